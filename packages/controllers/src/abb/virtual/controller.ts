import type { DatagramSocket } from "../../transport/port.ts";
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
  const bound = await options.network.bind({ host: options.host, port: 0 });
  return bound.kind === "taken" ? bound : openAbb(options, bound.socket);
}

function openAbb(options: VirtualAbbOptions, socket: DatagramSocket): Promise<AbbStart> {
  return new AbbControllerState(options, socket).open();
}

class AbbControllerState {
  readonly options: VirtualAbbOptions;
  readonly socket: DatagramSocket;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly cycle_s: number;
  readonly log: (sentence: string) => void;
  readonly start_rad: ArrayLike<number> | undefined;
  readonly initialize: (() => void) | undefined;
  readonly neutral: VirtualController;
  isOff = false;
  byOthers = false;
  powered_s: number;
  cycled_s: number;
  readonly virtualPendant: VirtualPendant;
  readonly egm: EgmMotion;
  readonly programs: Programs;
  readonly files = new Files();
  readonly lines: Lines;
  readonly stopCycle: () => void;
  server: RwsServer | null = null;

  constructor(options: VirtualAbbOptions, socket: DatagramSocket) {
    this.options = options;
    this.socket = socket;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.cycle_s = this.options.cycle_s ?? EGM_CYCLE_S;
    this.log =
      this.options.log ??
      (() => {
        /* Nobody asked for it. */
      });
    this.start_rad = this.options.start_rad;
    this.initialize = this.options.initialize;
    this.neutral = createVirtualController({
      robot: this.robot,
      scheduler: this.scheduler,
      cycle_s: this.cycle_s,
      mode: "remote",
      maxSpeed: this.options.maxSpeed ?? 1,
      ...(this.start_rad ? { start_rad: this.start_rad } : {}),
      ...(this.initialize ? { initialize: this.initialize } : {}),
    });
    this.powered_s = this.scheduler.now_s();
    this.cycled_s = this.powered_s;
    this.virtualPendant = new VirtualPendant(this.now_s, because => {
      this.egm.end("stopped", because);
      this.programs.interrupted(because);
    });
    this.egm = new EgmMotion(
      {
        robot: this.robot,
        socket: this.socket,
        to: this.options.sensor ?? { host: this.host, port: EGM_PORT },
        maxSpeed: this.options.maxSpeed ?? 1,
        gain_per_s: Math.min(1 / LONGEST_CYCLE_S, this.options.gain_per_s ?? GAIN_PER_S),
        commTimeout_s: this.options.commTimeout_s,
        log: this.log,
        failed: because => {
          this.virtualPendant.log(EVENT.egm, 3, "EGM error", because);
          this.programs.interrupted(because);
        },
      },
      this.neutral.jointAngles(),
    );
    this.programs = new Programs(
      this.neutral,
      this.virtualPendant,
      {
        start: commTimeout_s => {
          this.egm.start(commTimeout_s);
        },
        stop: () => {
          this.egm.end("stopped", "The program was stopped.");
        },
      },
      this.options.interpret ?? (() => ({ kind: "not-understood", faults: [] })),
    );
    this.lines = new Lines(this.neutral);
    this.neutral.onSample(({ gripperClosed, signals }) => {
      this.lines.take(gripperClosed, signals);
    });
    this.files.write(["$HOME", EGM_FILE], latin1Bytes(EGM_TEXT));
    this.programs.load(EGM_TEXT, true);
    this.start();
    this.stopCycle = this.scheduler.every(this.cycle_s, () => {
      // A clock that ticks late is made good in one longer cycle, up to a bound that keeps the lag stable.
      const at_s = this.scheduler.now_s();
      const dt_s = Math.min(LONGEST_CYCLE_S, at_s - this.cycled_s);
      this.cycled_s = at_s;
      if (this.isOff) {
        this.egm.standsAt(q_rad => {
          this.neutral.jointAngles(q_rad);
        });
        return;
      }
      this.egm.motorsOn = this.virtualPendant.motorsOn;
      const others = this.programs.hasArm || this.neutral.isMoving();
      const hadIt = this.byOthers;
      this.byOthers = others;
      // Where they left it is known a cycle later.
      if (others || hadIt)
        this.egm.standsAt(q_rad => {
          this.neutral.jointAngles(q_rad);
        });
      else {
        this.egm.cycle(dt_s);
        this.neutral.jumpTo(this.egm.q_rad);
      }
      // A text that moves by itself has ended what was set up for guiding.
      if (this.programs.isGuided && !this.egm.frozen) this.egm.tell(Math.round(this.now_s() * 1000));
    });
  }

  async open(): Promise<AbbStart> {
    if (this.options.rws !== undefined) {
      this.server = await serveRws({
        network: this.network,
        host: this.host,
        port: this.options.rws,
        scheduler: this.scheduler,
        log: this.log,
        robot: this.robot,
        model: this.options.model ?? this.robot.vendorSection?.model ?? this.robot.name.replace(/^ABB /, ""),
        q_rad: () => this.neutral.jointAngles(),
        cabinet: this.virtualPendant,
        programs: this.programs,
        files: this.files,
        lines: this.lines,
        isOff: () => this.isOff,
      });
      if (this.server.listening.kind === "taken") {
        this.stopCycle();
        this.socket.close();
        this.neutral.close();
        return { kind: "taken", sentence: this.server.listening.sentence };
      }
    }
    return startedAbb(this);
  }

  stopWaiting: () => void = () => {
    /* Nothing is waited for yet. */
  };

  readonly now_s = (): number => this.scheduler.now_s() - this.powered_s;

  /** What a person does in the morning. */
  start(): void {
    if (this.virtualPendant.switchOn() !== null) return;
    // What somebody left there moves by itself: that is not started by turning a key.
    if (this.programs.isRunning || !this.programs.isGuided) return;
    if (this.programs.reset() === null) this.programs.start(null);
  }
}

function startedAbb(own: AbbControllerState): AbbStart {
  const controller: VirtualAbb = {
    robot: own.robot,
    neutral: own.neutral,
    programs: own.programs,
    cabinet: own.virtualPendant,
    files: own.files,
    lines: own.lines,
    address: own.socket.address,
    rws: own.server?.listening.kind === "listening" ? own.server.listening.address : null,
    brakingTime_s: Math.max(brakingTime_s(own.robot) + 2 * own.cycle_s, own.neutral.brakingTime_s),
    get frozen() {
      return own.egm.frozen;
    },
    set frozen(is) {
      own.egm.frozen = is;
    },
    get message() {
      return own.egm.message;
    },
    get hasFailed() {
      return own.egm.hasFailed;
    },
    pendant: {
      setMode: to => {
        own.neutral.atTheRobot.setMode(to);
        own.virtualPendant.setKey(to === "manual" ? "MANR" : "AUTO");
        if (to !== "manual") own.start();
      },
      jog: target => own.neutral.atTheRobot.jog(target),
      emergencyStop: is => {
        own.virtualPendant.emergencyStop(is);
      },
      setGuardOpen: open => {
        own.virtualPendant.setGuardOpen(open);
      },
      protectiveStop: because => {
        own.egm.end("error", because);
        own.virtualPendant.log(EVENT.failed, 3, "Motion supervision", because);
        own.programs.interrupted(because);
      },
      setInput: (signal, value) => {
        own.lines.setInput(signal, value);
      },
      grantRemote: granted => {
        own.server?.grantRemote(granted);
      },
    },
    setRefusing: refusing => {
      own.server?.setRefusing(refusing);
    },
    reboot: off_s => {
      own.virtualPendant.boot();
      own.egm.boot();
      own.server?.boot();
      own.isOff = true;
      own.stopWaiting();
      const stop = own.scheduler.every(off_s, () => {
        stop();
        own.isOff = false;
        own.powered_s = own.scheduler.now_s();
      });
      own.stopWaiting = stop;
    },
    close: () => {
      own.stopWaiting();
      own.stopCycle();
      own.server?.close();
      own.socket.close();
      own.neutral.close();
    },
  };
  return { kind: "started", controller };
}
