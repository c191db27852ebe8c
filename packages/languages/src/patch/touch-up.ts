import {
  angleBetween,
  branchOf,
  compose,
  degrees,
  distance,
  emptyProgram,
  flangePose,
  identity,
  inverse,
  millimetres,
  type Dialect,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Target,
} from "@twincell/core";
import { applyEdits, editsOf, type TextEdit } from "./rewrite.ts";
import { findPoints } from "./find.ts";
import type { PatchFile, TextPoint } from "./points.ts";

export type TouchedUp =
  | {
      readonly kind: "touched-up";
      readonly files: readonly PatchFile[];
      /** What changed; nothing when the point says the same already. */
      readonly edits: readonly TextEdit[];
      /** Motions that go to this point: all of them go to the new place. */
      readonly uses: number;
    }
  | { readonly kind: "refused"; readonly sentence: string; readonly hint: string };

/** Lengths in metres, angles in radians or parts of a quaternion. */
const FINE: Readonly<Record<string, RegExp>> = { urscript: /./, rapid: /^Q/ };
const NONE = /^$/;
/** A point of fewer numbers is no place of a six-axis arm. */
const REQUIRED = 6;

interface Written {
  readonly point: TextPoint;
  readonly text: string;
}

/**
 * Rewrites one point so that the robot stands at `q_rad` there: its numbers in the tool and frame of the motion that
 * was looked at, its status and turns of that configuration, and nothing else of the text. The numbers are those that
 * the language's own emitter writes; external axes stay.
 *
 * @param move  the motion as the text was executed, with the tools and frames of that moment.
 */
export function touchUpPoint(
  dialect: Dialect,
  files: readonly PatchFile[],
  point: TextPoint,
  move: MoveStep,
  context: Pick<Program, "tools" | "frames">,
  robot: Robot,
  q_rad: readonly number[],
  worldFromBase: Pose<"world", "base"> = identity(),
): TouchedUp {
  const refused = (sentence: string, hint: string): TouchedUp => ({ kind: "refused", sentence, hint });
  const called = point.name === "" ? `the point of line ${point.value.line}` : point.name;
  if (point.fixed !== undefined) return refused(point.fixed, "Change the numbers in the text itself.");
  if (q_rad.length !== robot.arm.joints.length)
    return refused(
      `${q_rad.length} joint values are given; ${robot.name} has ${robot.arm.joints.length} joints.`,
      "Give one value for each joint.",
    );
  const target = targetAt(point, move.target, context, robot, q_rad, worldFromBase);
  if (target === undefined)
    return refused(
      `${called} is ${point.kind === "joints" ? "of joint angles" : "a pose"}, but the motion was executed in a frame that the text does not name.`,
      "Touch the point up on a motion that goes straight to it.",
    );
  let model: Written | undefined;
  let sentence: string | undefined;
  // A joint motion says status and turns; a language that names no posture writes the bare pose in a straight one.
  for (const path of ["ptp", "lin"] as const) {
    const said = emitted(dialect, path, target, context, robot, q_rad, worldFromBase);
    sentence ??= said.sentence;
    const found = findPoints(dialect.id, said.files);
    if (found.kind === "not-yet") return refused(found.because, "Change the numbers in the text itself.");
    const written = found.points.find(
      each => each.kind === point.kind && each.uses.some(use => use.whole) && each.fields.length >= REQUIRED,
    );
    if (written === undefined) continue;
    model = { point: written, text: said.files[written.value.file]!.text };
    break;
  }
  if (model === undefined)
    return refused(
      sentence ?? `${dialect.name} writes this place in another form than that of ${called}.`,
      "Move the robot to a place that it reaches with this tool and frame.",
    );
  const { text } = model;
  const values = Object.fromEntries(model.point.fields.map(({ key, start, end }) => [key, text.slice(start, end)]));
  const fine = FINE[dialect.id] ?? NONE;
  const edits = editsOf(files, point, values, key => fine.test(key));
  return { kind: "touched-up", files: applyEdits(files, edits), edits, uses: point.uses.length };
}

/** How far two executions of one step are apart, tool tip in the world [m, rad]. */
export function deviationOf(
  a: { readonly target: Target; readonly context: Pick<Program, "tools" | "frames"> },
  b: { readonly target: Target; readonly context: Pick<Program, "tools" | "frames"> },
  robot: Robot,
  worldFromBase: Pose<"world", "base"> = identity(),
): { readonly position_m: number; readonly angle_rad: number } {
  const [first, second] = [a, b].map(({ target, context }) => tipOf(target, context, robot, worldFromBase));
  return {
    position_m: distance(first!.position, second!.position),
    angle_rad: angleBetween(first!.quaternion, second!.quaternion),
  };
}

/** "2.0 mm and 0.1°": how far a touch-up moved a point. */
export const deviationText = ({ position_m, angle_rad }: ReturnType<typeof deviationOf>): string =>
  `${millimetres(position_m).toFixed(1)} mm and ${degrees(angle_rad).toFixed(1)}°`;

const worldFromFrame = ({ frames }: Pick<Program, "frames">, frame: string): Pose<"world", "frame"> | undefined =>
  frame === "world" ? identity() : frames[frame];

const toolOf = ({ tools }: Pick<Program, "tools">, tool = "flange"): Pose<"flange", "tcp"> =>
  tool === "flange" ? identity() : (tools[tool] ?? identity());

function tipOf(
  target: Target,
  context: Pick<Program, "tools" | "frames">,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
): Pose<"world", "tcp"> {
  return "q" in target
    ? compose(compose(worldFromBase, flangePose(robot.arm, target.q)), toolOf(context, target.tool))
    : compose(worldFromFrame(context, target.frame) ?? identity(), target.pose);
}

function targetAt(
  { kind }: TextPoint,
  at: Target,
  context: Pick<Program, "tools" | "frames">,
  robot: Robot,
  q_rad: readonly number[],
  worldFromBase: Pose<"world", "base">,
): Target | undefined {
  const tool = at.tool ?? "flange";
  if (kind === "joints") return { q: q_rad, tool };
  if ("q" in at) return undefined;
  const frame = worldFromFrame(context, at.frame);
  if (frame === undefined) return undefined;
  const tip = tipOf({ q: q_rad, tool }, context, robot, worldFromBase);
  const branch = branchOf(robot, q_rad);
  return {
    pose: compose(inverse(frame), tip),
    frame: at.frame,
    tool,
    ...(branch === undefined ? {} : { branch }),
  };
}

/**
 * A program of that one motion, by the language's emitter, for a robot that stands there already: so turns are those of
 * `q_rad`.
 */
function emitted(
  dialect: Dialect,
  path: "ptp" | "lin",
  wanted: Target,
  { tools, frames }: Pick<Program, "tools" | "frames">,
  robot: Robot,
  q_rad: readonly number[],
  worldFromBase: Pose<"world", "base">,
): { readonly files: readonly PatchFile[]; readonly sentence?: string } {
  const target: Target =
    path === "ptp" || "q" in wanted ? wanted : { pose: wanted.pose, frame: wanted.frame, tool: wanted.tool };
  const speed = path === "ptp" ? { ratio: 0.1 } : { mps: 0.1 };
  const step: MoveStep = { id: "point", type: "move", path, target, speed, blend_m: 0 };
  const program: Program = { ...emptyProgram(robot.id, "POINT"), tools, frames, steps: [step] };
  const answer = dialect.emit(program, { ...robot, home_rad: q_rad }, worldFromBase);
  return answer.kind === "emitted" ? { files: answer.files } : { files: [], sentence: answer.sentence };
}
