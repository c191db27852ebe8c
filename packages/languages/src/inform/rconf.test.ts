import { degrees, emptyProgram, radians, robotById, seededRandom, type MoveStep, type Program } from "@twincell/core";
import { expect, test } from "vitest";
import { inform, proveText, runnableFile } from "../index.ts";

const robot = robotById("yaskawa_gp8")!;
/** With these L and U the wrist centre stands above axis S, over the shoulder by some hundredths of a millimetre. */
const ABOVE_S_DEG = { l: 130.1223459221525, u: -29.147741459504815 } as const;
const move = (id: string, path: MoveStep["path"], q_deg: readonly number[]): MoveStep => ({
  id,
  type: "move",
  path,
  target: { q: q_deg.map(radians), tool: "flange" },
  speed: { mps: 0.2 },
  blend_m: 0,
});
const proof = (steps: Program["steps"]): { readonly kind: string; readonly sentence: string } => {
  const program: Program = { ...emptyProgram(robot.id), steps };
  const emitted = inform.emit(program, robot);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  return proveText(inform, runnableFile(inform, emitted.files)!, program, robot);
};

test("RCONF names the posture of the digits that are written: next to axis S they turn R across 90°", () => {
  const random = seededRandom(257);
  const within = (size: number): number => size * (2 * random() - 1);
  for (let i = 0; i < 200; i++) {
    const q_deg = [
      within(160),
      ABOVE_S_DEG.l,
      ABOVE_S_DEG.u,
      (random() < 0.5 ? 90 : -90) + within(0.05),
      45 + within(30),
      within(120),
    ];
    const { kind, sentence } = proof([
      move("above", "ptp", q_deg),
      move("there", "lin", q_deg),
      move("again", "lin", [...q_deg.slice(0, 5), q_deg[5]! + 20]),
    ]);
    expect(kind, `${i}: ${q_deg.map(value => value.toFixed(3)).join(" ")}: ${sentence}`).toBe("proven");
  }
});

test("the posture of seed 257 of the round trips", () => {
  const q_rad = [
    -2.6059407076240797, 2.271063366760578, -0.5087240579884165, 1.5710882030541033, 0.7923547894151648,
    -0.9517369816450448,
  ];
  expect(proof([move("a", "ptp", [0, 0, 0, 0, -90, 0]), move("k25", "ptp", q_rad.map(degrees))]).kind).toBe("proven");
});
