import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Expression } from "../read/syntax.ts";
import type { System } from "./system.ts";
import { component, evaluate, numberOf, type Memory, type Structure } from "./values.ts";

/** What BAS(#COMMAND, value) of the controller's own bas.src does to the settings of motion. */
export function BAS(args: readonly (Expression | undefined)[], system: System, memory: Memory, at: TextPlace): void {
  const [first, second] = args;
  const command = first === undefined ? undefined : evaluate(first, memory);
  if (command?.kind !== "enum")
    throw new TextError(first ?? at, "a command such as #INITMOV", "BAS takes a command first.");
  const given = (): number => {
    if (second === undefined) throw new TextError(at, "a second argument", `BAS(${command.value}, …) takes a number.`);
    return numberOf(second, memory);
  };
  switch (command.value) {
    case "#INITMOV":
      return system.initialize();
    case "#VEL_PTP":
      return system.setAxes("$VEL_AXIS", given(), second!);
    case "#ACC_PTP":
      return system.setAxes("$ACC_AXIS", given(), second!);
    case "#VEL_CP":
      return system.setPart("$VEL", "CP", positive(given(), second!));
    case "#ACC_CP":
      return system.setPart("$ACC", "CP", positive(given(), second!));
    case "#TOOL":
      return system.choose("TOOL", given(), second!);
    case "#BASE":
      return system.choose("BASE", given(), second!);
    default:
      return inForceBy(args, system, memory, at, command);
  }
}

/** What inline forms have put in force. */
function inForceBy(
  args: readonly (Expression | undefined)[],
  system: System,
  memory: Memory,
  at: TextPlace,
  command: { readonly value: string },
): void {
  const [first, second] = args;
  const given = (): number => {
    if (second === undefined) throw new TextError(at, "a second argument", `BAS(${command.value}, …) takes a number.`);
    return numberOf(second, memory);
  };
  switch (command.value) {
    case "#PTP_PARAMS":
    case "#PTP_DAT": {
      const data = inForce("PDAT_ACT", memory, at);
      if (command.value === "#PTP_PARAMS") system.setAxes("$VEL_AXIS", given(), second!);
      apply(data, system, at, "PTP");
      return frames(system, memory, at);
    }
    case "#CP_PARAMS":
    case "#CP_DAT": {
      if (command.value === "#CP_PARAMS") system.setPart("$VEL", "CP", positive(given(), second!));
      apply(inForce("LDAT_ACT", memory, at), system, at, "CP");
      return frames(system, memory, at);
    }
    case "#EX_BASE":
    case "#FRAMES":
    case "#OUT_SYNC":
    case "#OUT_ASYNC":
    case "#GROUP":
      return;
    default:
      throw new TextError(first!, "a command of BAS", `BAS has no command ${command.value} that is understood here.`);
  }
}

function positive(value: number, at: TextPlace): number {
  if (!(value > 0)) throw new TextError(at, "a number above 0", `The value is ${value}.`);
  return value;
}

function inForce(name: string, memory: Memory, at: TextPlace): Structure | undefined {
  const value = memory.read(name, at);
  return value?.kind === "structure" ? value : undefined;
}

/**
 * What a setting of a spline motion makes of the data of its inline form: `WITH $APO = SAPO_PTP(PPDAT1)`. True where it
 * is one of the controller's own; those of jerk, load and collision monitoring do not change where the robot goes.
 */
export function inlineSetting(
  name: string,
  first: Expression,
  system: System,
  memory: Memory,
): "done" | "no-function-of-the-controller" {
  const data = (): Structure | undefined => {
    const value = evaluate(first, memory);
    return value.kind === "structure" ? value : undefined;
  };
  switch (name) {
    case "SVEL_CP":
      system.setPart("$VEL", "CP", positive(numberOf(first, memory), first));
      return "done";
    case "SVEL_JOINT":
      system.setAxes("$VEL_AXIS", numberOf(first, memory), first);
      return "done";
    case "SACC_JOINT":
      accelerate(data(), system, first, "PTP");
      return "done";
    case "SACC_CP":
      accelerate(data(), system, first, "CP");
      return "done";
    case "SAPO_PTP":
      approximate(data(), system, "PTP");
      return "done";
    case "SAPO":
      approximate(data(), system, "CP");
      return "done";
    case "SORI_TYP": {
      orient(data(), system, first);
      return "done";
    }
    case "SIPO_MODE":
      system.write("$IPO_MODE", evaluate(first, memory), first, "");
      return "done";
    case "SLOAD":
    case "SJERK":
    case "SGEAR_JERK":
    case "SCOLLMON":
    case "USE_CM_PRO_VALUES":
      return "done";
    default:
      return "no-function-of-the-controller";
  }
}

/** Acceleration in percent, approximation in percent or millimetres, and how the orientation goes along. */
function apply(data: Structure | undefined, system: System, at: TextPlace, sort: "PTP" | "CP"): void {
  accelerate(data, system, at, sort);
  approximate(data, system, sort);
  orient(data, system, at);
}

function accelerate(data: Structure | undefined, system: System, at: TextPlace, sort: "PTP" | "CP"): void {
  const acceleration = data && component(data, "ACC");
  if (acceleration === undefined || acceleration <= 0) return;
  if (sort === "PTP") {
    system.setAxes("$ACC_AXIS", acceleration, at);
    return;
  }
  const full = component({ kind: "structure", type: undefined, fields: new Map(system.values) }, "DEF_ACC_CP") ?? 2.3;
  system.setPart("$ACC", "CP", (acceleration / 100) * full);
}

function approximate(data: Structure | undefined, system: System, sort: "PTP" | "CP"): void {
  const distance = data && component(data, "APO_DIST");
  if (distance === undefined) return;
  const mode = data?.fields.get("APO_MODE");
  if (sort === "PTP" && !(mode?.kind === "enum" && mode.value === "#CDIS")) system.setPart("$APO", "CPTP", distance);
  else system.setPart("$APO", "CDIS", distance);
}

function orient(data: Structure | undefined, system: System, at: TextPlace): void {
  const type = data?.fields.get("ORI_TYP");
  if (type !== undefined) system.write("$ORI_TYPE", type, at, "");
}

/** FDAT_ACT names tool and base by their numbers. */
function frames(system: System, memory: Memory, at: TextPlace): void {
  const data = inForce("FDAT_ACT", memory, at);
  if (data === undefined) return;
  const tool = component(data, "TOOL_NO");
  const base = component(data, "BASE_NO");
  if (tool !== undefined) system.choose("TOOL", tool, at);
  if (base !== undefined) system.choose("BASE", base, at);
  const mode = data.fields.get("IPO_FRAME");
  if (mode !== undefined) system.write("$IPO_MODE", mode, at, "");
}
