import { describe, expect, test } from "vitest";
import {
  angleBetween,
  applyRepair,
  checkProgram,
  distance,
  emptyProgram,
  explainReach,
  flangePose,
  fromAxisAngle,
  multiply,
  pose,
  robotById,
  robotFromArm,
  seededRandom,
  solveAll,
  type Joint,
  type Pose,
  type Program,
  type Reach,
  type Robot,
} from "../index.ts";

const ur10e = robotById("ur10e")!;
const gofa = robotById("abb_crb15000_5_95")!;
const iiwa = robotById("kuka_lbr_iiwa_14_r820")!;
const rx90l = robotById("staubli_rx90l")!;
const START: Readonly<Record<string, readonly number[]>> = {
  [ur10e.id]: [0.4, -1.1, 1.3, -0.6, 0.8, 0.2],
  [gofa.id]: [0.3, 0.4, 0.5, 0.3, 0.8, 0.2],
  [iiwa.id]: [0.3, 0.7, -0.4, -1.2, 0.5, 0.9, 0.2],
  [rx90l.id]: [0.2, -1, 2, 0.3, 0.6, 0.1],
};
const MILLIMETRES = 1000;

/** The arm with every joint held to 0.3 rad about a posture. */
function held(robot: Robot, about: readonly number[]): Robot {
  const joints = robot.arm.joints.map(
    (joint, j): Joint => ({
      ...joint,
      limits: { ...joint.limits, lower_rad: about[j]! - 0.3, upper_rad: about[j]! + 0.3 },
    }),
  );
  return { ...robot, arm: { ...robot.arm, joints } };
}
const moved = ({ position: [x, y, z], quaternion }: Pose<"base", "flange">, share: number): Pose<"base", "flange"> => ({
  position: [x * share, y * share, z],
  quaternion,
});

describe.each([ur10e, gofa, iiwa, rx90l])("why $name cannot", robot => {
  const q = START[robot.id]!;
  const wanted = flangePose(robot.arm, q);
  const of = <K extends Reach["kind"]>(reach: Reach, kind: K): Extract<Reach, { kind: K }> => {
    if (reach.kind !== kind) throw new Error(`${reach.kind}, not ${kind}: ${explainReach(reach)}`);
    return reach as Extract<Reach, { kind: K }>;
  };

  test("too far: by how much, and so much nearer it is not", () => {
    const far = moved(wanted, 8);
    const reach = of(solveAll(robot, far), "too-far");
    expect(explainReach(reach)).toBe(
      `The wrist would be ${((reach.reach_m + reach.beyond_m) * MILLIMETRES).toFixed(0)} mm from the shoulder; the arm is ${(reach.reach_m * MILLIMETRES).toFixed(0)} mm long.`,
    );
    const away = Math.hypot(far.position[0], far.position[1]);
    const nearer = solveAll(robot, moved(far, 1 - (0.9 * reach.beyond_m) / away));
    expect(of(nearer, "too-far").beyond_m).toBeLessThan(0.5 * reach.beyond_m);
    // The wrist moves along with the flange: nothing the arm can stretch to is reported as too far.
    expect(reach.beyond_m).toBeGreaterThan(away - reach.reach_m - 0.5);
  });

  test("a joint beyond its limit: which, where it would turn and where it ends", () => {
    const tight = held(robot, q);
    for (let j = 0; j < q.length; j++) {
      const beyond = q.with(j, q[j]! + 0.35);
      const reach = solveAll(tight, flangePose(robot.arm, beyond), { near: beyond });
      if (reach.kind === "reached") {
        expect(robot.family.kind).toBe("spherical-seven");
        continue;
      }
      const { joint, wanted_rad, limit_rad } = of(reach, "outside-limits");
      const { lower_rad, upper_rad } = tight.arm.joints[joint - 1]!.limits;
      expect(wanted_rad > upper_rad ? limit_rad === upper_rad : wanted_rad < lower_rad && limit_rad === lower_rad).toBe(
        true,
      );
      if (q.length === 6) expect([joint, wanted_rad]).toEqual([j + 1, expect.closeTo(beyond[j]!, 6)]);
      expect(explainReach(reach)).toMatch(/^Joint \d would turn to -?\d+\.\d°; its limit is -?\d+\.\d°\.$/);
    }
  });

  test("X-08 the maker's smaller workspace", () => {
    const small: Robot = { ...robot, workspace: { reach_m: 0.1, wristInFlange_m: [0, 0, 0] } };
    const reach = of(solveAll(small, wanted), "beyond-workspace");
    expect(reach.declared_m).toBe(0.1);
    expect(explainReach(reach)).toBe(
      `The wrist would be ${(reach.distance_m * MILLIMETRES).toFixed(0)} mm from axis 2; the maker declares a reach of 100 mm.`,
    );
  });

  test("a singular posture is reached and said to be one", () => {
    if (robot.family.kind === "general-6r" || robot.family.kind === "spherical-seven") return; // no single joint brings these there
    expect(of(solveAll(robot, wanted), "reached").singular).toBe(false);
    expect(of(solveAll(robot, flangePose(robot.arm, q.with(4, 0))), "reached").singular).toBe(true);
  });

  test("each repair that a check offers really works", () => {
    let offered = 0;
    const away = Math.hypot(wanted.position[0], wanted.position[1]);
    const long = robot.reach_m + 0.05;
    const targets: readonly Pose<"base", "flange">[] = [
      moved(wanted, long / away),
      { ...wanted, position: [long, 0, wanted.position[2]] },
      { ...moved(wanted, 0.15), quaternion: multiply(wanted.quaternion, fromAxisAngle([1, 0, 0], 0.6)) },
    ];
    for (const target of targets) {
      const program: Program = {
        ...emptyProgram(robot.id),
        steps: [
          { id: "a", type: "move", path: "ptp", target: { q: [...q] }, speed: { ratio: 0.2 }, blend_m: 0 },
          {
            id: "b",
            type: "move",
            path: "ptp",
            target: {
              pose: { position: target.position, quaternion: target.quaternion },
              frame: "base",
              tool: "flange",
            },
            speed: { ratio: 0.2 },
            blend_m: 0,
          },
        ],
      };
      const findings = checkProgram(program, robot).verdict.steps[1]!.findings.filter(
        ({ code }) => code.startsWith("reach.") || code === "limits.joint",
      );
      for (const { repairs } of findings) {
        expect(repairs.length).toBeLessThanOrEqual(3);
        for (const repair of repairs) {
          offered++;
          expect(repair.sentence).toMatch(/^(Tilt|Turn|Move|Take).*\d?.*\.$/);
          const step = applyRepair(program, "b", repair).steps[1]!;
          if (step.type !== "move" || !("pose" in step.target)) throw new Error("The repair is no pose.");
          const goal = pose<"base", "flange">([...step.target.pose.position], [...step.target.pose.quaternion]);
          const reach = of(solveAll(robot, goal, { near: q }), "reached");
          const is = flangePose(robot.arm, reach.solutions[0]!.q_rad);
          expect(distance(is.position, goal.position)).toBeLessThan(1e-9);
          expect(angleBetween(is.quaternion, goal.quaternion)).toBeLessThan(1e-8);
        }
      }
    }
    expect(offered).toBeGreaterThan(0);
  });
});

describe("too near", () => {
  test.each([
    ["UR10e: beside axis 1", ur10e, pose<"base", "flange">([0.05, 0, 0.9], fromAxisAngle([0, 1, 0], Math.PI / 2))],
    ["iiwa: the wrist in the shoulder", iiwa, pose<"base", "flange">([0, 0, 0.36 + 0.126 + 0.003], [0, 0, 0, 1])],
  ] as const)("%s", (_, robot, wanted) => {
    const reach = solveAll(robot, wanted);
    if (reach.kind !== "too-near") throw new Error(explainReach(reach));
    expect(reach.inside_m).toBeGreaterThan(0);
    expect(explainReach(reach)).toMatch(
      /^The wrist would be \d+(\.\d)? mm from the shoulder; it cannot come nearer than \d+(\.\d)? mm\.$/,
    );
  });
});

test("the GoFa: the wrist can be brought there, but not so turned", () => {
  const random = seededRandom(3);
  const any = (): number => random() - 0.5;
  let seen = 0;
  for (let k = 0; k < 300 && seen < 5; k++) {
    const axis: [number, number, number] = [any(), any(), any()];
    const length = Math.hypot(...axis);
    const turn = fromAxisAngle([axis[0] / length, axis[1] / length, axis[2] / length], 6 * random());
    const reach = solveAll(gofa, { position: [1.6 * any(), 1.6 * any(), 0.3 + 1.4 * any()], quaternion: turn });
    if (reach.kind !== "not-so-turned") continue;
    seen++;
    expect(reach.short_rad).toBeGreaterThan(0);
    expect(explainReach(reach)).toMatch(/would have to stand \d+\.\d° off the angle they are built at\.$/);
  }
  expect(seen).toBeGreaterThan(0);
});

describe("arms without a closed form", () => {
  const bent = ur10e.arm.joints.map(
    (joint, j): Joint =>
      j === 2
        ? {
            ...joint,
            parentFromJoint: {
              ...joint.parentFromJoint,
              quaternion: multiply(joint.parentFromJoint.quaternion, fromAxisAngle([1, 0, 0], 0.02)),
            },
          }
        : joint,
  );
  const six = robotFromArm({ ...ur10e.arm, name: "bent", joints: bent });
  const five = robotFromArm({ ...ur10e.arm, name: "five", joints: ur10e.arm.joints.slice(0, 5) });
  test("six joints: postures that a search found, each within limits and on the pose, and marked as such", () => {
    expect(six.family.kind).toBe("general");
    const q = START[ur10e.id]!;
    const wanted = flangePose(six.arm, q);
    const reach = solveAll(six, wanted, { near: q });
    if (reach.kind !== "reached") throw new Error(explainReach(reach));
    expect(reach.method).toBe("numeric");
    expect(reach.solutions.length).toBeGreaterThan(2);
    expect([...reach.solutions[0]!.q_rad]).toEqual(q.map(angle => expect.closeTo(angle, 6)));
    for (const { q_rad } of reach.solutions)
      expect(distance(flangePose(six.arm, q_rad).position, wanted.position)).toBeLessThan(1e-9);
  });
  test("five joints: a pose of the arm's own is met, another says how far the nearest is off", () => {
    const wanted = flangePose(five.arm, START[ur10e.id]!.slice(0, 5));
    expect(solveAll(five, wanted)).toMatchObject({ kind: "reached", method: "numeric" });
    const turned = solveAll(five, {
      ...wanted,
      quaternion: multiply(wanted.quaternion, fromAxisAngle([1, 0, 0], 0.5)),
    });
    expect(explainReach(turned)).toMatch(
      /^From 24 starts damped least squares found no posture of five; the nearest: .*\d+.*\.$/,
    );
  });
});
