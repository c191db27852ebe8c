import { expect, test } from "vitest";
import { accessCode } from "./access.ts";

test("twenty wrong codes are followed by a pause of a minute, not by one until the next start; who has the cookie stays in", () => {
  let now_s = 100;
  const access = accessCode(() => now_s);
  const wrong = access.code === "000000" ? "000001" : "000000";
  const first = access.enter(undefined, access.code);
  if (first.kind !== "welcome-with-cookie") throw new Error(first.kind);
  const cookie = first.cookie.split(";")[0]!;
  for (let i = 0; i < 19; i++) expect(access.enter(undefined, wrong)).toEqual({ kind: "ask" });
  expect(access.enter(undefined, wrong)).toEqual({ kind: "too-many-tries" });
  now_s += 59;
  expect(access.enter(undefined, access.code)).toEqual({ kind: "too-many-tries" });
  expect(access.enter(cookie, null)).toEqual({ kind: "welcome" });
  now_s += 2;
  expect(access.enter(undefined, wrong)).toEqual({ kind: "ask" });
  expect(access.enter(undefined, access.code)).toMatchObject({ kind: "welcome-with-cookie" });
});
