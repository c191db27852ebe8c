/** Every example of the start page: checked, exported in each language of its robot, run on a virtual controller. */
import { cellGeometry, EXAMPLES, type Example, type StepsCell } from "@twincell/project";
import {
  checkProgram,
  compose,
  distance,
  flangePose,
  linkSolids,
  manualScheduler,
  planProgram,
  robotById,
  samplePlan,
  withBranches,
  type Program,
  type Robot,
} from "@twincell/core";
import { createVirtualController, textSteps } from "@twincell/controllers";
import { dialectsFor, proveText, runnableFile } from "@twincell/languages";
import { describe, expect, test } from "vitest";

const clear = EXAMPLES.filter(({ check }) => check === "clear");
const LONGEST_RUN_S = 900;
/** Texts keep tenths of a millimetre or of a thousandth of a degree. */
const END_M = 1e-4;

type Dialect = ReturnType<typeof dialectsFor>[number];

interface Task {
  readonly cell: StepsCell;
  readonly robot: Robot;
  readonly program: Program;
}
function taskOf({ make }: Example): Task {
  const cell = make();
  const robot = robotById(cell.robot.id)!;
  return { cell, robot, program: cell.programs[0]! };
}

/** Some controllers count their inputs and outputs from another number than 1. */
const FIRST_LINE: Readonly<Record<string, { readonly input: number; readonly output: number }>> = {
  "v-plus": { input: 1001, output: 1 },
  "kawasaki-as": { input: 1001, output: 1 },
};

function textOf(dialect: Dialect, { cell, robot, program }: Task) {
  const { worldFromBase } = cell.robot;
  const first = FIRST_LINE[dialect.id] ?? { input: 1, output: 1 };
  const signals = Object.fromEntries(
    Object.entries(program.signals).map(([name, line]) => [
      name,
      { ...line, address: (line.address ?? 1) - 1 + (line.kind === "digital-in" ? first.input : first.output) },
    ]),
  );
  const written = withBranches({ ...program, signals }, robot, { where: "needed", worldFromBase });
  return { written, emitted: dialect.emit(written, robot, worldFromBase) };
}

test("there are at least twelve examples, each with a name, a sentence and a folder of its own", () => {
  expect(EXAMPLES.length).toBeGreaterThanOrEqual(12);
  expect(new Set(EXAMPLES.map(({ make }) => make().name)).size).toBe(EXAMPLES.length);
  expect(new Set(EXAMPLES.map(({ id }) => id)).size).toBe(EXAMPLES.length);
  expect(EXAMPLES.filter(({ sentence }) => !/^[A-Z].{20,90}\.$/.test(sentence))).toEqual([]);
});

test.each(EXAMPLES.map(example => [example.id, example] as const))("%s: the check answers as it says", (_, example) => {
  const { cell, robot, program } = taskOf(example);
  const { verdict } = checkProgram(program, robot, { cell: cellGeometry(cell, linkSolids(robot)) });
  expect(program.steps.length === 0).toBe(example.check === "empty");
  expect(verdict.steps.filter(step => step.verdict === "bad").length > 0).toBe(example.check === "bad");
  expect(verdict.ok).toBe(example.check !== "bad");
});

test("the line out of reach says how far the wrist is asked to go and where on the path it ends", () => {
  const { cell, robot, program } = taskOf(EXAMPLES.find(({ check }) => check === "bad")!);
  const { verdict } = checkProgram(program, robot, { cell: cellGeometry(cell, linkSolids(robot)) });
  const [start, end] = verdict.steps;
  expect(start!.verdict).toBe("ok");
  const said = end!.findings.map(({ sentence }) => sentence).join(" ");
  expect(said).toMatch(/wrist would be 2940 mm from the shoulder; the arm is 1514 mm long/);
  expect(said).toMatch(/gets to 51 % of the path/);
});

describe.each(clear.map(example => [example.id, example] as const))("%s", (_, example) => {
  const task = taskOf(example);
  const { cell, robot, program } = task;
  const { worldFromBase } = cell.robot;
  const dialects = dialectsFor(robot);

  test.each(dialects.map(dialect => [dialect.name, dialect] as const))(
    "in %s: the text, executed, is the program, or what the language cannot say is named",
    (__, dialect) => {
      const { written, emitted } = textOf(dialect, task);
      if (emitted.kind !== "emitted") {
        // Only the pose list of the research arm may leave something unsaid; it declares what.
        expect(dialect).not.toBe(dialects[0]);
        const [, missing] = /asks for (\S+)\./.exec(emitted.sentence) ?? [];
        expect(dialect.cannot.map(({ what }) => what)).toContain(missing);
        return;
      }
      const proof = proveText(dialect, runnableFile(dialect, emitted.files)!, written, robot, worldFromBase);
      expect([proof.kind, proof.kind === "proven" ? "" : proof.sentence]).toEqual(["proven", ""]);
    },
    120_000,
  );

  test("a virtual controller that executes the text ends where the program ends", async () => {
    const [dialect] = dialects;
    const { emitted } = textOf(dialect!, task);
    if (emitted.kind !== "emitted") throw new Error(emitted.sentence);
    const interpreted = dialect!.interpret(runnableFile(dialect!, emitted.files)!.text, robot, worldFromBase);
    if (interpreted.kind !== "ready") throw new Error(JSON.stringify(interpreted.faults));
    const scheduler = manualScheduler();
    const virtual = createVirtualController({ robot, scheduler, worldFromBase, cycle_s: 0.012 });
    let last: number[] = [];
    virtual.onSample(({ q_rad }) => {
      last = [...q_rad];
    });
    for (const [name, { kind }] of Object.entries(interpreted.context.signals ?? {}))
      if (kind === "digital-in") virtual.atTheRobot.setInput(name, true);
    const text = textSteps(() => interpreted.run());
    let outcome: unknown = null;
    const run = virtual.run(text.steps, interpreted.context).then(ended => {
      outcome = ended;
    });
    while (outcome === null && scheduler.now_s() < LONGEST_RUN_S) await scheduler.elapse(5);
    await run;
    expect(outcome).toEqual({ kind: "done" });
    const answer = planProgram(program, robot, { worldFromBase });
    if (answer.kind !== "planned") throw new Error("The program has no plan.");
    const q = new Float64Array(robot.home_rad.length);
    samplePlan(answer.plan, Infinity, q);
    const tool = cell.tools[0]!.flangeFromTcp;
    const at = (joints: ArrayLike<number>) => compose(flangePose(robot.arm, joints), tool).position;
    expect(distance(at(last), at(q))).toBeLessThan(END_M);
  }, 120_000);
});
