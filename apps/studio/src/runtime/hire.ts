import { onOwnRobot, ownRobots, type Robot } from "@twincell/core";

/** What a page tells its workers beside their work: a robot that came from a file. */
export interface KnowRobot {
  readonly knowRobot: Robot;
}

/** Workers end when nobody holds them any more; one that has ended hears nothing. */
const hired = new Set<WeakRef<Worker>>();

onOwnRobot(robot => {
  for (const reference of hired) {
    const worker = reference.deref();
    if (worker === undefined) hired.delete(reference);
    else worker.postMessage({ knowRobot: robot } satisfies KnowRobot);
  }
});

/**
 * The worker, told of every robot that was added from a file, before its first work and from now on. For workers that
 * are told the id of a robot; they import `workers/know-robots.ts`.
 */
export function withRobots(worker: Worker): Worker {
  for (const robot of ownRobots()) worker.postMessage({ knowRobot: robot } satisfies KnowRobot);
  hired.add(new WeakRef(worker));
  return worker;
}
