/** A program as a person would write it by the statements of AS: the emitter writes the same. */
import {
  emptyProgram,
  pose,
  radians,
  robotById,
  type MoveStep,
  type Pallet,
  type Program,
  type Step,
} from "@twincell/core";
import { expect, test } from "vitest";
import { kawasakiAs } from "./index.ts";

const robot = robotById("kawasaki_rs007l")!;
const home: MoveStep = {
  id: "h",
  name: "Home",
  type: "move",
  path: "ptp",
  target: { q: [0, 0, -90, 0, -90, 0].map(radians), tool: "flange" },
  speed: { ratio: 0.5 },
  blend_m: 0,
};
const nested: Step = {
  id: "o",
  type: "repeat",
  times: 2,
  steps: [{ id: "i", type: "repeat", times: 3, steps: [{ id: "w", type: "wait", s: 0.5 }] }],
};
const written = (more: Partial<Program>): readonly string[] => {
  const emitted = kawasakiAs.emit({ ...emptyProgram(robot.id, "Fill tray"), ...more }, robot);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  return emitted.files[0]!.text.split(/\r?\n/).map(line => line.trim());
};

test("what the controller would keep from before is set first: base, passing, acceleration, braking", () => {
  expect(written({ steps: [nested] })).toEqual([
    ".PROGRAM fill_tray()",
    ";* Fill tray",
    ";* Kawasaki RS007L. Lengths in mm, angles in degrees, locations in the base of the robot.",
    "BASE NULL",
    "CP ON",
    "ACCEL 100 ALWAYS",
    "DECEL 100 ALWAYS",
    "FOR .count = 1 TO 2",
    "FOR .count_2 = 1 TO 3",
    "TWAIT 0.5",
    "END",
    "END",
    ".END",
    "",
  ]);
});

test("no two loops share a counter, two pallets neither", () => {
  const tray: Pallet = {
    frame: "world",
    origin: pose([0.4, 0.2, 0.2], [1, 0, 0, 0]),
    rowEnd: [0.46, 0.2, 0.2],
    columnEnd: [0.4, 0.26, 0.2],
    rows: 2,
    columns: 2,
    layers: 1,
    layer_m: 0,
  };
  const counters = written({
    pallets: { one: tray, two: tray },
    steps: [
      home,
      { id: "a", type: "pallet", pallet: "one", steps: [{ id: "w", type: "wait", s: 1 }] },
      { id: "b", type: "pallet", pallet: "two", steps: [{ id: "v", type: "wait", s: 1 }] },
    ],
  }).flatMap(line => /^FOR (\.\w+)/.exec(line)?.[1] ?? []);
  expect(counters).toEqual([".layer", ".line", ".along", ".layer_2", ".line_2", ".along_2"]);
});

test("acceleration and braking are said with the first motion where any step asks for less than all of it, and groups head their steps", () => {
  const slow: MoveStep = {
    id: "s",
    type: "move",
    path: "ptp",
    target: home.target,
    speed: { ratio: 0.5 },
    blend_m: 0,
    acceleration: { ratio: 0.5 },
    group: "g",
  };
  const lines = written({ steps: [home, slow], groups: { g: { name: "Edge 1" } } });
  expect(lines.filter(line => /^(?:ACCEL|DECEL|;==)/.test(line))).toEqual([
    "ACCEL 100 ALWAYS",
    "DECEL 100 ALWAYS",
    "ACCEL 100 ALWAYS",
    "DECEL 100 ALWAYS",
    ";== Edge 1",
    "ACCEL 50 ALWAYS",
    "DECEL 50 ALWAYS",
  ]);
  expect(written({ steps: [home, { ...home, id: "k" }] }).filter(line => line.startsWith("ACCEL"))).toEqual([
    "ACCEL 100 ALWAYS",
  ]);
});
