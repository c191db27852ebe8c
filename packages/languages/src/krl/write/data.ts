import type { EmittedFile, Pose, SignalLine, Variable } from "@twincell/core";
import { BlockWriter } from "../../emitter/index.ts";
import { frameText } from "./location.ts";
import { krlName } from "./names.ts";

const GRIPPER = "GRIPPER";
const WIRES: Readonly<Record<SignalLine["kind"], string>> = {
  "digital-in": "$IN",
  "digital-out": "$OUT",
  "analogue-in": "$ANIN",
  "analogue-out": "$ANOUT",
};

/** The data list of a module: what a person may touch up on the pendant without looking at the program. */
export class DataList {
  /** Every name of the module: points, frames, signals, counters, routines. */
  readonly taken = new Set<string>([GRIPPER]);
  private readonly frames = new Map<string, string>();
  private hasGripper = false;
  private readonly signals = new Map<string, string>();
  private readonly variables = new Map<string, string>();
  private readonly declared: { readonly line: string; readonly step: string }[] = [];

  /**
   * The name under which a frame is kept; declared when it is asked for first. `key` tells frames apart that are called
   * the same.
   */
  frame(prefix: "TOOL_" | "BASE_" | "ROOT_", name: string, pose: () => Pose): string {
    const key = `${prefix}${name}`;
    const known = this.frames.get(key);
    if (known !== undefined) return known;
    const variable = krlName(name, this.taken, prefix);
    this.frames.set(key, variable);
    this.add(`DECL FRAME ${variable}={${frameText(pose())}}`);
    return variable;
  }

  signal(name: string, { kind, address }: SignalLine): string {
    const known = this.signals.get(name);
    if (known !== undefined) return known;
    const variable = krlName(name, this.taken);
    this.signals.set(name, variable);
    this.add(`SIGNAL ${variable} ${WIRES[kind]}[${address}]`);
    return variable;
  }

  /** The output of the gripper, whose name says what it is. */
  gripper(address: number): string {
    if (!this.hasGripper) this.add(`SIGNAL ${GRIPPER} $OUT[${address}]`);
    this.hasGripper = true;
    return GRIPPER;
  }

  /** A variable of the program; its first value is given where the program begins. */
  variable(name: string, { type }: Variable): string {
    const known = this.variables.get(name);
    if (known !== undefined) return known;
    const variable = krlName(name, this.taken);
    this.variables.set(name, variable);
    this.add(`DECL ${{ bool: "BOOL", int: "INT", num: "REAL" }[type]} ${variable}=${type === "bool" ? "FALSE" : "0"}`);
    return variable;
  }

  counter(name: string): string {
    const variable = krlName(name, this.taken);
    this.add(`DECL INT ${variable}=0`);
    return variable;
  }

  add(line: string, step = ""): void {
    this.declared.push({ line, step });
  }

  file(name: string): EmittedFile {
    const out = new BlockWriter();
    out.add("&ACCESS RVP");
    out.add("&REL 1");
    out.add(`DEFDAT ${name}`);
    out.depth = 1;
    out.add("EXT BAS(BAS_COMMAND :IN,REAL :IN)");
    for (const { line, step } of this.declared) out.add(line, step);
    out.depth = 0;
    out.add("ENDDAT");
    return out.file(`${name}.dat`);
  }
}
