import type { TriangleMesh } from "../../mesh/mesh.ts";
import { addScaled, cross, type Vector3 } from "../../spatial/vector.ts";
import type { FormLoft, FormRing, PartMaterial } from "../../model/form.ts";
import type { LinkDesign, LinkPart } from "./link-shape.ts";
import { bolts, loft, type Frame, type Ring } from "./loft.ts";
import type { Point2 } from "./outline.ts";

/** Corners are never sharper than this: castings are not [m]. */
const LEAST_RADIUS_M = 0.0008;
const FRAMES: Readonly<Record<FormLoft["along"], Frame>> = {
  x: { origin: [0, 0, 0], u: [0, 1, 0], v: [0, 0, 1] },
  y: { origin: [0, 0, 0], u: [0, 0, 1], v: [1, 0, 0] },
  z: { origin: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0] },
};

/** What is drawn of a link of lofts, seen from the link, and the shells around it. */
export function loftedLink(material: PartMaterial, lofts: readonly FormLoft[]): LinkDesign {
  const parts = lofts.map(
    (each, i): LinkPart => ({
      name: `casting ${i + 1}`,
      material: each.material ?? material,
      mesh: loft(
        FRAMES[each.along],
        rounded(each).map(({ ring, inset_m }) => drawn(ring, inset_m, 9, 1)),
      ),
    }),
  );
  for (const each of lofts)
    if (each.bolts !== undefined) parts.push({ name: "bolts", material: "metal", mesh: screws(each, each.bolts) });
  return { parts, shells: lofts.map(shellOf) };
}

/** Radius and height of a screw's head [m]. */
const HEAD_M = 0.0032;
const HEAD_HEIGHT_M = 0.0014;

/** Screw heads on the rounded end of a round casting. */
function screws({ along, ends, rings }: FormLoft, count: number): TriangleMesh {
  const top = ends[1] > 0;
  const [w, u0, u1, v0, v1] = top ? rings.at(-1)! : rings[0]!;
  const frame = FRAMES[along];
  const origin: Vector3 = addScaled(
    addScaled(addScaled([0, 0, 0], frame.u, (u0 + u1) / 2000), frame.v, (v0 + v1) / 2000),
    cross(frame.u, frame.v),
    w / 1000,
  );
  return bolts(
    top ? { ...frame, origin } : { origin, u: frame.v, v: frame.u },
    count,
    ((u1 - u0) / 2000) * 0.84,
    HEAD_M,
    HEAD_HEIGHT_M + 0.001,
  );
}

/** Around the drawn loft: the corners of a polygon with few sides lie outside the arc. */
function shellOf({ along, rings, ends, bolts: heads }: FormLoft): TriangleMesh {
  const steps = 3;
  const [w, ...first] = rings[0]!;
  const [wEnd, ...last] = rings.at(-1)!;
  const head = heads === undefined ? 0 : 1000 * HEAD_HEIGHT_M;
  const around: FormRing[] = [
    [w - (ends[1] > 0 ? 0 : head), ...first],
    ...rings.slice(1, -1),
    [wEnd + (ends[1] > 0 ? head : 0), ...last],
  ];
  return loft(
    FRAMES[along],
    around.map(ring => drawn(ring, 0, steps, 1 / Math.cos(Math.PI / 4 / steps))),
  );
}

interface Turned {
  readonly ring: FormRing;
  readonly inset_m: number;
}

/** The rings with both end edges rounded: a quarter arc in three steps. */
function rounded({ rings, ends }: FormLoft): Turned[] {
  const out: Turned[] = rings.map(ring => ({ ring, inset_m: 0 }));
  const first = rings[0]!;
  const last = rings.at(-1)!;
  const length = last[0] - first[0];
  const at = (w: number): FormRing => ringAt(rings, w);
  const radiusOf = (ring: FormRing, wanted: number): number =>
    Math.min(wanted, 0.3 * length, 0.3 * (ring[2] - ring[1]), 0.3 * (ring[4] - ring[3]));
  const low = radiusOf(first, ends[0]);
  const high = radiusOf(last, ends[1]);
  const arc = (radius: number, from: number, sign: 1 | -1): Turned[] =>
    [0, 1, 2, 3].map(k => {
      const angle = (k * Math.PI) / 6;
      const w = from + sign * radius * (1 - Math.sin(angle));
      return { ring: [w, ...at(w).slice(1)] as unknown as FormRing, inset_m: (radius * (1 - Math.cos(angle))) / 1000 };
    });
  const middle = out.filter(({ ring }) => ring[0] > first[0] + low + 1e-6 && ring[0] < last[0] - high - 1e-6);
  const start = low > 0 ? arc(low, first[0], 1).toReversed() : [out[0]!];
  const end = high > 0 ? arc(high, last[0], -1) : [out.at(-1)!];
  return [...start, ...middle, ...end];
}

/** The loft between its rings, all numbers in a straight line. */
function ringAt(rings: readonly FormRing[], w: number): FormRing {
  const next = Math.max(
    1,
    rings.findIndex(ring => ring[0] >= w),
  );
  const a = rings[next - 1]!;
  const b = rings[next] ?? a;
  const t = b[0] === a[0] ? 0 : (w - a[0]) / (b[0] - a[0]);
  return a.map((value, k) => value + t * (b[k]! - value)) as unknown as FormRing;
}

/** Points of a ring, counter-clockwise from the middle of its +u side. */
function drawn([w, u0, u1, v0, v1, ...radii]: FormRing, inset_m: number, steps: number, factor: number): Ring {
  const lowU = u0 / 1000 + inset_m;
  const highU = u1 / 1000 - inset_m;
  const lowV = v0 / 1000 + inset_m;
  const highV = v1 / 1000 - inset_m;
  const half = Math.min(highU - lowU, highV - lowV) / 2;
  const points: Point2[] = [];
  // Corners in the order of their angle: (u1, v1), (u0, v1), (u0, v0), (u1, v0).
  [2, 3, 0, 1].forEach((corner, quarter) => {
    const r = Math.min(half, Math.max(LEAST_RADIUS_M, radii[corner]! / 1000 - inset_m));
    const cu = corner === 1 || corner === 2 ? highU - r : lowU + r;
    const cv = corner > 1 ? highV - r : lowV + r;
    for (let k = 0; k <= steps; k++) {
      const angle = ((quarter + k / steps) * Math.PI) / 2;
      points.push([cu + factor * r * Math.cos(angle), cv + factor * r * Math.sin(angle)]);
    }
  });
  return { points, w_m: w / 1000 };
}
