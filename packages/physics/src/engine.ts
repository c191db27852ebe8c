import load, { type MainModule, type MjData, type MjModel } from "@mujoco/mujoco";

/** MuJoCo, compiled to WebAssembly. One a thread is enough: any number of worlds live in it. */
export type Engine = MainModule;
export type { MjData, MjModel };

/** The version that results were measured with; peers in benchmarks must be the same. */
export const MUJOCO_VERSION = "3.14.0";

/**
 * Loads the engine: 10 MB, so only where somebody asked for physics.
 *
 * @param wasmUrl  where a page serves `@mujoco/mujoco/mujoco.wasm`; Node finds it by itself.
 */
export const loadEngine = (wasmUrl?: string): Promise<Engine> =>
  load(wasmUrl === undefined ? {} : { locateFile: (path: string) => (path.endsWith(".wasm") ? wasmUrl : path) });
