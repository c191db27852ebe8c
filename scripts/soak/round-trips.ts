import { CAPABILITIES, LIBRARY, degrees, millimetres, pose } from "@twincell/core";
import { DIALECTS, dialectsFor, proveText, runnableFile } from "@twincell/languages";
import { linesOf, namesConfigurations } from "../../packages/languages/src/testing/lines.ts";
import { randomProgram } from "../../packages/languages/src/testing/programs.ts";
import { keptResults } from "./kept.ts";

/**
 * A thousand random programs per dialect and robot that speaks it, written, executed and compared: the worst distance
 * and turn between what was meant and what the text does. Every second program has loops, decisions, calls, pallets and
 * signals as far as the dialect says them. `node scripts/soak/round-trips.ts [programs] [dialect]` keeps its result in
 * round-trips.json.
 */
const PROGRAMS = Number(process.argv[2] ?? 1000);
const ONLY = process.argv[3];
const STEPS = 30;
interface Compared {
  programs: number;
  steps: number;
  worst_mm: number;
  worst_deg: number;
  refused: number;
  differing: number;
  examples: string[];
  seconds: number;
}
const kept = keptResults<Compared>(new URL("round-trips.json", import.meta.url), {
  what: "random programs written, executed and compared step by step",
  seeds: `1 … ${PROGRAMS}`,
});

for (const dialect of DIALECTS) {
  if (ONLY !== undefined && dialect.id !== ONLY) continue;
  const cannot = dialect.cannot.map(({ what }) => what);
  const paths = (["ptp", "lin", "circ", "spline"] as const).filter(path => !cannot.includes(path));
  const can = new Set(CAPABILITIES.filter(capability => !cannot.includes(capability)));
  for (const robot of LIBRARY.filter(each => dialectsFor(each).includes(dialect))) {
    const begun_ms = performance.now();
    const refused: string[] = [];
    const differing: string[] = [];
    const branches = namesConfigurations(dialect.id, robot);
    let worst_m = 0;
    let worst_rad = 0;
    let steps = 0;
    for (let seed = 1; seed <= PROGRAMS; seed++) {
      const worldFromBase = pose<"world", "base">([0.3, -0.2, 0.75], [0, 0, Math.sin(seed), Math.cos(seed)]);
      const program = randomProgram(robot, {
        seed,
        steps: STEPS,
        worldFromBase,
        paths,
        cannot,
        branches,
        ...(seed % 2 === 0 ? { can, signals: linesOf(dialect.id) } : {}),
      });
      const emitted = dialect.emit(program, robot, worldFromBase);
      if (emitted.kind === "cannot") {
        refused.push(`${seed}: ${emitted.sentence}`);
        continue;
      }
      const proof = proveText(dialect, runnableFile(dialect, emitted.files)!, program, robot, worldFromBase);
      if (proof.kind !== "proven") {
        differing.push(`${seed}: ${proof.sentence}`);
        continue;
      }
      worst_m = Math.max(worst_m, proof.worst_m);
      worst_rad = Math.max(worst_rad, proof.worst_rad);
      steps += proof.steps.length;
    }
    const name = `${dialect.id} on ${robot.id}`;
    kept.keep(name, {
      programs: PROGRAMS,
      steps,
      worst_mm: millimetres(worst_m),
      worst_deg: degrees(worst_rad),
      refused: refused.length,
      differing: differing.length,
      examples: [...differing, ...refused].slice(0, 5),
      seconds: Math.round((performance.now() - begun_ms) / 1000),
    });
    process.stdout.write(`${name}: ${JSON.stringify(kept.of(name))}\n`);
  }
}
