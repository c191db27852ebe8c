import {
  emptyProgram,
  type Dialect,
  type EmittedFile,
  type Executed,
  type MoveStep,
  type Program,
  type Skipped,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { executeText } from "../patch/index.ts";
import { runnableFile } from "../prove.ts";
import type { DialectBench } from "./describe-dialect.ts";

/**
 * Statements that no reader of the language understands: a plain one, a motion, and a block with a motion of the
 * program inside.
 */
export interface Unknown {
  readonly statement: string;
  readonly motion: string;
  readonly opens?: string;
  readonly closes?: string;
  /** Makes a line of the text of a statement; most languages need nothing. */
  readonly line?: (statement: string) => string;
}

/** What is left out when a person says so, and that nothing is when nobody did. */
export function describeSkipping(dialect: Dialect, { robot, worldFromBase }: DialectBench, unknown: Unknown): void {
  const q = [...robot.home_rad];
  const asLine = unknown.line ?? ((statement: string) => `  ${statement}`);
  const move = (id: string, turn_rad: number): MoveStep => ({
    id,
    type: "move",
    path: "ptp",
    target: { q: q.map((angle, i) => (i === 0 ? angle + turn_rad : angle)) },
    speed: { ratio: 0.5 },
    blend_m: 0,
  });
  const program: Program = {
    ...emptyProgram(robot.id, "Left out"),
    steps: [move("a", 0.1), { id: "w", type: "wait", s: 1 }, move("b", 0.3), move("c", 0.2)],
  };
  const emitted = dialect.emit(program, robot, worldFromBase);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  const file: EmittedFile = runnableFile(dialect, emitted.files)!;
  const lines = file.text.split(/\r?\n/);
  /** The first line that moves to the step, or waits. */
  const lineOf = (id: string): number =>
    file.lines.findIndex((step, i) => step === id && (id === "w" || dialect.lines!.motion.test(lines[i]!)));
  const put = (at: number, ...statements: string[]): string =>
    lines.toSpliced(at, 0, ...statements.map(asLine)).join("\n");

  /** What a text that is executed as it is leaves out, which is named at the lines from `first` to `last`. */
  const named = (text: string, first: number, last: number): readonly string[] | undefined => {
    const executed = executeText(dialect, text, "left out", robot, worldFromBase);
    if (executed.kind === "not-understood") return undefined;
    expect(executed.notExecuted.some(({ line }) => line >= first && line <= last)).toBe(true);
    return executed.program.steps.map(({ type }) => type);
  };

  const read = (
    text: string,
    first: number,
    last = first,
  ): { readonly steps: readonly Step[]; readonly skipped: readonly Skipped[] | undefined } => {
    const plain = dialect.parse(text, robot, worldFromBase);
    const parsed = dialect.parse(text, robot, worldFromBase, { skipUnknown: true });
    const interpreted = dialect.interpret(text, robot, worldFromBase, { skipUnknown: true });
    const asText = named(text, first, last);
    // Kept as steps without being asked to leave anything out: then the place is among the warnings.
    if (plain.kind === "parsed") {
      expect(plain.warnings.some(({ line }) => line >= first && line <= last)).toBe(true);
      return { steps: plain.program.steps, skipped: undefined };
    }
    if (asText !== undefined) {
      if (parsed.kind !== "parsed") throw new Error(JSON.stringify(parsed.faults));
      expect(asText).toEqual(parsed.program.steps.flatMap(({ type }) => (type === "comment" ? [] : [type])));
      return { steps: parsed.program.steps, skipped: parsed.skipped };
    }
    if (parsed.kind !== "parsed") throw new Error(JSON.stringify(parsed.faults));
    if (interpreted.kind !== "ready") throw new Error(JSON.stringify(interpreted.faults));
    const run = interpreted.run();
    const done: Executed[] = [];
    for (let next = run.next(); next.done !== true; next = run.next()) done.push(next.value);
    // What is no statement may be the name of a program that no file has.
    const places = (skipped: readonly Skipped[] = []): unknown =>
      skipped.map(({ what, line, lastLine, text: left }) => ({ what, line, lastLine, left }));
    expect(places(interpreted.skipped)).toEqual(places(parsed.skipped));
    expect(done.flatMap(({ step }) => (step === undefined ? [] : [step.type]))).toEqual(
      parsed.program.steps.flatMap(({ type }) => (type === "comment" ? [] : [type])),
    );
    return { steps: parsed.program.steps, skipped: parsed.skipped! };
  };
  const types = (steps: readonly Step[]): string[] => steps.flatMap(({ type }) => (type === "comment" ? [] : [type]));

  describe(`what is not understood of ${dialect.name}`, () => {
    test("a statement is reported with its line and column, and left out only when it is named or the user says so", () => {
      const at = lineOf("w");
      const { steps, skipped } = read(put(at, unknown.statement), at + 1);
      expect(types(steps)).toEqual(["move", "wait", "move", "move"]);
      if (skipped === undefined) return;
      expect(skipped).toMatchObject([
        { what: "statement", line: at + 1, lastLine: at + 1, text: asLine(unknown.statement) },
      ]);
      expect(skipped[0]!.column).toBeGreaterThan(0);
      expect(skipped[0]!.sentence).toContain(`Line ${at + 1} is left out.`);
    });

    test("a motion that is left out is called one", () => {
      const at = lineOf("b");
      const { steps, skipped } = read(put(at, unknown.motion), at + 1);
      expect(types(steps)).toEqual(["move", "wait", "move", "move"]);
      if (skipped === undefined) return;
      expect(skipped).toMatchObject([{ what: "motion", line: at + 1 }]);
      expect(skipped[0]!.sentence).toMatch(/^The motion in line [0-9]+ is left out: the robot goes on/);
    });

    test.skipIf(unknown.opens === undefined)(
      "a block that nobody knows when to run is left out with all that it does, and its motions are counted",
      () => {
        const at = lineOf("b");
        const text = lines
          .toSpliced(at + 1, 0, asLine(unknown.closes!))
          .toSpliced(at, 0, asLine(unknown.opens!))
          .join("\n");
        const { steps, skipped } = read(text, at + 1, at + 3);
        expect(types(steps)).toEqual(["move", "wait", "move"]);
        if (skipped === undefined) return;
        expect(skipped).toMatchObject([{ what: "branch", line: at + 1, lastLine: at + 3 }]);
        expect(skipped[0]!.sentence).toContain(
          `Lines ${at + 1} to ${at + 3} are left out with all that they do, a motion among it.`,
        );
      },
    );

    test("a text that is none of the language stays refused", () => {
      for (const each of [dialect.interpret, dialect.parse])
        expect(each("lorem ipsum\ndolor sit amet\n", robot, worldFromBase, { skipUnknown: true }).kind).toBe(
          "not-understood",
        );
    });
  });
}
