import { createStore } from "zustand/vanilla";

/**
 * What a joint may travel between two services [rad, or m of one that slides], by the id of the robot, base first; 0
 * where nobody said.
 */
export interface ServiceState {
  readonly travel: Readonly<Record<string, readonly number[]>>;
}
export const serviceStore = createStore<ServiceState>(() => ({ travel: {} }));

export function setServiceTravel(robot: string, joint: number, travel: number, joints: number): void {
  serviceStore.setState(({ travel: known }) => ({
    travel: {
      ...known,
      [robot]: Array.from({ length: joints }, (_, i) => (i === joint ? travel : (known[robot]?.[i] ?? 0))),
    },
  }));
}

/** Only numbers of what was kept; anything else is nobody's word. */
export function readServiceTravel(raw: unknown): ServiceState["travel"] {
  if (typeof raw !== "object" || raw === null) return {};
  return Object.fromEntries(
    Object.entries(raw).flatMap(([robot, values]): [string, readonly number[]][] =>
      Array.isArray(values)
        ? [[robot, values.map(value => (typeof value === "number" && value > 0 && Number.isFinite(value) ? value : 0))]]
        : [],
    ),
  );
}
