import { spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { expect, test } from "vitest";

const root = fileURLToPath(new URL("../../../", import.meta.url));

/** The command as users run it: a process of its own, with its own standard streams. */
function twincell(
  args: readonly string[],
  input = "",
): { readonly code: number; readonly out: string; readonly err: string; readonly lines: () => unknown[] } {
  const run = spawnSync(process.execPath, ["apps/cli/src/main.ts", ...args], { cwd: root, input, encoding: "utf8" });
  return {
    code: run.status ?? -1,
    out: run.stdout,
    err: run.stderr,
    lines: () =>
      run.stdout
        .trim()
        .split("\n")
        .map(line => JSON.parse(line) as unknown),
  };
}
const fixture = (name: string): unknown => JSON.parse(readFileSync(`${root}fixtures/kinematics/${name}`, "utf8"));

test("robots names the RX90L with its numbers, their sources and what was assumed", () => {
  const { code, lines } = twincell(["robots"]);
  expect(code).toBe(0);
  expect(lines()).toContainEqual(
    expect.objectContaining({ id: "staubli_rx90l", family: "ortho-parallel", dof: 6, payload_kg: 3.5, reach_m: 1.185 }),
  );
});

test("robots lists the whole library, with and without --json: id, name, family, dof, payload, reach, source and assumptions", () => {
  const plain = twincell(["robots"]);
  const json = twincell(["robots", "--json"]);
  const robots = plain.lines() as Record<string, unknown>[];
  expect(json.out).toBe(plain.out);
  expect(robots.length).toBeGreaterThanOrEqual(11);
  for (const robot of robots) {
    for (const key of ["id", "name", "family"]) expect(robot[key]).toEqual(expect.stringMatching(/./));
    for (const key of ["dof", "reach_m", "shape_error_m"]) expect(robot[key]).toEqual(expect.any(Number));
    expect(robot.payload_kg === null || Number(robot.payload_kg) > 0).toBe(true);
    expect(Object.keys(robot.source as object).length).toBeGreaterThan(0);
    expect(Array.isArray(robot.assumptions)).toBe(true);
  }
  expect(robots).toContainEqual(
    expect.objectContaining({
      id: "ur10e",
      dof: 6,
      payload_kg: 10,
      mass_kg: 33.5,
      reach_m: 1.3,
      reach_measured_from: "axis-2",
    }),
  );
  expect(robots).toContainEqual(expect.objectContaining({ id: "kuka_lbr_iiwa_14_r820", dof: 7 }));
  expect(robots).toContainEqual(
    expect.objectContaining({ id: "ur5e", vendor: "Universal Robots", family: "three-parallel", payload_kg: 5 }),
  );
  expect(new Set(robots.map(({ vendor }) => vendor)).size).toBeGreaterThanOrEqual(14);
  expect(robots.filter(robot => "made_up_geometry" in robot).map(robot => robot.id)).toEqual(["lola_rl15_placeholder"]);
});

test("robots filters by maker, words, reach and payload; robots of unknown payload come last and are said to be so", () => {
  const ids = (...args: string[]) =>
    (twincell(["robots", ...args]).lines() as { id: string; payload_kg: number | null }[]).map(({ id }) => id);
  expect(ids("--maker", "universal").toSorted()).toContain("ur5e");
  expect(ids("--find", "universal ur5e")).toEqual(["ur5e"]);
  const lifting = twincell(["robots", "--payload", "9", "--reach", "1200"]).lines() as Record<string, number | null>[];
  const firstUnknown = lifting.findIndex(({ payload_kg }) => payload_kg === null);
  expect(firstUnknown).toBeGreaterThan(0);
  expect(lifting.slice(0, firstUnknown).every(({ payload_kg }) => payload_kg! >= 9)).toBe(true);
  expect(lifting.slice(firstUnknown).every(({ payload_kg }) => payload_kg === null)).toBe(true);
  expect(lifting.every(({ reach_m }) => reach_m! >= 1.2)).toBe(true);
  expect(twincell(["robots", "--find", "ur5e", "--text"]).out).toMatch(/^ur5e .*mm {2}5 kg\n$/);
  const none = twincell(["robots", "--maker", "nobody"]);
  expect([none.code, none.out]).toEqual([1, ""]);
});

test("a robot file is enough for fk and ik; a fault in it is named with its place", () => {
  const pose = twincell(["fk", "--robot", "examples/robots/small-arm.json"], '{"q":[0.3,0.2,0.1,0.4,0.7,-0.2]}');
  expect(pose.code).toBe(0);
  const [answer] = twincell(
    ["ik", "--robot", "examples/robots/small-arm.json", "--near", "0.3,0.2,0.1,0.4,0.7,-0.2"],
    pose.out,
  ).lines() as { solutions: number[][] }[];
  answer!.solutions[0]!.forEach((angle, j) => {
    expect(angle).toBeCloseTo([0.3, 0.2, 0.1, 0.4, 0.7, -0.2][j]!, 9);
  });
  const wrong = twincell(["fk", "--robot", "package.json"], "");
  expect(wrong.code).toBe(2);
  expect(wrong.err).toContain(
    'package.json: format: The format of a robot file is "twincell.robot"; here it is nothing.',
  );
});

test("fk answers the reference cases, in the root link and in the vendor's world", () => {
  const { samples } = fixture("staubli_rx90l.forward.json") as { samples: { q: number[]; T: number[][] }[] };
  const input = samples.map(({ q }) => JSON.stringify({ q })).join("\n");
  const poses = twincell(["fk", "--robot", "staubli_rx90l"], input).lines() as { position: number[] }[];
  const fromShoulder = twincell(["fk", "--robot", "staubli_rx90l", "--base", "base"], input).lines() as {
    position: number[];
  }[];
  expect(poses.length).toBe(samples.length);
  samples.forEach(({ T }, i) => {
    T.slice(0, 3).forEach((row, axis) => {
      expect(poses[i]!.position[axis]).toBeCloseTo(row[3]!, 9);
    });
    expect(fromShoulder[i]!.position[2]).toBeCloseTo(T[2]![3]! - 0.42, 9);
  });
});

test("ik --method compare puts one pose through each method; one method alone answers too; another name is refused", () => {
  const pose = twincell(["fk", "--robot", "staubli_rx90l"], '{"q":[0.3,-1,1.2,0.4,0.7,-0.2]}').out;
  const near = ["--near", "0.2,-1.1,1.3,0.3,0.6,-0.1"];
  interface Tried {
    method: string;
    q: number[];
    position_error_m: number;
    iterations: number;
    jump_rad: number;
    took_ms: number;
    sentence: string;
  }
  const [all] = twincell(["ik", "--robot", "staubli_rx90l", "--method", "compare", ...near], pose).lines() as {
    tried: Tried[];
  }[];
  expect(all!.tried.map(({ method }) => method)).toEqual(["closed", "dls", "fabrik", "gradient"]);
  for (const { position_error_m, jump_rad, took_ms, sentence } of all!.tried) {
    expect(position_error_m).toBeLessThan(5e-3);
    expect(jump_rad).toBeLessThan(1);
    expect(took_ms).toBeGreaterThan(0);
    expect(sentence).toMatch(/\.$/);
  }
  const [alone] = twincell(["ik", "--robot", "staubli_rx90l", "--method", "dls", ...near], pose).lines() as {
    tried: Tried[];
  }[];
  expect(alone!.tried).toHaveLength(1);
  alone!.tried[0]!.q.forEach((angle, j) => {
    expect(angle).toBeCloseTo([0.3, -1, 1.2, 0.4, 0.7, -0.2][j]!, 8);
  });
  const wrong = twincell(["ik", "--robot", "staubli_rx90l", "--method", "magic"], pose);
  expect([wrong.code, wrong.err]).toEqual([
    2,
    'twincell: There is no method "magic". Methods: closed, dls, fabrik, gradient, compare.\n',
  ]);
});

test("ik gives every branch in (−π, π], whole turns with --within-limits, the nearest first with --near", () => {
  const pose = twincell(["fk", "--robot", "staubli_rx90l"], '{"q":[0.3,-1,1.2,0.4,0.7,-0.2]}').out;
  const [all] = twincell(["ik", "--robot", "staubli_rx90l"], pose).lines() as {
    solutions: number[][];
    reach: { kind: string };
  }[];
  expect(all!.solutions.length).toBe(8);
  expect(all!.solutions.flat().every(angle => angle > -Math.PI && angle <= Math.PI)).toBe(true);
  expect(all!.reach.kind).toBe("reached");
  const [near] = twincell(
    ["ik", "--robot", "staubli_rx90l", "--within-limits", "--near", "0.3,-1,1.2,0.4,0.7,-0.2"],
    pose,
  ).lines() as { solutions: number[][] }[];
  expect(near!.solutions.length).toBeGreaterThan(8);
  near!.solutions[0]!.forEach((angle, joint) => {
    expect(angle).toBeCloseTo([0.3, -1, 1.2, 0.4, 0.7, -0.2][joint]!, 9);
  });
});

test("ik --elbow turns the elbow of seven joints about the line from shoulder to wrist; another arm has none", () => {
  const q = [0.3, 0.7, -0.4, -1.2, 0.5, 0.9, 0.2];
  const iiwa = ["--robot", "kuka_lbr_iiwa_14_r820"];
  const pose = twincell(["fk", ...iiwa], JSON.stringify({ q })).out;
  for (const elbow of ["0", "-1.1", "2"]) {
    const [answer] = twincell(["ik", ...iiwa, "--elbow", elbow], pose).lines() as { solutions: number[][] }[];
    expect(answer!.solutions).toHaveLength(8);
    const back = twincell(
      ["fk", ...iiwa],
      answer!.solutions.map(solution => JSON.stringify({ q: solution })).join("\n"),
    ).lines() as { position: number[] }[];
    const wanted = JSON.parse(pose) as { position: number[] };
    for (const { position } of back)
      position.forEach((value, axis) => {
        expect(value).toBeCloseTo(wanted.position[axis]!, 9);
      });
  }
  expect(twincell(["ik", "--robot", "ur10e", "--elbow", "0"], pose)).toMatchObject({
    code: 2,
    err: expect.stringContaining("has no elbow angle") as string,
  });
});

test("a pose out of reach is an answer with its measure, not a failure", () => {
  const { code, lines } = twincell(["ik", "--robot", "staubli_rx90l"], '{"position":[3,0,1],"quaternion":[0,0,0,1]}');
  expect(code).toBe(0);
  expect(lines()[0]).toMatchObject({ solutions: [], reach: { kind: "too-far", reach_m: 1.1 } });
});

test.each([
  [["fk", "--robot", "staubli_rx90l"], '{"q":[0,0,0,0,0,0]}\n{"q":[1]}', "Line 2"],
  [["fk", "--robot", "staubli_rx90l"], "nonsense", "Line 1 is not JSON"],
  [["fk", "--robot", "staubli_rx90l"], '{"q":[0,0,0,0,null,0]}', "joint 5"],
  [["fk", "--robot", "nobody"], "", "nobody"],
  [["fk"], "", "--robot is missing"],
  [["ik", "--robot", "staubli_rx90l"], '{"position":[0,0,1],"quaternion":[0,0,0,2]}', "length 2"],
  [["ik", "--robot", "staubli_rx90l", "--near", "1,2"], "", "--near wants 6"],
  [["ik", "--robot", "staubli_rx90l", "--speed", "1"], "", "speed"],
  [["fly"], "", "no command"],
])("wrong use ends with 2 and one sentence: %j", (args, input, says) => {
  const { code, err, out } = twincell(args, input);
  expect(code).toBe(2);
  expect(err).toContain(says);
  expect(err.trim().split("\n").length).toBe(1);
  expect(out.includes("NaN")).toBe(false);
});
