import {
  brakingTime_s,
  type CommandOutcome,
  type Interpreted,
  type OperatingMode,
  type Robot,
  type Scheduler,
} from "@twincell/core";
import { latin1Bytes } from "../../http/index.ts";
import type { Address, Network } from "../../transport/index.ts";
import { createVirtualController, type VirtualController } from "../../virtual/index.ts";
import { EGM_CYCLE_S, EGM_FILE, EGM_PORT, EGM_TEXT, EVENT } from "../codec/index.ts";
import { VirtualPendant } from "./cabinet.ts";
import { EgmMotion } from "./egm-motion.ts";
import { Files } from "./files.ts";
import { Lines } from "./lines.ts";
import { Programs } from "./programs.ts";
import { serveRws, type RwsServer } from "./rws-server.ts";

export interface VirtualAbbOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  /** The controller's own address; it is the one that sends first. */
  readonly host: string;
  /** Where it sends its states: the computer that guides it. */
  readonly sensor?: Address;
  /** Where Robot Web Services are served; 0 takes a free port. Without it the controller has none. */
  readonly rws?: number;
  /** Executes RAPID. Without it texts that move by themselves are not understood. */
  readonly interpret?: (text: string) => Interpreted;
  /** What it calls its robot; the robot's name without its vendor when left out. */
  readonly model?: string;
  readonly start_rad?: ArrayLike<number>;
  /** Part of the robot's own joint speeds that it follows targets with. */
  readonly maxSpeed?: number;
  readonly cycle_s?: number;
  /** Without a target for this long the motion is given up [s]; what the program says when left out. */
  readonly commTimeout_s?: number;
  /** How quickly a gap to the target is closed [1/s]: the first-order lag of a guided robot. */
  readonly gain_per_s?: number;
  readonly initialize?: () => void;
  /** Told once about each kind of datagram that is no target, and of request that is none. */
  readonly log?: (sentence: string) => void;
}
/**
 * The cabinet as a person stands before it. The program that waits for targets runs while motors are on, the key is not
 * in manual and nothing is wrong.
 */
export interface AbbPendant {
  /** Away from manual also means: motors on, program started, as a person does it there. */
  setMode(mode: OperatingMode): void;
  jog(q_rad: ArrayLike<number>): Promise<CommandOutcome>;
  emergencyStop(pressed: boolean): void;
  setGuardOpen(open: boolean): void;
  protectiveStop(because: string): void;
  setInput(signal: string, value: boolean | number): void;
  /** What the person at the pendant answers to a client that asks to write in manual mode. */
  grantRemote(granted: boolean): void;
}
export interface VirtualAbb {
  readonly robot: Robot;
  readonly neutral: VirtualController;
  readonly pendant: AbbPendant;
  readonly brakingTime_s: number;
  /** The socket that it sends from. */
  readonly address: Address;
  /** Where Robot Web Services listen; null without them. */
  readonly rws: Address | null;
  /** Neither hears nor says anything over EGM while it is true. */
  frozen: boolean;
  /** Why EGM ended last, or "". */
  readonly message: string;
  /** Robot Web Services break off and let nobody in while it is true. */
  setRefusing(refusing: boolean): void;
  readonly programs: Programs;
  readonly cabinet: VirtualPendant;
  readonly files: Files;
  readonly lines: Lines;
  /** EGM has ended by a fault that waits for a person. */
  readonly hasFailed: boolean;
  reboot(off_s: number): void;
  close(): void;
}
export type AbbStart =
  | { readonly kind: "started"; readonly controller: VirtualAbb }
  | { readonly kind: "taken"; readonly sentence: string };

const LONGEST_CYCLE_S = 0.04;
const GAIN_PER_S = 20;

/**
 * A controller of numbers: it is guided from outside over EGM, and served over Robot Web Services where it has them.
 */
export async function createVirtualAbb(options: VirtualAbbOptions): Promise<AbbStart> {
  const { robot, scheduler, network, host } = options;
  const cycle_s = options.cycle_s ?? EGM_CYCLE_S;
  const log =
    options.log ??
    (() => {
      /* Nobody asked for it. */
    });
  const bound = await network.bind({ host, port: 0 });
  if (bound.kind === "taken") return bound;
  const { socket } = bound;
  const { start_rad, initialize } = options;
  const neutral = createVirtualController({
    robot,
    scheduler,
    cycle_s,
    mode: "remote",
    maxSpeed: options.maxSpeed ?? 1,
    ...(start_rad ? { start_rad } : {}),
    ...(initialize ? { initialize } : {}),
  });
  let isOff = false;
  let byOthers = false;
  let powered_s = scheduler.now_s();
  let cycled_s = powered_s;
  let stopWaiting: () => void = () => {
    /* Nothing is waited for yet. */
  };
  const now_s = (): number => scheduler.now_s() - powered_s;

  const virtualPendant = new VirtualPendant(now_s, because => {
    egm.end("stopped", because);
    programs.interrupted(because);
  });
  const egm = new EgmMotion(
    {
      robot,
      socket,
      to: options.sensor ?? { host, port: EGM_PORT },
      maxSpeed: options.maxSpeed ?? 1,
      gain_per_s: Math.min(1 / LONGEST_CYCLE_S, options.gain_per_s ?? GAIN_PER_S),
      commTimeout_s: options.commTimeout_s,
      log,
      failed(because) {
        virtualPendant.log(EVENT.egm, 3, "EGM error", because);
        programs.interrupted(because);
      },
    },
    neutral.jointAngles(),
  );
  const programs = new Programs(
    neutral,
    virtualPendant,
    {
      start(commTimeout_s) {
        egm.start(commTimeout_s);
      },
      stop() {
        egm.end("stopped", "The program was stopped.");
      },
    },
    options.interpret ?? (() => ({ kind: "not-understood", faults: [] })),
  );
  const files = new Files();
  const lines = new Lines(neutral);
  neutral.onSample(({ gripperClosed, signals }) => {
    lines.take(gripperClosed, signals);
  });
  files.write(["$HOME", EGM_FILE], latin1Bytes(EGM_TEXT));
  programs.load(EGM_TEXT, true);

  /** What a person does in the morning. */
  function start(): void {
    if (virtualPendant.switchOn() !== null) return;
    // What somebody left there moves by itself: that is not started by turning a key.
    if (programs.isRunning || !programs.isGuided) return;
    if (programs.reset() === null) programs.start(null);
  }
  start();

  const stopCycle = scheduler.every(cycle_s, () => {
    // A clock that ticks late is made good in one longer cycle, up to a bound that keeps the lag stable.
    const at_s = scheduler.now_s();
    const dt_s = Math.min(LONGEST_CYCLE_S, at_s - cycled_s);
    cycled_s = at_s;
    if (isOff) {
      egm.standsAt(q_rad => {
        neutral.jointAngles(q_rad);
      });
      return;
    }
    egm.motorsOn = virtualPendant.motorsOn;
    const others = programs.hasArm || neutral.isMoving();
    const hadIt = byOthers;
    byOthers = others;
    // Where they left it is known a cycle later.
    if (others || hadIt)
      egm.standsAt(q_rad => {
        neutral.jointAngles(q_rad);
      });
    else {
      egm.cycle(dt_s);
      neutral.jumpTo(egm.q_rad);
    }
    // A text that moves by itself has ended what was set up for guiding.
    if (programs.isGuided && !egm.frozen) egm.tell(Math.round(now_s() * 1000));
  });

  let server: RwsServer | null = null;
  if (options.rws !== undefined) {
    server = await serveRws({
      network,
      host,
      port: options.rws,
      scheduler,
      log,
      robot,
      model: options.model ?? robot.vendorSection?.model ?? robot.name.replace(/^ABB /, ""),
      q_rad: () => neutral.jointAngles(),
      cabinet: virtualPendant,
      programs,
      files,
      lines,
      isOff: () => isOff,
    });
    if (server.listening.kind === "taken") {
      stopCycle();
      socket.close();
      neutral.close();
      return { kind: "taken", sentence: server.listening.sentence };
    }
  }

  const controller: VirtualAbb = {
    robot,
    neutral,
    programs,
    cabinet: virtualPendant,
    files,
    lines,
    address: socket.address,
    rws: server?.listening.kind === "listening" ? server.listening.address : null,
    brakingTime_s: Math.max(brakingTime_s(robot) + 2 * cycle_s, neutral.brakingTime_s),
    get frozen() {
      return egm.frozen;
    },
    set frozen(is) {
      egm.frozen = is;
    },
    get message() {
      return egm.message;
    },
    get hasFailed() {
      return egm.hasFailed;
    },
    pendant: {
      setMode(to) {
        neutral.atTheRobot.setMode(to);
        virtualPendant.setKey(to === "manual" ? "MANR" : "AUTO");
        if (to !== "manual") start();
      },
      jog: target => neutral.atTheRobot.jog(target),
      emergencyStop(is) {
        virtualPendant.emergencyStop(is);
      },
      setGuardOpen(open) {
        virtualPendant.setGuardOpen(open);
      },
      protectiveStop(because) {
        egm.end("error", because);
        virtualPendant.log(EVENT.failed, 3, "Motion supervision", because);
        programs.interrupted(because);
      },
      setInput(signal, value) {
        lines.setInput(signal, value);
      },
      grantRemote(granted) {
        server?.grantRemote(granted);
      },
    },
    setRefusing(refusing) {
      server?.setRefusing(refusing);
    },
    reboot(off_s) {
      virtualPendant.boot();
      egm.boot();
      server?.boot();
      isOff = true;
      stopWaiting();
      const stop = scheduler.every(off_s, () => {
        stop();
        isOff = false;
        powered_s = scheduler.now_s();
      });
      stopWaiting = stop;
    },
    close() {
      stopWaiting();
      stopCycle();
      server?.close();
      socket.close();
      neutral.close();
    },
  };
  return { kind: "started", controller };
}
