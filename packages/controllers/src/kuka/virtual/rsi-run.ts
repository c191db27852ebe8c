import {
  compose,
  degrees,
  flangePose,
  fromKukaAbc,
  normalizeQuaternion,
  pose,
  seededRandom,
  solveAll,
  toKukaAbc,
  type Pose,
  type Robot,
  type Scheduler,
  type AxisCounting,
  axesOfJoints,
  jointsOfAxes,
} from "@twincell/core";
import type { DatagramSocket, Network } from "../../transport/index.ts";
import type { VirtualController } from "../../virtual/index.ts";
import { AXES, AXIS_NAMES } from "../codec/axes.ts";
import { readRsi, rsiKeys, rsiNumber, rsiWriter, type RsiConfig, type RsiValue } from "../codec/rsi.ts";
import type { Builtin } from "./builtin.ts";
import { TWC } from "../codec/loop.ts";
import type { KukaFaults } from "./faults.ts";
import type { Globals } from "./globals.ts";
import { T1_MPS, type Machine } from "./machine.ts";

export interface RsiOptions {
  readonly config: RsiConfig;
  /** 4 or 12 ms. */
  readonly cycle_s?: 0.004 | 0.012;
  /** Corrections are increments of every cycle, or what is added to where the robot stood when it began. */
  readonly mode?: "relative" | "absolute";
  /** Telegrams that may come late or wrong, in all, before RSI breaks off. */
  readonly timeout?: number;
  /** Most that all corrections together may amount to, either way: AXISCORR and POSCORR. */
  readonly limits?: { readonly axes_deg: number; readonly position_mm: number; readonly rotation_deg: number };
  readonly decimals?: number;
}
const FRAME = ["X", "Y", "Z", "A", "B", "C"] as const;

export interface RsiSources {
  readonly robot: Robot;
  readonly axes: AxisCounting;
  readonly arm: VirtualController;
  readonly machine: Machine;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly faults: KukaFaults;
  readonly globals: Globals;
  readonly log: (sentence: string) => void;
}

/**
 * The robot's side of RSI. It owns IPOC; an answer counts when it carries the IPOC of the telegram before, comes within
 * the cycle and from the sensor of the file. What is missing or wrong counts as late: its corrections are dropped, or
 * held where the file says so.
 */
export class RsiRun implements Builtin {
  private readonly from: RsiSources;
  private readonly options: Required<RsiOptions>;
  private readonly write: (values: ReadonlyMap<string, RsiValue>, ipoc: number) => string;
  private readonly received: ReturnType<typeof rsiKeys>;
  private readonly values = new Map<string, RsiValue>();
  private readonly corrections = new Map<string, number>();
  private readonly start_deg = new Float64Array(AXES);
  private readonly axes_deg = new Float64Array(AXES);
  private readonly total = new Map<string, number>();
  private readonly random = seededRandom(77);
  private socket: DatagramSocket | null = null;
  private start: Pose<"base", "flange"> | null = null;
  private ipoc = 123_456;
  private answer: ReadonlyMap<string, string> | null = null;
  private ticks = 0;
  private late = 0;
  private active = false;
  private complained = false;

  constructor(from: RsiSources, options: RsiOptions) {
    this.from = from;
    this.options = {
      cycle_s: 0.004,
      mode: "relative",
      timeout: 100,
      limits: { axes_deg: 1e6, position_mm: 1e6, rotation_deg: 1e6 },
      decimals: 6,
      ...options,
    };
    this.write = rsiWriter("Rob", "KUKA", options.config.send, this.options.decimals);
    this.received = rsiKeys(options.config.receive);
  }
  get isActive(): boolean {
    return this.active;
  }
  /** Late or wrong telegrams so far: what DEF_Delay says. */
  get delay(): number {
    return this.late;
  }

  /** Takes a port of its own; null when there is none. */
  async open(): Promise<string | null> {
    const { network, host, log } = this.from;
    const bound = await network.bind({ host, port: 0 });
    if (bound.kind === "taken") return bound.sentence;
    this.socket = bound.socket;
    bound.socket.onDatagram(lent => {
      if (!this.active || lent.length > 65_507) return;
      let text = "";
      for (const byte of lent) text += String.fromCharCode(byte);
      const read = readRsi(text, "Sen");
      if (read.kind === "telegram" && read.type === this.options.config.senType && read.ipoc === this.ipoc) {
        this.answer = read.values;
        return;
      }
      // An answer to an earlier telegram is only late; anything else is wrong, which is said once.
      if (read.kind === "telegram" && read.type === this.options.config.senType && read.ipoc < this.ipoc) return;
      if (!this.complained)
        log(`RSI: ${read.kind === "telegram" ? `an answer of “${read.type}” with IPOC ${read.ipoc}` : read.sentence}`);
      this.complained = true;
    });
    return null;
  }
  close(): void {
    this.active = false;
    this.socket?.close();
  }

  begin(): void {
    const { arm, axes, robot } = this.from;
    this.corrections.clear();
    this.total.clear();
    axesOfJoints(axes, arm.jointAngles(), this.start_deg);
    this.start = flangePose(robot.arm, arm.jointAngles());
    // The set point is the program's: corrections do not show in it.
    const start = this.start;
    const angles = toKukaAbc(start.quaternion);
    FRAME.forEach((name, i) => {
      this.values.set(`RSol.${name}`, i < 3 ? 1000 * start.position[i]! : angles[i - 3]!);
    });
    this.answer = null;
    this.late = this.ticks = 0;
    this.active = true;
    this.complained = false;
    this.from.globals.set(TWC.stop, false);
  }
  goOn(): void {
    this.begin();
  }
  abandon(): void {
    this.active = false;
  }
  interrupted(): void {
    this.active = false;
  }

  cycle(): void {
    const { arm, machine, axes, faults } = this.from;
    const { config, cycle_s, timeout } = this.options;
    if (this.active && this.from.globals.bool(TWC.stop)) {
      this.from.globals.set(TWC.stop, false);
      machine.stop(2, "");
    }
    if (!this.active || ++this.ticks % Math.round(cycle_s / 0.004) !== 0) return;
    if (!config.onlySend && this.ticks > Math.round(cycle_s / 0.004)) {
      this.take();
      const why =
        this.late > timeout ? `RSI: ${this.late} telegrams were late or wrong; ${timeout} may be` : this.correct();
      if (why) {
        this.active = false;
        machine.stop(2, why);
        return;
      }
    }
    this.answer = null;
    this.ipoc += Math.round(1000 * cycle_s);
    const q_rad = arm.jointAngles();
    const at = flangePose(this.from.robot.arm, q_rad);
    const angles = toKukaAbc(at.quaternion);
    axesOfJoints(axes, q_rad, this.axes_deg);
    AXIS_NAMES.forEach((name, i) => {
      this.values.set(`AIPos.${name}`, this.axes_deg[i]!).set(`ASPos.${name}`, this.start_deg[i]!);
    });
    FRAME.forEach((name, i) => {
      this.values.set(`RIst.${name}`, i < 3 ? 1000 * at.position[i]! : angles[i - 3]!);
    });
    this.values.set("Delay.D", this.late);
    const bytes = Uint8Array.from(this.write(this.values, this.ipoc), sign => sign.charCodeAt(0) & 255);
    const to = { host: config.ip, port: config.port };
    if (faults.silent || this.random() < faults.loss) return;
    this.socket?.send(bytes, to);
    if (this.random() < faults.duplicates) this.socket?.send(bytes, to);
  }

  /** The corrections in force in this cycle. */
  private take(): void {
    if (!this.answer) this.late++;
    for (const { key, holdOn } of this.received) {
      const value = this.answer ? rsiNumber(this.answer, key) : NaN;
      if (Number.isFinite(value)) this.corrections.set(key, value);
      else if (holdOn === 0) this.corrections.delete(key);
    }
  }

  /** Moves the arm as they say; why RSI ends, or null. */
  private correct(): string | null {
    const { arm, axes, robot, machine } = this.from;
    const { limits, mode, cycle_s } = this.options;
    if (this.corrections.size === 0) return null;
    const sum = (key: string): number => {
      const now = (this.corrections.get(key) ?? 0) + (mode === "relative" ? (this.total.get(key) ?? 0) : 0);
      this.total.set(key, now);
      return now;
    };
    const a = AXIS_NAMES.map(name => sum(`AKorr.${name}`));
    const r = FRAME.map(name => sum(`RKorr.${name}`));
    for (const [i, value] of a.entries())
      if (Math.abs(value) > limits.axes_deg)
        return `RSI: the correction of A${i + 1} is ${value.toFixed(2)}°; its limit is ${limits.axes_deg}°`;
    for (const [i, value] of r.entries()) {
      const limit = i < 3 ? limits.position_mm : limits.rotation_deg;
      if (Math.abs(value) > limit)
        return `RSI: the correction of ${FRAME[i]!} is ${value.toFixed(2)}; its limit is ${limit}`;
    }
    const is_rad = arm.jointAngles();
    const q_rad = new Float64Array(AXES);
    if (r.some(value => value !== 0)) {
      const start = this.start!;
      const turned = compose(pose([0, 0, 0], fromKukaAbc(r[3]!, r[4]!, r[5]!)), pose([0, 0, 0], start.quaternion));
      const wanted: Pose<"base", "flange"> = {
        position: [0, 1, 2].map(i => start.position[i]! + r[i]! / 1000) as [number, number, number],
        quaternion: normalizeQuaternion(turned.quaternion),
      };
      const reach = solveAll(robot, wanted, { near: is_rad });
      if (reach.kind !== "reached") return "RSI: the corrected place is out of reach";
      q_rad.set(reach.solutions[0]!.q_rad);
      axesOfJoints(axes, q_rad, this.axes_deg);
    } else this.axes_deg.set(this.start_deg);
    for (let i = 0; i < AXES; i++) this.axes_deg[i]! += a[i]!;
    jointsOfAxes(axes, this.axes_deg, q_rad);
    for (const [
      i,
      {
        limits: { speed_rad_s },
      },
    ] of robot.arm.joints.entries()) {
      const rate = Math.abs(q_rad[i]! - is_rad[i]!) / cycle_s;
      if (rate > speed_rad_s * (1 + 1e-3))
        return `RSI: A${i + 1} would turn at ${degrees(rate).toFixed(0)}°/s; its limit is ${degrees(speed_rad_s).toFixed(0)}°/s`;
    }
    if (machine.mode === "T1") {
      const from = flangePose(robot.arm, is_rad).position;
      const to = flangePose(robot.arm, q_rad).position;
      if (Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) / cycle_s > T1_MPS)
        return "RSI: faster than T1 allows";
    }
    const moved = arm.jumpTo(q_rad);
    return moved.kind === "done" ? null : `RSI: ${moved.why.sentence}`;
  }
}
