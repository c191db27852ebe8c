import { JerkMotion, JerkPlanner, seededRandom, type JerkLimits, type JerkState } from "@twincell/core";
import { figure, settled, type Bench, type Figure } from "./figure.ts";
import { numbersOf, pythonPeer } from "./peer.ts";

const AXES = 6;
const CASES = 2048;
const CALLS = 2000;
const ROUNDS = 101;
const WARM_UP = 60;

interface Case {
  readonly from: JerkState;
  readonly to: JerkState;
}

/**
 * Jerk-limited motions of six axes that arrive together: rest to rest, and from any speed and acceleration to any
 * other. Limits are those of a medium-sized arm, states are seeded. Ruckig plans the very same cases in the same run.
 */
export const run: Bench = () => {
  const limits: JerkLimits[] = [3, 2.5, 3, 6, 6, 8].map(speed => ({
    speed,
    acceleration: speed * 4,
    jerk: speed * 40,
  }));
  const figures: Figure[] = [];
  for (const [name, budget, cases] of [
    ["rest", 2, restCases()],
    ["any", 6, anyCases(limits)],
  ] as const) {
    const planner = new JerkPlanner(limits);
    const motion = new JerkMotion(AXES);
    const durations = new Float64Array(CASES);
    for (let k = 0; k < CASES; k++) {
      const answer = planner.plan(cases[k]!.from, cases[k]!.to, motion);
      if (answer.kind !== "planned") throw new Error(`Case ${k} of ${name} is not planned: ${answer.kind}.`);
      durations[k] = motion.duration_s;
    }
    const times = settled(CALLS, ROUNDS, WARM_UP, i => {
      const one = cases[i % CASES]!;
      planner.plan(one.from, one.to, motion);
    });
    figures.push(figure(`profile/${name}`, "us", times, `${AXES} axes, ${CASES} seeded cases; budget ${budget}`));
    const peer = pythonPeer("ruckig", ["ruckig==0.19.4"], RUCKIG, { limits, cases, calls: CALLS, rounds: 21 });
    if (peer === undefined) continue;
    const theirs = numbersOf(peer, "durations");
    let slower = 0;
    let faster = 0;
    for (let k = 0; k < CASES; k++) {
      const by = durations[k]! / theirs[k]! - 1;
      slower = Math.max(slower, by);
      faster = Math.min(faster, by);
    }
    figures.push(
      figure(
        `profile/${name}-ruckig`,
        "us",
        numbersOf(peer, "times"),
        "Ruckig 0.19.4 (C++), same cases, called from Python",
      ),
    );
    figures.push(
      figure(
        `profile/${name}-slower-than-ruckig`,
        "1",
        [slower],
        `largest relative excess of a duration over Ruckig's; the largest saving is ${(-faster).toExponential(1)}; must be below 1e-6`,
      ),
    );
  }
  return Promise.resolve(figures);
};

function restCases(): Case[] {
  const random = seededRandom(31);
  const place = (): number[] => Array.from({ length: AXES }, () => random() * 4 - 2);
  return Array.from({ length: CASES }, () => ({ from: { place: place() }, to: { place: place() } }));
}

/**
 * Speeds and accelerations up to 70 % of the limits, less where they would run over them before they can be taken back.
 */
function anyCases(limits: readonly JerkLimits[]): Case[] {
  const random = seededRandom(32);
  const state = (): JerkState => {
    const place: number[] = [];
    const speed: number[] = [];
    const acceleration: number[] = [];
    for (const { speed: v, acceleration: a } of limits) {
      place.push(random() * 4 - 2);
      speed.push((random() * 1.4 - 0.7) * v);
      acceleration.push((random() * 1.4 - 0.7) * a);
    }
    return { place, speed, acceleration };
  };
  return Array.from({ length: CASES }, () => ({ from: state(), to: state() }));
}

/** Times the call alone: inputs are made before. */
const RUCKIG = `
import json, sys, time
from ruckig import Ruckig, InputParameter, Trajectory
data = json.load(sys.stdin)
n = len(data["limits"])
inputs = []
for case in data["cases"]:
    i = InputParameter(n)
    i.max_velocity = [l["speed"] for l in data["limits"]]
    i.max_acceleration = [l["acceleration"] for l in data["limits"]]
    i.max_jerk = [l["jerk"] for l in data["limits"]]
    zero = [0.0] * n
    for side, name in (("from", "current"), ("to", "target")):
        state = case[side]
        setattr(i, name + "_position", state["place"])
        setattr(i, name + "_velocity", state.get("speed", zero))
        setattr(i, name + "_acceleration", state.get("acceleration", zero))
    inputs.append(i)
otg, trajectory = Ruckig(n), Trajectory(n)
durations = []
for i in inputs:
    otg.calculate(i, trajectory)
    durations.append(trajectory.duration)
times = []
for r in range(data["rounds"]):
    begun = time.perf_counter_ns()
    for k in range(data["calls"]):
        otg.calculate(inputs[k % len(inputs)], trajectory)
    times.append((time.perf_counter_ns() - begun) / 1000 / data["calls"])
print(json.dumps({"durations": durations, "times": times}))
`;

if (import.meta.main) for (const line of await run()) process.stdout.write(`${JSON.stringify(line)}\n`);
