import { expect, test } from "vitest";
import { accessCode, askForCode, clientOf } from "./access.ts";

test("twenty wrong codes of one client are followed by a pause of a minute, each further one by twice the pause up to an hour; who has the cookie and every other client stay in", () => {
  let now_s = 100;
  const access = accessCode(() => now_s);
  const wrong = access.code === "000000" ? "000001" : "000000";
  const first = access.enter(undefined, access.code, "b");
  if (first.kind !== "welcome-with-cookie") throw new Error(first.kind);
  const cookie = first.cookie.split(";")[0]!;
  for (let i = 0; i < 19; i++) expect(access.enter(undefined, wrong, "a")).toEqual({ kind: "ask" });
  for (const pause_s of [60, 120, 240, 480, 960, 1920, 3600, 3600]) {
    expect(access.enter(undefined, wrong, "a")).toEqual({ kind: "too-many-tries" });
    now_s += pause_s - 1;
    expect(access.enter(undefined, access.code, "a")).toEqual({ kind: "too-many-tries" });
    expect(access.enter(cookie, null, "a")).toEqual({ kind: "welcome" });
    expect(access.enter(undefined, access.code, "b")).toMatchObject({ kind: "welcome-with-cookie" });
    now_s += 2;
  }
  expect(access.enter(undefined, access.code, "a")).toMatchObject({ kind: "welcome-with-cookie" });
  expect(access.enter(undefined, wrong, "a")).toEqual({ kind: "ask" });
});

test("a client is its address, of IPv6 its network", () => {
  expect(clientOf("192.168.1.4")).toBe("192.168.1.4");
  expect(clientOf("::ffff:192.168.1.4")).toBe("::ffff:192.168.1.4");
  expect(clientOf("2001:db8:1:2:aaaa::1")).toBe(clientOf("2001:db8:1:2:bbbb::9"));
  expect(clientOf("fe80::1")).toBe(clientOf("fe80::2"));
  expect(clientOf("2001:db8:1:3:aaaa::1")).not.toBe(clientOf("2001:db8:1:2:aaaa::1"));
});

test("the page that asks for the code speaks the first language of the browser that it is written in, else English", () => {
  expect(askForCode("fr;q=0.9,de-AT;q=0.8,en;q=0.7")).toMatch(/<html lang="de">.*Die sechs Ziffern/s);
  expect(askForCode("fr,xx")).toMatch(/<html lang="en">.*Type the six digits/s);
  expect(askForCode()).toContain('<html lang="en">');
});
