import {
  angleBetween,
  compose,
  distance,
  flangePose,
  identity,
  pose,
  robotById,
  seededRandom,
  type MoveStep,
  type Pose,
  type Program,
  type Random,
  type Robot,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { DIALECTS, dialectById } from "../index.ts";
import { HAND_WRITTEN, type HandWritten } from "../testing/hand-written.ts";
import { linesOf } from "../testing/lines.ts";
import { randomProgram } from "../testing/programs.ts";
import { executeText, findPoints, joinFiles, mainOf, touchUpPoint, type PatchFile, type TextPoint } from "./index.ts";

const worldFromBase: Pose<"world", "base"> = pose([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]);
/** Three decimals of a degree in each of six joints, at the end of a two metre arm. */
const ROUNDING = { position_m: 2e-4, angle_rad: 2e-4 };

interface Case {
  readonly title: string;
  readonly language: string;
  readonly robot: Robot;
  readonly main: string;
  readonly files: readonly PatchFile[];
}
const generated = (language: string, robotId: string, seed: number): Case => {
  const robot = robotById(robotId)!;
  const dialect = dialectById(language)!;
  const program = randomProgram(robot, {
    seed,
    steps: 40,
    worldFromBase,
    paths: ["ptp", "lin"],
    cannot: dialect.cannot.map(({ what }) => what),
    signals: linesOf(language),
  });
  const emitted = dialect.emit(program, robot, worldFromBase);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  return {
    title: `generated ${language} ${seed}`,
    language,
    robot,
    main: mainOf(dialect, emitted.files)!.name,
    files: emitted.files,
  };
};
const written = ({ language, robot, main, files }: HandWritten): Case => ({
  title: `hand-written ${language}`,
  language,
  robot: robotById(robot)!,
  main,
  files,
});
const CASES: readonly Case[] = [
  ...HAND_WRITTEN.map(written),
  ...HAND_WRITTEN.flatMap(({ language, robot }) => [1, 3].map(seed => generated(language, robot, seed))),
];

const pointsOf = ({ language, files }: Pick<Case, "language" | "files">): readonly TextPoint[] => {
  const found = findPoints(language, files);
  if (found.kind === "not-yet") throw new Error(found.because);
  return found.points;
};
/** The motions of a text by file and line, with what the controller knows there. */
function executed(of: Case): { readonly moves: ReadonlyMap<string, MoveStep>; readonly program: Program } {
  const dialect = dialectById(of.language)!;
  const joined = joinFiles(dialect, of.files, of.main);
  const ran = executeText(dialect, joined.text, "test", of.robot, worldFromBase);
  if (ran.kind === "not-understood") throw new Error(`${of.title}: ${JSON.stringify(ran.faults)}`);
  const moves = new Map<string, MoveStep>();
  for (const step of ran.program.steps) {
    if (step.type !== "move") continue;
    const { file, line } = joined.place(ran.lines.get(step.id)!);
    if (!moves.has(`${file}:${line}`)) moves.set(`${file}:${line}`, step);
  }
  return { moves, program: ran.program };
}
function tipOf(target: MoveStep["target"], program: Program, robot: Robot): Pose {
  const tool = target.tool ?? "flange";
  const flangeFromTcp = tool === "flange" ? identity<"flange", "tcp">() : program.tools[tool]!;
  if ("q" in target) return compose(compose(worldFromBase, flangePose(robot.arm, target.q)), flangeFromTcp);
  return compose(target.frame === "world" ? identity<"world", "frame">() : program.frames[target.frame]!, target.pose);
}
const near = (robot: Robot, random: Random): number[] =>
  robot.home_rad.map((q, j) => {
    const { lower_rad, upper_rad } = robot.arm.joints[j]!.limits;
    return Math.min(upper_rad - 0.05, Math.max(lower_rad + 0.05, q + (random() - 0.5) * 1.2));
  });
/** The text around the numbers of a point. */
const frameOf = (files: readonly PatchFile[], point: TextPoint): string => {
  let text = files[point.value.file]!.text.slice(point.value.start, point.value.end);
  for (const { start, end } of [...point.fields].reverse())
    text = `${text.slice(0, start - point.value.start)}#${text.slice(end - point.value.start)}`;
  return text;
};

describe.each(HAND_WRITTEN.map(each => [each.language, each] as const))("points of hand-written %s", (_, text) => {
  test("are found where they stand, each value and each motion at its line; comments and strings hold none", () => {
    const points = pointsOf(text).filter(point => point.uses.length > 0);
    expect(points.map(point => point.name.toLowerCase()).sort()).toEqual(
      text.points.map(name => name.toLowerCase()).sort(),
    );
    for (const point of points) {
      const value = text.files[point.value.file]!.text;
      expect(value.slice(0, point.value.start).split("\n")).toHaveLength(point.value.line);
      for (const use of point.uses) {
        const said = text.files[use.file]!.text;
        expect(said.slice(0, use.start).split("\n")).toHaveLength(use.line);
        if (point.name !== "")
          expect(said.slice(use.start, use.end).toLowerCase().replace(/:\w+/, "")).toBe(point.name.toLowerCase());
      }
    }
  });
});

test("1,000 random touch-ups: equal elsewhere byte for byte, the point read again within rounding, no other motion changed", () => {
  const random = seededRandom(13);
  let done = 0;
  for (let i = 0; done < 1000; i++) {
    const of = CASES[i % CASES.length]!;
    const dialect = dialectById(of.language)!;
    const before = executed(of);
    const all = pointsOf(of);
    const points = all.filter(
      point =>
        point.fixed === undefined &&
        point.uses.some(use => use.whole && before.moves.has(`${use.file}:${use.motionLine}`)) &&
        // The via point of an arc is executed with the end of its line.
        point.uses.every(use => use.whole && !isVia(of, use.file, use.start)),
    );
    // Several touch-ups of one text, each on top of the one before.
    let files = of.files;
    for (let n = 0; n < 25 && done < 1000; n++, done++) {
      const [{ name }, at] = pick(points, random);
      const point = pointsOf({ ...of, files })[all.indexOf(points[at]!)]!;
      const use = point.uses.find(each => before.moves.has(`${each.file}:${each.motionLine}`))!;
      const q = near(of.robot, random);
      const move = before.moves.get(`${use.file}:${use.motionLine}`)!;
      const touched = touchUpPoint(dialect, files, point, move, before.program, of.robot, q, worldFromBase);
      if (touched.kind === "refused") throw new Error(`${of.title} ${name}: ${touched.sentence}`);
      expect(touched.uses).toBe(point.uses.length);
      const title = `${of.title} ${name} #${done}`;
      const { file, start, end } = point.value;
      touched.files.forEach((after, f) => {
        if (f !== file) expect(after).toBe(files[f]);
      });
      const [old, now] = [files[file]!.text, touched.files[file]!.text];
      expect(now.slice(0, start), title).toBe(old.slice(0, start));
      expect(now.slice(end + now.length - old.length), title).toBe(old.slice(end));
      const again = pointsOf({ ...of, files: touched.files });
      const same = again.find(each => each.value.file === file && each.value.start === start)!;
      expect(frameOf(touched.files, same), title).toBe(frameOf(files, point));

      const after = executed({ ...of, files: touched.files });
      const last = executed({ ...of, files });
      for (const [place, step] of after.moves) {
        const wanted = point.uses.some(each => `${each.file}:${each.motionLine}` === place);
        if (!wanted) {
          expectUnmoved(step, after.program, last.moves.get(place)!, last.program, of.robot, `${title} at ${place}`);
          continue;
        }
        const tip = tipOf(step.target, after.program, of.robot);
        const goal = tipOf({ q, tool: move.target.tool ?? "flange" }, before.program, of.robot);
        if ((step.target.tool ?? "flange") !== (move.target.tool ?? "flange")) continue;
        expect(distance(tip.position, goal.position), `${title} at ${place}`).toBeLessThan(ROUNDING.position_m);
        expect(angleBetween(tip.quaternion, goal.quaternion), `${title} at ${place}`).toBeLessThan(ROUNDING.angle_rad);
      }
      files = touched.files;
    }
  }
  expect(done).toBe(1000);
}, 120_000);

test("touching a point up where it is changes nothing of a hand-written text that is read again", () => {
  for (const of of HAND_WRITTEN.map(written)) {
    const { moves, program } = executed(of);
    for (const point of pointsOf(of).filter(each => each.kind === "joints" && each.fixed === undefined)) {
      const use = point.uses.find(each => moves.has(`${each.file}:${each.motionLine}`));
      const move = use === undefined ? undefined : moves.get(`${use.file}:${use.motionLine}`);
      if (move === undefined || !("q" in move.target)) continue;
      const touched = touchUpPoint(
        dialectById(of.language)!,
        of.files,
        point,
        move,
        program,
        of.robot,
        move.target.q,
        worldFromBase,
      );
      expect(touched, `${of.title} ${point.name}`).toMatchObject({ kind: "touched-up", edits: [], files: of.files });
    }
  }
});

test("in a text of 10,000 lines a point is found and rewritten in less than 50 ms", () => {
  const [krl] = HAND_WRITTEN.map(written);
  const of = krl!;
  const { moves, program } = executed(of);
  const filler = "  LIN XP2 C_DIS\r\n; Naht {X 1,Y 2}\r\n".repeat(5000);
  const src = of.files[0]!.text.replace("  LIN XP2 C_DIS\r\n", filler);
  const files = [{ name: of.files[0]!.name, text: src }, of.files[1]!];
  expect(src.split("\n").length).toBeGreaterThan(10_000);
  const move = [...moves.values()].find(step => !("q" in step.target))!;
  const once = (): number => {
    const start = performance.now();
    const point = pointsOf({ language: "krl", files }).find(each => each.name === "XP2")!;
    const touched = touchUpPoint(
      dialectById("krl")!,
      files,
      point,
      move,
      program,
      of.robot,
      of.robot.home_rad,
      worldFromBase,
    );
    expect(touched.kind).toBe("touched-up");
    return performance.now() - start;
  };
  once();
  expect(Math.min(...Array.from({ length: 5 }, once))).toBeLessThan(50);
});

test("a point that gets several values is not touched up, with the lines of all of them", () => {
  const files = [
    {
      name: "a.src",
      text: "DEF a( )\nXP1={A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}\nPTP XP1\nXP1={A1 10,A2 -90,A3 90,A4 0,A5 0,A6 0}\nPTP XP1\nEND\n",
    },
  ];
  const robot = robotById("kuka_kr6_2")!;
  const point = pointsOf({ language: "krl", files })[0]!;
  const move: MoveStep = {
    id: "a",
    type: "move",
    path: "ptp",
    target: { q: robot.home_rad },
    speed: { ratio: 1 },
    blend_m: 0,
  };
  expect(
    touchUpPoint(dialectById("krl")!, files, point, move, { tools: {}, frames: {} }, robot, robot.home_rad),
  ).toEqual({
    kind: "refused",
    sentence: "XP1 gets a value in 2 places (lines 2, 4): which of them a motion means is decided while it runs.",
    hint: "Change the numbers in the text itself.",
  });
});

test("a language whose points are not found yet says why; the others find points in their own texts", () => {
  const able = DIALECTS.filter(({ id }) => findPoints(id, []).kind === "found").map(({ id }) => id);
  expect(able).toEqual(["krl", "urscript", "rapid", "fanuc-ls"]);
  for (const { id } of DIALECTS) {
    const found = findPoints(id, []);
    if (found.kind === "not-yet") expect(found.because).toMatch(/^[A-Z].{30,}\.$/);
  }
});

test("the file that is run is the one no other file calls; its data list comes right behind it", () => {
  const krl = dialectById("krl")!;
  const files = [
    { name: "clean.dat", text: "DEFDAT clean\nENDDAT\n" },
    { name: "clean.src", text: "DEF clean( )\nEND" },
    { name: "weld.dat", text: "DEFDAT weld\nENDDAT\n" },
    { name: "notes.txt", text: "nothing" },
    { name: "weld.src", text: "DEF weld( )\nclean( )\nEND\n" },
  ];
  expect(mainOf(krl, files)?.name).toBe("weld.src");
  const joined = joinFiles(krl, files, "weld.src");
  expect(joined.text).toBe(
    "DEF weld( )\nclean( )\nEND\nDEFDAT weld\nENDDAT\nDEF clean( )\nEND\nDEFDAT clean\nENDDAT\n",
  );
  expect(joined.place(5)).toEqual({ file: 2, line: 2 });
  expect(joined.place(7)).toEqual({ file: 1, line: 2 });
  expect(joined.joined(1, 2)).toBe(7);
  expect(joined.joined(3, 1)).toBeUndefined();
});

/**
 * A PTP behind a touched-up point may be told by joint angles, for its turns are reached from elsewhere; it goes to the
 * same place.
 */
function expectUnmoved(
  step: MoveStep,
  program: Program,
  before: MoveStep,
  programBefore: Program,
  robot: Robot,
  title: string,
): void {
  const { target, ...rest } = step;
  const { target: was, ...restBefore } = before;
  expect(rest, title).toEqual(restBefore);
  expect(target.tool, title).toBe(was.tool);
  const tip = tipOf(target, program, robot);
  const tipBefore = tipOf(was, programBefore, robot);
  expect(distance(tip.position, tipBefore.position), title).toBeLessThan(1e-6);
  expect(angleBetween(tip.quaternion, tipBefore.quaternion), title).toBeLessThan(1e-6);
}

function pick<T>(list: readonly T[], random: Random): readonly [T, number] {
  const at = Math.floor(random() * list.length);
  return [list[at]!, at];
}
/**
 * Whether a motion names another point after this one on its line, or goes on in the next line: it is the via point of
 * an arc.
 */
function isVia({ language, files }: Case, file: number, at: number): boolean {
  const line = /^[^\r\n]*/.exec(files[file]!.text.slice(files[file]!.text.lastIndexOf("\n", at) + 1))![0];
  return language === "fanuc-ls" ? /^\s*\d*:C /.test(line) : /\b(CIRC|MoveC|movec)\b/i.test(line);
}
