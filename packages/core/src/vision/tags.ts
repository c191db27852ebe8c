/**
 * Square tags of the family tag36h11: a black border of one module round 6 × 6 modules, 8 × 8 in all, with white about
 * them. Any two tags, however turned, differ in at least 11 modules.
 *
 * @see Olson, AprilTag: A robust and flexible visual fiducial system, ICRA 2011.
 */
export const TAG_MODULES = 8;
const DATA_MODULES = 6;
const DATA_BITS = DATA_MODULES * DATA_MODULES;
const HALF_BITS = 18;
const HALF_MASK = 0x3ffff;
/** So many modules may be read wrongly: at 11 apart, 2 leave no doubt which tag it is. */
const MAX_WRONG_BITS = 2;

/** Codes of the tags 0 … 31: bit 35 is the module at top left, then row by row; 1 is white. */
const CODES: readonly number[] = [
  0xd5d628584, 0xd97f18b49, 0xdd280910e, 0xe479e9c98, 0xebcbca822, 0xf31dab3ac, 0x056a5d085, 0x10652e1d4, 0x22b1dfead,
  0x265ad0472, 0x34fe91b86, 0x3ff962cd5, 0x43a25329a, 0x474b4385f, 0x4e9d243e9, 0x5246149ae, 0x5997f5538, 0x683bb6c4c,
  0x6be4a7211, 0x7e3158eea, 0x81da494af, 0x858339a74, 0x8cd51a5fe, 0x9f21cc2d7, 0xa2cabc89c, 0xadc58d9eb, 0xb16e7dfb0,
  0xb8c05eb3a, 0xd25ef139d, 0xd607e1962, 0xe4aba3076, 0x2dde6a3da,
];

/** How many tags of the family are known here: ids 0 … TAG_COUNT − 1. */
export const TAG_COUNT = CODES.length;

/** The 36 bits of a tag as a number below 2³⁶. @throws RangeError when the id is none of 0 … TAG_COUNT − 1 */
export function tagCode(id: number): number {
  const code = CODES[id];
  if (code === undefined) throw new RangeError(`Tag ${id} is not known; ids go from 0 to ${TAG_COUNT - 1}.`);
  return code;
}

/** Whether the module at that row and column (0 … 7, from top left) of a tag is white. @throws RangeError */
export function tagModuleIsWhite(id: number, row: number, column: number): boolean {
  const code = tagCode(id);
  const outside = row < 1 || row > DATA_MODULES || column < 1 || column > DATA_MODULES;
  if (outside) return false;
  const bit = DATA_BITS - 1 - (DATA_MODULES * (row - 1) + column - 1);
  return Math.floor(code / 2 ** bit) % 2 === 1;
}

/** Every tag in its four turns, in halves of 18 bits: entry 4 id + quarter turns. */
const HIGH = new Int32Array(4 * CODES.length);
const LOW = new Int32Array(4 * CODES.length);
for (const [id, code] of CODES.entries()) {
  let turned = code;
  for (let turns = 0; turns < 4; turns++) {
    HIGH[4 * id + turns] = Math.floor(turned / 2 ** HALF_BITS);
    LOW[4 * id + turns] = turned % 2 ** HALF_BITS;
    turned = quarterTurn(turned);
  }
}

/** The code read when a tag is turned by 90° counter-clockwise: what stood at row r, column c stands at 5 − c, r. */
function quarterTurn(code: number): number {
  let turned = 0;
  for (let row = 0; row < DATA_MODULES; row++)
    for (let column = 0; column < DATA_MODULES; column++) {
      const from = DATA_BITS - 1 - (DATA_MODULES * column + (DATA_MODULES - 1 - row));
      turned = 2 * turned + (Math.floor(code / 2 ** from) % 2);
    }
  return turned;
}

function bitCount(value: number): number {
  let v = value & HALF_MASK;
  v -= (v >> 1) & 0x15555;
  v = (v & 0x33333) + ((v >> 2) & 0x33333);
  return (((v + (v >> 4)) & 0x0f0f) % 255) + ((v >> 16) & 0xf);
}

/** How many bits differ between what was read (two halves of 18 bits) and a tag in one of its turns. */
export const wrongBits = (high: number, low: number, id: number, turns: number): number =>
  bitCount(high ^ HIGH[4 * id + turns]!) + bitCount(low ^ LOW[4 * id + turns]!);

/**
 * Which tag 36 modules are, at most 2 of them wrong.
 *
 * @param high bits 35 … 18 in reading order
 * @param low  bits 17 … 0
 * @returns 4 id + quarter turns counter-clockwise by which the tag is seen turned, or −1
 */
export function matchTag(high: number, low: number): number {
  for (let i = 0; i < HIGH.length; i++)
    if (bitCount(high ^ HIGH[i]!) + bitCount(low ^ LOW[i]!) <= MAX_WRONG_BITS) return i;
  return -1;
}
