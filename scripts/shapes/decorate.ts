// Covers over the bearings and a mark on the links that turn about themselves, found on the voxels of the links.
import { rotate, type FormLoft, type Robot, type Vector3 } from "@twincell/core";
import type { Voxels } from "./voxels.ts";

const AXES = ["x", "y", "z"] as const;
const CAP_MM = 2.5;
const EVEN_M = 0.003;
type Lofts = FormLoft[][];

/** The axis of the link's frame that a direction runs along, and which way; undefined when it runs along none. */
function alignedTo(direction: Vector3): { readonly axis: number; readonly way: 1 | -1 } | undefined {
  const axis = direction.findIndex(value => Math.abs(value) > 0.999);
  return axis < 0 ? undefined : { axis, way: direction[axis]! > 0 ? 1 : -1 };
}

/** Where a ray along an axis first meets the link, coming from the `way` side; undefined when it passes [m]. */
function meets(
  { solid, count, origin, pitch_m }: Voxels,
  axis: number,
  way: 1 | -1,
  at: readonly number[],
): number | undefined {
  const cell = at.map((value, k) => Math.floor((value - origin[k]!) / pitch_m));
  const step = [count[1] * count[2], count[2], 1];
  if (cell.some((value, k) => k !== axis && (value < 0 || value >= count[k]!))) return undefined;
  for (let i = way > 0 ? count[axis]! - 1 : 0; i >= 0 && i < count[axis]!; i -= way) {
    cell[axis] = i;
    if (solid[cell[0]! * step[0]! + cell[1]! * step[1]! + cell[2]!] === 1)
      return origin[axis]! + pitch_m * (i + (way > 0 ? 0.75 : 0.25));
  }
  return undefined;
}

/** The widest disc around the axis on which the link is even. */
function disc(
  voxels: Voxels,
  axis: number,
  way: 1 | -1,
  centre: Vector3,
): { readonly w: number; readonly radius: number } | undefined {
  const w = meets(voxels, axis, way, centre);
  const iu = (axis + 1) % 3;
  const iv = (axis + 2) % 3;
  if (w === undefined) return undefined;
  let radius = 0;
  for (let r = 0.004; r < 0.15; r += 0.004) {
    let even = 0;
    for (let k = 0; k < 24; k++) {
      const at = [...centre];
      const angle = (k * Math.PI) / 12;
      at[iu]! += r * Math.cos(angle);
      at[iv]! += r * Math.sin(angle);
      const hit = meets(voxels, axis, way, at);
      if (hit !== undefined && Math.abs(hit - w) < EVEN_M) even++;
    }
    if (even < 22) break;
    radius = r;
  }
  return { w, radius };
}

/** A cover over each bearing of the named joints, on both sides, on whichever of its two links lies outside. */
export function addCovers(
  robot: Robot,
  voxels: readonly Voxels[],
  joints: readonly number[],
  lofts: Lofts,
  material: "dark" | "cover",
): void {
  for (const number of joints) {
    const joint = robot.arm.joints[number - 1]!;
    const { position, quaternion } = joint.parentFromJoint;
    const sides = [1, -1]
      .flatMap(way => [
        { link: number, centre: [0, 0, 0] as Vector3, direction: joint.axis.map(value => value * way) as Vector3, way },
        {
          link: number - 1,
          centre: position,
          direction: rotate(quaternion, joint.axis).map(value => value * way) as Vector3,
          way,
        },
      ])
      .map(side => {
        const aligned = alignedTo(side.direction);
        const found = aligned && disc(voxels[side.link]!, aligned.axis, aligned.way, side.centre);
        return {
          ...side,
          aligned,
          found,
          out: found && aligned ? (found.w - side.centre[aligned.axis]!) * aligned.way : -Infinity,
        };
      });
    for (const way of [1, -1]) {
      const [best] = sides.filter(side => side.way === way).sort((a, b) => b.out - a.out);
      if (best?.aligned === undefined || best.found === undefined || best.found.radius < 0.016) continue;
      const { axis, way: up } = best.aligned;
      const r = Math.round(820 * best.found.radius);
      const w = 1000 * best.found.w;
      const [cu, cv] = [(axis + 1) % 3, (axis + 2) % 3].map(k => Math.round(1000 * best.centre[k]!)) as [
        number,
        number,
      ];
      const ring = (at: number): FormLoft["rings"][number] => [
        Math.round(10 * at) / 10,
        cu - r,
        cu + r,
        cv - r,
        cv + r,
        r,
        r,
        r,
        r,
      ];
      const [from, to] = up > 0 ? [w - 2, w + CAP_MM] : [w - CAP_MM, w + 2];
      lofts[best.link]!.push({
        along: AXES[axis]!,
        ends: up > 0 ? [0, 1] : [1, 0],
        rings: [ring(from), ring(to)],
        material,
        ...(r >= 24 ? { bolts: r >= 45 ? 8 : 6 } : {}),
      });
    }
  }
}

/** A white bar on one side of a link that turns about itself (row L-62). */
export function addMark(robot: Robot, voxels: readonly Voxels[], link: number, length_mm: number, lofts: Lofts): void {
  const turning = alignedTo(robot.arm.joints[link - 1]!.axis);
  if (turning === undefined) throw new Error(`Link ${link} of ${robot.name} turns about no axis of its frame.`);
  const { axis } = turning;
  const side = (axis + 1) % 3;
  const v = voxels[link]!;
  const low = v.origin[axis]! + 2 * v.pitch_m;
  const high = v.origin[axis]! + (v.count[axis]! - 3) * v.pitch_m;
  const half = length_mm / 2000;
  let best: { w: number; way: 1 | -1; out: number; spread: number } | undefined;
  for (let w = low + half; w <= high - half; w += 0.001)
    for (const way of [1, -1] as const) {
      const hits = [-half, -half / 2, 0, half / 2, half].map(step => {
        const at = [0, 0, 0];
        at[axis] = w + step;
        return meets(v, side, way, at) ?? 0;
      });
      const outs = hits.map(hit => hit * way);
      const spread = Math.max(...outs) - Math.min(...outs);
      const out = Math.max(...outs);
      if (Math.min(...outs) < 0.012) continue;
      if (best === undefined || spread < best.spread - 0.0005 || (spread < best.spread + 0.0005 && out > best.out))
        best = { w, way, out, spread };
    }
  if (best === undefined && length_mm > 1) {
    addMark(robot, voxels, link, length_mm / 2, lofts);
    return;
  }
  if (best === undefined) throw new Error(`No place for a mark on link ${link} of ${robot.name}.`);
  const w = Math.round(1000 * best.w);
  const inner = Math.round(1000 * best.out) - 4;
  const outer = Math.round(10_000 * best.out) / 10 + 0.8;
  const [u0, u1] = best.way > 0 ? [inner, outer] : [-outer, -inner];
  const r = 1;
  lofts[link]!.push({
    along: AXES[axis]!,
    ends: [1, 1],
    rings: [
      [w - length_mm / 2, u0, u1, -4, 4, r, r, r, r],
      [w + length_mm / 2, u0, u1, -4, 4, r, r, r, r],
    ],
    material: "mark",
  });
}
