import {
  checkProgram,
  emptyProgram,
  flangePose,
  linkSolids,
  robotById,
  seededRandom,
  verifyProgram,
  type CellGeometry,
  type Pose,
  type Program,
  type Quaternion,
  type Robot,
  type Step,
  type Vector3,
} from "@twincell/core";
import { cellGeometry, edgeTraceCell } from "@twincell/project";
import { figure, type Figure } from "./figure.ts";

const POSES = 10_000;
const ROUNDS = 5;
/** Joint moves sweep far: seconds of motion count there, not poses. */
const JOINT_MOVES = 200;

/**
 * A program of 10,000 poses checked whole: postures, limits, speeds, singular postures, and contact proven along every
 * motion against the robot itself, table, carton and walls of the edge-trace cell: straight moves 2 mm apart, blended
 * like a traced edge, the same with a stop at each pose, and rows that the nearest postures do not get through. Beside
 * it 200 far joint moves between seeded postures.
 */
export function run(): Promise<Figure[]> {
  const cell = edgeTraceCell();
  const robot = robotById(cell.robot.id);
  if (!robot) throw new Error(`The library has no ${cell.robot.id}.`);
  const geometry = cellGeometry(cell, linkSolids(robot));
  const worldFromBase = cell.robot.worldFromBase;
  const figures: Figure[] = [];
  const programs: readonly (readonly [string, Program])[] = [
    ["10k", traced(robot, 0.002)],
    ["10k-stops", traced(robot, 0)],
    ["10k-choice", chosen(robot)],
    [`joints-${JOINT_MOVES}`, jointMoves(robot)],
  ];
  for (const [name, program] of programs) {
    for (const withCell of [false, true]) {
      const times: number[] = [];
      const processor: number[] = [];
      let note = "";
      for (let round = 0; round < ROUNDS; round++) {
        const begun_ms = performance.now();
        const used = process.cpuUsage();
        const { verdict } = checkProgram(program, robot, withCell ? { cell: geometry } : { worldFromBase });
        times.push(performance.now() - begun_ms);
        const { user, system } = process.cpuUsage(used);
        processor.push((user + system) / 1000);
        const count = (kind: string): number => verdict.steps.filter(step => step.verdict === kind).length;
        note = `${program.steps.length} poses, ${count("ok")} ok, ${count("warn")} warn, ${count("bad")} bad, ${count("unknown")} unknown, ${verdict.duration_s.toFixed(0)} s of motion${withCell ? ", collision on" : ""}`;
      }
      figures.push(
        figure(
          `check/${name}${withCell ? "" : "-no-collision"}`,
          "ms",
          times,
          `${note}; processor time ${processor.sort((a, b) => a - b)[ROUNDS >> 1]!.toFixed(0)} ms, all threads`,
        ),
      );
    }
  }
  return Promise.resolve([...figures, ...wholeMinute(robot, geometry)]);
}

const MINUTE_S = 60;
const MINUTE_MARGIN_M = 0.002;

/**
 * A program of a minute in the lab cell, 2 mm kept from everything: joint moves between working places and straight
 * moves over them.
 */
function wholeMinute(robot: Robot, geometry: CellGeometry): Figure[] {
  const laps = traced(robot, 0.002).steps.slice(1);
  const far = jointMoves(robot).steps;
  const steps: Step[] = [];
  let duration_s = 0;
  // A bundle of far moves, then a stretch of tracing, until the minute is full.
  for (let round = 0; duration_s < MINUTE_S; round++) {
    steps.push(
      ...far.slice(4 * round, 4 * round + 4),
      { ...laps[200 * round]!, id: `to${round}`, path: "ptp", speed: { ratio: 0.5 } } as Step,
      ...laps.slice(200 * round, 200 * round + 200),
    );
    duration_s = checkProgram({ ...emptyProgram(robot.id, "Minute"), steps }, robot, {
      worldFromBase: geometry.worldFromBase,
    }).verdict.duration_s;
  }
  const program = { ...emptyProgram(robot.id, "Minute"), steps };
  const times: number[] = [];
  const certified: number[] = [];
  const verified: number[] = [];
  let note = "";
  let pieces = 0;
  for (let round = 0; round < ROUNDS; round++) {
    let begun_ms = performance.now();
    const { verdict } = checkProgram(program, robot, { cell: geometry, margin_m: MINUTE_MARGIN_M });
    times.push(performance.now() - begun_ms);
    begun_ms = performance.now();
    const { plan, certificate } = checkProgram(program, robot, {
      cell: geometry,
      margin_m: MINUTE_MARGIN_M,
      certify: true,
    });
    certified.push(performance.now() - begun_ms);
    begun_ms = performance.now();
    const answer = verifyProgram(certificate!, program, plan, robot, geometry);
    verified.push(performance.now() - begun_ms);
    pieces = certificate!.segments.reduce((sum, segment) => sum + segment.pieces.length, 0);
    note = `${steps.length} steps, ${verdict.duration_s.toFixed(0)} s of motion, ${verdict.steps.filter(step => step.verdict === "bad").length} bad, least clearance ${((verdict.clearance_m ?? 0) * 1000).toFixed(0)} mm; ${answer.kind}`;
  }
  return [
    figure("check/60s", "ms", times, `budget 1000; margin 2 mm; ${note}`),
    figure("check/60s-certified", "ms", certified, `the same, keeping what proves it: ${pieces} pieces`),
    figure("check/60s-verified", "ms", verified, "the second proof of that certificate"),
  ];
}

/** Loops of straight moves, 2 mm apart, over a plane 0.25 m above the table. */
function traced(robot: Robot, blend_m: number): Program {
  const steps: Step[] = [];
  const down: Quaternion = [1, 0, 0, 0];
  const target = (position: Vector3): { pose: Pose<"frame", "tcp">; frame: string; tool: string } => ({
    pose: { position, quaternion: down },
    frame: "world",
    tool: "flange",
  });
  steps.push({
    id: "s0",
    type: "move",
    path: "ptp",
    target: target([0.65, 0, 0.75]),
    speed: { ratio: 0.5 },
    blend_m: 0,
  });
  for (let i = 1; i < POSES; i++) {
    const turn = i * 0.02;
    const radius = 0.1 + 0.02 * Math.sin(turn / 40);
    steps.push({
      id: `s${i}`,
      type: "move",
      path: "lin",
      speed: { mps: 0.1 },
      blend_m,
      target: target([0.55 + radius * Math.cos(turn), radius * Math.sin(turn), 0.75 + 0.01 * Math.sin(turn / 7)]),
    });
  }
  return { ...emptyProgram(robot.id, "Traced"), steps };
}

/**
 * Rows of nine straight moves that turn the tool by 206°, each begun by a joint move to a pose taught without a
 * posture: the nearest one runs joint 6 into its limit in every row, so that all postures of all poses have to be
 * weighed.
 */
function chosen(robot: Robot): Program {
  const row = 10;
  const steps: Step[] = Array.from({ length: POSES }, (_, i) => {
    const k = i % row;
    const turn = Math.floor(i / row) * 0.05;
    const { position, quaternion } = flangePose(robot.arm, [
      0.4 * Math.sin(turn) + 0.002 * k,
      -0.9 + 0.1 * Math.cos(turn),
      2.2,
      0.1,
      0.7,
      2.9 + 0.4 * k,
    ]);
    return {
      id: `s${i}`,
      type: "move",
      path: k === 0 ? "ptp" : "lin",
      target: { pose: { position, quaternion }, frame: "world", tool: "flange" },
      speed: k === 0 ? { ratio: 0.5 } : { mps: 0.05 },
      blend_m: 0,
    };
  });
  return { ...emptyProgram(robot.id, "Rows"), steps };
}

/** Joint moves from one seeded posture to the next, all inside the limits and not far from home. */
function jointMoves(robot: Robot): Program {
  const random = seededRandom(11);
  const centre = [0, -0.9, 2.2, 0, 0.6, 0];
  const reach = [1, 0.15, 0.15, 1.5, 0.8, 2];
  const steps: Step[] = Array.from({ length: JOINT_MOVES }, (_, i) => ({
    id: `s${i}`,
    type: "move",
    path: "ptp",
    target: { q: centre.map((c, j) => c + (random() * 2 - 1) * reach[j]!) },
    speed: { ratio: 1 },
    blend_m: 0,
  }));
  return { ...emptyProgram(robot.id, "Joint moves"), steps };
}
