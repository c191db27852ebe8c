import type { Branch } from "../../kinematics/branch.ts";
import type { Pose } from "../../spatial/pose.ts";
import type { MoveStep, Speed, Step, Target } from "../program.ts";
import { keys, type Fields, type Reader } from "./reader.ts";

/** What a step may refer to. */
export interface Surroundings {
  readonly robot: string;
  readonly joints: number | undefined;
  readonly tools: Readonly<Record<string, Pose<"flange", "tcp">>>;
  readonly frames: Readonly<Record<string, Pose<"world", "frame">>>;
}

const PATHS = ["ptp", "lin", "circ", "spline"] as const;
const BASE = ["id", "type", "name", "group"] as const;

export function readSteps(reader: Reader, value: unknown, around: Surroundings): readonly Step[] {
  const list = reader.list(value, "steps", "the list of steps");
  const steps: Step[] = [], seen = new Map<string, number>();
  if (list === undefined) return steps;
  for (let i = 0; i < list.length; i++) {
    const path = `steps[${i}]`, fields = reader.object(list[i], path, `step ${i + 1}`);
    if (fields === undefined) continue;
    const id = reader.name(fields.id, `${path}.id`, `the id of step ${i + 1}`) ?? "";
    const what = id === "" ? `step ${i + 1}` : `step “${id}”`;
    const earlier = seen.get(id);
    if (id !== "" && earlier !== undefined) reader.fault(`${path}.id`, `${what} exists twice: as number ${earlier + 1} and as number ${i + 1}.`);
    else seen.set(id, i);
    const step = readStep(reader, fields, path, what, id, around);
    if (step !== undefined) steps.push(step);
  }
  return steps;
}

function readStep(reader: Reader, fields: Fields, path: string, what: string, id: string, around: Surroundings): Step | undefined {
  const base = {
    id,
    ...optionalText(reader, fields, "name", path, what),
    ...optionalText(reader, fields, "group", path, what),
  };
  switch (fields.type) {
    case "move": return readMove(reader, fields, path, what, base, around);
    case "wait": {
      reader.onlyKeys(fields, path, what, [...BASE, "s"]);
      const s = reader.number(fields.s, `${path}.s`, `the wait of ${what}`, "s");
      if (s === undefined) return undefined;
      return s >= 0 ? { ...base, type: "wait", s } : reader.fault(`${path}.s`, `${what} waits ${s} s; a wait is 0 s or longer.`);
    }
    case "gripper": {
      reader.onlyKeys(fields, path, what, [...BASE, "closed"]);
      if (typeof fields.closed === "boolean") return { ...base, type: "gripper", closed: fields.closed };
      return reader.fault(`${path}.closed`, `“closed” of ${what} is true or false; here it is ${reader.shown(fields.closed)}.`);
    }
    default:
      return reader.fault(`${path}.type`, `${what} is of type ${reader.shown(fields.type)}; a step is a "move", a "wait" or a "gripper".`);
  }
}

function optionalText<K extends "name" | "group">(reader: Reader, fields: Fields, key: K, path: string, what: string): { readonly [k in K]?: string } {
  if (fields[key] === undefined) return {};
  const text = reader.text(fields[key], `${path}.${key}`, `the ${key} of ${what}`);
  const found: { [k in K]?: string } = {};
  if (text !== undefined) found[key] = text;
  return found;
}

function readMove(
  reader: Reader, fields: Fields, path: string, what: string,
  base: { readonly id: string; readonly name?: string; readonly group?: string }, around: Surroundings,
): MoveStep | undefined {
  reader.onlyKeys(fields, path, what, keys<MoveStep>()("id", "type", "name", "group", "path", "target", "via", "speed", "blend_m"));
  const kind = PATHS.find(known => known === fields.path);
  if (kind === undefined) reader.fault(`${path}.path`, `${what} moves along ${reader.shown(fields.path)}; a path is one of ${PATHS.join(", ")}.`);
  const target = readTarget(reader, fields.target, `${path}.target`, `the target of ${what}`, around);
  const via = fields.via === undefined ? undefined : readTarget(reader, fields.via, `${path}.via`, `the via point of ${what}`, around);
  if (kind === "circ" && fields.via === undefined) reader.fault(`${path}.via`, `${what} is a circular move and names no point to pass through.`);
  if (kind !== undefined && kind !== "circ" && fields.via !== undefined) reader.fault(`${path}.via`, `${what} is a ${kind} move; only a circ passes through a via point.`);
  const speed = readSpeed(reader, fields.speed, `${path}.speed`, what);
  const blend_m = fields.blend_m === undefined ? 0 : reader.number(fields.blend_m, `${path}.blend_m`, `the blend of ${what}`, "m");
  if (blend_m !== undefined && blend_m < 0) reader.fault(`${path}.blend_m`, `${what} blends by ${blend_m} m; a blend is 0 m or more.`);
  if (kind === undefined || target === undefined || speed === undefined || blend_m === undefined) return undefined;
  return { ...base, type: "move", path: kind, target, ...(via === undefined ? {} : { via }), speed, blend_m };
}

function readTarget(reader: Reader, value: unknown, path: string, what: string, around: Surroundings): Target | undefined {
  const fields = reader.object(value, path, what);
  if (fields === undefined) return undefined;
  if ("q" in fields === "pose" in fields) return reader.fault(path, `${what} has either joint angles “q” or a “pose”.`);
  if ("q" in fields) {
    reader.onlyKeys(fields, path, what, ["q", "tool"]);
    const q = readJoints(reader, fields.q, `${path}.q`, what, around);
    const tool = fields.tool === undefined ? {} : { tool: known(reader, fields.tool, `${path}.tool`, what, "tool", around.tools, "flange") };
    return q === undefined ? undefined : { q, ...tool };
  }
  reader.onlyKeys(fields, path, what, ["pose", "frame", "tool", "branch"]);
  const pose = reader.pose<"frame", "tcp">(fields.pose, `${path}.pose`, what);
  const frame = fields.frame === undefined ? "world" : known(reader, fields.frame, `${path}.frame`, what, "frame", around.frames, "world");
  const tool = fields.tool === undefined ? "flange" : known(reader, fields.tool, `${path}.tool`, what, "tool", around.tools, "flange");
  const branch = fields.branch === undefined ? undefined : readBranch(reader, fields.branch, `${path}.branch`, what);
  return pose === undefined ? undefined : { pose, frame, tool, ...(branch === undefined ? {} : { branch }) };
}

function readJoints(reader: Reader, value: unknown, path: string, what: string, around: Surroundings): number[] | undefined {
  const q = reader.numbers(value, path, `the list of joint angles of ${what}`, "rad", undefined);
  if (q === undefined) return undefined;
  if (q.length === 0) return reader.fault(path, `${what} has no joint angles.`);
  if (around.joints !== undefined && q.length !== around.joints) {
    return reader.fault(path, `${what} has ${q.length} joint angles; ${around.robot} has ${around.joints} joints.`);
  }
  return q;
}

function known(
  reader: Reader, value: unknown, path: string, what: string, noun: string, table: Readonly<Record<string, unknown>>, builtIn: string,
): string {
  const name = reader.name(value, path, `the ${noun} of ${what}`) ?? builtIn;
  if (name !== builtIn && !Object.hasOwn(table, name)) {
    reader.fault(path, `${what} names the ${noun} “${name}”, which the program does not have; it has ${[builtIn, ...Object.keys(table)].join(", ")}.`);
  }
  return name;
}

function readBranch(reader: Reader, value: unknown, path: string, what: string): Branch | undefined {
  const fields = reader.object(value, path, `the branch of ${what}`);
  if (fields === undefined) return undefined;
  reader.onlyKeys(fields, path, `the branch of ${what}`, keys<Branch>()("shoulder", "elbow", "wrist"));
  const oneOf = <T extends string>(key: keyof Branch, a: T, b: T): T | undefined => {
    const word = fields[key];
    return word === a ? a : word === b ? b : reader.fault(`${path}.${key}`, `the ${key} of ${what} is "${a}" or "${b}"; here it is ${reader.shown(word)}.`);
  };
  const shoulder = oneOf("shoulder", "front", "back"), elbow = oneOf("elbow", "up", "down"), wrist = oneOf("wrist", "positive", "negative");
  return shoulder === undefined || elbow === undefined || wrist === undefined ? undefined : { shoulder, elbow, wrist };
}

function readSpeed(reader: Reader, value: unknown, path: string, what: string): Speed | undefined {
  if (value === undefined) return reader.fault(path, `${what} has no speed; give it a ratio, mps or time_s.`);
  const fields = reader.object(value, path, `the speed of ${what}`);
  if (fields === undefined) return undefined;
  reader.onlyKeys(fields, path, `the speed of ${what}`, ["ratio", "mps", "time_s"]);
  const given = (["ratio", "mps", "time_s"] as const).filter(key => fields[key] !== undefined);
  const key = given[0];
  if (given.length !== 1 || key === undefined) return reader.fault(path, `the speed of ${what} is exactly one of ratio, mps and time_s; here are ${given.length} of them.`);
  const unit = key === "ratio" ? "" : key === "mps" ? "m/s" : "s";
  const number = reader.number(fields[key], `${path}.${key}`, `the speed of ${what}`, unit);
  if (number === undefined) return undefined;
  if (number <= 0) return reader.fault(`${path}.${key}`, `the speed of ${what} is more than 0${unit === "" ? "" : ` ${unit}`}; here it is ${number}.`);
  switch (key) {
    case "ratio":
      return number <= 1 ? { ratio: number } : reader.fault(`${path}.ratio`, `the speed of ${what} is a ratio from 0 to 1 of full joint speed; here it is ${number}.`);
    case "mps": return { mps: number };
    case "time_s": return { time_s: number };
  }
}
