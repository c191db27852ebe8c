import {
  PALLET_ORDERS,
  listsOf,
  palletSlots,
  type Dialect,
  type EmittedFile,
  type Pallet,
  type Program,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { proveText, runnableFile } from "../prove.ts";
import type { DialectBench } from "./describe-dialect.ts";
import { structuredProgram } from "./structured.ts";

/** The shape of a program: sorts of steps, and those inside them. */
const shape = (steps: readonly Step[]): unknown[] =>
  steps.map(step => {
    const lists = listsOf(step);
    return lists.length === 0 ? step.type : [step.type, step.type === "repeat" ? step.times : "", ...lists.map(shape)];
  });

/** What a language keeps of loops, decisions, calls and patterns, and what of lines and loads. */
export function describeStructure(dialect: Dialect, bench: DialectBench): void {
  const { robot, worldFromBase } = bench;
  const cannot = new Set([...dialect.cannot.map(({ what }) => what), ...(dialect.idioms ?? [])]);
  const emit = (program: Program): EmittedFile => {
    const emitted = dialect.emit(program, robot, worldFromBase);
    if (emitted.kind === "cannot") throw new Error(`${emitted.step}: ${emitted.sentence}`);
    return runnableFile(dialect, emitted.files)!;
  };
  const parse = (text: string): Program => {
    const parsed = dialect.parse(text, robot, worldFromBase);
    if (parsed.kind === "not-understood") throw new Error(JSON.stringify(parsed.faults));
    expect(parsed.warnings).toEqual([]);
    return parsed.program;
  };
  const structured = (pallet?: Partial<Pallet>): Program => {
    const program = structuredProgram(robot, worldFromBase, cannot, pallet);
    return { ...program, signals: { ...program.signals, ...bench.signals } };
  };
  const whole = structured();

  describe(`structure in ${dialect.name}`, () => {
    test("lines, loads, loops, decisions, calls, patterns and searches are carried out as the program says", () => {
      const proof = proveText(dialect, emit(whole), whole, robot, worldFromBase);
      expect(proof.kind, proof.sentence).toBe("proven");
    });

    test("they stay what they are when the text is read: same shape, same text", () => {
      const file = emit(whole);
      const again = parse(file.text);
      expect(shape(again.steps)).toEqual(shape(whole.steps));
      expect(Object.values(again.routines).map(shape)).toEqual(Object.values(whole.routines).map(shape));
      expect(emit(again).text).toBe(file.text);
    });

    test("a loop of a thousand rounds is no longer than one of ten", () => {
      const loops = (times: number): Program => ({
        ...whole,
        steps: whole.steps.map(step => (step.type === "repeat" ? { ...step, times } : step)),
      });
      expect(emit(loops(1000)).lines).toHaveLength(emit(loops(10)).lines.length);
      expect(shape(parse(emit(loops(1000)).text).steps)).toEqual(shape(loops(1000).steps));
    });

    const patterns: readonly Partial<Pallet>[] = [
      ...PALLET_ORDERS.map(order => ({ order })),
      { interleave: "odd-rows-shifted" },
      { interleave: "odd-rows-shifted", order: "rows-zigzag" },
      { rows: 1 },
      { columns: 1, layers: 1 },
      { rows: 1, columns: 1, layers: 1 },
      { frame: "world" },
    ];
    test.each(cannot.has("pallet") ? [] : patterns)(
      "a pattern of places stays a loop, and every place is met: %o",
      pattern => {
        const program = structured(pattern);
        const file = emit(program);
        const again = parse(file.text);
        const proof = proveText(dialect, file, program, robot, worldFromBase);
        expect(proof.kind, proof.sentence).toBe("proven");
        expect(emit(again).text).toBe(file.text);
        const wanted = palletSlots(program.pallets.tray!);
        const got = palletSlots(Object.values(again.pallets)[0]!);
        expect(got).toHaveLength(wanted.length);
        for (const [i, { position }] of got.entries())
          expect(Math.hypot(...position.map((v, k) => v - wanted[i]!.position[k]!))).toBeLessThan(1e-5);
      },
    );

    test("a program without an end is carried out as long as it is asked for more", () => {
      if (cannot.has("repeat")) return;
      const program: Program = {
        ...whole,
        steps: [{ id: "r", type: "repeat", times: "forever", steps: whole.steps.filter(step => step.type === "move") }],
      };
      const file = emit(program);
      const proof = proveText(dialect, file, program, robot, worldFromBase);
      expect(proof.kind, proof.sentence).toBe("proven");
      expect(parse(file.text).steps).toMatchObject([{ type: "repeat", times: "forever" }]);
    });
  });
}
