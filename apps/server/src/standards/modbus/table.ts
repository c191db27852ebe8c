import { readFileSync } from "node:fs";
import { isSlide, PlainFault } from "@twincell/core";
import type { RobotState } from "../robot-states.ts";
import { causeOf, type StandardContext } from "../standard.ts";
import { DEVICE_FAILURE, ILLEGAL_ADDRESS, MODBUS_DONE, type ModbusTable } from "./frames.ts";

/** Addresses of one robot: block k has those from k · 2000. */
export const MODBUS_BLOCK = 2000;
export const STATUS = 0;
export const OVERRIDE = 1;
export const JOINTS = 2;
export const SEQUENCE = 3;
/** Each joint two registers, high word first: 0.001° or 1 µm. */
export const POSITIONS = 10;
/** The same, per second. */
export const SPEEDS = 50;
/** Numbers of lines, each two registers: float32, high word first. */
export const NUMBERS = 500;
/** Coils that stop the robot when 1 is written; they read 0. */
export const STOP_COIL = 1999;
export const EMERGENCY_COIL = 1998;
const MOST_LINES = 256;
const MOST_JOINTS = 16;

/** Lines of a robot by their order in a file: `{"format":"twincell.modbus","version":1,"robots":{"arm":["in_1"]}}`. */
export function readModbusLines(path: string): ReadonlyMap<string, readonly string[]> {
  const fault = (sentence: string): PlainFault =>
    new PlainFault("modbus.lines", `${path}: ${sentence}`, "docs/plant.md says how a file of lines is written.");
  let value: unknown;
  try {
    value = JSON.parse(readFileSync(path, "utf8"));
  } catch (problem) {
    throw fault(`${causeOf(problem)}.`);
  }
  const { format, version, robots } = (value ?? {}) as Readonly<Record<string, unknown>>;
  if (format !== "twincell.modbus" || version !== 1 || typeof robots !== "object" || robots === null)
    throw fault("it is no file of lines of version 1.");
  return new Map(
    Object.entries(robots).map(([robot, lines]: [string, unknown]) => {
      if (!Array.isArray(lines) || lines.length > MOST_LINES || !lines.every(line => typeof line === "string"))
        throw fault(`robots.${robot} is no list of at most ${MOST_LINES} names.`);
      return [robot, lines];
    }),
  );
}

/** The robots of a server as registers and coils. */
export function modbusTable(
  { states, robots }: StandardContext,
  given: ReadonlyMap<string, readonly string[]>,
  mayWrite: boolean,
): ModbusTable & { close(): void } {
  /** A robot that is opened again under its id has the block that it had. */
  const blocks = new Map<string, number>();
  const lines = new Map<string, string[]>();
  const close = states.listen({
    opened(robot) {
      if (!blocks.has(robot.id)) blocks.set(robot.id, blocks.size);
      const words = robot.connection.pendant?.words;
      lines.set(robot.id, [...(given.get(robot.id) ?? [...(words?.inputs ?? []), ...(words?.outputs ?? [])])]);
    },
    signals(robot) {
      const known = lines.get(robot.id)!;
      if (given.has(robot.id)) return;
      for (const name of robot.signals.keys()) if (known.length < MOST_LINES && !known.includes(name)) known.push(name);
    },
  });
  const at = (address: number): { readonly robot: RobotState; readonly offset: number } | null => {
    const block = Math.floor(address / MODBUS_BLOCK);
    for (const [id, each] of blocks) {
      const robot = each === block ? states.all.get(id) : undefined;
      if (robot) return { robot, offset: address % MODBUS_BLOCK };
    }
    return null;
  };
  const valueOf = (robot: RobotState, line: string): boolean | number =>
    robot.connection.pendant?.shown.on.includes(line) || (robot.signals.get(line) ?? false);
  const bit = (address: number): boolean | null => {
    const found = at(address);
    if (!found) return null;
    if (found.offset === STOP_COIL || found.offset === EMERGENCY_COIL) return false;
    const line = lines.get(found.robot.id)![found.offset];
    return line === undefined ? null : valueOf(found.robot, line) !== false && valueOf(found.robot, line) !== 0;
  };
  const register = (address: number): number | null => {
    const found = at(address);
    return found && registerOf(found.robot, found.offset, lines.get(found.robot.id)!, valueOf);
  };
  return {
    coil: bit,
    input: bit,
    holding: register,
    inputRegister: register,
    writeRegister: () => ILLEGAL_ADDRESS,
    async writeCoil(address, on) {
      const found = at(address);
      if (!found) return ILLEGAL_ADDRESS;
      const { robot, offset } = found;
      if (offset === STOP_COIL || offset === EMERGENCY_COIL) {
        if (on) robots.stop("Modbus", robot.id, offset === EMERGENCY_COIL);
        return MODBUS_DONE;
      }
      const signal = lines.get(robot.id)![offset];
      if (signal === undefined) return ILLEGAL_ADDRESS;
      // Whoever reaches the port is nobody by name: on a network nothing but stops is taken from it.
      if (!mayWrite) return DEVICE_FAILURE;
      const outcome = await robots.ask("Modbus", {
        type: "pendant",
        station: robot.id,
        act: { do: "input", signal, value: on },
      });
      return outcome.kind === "done" ? MODBUS_DONE : DEVICE_FAILURE;
    },
    close,
  };
}

function registerOf(
  robot: RobotState,
  offset: number,
  lines: readonly string[],
  valueOf: (robot: RobotState, line: string) => boolean | number,
): number | null {
  if (offset === STATUS) return statusOf(robot);
  if (offset === OVERRIDE) return Math.round((robot.sample?.override ?? 0) * 100);
  if (offset === JOINTS) return robot.joints.length;
  if (offset === SEQUENCE) return (robot.sample?.sequence ?? 0) & 0xffff;
  if (offset < POSITIONS) return 0;
  if (offset < POSITIONS + 2 * MOST_JOINTS) return wordOf(thousandth(robot, robot.q_rad, offset - POSITIONS), offset);
  if (offset >= SPEEDS && offset < SPEEDS + 2 * MOST_JOINTS)
    return wordOf(thousandth(robot, robot.speed_rad_s, offset - SPEEDS), offset);
  if (offset < NUMBERS || offset >= NUMBERS + 2 * lines.length) return offset < NUMBERS ? 0 : null;
  const number = Buffer.alloc(4);
  number.writeFloatBE(Number(valueOf(robot, lines[(offset - NUMBERS) >> 1]!)));
  return number.readUInt16BE(offset % 2 === 0 ? 0 : 2);
}
const wordOf = (value: number, offset: number): number => (offset % 2 === 0 ? value >>> 16 : value & 0xffff);
function thousandth({ model }: RobotState, values: Float64Array, offset: number): number {
  const i = offset >> 1;
  const joint = model?.arm.joints[i];
  const value = values[i] ?? 0;
  return Math.round(joint && isSlide(joint) ? value * 1e6 : (value * 180_000) / Math.PI);
}
/** Bits from 0: connected, moving, emergency stop, other stop, automatic, remote, commanded by somebody. */
function statusOf({ sample, connection }: RobotState): number {
  const bits = [
    connection.link?.state === "open",
    sample?.moving === true,
    connection.guard.state.emergency || sample?.safety === "emergency-stop",
    sample?.safety === "protective-stop" || sample?.safety === "guard-stop",
    sample?.mode === "automatic",
    sample?.mode === "remote",
    connection.guard.state.holder !== null,
  ];
  return bits.reduce((word, on, i) => word | (on ? 1 << i : 0), 0);
}
