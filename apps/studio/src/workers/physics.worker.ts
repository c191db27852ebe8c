import "./know-robots.ts";
import { robotById, SignalTable } from "@twincell/core";
import { createWorld, loadEngine, PhysicsRun, type MujocoWorld } from "@twincell/physics";
import { physicalScene } from "@twincell/project";
import type { FromPhysics, PhysicsFrame, ToPhysics } from "./physics-messages.ts";

let world: MujocoWorld | undefined;
let run: PhysicsRun | undefined;
let edition = 0;
let left_s = 0;
let stopped = false;
let said: string[] = [];
const engine = loadEngine();
const answer = (message: FromPhysics): void => {
  postMessage(message);
};
const frameOf = (at: MujocoWorld, step: string): PhysicsFrame => ({
  t_s: at.state.time_s,
  q_rad: at.state.q_rad.slice(),
  parts: at.state.parts.slice(),
  opening_m: at.state.opening_m,
  grasp: [...at.state.grasp],
  tripped: at.tripped.slice(),
  people: Float64Array.from(at.people.places.flatMap(({ x_m, y_m, heading_rad }) => [x_m, y_m, heading_rad])),
  step,
});

async function start({ document, program, edition: mine }: Extract<ToPhysics, { kind: "start" }>): Promise<void> {
  edition = mine;
  world?.close();
  world = run = undefined;
  const robot = robotById(document.robot.id);
  const ready = await engine;
  if (mine !== edition) return;
  if (!robot) {
    answer({
      kind: "refused",
      edition,
      sentence: `The library has no robot called “${document.robot.id}”.`,
      hint: "Choose another robot.",
    });
    return;
  }
  const built = createWorld(ready, physicalScene(document, robot, { program }), new SignalTable());
  if (built.kind === "refused") {
    answer({ kind: "refused", edition, sentence: built.why.sentence, hint: built.why.hint });
    return;
  }
  world = built.world;
  said = [];
  left_s = 0;
  stopped = false;
  run = new PhysicsRun(world, program, {
    onEvent: event => {
      said.push(event.sentence);
      if (event.kind === "override") stopped = event.override === 0;
    },
  });
  answer({ kind: "ready", edition, parts: world.parts, assumptions: built.assumptions, frame: frameOf(world, "") });
}

function advance(dt_s: number, override: number): void {
  if (!world || !run) return;
  run.override = override;
  left_s += dt_s;
  for (; left_s >= world.step_s && run.state.kind === "running"; left_s -= world.step_s) run.advance();
  answer({
    kind: "frame",
    edition,
    state: run.state.kind,
    stopped,
    frame: frameOf(world, run.state.step),
    said,
    why: run.state.why ? `${run.state.why.sentence} ${run.state.why.hint}` : "",
  });
  said = [];
}

addEventListener("message", ({ data }: MessageEvent<ToPhysics>) => {
  if (data.kind === "start") {
    start(data).catch((problem: unknown) => {
      answer({
        kind: "refused",
        edition: data.edition,
        sentence: `Physics stopped: ${problem instanceof Error ? problem.message : String(problem)}.`,
        hint: "Reload the page; nothing is lost.",
      });
    });
    return;
  }
  if (data.edition !== edition || !run) return;
  if (data.kind === "advance") {
    advance(data.dt_s, data.override);
    return;
  }
  const allowed = run.watch.resume();
  if (allowed.kind === "refused") said.push(allowed.sentence);
});
