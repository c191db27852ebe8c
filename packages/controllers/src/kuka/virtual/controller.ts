import type { CommandOutcome, Interpreted, MoveStep, Robot, Scheduler } from "@twincell/core";
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
  const { robot, scheduler, network, host } = options;
  const axes = kukaAxes(robot);
  if (!axes) throw new RangeError(`How a KUKA controller counts the axes of ${robot.name} is not known.`);
  const log =
    options.log ??
    ((): void => {
      /* Nobody asked for it. */
    });
  const arm = createVirtualController({
    robot,
    scheduler,
    cycle_s: options.cycle_s ?? 0.004,
    name: `Virtual ${robot.name}`,
    ...(options.start_rad ? { start_rad: options.start_rad } : {}),
    ...(options.maxSpeed === undefined ? {} : { maxSpeed: options.maxSpeed }),
  });
  const faults = noFaults();
  const now: Now = { q_rad: arm.jointAngles(), time_s: 0 };
  let booted_s = 0;
  let last_s = 0;
  const timers = new Timers(() => 1000 * now.time_s);
  const globals = new Globals([...LOOP_GLOBALS, ...(options.globals ?? [])], options.digits);
  const machine = new Machine(arm, options.mode ?? "EX", () => {
    programs.interrupted();
  });
  const slow = (step: MoveStep): MoveStep =>
    machine.mode === "T1" ? slowed(robot, step, arm.jointAngles(), T1_MPS) : step;
  const builtins = new Map<string, Builtin>([[LOOP_NAME, new LoopRun(globals, timers, arm, machine, axes, slow)]]);
  const rsi = options.rsi
    ? new RsiRun({ robot, axes, arm, machine, scheduler, network, host, faults, globals, log }, options.rsi)
    : null;
  if (rsi) {
    builtins.set(RSI_NAME, rsi);
    const why = await rsi.open();
    if (why) log(why);
  }
  const programs = new Programs(arm, machine, builtins, robot, options.interpret);
  const identity = {
    model: options.model ?? kukaModel(robot),
    serial: options.serial ?? "800001",
    name: options.name ?? "VIRTUAL",
  };
  const proxy = new Map([
    ["PING", "PONG"],
    ["@PROXY_TYPE", "C3 BRIDGE INTERFACE"],
    ["@PROXY_VERSION", "1.5.0"],
    ["@PROXY_HOSTNAME", identity.name],
    ["@PROXY_ADDRESS", host],
    ["@PROXY_ENABLED", "TRUE"],
    [
      "@PROXY_FEATURES",
      Array.from({ length: C3_TYPES.at(-1)! + 1 }, (_, i) =>
        C3_TYPES.includes(C3_TYPES.at(-1)! - i) ? "1" : "0",
      ).join(""),
    ],
  ]);
  const wiring = options.wiring === undefined ? EXAMPLE_WIRING : options.wiring;
  const wire = (): void => {
    globals.set(TWC.drivesOn, wiring?.drivesOn ?? 0);
    globals.set(TWC.drivesOff, wiring?.drivesOff ?? 0);
  };
  wire();
  /** Automatic External: heard in EXT only, but off is off. */
  const onOutput = (n: number, value: boolean): void => {
    if (!value) return;
    if (n === wiring?.drivesOff) machine.setDrives(false);
    if (n === wiring?.drivesOn && machine.mode === "EX") machine.setDrives(true);
  };
  const variables = kukaVariables({
    robot,
    axes,
    identity,
    machine,
    programs,
    globals,
    timers,
    arm,
    now,
    proxy,
    onOutput,
    ...(options.digits === undefined ? {} : { digits: options.digits }),
  });

  arm.onSample(sample => {
    last_s = sample.time_s;
    if (!faults.frozen) {
      now.q_rad.set(sample.q_rad);
      now.time_s = sample.time_s - booted_s;
    }
    machine.cycle();
    programs.cycle(sample.step);
  });

  const server: C3Server = await serveC3({
    network,
    host,
    port: options.port ?? C3_PORT,
    scheduler,
    faults,
    variables,
    machine,
    programs,
    hostName: identity.name,
    log,
  });
  const sockets: DatagramSocket[] = [];
  if (server.listening.kind === "listening") {
    const { port } = server.listening.address;
    proxy.set("@PROXY_PORT", String(port));
    await answerDiscovery(
      network,
      host,
      port,
      () => hereIAmText(identity),
      socket => {
        sockets.push(socket);
      },
    );
  }

  return {
    robot,
    arm,
    faults,
    variables,
    listening: server.listening,
    get mode() {
      return machine.mode;
    },
    program: programs,
    machine,
    get messages() {
      return machine.messages;
    },
    get drivesOn() {
      return machine.drivesOn;
    },
    get rsiDelay() {
      return rsi ? rsi.delay : null;
    },
    pendant: {
      setMode(mode) {
        machine.setMode(mode);
      },
      setEnabling(pressed) {
        machine.setEnabling(pressed);
      },
      setDrives: on => machine.setDrives(on),
      select: name => programs.select(name),
      start: () => programs.start(),
      stop() {
        programs.hold();
      },
      reset: () => programs.reset(),
      cancel: () => programs.cancel(),
      confirm() {
        machine.confirm();
      },
      setOverride: percent => machine.setOverride(percent),
      async jog(q_rad, ratio = 1) {
        const why = machine.isManual ? machine.hindrance : `The mode is ${machine.mode}; axes are jogged in T1 and T2.`;
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
        return arm.run([slow(step)], { tools: {}, frames: {} });
      },
      setEmergencyStop(pressed) {
        machine.setEmergency(pressed);
      },
      setGuardOpen(open) {
        machine.setSafety(!open);
      },
      fail(because) {
        machine.stop(2, because);
      },
      setInput(n, value) {
        arm.signals.write(`$IN[${n}]`, value);
      },
      write: (name, text) => programs.write(name, text),
    },
    reboot() {
      server.cut();
      machine.stop(1, "");
      programs.cancel();
      booted_s = last_s;
      now.time_s = 0;
      for (const [name, , value] of LOOP_GLOBALS) globals.write(name, value);
      wire();
    },
    close() {
      server.close();
      rsi?.close();
      for (const socket of sockets) socket.close();
      arm.close();
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
