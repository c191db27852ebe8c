import { BYTES, DOUBLE, FieldWriter, VARINT, readFields } from "./protobuf.ts";

/** Where a controller sends its states when nothing else is set up. */
export const EGM_PORT = 6510;
/** One message for each cycle of a controller [s]. */
export const EGM_CYCLE_S = 0.004;
/** How long an EGM motion waits for a target by default (\CommTimeout) [s]. */
export const COMM_TIMEOUT_S = 1;
const TYPE = { command: 1, robot: 2, sensor: 3 } as const;
/** Robot axes and external ones: the seventh axis of an arm is an external one. */
const MOST_AXES = 6;
const MOST_EXTERNAL = 6;

export const MOTORS = { undefined: 0, on: 1, off: 2 } as const;
export const EGM_STATE = { undefined: 0, error: 1, stopped: 2, running: 3 } as const;
export const RAPID = { undefined: 0, stopped: 1, running: 2 } as const;

/** A pose of the tool in the frame that EGM was set up with: place [mm], orientation u0 … u3 (the real part first). */
export interface EgmPose {
  known: boolean;
  readonly position_mm: Float64Array;
  readonly orientation: Float64Array;
}
export const noEgmPose = (): EgmPose => ({
  known: false,
  position_mm: new Float64Array(3),
  orientation: new Float64Array(4),
});

/** What a controller says in each cycle. Angles [deg]; axes beyond the sixth are the external ones. */
export interface EgmRobot {
  sequence: number;
  /** Of the controller's own clock [ms]. */
  time_ms: number;
  axes: number;
  readonly joints_deg: Float64Array;
  readonly pose: EgmPose;
  /** Where it was told to be in this cycle. */
  readonly planned_deg: Float64Array;
  readonly plannedPose: EgmPose;
  motors: number;
  state: number;
  rapid: number;
  converged: boolean;
}
export const noEgmRobot = (): EgmRobot => ({
  sequence: 0,
  time_ms: 0,
  axes: 0,
  joints_deg: new Float64Array(MOST_AXES + MOST_EXTERNAL),
  pose: noEgmPose(),
  planned_deg: new Float64Array(MOST_AXES + MOST_EXTERNAL),
  plannedPose: noEgmPose(),
  motors: 0,
  state: 0,
  rapid: 0,
  converged: false,
});

/** What it is told: where to be, and how fast it goes there [deg, deg/s]. */
export interface EgmSensor {
  sequence: number;
  time_ms: number;
  axes: number;
  readonly joints_deg: Float64Array;
  readonly speeds_deg_s: Float64Array;
  hasSpeeds: boolean;
}
export const noEgmSensor = (): EgmSensor => ({
  sequence: 0,
  time_ms: 0,
  axes: 0,
  joints_deg: new Float64Array(MOST_AXES + MOST_EXTERNAL),
  speeds_deg_s: new Float64Array(MOST_AXES + MOST_EXTERNAL),
  hasSpeeds: false,
});

/** Reads repeated doubles, one by one or packed, from the place of `first`; returns how many there are then. */
function readDoubles(bytes: Uint8Array, from: number, to: number, out: Float64Array, first: number): number {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let count = first;
  const take = (value: number): void => {
    if (count < out.length) out[count++] = value;
  };
  const isWhole = readFields(bytes, from, to, (field, kind, value, begin, end) => {
    if (field !== 1) return;
    if (kind === DOUBLE) take(value);
    if (kind === BYTES) for (let at = begin; at + 8 <= end; at += 8) take(view.getFloat64(at, true));
  });
  return isWhole ? count : -1;
}

/** Joints, then external joints, of a position; -1 when the bytes are damaged. */
function readJoints(
  bytes: Uint8Array,
  from: number,
  to: number,
  robotField: number,
  externalField: number,
  out: Float64Array,
): number {
  let count = 0;
  // The robot's own come first on the wire too: fields are written in order.
  const isWhole = readFields(bytes, from, to, (field, kind, _value, begin, end) => {
    if (kind === BYTES && count >= 0 && (field === robotField || field === externalField))
      count = readDoubles(bytes, begin, end, out, count);
  });
  return isWhole ? count : -1;
}

/** Reads the fields 1, 2, … of a message as doubles; false when one is missing or no number. */
function readNumbers(bytes: Uint8Array, from: number, to: number, out: Float64Array): boolean {
  out.fill(NaN);
  const isWhole = readFields(bytes, from, to, (field, kind, value) => {
    if (kind === DOUBLE && field >= 1 && field <= out.length) out[field - 1] = value;
  });
  return isWhole && out.every(value => Number.isFinite(value));
}

/**
 * The Cartesian part of a position, if it has one: place and quaternion. Euler angles, which some send besides, say the
 * same.
 */
function readPose(bytes: Uint8Array, from: number, to: number, out: EgmPose): void {
  out.known = false;
  let hasPlace = false;
  let hasTurn = false;
  readFields(bytes, from, to, (field, kind, _value, begin, end) => {
    if (field !== 2 || kind !== BYTES) return;
    readFields(bytes, begin, end, (inner, innerKind, _number, first, last) => {
      if (innerKind !== BYTES) return;
      if (inner === 1) hasPlace = readNumbers(bytes, first, last, out.position_mm);
      if (inner === 2) hasTurn = readNumbers(bytes, first, last, out.orientation);
    });
  });
  out.known = hasPlace && hasTurn;
}

function readEnum(bytes: Uint8Array, from: number, to: number): number {
  let value = 0;
  readFields(bytes, from, to, (field, kind, number) => {
    if (field === 1 && kind === VARINT) value = number;
  });
  return value;
}

/**
 * Reads what a controller sent into `out`; one sentence when it is nothing of the kind, and `out` may then be half
 * filled.
 */
export function readEgmRobot(bytes: Uint8Array, out: EgmRobot): string | null {
  let hasHeader = false;
  let isRobot = false;
  let axes = -1;
  out.motors = out.state = out.rapid = 0;
  out.converged = out.pose.known = out.plannedPose.known = false;
  const isWhole = readFields(bytes, 0, bytes.length, (field, kind, value, begin, end) => {
    if (kind === VARINT && field === 6) out.converged = value !== 0;
    if (kind !== BYTES) return;
    switch (field) {
      case 1:
        hasHeader = readFields(bytes, begin, end, (inner, _kind, number) => {
          if (inner === 1) out.sequence = number;
          if (inner === 2) out.time_ms = number;
          if (inner === 3) isRobot = number === TYPE.robot;
        });
        break;
      case 2:
        axes = readJoints(bytes, begin, end, 1, 3, out.joints_deg);
        readPose(bytes, begin, end, out.pose);
        break;
      case 3:
        readJoints(bytes, begin, end, 1, 3, out.planned_deg);
        readPose(bytes, begin, end, out.plannedPose);
        break;
      case 4:
        out.motors = readEnum(bytes, begin, end);
        break;
      case 5:
        out.state = readEnum(bytes, begin, end);
        break;
      case 8:
        out.rapid = readEnum(bytes, begin, end);
        break;
      default:
        break;
    }
  });
  if (!isWhole || !hasHeader) return "The datagram is no message of EGM.";
  if (!isRobot) return "The message of EGM is not one of a robot.";
  if (axes < 1) return "The message of EGM has no joint angles.";
  for (let i = 0; i < axes; i++)
    if (!Number.isFinite(out.joints_deg[i]!)) return `Axis ${i + 1} of the message of EGM is no number.`;
  out.axes = axes;
  return null;
}

/** Reads what a controller is told; one sentence when it is nothing of the kind. */
export function readEgmSensor(bytes: Uint8Array, out: EgmSensor): string | null {
  let hasHeader = false;
  let isSensor = false;
  let axes = -1;
  let speeds = 0;
  out.speeds_deg_s.fill(0);
  const isWhole = readFields(bytes, 0, bytes.length, (field, kind, _value, begin, end) => {
    if (kind !== BYTES) return;
    if (field === 1) {
      hasHeader = readFields(bytes, begin, end, (inner, _kind, number) => {
        if (inner === 1) out.sequence = number;
        if (inner === 2) out.time_ms = number;
        if (inner === 3) isSensor = number === TYPE.sensor;
      });
    }
    if (field === 2) axes = readJoints(bytes, begin, end, 1, 3, out.joints_deg);
    if (field === 3) speeds = readJoints(bytes, begin, end, 1, 3, out.speeds_deg_s);
  });
  if (!isWhole || !hasHeader) return "The datagram is no message of EGM.";
  if (!isSensor) return "The message of EGM is not one of a sensor.";
  if (axes < 1) return "The message of EGM has no joint angles.";
  for (let i = 0; i < axes; i++)
    if (!Number.isFinite(out.joints_deg[i]!) || !Number.isFinite(out.speeds_deg_s[i]!))
      return `Axis ${i + 1} of the message of EGM is no number.`;
  out.axes = axes;
  out.hasSpeeds = speeds > 0;
  return null;
}

/** Writers keep their bytes: what `write` returns is lent until the next call. */
const header = (out: FieldWriter, sequence: number, time_ms: number, type: number): void => {
  out.inside(1, () => {
    out.varint(1, sequence);
    out.varint(2, time_ms);
    out.varint(3, type);
  });
};
const doubles = (out: FieldWriter, field: number, values: Float64Array, from: number, to: number): void => {
  if (to > from)
    out.inside(field, () => {
      for (let i = from; i < to; i++) out.double(1, values[i]!);
    });
};

export function egmRobotWriter(): (message: EgmRobot) => Uint8Array {
  const out = new FieldWriter(1024);
  const numbers = (field: number, values: Float64Array): void => {
    out.inside(field, () => {
      for (let i = 0; i < values.length; i++) out.double(i + 1, values[i]!);
    });
  };
  return message => {
    const { sequence, time_ms, axes, motors, state, rapid, converged } = message;
    const position = (field: number, joints_deg: Float64Array, pose: EgmPose): void => {
      out.inside(field, () => {
        doubles(out, 1, joints_deg, 0, Math.min(axes, MOST_AXES));
        if (pose.known)
          out.inside(2, () => {
            numbers(1, pose.position_mm);
            numbers(2, pose.orientation);
          });
        doubles(out, 3, joints_deg, MOST_AXES, axes);
      });
    };
    out.begin();
    header(out, sequence, time_ms, TYPE.robot);
    position(2, message.joints_deg, message.pose);
    position(3, message.planned_deg, message.plannedPose);
    out.inside(4, () => {
      out.varint(1, motors);
    });
    out.inside(5, () => {
      out.varint(1, state);
    });
    out.varint(6, converged ? 1 : 0);
    out.inside(8, () => {
      out.varint(1, rapid);
    });
    return out.lent;
  };
}

export function egmSensorWriter(): (message: EgmSensor) => Uint8Array {
  const out = new FieldWriter(512);
  return ({ sequence, time_ms, axes, joints_deg, speeds_deg_s }) => {
    out.begin();
    header(out, sequence, time_ms, TYPE.sensor);
    for (const [field, values] of [
      [2, joints_deg],
      [3, speeds_deg_s],
    ] as const) {
      out.inside(field, () => {
        doubles(out, 1, values, 0, Math.min(axes, MOST_AXES));
        doubles(out, 3, values, MOST_AXES, axes);
      });
    }
    return out.lent;
  };
}
