import { identity, linkPoses, flangePose, rotate, type SerialArm } from "@twincell/core";
import { figure, type Figure } from "./figure.ts";
import { numbersOf, pythonPeer } from "./peer.ts";

/**
 * Axes and steps from axis to axis in the base, all angles 0; the flange last. What EAIK and pinocchio build the same
 * arm from.
 */
function linesOf(arm: SerialArm): {
  readonly axes: number[][];
  readonly origins: number[][];
  readonly flange: number[];
} {
  const links = Array.from({ length: arm.joints.length + 1 }, () => identity<"base", "link">());
  const zero = new Float64Array(arm.joints.length);
  linkPoses(arm, zero, links);
  return {
    axes: arm.joints.map(({ axis }, j) => [...rotate(links[j + 1]!.quaternion, axis)]),
    origins: arm.joints.map((_, j) => [...links[j + 1]!.position]),
    flange: [...flangePose(arm, zero).position],
  };
}

const EAIK = `
import json, sys, time
import numpy as np
from eaik.IK_HP import HPRobot
task = json.load(sys.stdin)
H, places = np.array(task["axes"]), np.array(task["origins"] + [task["flange"]])
robot = HPRobot(H, np.vstack([places[:1], np.diff(places, axis=0)]))
poses = [robot.fwdKin(np.array(q)) for q in task["sets"]]
times = []
for k in range(12):
    began = time.perf_counter_ns()
    answers = robot.IK_batched(poses, 1)
    times.append((time.perf_counter_ns() - began) / 1000 / len(poses))
json.dump({"times": times[2:], "solutions": [float(np.mean([a.num_solutions() if hasattr(a, "num_solutions") else len(a.Q) for a in answers]))]}, sys.stdout)
`;

const PINOCCHIO = `
import json, sys, time
import numpy as np
import pinocchio as pin
task = json.load(sys.stdin)
model, before, parent = pin.Model(), np.zeros(3), 0
for k, (axis, origin) in enumerate(zip(task["axes"], task["origins"])):
    parent = model.addJoint(parent, pin.JointModelRevoluteUnaligned(np.array(axis)), pin.SE3(np.eye(3), np.array(origin) - before), "joint%d" % k)
    before = np.array(origin)
data, sets, flange = model.createData(), [np.array(q) for q in task["sets"]], pin.SE3(np.eye(3), np.array(task["flange"]) - before)
def timed(call):
    times = []
    for k in range(12):
        began = time.perf_counter_ns()
        for q in sets: call(q)
        times.append((time.perf_counter_ns() - began) / 1000 / len(sets))
    return times[2:]
fk = timed(lambda q: pin.forwardKinematics(model, data, q))
jacobian = timed(lambda q: pin.computeJointJacobians(model, data, q))
pin.forwardKinematics(model, data, sets[0])
json.dump({"fk": fk, "jacobian": jacobian, "place": [float(x) for x in (data.oMi[model.njoints - 1] * flange).translation]}, sys.stdout)
`;

/**
 * The same arm and joint angles through EAIK, all branches, one thread, in its own batch call. Nothing where it does
 * not install.
 */
export function eaikFigures(name: string, arm: SerialArm, sets: readonly Float64Array[]): Figure[] {
  const answer = pythonPeer("eaik", ["eaik==1.2.2"], EAIK, { ...linesOf(arm), sets: sets.map(q => [...q]) });
  return answer === undefined
    ? []
    : [
        figure(
          `ik/${name}-eaik`,
          "us",
          numbersOf(answer, "times"),
          `EAIK 1.2.2 (C++, its own batch call from Python, one thread), ${numbersOf(answer, "solutions")[0]!.toFixed(2)} solutions per pose`,
        ),
      ];
}

/**
 * The same arm and joint angles through pinocchio, called from Python one by one. Nothing where it does not install.
 * @throws {Error} when its flange stands elsewhere.
 */
export function pinocchioFigures(name: string, arm: SerialArm, sets: readonly Float64Array[]): Figure[] {
  const answer = pythonPeer("pinocchio", ["pin==4.1.0"], PINOCCHIO, { ...linesOf(arm), sets: sets.map(q => [...q]) });
  if (answer === undefined) return [];
  const ours = flangePose(arm, sets[0]!).position;
  const theirs = numbersOf(answer, "place");
  if (!ours.every((value, i) => Math.abs(value - theirs[i]!) < 1e-9))
    throw new Error(`Pinocchio has the flange of ${name} elsewhere.`);
  return [
    figure(
      `fk/${name}-pinocchio`,
      "us",
      numbersOf(answer, "fk"),
      "pinocchio 4.1.0 (C++), all joint frames, called from Python one by one",
    ),
    figure(
      `fkjac/${name}-pinocchio`,
      "us",
      numbersOf(answer, "jacobian"),
      "pinocchio 4.1.0 (C++), all frames and joint Jacobian, called from Python one by one",
    ),
  ];
}
