import type { CommandOutcome, Interpreted, MoveStep, Robot, Scheduler, AxisCounting } from "@twincell/core";
import { slowed } from "../../guard/index.ts";
import type { DatagramSocket, Listening, Network } from "../../transport/index.ts";
import { createVirtualController, type VirtualController } from "../../virtual/index.ts";
import { kukaAxes } from "../codec/axes.ts";
import { C3_PORT } from "../codec/c3.ts";
import { hereIAmText, OLD_ANSWER_PORT, OLD_DISCOVERY_PORT, WHERE_ARE_YOU } from "../codec/discovery.ts";
import { LOOP_GLOBALS, LOOP_NAME, RSI_NAME, TWC } from "../codec/loop.ts";
import { kukaModel } from "../codec/models.ts";
import { C3_TYPES, serveC3, type C3Server } from "./c3-server.ts";
import { noFaults, type KukaFaults } from "./faults.ts";
import type { Builtin } from "./builtin.ts";
import { Globals, Timers, type GlobalType } from "./globals.ts";
import { LoopRun } from "./loop-run.ts";
import { Machine, T1_MPS, type KukaMode, type Message } from "./machine.ts";
import { Programs, type ProgramState } from "./programs.ts";
import { RsiRun, type RsiOptions } from "./rsi-run.ts";
import { kukaVariables, type Now, type Variables } from "./variables.ts";

export interface VirtualKukaOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  /** 7000 when left out; 0 takes a free one. */
  readonly port?: number;
  /** Executes KRL: a .src with its .dat behind it. */
  readonly interpret: (text: string) => Interpreted;
  readonly mode?: KukaMode;
  readonly start_rad?: ArrayLike<number>;
  readonly maxSpeed?: number;
  readonly cycle_s?: number;
  readonly model?: string;
  readonly serial?: string;
  readonly name?: string;
  /** Digits of numbers in variables: seven, as a 32-bit REAL has, when left out. */
  readonly digits?: number;
  /** Further global variables: name, type, value. */
  readonly globals?: readonly (readonly [string, GlobalType, string])[];
  /**
   * Outputs that the cell has wired to $DRIVES_ON and, inverted, to $DRIVES_OFF; those of the example when left out,
   * null for none.
   */
  readonly wiring?: { readonly drivesOn: number; readonly drivesOff: number } | null;
  /** RobotSensorInterface, under the program TWINCELL_RSI; without it the controller has none. */
  readonly rsi?: RsiOptions;
  readonly log?: (sentence: string) => void;
}
/** The wiring of the example cell. */
export const EXAMPLE_WIRING = { drivesOn: 997, drivesOff: 998 } as const;

/** What a person does at the robot. Why it cannot be is a sentence; null when it was done. */
export interface KukaPendant {
  setMode(mode: KukaMode): void;
  /** In T1 and T2: pressed brings the drives on, released takes them off. */
  setEnabling(pressed: boolean): void;
  setDrives(on: boolean): string | null;
  select(program: string): string | null;
  start(): string | null;
  stop(): void;
  reset(): string | null;
  cancel(): string | null;
  confirm(): void;
  setOverride(percent: number): boolean;
  /** A joint move by the jog keys, in T1 or T2 with the enabling switch pressed. */
  jog(q_rad: ArrayLike<number>, ratio?: number): Promise<CommandOutcome>;
  setEmergencyStop(pressed: boolean): void;
  /** The gate, or a proximity sensor wired to the operator safety (row T-27). */
  setGuardOpen(open: boolean): void;
  /** The robot stops by itself (STOP 2); the message waits to be confirmed. */
  fail(because: string): void;
  setInput(n: number, value: boolean): void;
  write(name: string, text: string): string | null;
}

export interface VirtualKuka {
  readonly robot: Robot;
  /** The arm that moves; its samples are the truth that drivers are held against. */
  readonly arm: VirtualController;
  readonly pendant: KukaPendant;
  readonly faults: KukaFaults;
  readonly variables: Variables;
  readonly listening: Listening;
  readonly mode: KukaMode;
  readonly machine: Pick<
    Machine,
    "mode" | "isManual" | "emergency" | "safetyClosed" | "stopMessage" | "messages" | "ready" | "override"
  >;
  readonly program: { readonly state: ProgramState; readonly name: string };
  readonly messages: readonly Message[];
  readonly drivesOn: boolean;
  /** Late or wrong answers of the sensor so far; null without RSI. */
  readonly rsiDelay: number | null;
  /** Power off and on: connections cut, program deselected, the clock begins at 0. */
  reboot(): void;
  close(): void;
}

/**
 * A KUKA controller of numbers: mode key, drives, stops, messages, programs, variables over TCP 7000 and discovery over
 * UDP 6999 and 7000. Refuses an arm whose axes are not known (RangeError).
 */
export async function createVirtualKuka(options: VirtualKukaOptions): Promise<VirtualKuka> {
  const { robot } = options;
  const axes = kukaAxes(robot);
  if (!axes) throw new RangeError(`How a KUKA controller counts the axes of ${robot.name} is not known.`);
  return openKuka(options, axes);
}

function openKuka(options: VirtualKukaOptions, axes: AxisCounting): Promise<VirtualKuka> {
  return new KukaControllerState(options, axes).open();
}

class KukaControllerState {
  readonly options: VirtualKukaOptions;
  readonly axes: AxisCounting;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly log: (sentence: string) => void;
  readonly arm: VirtualController;
  readonly faults = noFaults();
  readonly now: Now;
  booted_s = 0;
  last_s = 0;
  readonly timers: Timers;
  readonly globals: Globals;
  readonly machine: Machine;
  readonly builtins: Map<string, Builtin>;
  readonly rsi: RsiRun | null;
  programs!: Programs;
  identity!: { model: string; serial: string; name: string };
  proxy!: Map<string, string>;
  wiring!: { readonly drivesOn: number; readonly drivesOff: number } | null;
  variables!: Variables;
  server!: C3Server;
  readonly sockets: DatagramSocket[] = [];

  constructor(options: VirtualKukaOptions, axes: AxisCounting) {
    this.options = options;
    this.axes = axes;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.log =
      this.options.log ??
      ((): void => {
        /* Nobody asked for it. */
      });
    this.arm = createVirtualController({
      robot: this.robot,
      scheduler: this.scheduler,
      cycle_s: this.options.cycle_s ?? 0.004,
      name: `Virtual ${this.robot.name}`,
      ...(this.options.start_rad ? { start_rad: this.options.start_rad } : {}),
      ...(this.options.maxSpeed === undefined ? {} : { maxSpeed: this.options.maxSpeed }),
    });
    this.now = { q_rad: this.arm.jointAngles(), time_s: 0 };
    this.timers = new Timers(() => 1000 * this.now.time_s);
    this.globals = new Globals([...LOOP_GLOBALS, ...(this.options.globals ?? [])], this.options.digits);
    this.machine = new Machine(this.arm, this.options.mode ?? "EX", () => {
      this.programs.interrupted();
    });
    this.builtins = new Map<string, Builtin>([
      [LOOP_NAME, new LoopRun(this.globals, this.timers, this.arm, this.machine, this.axes, this.slow)],
    ]);
    this.rsi = this.options.rsi
      ? new RsiRun(
          {
            robot: this.robot,
            axes: this.axes,
            arm: this.arm,
            machine: this.machine,
            scheduler: this.scheduler,
            network: this.network,
            host: this.host,
            faults: this.faults,
            globals: this.globals,
            log: this.log,
          },
          this.options.rsi,
        )
      : null;
  }

  async open(): Promise<VirtualKuka> {
    if (this.rsi) {
      this.builtins.set(RSI_NAME, this.rsi);
      const why = await this.rsi.open();
      if (why) this.log(why);
    }
    this.programs = new Programs(this.arm, this.machine, this.builtins, this.robot, this.options.interpret);
    this.identity = {
      model: this.options.model ?? kukaModel(this.robot),
      serial: this.options.serial ?? "800001",
      name: this.options.name ?? "VIRTUAL",
    };
    this.proxy = new Map([
      ["PING", "PONG"],
      ["@PROXY_TYPE", "C3 BRIDGE INTERFACE"],
      ["@PROXY_VERSION", "1.5.0"],
      ["@PROXY_HOSTNAME", this.identity.name],
      ["@PROXY_ADDRESS", this.host],
      ["@PROXY_ENABLED", "TRUE"],
      [
        "@PROXY_FEATURES",
        Array.from({ length: C3_TYPES.at(-1)! + 1 }, (_, i) =>
          C3_TYPES.includes(C3_TYPES.at(-1)! - i) ? "1" : "0",
        ).join(""),
      ],
    ]);
    this.wiring = this.options.wiring === undefined ? EXAMPLE_WIRING : this.options.wiring;
    this.wire();
    this.variables = kukaVariables({
      robot: this.robot,
      axes: this.axes,
      identity: this.identity,
      machine: this.machine,
      programs: this.programs,
      globals: this.globals,
      timers: this.timers,
      arm: this.arm,
      now: this.now,
      proxy: this.proxy,
      onOutput: this.onOutput,
      ...(this.options.digits === undefined ? {} : { digits: this.options.digits }),
    });
    this.arm.onSample(sample => {
      this.last_s = sample.time_s;
      if (!this.faults.frozen) {
        this.now.q_rad.set(sample.q_rad);
        this.now.time_s = sample.time_s - this.booted_s;
      }
      this.machine.cycle();
      this.programs.cycle(sample.step);
    });
    this.server = await serveC3({
      network: this.network,
      host: this.host,
      port: this.options.port ?? C3_PORT,
      scheduler: this.scheduler,
      faults: this.faults,
      variables: this.variables,
      machine: this.machine,
      programs: this.programs,
      hostName: this.identity.name,
      log: this.log,
    });
    if (this.server.listening.kind === "listening") {
      const { port } = this.server.listening.address;
      this.proxy.set("@PROXY_PORT", String(port));
      await answerDiscovery(
        this.network,
        this.host,
        port,
        () => hereIAmText(this.identity),
        socket => {
          this.sockets.push(socket);
        },
      );
    }
    return virtualKukaOf(this);
  }

  readonly slow = (step: MoveStep): MoveStep =>
    this.machine.mode === "T1" ? slowed(this.robot, step, this.arm.jointAngles(), T1_MPS) : step;

  wire(): void {
    this.globals.set(TWC.drivesOn, this.wiring?.drivesOn ?? 0);
    this.globals.set(TWC.drivesOff, this.wiring?.drivesOff ?? 0);
  }

  /** Automatic External: heard in EXT only, but off is off. */
  readonly onOutput = (n: number, value: boolean): void => {
    if (!value) return;
    if (n === this.wiring?.drivesOff) this.machine.setDrives(false);
    if (n === this.wiring?.drivesOn && this.machine.mode === "EX") this.machine.setDrives(true);
  };
}

function virtualKukaOf(own: KukaControllerState): VirtualKuka {
  return {
    robot: own.robot,
    arm: own.arm,
    faults: own.faults,
    variables: own.variables,
    listening: own.server.listening,
    get mode() {
      return own.machine.mode;
    },
    program: own.programs,
    machine: own.machine,
    get messages() {
      return own.machine.messages;
    },
    get drivesOn() {
      return own.machine.drivesOn;
    },
    get rsiDelay() {
      return own.rsi ? own.rsi.delay : null;
    },
    pendant: {
      setMode(mode) {
        own.machine.setMode(mode);
      },
      setEnabling(pressed) {
        own.machine.setEnabling(pressed);
      },
      setDrives: on => own.machine.setDrives(on),
      select: name => own.programs.select(name),
      start: () => own.programs.start(),
      stop() {
        own.programs.hold();
      },
      reset: () => own.programs.reset(),
      cancel: () => own.programs.cancel(),
      confirm() {
        own.machine.confirm();
      },
      setOverride: percent => own.machine.setOverride(percent),
      async jog(q_rad, ratio = 1) {
        const why = own.machine.isManual
          ? own.machine.hindrance
          : `The mode is ${own.machine.mode}; axes are jogged in T1 and T2.`;
        if (why)
          return {
            kind: "refused",
            why: {
              code: "controller.not-manual",
              sentence: why,
              hint: "Turn the key to T1 and press the enabling switch.",
            },
          };
        const step: MoveStep = {
          id: "jog",
          type: "move",
          path: "ptp",
          target: { q: Array.from(q_rad) },
          speed: { ratio },
          blend_m: 0,
        };
        return own.arm.run([own.slow(step)], { tools: {}, frames: {} });
      },
      setEmergencyStop(pressed) {
        own.machine.setEmergency(pressed);
      },
      setGuardOpen(open) {
        own.machine.setSafety(!open);
      },
      fail(because) {
        own.machine.stop(2, because);
      },
      setInput(n, value) {
        own.arm.signals.write(`$IN[${n}]`, value);
      },
      write: (name, text) => own.programs.write(name, text),
    },
    reboot() {
      own.server.cut();
      own.machine.stop(1, "");
      own.programs.cancel();
      own.booted_s = own.last_s;
      own.now.time_s = 0;
      for (const [name, , value] of LOOP_GLOBALS) own.globals.write(name, value);
      own.wire();
    },
    close() {
      own.server.close();
      own.rsi?.close();
      for (const socket of own.sockets) socket.close();
      own.arm.close();
    },
  };
}

/**
 * What a person does in the morning: messages confirmed, drives on, our program selected and started. Null, or what
 * stands in the way.
 */
export function startLoop(kuka: VirtualKuka, name: typeof LOOP_NAME | typeof RSI_NAME = LOOP_NAME): string | null {
  const { pendant, program } = kuka;
  pendant.confirm();
  const why = pendant.setDrives(true) ?? (program.name === name ? null : pendant.select(name)) ?? pendant.start();
  // On the path a person starts once more; EXT goes on by itself.
  return why ?? (kuka.mode === "EX" ? null : pendant.start());
}

/** On the port of the variables and on the old one; a port that is taken is left to who has it. */
async function answerDiscovery(
  network: Network,
  host: string,
  port: number,
  text: () => string,
  opened: (socket: DatagramSocket) => void,
): Promise<void> {
  for (const [at, answer] of [
    [port, 0],
    [OLD_DISCOVERY_PORT, OLD_ANSWER_PORT],
  ] as const) {
    const bound = await network.bind({ host, port: at });
    if (bound.kind === "taken") continue;
    opened(bound.socket);
    bound.socket.onDatagram((lent, from) => {
      if (lent.length !== WHERE_ARE_YOU.length || String.fromCharCode(...lent) !== WHERE_ARE_YOU) return;
      bound.socket.send(
        Uint8Array.from(text(), sign => sign.charCodeAt(0) & 255),
        { host: from.host, port: answer === 0 ? from.port : answer },
      );
    });
  }
}
