import { inverse, compose, type Pose } from "../../spatial/pose.ts";
import { slerp } from "../../spatial/quaternion.ts";
import { distance } from "../../spatial/vector.ts";
import type { MoveStep, Step } from "../../program/program.ts";
import { pointsOnBeziers } from "./bezier.ts";
import type { Demonstration } from "./demonstration.ts";
import type { FilteredDemonstration, FilteredPart } from "./filters.ts";

export interface DemonstratedSteps {
  /** Frame and tool of the program that the points are taught in. */
  readonly frame: string;
  readonly worldFromFrame: Pose<"world", "frame">;
  readonly tool: string;
  /** The way to the first point: not a part of what was shown. */
  readonly approach: { readonly ratio: number };
  /** Rests of the hand of at least this long become waits of the same length [s]; Infinity leaves them out. */
  readonly waitsFrom_s: number;
  /**
   * Straights take exactly as long as the hand took; otherwise they go at its mean speed, which every language can say.
   */
  readonly exactDurations?: boolean;
  /** Ids begin with it. */
  readonly prefix?: string;
}

/** A hand that hardly moved makes no step slower than this, and none faster [m/s]. */
const SLOWEST_MPS = 0.005;
const FASTEST_MPS = 1.5;

/**
 * The steps of a filtered demonstration: PTP to the first point, then with the hand's own timing: a straight
 * is one LIN and a curve a chain of splines at the hand's mean speed there, a stop of at least
 * `waitsFrom_s` a wait, and a change of the grip a gripper step.
 */
export function stepsOfDemonstration(
  demonstration: Demonstration,
  filtered: FilteredDemonstration,
  options: DemonstratedSteps,
): Step[] {
  const { times_s, worldFromTcp, closed } = demonstration;
  const { prefix = "d" } = options;
  const frameFromWorld = inverse(options.worldFromFrame);
  const steps: Step[] = [];
  const id = (): string => `${prefix}${steps.length + 1}`;
  const moveTo = (pose: Pose<"world", "tcp">, path: MoveStep["path"], speed: MoveStep["speed"], blend_m = 0): void => {
    steps.push({
      id: id(),
      type: "move",
      path,
      target: {
        pose: compose(frameFromWorld, pose) as Pose<"frame", "tcp">,
        frame: options.frame,
        tool: options.tool,
      },
      speed,
      blend_m,
    });
  };
  const poseAt = (i: number): Pose<"world", "tcp"> => stopAt(filtered.parts, i)?.pose ?? worldFromTcp[i]!;

  moveTo(poseAt(0), "ptp", options.approach);
  let holds = closed[0] ?? false;
  if (holds) steps.push({ id: id(), type: "gripper", closed: true });
  for (const part of filtered.parts) {
    const took_s = times_s[part.last]! - times_s[part.first]!;
    if (part.kind === "straight") {
      const [from, to] = [poseAt(part.first), poseAt(part.last)];
      const speed = handSpeed(distance(from.position, to.position), took_s);
      moveTo(to, "lin", options.exactDurations ? { time_s: took_s } : speed);
    } else if (part.kind === "curve") {
      const points = pointsOnBeziers(part.beziers, part.perCurve);
      const length_m = points.slice(1).reduce((sum, point, i) => sum + distance(points[i]!, point), 0);
      const speed = handSpeed(length_m, took_s);
      const from = poseAt(part.first);
      const to = poseAt(part.last);
      points.slice(1).forEach((position, i) => {
        const turned = slerp(from.quaternion, to.quaternion, (i + 1) / (points.length - 1));
        moveTo({ position, quaternion: turned }, "spline", speed);
      });
    } else {
      for (let i = part.first; i <= part.last; i++) {
        if (closed[i] === holds) continue;
        holds = closed[i]!;
        steps.push({ id: id(), type: "gripper", closed: holds });
      }
      if (took_s >= options.waitsFrom_s) steps.push({ id: id(), type: "wait", s: Number(took_s.toPrecision(3)) });
    }
  }
  return steps;
}

/** Mean speed of the hand, within what a robot can be told, to three digits. */
const handSpeed = (length_m: number, took_s: number): { readonly mps: number } => ({
  mps: Number(Math.min(FASTEST_MPS, Math.max(SLOWEST_MPS, length_m / took_s)).toPrecision(3)),
});

/** The stop that a sample belongs to: its mean pose is what is taught. */
const stopAt = (parts: readonly FilteredPart[], i: number): Extract<FilteredPart, { kind: "stop" }> | undefined =>
  parts.find(
    (part): part is Extract<FilteredPart, { kind: "stop" }> =>
      part.kind === "stop" && part.first <= i && i <= part.last,
  );
