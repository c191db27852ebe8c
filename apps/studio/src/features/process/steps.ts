import type { CellDocument } from "@twincell/project";

/** The six steps in which a cell comes about (row N-01), in their order. */
export const PROCESS_STEPS = ["objects", "kinematics", "interactions", "scenario", "run", "execute"] as const;
export type ProcessStep = (typeof PROCESS_STEPS)[number];

/** What the stores know of the work so far. */
export interface Progress {
  readonly document: CellDocument;
  /** Steps of the selected program; lines of one that is text. */
  readonly steps: number;
  /** The simulation has run, and its check has an answer. */
  readonly simulated: boolean;
  readonly judged: "clear" | "bad" | null;
  /** Runs on a controller that were recorded. */
  readonly runs: number;
}

/**
 * Which of the six steps are done: something stands in the cell; the robot has a tool or is one that was brought;
 * something can be grasped, moves, senses or is watched; a program is there; it was simulated; it ran on a controller,
 * and its check finds nothing to correct.
 */
export function stepsDone({ document, steps, simulated, judged, runs }: Progress): ReadonlySet<ProcessStep> {
  const { objects, tools, tool, robot } = document;
  const done = new Set<ProcessStep>();
  if (objects.length > 0) done.add("objects");
  const used = tools.find(({ name }) => name === tool);
  if (robot.file !== undefined || (used && Math.hypot(...used.flangeFromTcp.position) > 0)) done.add("kinematics");
  const interacts =
    objects.some(({ role, belt }) => role === "workpiece" || belt !== undefined) ||
    [document.sensors, document.zones, document.people].some(list => (list?.length ?? 0) > 0);
  if (interacts) done.add("interactions");
  if (steps > 0) done.add("scenario");
  if (steps > 0 && simulated && judged !== null) done.add("run");
  if (runs > 0 && judged === "clear") done.add("execute");
  return done;
}

/** The first step that is not done; null when all are. */
export const nextStep = (done: ReadonlySet<ProcessStep>): ProcessStep | null =>
  PROCESS_STEPS.find(step => !done.has(step)) ?? null;
