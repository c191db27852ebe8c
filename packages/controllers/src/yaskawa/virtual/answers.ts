import type { VirtualController } from "../../virtual/controller.ts";
import type { PulseScale } from "../codec/axes.ts";
import type { Machine } from "./machine.ts";
import { compose, flangePose, inverse, type Pose, type Robot } from "@twincell/core";
import {
  ADDED,
  ALARM_BYTES,
  COMMAND,
  CYCLE,
  FRAME,
  MAX_DATA_BYTES,
  OFF,
  ON,
  PLURAL,
  POWER,
  RESET,
  SERVICE,
  STATUS,
  formOf,
  placeOf,
  pulsesOf,
  putText,
  putU32,
  readSelection,
  textAt,
  textBytes,
  u32,
  writeAlarm,
  writeJob,
  writePosition,
  writeStatus,
  type HsesRequest,
  type ValueKind,
} from "../codec/index.ts";
import { elapsed, stamp } from "./clock.ts";
import type { Lines, Variables } from "./memory.ts";
import { moveOrders, type MoveOptions, type MoveOrders } from "./moves.ts";

export interface AnswerOptions extends MoveOptions {
  readonly lines: Lines;
  readonly variables: Variables;
  readonly model: string;
  readonly unix_s: () => number;
  /** What the pendant shows. */
  readonly display: (text: string) => void;
}
export interface Answer {
  readonly status: number;
  readonly added: number;
  readonly data: Uint8Array;
}

const NOTHING = new Uint8Array(0);
const well = (data: Uint8Array = NOTHING): Answer => ({ status: STATUS.well, added: 0, data });
const refused = (added: number, status: number = STATUS.refused): Answer => ({ status, added, data: NOTHING });
/** The outcome of an order: 0, or why not. */
const done = (added: number): Answer => (added === 0 ? well() : refused(added));
const noInstance = (): Answer => refused(ADDED.noInstance, STATUS.noInstance);
const noAttribute = (): Answer => refused(ADDED.noAttribute, STATUS.noAttribute);

const AXIS_NAMES = ["S", "L", "U", "R", "B", "T", "E", "W"];
const PLACE_NAMES = ["X", "Y", "Z", "RX", "RY", "RZ", "RE", ""];
const WORDS = (count: number): number[] => Array<number>(count).fill(4);
/** Lengths of the fields of an answer, in order: attribute 1 is the first. */
const FIELDS: Readonly<Record<number, readonly number[]>> = {
  [COMMAND.alarm]: [4, 4, 4, 16, 32],
  [COMMAND.alarmHistory]: [4, 4, 4, 16, 32],
  [COMMAND.status]: WORDS(2),
  [COMMAND.job]: [32, 4, 4, 4],
  [COMMAND.axisNames]: WORDS(8),
  [COMMAND.position]: WORDS(13),
  [COMMAND.positionError]: WORDS(8),
  [COMMAND.torque]: WORDS(8),
  [COMMAND.managementTime]: [16, 12],
  [COMMAND.systemInfo]: [24, 16, 8],
};
const ROBOT_PULSE = 1;
const ROBOT_PLACE = 101;

/** Answers of division 1: what is asked is read, what is ordered is done by the machine. */
export function answerer(options: AnswerOptions): (request: HsesRequest) => Answer {
  return answererOf(new Answers(options));
}

class Answers {
  readonly options: AnswerOptions;
  readonly robot: Robot;
  readonly neutral: VirtualController;
  readonly machine: Machine;
  readonly lines: Lines;
  readonly variables: Variables;
  readonly scale: PulseScale;
  readonly n: number;
  readonly moves: MoveOrders;
  readonly baseFromVendor: Pose<"base", "frame">;
  readonly begun_s: number;

  constructor(options: AnswerOptions) {
    this.options = options;
    this.robot = this.options.robot;
    this.neutral = this.options.neutral;
    this.machine = this.options.machine;
    this.lines = this.options.lines;
    this.variables = this.options.variables;
    this.scale = this.options.scale;
    this.n = this.robot.arm.joints.length;
    this.moves = moveOrders(this.options);
    this.baseFromVendor = this.robot.baseFromVendorWorld as Pose as Pose<"base", "frame">;
    this.begun_s = this.options.unix_s();
  }

  position(instance: number): Uint8Array | undefined {
    const q_rad = this.neutral.jointAngles();
    const axes = new Int32Array(8);
    const head = { form: formOf(this.robot, q_rad), tool: 0, user: 0, extendedForm: 0, axes };
    if (instance === ROBOT_PULSE) {
      pulsesOf(q_rad, this.scale, axes);
      return writePosition({ ...head, type: FRAME.pulse });
    }
    if (instance !== ROBOT_PLACE) return undefined;
    placeOf(compose(inverse(this.baseFromVendor), flangePose(this.robot.arm, q_rad)), axes);
    return writePosition({ ...head, type: FRAME.base });
  }

  names(instance: number): Uint8Array | undefined {
    const all =
      instance === ROBOT_PULSE ? AXIS_NAMES.slice(0, this.n) : instance === ROBOT_PLACE ? PLACE_NAMES : undefined;
    if (all === undefined) return undefined;
    const out = new Uint8Array(32);
    all.forEach((name, i) => {
      putText(out, 4 * i, 4, name);
    });
    return out;
  }

  managementTime(instance: number): Uint8Array | undefined {
    const { servo, playback, motion } = this.machine.time_s;
    const seconds: Readonly<Record<number, number>> = {
      1: this.neutral_s(),
      10: servo,
      11: servo,
      110: playback,
      111: playback,
      210: motion,
      211: motion,
      301: motion,
    };
    const own = seconds[instance];
    if (own === undefined) return undefined;
    const out = textBytes(stamp(this.options.unix_s() - this.neutral_s()), 28);
    putText(out, 16, 12, elapsed(own));
    return out;
  }

  neutral_s(): number {
    return this.options.unix_s() - this.begun_s;
  }

  systemInfo(instance: number): Uint8Array | undefined {
    if (instance !== 11 && instance !== 101) return undefined;
    const out = textBytes("VIRTUAL HSES", 48);
    putText(out, 24, 16, instance === 11 ? this.options.model : "HANDLING");
    putText(out, 40, 8, "1.00");
    return out;
  }

  /** What can only be read; null for other commands. */
  read(command: number, instance: number): Uint8Array | undefined | null {
    switch (command) {
      case COMMAND.alarm:
        return instance >= 1 && instance <= 4 ? writeAlarm(this.machine.alarms[instance - 1]) : undefined;
      case COMMAND.alarmHistory:
        return instance >= 1 && instance <= 100
          ? writeAlarm(this.machine.history[instance - 1])
          : [1000, 2000, 3000, 4000].some(from => instance > from && instance <= from + 100)
            ? new Uint8Array(ALARM_BYTES)
            : undefined;
      case COMMAND.status:
        return instance === 1 ? writeStatus(this.machine.status) : undefined;
      case COMMAND.job:
        return instance === 1
          ? writeJob({ ...this.machine.place, override: this.machine.speedOverride })
          : instance <= 6 && instance > 1
            ? writeJob({ job: "", line: 0, step: 0, override: this.machine.speedOverride })
            : undefined;
      case COMMAND.axisNames:
        return this.names(instance);
      case COMMAND.position:
        return this.position(instance);
      // The virtual robot has ideal drives: it is where it was sent, and nothing measures what that takes.
      case COMMAND.positionError:
      case COMMAND.torque:
        return instance === ROBOT_PULSE ? new Uint8Array(32) : undefined;
      case COMMAND.managementTime:
        return this.managementTime(instance);
      case COMMAND.systemInfo:
        return this.systemInfo(instance);
      default:
        return null;
    }
  }

  toggled(data: Uint8Array, set: (on: boolean) => number): Answer {
    const to = data.length === 4 ? u32(data, 0) : 0;
    return to === ON || to === OFF ? done(set(to === ON)) : refused(data.length === 4 ? ADDED.outOfRange : ADDED.size);
  }

  order({ command, instance, attribute, service, data }: HsesRequest): Answer | null {
    const isOne = attribute === 1 && service === SERVICE.setOne;
    const remote = this.machine.fromOutside();
    switch (command) {
      case COMMAND.reset:
        if (!isOne) return noAttribute();
        return instance !== RESET.alarm && instance !== RESET.error
          ? noInstance()
          : remote !== 0
            ? refused(remote)
            : done(instance === RESET.alarm ? this.machine.resetAlarm() : this.machine.cancelError());
      case COMMAND.power:
        if (!isOne) return noAttribute();
        // Anyone may stop the robot in any mode.
        if (instance === POWER.hold)
          return this.toggled(data, on => (on || remote === 0 ? this.machine.hold("heldByCommand", on) : remote));
        if (instance === POWER.servo) return this.toggled(data, on => (remote === 0 ? this.machine.servo(on) : remote));
        return instance === POWER.hlock ? this.toggled(data, () => remote) : noInstance();
      case COMMAND.cycle: {
        if (!isOne) return noAttribute();
        if (instance !== 2) return noInstance();
        if (remote !== 0) return refused(remote);
        const cycle = data.length === 4 ? u32(data, 0) : 0;
        if (cycle < CYCLE.step || cycle > CYCLE.continuous) return refused(ADDED.outOfRange);
        this.machine.choose(cycle);
        return well();
      }
      case COMMAND.display:
        if (!isOne) return noAttribute();
        if (instance !== 1) return noInstance();
        this.options.display(textAt(data, 0, 30));
        return well();
      case COMMAND.start:
        return !isOne
          ? noAttribute()
          : instance !== 1
            ? noInstance()
            : data.length !== 4
              ? refused(ADDED.size)
              : u32(data, 0) !== ON
                ? refused(ADDED.outOfRange)
                : done(remote || this.machine.start());
      case COMMAND.select: {
        if (attribute !== 0 || service !== SERVICE.setAll) return noAttribute();
        if (instance !== 1) return noInstance();
        const selection = readSelection(data);
        return selection ? done(remote || this.machine.select(selection.job, selection.line)) : refused(ADDED.size);
      }
      case COMMAND.movePulse:
        return service !== SERVICE.setAll ? noAttribute() : done(remote || this.moves.pulse(instance, data));
      case COMMAND.moveCartesian:
        return service !== SERVICE.setAll ? noAttribute() : done(remote || this.moves.cartesian(instance, data));
      default:
        return null;
    }
  }

  value(kind: ValueKind, { instance, attribute, service, data }: HsesRequest): Answer {
    if (instance < kind.first || instance > kind.last) return noInstance();
    const isGet = service === SERVICE.getAll || service === SERVICE.getOne;
    const isSet = service === SERVICE.setAll || service === SERVICE.setOne;
    if ((!isGet && !isSet) || (kind.whole ? attribute > kind.bytes / 4 : attribute > 1)) return noAttribute();
    const isPart = kind.whole && attribute > 0;
    const at = isPart ? 4 * (attribute - 1) : 0;
    const size = isPart ? 4 : kind.bytes;
    const is = this.variables.read(kind, instance);
    if (isGet) return is ? well(is.slice(at, at + size)) : refused(ADDED.noPosition);
    const remote = this.machine.fromOutside();
    if (remote !== 0) return refused(remote);
    if (data.length < size) return refused(ADDED.size);
    const next = is?.slice() ?? new Uint8Array(kind.bytes);
    next.set(data.subarray(0, size), at);
    if (kind.whole && !POSITION_TYPES.includes(u32(next, 0))) return refused(ADDED.positionType);
    this.variables.write(kind, instance, next);
    return well();
  }

  many(request: HsesRequest): Answer {
    const { instance, attribute, service, data } = request;
    const command = request.command - PLURAL;
    const isIo = command === COMMAND.io;
    const kind = this.variables.kind(command);
    const bytes = isIo ? 1 : kind?.bytes;
    if (bytes === undefined) return refused(ADDED.noCommand, STATUS.noCommand);
    if (attribute !== 0 || (service !== SERVICE.getMany && service !== SERVICE.setMany)) return noAttribute();
    if (data.length < 4) return refused(ADDED.size);
    const count = u32(data, 0);
    if (count < 1 || (bytes === 1 && count % 2 === 1)) return refused(ADDED.outOfRange);
    if (4 + count * bytes > MAX_DATA_BYTES) return refused(ADDED.tooLarge);
    const isSet = service === SERVICE.setMany;
    const remote = isSet ? this.machine.fromOutside() : 0;
    if (remote !== 0) return refused(remote);
    if (isSet && data.length < 4 + count * bytes) return refused(ADDED.size);
    // Looked at as a whole first: a refused write changes nothing.
    const last = instance + count - 1;
    if (
      isIo
        ? this.lines.read(instance) === undefined || this.lines.read(last) === undefined
        : instance < kind!.first || last > kind!.last
    )
      return noInstance();
    const out = new Uint8Array(4 + (isSet ? 0 : count * bytes));
    putU32(out, 0, count);
    for (let i = 0; i < count; i++) {
      const at = 4 + i * bytes;
      const one = data.subarray(at, at + bytes);
      if (isSet) {
        if (!isIo) this.variables.write(kind!, instance + i, one);
        else if (!this.lines.write(instance + i, one[0]!)) return refused(ADDED.notAccessible);
        continue;
      }
      const is = isIo ? Uint8Array.of(this.lines.read(instance + i) ?? 0) : this.variables.read(kind!, instance + i);
      if (!is) return refused(ADDED.noPosition);
      out.set(is, at);
    }
    return well(isSet ? NOTHING : out);
  }

  io({ instance, attribute, service, data }: HsesRequest): Answer {
    if (attribute > 1) return noAttribute();
    const is = this.lines.read(instance);
    if (is === undefined) return noInstance();
    if (service === SERVICE.getAll || service === SERVICE.getOne) return well(Uint8Array.of(is));
    if (service !== SERVICE.setAll && service !== SERVICE.setOne) return noAttribute();
    const remote = this.machine.fromOutside();
    if (remote !== 0) return refused(remote);
    if (data.length < 1) return refused(ADDED.size);
    return this.lines.write(instance, data[0]!) ? well() : refused(ADDED.notAccessible);
  }
}

function answererOf(own: Answers): (request: HsesRequest) => Answer {
  return request => {
    const { command, instance, attribute, service } = request;
    if (command >= COMMAND.io + PLURAL && command <= COMMAND.externalAxis + PLURAL) return own.many(request);
    if (command === COMMAND.io) return own.io(request);
    const kind = own.variables.kind(command);
    if (kind) return own.value(kind, request);
    const all = own.read(command, instance);
    if (all === null) return own.order(request) ?? refused(ADDED.noCommand, STATUS.noCommand);
    if (all === undefined) return noInstance();
    if (service === SERVICE.getAll && attribute === 0) return well(all);
    const fields = FIELDS[command]!;
    const size = fields[attribute - 1];
    if (size === undefined || service !== SERVICE.getOne) return noAttribute();
    const at = fields.slice(0, attribute - 1).reduce((sum, length) => sum + length, 0);
    return well(all.slice(at, at + size));
  };
}
const POSITION_TYPES: readonly number[] = Object.values(FRAME);
