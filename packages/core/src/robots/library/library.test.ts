import { readdirSync, readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import {
  compose,
  distance,
  flangePose,
  fromMatrix,
  inverse,
  LIBRARY,
  linkPoses,
  identity,
  orthoParallelFlange,
  orthoParallelFromArm,
  robotById,
  seededRandom,
  angleBetween,
  wrapAngle,
  type Pose,
  type Robot,
} from "../../index.ts";

const here = new URL("./", import.meta.url);
/** Witness: pinocchio, cross-checked with yourdfpy and MuJoCo. Units m, rad. */
interface Forward {
  limits_lower: number[];
  limits_upper: number[];
  velocity_limit: number[];
  joint_names: string[];
  tip_link: string;
  base_link: string;
  samples: Case[];
  near_singular: Case[];
}
interface Case {
  q: number[];
  T: number[][];
  vendor_pose?: { X: number; Y: number; Z: number };
}
const forwardOf = (id: string): Forward =>
  JSON.parse(readFileSync(new URL(`../../../../../fixtures/kinematics/${id}.forward.json`, here), "utf8")) as Forward;

const poseOf = (T: number[][]): Pose<"base", "flange"> => ({
  position: [T[0]![3]!, T[1]![3]!, T[2]![3]!],
  quaternion: fromMatrix(T.flatMap(row => row.slice(0, 3)).slice(0, 9)),
});
function gap(got: Pose, wanted: Pose): number {
  const sign = Math.sign(got.quaternion.reduce((sum, value, i) => sum + value * wanted.quaternion[i]!, 0));
  return Math.max(
    ...got.position.map((value, i) => Math.abs(value - wanted.position[i]!)),
    ...got.quaternion.map((value, i) => Math.abs(value - sign * wanted.quaternion[i]!)),
  );
}

describe.each(LIBRARY.map(robot => [robot.id, robot] as const))("%s", (id, robot) => {
  const wanted = forwardOf(id);

  test("forward kinematics meets every reference case to 1e-9, in the root and in the vendor's world", () => {
    expect(wanted.samples.length).toBe(200);
    const vendorFromBase = inverse(robot.baseFromVendorWorld);
    for (const { q, T, vendor_pose } of [...wanted.samples, ...wanted.near_singular]) {
      const got = flangePose(robot.arm, q);
      expect(gap(got, poseOf(T))).toBeLessThan(1e-9);
      const inVendor_m = compose(vendorFromBase, got).position;
      if (vendor_pose)
        [vendor_pose.X, vendor_pose.Y, vendor_pose.Z].forEach((mm, k) => {
          expect(Math.abs(inVendor_m[k]! - mm / 1000)).toBeLessThan(2e-9);
        });
    }
  });

  test("names, limits and speeds are those of the robot file", () => {
    const { joints } = robot.arm;
    expect(joints.map(({ name }) => name)).toEqual(wanted.joint_names);
    expect([robot.frames.base, robot.frames.tip]).toEqual([wanted.base_link, wanted.tip_link]);
    joints.forEach(({ limits }, j) => {
      expect(limits.lower_rad).toBeCloseTo(wanted.limits_lower[j]!, 7);
      expect(limits.upper_rad).toBeCloseTo(wanted.limits_upper[j]!, 7);
      expect(limits.speed_rad_s).toBeCloseTo(wanted.velocity_limit[j]!, 7);
    });
  });

  test("home lies inside the limits and every number names its source", () => {
    expect(robot.home_rad.length).toBe(robot.arm.joints.length);
    robot.arm.joints.forEach(({ limits }, j) => {
      expect(robot.home_rad[j]).toBeGreaterThan(limits.lower_rad);
      expect(robot.home_rad[j]).toBeLessThan(limits.upper_rad);
    });
    const named = Object.keys(robot.sources).join(" ");
    for (const word of ["lengths", "limits", "speed", "reach"])
      if (id !== "staubli_rx90l") expect(named).toContain(word);
    expect(Object.values(robot.sources).every(sentence => sentence.endsWith("."))).toBe(true);
    expect(robot.assumptions.every(sentence => sentence.endsWith("."))).toBe(true);
    expect(robot.masses === undefined || robot.masses.length === robot.arm.joints.length).toBe(true);
  });

  test("is plain data: written as JSON and read again it computes the same", () => {
    const { arm } = JSON.parse(JSON.stringify(robot)) as Robot;
    for (const { q } of wanted.near_singular) expect(gap(flangePose(arm, q), flangePose(robot.arm, q))).toBe(0);
  });
});

test("the seven lengths, zeros and senses in the files are those the axes give", () => {
  const random = seededRandom(3);
  let compared = 0;
  for (const { arm, family } of LIBRARY) {
    const derived = orthoParallelFromArm(arm);
    expect(family.kind === "ortho-parallel").toBe(derived !== null);
    if (family.kind !== "ortho-parallel" || derived === null) continue;
    compared++;
    for (const key of ["a1_m", "a2_m", "b_m", "c1_m", "c2_m", "c3_m", "c4_m"] as const)
      expect(derived[key]).toBeCloseTo(family[key], 12);
    family.offsets_rad.forEach((offset, j) => {
      expect(wrapAngle(derived.offsets_rad[j]! - offset)).toBeCloseTo(0, 12);
    });
    expect(derived.signs).toEqual(family.signs);
    for (let n = 0; n < 50; n++) {
      const q = Float64Array.from({ length: 6 }, () => 6 * (random() - 0.5));
      const a = flangePose(arm, q);
      const b = orthoParallelFlange(family, q);
      expect(distance(a.position, b.position)).toBeLessThan(1e-9);
      expect(angleBetween(a.quaternion, b.quaternion)).toBeLessThan(1e-9);
    }
  }
  expect(compared).toBe(12);
});

test("every data file of the folder is in the library, under an id of its own", () => {
  const files = readdirSync(here).filter(
    name => name.endsWith(".ts") && !name.endsWith(".test.ts") && !["index.ts", "write.ts"].includes(name),
  );
  expect(files.length).toBe(LIBRARY.length);
  expect(new Set(LIBRARY.map(({ id }) => id)).size).toBe(LIBRARY.length);
});

test("L-10 X-17 links hang from the base one after the other: n + 1 of them, and turning a joint moves only what comes after it", () => {
  for (const { arm, home_rad } of LIBRARY) {
    const n = arm.joints.length;
    const links = (q: ArrayLike<number>): Pose<"base", "link">[] => {
      const out = Array.from({ length: n + 1 }, () => identity<"base", "link">());
      linkPoses(arm, q, out);
      return out;
    };
    const before = links(home_rad);
    expect(before.length).toBe(n + 1);
    for (let joint = 0; joint < n; joint++) {
      const after = links(home_rad.map((angle, j) => (j === joint ? angle + 0.3 : angle)));
      after.forEach((pose, link) => {
        expect(gap(pose, before[link]!) < 1e-12).toBe(link <= joint);
      });
    }
  }
});

test("L-10 the RL15's link frames stand like the world at zero", () => {
  const { arm } = rl15();
  const links = Array.from({ length: 7 }, () => identity<"base", "link">());
  linkPoses(arm, [0, 0, 0, 0, 0, 0], links);
  for (const { quaternion } of links) expect(quaternion).toEqual([0, 0, 0, 1]);
});

const rl15 = (): Robot => robotById("lola_rl15_placeholder")!;

test("L-18 G-02 RL15: masses, motors, gears and inertias are Table A2's, and motor torque times gear is the printed joint torque", () => {
  const { arm, masses } = rl15();
  expect(masses?.map(({ mass_kg }) => mass_kg)).toEqual([347.95, 75.17, 82.34, 46.3, 2.37, 0.9]);
  expect(arm.joints.map(({ drive }) => drive?.motorTorque_Nm)).toEqual([17.8, 38.6, 17.8, 3.47, 3.47, 3.47]);
  expect(arm.joints.map(({ drive }) => drive?.gear)).toEqual([120, 119, 119, 133.4, 219.4, 53.3]);
  expect(arm.joints.map(({ drive }) => drive?.rotorInertia_kgm2)).toEqual([
    0.0042, 0.009, 0.009, 0.0008, 0.001, 0.0007,
  ]);
  [2136, 4593.4, 2118.2, 462.9, 761.32, 184.95].forEach((printed, j) => {
    expect(Math.abs(arm.joints[j]!.limits.torque_Nm! - printed)).toBeLessThan(0.0021);
  });
});

test("L-19 RL15: joint ranges are Table A3's", () => {
  const deg = rl15().arm.joints.map(({ limits }) =>
    [limits.lower_rad, limits.upper_rad].map(angle => Math.round(((angle * 180) / Math.PI) * 1e9) / 1e9),
  );
  expect(deg).toEqual([
    [-150, 150],
    [-120, 80],
    [-73, 73],
    [-250, 250],
    [-110, 110],
    [-200, 200],
  ]);
});

test("L-20 G-06 RL15: joint speeds are motor speed over gear, and the file says that this reading is an inference", () => {
  [175, 141.18, 176.47, 152.92, 92.98, 382.74].forEach((wanted, j) => {
    expect(Math.abs((rl15().arm.joints[j]!.limits.speed_rad_s * 180) / Math.PI - wanted)).toBeLessThan(0.005);
  });
  expect(rl15().assumptions.some(sentence => sentence.includes("read as speeds of the motors"))).toBe(true);
});

test("L-21 the RL15's made-up geometry is said in its name, its sources and its assumptions", () => {
  const robot = rl15();
  expect(robot.madeUpGeometry).toBe(true);
  expect(robot.name).toContain("stand-in");
  expect(robot.assumptions[0]).toContain("made up");
  expect(LIBRARY.filter(({ madeUpGeometry }) => madeUpGeometry === true)).toEqual([robot]);
});

test("the joints of the UR10e turn by ±360°, the elbow by the ±180° of the vendor's own file, not the ±360° that X-03 asks for", () => {
  const deg = robotById("ur10e")!.arm.joints.map(({ limits }) => Math.round((limits.upper_rad * 180) / Math.PI));
  expect(deg).toEqual([360, 360, 180, 360, 360, 360]);
  robotById("ur10e")!.arm.joints.forEach(({ limits }) => {
    expect(limits.lower_rad).toBe(-limits.upper_rad);
  });
});

test("X-09 the UR10e weighs 33.5 kg and carries 10", () => {
  const robot = robotById("ur10e")!;
  expect([robot.mass_kg, robot.payload_kg]).toEqual([33.5, 10]);
  expect(robot.masses!.reduce((sum, { mass_kg }) => sum + mass_kg, 0)).toBeCloseTo(29.104, 9);
});
