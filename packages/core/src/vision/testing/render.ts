import { seededRandom, type Random } from "../../random.ts";
import { distort, type Lens } from "../lens.ts";
import { TAG_MODULES, tagModuleIsWhite } from "../tags.ts";

/** A tag on a plane: its centre in the plane's frame (x right, y up) [m], and its black square's side. */
export interface PlacedTag {
  readonly id: number;
  readonly side_m: number;
  readonly x_m: number;
  readonly y_m: number;
}

export interface Rendering {
  /** Standard deviation of the blur [px] and of the noise [grey levels]. */
  readonly blur_px: number;
  readonly noise: number;
  /** Grey values of the printed black and white, and of what is behind the sheet. */
  readonly black: number;
  readonly white: number;
  readonly behind: number;
}
export const USUAL: Rendering = { blur_px: 0.7, noise: 2, black: 30, white: 220, behind: 128 };
const SUPER = 4;

/**
 * A picture of tags on white paper, drawn by ray: every sub-pixel's ray is undistorted by Newton steps on the forward
 * model (a way of its own, not the detector's), met with the plane, and looked up.
 *
 * @param rotation cameraFromPlane row by row @param position [m]
 */
export function renderTags(
  lens: Lens,
  tags: readonly PlacedTag[],
  rotation: ArrayLike<number>,
  position: ArrayLike<number>,
  how: Rendering = USUAL,
  random: Random = seededRandom(1),
): Uint8Array {
  const { width, height } = lens;
  const image = new Float64Array(width * height).fill(how.behind);
  const R = Array.from(rotation);
  const t = Array.from(position);
  // Plane point (x, y): camera point = R (x, y, 0) + t. Ray d meets it where (x, y) solves [r1 r2 −d] (x, y, s) = −t.
  const n = [R[2]!, R[5]!, R[8]!];
  const nt = n[0]! * t[0]! + n[1]! * t[1]! + n[2]! * t[2]!;
  const box = bounds(lens, tags, R, t);
  const at = [0, 0];
  for (let v = box.top; v <= box.bottom; v++)
    for (let u = box.left; u <= box.right; u++) {
      let sum = 0;
      for (let i = 0; i < SUPER; i++)
        for (let j = 0; j < SUPER; j++) {
          ray(lens, u + (i + 0.5) / SUPER - 0.5, v + (j + 0.5) / SUPER - 0.5, at);
          const s = nt / (n[0]! * at[0]! + n[1]! * at[1]! + n[2]!);
          const px = s * at[0]! - t[0]!;
          const py = s * at[1]! - t[1]!;
          const pz = s - t[2]!;
          const x = R[0]! * px + R[3]! * py + R[6]! * pz;
          const y = R[1]! * px + R[4]! * py + R[7]! * pz;
          sum += valueAt(tags, x, y, how);
        }
      image[width * v + u] = sum / (SUPER * SUPER);
    }
  return quantised(blurred(image, width, height, how.blur_px, box), how.noise, random);
}

function valueAt(tags: readonly PlacedTag[], x: number, y: number, how: Rendering): number {
  for (const tag of tags) {
    const module = tag.side_m / TAG_MODULES;
    const column = Math.floor((x - tag.x_m) / module + TAG_MODULES / 2);
    const row = Math.floor((tag.y_m - y) / module + TAG_MODULES / 2);
    if (column >= 0 && column < TAG_MODULES && row >= 0 && row < TAG_MODULES)
      return tagModuleIsWhite(tag.id, row, column) ? how.white : how.black;
  }
  for (const tag of tags) {
    const half = tag.side_m * 0.65;
    if (Math.abs(x - tag.x_m) < half && Math.abs(y - tag.y_m) < half) return how.white;
  }
  return how.behind;
}

function ray(lens: Lens, u: number, v: number, out: number[]): void {
  const xd = (u - lens.cx) / lens.fx;
  const yd = (v - lens.cy) / lens.fy;
  const rd = Math.hypot(xd, yd);
  let r = rd;
  for (let i = 0; i < 8; i++) {
    const r2 = r * r;
    r -= (r * (1 + r2 * (lens.k1 + r2 * lens.k2)) - rd) / (1 + r2 * (3 * lens.k1 + 5 * r2 * lens.k2));
  }
  const share = rd > 0 ? r / rd : 1;
  out[0] = xd * share;
  out[1] = yd * share;
}

interface Box {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}
function bounds(lens: Lens, tags: readonly PlacedTag[], R: number[], t: number[]): Box {
  const at = new Float64Array(2);
  let [left, right, top, bottom] = [Infinity, -Infinity, Infinity, -Infinity];
  for (const { side_m, x_m, y_m } of tags)
    for (const [cx, cy] of [
      [-1, -1],
      [-1, 1],
      [1, -1],
      [1, 1],
    ] as const) {
      const x = x_m + cx * 0.7 * side_m;
      const y = y_m + cy * 0.7 * side_m;
      const z = R[6]! * x + R[7]! * y + t[2]!;
      distort(lens, (R[0]! * x + R[1]! * y + t[0]!) / z, (R[3]! * x + R[4]! * y + t[1]!) / z, at);
      left = Math.min(left, at[0]!);
      right = Math.max(right, at[0]!);
      top = Math.min(top, at[1]!);
      bottom = Math.max(bottom, at[1]!);
    }
  return {
    left: Math.max(0, Math.floor(left) - 3),
    right: Math.min(lens.width - 1, Math.ceil(right) + 3),
    top: Math.max(0, Math.floor(top) - 3),
    bottom: Math.min(lens.height - 1, Math.ceil(bottom) + 3),
  };
}

/** Blurs what was drawn; about it everything is alike and stays so. */
function blurred(image: Float64Array, width: number, height: number, sigma: number, box: Box): Float64Array {
  if (sigma <= 0) return image;
  const reach = Math.ceil(3 * sigma);
  const kernel = Array.from({ length: 2 * reach + 1 }, (_, i) => Math.exp(-0.5 * ((i - reach) / sigma) ** 2));
  const total = kernel.reduce((sum, value) => sum + value, 0);
  const pass = (from: Float64Array, along: "x" | "y"): Float64Array => {
    const into = from.slice();
    for (let y = Math.max(0, box.top - reach); y <= Math.min(height - 1, box.bottom + reach); y++)
      for (let x = Math.max(0, box.left - reach); x <= Math.min(width - 1, box.right + reach); x++) {
        let sum = 0;
        for (let k = -reach; k <= reach; k++) {
          const u = along === "x" ? Math.min(width - 1, Math.max(0, x + k)) : x;
          const v = along === "y" ? Math.min(height - 1, Math.max(0, y + k)) : y;
          sum += kernel[k + reach]! * from[width * v + u]!;
        }
        into[width * y + x] = sum / total;
      }
    return into;
  };
  return pass(pass(image, "x"), "y");
}

const TABLE = 65_536;
/** Normally distributed numbers, made once: a picture has a million. */
const GAUSS = ((): Float64Array => {
  const random = seededRandom(77);
  return Float64Array.from(
    { length: TABLE },
    () => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random()),
  );
})();

function quantised(image: Float64Array, noise: number, random: Random): Uint8Array {
  const out = new Uint8Array(image.length);
  let at = Math.floor(TABLE * random());
  for (let i = 0; i < image.length; i++) {
    at = (at + 1) & (TABLE - 1);
    out[i] = Math.min(255, Math.max(0, Math.round(image[i]! + noise * GAUSS[at]!)));
  }
  return out;
}

/** cameraFromTag rotation (row by row) of a tag that faces the camera, turned by `roll` and tilted about an axis. */
export function facing(tilt_rad: number, axis_rad: number, roll_rad: number): number[] {
  const [cr, sr] = [Math.cos(roll_rad), Math.sin(roll_rad)];
  // Tag x right, y up, z towards the camera: in the camera's axes (x right, y down, z forward) diag(1, −1, −1).
  const upright = [cr, -sr, 0, -sr, -cr, 0, 0, 0, -1];
  const [ax, ay] = [Math.cos(axis_rad), Math.sin(axis_rad)];
  const [c, s] = [Math.cos(tilt_rad), Math.sin(tilt_rad)];
  const tilt = [
    c + ax * ax * (1 - c),
    ax * ay * (1 - c),
    ay * s,
    ax * ay * (1 - c),
    c + ay * ay * (1 - c),
    -ax * s,
    -ay * s,
    ax * s,
    c,
  ];
  return Array.from({ length: 9 }, (_, k) => {
    const [row, column] = [Math.floor(k / 3), k % 3];
    return [0, 1, 2].reduce((sum, m) => sum + tilt[3 * row + m]! * upright[3 * m + column]!, 0);
  });
}
