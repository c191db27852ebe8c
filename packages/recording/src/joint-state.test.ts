import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { jointStateTemplate, readPositions } from "./joint-state.ts";

interface Case { frame: string; names: string[]; sec: number; nanosec: number; q_rad: number[]; hex: string }
const golden = JSON.parse(readFileSync(new URL("../../../fixtures/recording/joint-state.cdr.json", import.meta.url), "utf8")) as { cases: Case[] };

test("joint states have the bytes that another ROS 2 implementation gives them", () => {
  expect(golden.cases.length).toBe(4);
  for (const { frame, names, sec, nanosec, q_rad, hex } of golden.cases) {
    const { bytes, stampAt, positionsAt } = jointStateTemplate(frame, names), view = new DataView(bytes.buffer);
    view.setInt32(stampAt, sec, true);
    view.setUint32(stampAt + 4, nanosec, true);
    q_rad.forEach((q, i) => { view.setFloat64(positionsAt + 8 * i, q, true); });
    expect(Buffer.from(bytes).toString("hex")).toBe(hex);
  }
});

test("angles are read from another implementation's bytes, and nothing from bytes cut short", () => {
  for (const { names, q_rad, hex } of golden.cases) {
    const bytes = Uint8Array.from(Buffer.from(hex, "hex")), out = new Float64Array(names.length + 1);
    expect(readPositions(bytes, names.length, out, 1)).toBe(true);
    expect([...out.subarray(1)]).toEqual(q_rad);
    expect(readPositions(bytes, names.length + 1, out, 0)).toBe(false);
    for (let cut = 0; cut < bytes.length - 8; cut++) expect(readPositions(bytes.subarray(0, cut), names.length, out, 0), `cut at ${cut}`).toBe(false);
  }
});
