/**
 * Dark quadrilaterals in a grey picture: halved in size, compared with the mean of its surroundings, outlines followed,
 * four corners taken. Everything is allocated once for one size of picture.
 */

/** Half the side of the window whose mean a pixel is compared with, in pixels of the halved picture. */
const WINDOW = 12;
/** A pixel is dark when it is so much below the mean of its window. */
const BIAS = 6;
const MIN_SIDE = 6;
const MAX_QUADS = 256;
/** An outline may leave the straight line between two corners by so much, in pixels or as a share of the side. */
const MAX_BEND = 1.6;
const MAX_BEND_SHARE = 0.04;
/** Steps to the eight neighbours, clockwise on the screen from the right. */
const STEP_X = [1, 1, 0, -1, -1, -1, 0, 1] as const;
const STEP_Y = [0, 1, 1, 1, 0, -1, -1, -1] as const;

export class QuadFinder {
  readonly width: number;
  readonly height: number;
  /** How many quadrilaterals the last picture had. */
  count = 0;
  /** Corners of them in pixels of the full picture, clockwise on the screen, 8 numbers each; borrowed. */
  readonly corners = new Float64Array(8 * MAX_QUADS);
  readonly #small: Uint8Array;
  readonly #dark: Uint8Array;
  readonly #sums: Uint32Array;
  readonly #x: Int16Array;
  readonly #y: Int16Array;
  #length = 0;

  /** @param width of the pictures [px] @param height of the pictures [px] */
  constructor(width: number, height: number) {
    this.width = width >> 1;
    this.height = height >> 1;
    const size = this.width * this.height;
    this.#small = new Uint8Array(size);
    this.#dark = new Uint8Array(size);
    this.#sums = new Uint32Array((this.width + 1) * (this.height + 1));
    this.#x = new Int16Array(4 * (this.width + this.height));
    this.#y = new Int16Array(4 * (this.width + this.height));
  }

  /** Finds the quadrilaterals of a picture of 8-bit grey values, `stride` to a row. */
  find(gray: Uint8Array, stride: number): void {
    this.count = 0;
    this.#halve(gray, stride);
    this.#threshold();
    this.#follow();
  }

  #halve(gray: Uint8Array, stride: number): void {
    const { width, height } = this;
    const small = this.#small;
    const sums = this.#sums;
    const across = width + 1;
    for (let y = 0; y < height; y++) {
      let from = 2 * y * stride;
      let sum = 0;
      let at = across * (y + 1) + 1;
      const end = width * (y + 1);
      for (let to = width * y; to < end; to++) {
        const value = (gray[from]! + gray[from + 1]! + gray[from + stride]! + gray[from + stride + 1]! + 2) >> 2;
        small[to] = value;
        sum += value;
        sums[at] = sums[at - across]! + sum;
        from += 2;
        at++;
      }
    }
  }

  #threshold(): void {
    const { width, height } = this;
    const small = this.#small;
    const dark = this.#dark;
    const sums = this.#sums;
    const across = width + 1;
    for (let y = 0; y < height; y++) {
      const top = Math.max(0, y - WINDOW);
      const bottom = Math.min(height, y + WINDOW + 1);
      const above = top * across;
      const below = bottom * across;
      // The frame stays bright: outlines never leave the picture.
      const edge = y === 0 || y === height - 1;
      for (let x = 0; x < width; x++) {
        const left = x < WINDOW ? 0 : x - WINDOW;
        const right = x + WINDOW + 1 > width ? width : x + WINDOW + 1;
        const area = (right - left) * (bottom - top);
        const sum = sums[below + right]! - sums[below + left]! - sums[above + right]! + sums[above + left]!;
        const isDark = !edge && x > 0 && x < width - 1 && (small[width * y + x]! + BIAS) * area < sum;
        dark[width * y + x] = isDark ? 1 : 0;
      }
    }
  }

  /** Follows every outline once: 2 marks pixels that one went through. */
  #follow(): void {
    const { width, height } = this;
    const dark = this.#dark;
    for (let y = 1; y < height - 1; y++) {
      let before = 0;
      for (let at = width * y + 1; at < width * (y + 1) - 1; at++) {
        const value = dark[at]!;
        if (value === 1 && before === 0) {
          this.#outline(at);
          if (this.#length >= 4 * MIN_SIDE && this.count < MAX_QUADS) this.#take();
        }
        before = value;
      }
    }
  }

  /** Follows the outline that begins at a dark pixel with a bright one on its left (Moore's neighbours, clockwise). */
  #outline(start: number): void {
    const { width } = this;
    const dark = this.#dark;
    const most = this.#x.length;
    let at = start;
    let length = 0;
    // The last bright neighbour is to the left: looking goes on clockwise from there.
    let looking = 4;
    let first = -1;
    for (;;) {
      let turned = 0;
      let next = -1;
      for (; turned < 8; turned++) {
        const direction = (looking + 1 + turned) & 7;
        const neighbour = at + STEP_X[direction]! + width * STEP_Y[direction]!;
        if (dark[neighbour] !== 0) {
          next = direction;
          break;
        }
      }
      dark[at] = 2;
      if (next < 0) break;
      if (at === start) {
        if (first === next) break;
        if (first < 0) first = next;
      }
      if (length < most) {
        this.#x[length] = at % width;
        this.#y[length] = (at / width) | 0;
      }
      length++;
      if (length > 4 * most) break;
      at += STEP_X[next]! + width * STEP_Y[next]!;
      looking = (next + 4) & 7;
      // From the new pixel, the neighbour looked at last was bright: go on from the one after where we came from.
    }
    this.#length = length <= most ? length : 0;
  }

  /** Four corners of the outline, when it is a quadrilateral's. */
  #take(): void {
    const n = this.#length;
    const X = this.#x;
    const Y = this.#y;
    let twice = 0;
    let sx = 0;
    let sy = 0;
    for (let i = 0; i < n; i++) {
      const j = i + 1 < n ? i + 1 : 0;
      twice += X[i]! * Y[j]! - X[j]! * Y[i]!;
      sx += X[i]!;
      sy += Y[i]!;
    }
    // Clockwise on the screen is positive with y down; the outline of a hole runs the other way.
    if (twice < 2 * MIN_SIDE * MIN_SIDE) return;
    const a = this.#farthest(sx / n, sy / n);
    const c = this.#farthest(X[a]!, Y[a]!);
    const b = this.#farthestFromLine(a, c);
    const d = this.#farthestFromLine(c, a);
    if (b < 0 || d < 0) return;
    if (!this.#straight(a, b) || !this.#straight(b, c) || !this.#straight(c, d) || !this.#straight(d, a)) return;
    const out = this.corners;
    const at = 8 * this.count++;
    this.#write(a, at, out);
    this.#write(b, at + 2, out);
    this.#write(c, at + 4, out);
    this.#write(d, at + 6, out);
  }

  /** A pixel of the halved picture is the mean of four: its centre lies between them. */
  #write(i: number, at: number, out: Float64Array): void {
    out[at] = 2 * this.#x[i]! + 0.5;
    out[at + 1] = 2 * this.#y[i]! + 0.5;
  }

  #farthest(x: number, y: number): number {
    let most = -1;
    let found = 0;
    for (let i = 0; i < this.#length; i++) {
      const dx = this.#x[i]! - x;
      const dy = this.#y[i]! - y;
      const far = dx * dx + dy * dy;
      if (far > most) {
        most = far;
        found = i;
      }
    }
    return found;
  }

  /** Between two places of the outline, going on from the first: where it is farthest from the line through both. */
  #farthestFromLine(from: number, to: number): number {
    const n = this.#length;
    const X = this.#x;
    const Y = this.#y;
    const dx = X[to]! - X[from]!;
    const dy = Y[to]! - Y[from]!;
    const long = Math.sqrt(dx * dx + dy * dy);
    let most = MIN_SIDE / 2;
    let found = -1;
    for (let i = from; i !== to; i = i + 1 < n ? i + 1 : 0) {
      // The outline runs clockwise: what it encloses is on its right, the next corner on its left.
      const aside = (dy * (X[i]! - X[from]!) - dx * (Y[i]! - Y[from]!)) / long;
      if (aside > most) {
        most = aside;
        found = i;
      }
    }
    return found;
  }

  #straight(from: number, to: number): boolean {
    const n = this.#length;
    const X = this.#x;
    const Y = this.#y;
    const dx = X[to]! - X[from]!;
    const dy = Y[to]! - Y[from]!;
    const long = Math.sqrt(dx * dx + dy * dy);
    if (long < MIN_SIDE) return false;
    const allowed = Math.max(MAX_BEND, MAX_BEND_SHARE * long) * long;
    for (let i = from; i !== to; i = i + 1 < n ? i + 1 : 0)
      if (Math.abs(dy * (X[i]! - X[from]!) - dx * (Y[i]! - Y[from]!)) > allowed) return false;
    return true;
  }
}
