import {
  armScratch,
  flangePose,
  identity,
  jacobian,
  jacobianScratch,
  robotById,
  seededRandom,
  type SerialArm,
} from "@twincell/core";
import { collections, figure, settled, type Bench, type Figure } from "./figure.ts";
import { pinocchioFigures } from "./kinematics-peers.ts";
import { KR6_ARM } from "./robots/kr6.ts";

/**
 * More inputs than a branch predictor can learn by heart. Many rounds shorter than a time slice: the median then stands
 * even while other processes share the cores.
 */
const SETS = 16_384;
const CALLS = 2000;
const ROUNDS = 301;
const WARM_UP = 100;
const PEER_SETS = 2000;

/**
 * Pose of the flange, and pose with Jacobian, from six joint angles, one thread; with scratch and answer given nothing
 * is allocated.
 */
export const run: Bench = async () => {
  const rx90l = robotById("staubli_rx90l");
  if (!rx90l) throw new Error("The library has no staubli_rx90l.");
  return [...(await figuresOf("rx90l", rx90l.arm)), ...(await figuresOf("kr6", KR6_ARM))];
};

async function figuresOf(name: string, arm: SerialArm): Promise<Figure[]> {
  const random = seededRandom(2);
  const scratch = armScratch();
  const flange = identity<"base", "flange">();
  const rows = new Float64Array(36);
  const working = jacobianScratch();
  const sets = Array.from({ length: SETS }, () => Float64Array.from(arm.joints, () => (random() - 0.5) * 6));
  return [
    figure(
      `fk/${name}`,
      "us",
      settled(CALLS, ROUNDS, WARM_UP, i => {
        flangePose(arm, sets[i % SETS]!, flange, scratch);
      }),
      "budget 0.1",
    ),
    figure(
      `fkjac/${name}`,
      "us",
      settled(CALLS, ROUNDS, WARM_UP, i => {
        jacobian(arm, sets[i % SETS]!, null, rows, working);
      }),
      "budget 0.3",
    ),
    figure(
      `fk/${name}-collections`,
      "per 10⁶",
      [
        await collections(1_000_000, i => {
          flangePose(arm, sets[i % SETS]!, flange, scratch);
          jacobian(arm, sets[i % SETS]!, null, rows, working);
        }),
      ],
      "garbage collections of forward kinematics and Jacobian; budget 0",
    ),
    ...pinocchioFigures(name, arm, sets.slice(0, PEER_SETS)),
  ];
}

if (import.meta.main) for (const line of await run()) process.stdout.write(`${JSON.stringify(line)}\n`);
