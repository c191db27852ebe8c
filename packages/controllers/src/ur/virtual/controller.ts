import type { Pose } from "@twincell/core";
import { createVirtualController, type VirtualController } from "../../virtual/index.ts";
import type { ByteStream, Listening } from "../../transport/index.ts";
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
import { ScriptServer } from "./script-server.ts";
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
  const { robot, network, scheduler } = options;
  const version = options.version ?? DEFAULTS.version;
  const host = options.host ?? DEFAULTS.host;
  const log =
    options.log ??
    (() => {
      /* Nobody listens. */
    });
  if (robot.arm.joints.length !== JOINTS)
    return {
      kind: "taken",
      sentence: `${robot.name} has ${robot.arm.joints.length} joints; robots of Universal Robots have ${JOINTS}.`,
    };
  const neutral: VirtualController = createVirtualController({
    robot,
    scheduler,
    cycle_s: CYCLE_S,
    ...(options.start_rad ? { start_rad: options.start_rad } : {}),
    ...(options.maxSpeed === undefined ? {} : { maxSpeed: options.maxSpeed }),
    ...(options.worldFromBase ? { worldFromBase: options.worldFromBase } : {}),
    ...(options.onMotion ? { onMotion: options.onMotion } : {}),
  });
  const memory = new Memory();
  const mover = new Mover(neutral, robot, CYCLE_S);
  const lines = new NamedLines(memory, neutral.signals);
  const faults = noFaults();
  let cycles = 0;
  let booted_s = options.booted_s ?? DEFAULTS.booted_s;
  let frozen = false;
  let gripper = false;
  let isClosed = false;
  const panel: Panel = { remote: options.remote ?? true, operational: "NONE", fraction: 1 };
  const now_s = (): number => cycles * CYCLE_S;
  const time_us = (): number => Math.round((booted_s + now_s()) * 1e6);
  // Delays are the wire's, not the controller's: they go on while it hangs.
  const outbox = new Outbox(faults, () => scheduler.now_s());

  const tell = (bytes: Uint8Array): void => {
    primary.tell(bytes);
    primaryCopy.tell(bytes);
  };
  const states = new States({
    powerOn_s: options.powerOn_s ?? DEFAULTS.powerOn_s,
    brakes_s: options.brakes_s ?? DEFAULTS.brakes_s,
    onStop(how, because) {
      log(because);
      if (how === "hold" && programs.pause()) return;
      programs.end();
    },
    onResume() {
      programs.resume();
    },
    onSafety(mode) {
      tell(safetyModeMessage(time_us(), mode));
    },
  });
  const onFault = ({ line, column, sentence }: ScriptFault): void => {
    log(`Line ${line}: ${sentence}`);
    tell(exceptionMessage(time_us(), line, column, sentence));
  };
  const protectiveStop = (because: string): void => {
    states.protectiveStop(because, now_s());
    tell(errorMessage(time_us(), 0, VIOLATION, because));
  };
  const programs: Programs = new Programs({
    mover,
    lines,
    interpret: options.interpret,
    onFault,
    host: {
      robot,
      memory,
      mover,
      cycle_s: CYCLE_S,
      now_s,
      protectiveStop,
      say: text => {
        tell(textMessage(time_us(), text));
      },
    },
    onStarted: name => {
      tell(keyMessage(time_us(), "PROGRAM_XXX_STARTED", name));
    },
    onStopped: name => {
      tell(keyMessage(time_us(), "PROGRAM_XXX_STOPPED", name));
    },
  });

  function onScript(text: string, answer: (bytes: Uint8Array) => void): void {
    if (!panel.remote) {
      answer(errorMessage(time_us(), READ_ONLY, 1, "The controller is not in remote control."));
      return;
    }
    switch (text.trim().toLowerCase()) {
      case "power on":
        states.powerOn(now_s());
        return;
      case "power off":
        states.powerOff();
        return;
      case "set robotmode run":
        states.powerOn(now_s(), ROBOT_MODE.RUNNING);
        return;
      case "set unlock protective stop":
        states.unlock(now_s());
        return;
      case "stop program":
        programs.end();
        return;
      default:
    }
    if (!states.mayMove) {
      answer(
        errorMessage(
          time_us(),
          0,
          1,
          "The robot is not ready: programs run when it is powered, its brakes are open and nothing holds it.",
        ),
      );
      return;
    }
    programs.start(text);
  }

  const setSpeed = (to: number): void => {
    panel.fraction = Math.max(0, Math.min(1, to));
    mover.setRate(panel.fraction);
  };
  const GROUPS = [
    ["standard", 0, 8],
    ["configurable", 8, 8],
    ["tool", 16, 2],
  ] as const;
  function onInputs(fields: readonly Field[]): void {
    if (!panel.remote) return;
    for (const { name } of fields) {
      if (name === "speed_slider_mask" && memory.get("speed_slider_mask") !== 0)
        setSpeed(memory.get("speed_slider_fraction"));
      if (name === "standard_analog_output_mask") {
        const mask = memory.get("standard_analog_output_mask");
        for (const i of [0, 1])
          if (mask & (1 << i)) memory.set(`standard_analog_output${i}`, memory.get(`standard_analog_output_${i}`));
      }
      for (const [group, from, count] of GROUPS) {
        if (name !== `${group}_digital_output_mask`) continue;
        const mask = memory.get(name);
        const value = memory.get(`${group}_digital_output`);
        for (let i = 0; i < count; i++)
          if (mask & (1 << i)) memory.setDigital("output", from + i, (value & (1 << i)) !== 0);
      }
    }
  }

  const model = options.model ?? modelOf(robot);
  const common = { outbox, log };
  const rtde = new RtdeServer({ ...common, memory, version, cycle_s: CYCLE_S, now_s, onInputs });
  const dashboard = new DashboardServer({
    ...common,
    states,
    programs,
    version,
    model,
    now_s,
    serial: options.serial ?? DEFAULTS.serial,
    isRemote: () => panel.remote,
    operationalMode: () => panel.operational,
    setOperationalMode: mode => {
      panel.operational = mode;
    },
    file: name => options.files?.get(name),
  });
  const joints = robot.arm.joints.map(({ limits }) => limits);
  const arm: PrimaryArm = {
    lower_rad: joints.map(limits => limits.lower_rad),
    upper_rad: joints.map(limits => limits.upper_rad),
    speed_rad_s: joints.map(limits => limits.speed_rad_s),
    acceleration_rad_s2: joints.map(limits => limits.acceleration_rad_s2),
    type: typeOf(model),
  };
  const tcp = new Float64Array(6);
  const offset = new Float64Array(6);
  const packaged = (): Uint8Array => {
    for (let i = 0; i < 6; i++) {
      tcp[i] = memory.slots[slotTcp + i]!;
      offset[i] = memory.slots[slotOffset + i]!;
    }
    const { robotMode, safetyMode } = states;
    return statePackage(
      {
        time_us: time_us(),
        powerOn: robotMode >= ROBOT_MODE.IDLE,
        emergencyStopped: EMERGENCY_STOPS.has(safetyMode),
        protectiveStopped: safetyMode === SAFETY_MODE.PROTECTIVE_STOP,
        running: programs.runtime === RUNTIME.PLAYING,
        paused: programs.runtime === RUNTIME.PAUSED,
        robotMode,
        safetyMode,
        remote: panel.remote,
        speedFraction: panel.fraction,
        q_rad: neutral.jointAngles(),
        qd_rad_s: mover.qd,
        jointMode: robotMode === ROBOT_MODE.RUNNING ? JOINT_MODE.running : JOINT_MODE.idle,
        tcp,
        tcpOffset: offset,
        digitalIn: memory.get("actual_digital_input_bits"),
        digitalOut: memory.get("actual_digital_output_bits"),
      },
      arm,
    );
  };
  const slotTcp = memory.slotOf("actual_TCP_pose");
  const slotOffset = memory.slotOf("tcp_offset");
  const greeting = (): Uint8Array[] => [
    versionMessage(time_us(), "URControl", version, "22-03-2022, 00:00:00"),
    safetyModeMessage(time_us(), states.safetyMode),
    packaged(),
  ];
  const primary = new ScriptServer({ ...common, name: "Primary interface", greeting, onScript });
  const secondary = new ScriptServer({ ...common, name: "Secondary interface", greeting, onScript });
  const realTime = new ScriptServer({ ...common, name: "Real-time interface", greeting: () => [], onScript });
  const primaryCopy = new ScriptServer({ ...common, name: "Primary interface, read-only", greeting });
  const secondaryCopy = new ScriptServer({ ...common, name: "Secondary interface, read-only", greeting });
  const realTimeCopy = new ScriptServer({ ...common, name: "Real-time interface, read-only", greeting: () => [] });
  const packageTellers = [primary, secondary, primaryCopy, secondaryCopy];
  const streams = [realTime, realTimeCopy];
  const realTimePackage = realTimeWriter();

  const fill = stateFiller(robot, memory, mover, states, programs);
  states.begin(options.begins === "powered-off" ? ROBOT_MODE.POWER_OFF : ROBOT_MODE.RUNNING);

  neutral.onSample(sample => {
    outbox.cycle();
    if (frozen !== faults.frozen) {
      frozen = faults.frozen;
      mover.hold(frozen);
    }
    if (frozen) return;
    cycles++;
    if (sample.gripperClosed !== gripper) {
      gripper = sample.gripperClosed;
      memory.setDigital("output", GRIPPER_BIT, gripper);
    }
    const q = mover.cycle(sample);
    fill(booted_s + now_s(), q, panel.fraction);
    states.cycle(now_s());
    const ended = programs.cycle();
    if (ended !== "") {
      log(ended);
      tell(errorMessage(time_us(), 0, 1, ended));
    }
    rtde.cycle(cycles);
    if (realTime.clients + realTimeCopy.clients > 0) {
      const bytes = realTimePackage(memory.slots);
      for (const server of streams) server.tell(bytes, true);
    }
    if (cycles % PRIMARY_CYCLES === 0 && packageTellers.some(({ clients }) => clients > 0)) {
      const bytes = packaged();
      for (const server of packageTellers) server.tell(bytes, true);
    }
  });

  const wanted = { ...UR_PORTS, ...options.ports };
  const routes: Extract<Listening, { kind: "listening" }>[] = [];
  const servers: Readonly<Record<keyof UrPorts, { accept(stream: ByteStream): void; closeAll(): void }>> = {
    dashboard,
    primary,
    secondary,
    realTime,
    rtde,
    primaryCopy,
    secondaryCopy,
    realTimeCopy,
  };
  const ports: Record<keyof UrPorts, number> = { ...wanted };
  const closeAll = (): void => {
    for (const server of Object.values(servers)) server.closeAll();
  };
  for (const name of Object.keys(servers) as (keyof UrPorts)[]) {
    const route = await network.listen({ host, port: wanted[name] }, stream => {
      if (faults.refusing || isClosed) stream.close();
      else servers[name].accept(stream);
    });
    if (route.kind === "taken") {
      for (const open of routes) open.close();
      neutral.close();
      return route;
    }
    ports[name] = route.address.port;
    routes.push(route);
  }

  const virtual: VirtualUr = {
    name: `Virtual ${robot.name}`,
    robot,
    faults,
    ports,
    memory,
    brakingTime_s: neutral.brakingTime_s,
    jointAngles: out => neutral.jointAngles(out),
    state: {
      get q_rad() {
        return neutral.jointAngles();
      },
      get robotMode() {
        return states.robotMode;
      },
      get safetyMode() {
        return states.safetyMode;
      },
      get runtime() {
        return programs.runtime;
      },
      get moving() {
        return mover.isMoving;
      },
      get remote() {
        return panel.remote;
      },
      get speedFraction() {
        return panel.fraction;
      },
      get cycles() {
        return cycles;
      },
    },
    digitalOut: bit => memory.digital("output", bit),
    pendant: urPendant({ robot, neutral, mover, states, programs, memory, panel, now_s, setSpeed, protectiveStop }),
    reboot() {
      programs.end();
      programs.endBeside();
      closeAll();
      outbox.clear();
      cycles = 0;
      booted_s = 0;
      states.begin(ROBOT_MODE.POWER_OFF);
    },
    close() {
      if (isClosed) return;
      isClosed = true;
      closeAll();
      for (const route of routes) route.close();
      neutral.close();
    },
  };
  return { kind: "started", virtual };
}
