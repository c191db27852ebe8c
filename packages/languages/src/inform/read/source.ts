import type { TextFault, TextPlace } from "@twincell/core";
import { TextError, plainText, LineReader } from "../../parser/index.ts";
import { Cursor } from "./cursor.ts";
import { JobBuilder } from "./job.ts";
import { positionKey } from "./statement.ts";
import type { Frame, Job, PositionType, Source } from "./syntax.ts";

export type SourceAnswer =
  | { readonly kind: "source"; readonly source: Source }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

const NUMBERS = /^-?[0-9]+(?:\.[0-9]*)?(?:,-?[0-9]+(?:\.[0-9]*)?)*$/;
const TYPES: ReadonlySet<string> = new Set(["PULSE", "ANGLE", "BASE", "ROBOT", "TOOL", "USER"]);

/**
 * Reads jobs, one behind the other in one text, first one first, with the tools (TOOL.CND) and user frames (UFRAME.CND)
 * that they mean. Goes on after a fault, so that all of them are told at once.
 */
export function readSource(text: string): SourceAnswer {
  const reader = new SourceReader();
  const wrong = reader.read(text);
  if (wrong !== undefined) return wrong;
  return { kind: "source", source: { jobs: reader.jobs, tools: reader.tools, users: reader.users } };
}

class SourceReader extends LineReader {
  readonly jobs = new Map<string, Job>();
  readonly tools = new Map<number, Frame>();
  readonly users = new Map<number, Frame>();
  private section: "outside" | "job" | "positions" | "head" | "instructions" | "tool" | "user" = "outside";
  private builder: JobBuilder | undefined;
  private opened = 0;
  private type: PositionType = "PULSE";
  private user = 0;
  private tool = 0;
  private rconf: readonly number[] = [];
  private counted: { readonly at: TextPlace; readonly c: number; readonly p: number } | undefined;
  private frame: { number: number; name: string } | undefined;

  protected line(raw: string, line: number): void {
    const text = plainText(raw).trimEnd();
    const at = { line, column: 1 };
    if (text.trim() === "") return;
    const mark = /^(\/{1,4})([A-Z]+)\s*(.*)$/i.exec(text);
    if (
      mark !== null &&
      (mark[1] !== "//" || this.section !== "instructions" || /^\/\/(?:TOOL|UFRAME|NAME|POS|INST)\b/i.test(text))
    ) {
      return this.header(`${mark[1]!}${mark[2]!.toUpperCase()}`, mark[3]!, at);
    }
    switch (this.section) {
      case "positions":
        return this.position(text, at);
      case "instructions":
        return this.instruction(raw, line);
      case "head":
        return this.beginning(raw, line);
      case "tool":
        return this.frameValues(text, at);
      case "user":
        return;
      default:
        // Remarks stand before a job and behind it.
        if (text.trimStart().startsWith("'")) return;
        throw new TextError(at, "/JOB", `"${text.slice(0, 20)}" stands outside a job.`);
    }
  }

  protected end(line: number): void {
    if (
      this.section === "job" ||
      this.section === "positions" ||
      this.section === "head" ||
      this.section === "instructions"
    ) {
      throw new TextError({ line, column: 1 }, "END", `The job of line ${this.opened} has no END.`);
    }
    if (this.jobs.size === 0) throw new TextError({ line: 1, column: 1 }, "/JOB", "The text has no job.");
  }

  private header(word: string, rest: string, at: TextPlace): void {
    if (this.builder === undefined && (word === "//NAME" || word === "//POS" || word === "//INST"))
      throw new TextError(at, "/JOB", `${word} stands outside a job.`);
    switch (word) {
      case "/JOB":
        if (this.section !== "outside" && this.section !== "tool" && this.section !== "user")
          throw new TextError(at, "END", `The job of line ${this.opened} has no END.`);
        this.section = "job";
        this.opened = at.line;
        this.builder = new JobBuilder("", at);
        this.type = "PULSE";
        this.user = this.tool = 0;
        this.rconf = [];
        this.counted = undefined;
        return;
      case "//NAME": {
        const name = rest.trim();
        if (name === "" || /\s/.test(name))
          throw new TextError(at, "a name without blanks", `"${name}" is no name of a job.`);
        if (this.jobs.has(name)) throw new TextError(at, "a job name used once", `Job ${name} is in the text twice.`);
        this.builder = new JobBuilder(name, at);
        return;
      }
      case "//POS":
        this.section = "positions";
        return;
      case "//INST":
        this.checkCount();
        this.section = "head";
        return;
      case "///NPOS": {
        const [c, , , p] = this.numbers(rest, at);
        this.counted = { at, c: c!, p: p ?? 0 };
        return;
      }
      case "///USER":
        this.user = this.numbers(rest, at)[0]!;
        return;
      case "///TOOL":
        if (this.section !== "user") this.tool = this.numbers(rest, at)[0]!;
        return;
      default:
        return this.detail(word, rest, at);
    }
  }

  /** What positions, tools and user frames are. */
  private detail(word: string, rest: string, at: TextPlace): void {
    switch (word) {
      case "///POSTYPE": {
        const type = rest.trim().toUpperCase();
        if (!TYPES.has(type))
          throw new TextError(
            at,
            "PULSE, ANGLE, BASE, ROBOT, TOOL or USER",
            `Positions of type ${type} are not understood here.`,
          );
        this.type = type as PositionType;
        return;
      }
      case "///RCONF":
        this.rconf = this.numbers(rest, at);
        return;
      case "//TOOL":
      case "//UFRAME":
        if (this.section === "instructions" || this.section === "positions")
          throw new TextError(at, "END", `The job of line ${this.opened} has no END.`);
        this.section = word === "//TOOL" ? "tool" : "user";
        this.frame = { number: this.numbers(rest, at)[0]!, name: "" };
        return;
      case "///NAME":
        if (this.frame !== undefined) this.frame.name = rest.trim();
        return;
      case "////BUSER":
        if (this.frame !== undefined && this.section === "user")
          this.users.set(this.frame.number, { ...this.frame, values: this.six(rest, at) });
        return;
      default:
        // Date, comment, attributes, groups and the teaching points of frames do not move the robot.
        if (this.section === "outside") throw new TextError(at, "/JOB", `${word} stands outside a job.`);
    }
  }

  private frameValues(text: string, at: TextPlace): void {
    // The first line is the frame; weight and centre of mass come behind it.
    if (this.frame === undefined || this.tools.has(this.frame.number)) return;
    this.tools.set(this.frame.number, { ...this.frame, values: this.six(text.trim(), at) });
  }

  private position(text: string, at: TextPlace): void {
    const match = /^((?:C|L?P)[0-9]{3,5})\s*=\s*(.*)$/i.exec(text.trim());
    if (match === null) {
      // Positions of a track or a station are kept: they are not moved here.
      const other = /^((?:BC|EC|L?BP|L?EX)[0-9]{3,5})\s*=\s*(.*)$/i.exec(text.trim());
      if (other !== null) {
        this.builder!.others.set(positionKey(other[1]!), other[2]!.trim());
        return;
      }
      throw new TextError(at, "a position such as C00000=1,2,3,4,5,6", `"${text.slice(0, 20)}" is no position.`);
    }
    const key = positionKey(match[1]!);
    const values =
      this.type === "PULSE" || this.type === "ANGLE" ? this.numbers(match[2]!, at) : this.six(match[2]!, at);
    if (this.builder!.positions.has(key))
      throw new TextError(at, "a position used once", `Position ${key} is in the job twice.`);
    this.builder!.positions.set(key, {
      ...at,
      type: this.type,
      user: this.user,
      tool: this.tool,
      values,
      rconf: this.rconf,
    });
  }

  private checkCount(): void {
    const keys = [...(this.builder?.positions.keys() ?? [])];
    const c = keys.filter(key => key.startsWith("C")).length;
    if (this.counted === undefined || (this.counted.c === c && this.counted.p === keys.length - c)) return;
    throw new TextError(
      this.counted.at,
      `${c} and ${keys.length - c}`,
      `///NPOS counts ${this.counted.c} positions and ${this.counted.p} variables; the job has ${c} and ${keys.length - c}.`,
    );
  }

  private beginning(raw: string, line: number): void {
    const cursor = new Cursor(raw, line);
    if (cursor.done) return;
    if (cursor.next !== "NOP") throw cursor.unexpected("NOP, with which every job begins");
    this.section = "instructions";
  }

  private instruction(raw: string, line: number): void {
    const cursor = new Cursor(raw, line);
    if (cursor.done) return;
    if (cursor.next !== "END") return this.builder!.line(cursor);
    const place = cursor.here;
    const builder = this.builder!;
    cursor.take();
    this.section = "outside";
    this.builder = undefined;
    cursor.expectEnd();
    const job = builder.finish(place);
    this.jobs.set(job.name, job);
  }

  private numbers(text: string, at: TextPlace): number[] {
    const plain = text.replace(/\s/g, "");
    if (!NUMBERS.test(plain))
      throw new TextError(
        at,
        "numbers with commas between them",
        `"${text.trim().slice(0, 40)}" is no list of numbers.`,
      );
    return plain.split(",").map(Number);
  }

  private six(text: string, at: TextPlace): number[] {
    const values = this.numbers(text, at);
    if (values.length < 6)
      throw new TextError(at, "six numbers", `${values.length} numbers stand where X, Y, Z, Rx, Ry, Rz are expected.`);
    return values.slice(0, 6);
  }
}
