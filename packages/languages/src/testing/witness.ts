import { identity, type Dialect, type Executed, type Robot, type Signals, type TextFault } from "@twincell/core";
import { expect, test } from "vitest";
import { proveText, runnableFile } from "../prove.ts";
import { randomProgram } from "./programs.ts";

/** Executes texts that were written by hand. */
export interface Witness {
  /** What a text does, step by step. */
  readonly run: (text: string, signals?: Signals) => Executed[];
  /** What keeps a text from being steps, or from being executed; "ready" when nothing does. */
  readonly faults: (text: string) => readonly TextFault[] | "ready";
}

export function witnessOf(dialect: Dialect, robot: Robot): Witness {
  return {
    run: (text, signals) => {
      const interpreted = dialect.interpret(text, robot);
      if (interpreted.kind === "not-understood") throw new Error(JSON.stringify(interpreted.faults));
      const done: Executed[] = [];
      for (let next = interpreted.run(signals), one = next.next(); one.done !== true; one = next.next())
        if (one.value.step !== undefined) done.push(one.value);
      return done;
    },
    faults: text => {
      const kept = dialect.parse(text, robot);
      const answer = kept.kind === "not-understood" ? kept : dialect.interpret(text, robot);
      return answer.kind === "not-understood" ? answer.faults : "ready";
    },
  };
}

/** Numbers to nine digits, for `toMatchObject`. */
export const near = (values: readonly number[], digits = 9): number[] =>
  values.map(value => expect.closeTo(value, digits) as number);
/** Inputs that are all on. */
export const ALL_ON: Signals = {
  read: () => true,
  write: () => {
    /* nobody listens */
  },
};

/** @param text  100,000 lines, each of which is a step. */
export function testLongText(dialect: Dialect, robot: Robot, text: () => string): void {
  test("100,000 lines are read in less than two seconds", () => {
    const long = text();
    const before = process.threadCpuUsage();
    const parsed = dialect.parse(long, robot);
    const { user, system } = process.threadCpuUsage(before);
    expect(parsed.kind === "parsed" && parsed.program.steps.length).toBe(100_000);
    expect((user + system) / 1e6).toBeLessThan(2);
  });
}

export function testHundredPrograms(dialect: Dialect, robot: Robot): void {
  test("100 random programs are met by their texts", () => {
    for (let seed = 101; seed <= 200; seed++) {
      const program = randomProgram(robot, {
        seed,
        steps: 12,
        worldFromBase: identity(),
        paths: ["ptp", "lin", "circ"],
        cannot: dialect.cannot.map(({ what }) => what),
      });
      const emitted = dialect.emit(program, robot);
      if (emitted.kind === "cannot") throw new Error(emitted.sentence);
      const proof = proveText(dialect, runnableFile(dialect, emitted.files)!, program, robot);
      expect(proof.kind, `seed ${seed}: ${proof.sentence}`).toBe("proven");
    }
  });
}
