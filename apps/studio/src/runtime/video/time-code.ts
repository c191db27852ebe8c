/** Cells along a side: one of frame, six of data, one of frame. Around it one cell of white at least. */
export const CODE_CELLS = 8;
const DATA_CELLS = CODE_CELLS - 2;
const DATA_BITS = DATA_CELLS * DATA_CELLS;
export const COUNTS = 1 << 16;
export const SESSIONS = 1 << 8;

/**
 * What a code says: a number that counts up, and which measurement it belongs to, so that another screen in the picture
 * is not taken for ours.
 */
export interface TimeCode {
  readonly counter: number;
  readonly session: number;
}

/**
 * CRC-12 of the two numbers, polynomial x¹² + x¹¹ + x³ + x² + x + 1, begun with ones so that an empty grid is no code.
 */
function checksum(counter: number, session: number): number {
  let crc = 0xfff;
  for (let bit = 23; bit >= 0; bit--) {
    const value = bit >= 8 ? (counter >> (bit - 8)) & 1 : (session >> bit) & 1;
    const top = (crc >> 11) & 1;
    crc = (crc << 1) & 0xfff;
    if (top !== value) crc ^= 0x80f;
  }
  return crc;
}

/**
 * The grid of a code, row by row from the top left: 1 is black. A black frame about 36 bits, most significant first: 16
 * of the counter, 8 of the session, 12 of checksum.
 *
 * @param counter  0 … 65,535
 * @param session  0 … 255
 */
export function codeCells({ counter, session }: TimeCode): Uint8Array {
  const cells = new Uint8Array(CODE_CELLS * CODE_CELLS).fill(1);
  const crc = checksum(counter, session);
  for (let i = 0; i < DATA_BITS; i++) {
    const bit = i < 16 ? (counter >> (15 - i)) & 1 : i < 24 ? (session >> (23 - i)) & 1 : (crc >> (35 - i)) & 1;
    cells[(1 + Math.floor(i / DATA_CELLS)) * CODE_CELLS + 1 + (i % DATA_CELLS)] = bit;
  }
  return cells;
}

/**
 * Reads the inner cells, turned and mirrored in every way a camera may see them; null when no way has this session and
 * the right checksum.
 */
export function readCells(cells: ArrayLike<number>, wanted: number): TimeCode | null {
  for (let way = 0; way < 8; way++) {
    let counter = 0;
    let session = 0;
    let crc = 0;
    for (let i = 0; i < DATA_BITS; i++) {
      const bit = cells[seenAt(way, 1 + Math.floor(i / DATA_CELLS), 1 + (i % DATA_CELLS))]!;
      if (i < 16) counter = counter * 2 + bit;
      else if (i < 24) session = session * 2 + bit;
      else crc = crc * 2 + bit;
    }
    if (session === wanted && checksum(counter, session) === crc) return { counter, session };
  }
  return null;
}
/** Where cell (row, column) of the upright code is seen, by quarter turns 0 … 3, and mirrored from 4 on. */
function seenAt(way: number, row: number, column: number): number {
  const last = CODE_CELLS - 1;
  let r = row;
  let c = way >= 4 ? last - column : column;
  for (let turn = 0; turn < way % 4; turn++) [r, c] = [c, last - r];
  return r * CODE_CELLS + c;
}
