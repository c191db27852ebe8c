import { everyStep, expressionOf, robotById, withLists, type Step } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { DIALECTS, proveText, runnableFile } from "./index.ts";
import { computingProgram, type ComputingLines, type ComputingWords } from "./testing/computing.ts";

interface Bench extends ComputingLines {
  readonly robot: string;
  readonly words?: ComputingWords;
}

/** A robot that speaks the language, and numbers of its lines. */
const BENCHES: Readonly<Record<string, Bench>> = {
  krl: { robot: "kuka_kr6_2", inputs: [3, 4], output: 5 },
  inform: { robot: "yaskawa_gp8", inputs: [3, 4], output: 5, words: { numbers: false } },
  rapid: { robot: "abb_irb120", inputs: [3, 4], output: 5 },
  urscript: { robot: "ur10e", inputs: [3, 4], output: 5, words: { div: false, mod: false } },
  "fanuc-ls": { robot: "fanuc_lrmate200id", inputs: [3, 4], output: 5 },
  "v-plus": { robot: "staubli_rx90l", inputs: [1003, 1004], output: 5 },
  val3: { robot: "staubli_rx160", inputs: [3, 4], output: 5, words: { div: false, stopInRoutine: false } },
  "kawasaki-as": { robot: "kawasaki_rs007l", inputs: [1003, 1004], output: 5 },
  spel: { robot: "epson_c4_a601s", inputs: [3, 4], output: 5, words: { div: false } },
  "melfa-basic": { robot: "mitsubishi_rv7fl", inputs: [3, 4], output: 5, words: { div: false } },
  pacscript: { robot: "denso_vs060", inputs: [3, 4], output: 5, words: { div: false } },
};
const PROGRAMS = Number(process.env.TWINCELL_COMPUTING ?? 60);
// The form with pulses is the same writer.
const computes = DIALECTS.filter(
  ({ id, cannot }) => id !== "inform-pulse" && cannot.every(({ what }) => what !== "assign"),
);

describe("programs that compute", () => {
  test("every language that declares it can is tried", () => {
    expect(computes.map(({ id }) => id).sort()).toEqual(Object.keys(BENCHES).sort());
  });

  test.each(computes.map(dialect => [dialect.id, dialect] as const))(
    "%s: every drawn program is written, and its text executes to the same steps whatever the inputs say",
    (id, dialect) => {
      const { robot: name, words, ...lines } = BENCHES[id]!;
      const robot = robotById(name)!;
      const kinds = new Set<string>();
      for (let seed = 1; seed <= PROGRAMS; seed++) {
        const program = computingProgram(robot, seed, lines, words);
        for (const step of everyStep(program)) kinds.add(step.type);
        const emitted = dialect.emit(program, robot);
        if (emitted.kind === "cannot") throw new Error(`${id} ${seed}: ${emitted.step}: ${emitted.sentence}`);
        const file = runnableFile(dialect, emitted.files)!;
        const proof = proveText(dialect, file, program, robot);
        expect(proof.kind, `${id} ${seed}: ${proof.sentence}\n${proof.kind === "proven" ? "" : file.text}`).toBe(
          "proven",
        );
      }
      expect(kinds).toEqual(new Set(["move", "assign", "set", "wait", "if", "while", "wait-for", "call"]));
    },
  );

  test.each(computes.map(dialect => [dialect.id, dialect] as const))(
    "%s: a text that counts one round too many or decides the other way is found out",
    (id, dialect) => {
      const { robot: name, words, ...lines } = BENCHES[id]!;
      const robot = robotById(name)!;
      let found = 0;
      for (let seed = 1; seed <= 20; seed++) {
        const program = computingProgram(robot, seed, lines, words);
        const wrong = {
          ...program,
          steps: program.steps.map(changed),
          routines: { turns: program.routines.turns!.map(changed) },
        };
        const emitted = dialect.emit(wrong, robot);
        if (emitted.kind === "cannot") continue;
        const proof = proveText(dialect, runnableFile(dialect, emitted.files)!, program, robot);
        if (proof.kind !== "proven") found++;
      }
      // The others have no loop and no decision that is ever come to.
      expect(found).toBeGreaterThanOrEqual(12);
    },
  );
});

/** Loops compare by <= instead of <, and decisions are turned round. */
function changed(whole: Step): Step {
  const step = withLists(whole, list => list.map(changed));
  if (step.type === "if") return { ...step, when: { expression: { op: "not", of: [expressionOf(step.when)] } } };
  if (step.type !== "while" || !("expression" in step.when)) return step;
  const { expression } = step.when;
  if (typeof expression !== "object" || !("op" in expression) || expression.op !== "<") return step;
  return { ...step, when: { expression: { ...expression, op: "<=" } } };
}
