import { JointSpline, seededRandom, timeOptimal } from "@twincell/core";
import { figure, settled, type Bench, type Figure } from "./figure.ts";
import { numbersOf, pythonPeer } from "./peer.ts";

const WAYPOINTS = 100;
const PLACES = 1001;
const JOINTS = 6;
const PATHS = 8;
const CALLS = 24;
const ROUNDS = 31;
const WARM_UP = 20;
const SPEED = [3, 2.5, 3, 6, 6, 8];
const ACCELERATION = SPEED.map(v => v * 4);

/**
 * Time-optimal timing of a cubic spline through 100 seeded waypoints of six joints, within joint speeds and
 * accelerations, on 1,001 places; the spline is made and sampled inside the measured time. TOPP-RA times the same
 * waypoints.
 */
export const run: Bench = () => {
  const random = seededRandom(51);
  const limits = { speed_rad_s: Float64Array.from(SPEED), acceleration_rad_s2: Float64Array.from(ACCELERATION) };
  const paths = Array.from({ length: PATHS }, () => walk(random));
  const knots = Array.from({ length: WAYPOINTS }, (_, i) => i / (WAYPOINTS - 1));
  const durationOf = (waypoints: readonly number[][]): number => {
    const answer = timeOptimal(new JointSpline(waypoints, knots), limits, { places: PLACES });
    if (answer.kind !== "timed") throw new Error(`A path is not timed: ${answer.kind}.`);
    return answer.timing.duration_s;
  };
  const durations = paths.map(durationOf);
  const figures: Figure[] = [];
  const times = settled(CALLS, ROUNDS, WARM_UP, i => {
    durationOf(paths[i % PATHS]!);
  }).map(us => us / 1000);
  figures.push(
    figure(
      "timing/1001",
      "ms",
      times,
      `${WAYPOINTS} waypoints, ${JOINTS} joints, ${PLACES} places, spline included; budget 3`,
    ),
  );
  const peer = pythonPeer("toppra", ["toppra==0.6.10"], TOPPRA, {
    paths,
    knots,
    places: PLACES,
    speed: SPEED,
    acceleration: ACCELERATION,
  });
  if (peer !== undefined) {
    const theirs = numbersOf(peer, "durations");
    const slower = Math.max(...durations.map((mine, k) => mine / theirs[k]! - 1));
    figures.push(
      figure(
        "timing/1001-toppra",
        "ms",
        numbersOf(peer, "times"),
        "TOPP-RA 0.6.10 (Python, own seidel solver), same waypoints and places; instance and parameterisation, spline made before",
      ),
    );
    figures.push(
      figure(
        "timing/slower-than-toppra",
        "1",
        [slower],
        "largest relative excess of a duration over TOPP-RA's; both hold the limits at both ends of every interval",
      ),
    );
  }
  return Promise.resolve(figures);
};

/** Waypoints of a walk that turns gently, so that speeds as well as accelerations bind. */
function walk(random: () => number): number[][] {
  const q = Array.from({ length: JOINTS }, () => random() - 0.5);
  const heading = q.map(() => random() - 0.5);
  return Array.from({ length: WAYPOINTS }, () => {
    for (let j = 0; j < JOINTS; j++) {
      heading[j] = 0.9 * heading[j]! + 0.2 * (random() - 0.5);
      q[j]! += 0.1 * heading[j]!;
    }
    return [...q];
  });
}

const TOPPRA = `
import json, sys, time, logging
import numpy as np
import toppra as ta
import toppra.algorithm as algo
import toppra.constraint as constraint
logging.disable(logging.CRITICAL)
data = json.load(sys.stdin)
v, a = np.array(data["speed"]), np.array(data["acceleration"])
cv = constraint.JointVelocityConstraint(np.stack([-v, v], 1))
ca = constraint.JointAccelerationConstraint(np.stack([-a, a], 1), discretization_scheme=constraint.DiscretizationType.Interpolation)
grid = np.linspace(0, 1, data["places"])
durations, times = [], []
for round in range(4):
    for points in data["paths"]:
        path = ta.SplineInterpolator(np.array(data["knots"]), np.array(points), bc_type="natural")
        begun = time.perf_counter()
        instance = algo.TOPPRA([cv, ca], path, gridpoints=grid, solver_wrapper="seidel")
        sdd, sd, _ = instance.compute_parameterization(0, 0)
        times.append((time.perf_counter() - begun) * 1000)
        if round == 0:
            durations.append(float(np.sum(2 * np.diff(grid) / (sd[1:] + sd[:-1]))))
print(json.dumps({"durations": durations, "times": times}))
`;

if (import.meta.main) for (const line of await run()) process.stdout.write(`${JSON.stringify(line)}\n`);
