import type { Value } from "./values.ts";

const IDENTITY: Value = [
  [0, 0, 0],
  [1, 0, 0, 0],
];
const SPEEDS = [
  5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1500, 2000, 2500, 3000, 4000, 5000, 6000,
  7000,
];
/** Zone of the tool, of the orientation, and how far the tool may be turned in it: mm, mm, degrees. */
// biome-ignore format: table of numbers
const ZONES: readonly (readonly [tool: number, orient: number, turn: number])[] = [
  [0.3, 0.3, 0.03], [1, 1, 0.1], [5, 8, 0.8], [10, 15, 1.5], [15, 23, 2.3], [20, 30, 3], [30, 45, 4.5], [40, 60, 6], [50, 75, 7.5], [60, 90, 9],
  [80, 120, 12], [100, 150, 15], [150, 225, 23], [200, 300, 30],
];

/** A load of nothing must not have no mass: load0 weighs this [kg]. */
export const NOTHING_KG = 0.001;

/** Data that every controller has. Names are lower case. */
export function predefined(fullSpeed_mps: number): ReadonlyMap<string, Value> {
  const data = new Map<string, Value>([
    ["tool0", [true, IDENTITY, [NOTHING_KG, [0, 0, 0.001], [1, 0, 0, 0], 0, 0, 0]]],
    ["wobj0", [false, true, "", IDENTITY, IDENTITY]],
    ["load0", [NOTHING_KG, [0, 0, 0.001], [1, 0, 0, 0], 0, 0, 0]],
    ["fine", [true, 0, 0, 0, 0, 0, 0]],
    ["vmax", [fullSpeed_mps * 1000, 500, 5000, 1000]],
    ["pi", Math.PI],
    ["high", 1],
    ["low", 0],
    ["edge", 2],
    ["op_undef", 0],
    ["op_auto", 1],
    ["op_man_prog", 2],
    ["op_man_test", 3],
    ["stempty", ""],
    ["diskhome", "HOME:"],
  ]);
  for (const v of SPEEDS) data.set(`v${v}`, [v, 500, 5000, 1000]);
  for (const [tool, orient, turn] of ZONES)
    data.set(`z${Math.trunc(tool)}`, [false, tool, orient, orient, turn, orient, turn]);
  return data;
}
