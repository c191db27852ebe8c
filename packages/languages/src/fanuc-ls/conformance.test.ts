import {
  CAPABILITIES,
  PALLET_ORDERS,
  emptyProgram,
  pose,
  robotById,
  type MoveStep,
  type Program,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { fanucLs } from "./index.ts";
import { describeDialect, type DialectBench } from "../testing/describe-dialect.ts";
import { describeStructure } from "../testing/describe-structure.ts";
import { randomProgram } from "../testing/programs.ts";
import { flawsOfListing } from "../testing/strict-fanuc-ls.ts";
import { structuredProgram } from "../testing/structured.ts";

const bench: DialectBench = {
  robot: robotById("fanuc_lrmate200id")!,
  worldFromBase: pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]),
  paths: ["ptp", "lin", "circ"],
  structured: true,
};

describeDialect(fanucLs, bench);
describeStructure(fanucLs, bench);

const { robot, worldFromBase, paths } = bench;
const cannot = fanucLs.cannot.map(({ what }) => what);
const filesOf = (program: Program): readonly string[] => {
  const emitted = fanucLs.emit(program, robot, worldFromBase);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  return emitted.files.map(({ text }) => text);
};

describe("a strict grammar of listings", () => {
  const can = new Set(CAPABILITIES.filter(capability => !cannot.includes(capability)));

  test("takes every file that is written", () => {
    const programs = [1, 2, 3, 4, 5, 6].map(seed =>
      randomProgram(robot, { seed, steps: 40, worldFromBase, paths, cannot, can }),
    );
    for (const program of [
      ...programs,
      ...PALLET_ORDERS.map(order => structuredProgram(robot, worldFromBase, new Set(cannot), { order })),
    ]) {
      for (const text of filesOf(program)) expect(flawsOfListing(text)).toEqual([]);
    }
  });

  test.each<[string, (text: string) => string]>([
    ["a line without its end", text => text.replace(" ;\r\n", "\r\n")],
    ["a number of lines that is not theirs", text => text.replace(/LINE_COUNT\t= ([0-9]+)/, "LINE_COUNT\t= 1$1")],
    ["a number that is missing", text => text.replace("   2:", "   3:")],
    ["per cent on a straight motion", text => text.replace("mm/sec", "%")],
    ["a position that is missing", text => text.replace("P[1]{", "P[77]{")],
    ["an open loop", text => text.replace("  ENDFOR ;", "  !end ;")],
    ["small letters in its name", text => text.replace("/PROG  P", "/PROG  p")],
    ["a configuration of four turns", text => text.replace("T, 0, 0, 0'", "T, 0, 0, 0, 0'")],
  ])("refuses a listing with %s", (_, spoil) => {
    const [text] = filesOf(structuredProgram(robot, worldFromBase, new Set(cannot)));
    const spoilt = spoil(text!);
    expect(spoilt).not.toBe(text);
    expect(flawsOfListing(spoilt)).not.toEqual([]);
  });
});

test("each program is a file of its own, named as the controller names it; what it cannot hold is refused with its step", () => {
  const emitted = fanucLs.emit(structuredProgram(robot, worldFromBase, new Set(cannot)), robot, worldFromBase);
  expect(emitted).toMatchObject({ kind: "emitted", files: [{ name: "PALLETISE.LS" }, { name: "DROP.LS" }] });
  const home: MoveStep = {
    id: "h",
    type: "move",
    path: "ptp",
    target: { q: [...robot.home_rad] },
    speed: { ratio: 1 },
    blend_m: 0,
  };
  const refused = (...steps: Program["steps"]): unknown =>
    fanucLs.emit({ ...emptyProgram(robot.id), steps }, robot, worldFromBase);
  expect(refused(home, { id: "w", type: "wait", s: 400 })).toMatchObject({
    kind: "cannot",
    step: "w",
    sentence: "Step w waits 400 s; WAIT goes up to 327.67 s.",
  });
  expect(
    refused(home, { id: "m", type: "message", text: "This is longer than one line of the pendant" }),
  ).toMatchObject({ kind: "cannot", step: "m" });
  expect(refused(home, { id: "s", type: "set", signal: "lamp", to: true })).toMatchObject({
    kind: "cannot",
    step: "s",
    sentence: expect.stringContaining("not in the list"),
  });
  // Where the robot never stands there is no place for a call: the way cannot be written in parts.
  expect(refused(...Array.from({ length: 10_000 }, (_, i) => ({ ...home, id: `h${i}`, blend_m: 0.01 })))).toMatchObject(
    { kind: "cannot", step: "h9999", sentence: expect.stringContaining("a listing numbers 9999") },
  );
});
