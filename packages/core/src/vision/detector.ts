import { EdgeRefiner, grayAt } from "./edges.ts";
import { distort, type Lens } from "./lens.ts";
import { squareHomography } from "./planar-pose.ts";
import { QuadFinder } from "./quads.ts";
import { matchTag, TAG_MODULES } from "./tags.ts";

/** A tag in a picture. Borrowed: the next picture writes it again. */
export interface TagSighting {
  id: number;
  /**
   * Directions x/z, y/z of the corners of its black square without the lens's distortion: top left, top right, bottom
   * right, bottom left of the upright tag.
   */
  readonly corners: Float64Array;
  /** Its side in the picture [px], the mean of four. */
  side_px: number;
}

const MAX_TAGS = 64;
/** White and black must be so many grey levels apart. */
const MIN_CONTRAST = 20;

/** Finds tags in pictures of one size. Nothing is allocated once it is made. */
export class TagDetector {
  /** How many tags the last picture had. */
  count = 0;
  readonly sightings: readonly TagSighting[] = Array.from({ length: MAX_TAGS }, () => ({
    id: -1,
    corners: new Float64Array(8),
    side_px: 0,
  }));
  readonly #quads: QuadFinder;
  readonly #edges = new EdgeRefiner();
  readonly #corners = new Float64Array(8);
  readonly #H = new Float64Array(9);
  readonly #at = new Float64Array(2);
  readonly #levels = new Float64Array(6);
  #lens: Lens;
  #high = 0;
  #low = 0;

  /** @param lens of the camera; its width and height are those of the pictures */
  constructor(lens: Lens) {
    this.#lens = lens;
    this.#quads = new QuadFinder(lens.width, lens.height);
  }

  /** Uses another lens from now on. @throws RangeError when it is one for pictures of another size */
  useLens(lens: Lens): void {
    if (lens.width !== this.#lens.width || lens.height !== this.#lens.height)
      throw new RangeError(`The lens is for pictures of ${lens.width} × ${lens.height} px.`);
    this.#lens = lens;
  }

  /**
   * Finds the tags of a picture.
   *
   * @param gray   8-bit grey values, row by row
   * @param stride values from one row to the next, at least the width
   * @returns how many there are; `sightings` holds them
   */
  detect(gray: Uint8Array, stride: number = this.#lens.width): number {
    this.count = 0;
    const quads = this.#quads;
    quads.find(gray, stride);
    for (let i = 0; i < quads.count && this.count < MAX_TAGS; i++) {
      for (let k = 0; k < 8; k++) this.#corners[k] = quads.corners[8 * i + k]!;
      this.#look(gray, stride);
    }
    return this.count;
  }

  #look(gray: Uint8Array, stride: number): void {
    const corners = this.#corners;
    const side_px = meanSide(corners);
    const rows = this.#lens.height;
    // Never farther than into the first module, where the code begins.
    const reach = Math.max(1, (0.8 * side_px) / TAG_MODULES);
    if (!this.#edges.refine(gray, stride, rows, this.#lens, corners, reach)) return;
    if (!squareHomography(corners, TAG_MODULES, this.#H)) return;
    if (!this.#readBits(gray, stride)) return;
    const match = matchTag(this.#high, this.#low);
    if (match < 0) return;
    const id = match >> 2;
    const turns = match & 3;
    for (let i = 0; i < this.count; i++) if (this.sightings[i]!.id === id && near(this.sightings[i]!, corners)) return;
    const sighting = this.sightings[this.count++]!;
    sighting.id = id;
    sighting.side_px = side_px;
    // Seen turned by so many quarters counter-clockwise, its own top left comes so many corners earlier.
    for (let k = 0; k < 4; k++) {
      const from = 2 * ((k + 4 - turns) & 3);
      sighting.corners[2 * k] = corners[from]!;
      sighting.corners[2 * k + 1] = corners[from + 1]!;
    }
  }

  /** The grey value at a place of the tag, in modules about its centre (x right, y up). */
  #sample(gray: Uint8Array, stride: number, x: number, y: number): number {
    const H = this.#H;
    const w = 1 / (H[6]! * x + H[7]! * y + 1);
    distort(this.#lens, (H[0]! * x + H[1]! * y + H[2]!) * w, (H[3]! * x + H[4]! * y + H[5]!) * w, this.#at);
    return grayAt(gray, stride, this.#lens.height, this.#at[0]!, this.#at[1]!);
  }

  /** Reads the 36 modules against a threshold that leans with the light on the tag; false when there is no contrast. */
  #readBits(gray: Uint8Array, stride: number): boolean {
    const levels = this.#levels;
    if (!this.#ring(gray, stride, TAG_MODULES / 2 - 0.5, 0)) return false;
    if (!this.#ring(gray, stride, TAG_MODULES / 2 + 0.5, 3)) return false;
    if (levels[3]! - levels[0]! < MIN_CONTRAST) return false;
    let high = 0;
    let low = 0;
    for (let row = 0; row < 6; row++)
      for (let column = 0; column < 6; column++) {
        const x = column - 2.5;
        const y = 2.5 - row;
        const value = this.#sample(gray, stride, x, y);
        const threshold =
          0.5 * (levels[0]! + levels[3]! + x * (levels[1]! + levels[4]!) + y * (levels[2]! + levels[5]!));
        const bit = value > threshold ? 1 : 0;
        if (row < 3) high = 2 * high + bit;
        else low = 2 * low + bit;
      }
    this.#high = high;
    this.#low = low;
    return true;
  }

  /** Mean grey value of a ring of modules and how it leans, written to `levels` from `into` on. */
  #ring(gray: Uint8Array, stride: number, half: number, into: number): boolean {
    const steps = 2 * half;
    let sum = 0;
    let byX = 0;
    let byY = 0;
    let square = 0;
    for (let i = 0; i < steps; i++) {
      const along = i - half;
      for (let side = 0; side < 4; side++) {
        const x = side === 0 ? along : side === 1 ? half : side === 2 ? -along : -half;
        const y = side === 0 ? half : side === 1 ? -along : side === 2 ? -half : along;
        const value = this.#sample(gray, stride, x, y);
        sum += value;
        byX += value * x;
        byY += value * y;
        square += x * x;
      }
    }
    this.#levels[into] = sum / (4 * steps);
    this.#levels[into + 1] = byX / square;
    this.#levels[into + 2] = byY / square;
    return sum === sum;
  }
}

function meanSide(corners: Float64Array): number {
  let sum = 0;
  for (let i = 0; i < 4; i++) {
    const j = 2 * ((i + 1) & 3);
    const dx = corners[j]! - corners[2 * i]!;
    const dy = corners[j + 1]! - corners[2 * i + 1]!;
    sum += Math.sqrt(dx * dx + dy * dy);
  }
  return sum / 4;
}

function near(sighting: TagSighting, corners: Float64Array): boolean {
  let dx = 0;
  let dy = 0;
  for (let i = 0; i < 4; i++) {
    dx += sighting.corners[2 * i]! - corners[2 * i]!;
    dy += sighting.corners[2 * i + 1]! - corners[2 * i + 1]!;
  }
  const across = Math.abs(corners[4]! - corners[0]!) + Math.abs(corners[5]! - corners[1]!);
  return Math.abs(dx) + Math.abs(dy) < across;
}
