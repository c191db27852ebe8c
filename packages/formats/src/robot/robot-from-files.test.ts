import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { strFromU8, strToU8 } from "fflate";
import { expect, test } from "vitest";
import {
  boxMesh,
  CellCollider,
  flangePose,
  identity,
  linkPoses,
  linkShapes,
  linkSolids,
  pose,
  robotById,
  solveAll,
  transformMesh,
  type Pose,
  type Vector3,
} from "@twincell/core";
import {
  armFromUrdf,
  filesInMemory,
  loadMeshes,
  mayBeRobot,
  readRobot,
  robotFromFiles,
  solidShapes,
  urdfSolids,
  writeDhTable,
  writeStl,
  type UrdfRead,
} from "../index.ts";
import { disk } from "../testing/disk.ts";

const DH = `# convention: standard
# units: mm deg
name a alpha d theta lower upper speed
j1 0 -90 300 0 -170 170 200
j2 250 0 0 0 -120 120 200
j3 0 -90 60 0 -170 170 200
j4 0 90 240 0 -180 180 300
j5 0 -90 40 0 -120 120 300
j6 0 0 80 0 -350 350 400
`;
const joint = (n: number, axis: string, xyz: string): string =>
  `<joint name="j${n}" type="revolute"><parent link="l${n - 1}"/><child link="l${n}"/><origin xyz="${xyz}"/><axis xyz="${axis}"/><limit lower="-2" upper="2" velocity="2" effort="9"/></joint>`;
const link = (n: number): string =>
  `<link name="l${n}"><inertial><mass value="${n + 1}"/><origin xyz="0 0 0.1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial><visual><geometry><mesh filename="package://arm/meshes/l.stl" scale="0.001 0.001 0.001"/></geometry><material name="m${n}"><color rgba="1 0 0 1"/></material></visual></link>`;
const URDF = `<robot name="arm">${[0, 1, 2].map(link).join("")}${joint(1, "0 0 1", "0 0 0.2")}${joint(2, "0 1 0", "0 0 0.3")}</robot>`;
const read = async (path: string, files: Readonly<Record<string, Uint8Array | string>>) => {
  const answer = await robotFromFiles(
    path,
    filesInMemory(
      new Map(Object.entries(files).map(([name, data]) => [name, typeof data === "string" ? strToU8(data) : data])),
    ),
  );
  if (answer.kind !== "robot") throw new Error(answer.sentence);
  return answer;
};

test("T-16 files that are robots are told by their first lines, not by their ending alone", () => {
  const is = (name: string, text: string): boolean => mayBeRobot(name, strToU8(text));
  expect(is("a.urdf", "<robot/>")).toBe(true);
  expect(is("a.json", '{ "format": "twincell.robot", "version": 1 }')).toBe(true);
  expect(is("a.dh.json", '{"convention": "modified"}')).toBe(true);
  expect(is("a.txt", DH)).toBe(true);
  expect(is("a.json", '{ "format": "twincell.cell", "robot": { "file": { "format": "twincell.robot" } } }')).toBe(
    false,
  );
  expect(is("a.txt", ".PROGRAM a()\nMOVE p1\n.END")).toBe(false);
  expect(is("a.csv", "t,x,y,z\n0,0,0,0")).toBe(false);
});

test("T-16 a D-H table whose axes 2 and 3 are not parallel becomes a robot that is solved numerically and reaches its own poses", async () => {
  const { robot, file, notes } = await read("odd.dh.txt", { "odd.dh.txt": DH.replace("j2 250 0", "j2 250 20") });
  expect(file.id).toMatch(/^odd_[0-9a-f]{8}$/);
  expect(robot.family.kind).toBe("general");
  expect(notes.join(" ")).toContain("Joint j1 has no acceleration in the file");
  const q = [0.3, -0.5, 0.7, 0.4, 0.6, -0.3];
  const wanted = flangePose(robot.arm, q);
  const reach = solveAll(robot, wanted, { near: q.map(value => value + 0.1) });
  if (reach.kind !== "reached") throw new Error(reach.kind);
  const own = flangePose(robot.arm, reach.solutions[0]!.q_rad);
  for (let k = 0; k < 3; k++) expect(own.position[k]).toBeCloseTo(wanted.position[k]!, 6);
});

test("T-16 the table of a library arm is that arm: its languages and its home come with it", async () => {
  const gp8 = robotById("yaskawa_gp8")!;
  const { robot } = await read("my gp8.dh.json", { "my gp8.dh.json": writeDhTable(gp8.arm, "modified") });
  expect(robot.id).not.toBe("yaskawa_gp8");
  expect(robot.vendorSection?.languages).toEqual(gp8.vendorSection!.languages);
  expect(robot.home_rad).toEqual(gp8.home_rad);
});

test("T-16, X-04 a URDF brings links, colours, masses and limits; a missing mesh is named and the rest comes", async () => {
  const files = { "arm/package.xml": "<package><name>arm</name></package>", "arm/urdf/arm.urdf": URDF };
  const stl = writeStl(boxMesh([100, 100, 200]));
  const { robot, notes } = await read("arm/urdf/arm.urdf", { ...files, "arm/meshes/l.stl": stl });
  expect(robot.arm.joints.map(({ limits }) => [limits.lower_rad, limits.upper_rad])).toEqual([
    [-2, 2],
    [-2, 2],
  ]);
  expect(robot.masses?.map(({ mass_kg }) => mass_kg)).toEqual([2, 3]);
  expect(linkShapes(robot).map(({ parts }) => [parts.length, parts[0]!.color])).toEqual([
    [1, "#ff0000"],
    [1, "#ff0000"],
    [1, "#ff0000"],
  ]);
  expect(Math.max(...linkSolids(robot)[1]!.mesh.positions)).toBeCloseTo(0.1, 6);
  expect(notes.some(note => note.includes("l.stl"))).toBe(false);
  const bare = await read("arm/urdf/arm.urdf", files);
  expect(bare.robot.links).toBeUndefined();
  expect(bare.notes.some(note => note.includes("l.stl"))).toBe(true);
});

test("T-16 bad robot files are one sentence with the place", async () => {
  const say = async (name: string, text: string): Promise<string> => {
    const answer = await robotFromFiles(name, filesInMemory(new Map([[name, strToU8(text)]])));
    return answer.kind === "robot" ? "" : answer.sentence;
  };
  expect(await say("a.json", '{"format":"twincell.robot","version":1,"id":"a","joints":[]}')).toBe(
    "joints: A robot has 1 to 32 joints; here it has 0.",
  );
  expect(await say("a.json", "{")).toMatch(/^a\.json is not JSON: /);
  expect(await say("a.txt", DH.replace("j3 0", "j3 x"))).not.toBe("");
  expect(strFromU8(strToU8(await say("a.urdf", "<robot name='a'><link name='b'/></robot>")))).toContain(
    "No joint moves",
  );
});

const IRB = fileURLToPath(new URL("../../../../../shared/robots/abb_irb120/robot.urdf", import.meta.url));

test.skipIf(!existsSync(IRB))(
  "X-11 each part collides where its maker's mesh is: contact within ±2 mm of its surface, from five sides",
  async () => {
    const answer = await robotFromFiles(IRB, disk);
    if (answer.kind !== "robot") throw new Error(answer.sentence);
    const { robot } = answer;
    const chain = armFromUrdf((readRobot(IRB, disk) as UrdfRead).robot);
    if (chain.kind !== "chain") throw new Error(chain.sentence);
    // The maker's own meshes of what moves, every triangle, at home. The foot may stand in things.
    const links = Array.from({ length: 7 }, () => identity<"base", "link">());
    linkPoses(robot.arm, robot.home_rad, links);
    const { meshOf } = loadMeshes(solidShapes(chain), IRB, disk);
    const maker = urdfSolids(chain, meshOf)
      .solids.filter(({ link }) => link > 0)
      .map(({ link, mesh }) => transformMesh(mesh, links[link] as Pose));
    const side = 0.01;
    const touches = (centre: Vector3): boolean =>
      new CellCollider(
        {
          worldFromBase: identity(),
          links: linkSolids(robot),
          objects: [{ id: "probe", name: "probe", worldFromObject: pose(centre), mesh: boxMesh([side, side, side]) }],
          allowedPairs: [],
          shapeError_m: 0,
        },
        robot.arm,
      ).collides(Float64Array.from(robot.home_rad));
    for (const [axis, sign] of [
      [0, 1],
      [0, -1],
      [1, 1],
      [1, -1],
      [2, 1],
    ] as const) {
      let extreme: Vector3 = [0, 0, 0];
      let most = -Infinity;
      for (const { positions } of maker)
        for (let i = 0; i < positions.length; i += 3)
          if (sign * positions[i + axis]! > most) {
            most = sign * positions[i + axis]!;
            extreme = [positions[i]!, positions[i + 1]!, positions[i + 2]!];
          }
      const probe = (gap_m: number): Vector3 => {
        const centre: Vector3 = [...extreme];
        centre[axis] += sign * (side / 2 + gap_m);
        return centre;
      };
      expect([axis, sign, touches(probe(0.002)), touches(probe(-0.002))]).toEqual([axis, sign, false, true]);
    }
  },
  60_000,
);
