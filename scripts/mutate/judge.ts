/**
 * A thread that is given one faulty emitter after the other and says whether its texts are told from the right ones.
 */
import { readFileSync } from "node:fs";
import { registerHooks } from "node:module";
import { fileURLToPath } from "node:url";
import { parentPort, workerData } from "node:worker_threads";
import {
  CAPABILITIES,
  PALLET_ORDERS,
  emptyProgram,
  everyStep,
  pose,
  robotById,
  type Dialect,
  type Program,
} from "@twincell/core";
import { dialectById, proveText, runnableFile } from "@twincell/languages";
import { linesOf } from "../../packages/languages/src/testing/lines.ts";
import { randomProgram } from "../../packages/languages/src/testing/programs.ts";
import { structuredProgram } from "../../packages/languages/src/testing/structured.ts";

export interface Order {
  readonly id: number;
  readonly file: string;
  readonly source: string;
}
export type Verdict =
  | { readonly kind: "killed"; readonly by: string }
  | { readonly kind: "survived"; readonly text: string }
  | { readonly kind: "same text" };

const { dialectId, robotId, files } = workerData as {
  readonly dialectId: string;
  readonly robotId: string;
  readonly files: readonly string[];
};
const own = new Set(files);
const sources = new Map<number, Order>();
registerHooks({
  resolve(specifier, context, next) {
    const found = next(specifier, context);
    const mutant = /\?mutant=([0-9]+)$/.exec(context.parentURL ?? "")?.[1];
    if (mutant === undefined || !found.url.startsWith("file:") || !own.has(fileURLToPath(found.url))) return found;
    return { ...found, url: `${found.url}?mutant=${mutant}` };
  },
  load(url, context, next) {
    const mutant = /\?mutant=([0-9]+)$/.exec(url)?.[1];
    if (mutant === undefined) return next(url, context);
    const path = fileURLToPath(url.replace(/\?.*$/, ""));
    const order = sources.get(Number(mutant))!;
    return {
      format: "module-typescript",
      shortCircuit: true,
      source: order.file === path ? order.source : readFileSync(path, "utf8"),
    };
  },
});

const dialect = dialectById(dialectId)!;
const robot = robotById(robotId)!;
const cannot = dialect.cannot.map(({ what }) => what);
const worldFromBase = pose<"world", "base">([0.3, -0.2, 0.75], [0, 0, Math.sin(0.4), Math.cos(0.4)]);
const paths = (["ptp", "lin", "circ", "spline"] as const).filter(path => !cannot.includes(path));
const can = new Set(CAPABILITIES.filter(each => !cannot.includes(each)));

/** The programs of the conformance suite, those with structure first. */
const lines = linesOf(dialectId);
const named = (program: Program): Program => ({ ...program, signals: { ...program.signals, ...lines } });
const PROGRAMS: readonly Program[] = [
  named(structuredProgram(robot, worldFromBase, new Set(cannot))),
  ...[2, 4, 6, 8].map(seed =>
    randomProgram(robot, { seed, steps: 40, worldFromBase, paths, cannot, can, signals: lines }),
  ),
  ...[1, 3, 5, 7].map(seed => randomProgram(robot, { seed, steps: 40, worldFromBase, paths, cannot })),
  ...(can.has("pallet")
    ? [
        ...PALLET_ORDERS.map(order => ({ order })),
        { interleave: "odd-rows-shifted" as const },
        { rows: 1 },
        { frame: "world" },
      ].map(pallet => named(structuredProgram(robot, worldFromBase, new Set(cannot), pallet)))
    : []),
  emptyProgram(robot.id),
];
const right = PROGRAMS.map(program => dialect.emit(program, robot, worldFromBase));

/** What people called steps and groups, and which belong together. */
const titles = (program: Program): string =>
  JSON.stringify(
    Array.from(everyStep(program), ({ name, group }) => [
      name,
      group === undefined ? undefined : program.groups[group]?.name,
    ]),
  );
const read: (Program | undefined)[] = [];
/** What is read of the right text. */
function readRight(i: number): Program | undefined {
  const wanted = right[i]!;
  if (read[i] === undefined && wanted.kind === "emitted") {
    const parsed = dialect.parse(runnableFile(dialect, wanted.files)!.text, robot, worldFromBase);
    if (parsed.kind === "parsed") read[i] = parsed.program;
  }
  return read[i];
}

async function judged(order: Order): Promise<Verdict> {
  sources.set(order.id, order);
  let faulty: Dialect;
  try {
    const module = (await import(`../../packages/languages/src/${dialectId}/index.ts?mutant=${order.id}`)) as Record<
      string,
      unknown
    >;
    faulty = Object.values(module).find(
      (each): each is Dialect => typeof each === "object" && each !== null && (each as Dialect).id === dialectId,
    )!;
  } catch (cause) {
    return { kind: "killed", by: `does not load: ${String(cause).slice(0, 80)}` };
  }
  let survived: Verdict = { kind: "same text" };
  for (const [i, program] of PROGRAMS.entries()) {
    const wanted = right[i]!;
    try {
      const emitted = faulty.emit(program, robot, worldFromBase);
      if (emitted.kind !== wanted.kind)
        return {
          kind: "killed",
          by: emitted.kind === "cannot" ? `refuses: ${emitted.sentence.slice(0, 80)}` : "writes what cannot be written",
        };
      if (emitted.kind !== "emitted" || wanted.kind !== "emitted") continue;
      if (JSON.stringify(emitted.files) === JSON.stringify(wanted.files)) continue;
      const file = runnableFile(faulty, emitted.files)!;
      const differs = emitted.files.findIndex(
        (each, k) => each.text !== wanted.files[k]?.text || each.name !== wanted.files[k].name,
      );
      const proof = proveText(dialect, file, program, robot, worldFromBase);
      if (proof.kind !== "proven") return { kind: "killed", by: proof.sentence.slice(0, 100) };
      for (const each of emitted.files) {
        if (!/^[\r\n\t -~]*$/.test(each.text)) return { kind: "killed", by: "not ASCII" };
        if (each.lines.length !== each.text.split("\n").length - 1)
          return { kind: "killed", by: "lines without a step" };
      }
      const covered = new Set(file.lines);
      if ([...everyStep(program)].some(({ id }) => !covered.has(id)))
        return { kind: "killed", by: "a step without lines" };
      if (proof.steps.some(({ id, line }) => file.lines[line - 1] !== id))
        return { kind: "killed", by: "lines of another step" };
      const parsed = dialect.parse(file.text, robot, worldFromBase);
      if (parsed.kind === "not-understood") return { kind: "killed", by: "cannot be read back" };
      if (titles(parsed.program) !== titles(readRight(i)!)) return { kind: "killed", by: "names or groups are lost" };
      const again = faulty.emit(parsed.program, robot, worldFromBase);
      if (again.kind === "cannot" || runnableFile(faulty, again.files)!.text !== file.text)
        return { kind: "killed", by: "read back, it is another text" };
      if (survived.kind === "same text")
        survived = {
          kind: "survived",
          text: difference(wanted.files[Math.max(0, differs)]!.text, emitted.files[Math.max(0, differs)]!.text),
        };
    } catch (cause) {
      return { kind: "killed", by: `throws: ${String(cause).slice(0, 80)}` };
    }
  }
  return survived;
}

/** The first line that is another. */
function difference(a: string, b: string): string {
  const were = a.split(/\r?\n/);
  const are = b.split(/\r?\n/);
  const i = were.findIndex((line, k) => line !== are[k]);
  return `${were[i]?.slice(0, 100)} → ${are[i]?.slice(0, 100)}`;
}

parentPort!.on("message", (order: Order) => {
  void judged(order).then(verdict => {
    parentPort!.postMessage({ id: order.id, verdict });
  });
});
parentPort!.postMessage("ready");
