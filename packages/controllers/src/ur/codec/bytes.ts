/** Writes numbers one after the other, big-endian, into bytes that grow. */
export interface Writer {
  u8(value: number): Writer;
  i8(value: number): Writer;
  u32(value: number): Writer;
  i32(value: number): Writer;
  /** A count below 2⁵³. */
  u64(value: number): Writer;
  f32(value: number): Writer;
  f64(value: number): Writer;
  f64s(values: ArrayLike<number>): Writer;
  text(value: string): Writer;
  zeros(count: number): Writer;
  readonly length: number;
  /** A copy of what was written. */
  done(): Uint8Array;
  /** Overwrites four bytes that were written before. */
  i32At(at: number, value: number): void;
}

export function writer(): Writer {
  let bytes = new Uint8Array(256);
  let view = new DataView(bytes.buffer);
  let at = 0;
  const room = (more: number): void => {
    if (at + more <= bytes.length) return;
    const larger = new Uint8Array(Math.max(2 * bytes.length, at + more));
    larger.set(bytes);
    bytes = larger;
    view = new DataView(bytes.buffer);
  };
  const put = (size: number, write: () => void): Writer => {
    room(size);
    write();
    at += size;
    return self;
  };
  const self: Writer = {
    u8: value =>
      put(1, () => {
        view.setUint8(at, value);
      }),
    i8: value =>
      put(1, () => {
        view.setInt8(at, value);
      }),
    u32: value =>
      put(4, () => {
        view.setUint32(at, value);
      }),
    i32: value =>
      put(4, () => {
        view.setInt32(at, value);
      }),
    u64: value =>
      put(8, () => {
        view.setUint32(at, Math.floor(value / 0x1_0000_0000));
        view.setUint32(at + 4, value >>> 0);
      }),
    f32: value =>
      put(4, () => {
        view.setFloat32(at, value);
      }),
    f64: value =>
      put(8, () => {
        view.setFloat64(at, value);
      }),
    f64s(values) {
      for (let i = 0; i < values.length; i++) self.f64(values[i]!);
      return self;
    },
    text(value) {
      for (let i = 0; i < value.length; i++) {
        const code = value.charCodeAt(i);
        self.u8(code < 128 ? code : 63);
      }
      return self;
    },
    zeros(count) {
      for (let i = 0; i < count; i++) self.u8(0);
      return self;
    },
    get length() {
      return at;
    },
    done: () => bytes.slice(0, at),
    i32At(where, value) {
      view.setInt32(where, value);
    },
  };
  return self;
}
