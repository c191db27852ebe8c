import type { Pallet, PalletOrder } from "../../program/pallet.ts";
import type { Program, Speed, Step } from "../../program/program.ts";
import { compose, identity, inverse, transformPoint, type Pose } from "../../spatial/pose.ts";
import { conjugate, fromAxisAngle, multiply, rotate, type Quaternion } from "../../spatial/quaternion.ts";
import { distance, type Vector3 } from "../../spatial/vector.ts";
import type { Demonstration } from "./demonstration.ts";
import { fittedGrid, type FittedGrid, type FittedLine, type GridRule } from "./grid.ts";
import { gripsOf, meanOf, snappedRotation, type Grip } from "./grips.ts";

/** A box of the cell: what can be picked, or what parts are laid on. z of its frame points up. */
export interface SceneBox {
  readonly name: string;
  /** Its middle. */
  readonly worldFromBox: Pose<"world", "box">;
  readonly size_m: Vector3;
}
export interface InferOptions {
  /** What may be picked, and what may be laid on. A box may be in both. */
  readonly parts: readonly SceneBox[];
  readonly surfaces: readonly SceneBox[];
  /** How many places there are in all; undefined: as the grid says that explains best what was shown. */
  readonly places?: number | undefined;
  /** Of the program that is made. */
  readonly tool: string;
  readonly flangeFromTcp: Pose<"flange", "tcp">;
  readonly robot: string;
  readonly name: string;
}

/** How the tool holds the part: in the middle of its top, straight, or as it was shown. */
export type GraspRule = "middle" | "shown";

export interface InferredPallet {
  readonly kind: "program";
  readonly program: Program;
  readonly pallet: Pallet;
  readonly surface: string;
  readonly part: string;
  readonly grasp: GraspRule;
  readonly rules: readonly [GridRule, GridRule];
  readonly places: number;
  /** How far each shown placement was from the place that it stands for [m]. */
  readonly off_m: readonly number[];
  readonly approach_m: number;
}
export type InferRefusal =
  /** The gripper never closes and then opens. */
  | { readonly kind: "refused"; readonly why: "no-cycle" }
  /** Nothing that can be picked is where the gripper closed. */
  | { readonly kind: "refused"; readonly why: "no-part"; readonly position_m: Vector3 }
  /** The parts were picked further apart than one feeder is. */
  | { readonly kind: "refused"; readonly why: "several-feeders"; readonly apart_m: number }
  /** The part was not put on a surface of the cell. */
  | { readonly kind: "refused"; readonly why: "no-surface"; readonly position_m: Vector3 }
  /** So many parts do not fit, or two placements are on one place. */
  | { readonly kind: "refused"; readonly why: "no-grid"; readonly places: number | undefined }
  /** The nearest grid is further from what was shown than a hand is. */
  | { readonly kind: "refused"; readonly why: "irregular"; readonly off_m: number };

/** The hand may miss a place or the part by this much, and turn by this much [m], [rad]. */
const HAND_REACH_M = 0.025;
const HAND_TURN_RAD = (12 * Math.PI) / 180;
/** Further than this from every grid is no grid [m]. */
const MOST_OFF_M = 0.012;
const LEAST_APPROACH_M = 0.03;
const MOST_APPROACH_M = 0.3;
const APPROACH_STEP_M = 0.01;
const FREE: Speed = { ratio: 0.5 };
const NEAR: Speed = { mps: 0.1 };

/**
 * A whole palletising program from one or two shown pick-and-places (rows M-54, L-32): what the part is held by,
 * which surface it goes to, the grid that explains the placements best, the way in and out. The cell says what the
 * hand cannot show precisely: how large the part and the surface are and where they stand. Steps of the program, one
 * pallet among them with eight inside:
 *
 *   above the part, down, close, up | above the place, down, open, up
 *
 * @param demonstration  one or more cycles, the first of them on the first place; order and corner of the pallet
 *   follow from the second.
 */
export function inferPallet(demonstration: Demonstration, options: InferOptions): InferredPallet | InferRefusal {
  const cycles = cyclesOf(gripsOf(demonstration));
  const [first] = cycles;
  if (!first) return { kind: "refused", why: "no-cycle" };
  const picks = cycles.map(({ pick }) => pick.pose);
  const apart_m = Math.max(...picks.map(({ position }) => distance(position, picks[0]!.position)));
  if (apart_m > HAND_REACH_M) return { kind: "refused", why: "several-feeders", apart_m };
  const worldFromPick = meanOf(picks);
  const part = partAt(options.parts, worldFromPick.position);
  if (!part) return { kind: "refused", why: "no-part", position_m: worldFromPick.position };
  const grasp = graspOf(part, worldFromPick);

  const surface = surfaceUnder(options.surfaces, part, first.place.pose.position);
  if (!surface) return { kind: "refused", why: "no-surface", position_m: first.place.pose.position };
  const worldFromSurface = topOf(surface);
  const surfaceFromWorld = inverse(worldFromSurface);
  const seen = cycles.map(({ place }) => compose(surfaceFromWorld, place.pose) as Pose<"surface", "tcp">);
  const turn = snappedRotation(
    multiply(meanOf(seen as unknown as Pose<"world", "tcp">[]).quaternion, conjugate(grasp.partFromTcp.quaternion)),
    QUARTERS,
    HAND_TURN_RAD,
  );
  const held = rotate(turn, grasp.partFromTcp.position);
  const put = seen.map(({ position }): Vector3 => [0, 1, 2].map(k => position[k]! - held[k]!) as Vector3);
  const quarter = QUARTERS.indexOf(turn as (typeof QUARTERS)[number]);
  const [long, wide, height_m] = part.size_m;
  const footprint: readonly [number, number] = quarter % 2 === 1 ? [wide, long] : [long, wide];
  const grid = fittedGrid(
    [surface.size_m[0], surface.size_m[1]],
    footprint,
    put.map(([x, y]) => [x, y]),
    options.places,
  );
  if (!grid) return { kind: "refused", why: "no-grid", places: options.places };
  const off_m = put.map(([x, y], i) => Math.hypot(x - placeOf(grid.x, i), y - placeOf(grid.y, i)));
  if (Math.max(...off_m) > MOST_OFF_M) return { kind: "refused", why: "irregular", off_m: Math.max(...off_m) };

  const approach_m = approachOf(cycles);
  const frame = surface.name;
  // No pallet has the name of a frame.
  const places = `${frame} places`;
  const pallet = palletOf(frame, grid, turn, height_m / 2);
  const worldFromPart = part.worldFromBox as Pose<string, string> as Pose<"world", "part">;
  const steps = cycleSteps(
    { pose: compose(worldFromPart, grasp.partFromTcp) as Pose<"world", "tcp">, frame: "world" },
    { pose: grasp.partFromTcp, frame: places },
    approach_m,
    options.tool,
  );
  return {
    kind: "program",
    program: {
      format: "twincell.program",
      version: 1,
      name: options.name,
      robot: options.robot,
      tools: { [options.tool]: options.flangeFromTcp },
      frames: { [frame]: worldFromSurface as Pose<string, string> as Pose<"world", "frame"> },
      groups: {},
      signals: {},
      pallets: { [places]: pallet },
      routines: {},
      steps: [{ id: "pallet-1", type: "pallet", pallet: places, steps }],
    },
    pallet,
    surface: surface.name,
    part: part.name,
    grasp: grasp.rule,
    rules: [grid.x.rule, grid.y.rule],
    places: grid.x.count * grid.y.count,
    off_m,
    approach_m,
  };
}

const UP: Vector3 = [0, 0, 1];
const QUARTERS: readonly Quaternion[] = [0, 1, 2, 3].map(k => fromAxisAngle(UP, (k * Math.PI) / 2));
/** The tool over a part: its z down, turned by quarters. */
const STRAIGHT_DOWN: readonly Quaternion[] = QUARTERS.map(turn => multiply(turn, [1, 0, 0, 0]));

interface Cycle {
  readonly pick: Grip;
  readonly place: Grip;
}
function cyclesOf(grips: readonly Grip[]): Cycle[] {
  const cycles: Cycle[] = [];
  grips.forEach((place, i) => {
    const pick = grips[i - 1];
    if (pick?.closed === true && !place.closed) cycles.push({ pick, place });
  });
  return cycles;
}

const topOf = ({ worldFromBox, size_m }: SceneBox): Pose<"world", "surface"> =>
  compose(worldFromBox, { position: [0, 0, size_m[2] / 2], quaternion: [0, 0, 0, 1] } as Pose<"box", "surface">);

/** The part that the tool is at: of those at most a hand's reach away, the one with the nearest top. */
function partAt(parts: readonly SceneBox[], tool: Vector3): SceneBox | undefined {
  let best: SceneBox | undefined;
  let nearest = Infinity;
  for (const part of parts) {
    const at = transformPoint(inverse(part.worldFromBox), tool);
    if (at.some((value, k) => Math.abs(value) > part.size_m[k]! / 2 + HAND_REACH_M)) continue;
    const off = Math.hypot(at[0], at[1], at[2] - part.size_m[2] / 2);
    if (off >= nearest) continue;
    nearest = off;
    best = part;
  }
  return best;
}

/** The tool in the part's frame: in the middle of the top and straight where the hand meant that. */
function graspOf(
  part: SceneBox,
  worldFromTcp: Pose<"world", "tcp">,
): { readonly rule: GraspRule; readonly partFromTcp: Pose<"part", "tcp"> } {
  const shown = compose(inverse(part.worldFromBox), worldFromTcp);
  const quaternion = snappedRotation(shown.quaternion, STRAIGHT_DOWN, HAND_TURN_RAD);
  const [x, y, z] = shown.position;
  const middle = Math.hypot(x, y) <= MOST_OFF_M;
  const top_m = part.size_m[2] / 2;
  const height = Math.abs(z - top_m) <= MOST_OFF_M ? top_m : z;
  return {
    rule: middle ? "middle" : "shown",
    partFromTcp: { position: middle ? [0, 0, height] : [x, y, height], quaternion },
  };
}

/** The surface that a part lies on when the tool is there: the highest under it. */
function surfaceUnder(surfaces: readonly SceneBox[], part: SceneBox, tool: Vector3): SceneBox | undefined {
  let best: SceneBox | undefined;
  let nearest = part.size_m[2] + 2 * HAND_REACH_M;
  for (const surface of surfaces) {
    const [x, y, z] = transformPoint(inverse(topOf(surface)), tool);
    if (Math.abs(x) > surface.size_m[0] / 2 || Math.abs(y) > surface.size_m[1] / 2) continue;
    if (z < -HAND_REACH_M || z > nearest) continue;
    nearest = z;
    best = surface;
  }
  return best;
}

const placeOf = (line: FittedLine, i: number): number => line.first_m + line.slots[i]! * line.pitch_m;

/** Height over part and place: what the hand kept in the middle of all its ways, in whole centimetres. */
function approachOf(cycles: readonly Cycle[]): number {
  const all = cycles.flatMap(({ pick, place }) => [pick.clear_m, place.clear_m]).sort((a, b) => a - b);
  const middle = all[all.length >> 1]!;
  const whole = Math.round(middle / APPROACH_STEP_M) * APPROACH_STEP_M;
  return Math.max(LEAST_APPROACH_M, Math.min(MOST_APPROACH_M, whole));
}

/** Corner and order as they were shown: the first placement is at the corner, the second says where the rows go. */
function palletOf(frame: string, { x, y }: FittedGrid, turn: Quaternion, lift_m: number): Pallet {
  const ends = ({ slots, count, first_m, pitch_m }: FittedLine): readonly [number, number] => {
    const low = first_m;
    const high = first_m + (count - 1) * pitch_m;
    return slots[0]! > (count - 1) / 2 ? [high, low] : [low, high];
  };
  const [x0, x1] = ends(x);
  const [y0, y1] = ends(y);
  const byColumns = x.slots[1] === x.slots[0] && y.slots[1] !== y.slots[0];
  const order: PalletOrder = byColumns ? "columns" : "rows";
  return {
    frame,
    origin: { position: [x0, y0, lift_m], quaternion: turn },
    rowEnd: [x1, y0, lift_m],
    columnEnd: [x0, y1, lift_m],
    rows: y.count,
    columns: x.count,
    layers: 1,
    layer_m: 0,
    order,
  };
}

interface GripPose {
  readonly pose: Pose<string, "tcp">;
  readonly frame: string;
}
function cycleSteps(pick: GripPose, place: GripPose, approach_m: number, tool: string): Step[] {
  const steps: Step[] = [];
  const move = (to: GripPose, above: boolean, path: "ptp" | "lin", speed: Speed): void => {
    const back: Pose<"tcp", "tcp"> = above ? { position: [0, 0, -approach_m], quaternion: [0, 0, 0, 1] } : identity();
    steps.push({
      id: `s${steps.length + 1}`,
      type: "move",
      path,
      target: { pose: compose(to.pose, back) as Pose<"frame", "tcp">, frame: to.frame, tool },
      speed,
      blend_m: 0,
    });
  };
  for (const [to, closed] of [
    [pick, true],
    [place, false],
  ] as const) {
    move(to, true, "ptp", FREE);
    move(to, false, "lin", NEAR);
    steps.push({ id: `s${steps.length + 1}`, type: "gripper", closed });
    move(to, true, "lin", NEAR);
  }
  return steps;
}
