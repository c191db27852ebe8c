import type { SerialArm } from "../model/arm.ts";
import { isSlide, slideOf } from "../model/slide.ts";
import { mergeMeshes } from "../mesh/assemble.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import { norm, type Vector3 } from "../spatial/vector.ts";
import type { CellGeometry, CellObject } from "./cell.ts";
import type { TriangleMesh } from "../mesh/mesh.ts";
import { rigid, rigidFromPose, type Rigid } from "./relative.ts";
import { buildSolid, type Solid } from "./solid.ts";

/**
 * Trees already built, kept as long as their meshes are: the same mesh twice in a cell, or a cell edited, costs
 * nothing.
 */
export class SolidCache {
  readonly #solids = new WeakMap<TriangleMesh, Solid>();

  of(mesh: TriangleMesh): Solid {
    const known = this.#solids.get(mesh);
    if (known) return known;
    const built = buildSolid(mesh);
    this.#solids.set(mesh, built);
    return built;
  }
}

/** What stands in the world and is carried by no link. */
export const WORLD = -1;

/** One solid of the cell: a link, the tool or an object, and where it is now. */
export interface Body {
  /** "link 4", "tool" or the id of an object. */
  readonly name: string;
  readonly kind: "link" | "tool" | "object";
  readonly solid: Solid;
  /** The link it moves with, or WORLD. */
  carrier: number;
  /** Pose of the solid in its carrier. */
  readonly carrierFromBody: Pose;
  readonly worldFromBody: Rigid;
  /** World box around it: centre and half lengths [m]. */
  readonly box: Float64Array;
  /**
   * reach_m[k]: no point of the solid is ever farther than this from the axis of joint k + 1, whatever the joints
   * after it do [m]. Empty for what stands in the world.
   */
  reach_m: readonly number[];
}

export function bodiesOf(cell: CellGeometry, arm: SerialArm, solidCache: SolidCache): Body[] {
  const bodies: Body[] = [];
  for (const link of [...new Set(cell.links.map(solid => solid.link))].sort((a, b) => a - b)) {
    const meshes = cell.links.filter(solid => solid.link === link).map(solid => solid.mesh);
    bodies.push(
      body(
        `link ${link}`,
        "link",
        meshes.length === 1 ? meshes[0]! : mergeMeshes(meshes.map(mesh => ({ mesh }))),
        solidCache,
        link,
        identity(),
      ),
    );
  }
  if (cell.tool)
    bodies.push(
      body(
        "tool",
        "tool",
        cell.tool.mesh,
        solidCache,
        arm.joints.length,
        compose(arm.lastJointFromFlange as Pose, identity()),
      ),
    );
  for (const object of cell.objects) bodies.push(objectBody(object, solidCache));
  for (const each of bodies) each.reach_m = reachesOf(each, arm);
  return bodies;
}

export const objectBody = ({ id, mesh, worldFromObject }: CellObject, solidCache: SolidCache): Body =>
  body(id, "object", mesh, solidCache, WORLD, compose(identity(), worldFromObject as Pose));

function body(
  name: string,
  kind: Body["kind"],
  mesh: TriangleMesh,
  solidCache: SolidCache,
  carrier: number,
  carrierFromBody: Pose,
): Body {
  return {
    name,
    kind,
    solid: solidCache.of(mesh),
    carrier,
    carrierFromBody,
    worldFromBody: rigid(),
    box: new Float64Array(6),
    reach_m: [],
  };
}

/** Moves a body to where its carrier is, and its world box with it. `scratch` is overwritten. */
export function placeBody(body: Body, worldFromCarrier: Pose, scratch: Pose): void {
  const m = rigidFromPose(compose(worldFromCarrier, body.carrierFromBody, scratch), body.worldFromBody);
  const root = body.solid.bvh.boxes;
  const box = body.box;
  for (let r = 0; r < 3; r++) {
    const x = m[3 * r]!;
    const y = m[3 * r + 1]!;
    const z = m[3 * r + 2]!;
    box[r] = x * root[0]! + y * root[1]! + z * root[2]! + m[9 + r]!;
    box[3 + r] = Math.abs(x) * root[3]! + Math.abs(y) * root[4]! + Math.abs(z) * root[5]! + 1e-9;
  }
}

/** Whether two world boxes are farther apart than `gap_m` along some axis. */
export function farApart(a: Float64Array, b: Float64Array, gap_m: number): boolean {
  return (
    Math.abs(a[0]! - b[0]!) - a[3]! - b[3]! > gap_m ||
    Math.abs(a[1]! - b[1]!) - a[4]! - b[4]! > gap_m ||
    Math.abs(a[2]! - b[2]!) - a[5]! - b[5]! > gap_m
  );
}

/**
 * Bounds on the distance from joint axes, base first:
 *   ρ_k = |p⊥_{k+1}| + R_{k+1},  R_m = |p_{m+1}| + R_{m+1} + slide_m,
 * and 1 for a joint that slides, which moves every point by what it moves itself; where p_{m+1} is joint m + 1 seen
 * from joint m, p⊥ its part across the axis, and R of the carrier the body's own radius.
 */
export function reachesOf({ carrier, carrierFromBody, solid }: Body, arm: SerialArm): number[] {
  const reaches = new Array<number>(Math.max(0, carrier)).fill(0);
  let ball_m = norm(carrierFromBody.position) + solid.radius_m;
  for (let k = carrier; k >= 1; k--) {
    const joint = arm.joints[k - 1]!;
    const next = k === carrier ? carrierFromBody.position : arm.joints[k]!.parentFromJoint.position;
    const rest = k === carrier ? solid.radius_m : ball_m;
    reaches[k - 1] = isSlide(joint) ? 1 : across(next, joint.axis) + rest;
    if (k < carrier) ball_m += norm(next);
    ball_m += slideOf([joint]);
  }
  return reaches;
}

/** Length of the part of v across the unit vector. */
function across(v: Vector3, unit: Vector3): number {
  const along = v[0] * unit[0] + v[1] * unit[1] + v[2] * unit[2];
  return Math.sqrt(Math.max(0, v[0] * v[0] + v[1] * v[1] + v[2] * v[2] - along * along));
}
