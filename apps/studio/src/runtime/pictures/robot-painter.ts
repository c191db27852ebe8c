import { withRobots } from "../hire.ts";
import type { FromRobotPainter, ToRobotPainter } from "../../workers/robot-picture-messages.ts";
import type { Pixels } from "./robot-picture.ts";

let worker: Worker | null = null;
let count = 0;
const asked = new Map<number, (picture: Pixels | null) => void>();
/** Pictures that were made, by robot and size. */
const made = new Map<string, Promise<Pixels | null>>();

function hired(): Worker {
  const fresh = withRobots(
    new Worker(new URL("../../workers/robot-picture.worker.ts", import.meta.url), { type: "module" }),
  );
  fresh.addEventListener("message", ({ data: { id, picture } }: MessageEvent<FromRobotPainter>) => {
    asked.get(id)?.(picture);
    asked.delete(id);
  });
  // Without its painter a robot is shown by its name alone.
  fresh.addEventListener("error", () => {
    for (const answer of asked.values()) answer(null);
    asked.clear();
  });
  return fresh;
}

/** The picture of a robot, made once away from the page; null where there is none. */
export function paintedRobot(robot: string, width: number, height: number): Promise<Pixels | null> {
  const key = `${robot} ${width} ${height}`;
  const known = made.get(key);
  if (known) return known;
  worker ??= hired();
  const id = ++count;
  const picture = new Promise<Pixels | null>(resolve => asked.set(id, resolve));
  worker.postMessage({ id, robot, width, height } satisfies ToRobotPainter);
  made.set(key, picture);
  return picture;
}
