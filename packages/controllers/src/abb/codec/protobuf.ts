/**
 * The few rules of protobuf's wire format that EGM needs. Numbers are little-endian; a field is its number, its kind
 * and its value.
 */
export const VARINT = 0;
export const DOUBLE = 1;
export const BYTES = 2;
export const FLOAT = 5;

/** A value met while reading: of a varint its number, of a double its number, of bytes where they are. */
export type FieldVisitor = (field: number, kind: number, value: number, from: number, to: number) => void;

/**
 * Calls `visit` for each field from `from` to `to`; false when the bytes end in the middle of one or have a kind that
 * nobody uses.
 */
export function readFields(bytes: Uint8Array, from: number, to: number, visit: FieldVisitor): boolean {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let at = from;
  const varint = (): number => {
    let value = 0;
    // Ten bytes hold 64 bits; beyond 2⁵³ digits are lost, which no field of EGM reaches.
    for (let i = 0, scale = 1; i < 10 && at < to; i++, scale *= 128) {
      const byte = bytes[at++]!;
      value += (byte & 127) * scale;
      if (byte < 128) return value;
    }
    return NaN;
  };
  while (at < to) {
    const key = varint();
    if (!(key >= 8)) return false;
    const field = Math.floor(key / 8);
    const kind = key % 8;
    switch (kind) {
      case VARINT: {
        const value = varint();
        if (Number.isNaN(value)) return false;
        visit(field, kind, value, 0, 0);
        break;
      }
      case DOUBLE:
        if (at + 8 > to) return false;
        visit(field, kind, view.getFloat64(at, true), at, at + 8);
        at += 8;
        break;
      case FLOAT:
        if (at + 4 > to) return false;
        visit(field, kind, view.getFloat32(at, true), at, at + 4);
        at += 4;
        break;
      case BYTES: {
        const size = varint();
        if (!(size <= to - at)) return false;
        visit(field, kind, 0, at, at + size);
        at += size;
        break;
      }
      default:
        return false;
    }
  }
  return true;
}

/** Writes into bytes of its own, which are lent until the next `begin`. */
export class FieldWriter {
  private readonly bytes: Uint8Array;
  private readonly view: DataView;
  private at = 0;

  constructor(most: number) {
    this.bytes = new Uint8Array(most);
    this.view = new DataView(this.bytes.buffer);
  }
  begin(): void {
    this.at = 0;
  }
  get lent(): Uint8Array {
    return this.bytes.subarray(0, this.at);
  }

  varint(field: number, value: number): void {
    this.bytes[this.at++] = field * 8 + VARINT;
    this.number(value);
  }
  double(field: number, value: number): void {
    this.bytes[this.at++] = field * 8 + DOUBLE;
    this.view.setFloat64(this.at, value, true);
    this.at += 8;
  }
  /** A message inside this one, of less than 128 bytes times 128. */
  inside(field: number, write: () => void): void {
    this.bytes[this.at++] = field * 8 + BYTES;
    const sizeAt = this.at;
    // Two bytes for the size, the first of which says that another follows: any size below 16384 fits without moving
    // what comes behind.
    this.at += 2;
    write();
    const size = this.at - sizeAt - 2;
    this.bytes[sizeAt] = (size & 127) | 128;
    this.bytes[sizeAt + 1] = size >> 7;
  }
  private number(value: number): void {
    let left = value;
    while (left >= 128) {
      this.bytes[this.at++] = (left % 128) | 128;
      left = Math.floor(left / 128);
    }
    this.bytes[this.at++] = left;
  }
}
