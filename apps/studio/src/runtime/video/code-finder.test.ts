import { expect, test } from "vitest";
import { findCode } from "./code-finder.ts";
import { squareToQuad } from "./quads.ts";
import { CODE_CELLS, codeCells, readCells, type TimeCode } from "./time-code.ts";

const W = 640;
const H = 480;
function dice(seed: number): (least: number, most: number) => number {
  let state = seed;
  return (least, most) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return least + (most - least) * (state / 2 ** 32);
  };
}
interface Filming {
  readonly corners: readonly number[];
  readonly blur_px?: number;
  readonly noise?: number;
  readonly black?: number;
  readonly white?: number;
  readonly slope?: number;
  /** A second code that fades in, and how far. */
  readonly fading?: readonly [TimeCode, number];
  readonly mirrored?: boolean;
  readonly seed?: number;
}
/**
 * A screen with a code as a camera sees it: in perspective, in a room with dark and light things, blurred, with noise.
 */
function film(
  code: TimeCode,
  { corners, blur_px = 0, noise = 0, black = 20, white = 225, slope = 0, fading, mirrored = false, seed = 1 }: Filming,
): Uint8Array {
  const roll = dice(seed);
  const map = squareToQuad(Float64Array.from(corners));
  const cells = codeCells(code);
  const later = fading && codeCells(fading[0]);
  const out = new Float64Array(W * H);
  // Inverse mapping by the adjugate of the 3×3 matrix.
  const [a, b, c, d, e, f, g, h] = map as unknown as readonly [
    number,
    number,
    number,
    number,
    number,
    number,
    number,
    number,
  ];
  const inverse = [
    e - f * h,
    c * h - b,
    b * f - c * e,
    f * g - d,
    a - c * g,
    c * d - a * f,
    d * h - e * g,
    b * g - a * h,
    a * e - b * d,
  ];
  const furniture = Array.from({ length: 12 }, () => ({
    x: roll(-40, W),
    y: roll(-40, H),
    w: roll(20, 200),
    h: roll(20, 200),
    v: roll(0, 255),
  }));
  for (let y = 0; y < H; y++) {
    for (let x = 0; x < W; x++) {
      const px = mirrored ? W - 1 - x : x;
      const w = inverse[6]! * (px + 0.5) + inverse[7]! * (y + 0.5) + inverse[8]!;
      const u = ((inverse[0]! * (px + 0.5) + inverse[1]! * (y + 0.5) + inverse[2]!) / w) * CODE_CELLS;
      const v = ((inverse[3]! * (px + 0.5) + inverse[4]! * (y + 0.5) + inverse[5]!) / w) * CODE_CELLS;
      let value: number;
      if (u >= -1.4 && u < CODE_CELLS + 1.4 && v >= -1.4 && v < CODE_CELLS + 1.4) {
        const inside = u >= 0 && u < CODE_CELLS && v >= 0 && v < CODE_CELLS;
        const at = Math.floor(v) * CODE_CELLS + Math.floor(u);
        const dark = inside ? cells[at]! + (later ? fading[1] * (later[at]! - cells[at]!) : 0) : 0;
        value = white + dark * (black - white) + slope * (x - W / 2);
      } else {
        value = 90 + 40 * Math.sin(x / 60) + 30 * Math.cos(y / 35);
        for (const each of furniture)
          if (x >= each.x && x < each.x + each.w && y >= each.y && y < each.y + each.h) value = each.v;
      }
      out[y * W + x] = value;
    }
  }
  let picture = out;
  for (let left = blur_px; left > 0; left--) picture = blurred(picture);
  return Uint8Array.from(picture, value => Math.max(0, Math.min(255, value + roll(-noise, noise))));
}
/** A box of 3 × 3; n times is a blur of about 0.8 √n pixels. */
function blurred(from: Float64Array): Float64Array<ArrayBuffer> {
  const to = new Float64Array(from.length);
  for (let y = 1; y < H - 1; y++)
    for (let x = 1; x < W - 1; x++) {
      let sum = 0;
      for (let dy = -1; dy <= 1; dy++) for (let dx = -1; dx <= 1; dx++) sum += from[(y + dy) * W + x + dx]!;
      to[y * W + x] = sum / 9;
    }
  return to;
}
/** A square of that side about a place, turned and tilted. */
function seen(cx: number, cy: number, side: number, turn_rad: number, tilt: number): number[] {
  return [
    [-1, -1],
    [1, -1],
    [1, 1],
    [-1, 1],
  ].flatMap(([x, y]) => {
    const a = Math.cos(turn_rad) * x! - Math.sin(turn_rad) * y!;
    const b = Math.sin(turn_rad) * x! + Math.cos(turn_rad) * y!;
    const far = 1 + tilt * a;
    return [cx + ((side / 2) * a) / far, cy + ((side / 2) * b) / far];
  });
}

test("X-40 a code reads back as what was written, turned and mirrored too; a wrong cell is never read as another number", () => {
  const roll = dice(3);
  for (let i = 0; i < 2000; i++) {
    const code = { counter: Math.floor(roll(0, 65536)), session: Math.floor(roll(0, 256)) };
    const cells = codeCells(code);
    expect(readCells(cells, code.session)).toEqual(code);
    const turned = cells.map(
      (_, at) => cells[(CODE_CELLS - 1 - (at % CODE_CELLS)) * CODE_CELLS + Math.floor(at / CODE_CELLS)]!,
    );
    expect(readCells(turned, code.session)).toEqual(code);
    const wrong = Uint8Array.from(cells);
    const at = (1 + Math.floor(roll(0, 6))) * CODE_CELLS + 1 + Math.floor(roll(0, 6));
    wrong[at] = 1 - wrong[at]!;
    expect(readCells(wrong, code.session)).toBeNull();
    expect(readCells(cells, (code.session + 1) % 256)).toBeNull();
  }
  expect(readCells(new Uint8Array(64), 0)).toBeNull();
  expect(readCells(new Uint8Array(64).fill(1), 255)).toBeNull();
});

test("X-40 the grid is as it is written down: counter 1 of session 2", () => {
  const grid = codeCells({ counter: 1, session: 2 });
  const rows = Array.from({ length: 8 }, (_, r) =>
    [...grid.subarray(8 * r, 8 * r + 8)].map(cell => "·#"[cell]).join(""),
  );
  // 0000000000000001 00000010, and 12 of CRC.
  expect(rows.slice(0, 5)).toEqual(["########", "#······#", "#······#", "#···#··#", "#····#·#"]);
  expect(rows[7]).toBe("########");
});

test("X-40 a code is found from afar and near, turned, tilted, blurred, in noise and in bad light", () => {
  const roll = dice(40);
  const code = { counter: 41_234, session: 77 };
  let found = 0;
  let wrong = 0;
  const n = 60;
  for (let i = 0; i < n; i++) {
    const side = roll(60, 330);
    const picture = film(code, {
      corners: seen(roll(230, 410), roll(215, 265), side, roll(-Math.PI, Math.PI), roll(-0.22, 0.22)),
      blur_px: Math.floor(roll(0, side / 50)),
      noise: roll(0, 22),
      black: roll(10, 60),
      white: roll(130, 250),
      slope: roll(-0.05, 0.05),
      seed: i,
      mirrored: i % 2 === 0,
    });
    const sighting = findCode(picture, W, H, code.session);
    if (sighting.kind !== "read") continue;
    if (sighting.codes.every(({ counter }) => counter === code.counter)) found++;
    else wrong++;
  }
  expect(wrong).toBe(0);
  expect(found / n).toBeGreaterThan(0.9);
});

test("X-40 two codes in one picture, one fading into the next, are no time", () => {
  const corners = seen(320, 240, 240, 0.2, 0.1);
  for (const [share, kind] of [
    [0, "read"],
    [0.1, "read"],
    [0.5, "mixed"],
    [0.9, "read"],
    [1, "read"],
  ] as const) {
    const sighting = findCode(
      film({ counter: 100, session: 5 }, { corners, fading: [{ counter: 0xff01, session: 5 }, share], noise: 8 }),
      W,
      H,
      5,
    );
    expect(sighting.kind, `${share}`).toBe(kind);
    if (sighting.kind === "read")
      expect(sighting.codes.map(({ counter }) => counter)).toContain(share < 0.5 ? 100 : 0xff01);
  }
});

test("X-40 a wrong checksum, a covered code and a room without one say nothing", () => {
  const corners = seen(320, 240, 240, 0, 0);
  const room = (seed: number) =>
    film({ counter: 0, session: 0 }, { corners: seen(-4000, -4000, 50, 0, 0), seed, noise: 30 });
  const picture = film({ counter: 999, session: 9 }, { corners });
  // One data cell painted over: white where black was, or the other way round.
  const cell = codeCells({ counter: 999, session: 9 })[8 + 1]!;
  for (let y = 155; y < 178; y++) for (let x = 235; x < 258; x++) picture[y * W + x] = cell === 1 ? 225 : 20;
  expect(findCode(picture, W, H, 9).kind).toBe("none");
  const covered = film({ counter: 999, session: 9 }, { corners });
  for (let y = 0; y < H; y++) for (let x = 300; x < 380; x++) covered[y * W + x] = 120;
  expect(findCode(covered, W, H, 9).kind).toBe("none");
  for (let seed = 0; seed < 8; seed++) expect(findCode(room(seed), W, H, seed).kind).toBe("none");
  expect(findCode(new Uint8Array(W * H), W, H, 0).kind).toBe("none");
  expect(findCode(new Uint8Array(0), 0, 0, 0).kind).toBe("none");
});
