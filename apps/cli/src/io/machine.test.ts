import { expect, test } from "vitest";
import { diagnose, type Machine } from "./machine.ts";

const WELL: Machine = {
  node: "24.21.0",
  studioBuilt: true,
  portFree: true,
  port: 7341,
  lanAddresses: ["192.168.1.7"],
  chromium: "/usr/bin/chromium",
  python: "3.12",
  freeBytes: 50e9,
  parts: [{ name: "@mujoco/mujoco@3.14.0", what: "Physics", installed: true }],
};
const of = (about: string, change: Partial<Machine>) =>
  diagnose({ ...WELL, ...change }).find(each => each.about === about);

test("a machine that has everything lacks nothing", () => {
  expect(diagnose(WELL).every(({ level }) => level === "ok")).toBe(true);
});

test("what keeps Twincell from working is bad, what does not is a note; each says the way out in one line", () => {
  expect(of("Node", { node: "22.18.0" })).toMatchObject({ level: "bad", sentence: expect.stringContaining("Install") });
  expect(of("Node", { node: "24.0.0" })!.level).toBe("ok");
  expect(of("studio", { studioBuilt: false })!.level).toBe("bad");
  expect(of("disk", { freeBytes: 2e8 })).toMatchObject({ level: "bad", sentence: expect.stringContaining("200 MB") });
  expect(of("disk", { freeBytes: null })!.level).toBe("note");
  expect(of("port", { portFree: false })).toMatchObject({ level: "note", sentence: expect.stringContaining("--port") });
  expect(of("secure context", { lanAddresses: [] })!.level).toBe("note");
  expect(of("browser", { chromium: null })!.level).toBe("note");
  expect(of("Python", { python: "3.9" })).toMatchObject({ level: "note", sentence: expect.stringContaining("3.10") });
  expect(of("Python", { python: null })!.level).toBe("note");
  const part = { name: "occt-import-js@0.0.23", what: "Reading STEP files", installed: false };
  expect(of(part.name, { parts: [part] })!.sentence).toContain("npm install occt-import-js@0.0.23");
  for (const { sentence } of diagnose({ ...WELL, python: null, chromium: null, freeBytes: 1, lanAddresses: [] }))
    expect(sentence).not.toContain("\n");
});
