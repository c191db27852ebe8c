import {
  angleBetween,
  baseField,
  clutchStep,
  compose,
  distance,
  emptyProgram,
  explainPose,
  FREE_HAND,
  fromAxisAngle,
  identity,
  inferPallet,
  repairPose,
  robotById,
  seededRandom,
  takeGrip,
  type MoveStep,
  type Pose,
  type Program,
  type Random,
} from "@twincell/core";
import {
  bruteRepairs,
  FLANGE_IN_TOOL,
  GRID,
  infeasiblePoses,
  leastBeyond,
  reachable,
  WristDistance,
} from "../packages/core/src/checks/repair/testing/brute-force.ts";
import {
  placesMet,
  randomPallet,
  type HandNoise,
} from "../packages/core/src/teach/demonstration/testing/random-pallets.ts";
import { singularJogs } from "../packages/core/src/teach/testing/singular-jogs.ts";
import { figure, type Bench, type Figure } from "./figure.ts";

const POSES = 10_000;
const REPAIRED = 300;
const PALLETS = 500;
const ENGAGES = 100_000;
const FIELDS = 20;
const JOGS = 1000;

/** Explaining and repairing poses against brute force, teaching once, the clutch, the reach field, singular jogs. */
export const run: Bench = () =>
  Promise.resolve([...explained(), ...repaired(), ...taughtOnce(), clutch(), ...field(), ...jogs()]);

/** The binding cause of 10,000 poses that the KR 6 cannot reach, against trying every posture. */
function explained(): Figure[] {
  const robot = robotById("kuka_kr6r900sixx")!;
  const wrist = new WristDistance(robot);
  const poses = infeasiblePoses(robot, seededRandom(2));
  const times: number[] = [];
  let same = 0;
  for (let n = 0; n < POSES; n++) {
    const flange = compose(poses.next().value, FLANGE_IN_TOOL);
    const began_ms = performance.now();
    const cause = explainPose(robot, flange);
    times.push(performance.now() - began_ms);
    if (cause.kind !== "reach") continue;
    const { reach } = cause;
    if (reach.kind === "outside-limits") {
      const { joint, over } = leastBeyond(robot, flange);
      if (joint === reach.joint && Math.abs(Math.abs(reach.wanted_rad - reach.limit_rad) - over) < 1e-9) same++;
    } else if (reach.kind === "too-far") same += Math.abs(reach.beyond_m - wrist.miss(flange)) < 1e-5 ? 1 : 0;
    else if (reach.kind === "too-near") same += leastBeyond(robot, flange).over === Infinity ? 1 : 0;
  }
  return [
    figure("teach/explain-agreement", `of ${POSES}`, [same], "binding cause equal to brute force; aim: all"),
    figure("teach/explain", "ms", times, "one explanation; budget 5"),
  ];
}

/** Of what brute force can repair: how much is repaired, and with at most a tenth more than the least change. */
function repaired(): Figure[] {
  const robot = robotById("kuka_kr6r900sixx")!;
  const fits = reachable(robot);
  const poses = infeasiblePoses(robot, seededRandom(7));
  let possible = 0;
  let done = 0;
  let least = 0;
  for (let n = 0; n < REPAIRED; n++) {
    const pose = poses.next().value;
    const brute = bruteRepairs(pose, fits);
    const kinds = (["spin", "tilt", "shift"] as const).filter(kind => brute[kind] !== undefined);
    if (kinds.length === 0) continue;
    possible++;
    const ours = repairPose(robot, pose, FLANGE_IN_TOOL);
    if (ours.length === 0) continue;
    done++;
    const within = kinds.every(kind => {
      const amount = ours.find(({ change }) => change.kind === kind)?.amount;
      return amount !== undefined && amount <= 1.1 * brute[kind]! + GRID[kind];
    });
    if (within) least++;
  }
  const percent = (count: number): number[] => [(100 * count) / possible];
  return [
    figure("teach/repair", "%", percent(done), `of ${possible} poses that brute force can repair; aim 90`),
    figure(
      "teach/repair-least",
      "%",
      percent(least),
      "every kind of repair within a tenth (and one grid step) of the least",
    ),
  ];
}

function taughtOnce(): Figure[] {
  const once = (name: string, noise: HandNoise, places: number | undefined, note: string): Figure[] => {
    const random = seededRandom(54);
    const times: number[] = [];
    let right = 0;
    for (let n = 0; n < PALLETS; n++) {
      const shown = randomPallet(random, noise, places);
      const began_ms = performance.now();
      const answer = inferPallet(shown.demonstration, shown.options);
      times.push(performance.now() - began_ms);
      if (answer.kind === "program" && placesMet(answer, shown, 0.002, Math.PI / 360) === 9) right++;
    }
    return [
      figure(`teach/${name}`, `of ${PALLETS}`, [right], note),
      figure(`teach/${name}-time`, "ms", times, "one demonstration of two cycles"),
    ];
  };
  const hasty: HandNoise = { misses_m: 0.005, tremor_m: 0.0015, turns_rad: 0.05 };
  const trembling: HandNoise = { misses_m: 0, tremor_m: 0.005, turns_rad: 0.05 };
  return [
    ...once(
      "once-missed",
      hasty,
      9,
      "placements missed by up to 5 mm, nine places said; nine of nine within 2 mm; aim 475",
    ),
    ...once("once-tremor", trembling, 9, "samples tremble by 5 mm, nine places said; aim 475"),
    ...once("once-uncounted", hasty, undefined, "missed by up to 5 mm, the number of places not said"),
  ];
}

/** The farthest that the tool moves in the frame in which the grip closes, at any scale, wherever the hand is. */
function clutch(): Figure {
  const random = seededRandom(29);
  const anywhere = <To extends string>(): Pose<"world", To> => ({
    position: [6 * random() - 3, 6 * random() - 3, 3 * random()],
    quaternion: fromAxisAngle(direction(random), 2 * Math.PI * random()),
  });
  let jump = 0;
  for (let n = 0; n < ENGAGES; n++) {
    const hand = anywhere<"hand">();
    const tool = anywhere<"tcp">();
    const at = clutchStep(takeGrip(hand, tool), hand, { ...FREE_HAND, scale: 0.1 + 1.9 * random() });
    jump = Math.max(jump, distance(at.position, tool.position) + angleBetween(at.quaternion, tool.quaternion));
  }
  return figure("teach/clutch-jump", "m + rad", [jump], `largest of ${ENGAGES} engages at scales 0.1 to 2`);
}
function direction(random: Random): [number, number, number] {
  const z = 2 * random() - 1;
  const angle = 2 * Math.PI * random();
  const flat = Math.sqrt(1 - z * z);
  return [flat * Math.cos(angle), flat * Math.sin(angle), z];
}

/** From where on the floor a program of 40 straight moves could be carried out. */
function field(): Figure[] {
  const robot = robotById("staubli_rx90l")!;
  const random = seededRandom(3);
  const steps = Array.from(
    { length: 40 },
    (_, i): MoveStep => ({
      id: `s${i}`,
      type: "move",
      path: i === 0 ? "ptp" : "lin",
      target: {
        pose: {
          position: [0.9 + 0.4 * random(), 0.8 * random() - 0.4, 0.3 + 0.5 * random()],
          quaternion: [1, 0, 0, 0],
        },
        frame: "world",
        tool: "flange",
      },
      speed: i === 0 ? { ratio: 0.5 } : { mps: 0.2 },
      blend_m: 0,
    }),
  );
  const program: Program = { ...emptyProgram(robot.id), steps };
  const coarse: number[] = [];
  const whole: number[] = [];
  const rates: number[] = [];
  for (let n = 0; n < FIELDS; n++) {
    const began_ms = performance.now();
    let first = true;
    let poses = 0;
    for (const { points, squares } of baseField(program, robot, identity())) {
      if (first) coarse.push(performance.now() - began_ms);
      first = false;
      poses = points * squares.length;
    }
    const took_ms = performance.now() - began_ms;
    whole.push(took_ms);
    rates.push((1000 * poses) / took_ms);
  }
  return [
    figure("teach/field-rate", "poses/s", rates, "each asked with and without 20° of room; aim 100000"),
    figure("teach/field-coarse", "ms", coarse, "first field; budget 200"),
    figure("teach/field", "ms", whole, "complete; budget 2000"),
  ];
}

/** Jogs that leave the singularity they began on, of a thousand at each of three. */
function jogs(): Figure[] {
  return ["staubli_rx90l", "kuka_kr6_2", "ur10e", "abb_crb15000_5_95"].map(id => {
    const results = ([2, 3, 5] as const).map(joint =>
      singularJogs(robotById(id)!, joint, JOGS, seededRandom(500 + joint)),
    );
    const left = results.reduce((sum, each) => sum + each.left, 0);
    const limited = results.reduce((sum, each) => sum + each.limited, 0);
    return figure(
      `teach/jogs-${id}`,
      `of ${3 * JOGS}`,
      [left],
      `left, or ended where the reach or a limit ends; ${limited} more were kept from it by a named joint limit`,
    );
  });
}
