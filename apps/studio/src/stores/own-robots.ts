import { addOwnRobot, isOwnRobot, robotById, robotOfFile, type Robot } from "@twincell/core";
import { createStore } from "zustand/vanilla";
import type { KeyValueStore } from "./keeper.ts";

/** A robot file as a cell keeps it. */
export type KeptRobotFile = Readonly<Record<string, unknown>> & { readonly id: string };

export interface OwnRobotState {
  /** Robots that a person brought, the newest first. */
  readonly robots: readonly Robot[];
}
export const ownRobotStore = createStore<OwnRobotState>(() => ({ robots: [] }));

const KEY = "twincell.library.robot.";
const files = new Map<string, KeptRobotFile>();
let keeper: KeyValueStore | null = null;

/** The file of a robot that came from one; undefined for those of the library. */
export const ownFileOf = (id: string): KeptRobotFile | undefined => files.get(id);

/** Makes the robot of a file known to the page. Undefined when the file is no robot. */
export function knowRobotFile(file: KeptRobotFile): Robot | undefined {
  const answer = robotOfFile(file);
  if (answer.kind !== "robot") return undefined;
  const { robot } = answer;
  if (robotById(robot.id) !== robot) addOwnRobot(robot);
  files.set(robot.id, file);
  const others = ownRobotStore.getState().robots.filter(({ id }) => id !== robot.id);
  ownRobotStore.setState({ robots: [robot, ...others] });
  return robot;
}

/** Makes a robot known and keeps it in this browser, so that other cells can have it. May fail, as keeping may. */
export async function keepRobotFile(file: KeptRobotFile): Promise<void> {
  knowRobotFile(file);
  await keeper?.set(KEY + file.id, JSON.stringify(file));
}

/** Forgets a robot for other cells; cells that have it keep it. */
export async function forgetRobotFile(id: string): Promise<void> {
  ownRobotStore.setState(({ robots }) => ({ robots: robots.filter(robot => robot.id !== id) }));
  await keeper?.delete(KEY + id);
}

/** Reads the robots that were kept in this browser. One that cannot be read any more is passed over. */
export async function loadRobotFiles(store: KeyValueStore): Promise<void> {
  keeper = store;
  for (const key of await store.keys()) {
    if (typeof key !== "string" || !key.startsWith(KEY)) continue;
    const text = await store.get(key);
    const file = typeof text === "string" ? fileOf(text) : undefined;
    if (file) knowRobotFile(file);
  }
}

function fileOf(text: string): KeptRobotFile | undefined {
  try {
    const value: unknown = JSON.parse(text);
    return isFile(value) ? value : undefined;
  } catch {
    return undefined; // Damaged: the cells that have the robot have it in them.
  }
}
const isFile = (value: unknown): value is KeptRobotFile =>
  typeof value === "object" && value !== null && "id" in value && typeof value.id === "string";

/** Whether a robot is one that a person brought. */
export const isOwn = (robot: Robot): boolean => isOwnRobot(robot);
