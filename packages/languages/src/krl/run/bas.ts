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

/** Acceleration in percent, approximation in percent or millimetres. */
function apply(data: Structure | undefined, system: System, at: TextPlace, sort: "PTP" | "CP"): void {
  if (data === undefined) return;
  const acceleration = component(data, "ACC");
  const distance = component(data, "APO_DIST");
  const mode = data.fields.get("APO_MODE");
  if (acceleration !== undefined && acceleration > 0) {
    if (sort === "PTP") system.setAxes("$ACC_AXIS", acceleration, at);
    else
      system.setPart(
        "$ACC",
        "CP",
        (acceleration / 100) *
          (component({ kind: "structure", type: undefined, fields: new Map(system.values) }, "DEF_ACC_CP") ?? 2.3),
      );
  }
  if (distance === undefined) return;
  if (sort === "PTP" && !(mode?.kind === "enum" && mode.value === "#CDIS")) system.setPart("$APO", "CPTP", distance);
  else system.setPart("$APO", "CDIS", distance);
}

/** FDAT_ACT names tool and base by their numbers. */
function frames(system: System, memory: Memory, at: TextPlace): void {
  const data = inForce("FDAT_ACT", memory, at);
  if (data === undefined) return;
  const tool = component(data, "TOOL_NO");
  const base = component(data, "BASE_NO");
  if (tool !== undefined) system.choose("TOOL", tool, at);
  if (base !== undefined) system.choose("BASE", base, at);
}
