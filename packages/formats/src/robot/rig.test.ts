import {
  boxMesh,
  compose,
  cylinderMesh,
  featureEdges,
  flangePose,
  fromAxisAngle,
  inverse,
  linkPoses,
  mergeMeshes,
  pose,
  SHARP_RAD,
  surfaceFeatureAt,
  transformMesh,
  transformPoint,
  type Pose,
  type Vector3,
} from "@twincell/core";
import { expect, test } from "vitest";
import { filesInMemory, robotFromFiles, robotFromRig, urdfFolder, type Rig, type RigPart } from "../index.ts";

/** A two-axis arm as a drawing has it: pivots at (400, 100, 300) upright and (400, 100, 700) along y [mm]. */
const SHOULDER: Vector3 = [0.4, 0.1, 0.3];
const ELBOW: Vector3 = [0.4, 0.1, 0.7];
const at = (position: Vector3): Pose => pose(position);
const lying = fromAxisAngle([1, 0, 0], Math.PI / 2);
const PARTS: readonly RigPart[] = [
  { name: "Foot", color: "#335577", mesh: transformMesh(boxMesh([0.2, 0.2, 0.3]), at([0.4, 0.1, 0.15])), link: 0 },
  { name: "Column", color: "#cc5500", mesh: transformMesh(cylinderMesh(0.05, 0.4, 48), at([0.4, 0.1, 0.5])), link: 1 },
  {
    name: "Boom",
    color: "#cc5500",
    mesh: mergeMeshes([
      { mesh: cylinderMesh(0.06, 0.1, 48), pose: pose(ELBOW, lying) },
      { mesh: boxMesh([0.3, 0.06, 0.06]), pose: at([0.6, 0.1, 0.7]) },
    ]),
    link: 2,
  },
];
/** What a click on a part finds. */
function picked(part: RigPart, point: Vector3) {
  const found = surfaceFeatureAt(featureEdges(part.mesh, SHARP_RAD), point, 0.005);
  if (found?.kind !== "cylinder") throw new Error(`${part.name}: ${found?.kind}`);
  return { through_m: found.center_m, axis: found.axis };
}
const RIG: Rig = {
  name: "Bench arm",
  parts: PARTS,
  joints: [
    { name: "turn", kind: "revolute", ...picked(PARTS[1]!, [0.45, 0.1, 0.5]), lower: -2, upper: 2.5, speed: 3 },
    { name: "lift", kind: "revolute", ...picked(PARTS[2]!, [0.4, 0.12, 0.76]), lower: -1, upper: 1.2, speed: 2 },
  ],
  flange: { at_m: [0.75, 0.1, 0.7], axis: [1, 0, 0] },
  density_kgm3: 2700,
};
const rigged = async (rig: Rig) => {
  const answer = await robotFromRig(rig);
  if (answer.kind !== "robot") throw new Error(answer.sentence);
  return answer;
};

test("T-52, N-05 picked shafts are the joints: pivots are those of the drawing, each link carries the next, the parts stay where they stood at 0", async () => {
  const { robot, worldFromBase } = await rigged(RIG);
  expect(robot.arm.joints.map(({ name, axis }) => [name, ...axis])).toEqual([
    ["turn", 0, 0, 1],
    ["lift", 0, 1, 0],
  ]);
  const links = [pose<"base", "link">(), pose<"base", "link">(), pose<"base", "link">()];
  linkPoses(robot.arm, [0, 0], links);
  const [, turn, lift] = links.map(each => compose(worldFromBase as Pose, each as Pose));
  // Only the line of an axis counts; along it a pivot may lie anywhere.
  expect(turn!.position[0]).toBeCloseTo(SHOULDER[0], 6);
  expect(turn!.position[1]).toBeCloseTo(SHOULDER[1], 6);
  expect(lift!.position[0]).toBeCloseTo(ELBOW[0], 6);
  expect(lift!.position[2]).toBeCloseTo(ELBOW[2], 6);
  expect(worldFromBase.position.map(value => Number(value.toFixed(6)))).toEqual([0.4, 0.1, 0]);
  const flange = (q: readonly number[]): Vector3 =>
    transformPoint(compose(worldFromBase as Pose, flangePose(robot.arm, q) as Pose), [0, 0, 0]);
  expect(flange([0, 0]).map(value => Number(value.toFixed(6)))).toEqual([0.75, 0.1, 0.7]);
  // A quarter turn of the first axis takes the boom to y; half of the right angle down by the second.
  expect(flange([Math.PI / 2, 0]).map(value => Number(value.toFixed(6)))).toEqual([0.4, 0.45, 0.7]);
  expect(flange([0, 0.5])[2]).toBeCloseTo(0.7 - 0.35 * Math.sin(0.5), 6);
  // Every link is drawn where its part stood.
  for (const [link, part] of PARTS.entries()) {
    const drawn = robot.links![link]!.parts[0]!;
    const world = transformMesh(drawn.mesh, compose(worldFromBase as Pose, links[link]! as Pose));
    world.positions.forEach((value, i) => expect(value).toBeCloseTo(part.mesh.positions[i]!, 6));
    expect(drawn.color).toBe(part.color);
  }
});

test("T-52 another mesh on a link leaves every pivot and the flange where they are", async () => {
  const before = await rigged(RIG);
  const coarse = transformMesh(boxMesh([0.08, 0.08, 0.4]), at([0.4, 0.1, 0.5]));
  const after = await rigged({
    ...RIG,
    parts: PARTS.map(part => (part.name === "Column" ? { ...part, mesh: coarse } : part)),
  });
  for (const q of [
    [0, 0],
    [1.1, -0.7],
  ])
    expect(flangePose(after.robot.arm, q)).toEqual(flangePose(before.robot.arm, q));
});

test("masses and inertias are those of solids: a column of 2700 kg/m³ as the formula of the prism says", async () => {
  const { robot } = await rigged(RIG);
  const [column] = robot.masses!;
  const area = 48 * 0.5 * 0.05 ** 2 * Math.sin((2 * Math.PI) / 48);
  expect(column!.mass_kg).toBeCloseTo(2700 * area * 0.4, 9);
  // The polar moment of a regular polygon: A r² (2 + cos 2π/n) / 6.
  const polar = (2700 * 0.4 * area * 0.05 ** 2 * (2 + Math.cos((2 * Math.PI) / 48))) / 6;
  expect(column!.inertia_kgm2![2]).toBeCloseTo(polar, 9);
  expect(column!.inertia_kgm2![0]).toBeCloseTo(polar / 2 + (column!.mass_kg * 0.16) / 12, 9);
});

test("N-05 as a URDF and read again it is the same arm with limits, masses, inertias, shapes and colours", async () => {
  const { robot } = await rigged(RIG);
  const { name, files } = urdfFolder(robot);
  expect(name).toBe("bench_arm");
  const bytes = (content: string | Uint8Array): Uint8Array =>
    typeof content === "string" ? new TextEncoder().encode(content) : content;
  const source = filesInMemory(new Map(files.map(({ path, content }) => [path, bytes(content)])));
  const back = await robotFromFiles("bench_arm/urdf/bench_arm.urdf", source);
  if (back.kind !== "robot") throw new Error(back.sentence);
  const q = [0.7, -0.4];
  const gap = compose(inverse(flangePose(robot.arm, q)), flangePose(back.robot.arm, q));
  expect(Math.hypot(...gap.position)).toBeLessThan(1e-12);
  expect(back.robot.arm.joints.map(({ limits }) => [limits.lower_rad, limits.upper_rad, limits.speed_rad_s])).toEqual([
    [-2, 2.5, 3],
    [-1, 1.2, 2],
  ]);
  back.robot.masses!.forEach((mass, i) => {
    expect(mass.mass_kg).toBeCloseTo(robot.masses![i]!.mass_kg, 12);
    mass.inertia_kgm2!.forEach((value, k) => expect(value).toBeCloseTo(robot.masses![i]!.inertia_kgm2![k]!, 12));
  });
  expect(back.robot.links!.map(({ parts }) => parts.map(({ color }) => color))).toEqual([
    ["#335577"],
    ["#cc5500"],
    ["#cc5500"],
  ]);
});

test("a sliding axis slides; an open part weighs as its box, and a link without parts leaves masses out, each said", async () => {
  const slide = await rigged({
    ...RIG,
    joints: [{ ...RIG.joints[0]!, kind: "prismatic", lower: 0, upper: 0.3, speed: 0.5 }, RIG.joints[1]!],
  });
  const z = (q: readonly number[]): number => flangePose(slide.robot.arm, q).position[2];
  expect(z([0.2, 0]) - z([0, 0])).toBeCloseTo(0.2, 9);
  const sheet = { ...PARTS[1]!, mesh: { ...PARTS[1]!.mesh, indices: PARTS[1]!.mesh.indices.slice(0, -3) } };
  const open = await rigged({ ...RIG, parts: [PARTS[0]!, sheet, PARTS[2]!] });
  expect(open.notes).toContain("Column is not closed: it weighs as much as the box around it.");
  expect(open.robot.masses![0]!.mass_kg).toBeCloseTo(2700 * 0.1 * 0.1 * 0.4, 3);
  const empty = await rigged({ ...RIG, parts: [PARTS[0]!, PARTS[2]!] });
  expect(empty.robot.masses).toBeUndefined();
  expect(empty.notes).toContain("Link 1 has no part: the robot has no masses, and torques are not computed.");
});

test("what is no robot is refused in one sentence", async () => {
  const says = async (rig: Rig): Promise<string> => {
    const answer = await robotFromRig(rig);
    return answer.kind === "robot" ? "a robot" : answer.sentence;
  };
  expect(await says({ ...RIG, joints: [] })).toContain("at least one axis");
  expect(await says({ ...RIG, parts: [] })).toBe("A robot has at least one part.");
  const [first, second] = RIG.joints as [Rig["joints"][0], Rig["joints"][0]];
  expect(await says({ ...RIG, joints: [first, { ...second, lower: 2 }] })).toBe(
    "The lower limit of joint 2 is not below its upper one.",
  );
  expect(await says({ ...RIG, joints: [first, { ...second, speed: 0 }] })).toBe("The speed of joint 2 is not above 0.");
  expect(await says({ ...RIG, joints: [first, { ...second, axis: [0, 0, 0] }] })).toBe(
    "The axis of joint 2 has no direction.",
  );
  expect(await says({ ...RIG, parts: [{ ...PARTS[0]!, link: 3 }] })).toBe(
    "Foot belongs to link 3, but the last link is 2.",
  );
});
