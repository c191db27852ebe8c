import { spawnSync } from "node:child_process";
import { expect, test } from "vitest";

/** In a process of its own, whose heap nobody else fills. */
const SCRIPT = `
import { PerformanceObserver } from "node:perf_hooks";
const core = {};
for (const file of ["kinematics/forward", "kinematics/jacobian", "kinematics/ortho-parallel", "kinematics/three-parallel", "robots/library/index", "spatial/pose", "random"]) Object.assign(core, await import(process.argv.at(-1) + file + ".ts"));
const CALLS = 100_000, SETS = 1024, random = core.seededRandom(2), pause = ms => new Promise(resolve => setTimeout(resolve, ms));
let collections = 0;
new PerformanceObserver(list => { collections += list.getEntries().length; }).observe({ entryTypes: ["gc"] });
const measured = {};
for (const id of ["staubli_rx90l", "ur10e"]) {
  const { arm, family } = core.robotById(id), scratch = core.armScratch(), working = core.jacobianScratch(), flange = core.identity(), rows = new Float64Array(36), out = new Float64Array(48);
  const sets = Array.from({ length: SETS }, () => Float64Array.from(arm.joints, () => 6 * (random() - 0.5))), poses = sets.map(q => core.flangePose(arm, q));
  const calls = {
    fk: i => { core.flangePose(arm, sets[i % SETS], flange, scratch); },
    jacobian: i => { core.jacobian(arm, sets[i % SETS], null, rows, working); },
    ik: family.kind === "ortho-parallel" ? i => { core.solveOrthoParallel(family, poses[i % SETS], out); } : i => { core.solveThreeParallel(family, poses[i % SETS], out); },
  };
  for (const [name, call] of Object.entries(calls)) {
    for (let round = 0; round < 2; round++) { for (let i = 0; i < 30_000; i++) call(i); await pause(20); }
    globalThis.gc();
    await pause(10);
    collections = 0;
    const before = process.memoryUsage().heapUsed;
    for (let i = 0; i < CALLS; i++) call(i);
    const bytes = (process.memoryUsage().heapUsed - before) / CALLS;
    await pause(10);
    measured[id + " " + name] = { collections, bytes };
  }
}
process.stdout.write(JSON.stringify(measured));
`;

// A number that is boxed takes 16 bytes and a context 40: a call that made one would show as that many per call.
test("forward kinematics, Jacobian and closed-form inverse allocate nothing: no byte per call, no collection", () => {
  const ran = spawnSync(
    process.execPath,
    ["--expose-gc", "--input-type=module", "-e", SCRIPT, new URL("../", import.meta.url).href],
    { encoding: "utf8" },
  );
  expect(ran.stderr).not.toMatch(/Error/);
  const measured = Object.entries(JSON.parse(ran.stdout) as Record<string, { collections: number; bytes: number }>);
  expect(measured).toHaveLength(6);
  for (const [name, { collections, bytes }] of measured) {
    expect(collections, name).toBe(0);
    expect(bytes, name).toBeLessThan(4);
  }
});
