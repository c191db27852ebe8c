import {
  CAPABILITIES,
  emptyProgram,
  everyStep,
  seededRandom,
  type Dialect,
  type EmittedFile,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { proveText, runnableFile } from "../prove.ts";
import { damaged, expectSane } from "./damage.ts";
import { randomProgram } from "./programs.ts";

export interface DialectBench {
  /** A robot that speaks the language, and where it stands. */
  readonly robot: Robot;
  readonly worldFromBase: Pose<"world", "base">;
  /** Paths that the dialect does not declare under `cannot`. */
  readonly paths: readonly MoveStep["path"][];
  /**
   * The dialect says everything that it does not list under `cannot`: random programs have signals, loops, decisions,
   * calls and pallets as well.
   */
  readonly structured?: boolean;
  /** Lines by the names and numbers that the language has. */
  readonly signals?: Program["signals"];
  /** False where the language cannot ask for a posture of this robot by its name. */
  readonly branches?: boolean;
  /** Its reader writes loops and calls out as what they do, so only programs without them come back as they were. */
  readonly unrolls?: boolean;
  /** What a controller executes of the files; left out, what the dialect says. */
  readonly runnable?: (files: readonly EmittedFile[]) => EmittedFile;
}

const PATHS: readonly MoveStep["path"][] = ["ptp", "lin", "circ", "spline"];
const SEEDS = [1, 2, 3, 4, 5, 6, 7, 8];
const STEPS = 40;
const DAMAGES = 300;
/** Longest that any damaged text may keep a reader busy. */
const PATIENCE_MS = 5_000;

/** What every dialect must do, whatever its language. Differences are declared in `cannot`, with the reason. */
export function describeDialect(dialect: Dialect, bench: DialectBench): void {
  const { robot, worldFromBase, paths } = bench;
  const emit = (program: Program): readonly EmittedFile[] => {
    const emitted = dialect.emit(program, robot, worldFromBase);
    if (emitted.kind === "cannot") throw new Error(`${emitted.step}: ${emitted.sentence}`);
    return emitted.files;
  };
  const chosen = bench.runnable ?? ((files: readonly EmittedFile[]): EmittedFile => runnableFile(dialect, files)!);
  const runnable = (program: Program): EmittedFile => chosen(emit(program));
  // What is written by an idiom does not come back as the step it was.
  const cannot = [...dialect.cannot.map(({ what }) => what), ...(dialect.idioms ?? [])];
  const random = (seed: number): Program =>
    randomProgram(robot, {
      seed,
      steps: STEPS,
      worldFromBase,
      paths,
      cannot,
      ...(bench.signals === undefined ? {} : { signals: bench.signals }),
      ...(bench.branches === undefined ? {} : { branches: bench.branches }),
      ...(bench.structured === true && seed % 2 === 0 ? { can } : {}),
    });
  const can = new Set(CAPABILITIES.filter(capability => !cannot.includes(capability)));
  const parse = (text: string): Program => {
    const parsed = dialect.parse(text, robot, worldFromBase);
    if (parsed.kind === "not-understood") throw new Error(JSON.stringify(parsed.faults));
    return parsed.program;
  };
  const expectProven = (file: EmittedFile, program: Program): void => {
    const proof = proveText(dialect, file, program, robot, worldFromBase);
    expect(proof.kind, proof.sentence).toBe("proven");
  };

  describe(`dialect ${dialect.name}`, () => {
    test.each(SEEDS)("emitted text, executed, meets every target within 0.01 mm and 0.001° (seed %d)", seed => {
      expectProven(runnable(random(seed)), random(seed));
    });

    test.each(SEEDS)("L-57 emit, parse, emit gives the same runnable text (seed %d)", seed => {
      const whole =
        bench.unrolls === true
          ? randomProgram(robot, { seed, steps: STEPS, worldFromBase, paths, cannot })
          : random(seed);
      const first = runnable(whole);
      const program = parse(first.text);
      expect(runnable(program).text).toBe(first.text);
      expectProven(first, program);
    });

    test("names of steps and groups come back from the text", () => {
      const titles = (program: Program): unknown[] =>
        program.steps.map(({ name, group }) => [name, group === undefined ? undefined : program.groups[group]?.name]);
      for (const seed of SEEDS) {
        const plain = randomProgram(robot, {
          seed,
          steps: STEPS,
          worldFromBase,
          paths,
          cannot,
          ...(bench.branches === undefined ? {} : { branches: bench.branches }),
        });
        expect(titles(parse(runnable(plain).text))).toEqual(titles(plain));
      }
    });

    test("an empty program is a text that does nothing", () => {
      expect(parse(runnable(emptyProgram(robot.id)).text).steps).toEqual([]);
    });

    test.each(SEEDS)(
      "the text depends on the program alone, is ASCII, and says for every line which step it belongs to (seed %d)",
      seed => {
        const program = random(seed);
        const files = emit(program);
        const ids = new Set(Array.from(everyStep(program), step => step.id));
        expect(emit(structuredClone(program))).toEqual(files);
        for (const { name, text, lines } of files) {
          expect(text, name).toMatch(/^[\r\n\t -~]*$/);
          expect(lines, name).toHaveLength(text.split("\n").length - 1);
          expect(
            lines.filter(id => id !== "" && !ids.has(id)),
            name,
          ).toEqual([]);
        }
        const file = chosen(files);
        const covered = new Set(file.lines);
        expect([...ids].filter(id => !covered.has(id))).toEqual([]);
        const proof = proveText(dialect, file, program, robot, worldFromBase);
        expect(proof.kind).toBe("proven");
        if (proof.kind === "proven") for (const { id, line } of proof.steps) expect(file.lines[line - 1]).toBe(id);
      },
    );

    const impossible = PATHS.filter(path => !paths.includes(path));
    test(`what it cannot is declared and stops the export at its step: ${impossible.join(", ") || "nothing"}`, () => {
      const q = [...robot.home_rad];
      const step = (id: string, path: MoveStep["path"]): MoveStep => ({
        id,
        type: "move",
        path,
        target: { q },
        via: { q },
        speed: { ratio: 0.1 },
        blend_m: 0,
      });
      for (const path of impossible) {
        expect(dialect.cannot.map(({ what }) => what)).toContain(path);
        const emitted = dialect.emit(
          { ...emptyProgram(robot.id), steps: [step("a", "ptp"), step("b", path), step("c", "ptp")] },
          robot,
          worldFromBase,
        );
        expect(emitted).toMatchObject({ kind: "cannot", step: "b" });
      }
    });

    test("a remark between two moves is no stop", () => {
      if (cannot.includes("comment")) return;
      const q = [...robot.home_rad];
      const move = (id: string, turn_rad: number): MoveStep => ({
        id,
        type: "move",
        path: "ptp",
        target: { q: q.map((angle, i) => (i === 0 ? angle + turn_rad : angle)) },
        speed: { ratio: 0.5 },
        blend_m: 0.01,
      });
      const program: Program = {
        ...emptyProgram(robot.id),
        steps: [
          move("a", 0.1),
          { id: "c", type: "comment", text: "Now the other one" },
          move("b", 0.3),
          move("d", 0.2),
        ],
      };
      expectProven(runnable(program), program);
    });

    test("a stop where a point should be passed is seen, between moves of two tools too", () => {
      const q = [...robot.home_rad];
      const tools: Program["tools"] = {
        one: { position: [0, 0, 0.1], quaternion: [0, 0, 0, 1] },
        two: { position: [0, 0, 0.2], quaternion: [0, 0, 0, 1] },
      };
      const move = (id: string, tool: string, turn_rad: number, blend_m: number): MoveStep => ({
        id,
        type: "move",
        path: "ptp",
        target: { q: q.map((angle, i) => (i === 0 ? angle + turn_rad : angle)), tool },
        speed: { ratio: 0.5 },
        blend_m,
      });
      const across = (second: string, blend_m: number): Program => ({
        ...emptyProgram(robot.id),
        tools,
        steps: [move("a", "one", 0.1, 0), move("b", "one", 0.3, blend_m), move("c", second, 0.2, 0)],
      });
      for (const second of ["one", "two"]) {
        expectProven(runnable(across(second, 0.01)), across(second, 0.01));
        const stopping = proveText(dialect, runnable(across(second, 0)), across(second, 0.01), robot, worldFromBase);
        if (second === "two" && dialect.resolution?.stopsAtNewTool === true) expect(stopping.kind).toBe("proven");
        else expect(stopping.sentence).toMatch(/stops at its target\.$/);
      }
    });

    test("a robot whose controllers do not run the language, by its vendor section, is refused with a sentence", () => {
      const { vendorSection: _, ...unknown } = robot;
      const stranger: Robot = { ...unknown, id: "stranger", name: "Stranger" };
      expect(dialect.emit(random(1), stranger).kind).toBe("cannot");
      expect(dialect.interpret(runnable(random(1)).text, stranger).kind).toBe("not-understood");
    });

    test("damaged text never throws, never hangs, and every fault has its place", () => {
      const next = seededRandom(99);
      const sources = emit(random(2)).map(file => file.text.slice(0, 1500));
      for (let i = 0; i < DAMAGES; i++) {
        const text = damaged(sources[i % sources.length]!, next);
        const started = performance.now();
        for (const answer of [
          dialect.parse(text, robot, worldFromBase),
          dialect.interpret(text, robot, worldFromBase),
        ]) {
          if (answer.kind === "not-understood") expectSane(answer.faults, text);
        }
        expect(performance.now() - started).toBeLessThan(PATIENCE_MS);
      }
    });

    test("text of quite another sort is refused", () => {
      for (const text of [
        '{"format":"twincell.program"}',
        "lorem ipsum dolor sit amet",
        "\0\0\0",
        "(".repeat(5000),
        `x = ${"(".repeat(5000)}1\n`,
        `x = ${"-".repeat(50000)}1\n`,
      ]) {
        const answer = dialect.interpret(text, robot);
        if (answer.kind === "not-understood") expectSane(answer.faults, text);
        if (!text.includes("--")) expect(answer.kind, text.slice(0, 40)).toBe("not-understood");
      }
    });
  });
}

/** Texts that a faulty emitter would have written: each must be told from the right one. */
export function describeMutations(
  dialect: Dialect,
  bench: DialectBench,
  mutations: Readonly<Record<string, (text: string) => string>>,
): void {
  describe(`faults put into ${dialect.name} text are found by executing it`, () => {
    test.each(Object.entries(mutations))("%s", (_, mutate) => {
      let changed = 0;
      for (const seed of SEEDS) {
        const program = randomProgram(bench.robot, {
          seed,
          steps: STEPS,
          worldFromBase: bench.worldFromBase,
          paths: bench.paths,
          cannot: dialect.cannot.map(({ what }) => what),
        });
        const emitted = dialect.emit(program, bench.robot, bench.worldFromBase);
        if (emitted.kind === "cannot") throw new Error(emitted.sentence);
        const file = (bench.runnable ?? (files => runnableFile(dialect, files)!))(emitted.files);
        const text = mutate(file.text);
        if (text === file.text) continue;
        changed++;
        expect(
          proveText(dialect, { ...file, text }, program, bench.robot, bench.worldFromBase).kind,
          `seed ${seed}`,
        ).not.toBe("proven");
      }
      expect(changed).toBeGreaterThan(SEEDS.length / 2);
    });
  });
}
