import { readFileSync } from "node:fs";
import {
  addCatalogue,
  catalogueRobots,
  compose,
  emptyProgram,
  flangePose,
  inverse,
  millimetres,
  parseRobot,
  pose,
  robotById,
  toMatrix,
  withBranches,
  type Dialect,
  type Executed,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import { describe, expect, test } from "vitest";
import { DIALECTS, dialectById, proveText, runnableFile } from "./index.ts";

addCatalogue(CATALOGUE);
const fixture = (path: string): unknown =>
  JSON.parse(readFileSync(new URL(`../../../fixtures/${path}`, import.meta.url), "utf8"));

function fromFile(name: string): Robot {
  const answer = parseRobot(fixture(`robots/${name}.json`));
  if (answer.kind !== "robot") throw new Error(answer.faults[0]!.sentence);
  return answer.robot;
}
const FILES = ["ur5e", "irb2400", "gp12", "kr16", "m10id", "tx2-90l"].map(fromFile);
const CATALOGUED = catalogueRobots().filter(({ vendorSection }) => vendorSection !== undefined);

interface Sample {
  readonly axes_deg: readonly number[];
  readonly flange_mm: readonly number[];
  readonly rotation: readonly number[];
}
const GOLDEN = (fixture("vendor/axes.json") as { readonly robots: Readonly<Record<string, readonly Sample[]>> }).robots;

const move = (id: string, path: MoveStep["path"], target: MoveStep["target"]): MoveStep => ({
  id,
  type: "move",
  path,
  target,
  speed: path === "ptp" ? { ratio: 0.5 } : { mps: 0.2 },
  blend_m: 0,
});

/** Two postures by their joints, a pose in between, and a line: at the arm's own home, so that every arm reaches it. */
function lap(robot: Robot): Program {
  const { home_rad } = robot;
  const turned = home_rad.map((q, i) => q + [0.3, 0.12, -0.1, 0.2, -0.15, 0.4][i]!);
  const at = flangePose(robot.arm, turned) as Pose as Pose<"base", "tcp">;
  const near = (dz: number) => ({
    pose: compose(pose<"frame", "base">([0, 0, dz]), at),
    frame: "world",
    tool: "flange",
  });
  return {
    ...emptyProgram(robot.id, "Lap"),
    steps: [
      move("home", "ptp", { q: home_rad }),
      move("turned", "ptp", { q: turned }),
      move("above", "ptp", near(0.02)),
      move("down", "lin", near(-0.01)),
      move("back", "ptp", { q: home_rad }),
    ],
  };
}

function exported(dialect: Dialect, robot: Robot, program: Program) {
  const emitted = dialect.emit(program, robot);
  if (emitted.kind === "cannot") throw new Error(`${emitted.step}: ${emitted.sentence}`);
  return { emitted, file: runnableFile(dialect, emitted.files)! };
}

describe.each([
  ["files", FILES],
  ["catalogue", CATALOGUED],
] as const)("robots of %s, by their vendor sections alone", (_, robots) => {
  test.each(robots.map(robot => [robot.id, robot] as const))(
    "%s is exported, executed equal to its plan, and read back to the same motions",
    (_id, robot) => {
      const languages = robot.vendorSection!.languages;
      expect(languages.length).toBeGreaterThan(0);
      for (const id of languages) {
        const dialect = dialectById(id)!;
        const program = withBranches(lap(robot), robot, { where: "needed" });
        const { file } = exported(dialect, robot, program);
        const proof = proveText(dialect, file, program, robot);
        expect(proof.kind === "proven" ? "" : proof.sentence).toBe("");
        const parsed = dialect.parse(file.text, robot);
        expect(parsed.kind === "parsed" ? "" : parsed.faults[0]!.sentence).toBe("");
        if (parsed.kind !== "parsed") continue;
        const again = proveText(dialect, file, parsed.program, robot);
        expect(again.kind === "proven" ? "" : again.sentence).toBe("");
        expect(parsed.program.steps.filter(({ type }) => type === "move").length).toBe(5);
      }
    },
  );

  test("no other language takes them", () => {
    for (const robot of robots)
      expect(
        DIALECTS.filter(
          ({ id }) => id !== "l-irl" && dialectById(id)!.emit(emptyProgram(robot.id), robot).kind === "emitted",
        ).map(({ id }) => id),
        robot.id,
      ).toEqual(robot.vendorSection!.languages);
  });
});

/** Every move of a run. */
function movesOf(run: Iterator<Executed, void>): MoveStep[] {
  const moves: MoveStep[] = [];
  for (let next = run.next(); next.done !== true; next = run.next())
    if (next.value.step?.type === "move") moves.push(next.value.step);
  return moves;
}

/** One joint motion to axis values as the controller's own text says it. */
const TEXTS: Readonly<Record<string, (a: readonly number[]) => string>> = {
  krl: a => `DEF GOLDEN()\nPTP {A1 ${a[0]!},A2 ${a[1]!},A3 ${a[2]!},A4 ${a[3]!},A5 ${a[4]!},A6 ${a[5]!}}\nEND\n`,
  rapid: a =>
    `MODULE Golden\nPROC main()\nMoveAbsJ [[${a.join(",")}],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nENDPROC\nENDMODULE\n`,
  urscript: a => `def golden():\n  movej([${a.map(value => `d2r(${value})`).join(", ")}])\nend\n`,
  "kawasaki-as": a => `.PROGRAM golden()\nJMOVE #[${a.join(",")}]\n.END\n`,
  "melfa-basic": a => `J1=(${a.join(",")})\nMov J1\nEnd\nJ1=(${a.join(",")})\n`,
  "fanuc-ls": a =>
    `/PROG  GOLDEN\n/MN\n   1:  J P[1] 10% FINE    ;\n/POS\nP[1]{\n   GP1:\n\tUF : 0, UT : 1,\n\tJ1= ${a[0]!} deg, J2= ${a[1]!} deg, J3= ${a[2]!} deg,\n\tJ4= ${a[3]!} deg, J5= ${a[4]!} deg, J6= ${a[5]!} deg\n};\n/END\n`,
};

describe("axis values in texts, by the makers' drawings (fixtures/vendor/axes.py)", () => {
  const cases = Object.entries(GOLDEN).flatMap(([id, samples]) => {
    const robot = robotById(id)!;
    const language = robot.vendorSection!.languages[0]!;
    const text = TEXTS[language];
    return text === undefined ? [] : [{ id, robot, language, text, samples }];
  });
  test.each(cases)(
    "$language executed for $id: the flange is where the drawing has it",
    ({ robot, language, text, samples }) => {
      let held = 0;
      for (const { axes_deg, flange_mm, rotation } of samples) {
        const interpreted = dialectById(language)!.interpret(text(axes_deg), robot);
        expect(interpreted.kind === "ready" ? "" : interpreted.faults[0]!.sentence).toBe("");
        if (interpreted.kind !== "ready") continue;
        const [step] = movesOf(interpreted.run());
        const target = step!.target;
        if (!("q" in target)) throw new Error("The text moves to joint angles.");
        const { position, quaternion } = compose(inverse(robot.baseFromVendorWorld), flangePose(robot.arm, target.q));
        position.forEach((value, i) => expect(millimetres(value)).toBeCloseTo(flange_mm[i]!, 3));
        // Where the flange points, whatever the maker calls its x axis.
        const out = toMatrix(quaternion);
        const points = (column: number): number =>
          Math.max(...[0, 1, 2].map(i => Math.abs(out[3 * i + 2]! - rotation[3 * i + column]!)));
        expect(Math.min(points(0), points(2))).toBeLessThan(1e-6);
        held++;
      }
      expect(held).toBe(samples.length);
    },
  );

  test.each(cases)("$language written for $id says the axis values of the drawing", ({ robot, language, samples }) => {
    const dialect = dialectById(language)!;
    for (const { axes_deg, flange_mm } of samples) {
      // The joint angles of this posture, found by where the flange is and not by the section.
      const interpreted = dialect.interpret(TEXTS[language]!(axes_deg), robot);
      if (interpreted.kind !== "ready") throw new Error(interpreted.faults[0]!.sentence);
      const [step] = movesOf(interpreted.run());
      const target = step!.target as { readonly q: readonly number[] };
      const flange = compose(inverse(robot.baseFromVendorWorld), flangePose(robot.arm, target.q)).position;
      flange.forEach((value, i) => expect(millimetres(value)).toBeCloseTo(flange_mm[i]!, 3));
      const inside = robot.arm.joints.every(
        ({ limits }, i) => target.q[i]! >= limits.lower_rad && target.q[i]! <= limits.upper_rad,
      );
      if (!inside) continue;
      const { file } = exported(dialect, robot, {
        ...emptyProgram(robot.id, "Golden"),
        steps: [move("there", "ptp", { q: target.q })],
      });
      const numbers = [...file.text.matchAll(/-?\d+(?:\.\d+)?(?:[eE]-?\d+)?/g)].map(([text]) => Number(text));
      const wanted = language === "urscript" ? axes_deg.map(value => (value * Math.PI) / 180) : axes_deg;
      const at = numbers.findIndex((_value, i) =>
        wanted.every((value, k) => numbers.slice(i + k, i + 14).some(each => Math.abs(each - value) < 2e-3)),
      );
      expect(at, `${wanted.join(" ")} in\n${file.text}`).toBeGreaterThanOrEqual(0);
    }
  });
});
