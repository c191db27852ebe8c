import { existsSync, readdirSync, readFileSync } from "node:fs";
import { describe, expect, test } from "vitest";
import { flangePose, pose, seededRandom, toMatrix, transformPoint } from "@twincell/core";
import { armFromUrdf, meshPlace, readStl, readUrdf, urdfSolids, writeUrdf } from "../index.ts";

const LIMIT = `<limit lower="-1" upper="2" velocity="3" effort="4"/>`;
const joint = (name: string, parent: string, child: string, inside = LIMIT, type = "revolute"): string =>
  `<joint name="${name}" type="${type}"><parent link="${parent}"/><child link="${child}"/>${inside}</joint>`;
const robot = (inside: string): string => `<?xml version="1.0"?>\n<robot name="r">\n${inside}\n</robot>`;
const links = (...names: string[]): string => names.map(name => `<link name="${name}"/>`).join("");

function readRobot(text: string) {
  const answer = readUrdf(text);
  if (answer.kind !== "read") throw new Error(answer.sentence);
  return answer;
}
function chain(text: string, base?: string, tip?: string) {
  const answer = armFromUrdf(readRobot(text).robot, base, tip);
  if (answer.kind !== "chain") throw new Error(answer.sentence);
  return answer;
}

describe("a chain becomes an arm", () => {
  const text = robot(`${links("base_link", "base", "plate", "one", "cover", "two", "tip", "finger")}
    ${joint("base_link-base", "base_link", "base", `<origin xyz="0 0 -1"/>`, "fixed")}
    ${joint("stand", "base_link", "plate", `<origin xyz="0 0 0.5" rpy="0 0 1.5707963267948966"/>`, "fixed")}
    ${joint("j1", "plate", "one", `<origin xyz="0.1 0 0"/><axis xyz="0 0 2"/>${LIMIT}`)}
    ${joint("bolt", "one", "cover", `<origin xyz="0 0 0.2"/>`, "fixed")}
    ${joint("j2", "cover", "two", `<axis xyz="0 -1 0"/>`, "continuous")}
    ${joint("end", "two", "tip", `<origin xyz="0 0 0.3"/>`, "fixed")}
    ${joint("grip", "tip", "finger", `<origin xyz="0 0.05 0"/><axis xyz="1 0 0"/>${LIMIT}`, "prismatic")}`);

  test("fixed joints melt in, axes are unit vectors, limits are kept", () => {
    const { arm } = chain(text, "base_link", "tip");
    expect(arm.joints.map(({ name, axis }) => [name, axis])).toEqual([
      ["j1", [0, 0, 1]],
      ["j2", [0, -1, 0]],
    ]);
    expect(arm.joints[0]!.limits).toEqual({
      lower_rad: -1,
      upper_rad: 2,
      speed_rad_s: 3,
      acceleration_rad_s2: 12,
      torque_Nm: 4,
    });
    const flange = flangePose(arm, [0, 0]);
    [0, 0.1, 1].forEach((v, k) => {
      expect(flange.position[k]).toBeCloseTo(v, 12);
    });
  });

  test("what had to be assumed is said", () => {
    expect(chain(text, "base_link", "tip").assumptions).toEqual([
      "Joint j1 has no acceleration in the file: full speed is assumed to be reached in 0.25 s.",
      "Joint j2 has no limits in the file: ±360° are assumed.",
      "Joint j2 has no speed in the file: 180°/s is assumed.",
      "Joint j2 has no acceleration in the file: full speed is assumed to be reached in 0.25 s.",
      "Joint grip is beside the chain and drawn at 0.",
    ]);
  });

  test("a joint that slides keeps its metres, and what is assumed of it is said in millimetres", () => {
    const { arm, assumptions } = chain(text, "base_link", "finger");
    expect(arm.joints[2]).toMatchObject({
      name: "grip",
      kind: "prismatic",
      axis: [1, 0, 0],
      limits: { lower_rad: -1, upper_rad: 2, speed_rad_s: 3, torque_Nm: 4 },
    });
    const near = flangePose(arm, [0, 0, 0]).position;
    const far = flangePose(arm, [0, 0, 0.25]).position;
    [0, 0.25, 0].forEach((v, k) => {
      expect(far[k]! - near[k]!).toBeCloseTo(v, 12);
    });
    expect(assumptions).not.toContain("Joint grip is beside the chain and drawn at 0.");
    expect(
      chain(robot(links("a", "b") + joint("j", "a", "b", `<axis xyz="0 0 1"/>`, "prismatic"))).assumptions.slice(0, 2),
    ).toEqual([
      "Joint j has no limits in the file: ±1000 mm are assumed.",
      "Joint j has no speed in the file: 250 mm/s is assumed.",
    ]);
    const again = chain(writeUrdf(arm));
    for (let j = 0; j < 3; j++) expect(again.arm.joints[j]!.kind).toBe(arm.joints[j]!.kind);
    flangePose(again.arm, [0.3, -0.2, 0.1]).position.forEach((v, k) => {
      expect(v).toBeCloseTo(flangePose(arm, [0.3, -0.2, 0.1]).position[k]!, 12);
    });
  });

  test("a side link may be the base", () => {
    expect(flangePose(chain(text, "base", "tip").arm, [0, 0]).position[2]).toBeCloseTo(2, 12);
  });

  test("tool0, flange or the longest chain is the tip", () => {
    const named = (tip: string): string =>
      robot(
        links("a", "b", "c", tip) + joint("j", "a", "b") + joint("k", "b", "c") + joint("t", "b", tip, "", "fixed"),
      );
    expect(chain(named("tool0")).tip).toBe("tool0");
    expect(chain(named("flange")).tip).toBe("flange");
    expect(chain(named("other")).tip).toBe("c");
  });

  test.each([
    [text, "base_link", "nowhere", "r has no link nowhere."],
    [text, "base_link", "base", "No joint moves between base_link and base."],
    [
      robot(links("a", "b") + joint("j", "a", "b", `<axis xyz="0 0 1"/>`, "planar")),
      "a",
      "b",
      "Joint j is planar; an arm here has joints that turn or slide.",
    ],
    [
      robot(links("a", "b", "c") + joint("j", "a", "b") + joint("k", "b", "c", `<mimic joint="j"/>`, "prismatic")),
      "a",
      "c",
      "Joint k follows joint j; it has no motion of its own.",
    ],
    [text, "one", "base", "Joint j1 moves between one and the chain to base."],
  ])("refused: another base or tip", (file, base, tip, sentence) => {
    expect(armFromUrdf(readRobot(file).robot, base, tip)).toMatchObject({ kind: "not-understood", sentence });
  });
});

describe("shapes", () => {
  const text = robot(`<material name="orange"><color rgba="1 0.5 0 1"/></material>
    <link name="a"><collision><origin xyz="1 0 0"/><geometry><box size="1 2 3"/></geometry></collision><visual><geometry><sphere radius="9"/></geometry></visual></link>
    <link name="b"><visual><geometry><mesh filename="package://maker/meshes/b.stl" scale="0.001 0.001 0.001"/></geometry><material name="orange"/></visual></link>
    <link name="c"><collision><geometry><cylinder radius="0.5" length="2"/></geometry></collision></link>
    ${joint("j", "a", "b")}${joint("f", "b", "c", `<origin xyz="0 0 5"/>`, "fixed")}`);

  test("ride on the moving link they are bolted to; without a collision shape the drawn one counts", () => {
    const { solids, missing } = urdfSolids(chain(text), () => undefined);
    expect(solids.map(({ link, name }) => [link, name])).toEqual([
      [0, "a"],
      [1, "c"],
    ]);
    expect(missing).toEqual(["package://maker/meshes/b.stl"]);
    expect(Math.max(...solids[1]!.mesh.positions.filter((_, i) => i % 3 === 2))).toBeCloseTo(6, 12);
    const given = urdfSolids(chain(text), () => ({
      positions: Float64Array.of(0, 0, 0, 1000, 0, 0, 0, 1000, 0),
      indices: Uint32Array.of(0, 1, 2),
    }));
    expect(Math.max(...given.solids[1]!.mesh.positions)).toBeCloseTo(1, 12);
  });

  test("colours come with their shape", () => {
    expect(chain(text).shapes.find(({ name }) => name === "b")!.shape.rgba).toEqual([1, 0.5, 0, 1]);
  });

  test.each([
    ["package://maker/meshes/b.stl", { package: "maker", path: "meshes/b.stl" }],
    ["meshes/./x/../b.stl", { path: "meshes/b.stl" }],
    ["meshes\\b.stl", { path: "meshes/b.stl" }],
    ["file:///data/b.stl", { path: "/data/b.stl" }],
    ["../secret", undefined],
    ["package://maker/../other/b.stl", undefined],
    ["package://maker", undefined],
    ["https://x/y", undefined],
    ["", undefined],
  ])("%s is found or left alone", (reference, place) => {
    expect(meshPlace(reference)).toEqual(place);
  });
});

describe("what cannot be read is said in one sentence", () => {
  test.each<[string, string, number?]>([
    ["", "The file is not XML: document must contain a root element.", 1],
    ["<robot", "The file is not XML: document must contain a root element.", 1],
    ["<robot>", "The file is not XML: unclosed tag: robot.", 1],
    ["<html/>", "The file begins with <html>; a robot description begins with <robot>.", 1],
    [robot(""), "The robot has no links.", 2],
    [robot(links("a", "a")), "Links a and a both hang on nothing; a robot has one root.", 2],
    [robot(links("a", "b")), "Links a and b both hang on nothing; a robot has one root.", 2],
    [
      robot(links("a", "b") + joint("j", "a", "b") + joint("k", "b", "a")),
      "Every link is the child of another: the joints run in a loop.",
      2,
    ],
    [
      robot(links("r", "a", "b") + joint("j", "a", "b") + joint("k", "b", "a")),
      "Link a is not connected to the root r: the joints run in a loop.",
    ],
    [
      robot(links("a", "b", "c") + joint("j", "a", "c") + joint("k", "b", "c") + joint("l", "a", "b")),
      "Link c is the child of two joints: chains that close on themselves are not read.",
      3,
    ],
    [
      robot(links("a", "b") + joint("j", "a", "x") + joint("k", "a", "b")),
      "Joint j names the link x, which is not in the file.",
      3,
    ],
    [
      robot(links("a", "b") + joint("j", "a", "b", `<axis xyz="0 0 0"/>`)),
      "The axis of Joint j is (0, 0, 0) and has no direction.",
      3,
    ],
    [
      robot(links("a", "b") + joint("j", "a", "b", `<axis xyz="0 NaN 1"/>`)),
      "The axis of Joint j holds “NaN”, which is not a usable number.",
      3,
    ],
    [
      robot(links("a", "b") + joint("j", "a", "b", `<origin xyz="0 1e999 1"/>`)),
      "An origin of Joint j holds “1e999”, which is not a usable number.",
      3,
    ],
    [
      robot(links("a", "b") + joint("j", "a", "b", `<origin xyz="0 1"/>`)),
      "An origin of Joint j needs 3 numbers, not “0 1”.",
      3,
    ],
    [
      robot(links("a", "b") + joint("j", "a", "b", `<limit lower="2" upper="1"/>`)),
      "The lower limit of Joint j, 2, is above its upper limit, 1.",
      3,
    ],
    [
      robot(links("a", "b") + joint("j", "a", "b", "", "screw")),
      "Joint j has the type “screw”; revolute, continuous, prismatic, fixed, floating, planar are read.",
      3,
    ],
    [
      robot(`<link name="a"><visual><geometry><box size="1 0 1"/></geometry></visual></link>`),
      "The box of Link a has an edge of 0 m.",
      3,
    ],
    [
      robot(`<xacro:include filename="x"/>`),
      "The file is a xacro (it holds <xacro:include>); expand it to a URDF first.",
      3,
    ],
    [
      `<!DOCTYPE r [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;">]><robot name="&b;"/>`,
      "The file defines XML entities of its own, which are not read.",
      1,
    ],
    [`<robot>${"<a>".repeat(100)}`, "Elements are nested more than 64 deep.", 1],
    [`<robot>${"<a/>".repeat(200_001)}`, "The file has more than 200000 elements.", 1],
    ["x".repeat(32_000_001), "The file has 32000001 characters; at most 32000000 are read."],
  ])("case %#", (text, sentence, line) => {
    const answer = readUrdf(text);
    if (answer.kind === "read") throw new Error("read");
    expect(answer.sentence).toBe(sentence);
    if (line !== undefined) expect(answer.line).toBe(line);
  });

  test("damaged files are read or refused, never a fault (3000 seeded cases)", () => {
    const whole = robot(
      links("a", "b", "tool0") +
        joint("j", "a", "b", `<origin xyz="0 0 1" rpy="1 2 3"/><axis xyz="0 0 1"/>${LIMIT}`) +
        joint("k", "b", "tool0", `<mimic joint="j"/>`, "continuous"),
    );
    const random = seededRandom(32);
    const pieces = [
      "<",
      ">",
      '"',
      "&",
      "NaN",
      "1e309",
      "-",
      "/",
      "]]>",
      "<!--",
      "&lt;",
      "\u0000",
      "é",
      '<link name="a"/>',
    ];
    let refused = 0;
    for (let i = 0; i < 3000; i++) {
      let text = whole;
      for (let n = 1 + Math.floor(random() * 3); n > 0; n--) {
        const at = Math.floor(random() * text.length);
        const length = Math.floor(random() * 12);
        text =
          text.slice(0, at) +
          (random() < 0.5 ? pieces[Math.floor(random() * pieces.length)]! : "") +
          text.slice(at + length);
      }
      const answer = readUrdf(text);
      const result = answer.kind === "read" ? armFromUrdf(answer.robot) : answer;
      if (result.kind === "not-understood") {
        refused++;
        expect(result.sentence.length).toBeGreaterThan(10);
      } else for (const { axis } of result.arm.joints) expect(Math.hypot(...axis)).toBeCloseTo(1, 12);
    }
    expect(refused).toBeGreaterThan(1500);
  });
});

const shared = new URL("../../../../../shared/robots/", import.meta.url);
describe.skipIf(!existsSync(shared))(
  "robots of the shared reference data (skipped where it is not beside the checkout)",
  () => {
    interface Reference {
      readonly base_link: string;
      readonly tip_link: string;
      readonly joint_names: readonly string[];
      readonly samples: readonly { q: number[]; T: number[][] }[];
    }
    const ids = existsSync(shared)
      ? readdirSync(shared).filter(id => existsSync(new URL(`${id}/reference_fk.json`, shared)))
      : [];

    test.each(ids)("%s: flange poses agree with pinocchio's", id => {
      const reference = JSON.parse(readFileSync(new URL(`${id}/reference_fk.json`, shared), "utf8")) as Reference;
      const { arm } = chain(
        readFileSync(new URL(`${id}/robot.urdf`, shared), "utf8"),
        reference.base_link,
        reference.tip_link,
      );
      expect(arm.joints.map(({ name }) => name)).toEqual(reference.joint_names);
      expect(reference.samples.length).toBe(200);
      for (const { q, T } of reference.samples) {
        const flange = flangePose(arm, q);
        const rotation = toMatrix(flange.quaternion);
        for (let r = 0; r < 3; r++) {
          expect(Math.abs(flange.position[r]! - T[r]![3]!)).toBeLessThan(1e-9);
          for (let c = 0; c < 3; c++) expect(Math.abs(rotation[3 * r + c]! - T[r]![c]!)).toBeLessThan(1e-9);
        }
      }
    });

    test("the default tip is the reference's, and every package path points at a file", () => {
      for (const id of ids) {
        const reference = JSON.parse(readFileSync(new URL(`${id}/reference_fk.json`, shared), "utf8")) as Reference;
        const { robot: urdf } = readRobot(readFileSync(new URL(`${id}/robot.urdf`, shared), "utf8"));
        const found = armFromUrdf(urdf);
        expect(found.kind === "chain" && found.tip).toBe(reference.tip_link);
        for (const link of urdf.links)
          for (const { geometry } of link.collisions) {
            if (geometry.kind === "mesh")
              expect(existsSync(new URL(`${id}/${meshPlace(geometry.reference)!.path}`, shared))).toBe(true);
          }
      }
    });

    test("the KR 6 R900's collision meshes are read and stand up", () => {
      const id = "kuka_kr6r900sixx";
      const found = chain(readFileSync(new URL(`${id}/robot.urdf`, shared), "utf8"));
      const { solids, missing } = urdfSolids(found, reference => {
        const answer = readStl(readFileSync(new URL(`${id}/${reference}`, shared)));
        return answer.kind === "read" ? answer.mesh : undefined;
      });
      expect(missing).toEqual([]);
      expect(solids.map(({ link }) => link)).toEqual([0, 1, 2, 3, 4, 5, 6]);
      expect(solids.reduce((sum, { mesh }) => sum + mesh.indices.length / 3, 0)).toBeGreaterThan(32_000);
    });

    test("a gripper with mimic joints is read", () => {
      const { robot: gripper } = readRobot(readFileSync(new URL("robotiq_2f85/robot.urdf", shared), "utf8"));
      expect(gripper.joints.filter(({ mimic }) => mimic).length).toBe(5);
    });
  },
);

test("roll, pitch and yaw turn about x, then y, then z of the parent", () => {
  const { arm } = chain(robot(links("a", "b") + joint("j", "a", "b", `<origin rpy="0.3 -0.4 0.5"/>${LIMIT}`)));
  const [roll, pitch, yaw] = [0.3, -0.4, 0.5];
  const point = transformPoint(pose([0, 0, 0], arm.joints[0]!.parentFromJoint.quaternion), [0, 0, 1]);
  expect(point[0]).toBeCloseTo(Math.cos(yaw) * Math.sin(pitch) * Math.cos(roll) + Math.sin(yaw) * Math.sin(roll), 12);
  expect(point[1]).toBeCloseTo(Math.sin(yaw) * Math.sin(pitch) * Math.cos(roll) - Math.cos(yaw) * Math.sin(roll), 12);
  expect(point[2]).toBeCloseTo(Math.cos(pitch) * Math.cos(roll), 12);
});
