import {
  cross,
  dot,
  identity,
  linkPoses,
  linkShapes,
  norm,
  normalize,
  readyPosture,
  subtract,
  transformPoint,
  type PartMaterial,
  type Robot,
  type RobotPaint,
  type Vector3,
} from "@twincell/core";

/** Where the picture is looked at from: along −VIEW, with RIGHT to the right. Both in the world, z up. */
const VIEW = normalize([0.46, -0.82, 0.34]);
const RIGHT = normalize([0.82, 0.46, 0]);
const UP: Vector3 = cross(VIEW, RIGHT);
const LIGHT = normalize([0.25, -0.5, 0.85]);
/** What faces away from the light still shows so much of its colour. */
const AMBIENT = 0.42;
const ROOM = 0.07;
/** Each pixel is the mean of so many by so many. */
const FINE = 2;
/** Colours of the robots that bring none of their own. */
const PLAIN: RobotPaint = { casting: "#eaa50c", dark: "#272c30", cover: "#3c444a" };

/** A picture, rows from the top, four bytes a pixel: red, green, blue, opacity. */
export interface Pixels {
  readonly width: number;
  readonly height: number;
  readonly data: Uint8ClampedArray<ArrayBuffer>;
}

/**
 * A robot as it looks, in its ready posture, lit from above: every triangle of its links, the nearest at each pixel.
 * Orthographic: column = RIGHT · p, row = −UP · p, depth = VIEW · p. Pure; takes some 10 ms.
 */
export function robotPicture(robot: Robot, width: number, height: number): Pixels {
  const triangles = trianglesOf(robot);
  const bounds = boundsOf(triangles);
  const [w, h] = [width * FINE, height * FINE];
  const scale = (1 - 2 * ROOM) * Math.min(w / (bounds.right - bounds.left), h / (bounds.top - bounds.bottom));
  const column = (x: number): number => w / 2 + scale * (x - (bounds.left + bounds.right) / 2);
  const row = (y: number): number => h / 2 - scale * (y - (bounds.bottom + bounds.top) / 2);
  const depth = new Float32Array(w * h).fill(-Infinity);
  const fine = new Uint8ClampedArray(4 * w * h);
  for (const { corners, colour } of triangles)
    fill(
      corners.map(([x, y, z]) => [column(x), row(y), z] as const),
      colour,
      { w, h, depth, fine },
    );
  return { width, height, data: shrunk(fine, width, height) };
}

interface Triangle {
  /** Right, up and towards the eye [m]. */
  readonly corners: readonly Vector3[];
  readonly colour: Vector3;
}

function trianglesOf(robot: Robot): Triangle[] {
  const links = Array.from({ length: robot.arm.joints.length + 1 }, () => identity<"base", "link">());
  linkPoses(robot.arm, readyPosture(robot), links);
  const colours = coloursOf(robot.paint ?? PLAIN);
  return linkShapes(robot).flatMap(({ link, parts }) =>
    parts.flatMap(({ material, color, mesh: { positions, indices } }) => {
      const paint = color === undefined ? colours[material] : byte(color);
      const points: Vector3[] = [];
      for (let i = 0; i < positions.length; i += 3)
        points.push(transformPoint(links[link]!, [positions[i]!, positions[i + 1]!, positions[i + 2]!]));
      const made: Triangle[] = [];
      for (let i = 0; i < indices.length; i += 3) {
        const corners = [points[indices[i]!]!, points[indices[i + 1]!]!, points[indices[i + 2]!]!] as const;
        const triangle = lit(corners, paint);
        if (triangle) made.push(triangle);
      }
      return made;
    }),
  );
}

/** Lambert's law; undefined for what is turned away or has no surface. */
function lit([a, b, c]: readonly [Vector3, Vector3, Vector3], colour: Vector3): Triangle | undefined {
  const normal = cross(subtract(b, a), subtract(c, a));
  const size = norm(normal);
  if (size === 0 || dot(normal, VIEW) <= 0) return undefined;
  const light = AMBIENT + (1 - AMBIENT) * Math.max(0, dot(normal, LIGHT) / size);
  return {
    corners: [a, b, c].map(point => [dot(point, RIGHT), dot(point, UP), dot(point, VIEW)]),
    colour: colour.map(value => value * light) as Vector3,
  };
}

interface Canvas {
  readonly w: number;
  readonly h: number;
  readonly depth: Float32Array;
  readonly fine: Uint8ClampedArray;
}

/** Fills a triangle by its barycentric coordinates where it is nearer than what is there. */
function fill(
  [a, b, c]: readonly (readonly [number, number, number])[],
  colour: Vector3,
  { w, h, depth, fine }: Canvas,
): void {
  const [ax, ay, az] = a!;
  const [bx, by, bz] = b!;
  const [cx, cy, cz] = c!;
  const area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay);
  if (Math.abs(area) < 1e-12) return;
  const fromX = Math.max(0, Math.floor(Math.min(ax, bx, cx)));
  const toX = Math.min(w - 1, Math.ceil(Math.max(ax, bx, cx)));
  const fromY = Math.max(0, Math.floor(Math.min(ay, by, cy)));
  const toY = Math.min(h - 1, Math.ceil(Math.max(ay, by, cy)));
  for (let y = fromY; y <= toY; y++) {
    for (let x = fromX; x <= toX; x++) {
      const u = ((x + 0.5 - ax) * (cy - ay) - (cx - ax) * (y + 0.5 - ay)) / area;
      const v = ((bx - ax) * (y + 0.5 - ay) - (x + 0.5 - ax) * (by - ay)) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      const z = az + u * (bz - az) + v * (cz - az);
      const at = y * w + x;
      if (z <= depth[at]!) continue;
      depth[at] = z;
      fine.set([colour[0], colour[1], colour[2], 255], 4 * at);
    }
  }
}

/** Means of `FINE` × `FINE` pixels; colours count as much as they cover. */
function shrunk(fine: Uint8ClampedArray, width: number, height: number): Uint8ClampedArray<ArrayBuffer> {
  const data = new Uint8ClampedArray(4 * width * height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const sum = [0, 0, 0, 0];
      for (let k = 0; k < FINE * FINE; k++) {
        const from = 4 * ((y * FINE + Math.floor(k / FINE)) * width * FINE + x * FINE + (k % FINE));
        if (fine[from + 3] === 0) continue;
        for (let part = 0; part < 4; part++) sum[part]! += fine[from + part]!;
      }
      const covered = sum[3]! / 255;
      if (covered > 0)
        data.set([sum[0]! / covered, sum[1]! / covered, sum[2]! / covered, sum[3]! / FINE ** 2], 4 * (y * width + x));
    }
  }
  return data;
}

function boundsOf(triangles: readonly Triangle[]): Record<"left" | "right" | "bottom" | "top", number> {
  const bounds = { left: Infinity, right: -Infinity, bottom: Infinity, top: -Infinity };
  for (const { corners } of triangles)
    for (const [x, y] of corners) {
      bounds.left = Math.min(bounds.left, x);
      bounds.right = Math.max(bounds.right, x);
      bounds.bottom = Math.min(bounds.bottom, y);
      bounds.top = Math.max(bounds.top, y);
    }
  return bounds;
}

const byte = (colour: string): Vector3 =>
  [1, 3, 5].map(at => parseInt(colour.slice(at, at + 2), 16)) as unknown as Vector3;
/** The dark parts are lightened a little, since the ground of the picture is dark too. */
const coloursOf = ({ casting, dark, cover }: RobotPaint): Readonly<Record<PartMaterial, Vector3>> => ({
  casting: byte(casting),
  dark: byte(dark).map(value => value + 34) as Vector3,
  cover: byte(cover).map(value => value + 20) as Vector3,
  metal: [185, 192, 197],
  mark: [247, 249, 250],
});
