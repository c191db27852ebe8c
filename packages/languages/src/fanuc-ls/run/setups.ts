import type { TextPlace } from "@twincell/core";
import { nameIn, rememberMap, type DeclaredCell, type Notices } from "../../parser/index.ts";
import type { ControllerArm } from "./arm.ts";
import { NOTHING, toPose, type Matrix } from "./matrix.ts";

/** A tool or a frame as it was set up, and what a person calls it. */
export interface Setup {
  readonly matrix: Matrix;
  readonly name: string;
}
type What = "uframe" | "utool";

/** What is taken of a frame or a tool that is set up nowhere. */
export const assumption = (name: string): string =>
  `${name} is set up nowhere in the text: it is taken to be no different from the ${name.startsWith("UF") ? "world" : "flange"}.`;

/** The user frames and tools of the controller, and which of them is in use. */
export class Setups {
  /** Frames and tools that were used and are set up nowhere in the text. */
  readonly assumed = new Map<string, TextPlace>();
  /** The numbers in use: UFRAME_NUM and UTOOL_NUM; undefined until the program says them. */
  readonly inUse: Record<What, number | undefined> = { uframe: undefined, utool: undefined };
  private readonly declared: DeclaredCell;
  private readonly arm: ControllerArm;
  private readonly known = new Map<string, Setup>();

  private readonly notices: Notices | undefined;

  constructor(declared: DeclaredCell, arm: ControllerArm, notices?: Notices) {
    this.notices = notices;
    this.declared = declared;
    this.arm = arm;
  }

  define(key: string, setup: Setup): void {
    this.known.set(key, setup);
  }
  /** The one of that number: the world or the flange where nothing is said of it. */
  of(what: What, number: number, at: TextPlace): Setup {
    const known = this.known.get(`${what}${number}`);
    if (known !== undefined) return known;
    if (number === 0) return { matrix: NOTHING, name: what === "uframe" ? "world" : "flange" };
    const name = `${what.toUpperCase()} ${number}`;
    if (!this.assumed.has(name)) {
      this.assumed.set(name, at);
      this.notices?.notGiven(at, assumption(name));
    }
    return { matrix: NOTHING, name };
  }
  /** The one in use. */
  now(what: What, at: TextPlace): Setup {
    return this.of(what, this.inUse[what] ?? 0, at);
  }

  /** The name that the neutral program gives a tool, under which it is declared from now on. */
  toolName(tool: Setup): string {
    return tool.name === "flange"
      ? "flange"
      : nameIn(this.declared.tools, toPose<"flange", "tcp">(tool.matrix), tool.name, " ");
  }
  frameName(frame: Setup): string {
    return frame.name === "world"
      ? "world"
      : nameIn(this.declared.frames, this.arm.cell<"world", "frame">(frame.matrix), frame.name, " ");
  }

  /** Remembers what is set up and in use; the answer brings it back. */
  remember(): () => void {
    const known = rememberMap(this.known);
    const inUse = { ...this.inUse };
    return () => {
      known();
      Object.assign(this.inUse, inUse);
    };
  }
}
