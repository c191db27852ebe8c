import { armScratch, flangePose, identity, robotById, seededRandom, type SerialArm } from "@twincell/core";
import { figure, microseconds, type Figure } from "./figure.ts";
import { KR6_ARM } from "./robots/kr6.ts";

const SETS = 1024, CALLS = 200_000, ROUNDS = 15;

/** Pose of the flange from six joint angles, one thread, with scratch and answer given: nothing is allocated. */
export function run(): Promise<Figure[]> {
  const rx90l = robotById("staubli_rx90l");
  if (!rx90l) throw new Error("The library has no staubli_rx90l.");
  return Promise.resolve([figureOf("fk/rx90l", rx90l.arm), figureOf("fk/kr6", KR6_ARM)]);
}

function figureOf(name: string, arm: SerialArm): Figure {
  const random = seededRandom(2), scratch = armScratch(), out = identity<"base", "flange">();
  const sets = Array.from({ length: SETS }, () => Float64Array.from(arm.joints, () => (random() - 0.5) * 6));
  return figure(name, "us", microseconds(CALLS, ROUNDS, i => { flangePose(arm, sets[i % SETS]!, out, scratch); }), "budget 0.1");
}

if (import.meta.main) for (const line of await run()) process.stdout.write(`${JSON.stringify(line)}\n`);
