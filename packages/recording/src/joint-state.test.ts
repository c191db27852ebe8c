import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { jointStateTemplate, positionsOffset } from "./joint-state.ts";

interface Case {
  frame: string;
  names: string[];
  sec: number;
  nanosec: number;
  q_rad: number[];
  hex: string;
}
const golden = JSON.parse(
  readFileSync(new URL("../../../fixtures/recording/joint-state.cdr.json", import.meta.url), "utf8"),
) as { cases: Case[] };

test("joint states have the bytes that another ROS 2 implementation gives them", () => {
  expect(golden.cases.length).toBe(4);
  for (const { frame, names, sec, nanosec, q_rad, hex } of golden.cases) {
    const { bytes, stampAt, positionsAt } = jointStateTemplate(frame, names);
    const view = new DataView(bytes.buffer);
    view.setInt32(stampAt, sec, true);
    view.setUint32(stampAt + 4, nanosec, true);
    q_rad.forEach((q, i) => {
      view.setFloat64(positionsAt + 8 * i, q, true);
    });
    expect(Buffer.from(bytes).toString("hex")).toBe(hex);
  }
});

test("angles are read from another implementation's bytes, and nothing from bytes cut short", () => {
  for (const { names, q_rad, hex } of golden.cases) {
    const bytes = Uint8Array.from(Buffer.from(hex, "hex"));
    const { length } = bytes;
    const joints = names.length;
    for (const before of [0, 3]) {
      const view = new DataView(Uint8Array.from([...new Array<number>(before).fill(9), ...bytes]).buffer);
      const at = before + positionsOffset(view, before, before + length, joints);
      expect(q_rad.map((_, i) => view.getFloat64(at + 8 * i, true))).toEqual(q_rad);
      expect(positionsOffset(view, before, before + length, joints + 1)).toBe(-1);
      for (let cut = 0; cut < length - 8; cut++)
        expect(positionsOffset(view, before, before + cut, joints), `cut at ${cut}`).toBe(-1);
    }
  }
});
