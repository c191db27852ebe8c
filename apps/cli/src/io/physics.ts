import { SignalTable, type PhysicalScene, type Program, type Robot } from "@twincell/core";
import type { PhysicsEvent } from "@twincell/physics";
import { physicalScene, type CellDocument } from "@twincell/project";
import { lineWriter } from "./json-lines.ts";
import { ioOf, momentWriter, toolsBySteps } from "./moments.ts";
import { UseFault } from "./usage.ts";

const CONTROLS = ["moved", "drives", "computed-torque"] as const;

/** `--control`: how the arm follows what it is told; `--bandwidth` of its drives. */
export function controlFrom(name = "moved", bandwidth_rad_s = 60): PhysicalScene["control"] {
  const kind = CONTROLS.find(each => each === name);
  if (kind === undefined) throw new UseFault(`--control wants ${CONTROLS.join(", ")}, not "${name}".`);
  return kind === "moved" ? { kind } : { kind, bandwidth_rad_s };
}

/** A cell with contact for that program; without `--cell` there is nothing to touch. */
export function sceneFor(
  cell: CellDocument | undefined,
  robot: Robot,
  program: Program,
  control: PhysicalScene["control"],
): PhysicalScene {
  if (cell === undefined)
    throw new UseFault("--cell is missing.", "Physics needs to know what stands around the robot and what it weighs.");
  return physicalScene(cell, robot, { program, control });
}

export interface PhysicsPlay {
  readonly scene: PhysicalScene;
  readonly program: Program;
  readonly period_s: number;
  readonly most_s: number;
  readonly inputs: Readonly<Record<string, boolean | number>>;
  readonly liftAnything: boolean;
}

/**
 * Carries out a program with contact, one JSON line each period; what happened since the last line is in its "events".
 * What is assumed and how it ended goes to standard error.
 */
export async function playWithPhysics({
  scene,
  program,
  period_s,
  most_s,
  inputs,
  liftAnything,
}: PhysicsPlay): Promise<number> {
  const { createWorld, loadEngine, PhysicsRun, StateLog } = await import("@twincell/physics");
  const signals = new SignalTable(Object.entries(inputs));
  const answer = createWorld(await loadEngine(), scene, signals);
  if (answer.kind === "refused") {
    process.stderr.write(`twincell: ${answer.why.sentence} ${answer.why.hint}\n`);
    return 1;
  }
  const { world } = answer;
  const { state } = world;
  const events: PhysicsEvent[] = [];
  const log = new StateLog();
  const writer = lineWriter();
  const run = new PhysicsRun(world, program, {
    onEvent: event => {
      events.push(event);
    },
    liftAnything,
  });
  const moment = momentWriter(scene.robot, scene.worldFromBase, program.tools, toolsBySteps(program));
  const write = (): void => {
    const parts = Object.fromEntries(
      world.parts.map((id, i) => [
        id,
        {
          position: [...state.parts.subarray(7 * i, 7 * i + 3)],
          quaternion: [...state.parts.subarray(7 * i + 3, 7 * i + 7)],
          grasp: state.grasp[i],
        },
      ]),
    );
    writer.write({
      ...moment(state.time_s, state.q_rad, ioOf(run.state.gripperClosed, program.signals, signals.all), run.state.step),
      parts,
      events: events.splice(0),
    });
  };
  write();
  for (let line = 1; run.state.kind === "running" && state.time_s < most_s; line++) {
    while (run.state.kind === "running" && state.time_s < line * period_s - 1e-9) {
      run.advance();
      log.add(world.coordinates.qpos);
    }
    write();
  }
  await writer.end();
  const { kind, why } = run.state;
  process.stderr.write(
    `${kind === "paused" ? `twincell: ${why!.sentence} ${why!.hint}` : kind === "done" ? `The program took ${state.time_s.toFixed(2)} s.` : `The program was still running after ${most_s} s.`} This rests on: ${answer.assumptions.join(" ")} States ${log.hash}.\n`,
  );
  world.close();
  return kind === "paused" ? 1 : 0;
}
