import {
  ownRobotFile,
  parseRobot,
  robotFromArm,
  robotOfFile,
  ROBOT_FORMAT,
  type Robot,
  type RobotFile,
} from "@twincell/core";
import { readDhTable } from "../dh/index.ts";
import { nameOf, type FileSource } from "../files/source.ts";
import { endingOf } from "../import/raw-parts.ts";
import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { utf8 } from "../utf8.ts";
import { armFromUrdf, endsOf } from "../urdf/chain.ts";
import { readRobot } from "../xacro/index.ts";
import { drawnLinks } from "./drawn-links.ts";

/** A robot as it is kept with a cell, and everything that was assumed or could not be loaded, one sentence each. */
export interface RobotRead {
  readonly kind: "robot";
  readonly robot: Robot;
  readonly file: RobotFile;
  readonly notes: readonly string[];
}

const DESCRIPTIONS = ["urdf", "xacro"];
/** A table in text says its convention in its first lines. */
const TABLE = /^[^\n]*convention\s*:/im;

/** Whether a file is a robot by its ending and its first characters: a description, a robot file or a D-H table. */
export function mayBeRobot(path: string, bytes: Uint8Array): boolean {
  const ending = endingOf(path);
  if (DESCRIPTIONS.includes(ending)) return true;
  if (!["json", "csv", "tsv", "txt", "dh"].includes(ending)) return false;
  const start = utf8(bytes.subarray(0, 4096));
  if (ending !== "json") return TABLE.test(start);
  // A cell may hold a robot file, and a vendor file stands beside a robot: what a file says of itself first counts.
  const format = /"format"\s*:\s*"([^"]*)"/.exec(start)?.[1];
  return format === ROBOT_FORMAT || (format === undefined && /"convention"\s*:/.test(start));
}

/**
 * The robot that a file describes: a URDF or xacro with the meshes it names, a robot file (docs/add-a-robot.md) or a
 * D-H table (docs/robot-files.md). Its arm is solved in closed form where its axes allow, numerically elsewhere.
 *
 * @param path  of the file in `files`; what it names is looked for from there.
 */
export async function robotFromFiles(path: string, files: FileSource): Promise<RobotRead | NotUnderstood> {
  const bytes = files.read(path);
  if (!bytes) return { kind: "not-understood", sentence: `${nameOf(path)} is not there or cannot be read.` };
  const described = DESCRIPTIONS.includes(endingOf(path))
    ? await fromDescription(path, files)
    : answering(() => fromText(path, utf8(bytes)));
  if (described.kind === "not-understood") return described;
  const file = ownRobotFile(described.robot);
  const kept = robotOfFile(file);
  if (kept.kind === "not-a-robot") return { kind: "not-understood", sentence: faultText(kept.faults) };
  return { kind: "robot", robot: kept.robot, file, notes: [...described.notes, ...kept.robot.assumptions] };
}

interface Described {
  readonly kind: "described";
  readonly robot: Robot;
  readonly notes: readonly string[];
}

const stem = (path: string): string =>
  nameOf(path).replace(/(\.urdf)?\.(urdf|xacro)$|(\.dh)?\.(json|csv|tsv|txt|dh)$/i, "") || "robot";

/** @throws {Refusal} */
function fromText(path: string, text: string): Described {
  if (text.trimStart().startsWith("{")) {
    const value = jsonOf(path, text);
    if (typeof value === "object" && value !== null && !("convention" in value)) {
      const answer = parseRobot(value);
      if (answer.kind === "not-a-robot") throw new Refusal(faultText(answer.faults));
      return { kind: "described", robot: answer.robot, notes: [] };
    }
  }
  const answer = readDhTable(text, stem(path));
  if (answer.kind !== "read") throw new Refusal(answer.sentence, answer.line);
  const robot = robotFromArm(answer.arm, {
    id: stem(path),
    name: answer.arm.name,
    assumptions: answer.assumptions,
    sources: { arm: `The D-H table ${nameOf(path)}.` },
  });
  return { kind: "described", robot, notes: [] };
}

function jsonOf(path: string, text: string): unknown {
  try {
    return JSON.parse(text);
  } catch (cause) {
    throw new Refusal(`${nameOf(path)} is not JSON: ${cause instanceof Error ? cause.message : "it cannot be read"}.`);
  }
}

async function fromDescription(path: string, files: FileSource): Promise<Described | NotUnderstood> {
  const answer = readRobot(path, files);
  if (answer.kind !== "read") return answer;
  const chain = armFromUrdf(answer.robot);
  if (chain.kind !== "chain") {
    const ends = endsOf(answer.robot).slice(0, 12).join(", ");
    return { ...chain, sentence: `${chain.sentence} The description ends in ${ends}.` };
  }
  const { links, shapeError_m, notes } = await drawnLinks(chain, path, files);
  const robot = robotFromArm(chain.arm, {
    id: stem(path),
    name: answer.robot.name,
    frames: { base: chain.base, tip: chain.tip },
    assumptions: [...answer.warnings, ...chain.assumptions],
    sources: { arm: `The description ${nameOf(path)}.` },
    shapeError_m,
    ...(chain.masses ? { masses: chain.masses } : {}),
    ...(links ? { links } : {}),
  });
  return { kind: "described", robot, notes };
}

const faultText = (faults: readonly { readonly path: string; readonly sentence: string }[]): string =>
  faults.map(({ path, sentence }) => (path === "" ? sentence : `${path}: ${sentence}`)).join(" ");
