import { readFileSync } from "node:fs";
import { PlainFault } from "@twincell/core";
import { z } from "zod";

const VERSION = 1;
const signal = z.strictObject({
  /** As OPC UA writes them: ns=2;s=PartThere. */
  node: z.string().min(1).max(500),
  robot: z.string().min(1).max(200),
  line: z.string().min(1).max(200),
  /** "plc": the robot's input follows the node; "robot": the node follows the robot's line. */
  from: z.enum(["plc", "robot"]),
});
const file = z.strictObject({
  format: z.literal("twincell.plc"),
  version: z.literal(VERSION),
  url: z.string().regex(/^opc\.tcp:\/\/.+/),
  user: z.string().min(1).optional(),
  password: z.string().min(1).optional(),
  signals: z.array(signal).min(1).max(1000),
});
export type PlcFile = z.infer<typeof file>;
export type PlcSignal = z.infer<typeof signal>;

/** Which nodes of a controller's OPC UA server belong to which lines of which robots. Throws with the place. */
export function readPlcFile(path: string): PlcFile {
  const fault = (why: string): PlainFault =>
    new PlainFault("plc.file", `${path}: ${why}`, "docs/plant.md says how such a file is written.");
  let value: unknown;
  try {
    value = JSON.parse(readFileSync(path, "utf8"));
  } catch (problem) {
    throw fault(`it cannot be read: ${problem instanceof Error ? problem.message : String(problem)}.`);
  }
  const { version } = (value ?? {}) as { readonly version?: unknown };
  if (typeof version === "number" && version > VERSION)
    throw fault(`it is of version ${version}; this release reads version ${VERSION}.`);
  const parsed = file.safeParse(value);
  if (parsed.success) return parsed.data;
  const [issue] = parsed.error.issues;
  throw fault(`${issue?.path.join(".") ?? "it"}: ${issue?.message ?? "is wrong"}.`);
}
