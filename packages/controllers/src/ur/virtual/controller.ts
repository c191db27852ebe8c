import type { Pose, JointLimits, Robot, Scheduler, JointSample } from "@twincell/core";
import { createVirtualController, type VirtualController } from "../../virtual/index.ts";
import type { ByteStream, Listening, Network } from "../../transport/index.ts";
import type { StartedDriver, VendorVirtual, VendorVirtualOptions } from "../../driver/index.ts";
import { JOINTS, modelOf, typeOf, UR_PORTS, type UrPorts } from "../codec/models.ts";
import { EMERGENCY_STOPS, JOINT_MODE, ROBOT_MODE, RUNTIME, SAFETY_MODE } from "../codec/modes.ts";
import { realTimeWriter } from "../codec/real-time.ts";
import {
  errorMessage,
  exceptionMessage,
  keyMessage,
  safetyModeMessage,
  statePackage,
  textMessage,
  versionMessage,
  type PrimaryArm,
} from "../codec/primary.ts";
import type { Version } from "../codec/rtde.ts";
import type { Field } from "../codec/rtde-fields.ts";
import type { ScriptFault } from "./script/index.ts";
import { DashboardServer } from "./dashboard-server.ts";
import { noFaults, Outbox, type UrFaults } from "./faults.ts";
import { GRIPPER_BIT, NamedLines } from "./lines.ts";
import { Memory } from "./memory.ts";
import { Mover } from "./mover.ts";
import { urPendant, type Panel, type UrPendant } from "./pendant.ts";
import { Programs } from "./programs.ts";
import { RtdeServer } from "./rtde-server.ts";
import { ScriptServer, type ScriptServerOptions } from "./script-server.ts";
import { stateFiller } from "./state-filler.ts";
import { States } from "./states.ts";

export interface VirtualUrOptions extends Omit<VendorVirtualOptions, "host"> {
  readonly host?: string;
  readonly worldFromBase?: Pose<"world", "base">;
  /** What it says it is, where that is not the robot it has. */
  readonly model?: string;
  readonly serial?: string;
  readonly version?: Version;
  /** Ready to move, or as after switching on. */
  readonly begins?: "running" | "powered-off";
  readonly remote?: boolean;
  readonly powerOn_s?: number;
  readonly brakes_s?: number;
  /** What the clock of the controller says at the beginning [s]; clients mistrust one that has just booted. */
  readonly booted_s?: number;
  /** Programs by name, for "load". */
  readonly files?: ReadonlyMap<string, string>;
  readonly onMotion?: (q_rad: ArrayLike<number>) => void;
  readonly log?: (sentence: string) => void;
}

export interface UrState {
  readonly q_rad: Float64Array;
  readonly robotMode: number;
  readonly safetyMode: number;
  readonly runtime: number;
  readonly moving: boolean;
  readonly remote: boolean;
  readonly speedFraction: number;
  /** Cycles since it was switched on. */
  readonly cycles: number;
}

export interface VirtualUr extends VendorVirtual {
  readonly faults: UrFaults;
  readonly pendant: UrPendant;
  readonly state: UrState;
  readonly memory: Memory;
  digitalOut(bit: number): boolean;
}
export type UrStarted =
  | { readonly kind: "started"; readonly virtual: VirtualUr }
  | Extract<StartedDriver, { kind: "taken" }>;

const CYCLE_S = 0.002;
/** The primary interface tells its state ten times a second. */
const PRIMARY_CYCLES = 50;
const DEFAULTS = {
  version: [5, 12, 0, 1_101_319] as Version,
  serial: "20225500001",
  booted_s: 60,
  powerOn_s: 1.5,
  brakes_s: 1,
  host: "127.0.0.1",
} as const;
/** Error of a script that comes while the controller is not in remote control. */
const READ_ONLY = 210;
const VIOLATION = 2;

/**
 * A controller of Universal Robots made of numbers: its ports, its states, its programs, in front of the neutral
 * virtual robot that moves.
 */
export async function createVirtualUr(options: VirtualUrOptions): Promise<UrStarted> {
  const { name, arm } = options.robot;
  return arm.joints.length === JOINTS
    ? openUr(options)
    : {
        kind: "taken",
        sentence: `${name} has ${arm.joints.length} joints; robots of Universal Robots have ${JOINTS}.`,
      };
}

function openUr(options: VirtualUrOptions): Promise<UrStarted> {
  return new UrControllerState(options).open();
}

class UrControllerState {
  readonly options: VirtualUrOptions;
  readonly robot: Robot;
  readonly network: Network;
  readonly scheduler: Scheduler;
  readonly version: Version;
  readonly host: string;
  readonly log: (sentence: string) => void;
  readonly neutral: VirtualController;
  readonly memory = new Memory();
  readonly mover: Mover;
  readonly lines: NamedLines;
  readonly faults = noFaults();
  cycles = 0;
  booted_s: number;
  frozen = false;
  gripper = false;
  isClosed = false;
  readonly panel: Panel;
  // Delays are the wire's, not the controller's: they go on while it hangs.
  readonly outbox: Outbox;
  readonly states: States;
  readonly programs: Programs;
  readonly GROUPS = [
    ["standard", 0, 8],
    ["configurable", 8, 8],
    ["tool", 16, 2],
  ] as const;
  readonly model: string;
  readonly common: { outbox: Outbox; log: (sentence: string) => void };
  readonly rtde: RtdeServer;
  readonly dashboard: DashboardServer;
  readonly joints: JointLimits[];
  readonly arm: PrimaryArm;
  readonly tcp = new Float64Array(6);
  readonly offset = new Float64Array(6);
  readonly slotTcp: number;
  readonly slotOffset: number;
  readonly primary: ScriptServer;
  readonly secondary: ScriptServer;
  readonly realTime: ScriptServer;
  readonly primaryCopy: ScriptServer;
  readonly secondaryCopy: ScriptServer;
  readonly realTimeCopy: ScriptServer;
  readonly packageTellers: ScriptServer[];
  readonly streams: ScriptServer[];
  readonly realTimePackage = realTimeWriter();
  readonly fill: (time_s: number, q: Float64Array, fraction: number) => void;
  readonly wanted: {
    dashboard: number;
    primary: number;
    secondary: number;
    realTime: number;
    rtde: number;
    primaryCopy: number;
    secondaryCopy: number;
    realTimeCopy: number;
  };
  readonly routes: Extract<Listening, { kind: "listening" }>[] = [];
  readonly servers: Readonly<Record<keyof UrPorts, { accept(stream: ByteStream): void; closeAll(): void }>>;
  readonly ports: Record<keyof UrPorts, number>;

  constructor(options: VirtualUrOptions) {
    this.options = options;
    this.robot = this.options.robot;
    this.network = this.options.network;
    this.scheduler = this.options.scheduler;
    this.version = this.options.version ?? DEFAULTS.version;
    this.host = this.options.host ?? DEFAULTS.host;
    this.log =
      this.options.log ??
      (() => {
        /* Nobody listens. */
      });
    this.neutral = createVirtualController({
      robot: this.robot,
      scheduler: this.scheduler,
      cycle_s: CYCLE_S,
      ...(this.options.start_rad ? { start_rad: this.options.start_rad } : {}),
      ...(this.options.maxSpeed === undefined ? {} : { maxSpeed: this.options.maxSpeed }),
      ...(this.options.worldFromBase ? { worldFromBase: this.options.worldFromBase } : {}),
      ...(this.options.onMotion ? { onMotion: this.options.onMotion } : {}),
    });
    this.mover = new Mover(this.neutral, this.robot, CYCLE_S);
    this.lines = new NamedLines(this.memory, this.neutral.signals);
    this.booted_s = this.options.booted_s ?? DEFAULTS.booted_s;
    this.panel = { remote: this.options.remote ?? true, operational: "NONE", fraction: 1 };
    this.outbox = new Outbox(this.faults, () => this.scheduler.now_s());
    this.states = this.makeStates();
    this.programs = this.makePrograms();
    this.model = this.options.model ?? modelOf(this.robot);
    this.common = { outbox: this.outbox, log: this.log };
    this.rtde = new RtdeServer({
      ...this.common,
      memory: this.memory,
      version: this.version,
      cycle_s: CYCLE_S,
      now_s: this.now_s,
      onInputs: this.onInputs,
    });
    this.dashboard = this.makeDashboard();
    this.joints = this.robot.arm.joints.map(({ limits }) => limits);
    this.arm = {
      lower_rad: this.joints.map(limits => limits.lower_rad),
      upper_rad: this.joints.map(limits => limits.upper_rad),
      speed_rad_s: this.joints.map(limits => limits.speed_rad_s),
      acceleration_rad_s2: this.joints.map(limits => limits.acceleration_rad_s2),
      type: typeOf(this.model),
    };
    this.slotTcp = this.memory.slotOf("actual_TCP_pose");
    this.slotOffset = this.memory.slotOf("tcp_offset");
    const { greeting, onScript } = this;
    const script = (name: string, way: Pick<ScriptServerOptions, "greeting" | "onScript">): ScriptServer =>
      new ScriptServer({ ...this.common, name, ...way });
    this.primary = script("Primary interface", { greeting, onScript });
    this.secondary = script("Secondary interface", { greeting, onScript });
    this.realTime = script("Real-time interface", { greeting: () => [], onScript });
    this.primaryCopy = script("Primary interface, read-only", { greeting });
    this.secondaryCopy = script("Secondary interface, read-only", { greeting });
    this.realTimeCopy = script("Real-time interface, read-only", { greeting: () => [] });
    this.packageTellers = [this.primary, this.secondary, this.primaryCopy, this.secondaryCopy];
    this.streams = [this.realTime, this.realTimeCopy];
    this.fill = stateFiller(this.robot, this.memory, this.mover, this.states, this.programs);
    this.states.begin(this.options.begins === "powered-off" ? ROBOT_MODE.POWER_OFF : ROBOT_MODE.RUNNING);
    this.neutral.onSample(sample => {
      this.cycle(sample);
    });
    this.wanted = { ...UR_PORTS, ...this.options.ports };
    this.servers = {
      dashboard: this.dashboard,
      primary: this.primary,
      secondary: this.secondary,
      realTime: this.realTime,
      rtde: this.rtde,
      primaryCopy: this.primaryCopy,
      secondaryCopy: this.secondaryCopy,
      realTimeCopy: this.realTimeCopy,
    };
    this.ports = { ...this.wanted };
  }

  private makeStates(): States {
    return new States({
      powerOn_s: this.options.powerOn_s ?? DEFAULTS.powerOn_s,
      brakes_s: this.options.brakes_s ?? DEFAULTS.brakes_s,
      onStop: (how, because) => {
        this.log(because);
        if (how === "hold" && this.programs.pause()) return;
        this.programs.end();
      },
      onResume: () => {
        this.programs.resume();
      },
      onSafety: mode => {
        this.tell(safetyModeMessage(this.time_us(), mode));
      },
    });
  }

  private makePrograms(): Programs {
    return new Programs({
      mover: this.mover,
      lines: this.lines,
      interpret: this.options.interpret,
      onFault: this.onFault,
      host: {
        robot: this.robot,
        memory: this.memory,
        mover: this.mover,
        cycle_s: CYCLE_S,
        now_s: this.now_s,
        protectiveStop: this.protectiveStop,
        say: text => {
          this.tell(textMessage(this.time_us(), text));
        },
      },
      onStarted: name => {
        this.tell(keyMessage(this.time_us(), "PROGRAM_XXX_STARTED", name));
      },
      onStopped: name => {
        this.tell(keyMessage(this.time_us(), "PROGRAM_XXX_STOPPED", name));
      },
    });
  }

  private makeDashboard(): DashboardServer {
    return new DashboardServer({
      ...this.common,
      states: this.states,
      programs: this.programs,
      version: this.version,
      model: this.model,
      now_s: this.now_s,
      serial: this.options.serial ?? DEFAULTS.serial,
      isRemote: () => this.panel.remote,
      operationalMode: () => this.panel.operational,
      setOperationalMode: mode => {
        this.panel.operational = mode;
      },
      file: name => this.options.files?.get(name),
    });
  }

  /** One cycle of the controller. */
  private cycle(sample: JointSample): void {
    this.outbox.cycle();
    if (this.frozen !== this.faults.frozen) {
      this.frozen = this.faults.frozen;
      this.mover.hold(this.frozen);
    }
    if (this.frozen) return;
    this.cycles++;
    if (sample.gripperClosed !== this.gripper) {
      this.gripper = sample.gripperClosed;
      this.memory.setDigital("output", GRIPPER_BIT, this.gripper);
    }
    const q = this.mover.cycle(sample);
    this.fill(this.booted_s + this.now_s(), q, this.panel.fraction);
    this.states.cycle(this.now_s());
    const ended = this.programs.cycle();
    if (ended !== "") {
      this.log(ended);
      this.tell(errorMessage(this.time_us(), 0, 1, ended));
    }
    this.rtde.cycle(this.cycles);
    if (this.realTime.clients + this.realTimeCopy.clients > 0) {
      const bytes = this.realTimePackage(this.memory.slots);
      for (const server of this.streams) server.tell(bytes, true);
    }
    if (this.cycles % PRIMARY_CYCLES === 0 && this.packageTellers.some(({ clients }) => clients > 0)) {
      const bytes = this.packaged();
      for (const server of this.packageTellers) server.tell(bytes, true);
    }
  }

  async open(): Promise<UrStarted> {
    for (const name of Object.keys(this.servers) as (keyof UrPorts)[]) {
      const route = await this.network.listen({ host: this.host, port: this.wanted[name] }, stream => {
        if (this.faults.refusing || this.isClosed) stream.close();
        else this.servers[name].accept(stream);
      });
      if (route.kind === "taken") {
        for (const open of this.routes) open.close();
        this.neutral.close();
        return route;
      }
      this.ports[name] = route.address.port;
      this.routes.push(route);
    }
    return startedUr(this);
  }

  readonly now_s = (): number => this.cycles * CYCLE_S;

  time_us(): number {
    return Math.round((this.booted_s + this.now_s()) * 1e6);
  }

  tell(bytes: Uint8Array): void {
    this.primary.tell(bytes);
    this.primaryCopy.tell(bytes);
  }

  readonly onFault = ({ line, column, sentence }: ScriptFault): void => {
    this.log(`Line ${line}: ${sentence}`);
    this.tell(exceptionMessage(this.time_us(), line, column, sentence));
  };

  readonly protectiveStop = (because: string): void => {
    this.states.protectiveStop(because, this.now_s());
    this.tell(errorMessage(this.time_us(), 0, VIOLATION, because));
  };

  readonly onScript = (text: string, answer: (bytes: Uint8Array) => void): void => {
    if (!this.panel.remote) {
      answer(errorMessage(this.time_us(), READ_ONLY, 1, "The controller is not in remote control."));
      return;
    }
    switch (text.trim().toLowerCase()) {
      case "power on":
        this.states.powerOn(this.now_s());
        return;
      case "power off":
        this.states.powerOff();
        return;
      case "set robotmode run":
        this.states.powerOn(this.now_s(), ROBOT_MODE.RUNNING);
        return;
      case "set unlock protective stop":
        this.states.unlock(this.now_s());
        return;
      case "stop program":
        this.programs.end();
        return;
      default:
    }
    if (!this.states.mayMove) {
      answer(
        errorMessage(
          this.time_us(),
          0,
          1,
          "The robot is not ready: programs run when it is powered, its brakes are open and nothing holds it.",
        ),
      );
      return;
    }
    this.programs.start(text);
  };

  readonly setSpeed = (to: number): void => {
    this.panel.fraction = Math.max(0, Math.min(1, to));
    this.mover.setRate(this.panel.fraction);
  };

  readonly onInputs = (fields: readonly Field[]): void => {
    if (!this.panel.remote) return;
    for (const { name } of fields) {
      if (name === "speed_slider_mask" && this.memory.get("speed_slider_mask") !== 0)
        this.setSpeed(this.memory.get("speed_slider_fraction"));
      if (name === "standard_analog_output_mask") {
        const mask = this.memory.get("standard_analog_output_mask");
        for (const i of [0, 1])
          if (mask & (1 << i))
            this.memory.set(`standard_analog_output${i}`, this.memory.get(`standard_analog_output_${i}`));
      }
      for (const [group, from, count] of this.GROUPS) {
        if (name !== `${group}_digital_output_mask`) continue;
        const mask = this.memory.get(name);
        const value = this.memory.get(`${group}_digital_output`);
        for (let i = 0; i < count; i++)
          if (mask & (1 << i)) this.memory.setDigital("output", from + i, (value & (1 << i)) !== 0);
      }
    }
  };

  packaged(): Uint8Array {
    for (let i = 0; i < 6; i++) {
      this.tcp[i] = this.memory.slots[this.slotTcp + i]!;
      this.offset[i] = this.memory.slots[this.slotOffset + i]!;
    }
    const { robotMode, safetyMode } = this.states;
    return statePackage(
      {
        time_us: this.time_us(),
        powerOn: robotMode >= ROBOT_MODE.IDLE,
        emergencyStopped: EMERGENCY_STOPS.has(safetyMode),
        protectiveStopped: safetyMode === SAFETY_MODE.PROTECTIVE_STOP,
        running: this.programs.runtime === RUNTIME.PLAYING,
        paused: this.programs.runtime === RUNTIME.PAUSED,
        robotMode,
        safetyMode,
        remote: this.panel.remote,
        speedFraction: this.panel.fraction,
        q_rad: this.neutral.jointAngles(),
        qd_rad_s: this.mover.qd,
        jointMode: robotMode === ROBOT_MODE.RUNNING ? JOINT_MODE.running : JOINT_MODE.idle,
        tcp: this.tcp,
        tcpOffset: this.offset,
        digitalIn: this.memory.get("actual_digital_input_bits"),
        digitalOut: this.memory.get("actual_digital_output_bits"),
      },
      this.arm,
    );
  }

  readonly greeting = (): Uint8Array[] => [
    versionMessage(this.time_us(), "URControl", this.version, "22-03-2022, 00:00:00"),
    safetyModeMessage(this.time_us(), this.states.safetyMode),
    this.packaged(),
  ];

  closeAll(): void {
    for (const server of Object.values(this.servers)) server.closeAll();
  }
}

function startedUr(own: UrControllerState): UrStarted {
  const virtual: VirtualUr = {
    name: `Virtual ${own.robot.name}`,
    robot: own.robot,
    faults: own.faults,
    ports: own.ports,
    memory: own.memory,
    brakingTime_s: own.neutral.brakingTime_s,
    jointAngles: out => own.neutral.jointAngles(out),
    state: {
      get q_rad() {
        return own.neutral.jointAngles();
      },
      get robotMode() {
        return own.states.robotMode;
      },
      get safetyMode() {
        return own.states.safetyMode;
      },
      get runtime() {
        return own.programs.runtime;
      },
      get moving() {
        return own.mover.isMoving;
      },
      get remote() {
        return own.panel.remote;
      },
      get speedFraction() {
        return own.panel.fraction;
      },
      get cycles() {
        return own.cycles;
      },
    },
    digitalOut: bit => own.memory.digital("output", bit),
    pendant: urPendant({
      robot: own.robot,
      neutral: own.neutral,
      mover: own.mover,
      states: own.states,
      programs: own.programs,
      memory: own.memory,
      panel: own.panel,
      now_s: own.now_s,
      setSpeed: own.setSpeed,
      protectiveStop: own.protectiveStop,
    }),
    reboot: () => {
      own.programs.end();
      own.programs.endBeside();
      own.closeAll();
      own.outbox.clear();
      own.cycles = 0;
      own.booted_s = 0;
      own.states.begin(ROBOT_MODE.POWER_OFF);
    },
    close: () => {
      if (own.isClosed) return;
      own.isClosed = true;
      own.closeAll();
      for (const route of own.routes) route.close();
      own.neutral.close();
    },
  };
  return { kind: "started", virtual };
}
