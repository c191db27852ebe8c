import {
  sectionForDriver,
  type CommandOutcome,
  type Interpreted,
  type OperatingMode,
  type Robot,
  type SafetyState,
  type Scheduler,
  type SignalLine,
} from "@twincell/core";
import type { Network } from "../transport/index.ts";
import type { Cannot } from "./cannot.ts";
import type { ControllerAdapter } from "./adapter.ts";

/** Ports by the brand's own names for them; those left out are the vendor's own. */
export type PortNumbers = Readonly<Record<string, number>>;

/** What stands in the controller's own parameter file and is never guessed: numbers, by the id of the datum. */
export type ControllerData = Readonly<Record<string, readonly number[]>>;
export interface ConnectionParameter {
  readonly id: string;
  readonly name: string;
  /** Where a person finds it. */
  readonly where: string;
  /** How many numbers; one a joint when left out. */
  readonly count?: number;
  /** What it is for most. */
  readonly usual?: readonly number[];
}

export interface AdapterOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  readonly host: string;
  readonly ports?: PortNumbers;
  readonly data?: ControllerData;
  /** Whether the robot is only watched now: nothing that takes anything from whoever commands it is sent then. */
  readonly isWatched?: () => boolean;
}
export interface VendorVirtualOptions extends AdapterOptions {
  /** Executes a text of the brand's own language; see `Brand.dialect`. */
  readonly interpret: (text: string) => Interpreted;
  readonly start_rad?: ArrayLike<number>;
  /** Part of the robot's own joint speeds that 100 % stands for, 0 … 1 (row T-17). */
  readonly maxSpeed?: number;
}

/** A position of the mode key, by the brand's own name for it. */
export interface KeyPosition {
  readonly id: string;
  readonly name: string;
  readonly mode: OperatingMode;
}

/** What lamps and screen of a pendant show now. */
export interface PendantShown {
  /** Id of the position that the mode key is in. */
  readonly key: string;
  /** `coming` while drives take their time. */
  readonly servo: "on" | "coming" | "off";
  readonly safety: SafetyState;
  /** 0 … 1. */
  readonly override: number;
  /** Name of the program that is chosen, or "". */
  readonly program: string;
  readonly running: boolean;
  /** What waits to be acknowledged, or keeps the robot where it is. */
  readonly alarms: readonly string[];
}

/** The lines of the cabinet in the brand's own names; none where the brand's protocol carries none. */
export interface PendantLines {
  readonly inputs: readonly string[];
  readonly outputs: readonly string[];
  read(signal: string): boolean;
}

/**
 * The cabinet and the pendant of a virtual controller, as a person stands before them (rows T-26, T-27). Why something
 * cannot be is a sentence; null when it was done.
 */
export interface Pendant {
  readonly keys: readonly KeyPosition[];
  /** What the brand writes on its keys for drives on and off, and for taking alarms away. */
  readonly labels: { readonly servo: string; readonly reset: string };
  readonly lines: PendantLines;
  readonly shown: PendantShown;
  turnKey(position: string): void;
  /** The position of that mode that a person would take. */
  setMode(mode: OperatingMode): void;
  /** Pressed, in a manual mode, it lets drives and jog keys work; let go, the arm stops. */
  setEnabling(pressed: boolean): void;
  setServo(on: boolean): string | null;
  setOverride(ratio: number): string | null;
  /** Takes away every alarm whose cause is gone. */
  reset(): string | null;
  /**
   * A joint move commanded at the pendant; works in a manual mode only.
   *
   * @param ratio  of the joint speeds, at most; 1 when left out. A reduced manual mode goes below it.
   */
  jog(q_rad: ArrayLike<number>, ratio?: number): Promise<CommandOutcome>;
  /** Brakes a jog along its path. */
  stopJog(): void;
  /** The red button: true presses it, false turns it out again; the drives stay off. */
  emergencyStop(pressed: boolean): void;
  /** A proximity sensor or a gate. */
  setGuardOpen(open: boolean): void;
  /** The robot stops by itself and stays so until reset. */
  protectiveStop(because: string): void;
  setInput(signal: string, value: boolean | number): void;
}

export interface VendorVirtual {
  readonly name: string;
  readonly robot: Robot;
  /** Where it listens, by the brand's names. */
  readonly ports: PortNumbers;
  readonly pendant: Pendant;
  /** Longest time from the command to stop until standstill [s]. */
  readonly brakingTime_s: number;
  /** The joint angles now [rad]. */
  jointAngles(out?: Float64Array): Float64Array;
  /** Off and on again: connections end, clocks and counters begin anew, drives are off as after power-on. */
  readonly reboot: () => void;
  close(): void;
}
export type StartedDriver =
  | { readonly kind: "started"; readonly virtual: VendorVirtual }
  | { readonly kind: "taken"; readonly sentence: string };

/** Another driver of a brand's controllers. */
export interface OtherPath {
  readonly name: string;
  readonly cannot: readonly Cannot[];
  /**
   * The rows from T-19 on that tests of its own show, and how the names of those tests end; the others are shown
   * through the brand's first driver.
   */
  readonly shows: readonly Cannot["row"][];
  readonly tests: string;
  face(options: AdapterOptions): ControllerAdapter;
}

/** A brand as apps meet it: one of these for each folder. */
export interface DriverKind {
  readonly id: string;
  readonly name: string;
  /** Id of the language its controllers run. */
  readonly dialect: string;
  /** The vendor's own port numbers. */
  readonly ports: PortNumbers;
  /** What a person must say of a real controller before it can be driven. */
  readonly data?: readonly ConnectionParameter[];
  /** Vendor of the controllers. */
  readonly vendor: string;
  /** Whether its controllers move that robot; left out, those whose vendor section names the driver. */
  readonly drives?: (robot: Robot) => boolean;
  /** What its driver cannot do, with the reasons. */
  readonly cannot: readonly Cannot[];
  /**
   * What the driver calls the line that a program gives that number; undefined where it has none. Left out, lines keep
   * the names of the program.
   */
  terminal?(line: SignalLine & { readonly address: number }): string | undefined;
  /** Other drivers of the same controllers, that apps do not offer by themselves. */
  readonly otherWays?: readonly OtherPath[];
  face(options: AdapterOptions): ControllerAdapter;
  virtual(options: VendorVirtualOptions): Promise<StartedDriver>;
}

/** Whether a driver moves a robot: its vendor section says so, and nothing in it is more than the driver can say. */
export const drivesRobot = ({ id, drives }: Pick<DriverKind, "id" | "drives">, robot: Robot): boolean =>
  drives?.(robot) ?? sectionForDriver(robot, id) !== undefined;
