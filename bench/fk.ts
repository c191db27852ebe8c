import { armScratch, flangePose, identity, jacobian, jacobianScratch, robotById, seededRandom, type SerialArm } from "@twincell/core";
import { figure, microseconds, type Bench, type Figure } from "./figure.ts";
import { KR6_ARM } from "./robots/kr6.ts";

const SETS = 1024, CALLS = 200_000, ROUNDS = 15;

/** Pose of the flange, and pose with Jacobian, from six joint angles, one thread; with scratch and answer given nothing is allocated. */
export const run: Bench = () => {
  const rx90l = robotById("staubli_rx90l");
  if (!rx90l) throw new Error("The library has no staubli_rx90l.");
  return Promise.resolve([...figuresOf("rx90l", rx90l.arm), ...figuresOf("kr6", KR6_ARM)]);
};

function figuresOf(name: string, arm: SerialArm): Figure[] {
  const random = seededRandom(2), scratch = armScratch(), flange = identity<"base", "flange">(), rows = new Float64Array(36), working = jacobianScratch();
  const sets = Array.from({ length: SETS }, () => Float64Array.from(arm.joints, () => (random() - 0.5) * 6));
  return [
    figure(`fk/${name}`, "us", microseconds(CALLS, ROUNDS, i => { flangePose(arm, sets[i % SETS]!, flange, scratch); }), "budget 0.1"),
    figure(`fkjac/${name}`, "us", microseconds(CALLS, ROUNDS, i => { jacobian(arm, sets[i % SETS]!, null, rows, working); }), "budget 0.3"),
  ];
}

if (import.meta.main) for (const line of await run()) process.stdout.write(`${JSON.stringify(line)}\n`);
