import { expect, test } from "vitest";
import {
  boxMesh,
  flangePose,
  linkShapes,
  linkSolids,
  ownRobotFile,
  parseRobot,
  robotById,
  robotFromArm,
} from "../index.ts";

const ur = robotById("ur10e")!;

test("T-16 a robot written as a robot file and read again is the same arm, with masses, links and vendor section", () => {
  const links = Array.from({ length: 7 }, (_, i) => ({
    parts: [{ color: "#102030", mesh: boxMesh([0.1, 0.1, 0.1 + i / 64]) }],
  }));
  const file: unknown = JSON.parse(JSON.stringify(ownRobotFile({ ...ur, id: "mine", name: "Mine", links })));
  const answer = parseRobot(file);
  if (answer.kind !== "robot") throw new Error(JSON.stringify(answer.faults));
  const { robot } = answer;
  expect(robot).toMatchObject({ name: "Mine", payload_kg: ur.payload_kg, mass_kg: 33.5, reach_m: ur.reach_m });
  expect(robot.assumptions).toEqual(ur.assumptions);
  expect(robot.vendorSection?.languages).toEqual(ur.vendorSection!.languages);
  expect(robot.masses?.map(({ mass_kg }) => mass_kg)).toEqual(ur.masses?.map(({ mass_kg }) => mass_kg));
  expect(robot.family.kind).toBe(ur.family.kind);
  const q = [0.3, -1.2, 1.4, -0.6, 0.9, 0.2];
  const [own, wanted] = [flangePose(robot.arm, q), flangePose(ur.arm, q)];
  for (let k = 0; k < 3; k++) expect(own.position[k]).toBeCloseTo(wanted.position[k]!, 12);
  expect(linkShapes(robot).map(({ parts }) => parts[0]!.color)).toEqual(Array.from({ length: 7 }, () => "#102030"));
  expect(linkSolids(robot)).toHaveLength(7);
});

test("T-16 the same file is the same robot, another one called alike is not; a library arm brings its languages", () => {
  const plain = robotFromArm(ur.arm, { id: "my arm", name: "My arm" });
  const file = ownRobotFile(plain);
  expect(file.id).toMatch(/^my_arm_[0-9a-f]{8}$/);
  expect(ownRobotFile(plain).id).toBe(file.id);
  expect(ownRobotFile({ ...plain, payload_kg: 3 }).id).not.toBe(file.id);
  const answer = parseRobot(file);
  expect(answer.kind === "robot" && answer.robot.vendorSection?.languages).toEqual(ur.vendorSection!.languages);
  // Written again from what was read, it keeps its name: no hash is put behind a hash.
  expect(answer.kind === "robot" && ownRobotFile(answer.robot).id).toMatch(/^my_arm_[0-9a-f]{8}$/);
});

test("T-16 links and masses that are none are refused with their place", () => {
  const file = ownRobotFile(ur);
  const faults = (more: object): string => {
    const answer = parseRobot({ ...file, ...more });
    return answer.kind === "robot" ? "" : answer.faults.map(({ path, sentence }) => `${path}: ${sentence}`).join(" ");
  };
  expect(faults({ links: [] })).toBe("links: A robot of 6 joints has 7 links, the base first; here it has 0.");
  const bad = { parts: [{ color: "red", positions: "AAAA", indices: "" }] };
  expect(faults({ links: Array.from({ length: 7 }, () => bad) })).toContain("links[0].parts[0].color: A colour is");
  expect(faults({ masses: [{ mass_kg: -1 }] })).toContain("masses: A robot of 6 joints has 6 masses; here it has 1.");
});
