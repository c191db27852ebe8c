import { compose, type EmittedFile, type Pose } from "@twincell/core";
import { rectanText } from "./location.ts";
import { titleText } from "./names.ts";
import { BlockWriter, type WalkedPlace } from "../../emitter/index.ts";

/** Tools 0 … 63 and user frames 1 … 63; variables of a kind 0 … 99. */
const LAST_FRAME = 63;
const LAST_VARIABLE = 99;

/** What a controller keeps outside of jobs, numbered in the order of use: tools, user frames, variables. */
export class Controller {
  /** Numbers that ran out. */
  readonly spent = new Set<string>();
  private readonly place: WalkedPlace;
  private readonly tools = new Map<string, number>([["flange", 0]]);
  private readonly users = new Map<string, number>();
  private readonly variables = new Map<string, string>();
  /** Variables for what is computed on the way. */
  readonly spare: string[] = [];
  private readonly used: Record<"I" | "D" | "P", number> = { I: 0, D: 0, P: 0 };

  constructor(place: WalkedPlace) {
    this.place = place;
  }

  tool(name: string): number {
    return this.numbered(this.tools, name, this.tools.size, "tools");
  }
  user(name: string): number {
    return this.numbered(this.users, name, this.users.size + 1, "user frames");
  }

  /** The variable that a variable of the program has become; all jobs share it. */
  named(name: string): string {
    const known = this.variables.get(name);
    if (known !== undefined) return known;
    const made = this.variable("D");
    this.variables.set(name, made);
    return made;
  }

  variable(letter: "I" | "D" | "P"): string {
    if (this.used[letter] > LAST_VARIABLE) this.spent.add(`${letter} variables`);
    return `${letter}${String(this.used[letter]++).padStart(3, "0")}`;
  }

  /** The user frame of a name, in robot coordinates. */
  vendorFromFrame(name: string): Pose<"vendor-world", "frame"> {
    return compose(this.place.vendorFromWorld, this.place.worldFromFrame(name));
  }

  /** TOOL.CND and UFRAME.CND with the numbers that the jobs mean. */
  files(): EmittedFile[] {
    const files: EmittedFile[] = [];
    if (this.tools.size > 1) {
      const out = new BlockWriter();
      for (const [name, number] of this.tools) {
        if (number === 0) continue;
        out.add(`//TOOL ${number}`);
        out.add(`///NAME ${titleText(name)}`);
        out.add(rectanText(this.place.tool(name)));
      }
      files.push(out.file("TOOL.CND"));
    }
    if (this.users.size > 0) {
      const out = new BlockWriter();
      for (const [name, number] of this.users) {
        out.add(`//UFRAME ${number}`);
        out.add(`///NAME ${titleText(name)}`);
        out.add("///TOOL 0");
        out.add(`////BUSER ${rectanText(this.vendorFromFrame(name))}`);
      }
      files.push(out.file("UFRAME.CND"));
    }
    return files;
  }

  private numbered(of: Map<string, number>, name: string, next: number, what: string): number {
    const known = of.get(name);
    if (known !== undefined) return known;
    if (next > LAST_FRAME) this.spent.add(what);
    of.set(name, next);
    return next;
  }
}
