import { writer, type Writer } from "./bytes.ts";
import { ascii, viewOf } from "./rtde.ts";

/** Kinds of packages of the primary and secondary interface, of parts of a state, and of messages. */
export const PACKAGE = { state: 16, message: 20 } as const;
export const PART = { mode: 0, joints: 1, masterboard: 3, cartesian: 4, kinematics: 5, configuration: 6 } as const;
export const MESSAGE = {
  text: 0,
  label: 1,
  popup: 2,
  version: 3,
  safetyMode: 5,
  error: 6,
  key: 7,
  value: 9,
  exception: 10,
} as const;
const HEADER = 5;
/** States have about 1.5 kB; nothing that is meant is larger than this. */
const LARGEST = 1 << 16;

export interface Packages {
  /** Takes what came and hands out whole packages; `body` is lent. A sentence when the bytes cannot be packages. */
  push(bytes: Uint8Array, take: (type: number, body: Uint8Array) => void): string | null;
}

/** Cuts a stream into packages `int32 size | uint8 type | body`. */
export function primaryPackages(): Packages {
  let kept = new Uint8Array(4096);
  let have = 0;
  return {
    push(bytes, take) {
      if (have + bytes.length > kept.length) {
        const larger = new Uint8Array(have + bytes.length);
        larger.set(kept.subarray(0, have));
        kept = larger;
      }
      kept.set(bytes, have);
      have += bytes.length;
      let at = 0;
      while (have - at >= HEADER) {
        const size = viewOf(kept).getInt32(at);
        if (size < HEADER || size > LARGEST) return `A package has ${HEADER} to ${LARGEST} bytes; one of ${size} came.`;
        if (have - at < size) break;
        take(kept[at + 4]!, kept.subarray(at + HEADER, at + size));
        at += size;
      }
      kept.copyWithin(0, at, have);
      have -= at;
      if (kept.length > 2 * LARGEST && have < LARGEST) kept = kept.slice(0, LARGEST);
      return null;
    },
  };
}

const six = (body: (i: number) => void): void => {
  for (let i = 0; i < 6; i++) body(i);
};
function part(out: Writer, kind: number, body: () => void): void {
  const at = out.length;
  out.u32(0).u8(kind);
  body();
  out.i32At(at, out.length - at);
}
function pack(type: number, body: (out: Writer) => void): Uint8Array {
  const out = writer().i32(0).u8(type);
  body(out);
  out.i32At(0, out.length);
  return out.done();
}

/**
 * What one state package says. Angles [rad], lengths [m], poses are x y z and a rotation vector in the controller's
 * base.
 */
export interface PrimaryState {
  readonly time_us: number;
  readonly powerOn: boolean;
  readonly emergencyStopped: boolean;
  readonly protectiveStopped: boolean;
  readonly running: boolean;
  readonly paused: boolean;
  readonly robotMode: number;
  readonly safetyMode: number;
  readonly remote: boolean;
  readonly speedFraction: number;
  readonly q_rad: ArrayLike<number>;
  readonly qd_rad_s: ArrayLike<number>;
  readonly jointMode: number;
  readonly tcp: ArrayLike<number>;
  readonly tcpOffset: ArrayLike<number>;
  readonly digitalIn: number;
  readonly digitalOut: number;
}

/** D-H numbers and limits of the arm, for the parts that clients ask for once. */
export interface PrimaryArm {
  readonly lower_rad: readonly number[];
  readonly upper_rad: readonly number[];
  readonly speed_rad_s: readonly number[];
  readonly acceleration_rad_s2: readonly number[];
  /** 1 UR5, 2 UR10, 3 UR3, 4 UR16, 7 UR20, 8 UR30; 0 when the arm has no number. */
  readonly type: number;
}

const CONTROL_BOX_C = 48;
const CELSIUS = 30;
export function statePackage(state: PrimaryState, arm: PrimaryArm): Uint8Array {
  return pack(PACKAGE.state, out => {
    part(out, PART.mode, () => {
      out
        .u64(state.time_us)
        .u8(1)
        .u8(1)
        .u8(+state.powerOn)
        .u8(+state.emergencyStopped)
        .u8(+state.protectiveStopped)
        .u8(+state.running)
        .u8(+state.paused);
      out.i8(state.robotMode).u8(0).f64(state.speedFraction).f64(state.speedFraction).f64(1).u8(0);
    });
    part(out, PART.joints, () => {
      six(i => {
        out
          .f64(state.q_rad[i] ?? 0)
          .f64(state.q_rad[i] ?? 0)
          .f64(state.qd_rad_s[i] ?? 0)
          .f32(0)
          .f32(CONTROL_BOX_C)
          .f32(CELSIUS)
          .f32(0)
          .u8(state.jointMode);
      });
    });
    part(out, PART.masterboard, () => {
      out
        .u32(state.digitalIn)
        .u32(state.digitalOut)
        .u8(0)
        .u8(0)
        .f64(0)
        .f64(0)
        .i8(0)
        .i8(0)
        .f64(0)
        .f64(0)
        .f32(CELSIUS)
        .f32(CONTROL_BOX_C)
        .f32(0)
        .f32(0);
      out.u8(state.safetyMode).u8(0).u8(0).u32(0).u8(0).u8(0).u8(0);
    });
    part(out, PART.cartesian, () => {
      out
        .f64s(Array.from({ length: 6 }, (_, i) => state.tcp[i] ?? 0))
        .f64s(Array.from({ length: 6 }, (_, i) => state.tcpOffset[i] ?? 0));
    });
    part(out, PART.configuration, () => {
      six(i => {
        out.f64(arm.lower_rad[i] ?? 0).f64(arm.upper_rad[i] ?? 0);
      });
      six(i => {
        out.f64(arm.speed_rad_s[i] ?? 0).f64(arm.acceleration_rad_s2[i] ?? 0);
      });
      // Defaults of joint and tool moves, and the equivalent radius; D-H numbers are not published with the arm and
      // left 0.
      out
        .f64(1.05)
        .f64(1.4)
        .f64(0.25)
        .f64(1.2)
        .f64(0.1)
        .zeros(4 * 48);
      out.i32(0).i32(0).i32(arm.type).i32(0);
    });
  });
}

const message = (time_us: number, source: number, kind: number, body: (out: Writer) => void): Uint8Array =>
  pack(PACKAGE.message, out => {
    out.u64(time_us).u8(source).u8(kind);
    body(out);
  });
/** Where messages come from: the controller, or a program. */
const CONTROLLER = 0xff;
const PROGRAM = 0xfe;

export const versionMessage = (
  time_us: number,
  name: string,
  [major, minor, bugfix, build]: readonly [number, number, number, number],
  date: string,
): Uint8Array =>
  message(time_us, CONTROLLER, MESSAGE.version, out => {
    out.i8(name.length).text(name).u8(major).u8(minor).i32(bugfix).i32(build).text(date);
  });
export const textMessage = (time_us: number, text: string): Uint8Array =>
  message(time_us, PROGRAM, MESSAGE.text, out => {
    out.text(text);
  });
export const safetyModeMessage = (time_us: number, mode: number): Uint8Array =>
  message(time_us, CONTROLLER, MESSAGE.safetyMode, out => {
    out.i32(0).i32(0).u8(mode).u32(0).u32(0);
  });
/** Levels: 0 info, 1 warning, 2 violation, 3 fault. */
export const errorMessage = (time_us: number, code: number, level: number, text: string): Uint8Array =>
  message(time_us, CONTROLLER, MESSAGE.error, out => {
    out.i32(code).i32(0).i32(level).u32(0).u32(0).text(text);
  });
export const keyMessage = (time_us: number, title: string, text: string): Uint8Array =>
  message(time_us, PROGRAM, MESSAGE.key, out => {
    out.i32(0).i32(0).u8(title.length).text(title).text(text);
  });
export const exceptionMessage = (time_us: number, line: number, column: number, text: string): Uint8Array =>
  message(time_us, PROGRAM, MESSAGE.exception, out => {
    out.u32(line).u32(column).text(text);
  });

export type PrimaryMessage =
  | { readonly kind: "text"; readonly text: string }
  | { readonly kind: "version"; readonly name: string; readonly major: number; readonly minor: number }
  | { readonly kind: "safety-mode"; readonly mode: number }
  | { readonly kind: "error"; readonly code: number; readonly level: number; readonly text: string }
  | { readonly kind: "key"; readonly title: string; readonly text: string }
  | { readonly kind: "exception"; readonly line: number; readonly column: number; readonly text: string };
const MESSAGE_HEAD = 10;

/** What a message says; null for kinds that are not understood here, and for bodies that are cut short. */
export function readMessage(body: Uint8Array): PrimaryMessage | null {
  if (body.length < MESSAGE_HEAD) return null;
  const kind = body[9]!;
  const rest = body.subarray(MESSAGE_HEAD);
  const view = viewOf(rest);
  const has = (bytes: number): boolean => rest.length >= bytes;
  switch (kind) {
    case MESSAGE.text:
      return { kind: "text", text: ascii(rest) };
    case MESSAGE.version: {
      const length = rest[0] ?? 0;
      return has(length + 3)
        ? {
            kind: "version",
            name: ascii(rest.subarray(1, 1 + length)),
            major: rest[1 + length]!,
            minor: rest[2 + length]!,
          }
        : null;
    }
    case MESSAGE.safetyMode:
      return has(9) ? { kind: "safety-mode", mode: rest[8]! } : null;
    case MESSAGE.error:
      return has(20)
        ? { kind: "error", code: view.getInt32(0), level: view.getInt32(8), text: ascii(rest.subarray(20)) }
        : null;
    case MESSAGE.key: {
      const length = rest[8] ?? 0;
      return has(9 + length)
        ? { kind: "key", title: ascii(rest.subarray(9, 9 + length)), text: ascii(rest.subarray(9 + length)) }
        : null;
    }
    case MESSAGE.exception:
      return has(8)
        ? { kind: "exception", line: view.getUint32(0), column: view.getUint32(4), text: ascii(rest.subarray(8)) }
        : null;
    default:
      return null;
  }
}

/** The joint angles [rad] and the robot mode of a state package, where it has them. */
export function readState(body: Uint8Array): { readonly q_rad?: Float64Array; readonly robotMode?: number } | null {
  const view = viewOf(body);
  let at = 0;
  let q_rad: Float64Array | undefined;
  let robotMode: number | undefined;
  while (body.length - at >= HEADER) {
    const size = view.getUint32(at);
    const kind = body[at + 4]!;
    if (size < HEADER || at + size > body.length) return null;
    if (kind === PART.joints && size >= HEADER + 6 * 41)
      q_rad = Float64Array.from({ length: 6 }, (_, i) => view.getFloat64(at + HEADER + 41 * i));
    if (kind === PART.mode && size >= HEADER + 16) robotMode = view.getInt8(at + HEADER + 15);
    at += size;
  }
  return { ...(q_rad ? { q_rad } : {}), ...(robotMode === undefined ? {} : { robotMode }) };
}
