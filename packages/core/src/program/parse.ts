import { robotById } from "../robots/library/index.ts";
import { jsonFault } from "./json-place.ts";
import { PROGRAM_FORMAT, PROGRAM_VERSION, type Program } from "./program.ts";
import { readPallets } from "./read/pallets.ts";
import { Reader, keys, type Fields } from "../json/reader.ts";
import { readSignals } from "./read/signals.ts";
import { readSteps } from "./read/steps.ts";
import { readParameters, readVariables } from "./read/variables.ts";
import type { ProgramScope } from "./read/scope.ts";
import { readGroups, readPoses } from "./read/tables.ts";
import { versionOf } from "./version.ts";
import { callCycle } from "./walk.ts";

/** What is wrong with a program: where ("steps[2].target.q[0]", or "line 3, column 7") and one sentence about it. */
export interface ProgramFault {
  readonly path: string;
  readonly sentence: string;
}

export type ProgramAnswer =
  | { readonly kind: "program"; readonly program: Program }
  | { readonly kind: "not-a-program"; readonly faults: readonly ProgramFault[] };

export interface ParseOptions {
  /** Joints of a robot by its id; undefined for one that is not known, whose joint count is then not checked. */
  readonly jointsOf?: (robot: string) => number | undefined;
}

/** More faults than this help nobody. */
const MOST_FAULTS = 50;

/**
 * Reads the PROGRAM contract from JSON text or from a value that came out of JSON. This is the only door: behind it
 * every number is finite, every id is unique, every tool and frame exists, and every quaternion has length 1.
 *
 * Missing `name`, tables (`tools`, `frames`, `groups`, `signals`, `variables`, `parameters`, `pallets`, `routines`) and
 * `blend_m` get their defaults, a pose without `frame` is in "world" and without `tool` of "flange". A key that no
 * contract knows is a fault, because it is usually a spelling mistake that would change the motion; keys that begin
 * with "$", "_" or "x-" are left out without a word. Files of version 1 are lifted as they are.
 *
 * Never throws.
 */
export function parseProgram(source: unknown, options: ParseOptions = {}): ProgramAnswer {
  let value = source;
  if (typeof source === "string") {
    const fault = jsonFault(source);
    if (fault !== undefined)
      return refuse([{ path: `line ${fault.line}, column ${fault.column}`, sentence: fault.sentence }]);
    value = JSON.parse(source);
  }
  try {
    return read(value, options.jointsOf ?? (id => robotById(id)?.arm.joints.length));
  } catch (cause) {
    // Only a value that never was JSON (a getter that throws, for instance) gets here.
    return refuse([
      {
        path: "",
        sentence: `The program cannot be read: ${cause instanceof Error ? cause.message : "its values cannot be looked at"}.`,
      },
    ]);
  }
}

function read(value: unknown, jointsOf: (robot: string) => number | undefined): ProgramAnswer {
  const reader = new Reader(MOST_FAULTS);
  const top = reader.object(value, "", "the program");
  if (top === undefined) return refuse(reader.faults);
  if (top.format !== PROGRAM_FORMAT) {
    return refuse([
      {
        path: "format",
        sentence: `A program says "format": "${PROGRAM_FORMAT}"; this one says ${reader.shown(top.format)}.`,
      },
    ]);
  }
  if (top.version !== 1 && top.version !== PROGRAM_VERSION) {
    const newer = typeof top.version === "number" && top.version > PROGRAM_VERSION;
    return refuse([
      {
        path: "version",
        sentence: newer
          ? `The program is of version ${top.version}; this release reads versions up to ${PROGRAM_VERSION}.`
          : `A program says "version": 1 or ${PROGRAM_VERSION}; this one says ${reader.shown(top.version)}.`,
      },
    ]);
  }
  reader.onlyKeys(
    top,
    "",
    "the program",
    keys<Program>()(
      "format",
      "version",
      "name",
      "robot",
      "tools",
      "frames",
      "groups",
      "signals",
      "variables",
      "parameters",
      "pallets",
      "routines",
      "steps",
    ),
  );
  const robot = reader.name(top.robot, "robot", "the robot of the program") ?? "";
  const name = top.name === undefined ? "Program" : (reader.text(top.name, "name", "the name of the program") ?? "");
  const tools = readPoses<"flange", "tcp">(reader, top.tools, "tools", "tool", "flange");
  const frames = readPoses<"world", "frame">(reader, top.frames, "frames", "frame", "world");
  const groups = readGroups(reader, top.groups);
  const signals = readSignals(reader, top.signals);
  const pallets = readPallets(reader, top.pallets, frames);
  const written =
    top.routines === undefined ? {} : (reader.object(top.routines, "routines", "the table of routines") ?? {});
  const names = new Set(Object.keys(written));
  const variables = readVariables(reader, top.variables, signals);
  const parameters = readParameters(reader, top.parameters, names, { ...signals, ...variables });
  const around: ProgramScope = {
    robot,
    joints: jointsOf(robot),
    tools,
    frames,
    pallets,
    routines: names,
    signals,
    variables,
    parameters,
    routine: undefined,
    seen: new Map(),
    open: [],
    depth: 0,
  };
  const steps = readSteps(reader, top.steps, "steps", "the list of steps", around);
  const routines = readRoutines(reader, written, around);
  if (reader.faults.length > 0) return refuse(reader.faults);
  const program: Program = {
    format: PROGRAM_FORMAT,
    version: 1,
    name,
    robot,
    tools,
    frames,
    groups,
    signals,
    ...(Object.keys(variables).length === 0 ? {} : { variables }),
    ...(Object.keys(parameters).length === 0 ? {} : { parameters }),
    pallets,
    routines,
    steps,
  };
  const version = versionOf(program);
  return { kind: "program", program: version === program.version ? program : { ...program, version } };
}

function readRoutines(reader: Reader, written: Fields, around: ProgramScope): Program["routines"] {
  const routines = Object.fromEntries(
    Object.entries(written).map(([name, list]) => {
      if (name === "") reader.fault("routines.", "A routine has a name that is not empty.");
      return [name, readSteps(reader, list, `routines.${name}`, `the routine “${name}”`, { ...around, routine: name })];
    }),
  );
  const cycle = callCycle(routines);
  if (cycle !== undefined)
    reader.fault(
      `routines.${cycle[0]!}`,
      `The routine “${cycle[0]!}” calls itself: ${cycle.join(" → ")}. It would never come back.`,
    );
  return routines;
}

const refuse = (faults: readonly ProgramFault[]): ProgramAnswer => ({ kind: "not-a-program", faults });
