import { findPath, PathValidator, type CellCollider, type SerialArm, type Vector3 } from "@twincell/core";
import { figure, microseconds, type Figure } from "./figure.ts";
import { numbersOf, pythonPeer } from "./peer.ts";

const QUESTIONS = 200;
const WARM_UP = 1200;

export interface PlanningCell {
  readonly collider: CellCollider;
  readonly arm: SerialArm;
  readonly free: readonly (readonly number[])[];
  /** Where the peer reads the same robot and objects. */
  readonly peer: {
    readonly urdf: string;
    readonly folder: string;
    readonly jig: string;
    readonly boxes: readonly { readonly center_m: Vector3; readonly half_size_m: Vector3 }[];
  };
}

/**
 * RRT-Connect of OMPL with the contact test of coal on the same meshes and pairs, called through pinocchio in one call
 * a posture. Its answers are lines between samples, 1 % of the extent of joint space apart; ours are proven between
 * them.
 */
const OMPL = `
import json, os, sys, time
import numpy as np
import pinocchio as pin, coal
from ompl import base as ob, geometric as og
import ompl.util as ou
ou.setLogLevel(ou.LOG_ERROR)
ou.RNG.setSeed(1)
task = json.load(sys.stdin)
model = pin.buildModelFromUrdf(task["urdf"])
shapes = pin.buildGeomFromUrdf(model, task["urdf"], pin.GeometryType.COLLISION, package_dirs=[task["folder"]])
links = shapes.ngeoms
place = lambda p: pin.SE3(np.eye(3), np.array(p, dtype=float))
for i, box in enumerate(task["boxes"]):
    shapes.addGeometryObject(pin.GeometryObject("box%d" % i, 0, 0, place(box["center_m"]), coal.Box(*[2 * h for h in box["half_size_m"]])))
shapes.addGeometryObject(pin.GeometryObject("jig", 0, 0, place([0, 0, 0]), coal.MeshLoader().load(task["jig"])))
joint = lambda i: shapes.geometryObjects[i].parentJoint
for i in range(links):
    for j in range(i + 1, shapes.ngeoms):
        if (j >= links and joint(i) > 0) or (j < links and abs(joint(i) - joint(j)) >= 2): shapes.addCollisionPair(pin.CollisionPair(i, j))
data, seen, n = model.createData(), shapes.createData(), model.nq
space = ob.RealVectorStateSpace(n)
bounds = ob.RealVectorBounds(n)
for k in range(n): bounds.setLow(k, float(model.lowerPositionLimit[k])); bounds.setHigh(k, float(model.upperPositionLimit[k]))
space.setBounds(bounds)
info = ob.SpaceInformation(space)
q = np.zeros(n)
def free(state):
    for k in range(n): q[k] = state[k]
    return not pin.computeCollisions(model, data, shapes, seen, q, True)
info.setStateValidityChecker(free)
info.setup()
def state(values):
    s = space.allocState()
    for k in range(n): s[k] = values[k]
    return s
times, found, lengths = [], 0, []
for start, goal in task["questions"]:
    problem = ob.ProblemDefinition(info)
    problem.setStartAndGoalStates(state(start), state(goal))
    planner = og.RRTConnect(info)
    planner.setProblemDefinition(problem)
    planner.setup()
    began = time.perf_counter_ns()
    planner.solve(5.0)
    times.append((time.perf_counter_ns() - began) / 1e6)
    if problem.hasExactSolution(): found += 1
json.dump({"times": times, "found": [found]}, sys.stdout)
`;

/**
 * Ways between random free postures of the KR 6 cell, each line of them proven; the same questions to OMPL with coal.
 */
export function planningFigures({ collider, arm, free, peer }: PlanningCell): Figure[] {
  const inside = free.filter(q =>
    q.every((angle, k) => angle >= arm.joints[k]!.limits.lower_rad && angle <= arm.joints[k]!.limits.upper_rad),
  );
  const checker = new PathValidator(collider, arm);
  const questions = Array.from({ length: QUESTIONS }, (_, i) => [inside[2 * i]!, inside[2 * i + 1]!] as const);
  const began_ms = performance.now();
  const first = findPath(checker, ...questions[0]!, { seed: 1 });
  const first_ms = performance.now() - began_ms;
  if (first.kind !== "found") throw new Error(`No way for the first question: ${first.kind}.`);
  // Other questions than those that count: the compiler settles and what was proven is kept, as for a cell that has
  // been open for a while.
  for (let i = 0; i < WARM_UP; i++)
    findPath(
      checker,
      inside[i % inside.length]!,
      inside[(i + 3 + 2 * Math.floor(i / inside.length)) % inside.length]!,
      {
        seed: i,
      },
    );
  let found = 0;
  let straight = 0;
  const times = questions.map(([from, to], i) => {
    const begun_ms = performance.now();
    const answer = findPath(checker, from, to, { seed: i + 1 });
    if (answer.kind === "found") {
      found++;
      if (answer.way.length === 2) straight++;
    }
    return performance.now() - begun_ms;
  });
  const filtered = microseconds(inside.length, 15, i => {
    checker.free(inside[i]!);
  });
  const answer = pythonPeer("ompl-coal", ["ompl==2.0.1", "pin==4.1.0"], OMPL, { ...peer, questions });
  return [
    figure(
      "plan/kr6",
      "ms",
      times,
      `budget 2; ${found} of ${QUESTIONS} found, ${straight} straight, every line proven free between samples too; new questions to a checker that answered ${WARM_UP} others`,
    ),
    figure("plan/kr6-first", "ms", [first_ms], "the first question of all, nothing compiled or kept yet"),
    ...(answer === undefined
      ? []
      : [
          figure(
            "plan/kr6-ompl",
            "ms",
            numbersOf(answer, "times"),
            `OMPL 2.0.1 RRTConnect, coal meshes through pinocchio 4.1.0 (one call from Python a posture), sampled and not proven, not shortened; ${numbersOf(answer, "found")[0]!} of ${QUESTIONS} found`,
          ),
        ]),
    figure(
      "collision/kr6-filtered",
      "us",
      filtered,
      "budget 10; free postures, pairs that are known to be clear there only looked up",
    ),
  ];
}
