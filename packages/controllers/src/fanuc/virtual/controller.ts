import type { Listening } from "../../transport/port.ts";
import {
  compose,
  flangePose,
  inverse,
  toFanucWpr,
  type CommandOutcome,
  type Interpreted,
  type MoveStep,
  type Pose,
  type Robot,
  type Scheduler,
  sectionForDriver,
  axesOfJoints,
  type AxisCounting,
} from "@twincell/core";
import { jointMoveSpeed } from "../../guard/index.ts";
import type { ByteStream, Network } from "../../transport/index.ts";
import { createVirtualController, type VirtualController } from "../../virtual/index.ts";
import {
  jointPart,
  MAX_WAITING,
  RMI_ERROR,
  RMI_PORT,
  RMI_SESSION_PORT,
  RmiReader,
  rmiBytes,
  rmiNumber,
  type RmiPacket,
} from "../codec/rmi.ts";
import { configurationOf, JOINTS } from "../codec/configuration.ts";
import { instructionOf, type Instruction } from "./instructions.ts";
import { serveFtp, type FtpServer } from "./ftp-server.ts";
import { FanucMachine, T1_MPS, type FanucKey } from "./machine.ts";
import { Programs } from "./programs.ts";

export interface VirtualFanucOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  /** 16001, where clients ask, and 16002, where the one that is let in goes. */
  readonly port?: number;
  readonly sessionPort?: number;
  /** Where files are put by FTP; 0 takes a free port. Without it the controller serves none. */
  readonly ftpPort?: number;
  /** Executes TP listings, the first of them one behind the other. Without it none is understood. */
  readonly interpret?: (text: string) => Interpreted;
  readonly start_rad?: ArrayLike<number>;
  readonly maxSpeed?: number;
  readonly digits?: number;
  readonly log?: (sentence: string) => void;
}
export interface FanucPendant {
  setKey(key: FanucKey): void;
  jog(q_rad: ArrayLike<number>, ratio?: number): Promise<CommandOutcome>;
  setEmergencyStop(pressed: boolean): void;
  setGuardOpen(open: boolean): void;
  fault(text: string): void;
  reset(): string | null;
  setInput(n: number, value: boolean): void;
}
export interface FanucFaults {
  refusing: boolean;
  silent: boolean;
  delay_s: number;
  frozen: boolean;
}
export interface VirtualFanuc {
  readonly robot: Robot;
  readonly arm: VirtualController;
  readonly pendant: FanucPendant;
  readonly faults: FanucFaults;
  readonly ports: { readonly connect: number; readonly session: number /** 0 without FTP. */; readonly files: number };
  readonly programs: Programs;
  readonly servosOn: boolean;
  readonly machine: Pick<
    FanucMachine,
    "key" | "pendant" | "emergency" | "fenceOpen" | "faults" | "ready" | "override" | "setOverride"
  >;
  /** Whether RMI_MOVE runs. */
  isRunning(): boolean;
  reboot(): void;
  close(): void;
}
export type FanucStarted =
  | { readonly kind: "started"; readonly virtual: VirtualFanuc }
  | { readonly kind: "taken"; readonly sentence: string };
interface Waiting {
  readonly name: string;
  readonly sequence: number;
  readonly instruction: Instruction;
}

const FLANGE: Pose<"flange", "tcp"> = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };
const VERSION = { MajorVersion: 5, MinorVersion: 0 } as const;
/** Clients ask for states all the time: who says nothing for so long is gone [s]. */
const KEEP_ALIVE_S = 5;
const WIRE = /^(DI|DO)\[([0-9]{1,4})\]$/;

/**
 * A FANUC controller of numbers behind its Remote Motion Interface: one client, eight instructions waiting, servos,
 * pendant, fence.
 */
export async function createVirtualFanuc(options: VirtualFanucOptions): Promise<FanucStarted> {
  const { robot } = options;
  const joints = sectionForDriver(robot, "fanuc");
  return joints === undefined || robot.arm.joints.length !== JOINTS
    ? { kind: "taken", sentence: `How a FANUC controller shows the joints of ${robot.name} is not known.` }
    : openFanuc(options, joints);
}

function openFanuc(options: VirtualFanucOptions, joints: AxisCounting): Promise<FanucStarted> {
  return new FanucControllerState(options, joints).open();
}

class FanucControllerState {
  readonly options: VirtualFanucOptions;
  readonly joints: AxisCounting;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly digits: number;
  readonly log: (sentence: string) => void;
  readonly arm: VirtualController;
  readonly faults: FanucFaults = { refusing: false, silent: false, delay_s: 0, frozen: false };
  readonly now_rad: Float64Array;
  readonly shown = new Float64Array(JOINTS);
  session: ByteStream | null = null;
  expected = false;
  running = false;
  next = 1;
  queue: Waiting[] = [];
  busy: Waiting | null = null;
  life = 0;
  time_s = 0;
  booted_s = 0;
  last_s = 0;
  heard_s = 0;
  complaint = "";
  readonly programs: Programs;
  readonly machine: FanucMachine;
  second!: Listening & { kind: "listening" };
  first!: Listening & { kind: "listening" };
  ftp!: FtpServer | null;

  constructor(options: VirtualFanucOptions, joints: AxisCounting) {
    this.options = options;
    this.joints = joints;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.network = this.options.network;
    this.host = this.options.host;
    this.digits = this.options.digits ?? 5;
    this.log =
      this.options.log ??
      ((): void => {
        /* Nobody asked for it. */
      });
    this.arm = createVirtualController({
      robot: this.robot,
      scheduler: this.scheduler,
      name: `Virtual ${this.robot.name}`,
      ...(this.options.start_rad ? { start_rad: this.options.start_rad } : {}),
      ...(this.options.maxSpeed === undefined ? {} : { maxSpeed: this.options.maxSpeed }),
    });
    this.now_rad = this.arm.jointAngles();
    this.programs = new Programs(this.options.interpret ?? (() => ({ kind: "not-understood", faults: [] })));
    this.machine = new FanucMachine(this.arm, () => {
      if (!this.running) return;
      const SequenceID = this.busy?.sequence ?? this.next - 1;
      this.abort();
      this.send({ key: "Communication", name: "FRC_SystemFault", fields: { SequenceID } });
    });
    this.arm.onSample(sample => {
      this.last_s = sample.time_s;
      if (this.faults.frozen) return;
      this.now_rad.set(sample.q_rad);
      this.time_s = sample.time_s - this.booted_s;
    });
  }

  async open(): Promise<FanucStarted> {
    const second = await this.network.listen(
      { host: this.host, port: this.options.sessionPort ?? RMI_SESSION_PORT },
      stream => {
        if (!this.expected || this.session || this.faults.refusing) {
          stream.close();
          return;
        }
        this.expected = false;
        this.session = stream;
        this.heard_s = this.scheduler.now_s();
        // A motion that was sent is carried out to its end; what waited behind it is not.
        this.attend(
          stream,
          packet => {
            this.heard_s = this.scheduler.now_s();
            return this.take(packet);
          },
          () => {
            if (this.session === stream) {
              this.session = null;
              this.queue = [];
            }
          },
        );
      },
    );
    if (second.kind === "taken") {
      this.arm.close();
      return second;
    }
    this.second = second;
    const first = await this.network.listen({ host: this.host, port: this.options.port ?? RMI_PORT }, stream => {
      if (this.faults.refusing) {
        stream.close();
        return;
      }
      this.attend(
        stream,
        ({ key, name }) => {
          if (key !== "Communication" || name !== "FRC_Connect") {
            this.send({ key, name, fields: { ErrorID: RMI_ERROR.command } }, stream);
            return true;
          }
          // A client that went without a word holds its place until the system notices; when another asks, so long a
          // silence is taken for that.
          if (this.session && this.scheduler.now_s() - this.heard_s > KEEP_ALIVE_S) {
            this.session.close();
            this.session = null;
            this.queue = [];
          }
          const taken = this.session !== null;
          if (!taken) this.expected = true;
          this.send(
            {
              key,
              name,
              fields: {
                ErrorID: taken ? RMI_ERROR.connected : RMI_ERROR.ok,
                PortNumber: taken ? 0 : this.second.address.port,
                ...VERSION,
              },
            },
            stream,
          );
          return true;
        },
        () => {
          /* It goes to the other port. */
        },
      );
    });
    if (first.kind === "taken") {
      this.second.close();
      this.arm.close();
      return first;
    }
    this.first = first;
    this.ftp =
      this.options.ftpPort === undefined
        ? null
        : await serveFtp({
            network: this.network,
            host: this.host,
            port: this.options.ftpPort,
            programs: this.programs,
            log: this.log,
          });
    if (this.ftp?.listening.kind === "taken") {
      this.first.close();
      this.second.close();
      this.arm.close();
      return this.ftp.listening;
    }
    return startedFanuc(this);
  }

  send(packet: RmiPacket, to = this.session): void {
    if (!to || this.faults.silent) return;
    const bytes = rmiBytes(packet);
    if (!(this.faults.delay_s > 0)) {
      to.send(bytes);
      return;
    }
    const stop = this.scheduler.every(this.faults.delay_s, () => {
      stop();
      to.send(bytes);
    });
  }

  answer({ name, sequence }: Waiting, ErrorID: number): void {
    this.send({ key: "Instruction", name, fields: { ErrorID, SequenceID: sequence } });
  }

  /** RMI_MOVE ends; what waited is forgotten. */
  abort(): void {
    this.life++;
    this.running = false;
    this.queue = [];
    this.busy = null;
    this.machine.hold(false);
  }

  work(): void {
    if (this.busy) return;
    const waiting = this.queue.shift();
    const mine = this.life;
    if (!waiting) return;
    this.busy = waiting;
    const end = (id: number): void => {
      if (mine !== this.life) return;
      this.busy = null;
      this.answer(waiting, id);
      this.work();
    };
    const { instruction } = waiting;
    if (instruction.kind === "error" || instruction.kind === "nothing") {
      end(instruction.kind === "error" ? instruction.id : RMI_ERROR.ok);
      return;
    }
    const callee =
      instruction.kind === "call"
        ? this.programs.call(instruction.program, this.arm.signals)
        : ({
            kind: "ready",
            steps: [instruction.make(this.arm.jointAngles())],
            context: { tools: {}, frames: {} },
          } as const);
    if (callee.kind === "not-understood") {
      this.complaint = `INTP-105 ${callee.sentence}`;
      end(RMI_ERROR.program);
      return;
    }
    void this.arm.run(callee.steps, callee.context).then(outcome => {
      if (mine !== this.life) return;
      if (outcome.kind === "done") {
        end(RMI_ERROR.ok);
        return;
      }
      this.answer(waiting, RMI_ERROR.position);
      this.machine.fault(outcome.why.sentence);
    });
  }

  whyNot(): number {
    return this.machine.pendant ? RMI_ERROR.pendant : !this.machine.ready ? RMI_ERROR.servoOff : RMI_ERROR.ok;
  }

  command(name: string, fields: Readonly<Record<string, unknown>>): Readonly<Record<string, unknown>> {
    const only = (ErrorID: number): { ErrorID: number } => ({ ErrorID });
    const TimeTag = Math.round(1000 * this.time_s);
    switch (name) {
      case "FRC_Initialize": {
        const why = this.whyNot();
        if (why !== RMI_ERROR.ok) return only(why);
        if (this.running || this.arm.isMoving()) return only(RMI_ERROR.program);
        this.abort();
        this.running = true;
        this.next = 1;
        return { ...only(RMI_ERROR.ok), GroupMask: 1 };
      }
      case "FRC_Abort":
        if (!this.running) return only(RMI_ERROR.notRunning);
        this.abort();
        this.arm.stop();
        return only(RMI_ERROR.ok);
      case "FRC_Pause":
        if (!this.running) return only(RMI_ERROR.notRunning);
        this.machine.hold(true);
        return only(RMI_ERROR.ok);
      case "FRC_Continue":
        if (!this.machine.isHeld) return only(RMI_ERROR.notPaused);
        this.machine.hold(false);
        return only(RMI_ERROR.ok);
      case "FRC_Reset":
        this.complaint = "";
        return only(this.machine.reset() === null ? RMI_ERROR.ok : RMI_ERROR.failed);
      case "FRC_ReadError":
        return {
          ...only(RMI_ERROR.ok),
          Count: Math.min(1, this.machine.faults.length),
          ErrorData: this.machine.faults.at(-1) ?? this.complaint,
        };
      case "FRC_GetStatus":
        return {
          ...only(RMI_ERROR.ok),
          ServoReady: this.machine.ready ? 1 : 0,
          TPMode: this.machine.pendant ? 1 : 0,
          RMIMotionStatus: this.running ? 1 : 0,
          ProgramStatus: this.machine.isHeld ? 1 : 0,
          SingleStepMode: 0,
          NumberUTool: 10,
          NumberUFrame: 9,
          NextSequenceID: this.next,
          Override: this.machine.override,
        };
      case "FRC_ReadJointAngles":
        return {
          ...only(RMI_ERROR.ok),
          TimeTag,
          JointAngle: jointPart(axesOfJoints(this.joints, this.now_rad, this.shown), this.digits),
          Group: 1,
        };
      case "FRC_ReadCartesianPosition": {
        const at = compose(
          inverse(this.robot.baseFromVendorWorld as Pose),
          flangePose(this.robot.arm, this.now_rad) as Pose,
        );
        const [w, p, r] = toFanucWpr(at.quaternion);
        const [X, Y, Z] = at.position.map(value => Number((1000 * value).toFixed(this.digits)));
        const [W, P, R] = [w, p, r].map(value => Number(value.toFixed(this.digits)));
        return {
          ...only(RMI_ERROR.ok),
          TimeTag,
          Configuration: { UToolNumber: 1, UFrameNumber: 0, ...configurationOf(this.robot, this.now_rad) },
          Position: { X, Y, Z, W, P, R, Ext1: 0, Ext2: 0, Ext3: 0 },
          Group: 1,
        };
      }
      case "FRC_SetOverRide":
        return only(this.machine.setOverride(rmiNumber(fields, "Value")) ? RMI_ERROR.ok : RMI_ERROR.override);
      case "FRC_SetUFrameUTool":
        return only(RMI_ERROR.ok);
      case "FRC_GetUFrameUTool":
        return { ...only(RMI_ERROR.ok), UFrameNumber: 0, UToolNumber: 1, Group: 1 };
      case "FRC_ReadDIN": {
        const n = rmiNumber(fields, "PortNumber");
        return Number.isInteger(n) && n > 0
          ? { ...only(RMI_ERROR.ok), PortNumber: n, PortValue: this.arm.signals.read(`DI[${n}]`) === true ? 1 : 0 }
          : only(RMI_ERROR.value);
      }
      case "FRC_WriteDOUT": {
        const n = rmiNumber(fields, "PortNumber");
        const value = fields["PortValue"];
        if (!(Number.isInteger(n) && n > 0) || (value !== "ON" && value !== "OFF")) return only(RMI_ERROR.value);
        this.arm.signals.write(`DO[${n}]`, value === "ON");
        return only(RMI_ERROR.ok);
      }
      default:
        return only(RMI_ERROR.command);
    }
  }

  take(packet: RmiPacket): boolean {
    const { key, name, fields } = packet;
    if (key === "Command") this.send({ key, name, fields: this.command(name, fields) });
    else if (key === "Instruction") {
      const sequence = rmiNumber(fields, "SequenceID");
      const reply = {
        name,
        sequence: Number.isFinite(sequence) ? sequence : 0,
        instruction: instructionOf(packet, this.robot, this.joints),
      };
      const why = !this.running
        ? RMI_ERROR.notRunning
        : sequence !== this.next
          ? RMI_ERROR.sequence
          : this.queue.length >= MAX_WAITING
            ? RMI_ERROR.failed
            : RMI_ERROR.ok;
      if (why !== RMI_ERROR.ok) {
        this.answer(reply, why);
        return true;
      }
      this.next++;
      this.queue.push(reply);
      this.work();
    } else if (name === "FRC_Disconnect") {
      this.send({ key, name, fields: { ErrorID: RMI_ERROR.ok } });
      return false;
    }
    return true;
  }

  /** Lines into packets; whoever sends what is none is logged once and cut off. */
  attend(stream: ByteStream, onPacket: (packet: RmiPacket) => boolean, over: () => void): void {
    const reader = new RmiReader();
    let isOver = false;
    const end = (): void => {
      if (!isOver) {
        isOver = true;
        over();
        stream.close();
      }
    };
    stream.onEnd(end);
    stream.onBytes(lent => {
      if (isOver) return;
      const why = reader.push(lent, packet => {
        if (!onPacket(packet)) end();
        return !isOver;
      });
      if (why) {
        this.log(`${stream.peer.host}:${stream.peer.port}: ${why} The connection is reset.`);
        end();
      }
    });
  }
}

function startedFanuc(own: FanucControllerState): FanucStarted {
  return {
    kind: "started",
    virtual: {
      robot: own.robot,
      arm: own.arm,
      faults: own.faults,
      programs: own.programs,
      ports: {
        connect: own.first.address.port,
        session: own.second.address.port,
        files: own.ftp?.listening.kind === "listening" ? own.ftp.listening.address.port : 0,
      },
      get servosOn() {
        return own.machine.ready;
      },
      machine: own.machine,
      isRunning: () => own.running,
      pendant: {
        setKey(key) {
          own.machine.setKey(key);
        },
        setEmergencyStop(pressed) {
          own.machine.setEmergency(pressed);
        },
        setGuardOpen(open) {
          own.machine.setFence(open);
        },
        fault(text) {
          own.machine.fault(text);
        },
        reset: () => own.machine.reset(),
        setInput(n, value) {
          own.arm.signals.write(`DI[${n}]`, value);
        },
        async jog(q_rad, most = 1) {
          if (!own.machine.pendant || !own.machine.ready)
            return {
              kind: "refused",
              why: {
                code: "controller.not-manual",
                sentence: own.machine.pendant ? "The servos are off." : "The pendant is not enabled.",
                hint: "Turn the key to T1 and reset the faults.",
              },
            };
          const full_mps = jointMoveSpeed(own.robot, own.arm.jointAngles(), q_rad, FLANGE);
          const step: MoveStep = {
            id: "jog",
            type: "move",
            path: "ptp",
            target: { q: Array.from(q_rad) },
            speed: { ratio: own.machine.key === "T1" && full_mps > T1_MPS ? Math.min(most, T1_MPS / full_mps) : most },
            blend_m: 0,
          };
          return own.arm.run([step], { tools: {}, frames: {} });
        },
      },
      reboot() {
        own.ftp?.cut();
        own.session?.close();
        own.session = null;
        own.abort();
        own.machine.fault("SYST-026 System normal power up");
        own.booted_s = own.last_s;
        own.time_s = 0;
      },
      close() {
        own.first.close();
        own.second.close();
        own.ftp?.close();
        own.session?.close();
        own.arm.close();
      },
    },
  };
}
export const fanucInput = (signal: string): number => {
  const match = WIRE.exec(signal);
  return match?.[1] === "DI" ? Number(match[2]) : NaN;
};
