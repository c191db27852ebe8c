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
import { serveFtp } from "./ftp-server.ts";
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
  const { robot, scheduler, network, host } = options;
  const section = sectionForDriver(robot, "fanuc");
  const digits = options.digits ?? 5;
  if (section === undefined || robot.arm.joints.length !== JOINTS)
    return { kind: "taken", sentence: `How a FANUC controller shows the joints of ${robot.name} is not known.` };
  const joints: AxisCounting = section;
  const log =
    options.log ??
    ((): void => {
      /* Nobody asked for it. */
    });
  const arm = createVirtualController({
    robot,
    scheduler,
    name: `Virtual ${robot.name}`,
    ...(options.start_rad ? { start_rad: options.start_rad } : {}),
    ...(options.maxSpeed === undefined ? {} : { maxSpeed: options.maxSpeed }),
  });
  const faults: FanucFaults = { refusing: false, silent: false, delay_s: 0, frozen: false };
  const now_rad = arm.jointAngles();
  const shown = new Float64Array(JOINTS);
  let session: ByteStream | null = null;
  let expected = false;
  let running = false;
  let next = 1;
  let queue: Waiting[] = [];
  let busy: Waiting | null = null;
  let life = 0;
  let time_s = 0;
  let booted_s = 0;
  let last_s = 0;
  let heard_s = 0;
  let complaint = "";
  const programs = new Programs(options.interpret ?? (() => ({ kind: "not-understood", faults: [] })));

  const send = (packet: RmiPacket, to = session): void => {
    if (!to || faults.silent) return;
    const bytes = rmiBytes(packet);
    if (!(faults.delay_s > 0)) {
      to.send(bytes);
      return;
    }
    const stop = scheduler.every(faults.delay_s, () => {
      stop();
      to.send(bytes);
    });
  };
  const answer = ({ name, sequence }: Waiting, ErrorID: number): void => {
    send({ key: "Instruction", name, fields: { ErrorID, SequenceID: sequence } });
  };

  /** RMI_MOVE ends; what waited is forgotten. */
  function abort(): void {
    life++;
    running = false;
    queue = [];
    busy = null;
    machine.hold(false);
  }
  const machine = new FanucMachine(arm, () => {
    if (!running) return;
    const SequenceID = busy?.sequence ?? next - 1;
    abort();
    send({ key: "Communication", name: "FRC_SystemFault", fields: { SequenceID } });
  });
  arm.onSample(sample => {
    last_s = sample.time_s;
    if (faults.frozen) return;
    now_rad.set(sample.q_rad);
    time_s = sample.time_s - booted_s;
  });

  function work(): void {
    if (busy) return;
    const waiting = queue.shift();
    const mine = life;
    if (!waiting) return;
    busy = waiting;
    const end = (id: number): void => {
      if (mine !== life) return;
      busy = null;
      answer(waiting, id);
      work();
    };
    const { instruction } = waiting;
    if (instruction.kind === "error" || instruction.kind === "nothing") {
      end(instruction.kind === "error" ? instruction.id : RMI_ERROR.ok);
      return;
    }
    const callee =
      instruction.kind === "call"
        ? programs.call(instruction.program, arm.signals)
        : ({
            kind: "ready",
            steps: [instruction.make(arm.jointAngles())],
            context: { tools: {}, frames: {} },
          } as const);
    if (callee.kind === "not-understood") {
      complaint = `INTP-105 ${callee.sentence}`;
      end(RMI_ERROR.program);
      return;
    }
    void arm.run(callee.steps, callee.context).then(outcome => {
      if (mine !== life) return;
      if (outcome.kind === "done") {
        end(RMI_ERROR.ok);
        return;
      }
      answer(waiting, RMI_ERROR.position);
      machine.fault(outcome.why.sentence);
    });
  }

  const whyNot = (): number =>
    machine.pendant ? RMI_ERROR.pendant : !machine.ready ? RMI_ERROR.servoOff : RMI_ERROR.ok;
  function command(name: string, fields: Readonly<Record<string, unknown>>): Readonly<Record<string, unknown>> {
    const only = (ErrorID: number): { ErrorID: number } => ({ ErrorID });
    const TimeTag = Math.round(1000 * time_s);
    switch (name) {
      case "FRC_Initialize": {
        const why = whyNot();
        if (why !== RMI_ERROR.ok) return only(why);
        if (running || arm.isMoving()) return only(RMI_ERROR.program);
        abort();
        running = true;
        next = 1;
        return { ...only(RMI_ERROR.ok), GroupMask: 1 };
      }
      case "FRC_Abort":
        if (!running) return only(RMI_ERROR.notRunning);
        abort();
        arm.stop();
        return only(RMI_ERROR.ok);
      case "FRC_Pause":
        if (!running) return only(RMI_ERROR.notRunning);
        machine.hold(true);
        return only(RMI_ERROR.ok);
      case "FRC_Continue":
        if (!machine.isHeld) return only(RMI_ERROR.notPaused);
        machine.hold(false);
        return only(RMI_ERROR.ok);
      case "FRC_Reset":
        complaint = "";
        return only(machine.reset() === null ? RMI_ERROR.ok : RMI_ERROR.failed);
      case "FRC_ReadError":
        return {
          ...only(RMI_ERROR.ok),
          Count: Math.min(1, machine.faults.length),
          ErrorData: machine.faults.at(-1) ?? complaint,
        };
      case "FRC_GetStatus":
        return {
          ...only(RMI_ERROR.ok),
          ServoReady: machine.ready ? 1 : 0,
          TPMode: machine.pendant ? 1 : 0,
          RMIMotionStatus: running ? 1 : 0,
          ProgramStatus: machine.isHeld ? 1 : 0,
          SingleStepMode: 0,
          NumberUTool: 10,
          NumberUFrame: 9,
          NextSequenceID: next,
          Override: machine.override,
        };
      case "FRC_ReadJointAngles":
        return {
          ...only(RMI_ERROR.ok),
          TimeTag,
          JointAngle: jointPart(axesOfJoints(joints, now_rad, shown), digits),
          Group: 1,
        };
      case "FRC_ReadCartesianPosition": {
        const at = compose(inverse(robot.baseFromVendorWorld as Pose), flangePose(robot.arm, now_rad) as Pose);
        const [w, p, r] = toFanucWpr(at.quaternion);
        const [X, Y, Z] = at.position.map(value => Number((1000 * value).toFixed(digits)));
        const [W, P, R] = [w, p, r].map(value => Number(value.toFixed(digits)));
        return {
          ...only(RMI_ERROR.ok),
          TimeTag,
          Configuration: { UToolNumber: 1, UFrameNumber: 0, ...configurationOf(robot, now_rad) },
          Position: { X, Y, Z, W, P, R, Ext1: 0, Ext2: 0, Ext3: 0 },
          Group: 1,
        };
      }
      case "FRC_SetOverRide":
        return only(machine.setOverride(rmiNumber(fields, "Value")) ? RMI_ERROR.ok : RMI_ERROR.override);
      case "FRC_SetUFrameUTool":
        return only(RMI_ERROR.ok);
      case "FRC_GetUFrameUTool":
        return { ...only(RMI_ERROR.ok), UFrameNumber: 0, UToolNumber: 1, Group: 1 };
      case "FRC_ReadDIN": {
        const n = rmiNumber(fields, "PortNumber");
        return Number.isInteger(n) && n > 0
          ? { ...only(RMI_ERROR.ok), PortNumber: n, PortValue: arm.signals.read(`DI[${n}]`) === true ? 1 : 0 }
          : only(RMI_ERROR.value);
      }
      case "FRC_WriteDOUT": {
        const n = rmiNumber(fields, "PortNumber");
        const value = fields["PortValue"];
        if (!(Number.isInteger(n) && n > 0) || (value !== "ON" && value !== "OFF")) return only(RMI_ERROR.value);
        arm.signals.write(`DO[${n}]`, value === "ON");
        return only(RMI_ERROR.ok);
      }
      default:
        return only(RMI_ERROR.command);
    }
  }

  function take(packet: RmiPacket): boolean {
    const { key, name, fields } = packet;
    if (key === "Command") send({ key, name, fields: command(name, fields) });
    else if (key === "Instruction") {
      const sequence = rmiNumber(fields, "SequenceID");
      const reply = {
        name,
        sequence: Number.isFinite(sequence) ? sequence : 0,
        instruction: instructionOf(packet, robot, joints),
      };
      const why = !running
        ? RMI_ERROR.notRunning
        : sequence !== next
          ? RMI_ERROR.sequence
          : queue.length >= MAX_WAITING
            ? RMI_ERROR.failed
            : RMI_ERROR.ok;
      if (why !== RMI_ERROR.ok) {
        answer(reply, why);
        return true;
      }
      next++;
      queue.push(reply);
      work();
    } else if (name === "FRC_Disconnect") {
      send({ key, name, fields: { ErrorID: RMI_ERROR.ok } });
      return false;
    }
    return true;
  }

  /** Lines into packets; whoever sends what is none is logged once and cut off. */
  function attend(stream: ByteStream, onPacket: (packet: RmiPacket) => boolean, over: () => void): void {
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
        log(`${stream.peer.host}:${stream.peer.port}: ${why} The connection is reset.`);
        end();
      }
    });
  }

  const second = await network.listen({ host, port: options.sessionPort ?? RMI_SESSION_PORT }, stream => {
    if (!expected || session || faults.refusing) {
      stream.close();
      return;
    }
    expected = false;
    session = stream;
    heard_s = scheduler.now_s();
    // A motion that was sent is carried out to its end; what waited behind it is not.
    attend(
      stream,
      packet => {
        heard_s = scheduler.now_s();
        return take(packet);
      },
      () => {
        if (session === stream) {
          session = null;
          queue = [];
        }
      },
    );
  });
  if (second.kind === "taken") {
    arm.close();
    return second;
  }
  const first = await network.listen({ host, port: options.port ?? RMI_PORT }, stream => {
    if (faults.refusing) {
      stream.close();
      return;
    }
    attend(
      stream,
      ({ key, name }) => {
        if (key !== "Communication" || name !== "FRC_Connect") {
          send({ key, name, fields: { ErrorID: RMI_ERROR.command } }, stream);
          return true;
        }
        // A client that went without a word holds its place until the system notices; when another asks, so long a
        // silence is taken for that.
        if (session && scheduler.now_s() - heard_s > KEEP_ALIVE_S) {
          session.close();
          session = null;
          queue = [];
        }
        const taken = session !== null;
        if (!taken) expected = true;
        send(
          {
            key,
            name,
            fields: {
              ErrorID: taken ? RMI_ERROR.connected : RMI_ERROR.ok,
              PortNumber: taken ? 0 : second.address.port,
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
    second.close();
    arm.close();
    return first;
  }
  const ftp =
    options.ftpPort === undefined ? null : await serveFtp({ network, host, port: options.ftpPort, programs, log });
  if (ftp?.listening.kind === "taken") {
    first.close();
    second.close();
    arm.close();
    return ftp.listening;
  }

  return {
    kind: "started",
    virtual: {
      robot,
      arm,
      faults,
      programs,
      ports: {
        connect: first.address.port,
        session: second.address.port,
        files: ftp?.listening.kind === "listening" ? ftp.listening.address.port : 0,
      },
      get servosOn() {
        return machine.ready;
      },
      machine,
      isRunning: () => running,
      pendant: {
        setKey(key) {
          machine.setKey(key);
        },
        setEmergencyStop(pressed) {
          machine.setEmergency(pressed);
        },
        setGuardOpen(open) {
          machine.setFence(open);
        },
        fault(text) {
          machine.fault(text);
        },
        reset: () => machine.reset(),
        setInput(n, value) {
          arm.signals.write(`DI[${n}]`, value);
        },
        async jog(q_rad, most = 1) {
          if (!machine.pendant || !machine.ready)
            return {
              kind: "refused",
              why: {
                code: "controller.not-manual",
                sentence: machine.pendant ? "The servos are off." : "The pendant is not enabled.",
                hint: "Turn the key to T1 and reset the faults.",
              },
            };
          const full_mps = jointMoveSpeed(robot, arm.jointAngles(), q_rad, FLANGE);
          const step: MoveStep = {
            id: "jog",
            type: "move",
            path: "ptp",
            target: { q: Array.from(q_rad) },
            speed: { ratio: machine.key === "T1" && full_mps > T1_MPS ? Math.min(most, T1_MPS / full_mps) : most },
            blend_m: 0,
          };
          return arm.run([step], { tools: {}, frames: {} });
        },
      },
      reboot() {
        ftp?.cut();
        session?.close();
        session = null;
        abort();
        machine.fault("SYST-026 System normal power up");
        booted_s = last_s;
        time_s = 0;
      },
      close() {
        first.close();
        second.close();
        ftp?.close();
        session?.close();
        arm.close();
      },
    },
  };
}
export const fanucInput = (signal: string): number => {
  const match = WIRE.exec(signal);
  return match?.[1] === "DI" ? Number(match[2]) : NaN;
};
