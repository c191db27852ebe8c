import { writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { robotById, type MoveStep, type Program, type Step } from "@twincell/core";
import { createWorld, loadEngine, pickAndPlaceProgram, pickScene, PhysicsRun, StateLog } from "@twincell/physics";

/**
 * An hour of a cell with contact in one world: a UR10e with its own torques fetches a box and puts it back, again and
 * again, while a beam and a belt work. No growth of memory, no part lost, no number that is none. `node --expose-gc
 * scripts/soak/physics-hour.ts [seconds]` keeps its result in physics-hour.json.
 */
const SECONDS = Number(process.argv[2] ?? 3600);
const EVERY_S = 60;
const robot = robotById("ur10e")!;
const { scene, grip_m } = pickScene(
  { shape: "box", width_m: 0.05, mass_kg: 2 },
  { robot, control: { kind: "computed-torque", bandwidth_rad_s: 60 } },
);
const there = pickAndPlaceProgram(robot, scene.gripper!, [0.65, -0.2, grip_m], [0.65, 0.25, grip_m], 0.5);
const back = pickAndPlaceProgram(robot, scene.gripper!, [0.65, 0.25, grip_m], [0.65, -0.2, grip_m], 0.5);
const steps: Step[] = [
  ...there.steps,
  ...back.steps.map((step): Step => ({ ...(step as MoveStep), id: `back-${step.id}` })),
];
const program: Program = { ...there, steps: [{ id: "for-ever", type: "repeat", times: "forever", steps }] };
const answer = createWorld(await loadEngine(), {
  ...scene,
  floor_m: -0.5,
  objects: [
    ...scene.objects,
    {
      id: "belt",
      name: "Belt",
      role: "fixture",
      worldFromObject: { position: [-0.8, 0, 0], quaternion: [0, 0, 0, 1] },
      shape: { kind: "box", size_m: [0.4, 1, 0.1] },
      belt: { direction: [0, 1, 0], speed_mps: 0.2, runs: { signal: "seen", is: false } },
    },
  ],
  sensors: [
    {
      id: "beam",
      name: "Beam",
      kind: "beam",
      from_m: [0.4, 0.02, 0.4],
      to_m: [0.9, 0.02, 0.4],
      signal: "seen",
      sees: ["part", "robot"],
    },
  ],
});
if (answer.kind === "refused") throw new Error(answer.why.sentence);
const { world } = answer;
const log = new StateLog();
let dropped = 0;
let held = 0;
let worst_m = 0;
let finite = true;
const run = new PhysicsRun(world, program, {
  onEvent: event => {
    if (event.kind === "dropped") dropped++;
    if (event.kind === "grasp" && event.signal === "held") held++;
  },
});
const memory = (): { heap_MB: number; engine_MB: number; resident_MB: number } => {
  (globalThis as { gc?: () => void }).gc?.();
  const { heapUsed, rss } = process.memoryUsage();
  return {
    heap_MB: Math.round(heapUsed / 1e5) / 10,
    engine_MB: Math.round(world.coordinates.qpos.buffer.byteLength / 1e5) / 10,
    resident_MB: Math.round(rss / 1e6),
  };
};
const begun_ms = performance.now();
let first = memory();
for (let until_s = EVERY_S; until_s <= SECONDS && run.state.kind === "running"; until_s += EVERY_S) {
  while (world.state.time_s < until_s && run.state.kind === "running") {
    run.advance();
    if (run.state.step === "rest" || run.state.step === "back-rest")
      worst_m = Math.max(
        worst_m,
        Math.min(Math.abs(world.state.parts[1]! + 0.2), Math.abs(world.state.parts[1]! - 0.25)),
      );
  }
  log.add(world.coordinates.qpos);
  log.add(world.coordinates.qvel);
  finite &&= world.state.parts.every(Number.isFinite) && world.state.q_rad.every(Number.isFinite);
  // What is compiled and cached in the first minutes is not growth.
  if (until_s === 5 * EVERY_S) first = memory();
}
const last = memory();
const simulated_s = Math.round(world.state.time_s);
const seconds = Math.round((performance.now() - begun_ms) / 1000);
const result = {
  simulated_s,
  seconds,
  ended: run.state.why?.sentence ?? "",
  held,
  dropped,
  worst_m: Math.round(worst_m * 1e6) / 1e6,
  finite,
  grown_MB: {
    heap: Math.round((last.heap_MB - first.heap_MB) * 10) / 10,
    engine: Math.round((last.engine_MB - first.engine_MB) * 10) / 10,
  },
  last,
  hash: log.hash,
};
process.stdout.write(`${JSON.stringify(result)}\n`);
writeFileSync(
  new URL("physics-hour.json", import.meta.url),
  `${JSON.stringify(
    {
      what: "one hour of pick and place with contact in one world; memory after five minutes and at the end",
      date: new Date().toISOString().slice(0, 10),
      machine: `${cpus()[0]?.model ?? "unknown"}, Node ${process.versions.node}`,
      seed: "none: nothing is random",
      results: result,
    },
    null,
    2,
  )}\n`,
);
world.close();
