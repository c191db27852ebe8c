import { robotById, type PhysicalScene } from "@twincell/core";
import { createWorld, loadEngine, MUJOCO_VERSION, PhysicsRun, sceneXml } from "@twincell/physics";
import { conveyorPalletCell, physicalScene } from "@twincell/project";
import { figure, settled, type Bench } from "./figure.ts";
import { numbersOf, pythonPeer } from "./peer.ts";

const ROUNDS = 31;
const STEPS = 500;

/**
 * Engine, cell and program: the conveyor with nine boxes and a UR10e that waits, then the whole program against the
 * clock.
 */
export const run: Bench = async () => {
  const loading = performance.now();
  const engine = await loadEngine();
  const loaded_ms = performance.now() - loading;
  const cell = conveyorPalletCell();
  const robot = robotById(cell.robot.id);
  const program = cell.programs[0];
  if (!robot || !program) throw new Error("The example has no robot or no program.");
  const scene: PhysicalScene = physicalScene(cell, robot, { program });
  const building = performance.now();
  const answer = createWorld(engine, scene);
  const built_ms = performance.now() - building;
  if (answer.kind === "refused") throw new Error(answer.why.sentence);
  const { world } = answer;
  const none = new Float64Array(scene.q_rad.length);
  const command = { q_rad: scene.q_rad, qd_rad_s: none, qdd_rad_s2: none, gripperClosed: false };
  for (let i = 0; i < 1000; i++) world.step(command);
  const ours = settled(STEPS, ROUNDS, 2, () => {
    world.step(command);
  });
  const bare = settled(STEPS, ROUNDS, 2, () => {
    engine.mj_step(world.model, world.data);
  });
  world.close();

  const again = createWorld(engine, scene);
  if (again.kind === "refused") throw new Error(again.why.sentence);
  const play = new PhysicsRun(again.world, program);
  const began = performance.now();
  const ended = play.runFor(200).kind;
  const took_s = (performance.now() - began) / 1000;
  const simulated_s = again.world.state.time_s;
  again.world.close();
  const peer = pythonPeer(`mujoco-${MUJOCO_VERSION}`, [`mujoco==${MUJOCO_VERSION}`], NATIVE, {
    xml: sceneXml(scene, undefined),
    rounds: ROUNDS,
    steps: STEPS,
    q: scene.q_rad,
  });
  return [
    figure("physics/load", "ms", [loaded_ms], "engine from disk, once a process"),
    figure("physics/build", "ms", [built_ms], "the conveyor cell, from document to world"),
    figure(
      "physics/step",
      "us",
      ours,
      `one step of ${scene.step_s ?? 0.002} s: nine boxes on a belt, arm, gripper, photo-cell`,
    ),
    figure("physics/step-engine", "us", bare, "the engine alone in the same world"),
    ...(peer === undefined
      ? []
      : [
          figure(
            "physics/step-native",
            "us",
            numbersOf(peer, "us"),
            `Python mujoco ${MUJOCO_VERSION}, the same model, its C loop`,
          ),
        ]),
    figure(
      "physics/real-time",
      "1",
      [simulated_s / took_s],
      `nine of nine boxes: ${simulated_s.toFixed(1)} s simulated, ${ended}; times faster than the clock`,
    ),
  ];
};

const NATIVE = `
import json, sys, time
import mujoco, numpy as np
given = json.load(sys.stdin)
m = mujoco.MjModel.from_xml_string(given["xml"]); d = mujoco.MjData(m)
d.qpos[:len(given["q"])] = given["q"]
mujoco.mj_step(m, d, nstep=1000)
us = []
for _ in range(given["rounds"]):
    t = time.perf_counter(); mujoco.mj_step(m, d, nstep=given["steps"]); us.append((time.perf_counter() - t) / given["steps"] * 1e6)
print(json.dumps({"us": us}))
`;

if (import.meta.main) for (const line of await run()) process.stdout.write(`${JSON.stringify(line)}\n`);
