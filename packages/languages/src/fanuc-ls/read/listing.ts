import type { TextPlace } from "@twincell/core";
import { TextError, plainText } from "../../parser/index.ts";
import { inEnglish, isGermanHead } from "./german.ts";
import { RegisterReader, VARIABLE_HEAD, type RegisterValues } from "./register-files.ts";

/** Three flags and the whole turns of axes 1, 4 and 6. */
export interface Config {
  readonly flip: boolean;
  readonly up: boolean;
  readonly toward: boolean;
  readonly turns: readonly [number, number, number];
}
export interface PositionRecord extends TextPlace {
  /** Numbers of the frame and the tool; undefined for F: those that are in use. */
  readonly uf: number | undefined;
  readonly ut: number | undefined;
  /** Taught with a tool that stands in the cell while the robot moves the part (RX, RY …). */
  readonly remote: boolean;
  /** X, Y, Z, W, P, R or J1 … J6; undefined where it was never taught. */
  readonly values: readonly number[] | undefined;
  readonly joints: boolean;
  readonly config: Config | undefined;
  /** What further groups and axes stand at, as it is written: they are not moved here. */
  readonly others: string;
}

/** A /PROG … /END of a text, its statements still as text: every character where it stands in the file. */
export interface ListedProgram extends TextPlace {
  readonly name: string;
  readonly comment: string;
  /** Lines of the whole file; those of no statement of this program are empty. */
  readonly code: string;
  readonly positions: ReadonlyMap<number, PositionRecord>;
}

/** Marks that no file holds: before a remark, and around a message. */
export const REMARK = "\u0002";
export const MESSAGE = "\u0001";

const SECTION = /^\s*\/(PROG|ATTR|APPL|MN|POS|END)\b\s*(.*)$/i;
const NUMBERED = /^\s*[0-9]*\s*:/;
const LABEL = /(\[\s*(?:[A-Za-z]+\[[0-9]+\]|[0-9]+)(?:\s*,\s*[0-9]+)?)\s*:([^\]]*)(?=\])/g;
const blank = (text: string): string => " ".repeat(text.length);

/**
 * Splits a text into its programs.
 *
 * @param label  told what a person calls a register or a line: "DO", 5, "lamp".
 * @throws {TextError} at the first thing that belongs to no listing.
 */
export function readListings(
  text: string,
  label: Labelling,
): { readonly programs: readonly ListedProgram[]; readonly registers: RegisterValues } {
  const lines = plainText(text).split(/\r\n|\n|\r/);
  const reader = new ListingReader(label);
  for (const [i, raw] of lines.entries())
    reader.line(i === 0 && raw.startsWith("\uFEFF") ? ` ${raw.slice(1)}` : raw, i);
  return reader.end(lines.length);
}

type Labelling = (word: string, number: number, name: string) => void;

class ListingReader {
  private readonly label: Labelling;
  private readonly programs: ListedProgram[] = [];
  private readonly registers = new RegisterReader();
  private section = "";
  private name = "";
  private comment = "";
  /** Lines before the program. */
  private from = 0;
  private opened: TextPlace = { line: 1, column: 1 };
  private code: string[] = [];
  private positions = new Map<number, PositionRecord>();
  private record: RecordReader | undefined;
  private isGerman = false;
  private inRegisters = false;

  constructor(label: Labelling) {
    this.label = label;
  }

  /** @param i  lines before it. */
  line(line: string, i: number): void {
    const place = { line: i + 1, column: 1 + (/\S/.exec(line)?.index ?? 0) };
    const head = line.trimStart().startsWith("/") && !line.trimStart().startsWith("//") ? SECTION.exec(line) : null;
    if (head !== null) return this.head(head[1]!.toUpperCase(), head[2]!.trim(), place);
    if (this.section === "MN") {
      this.code.push(statementOf(line, i + 1, this.label, this.isGerman));
      return;
    }
    this.code.push("");
    switch (this.section) {
      case "POS":
        return this.position(line, place);
      case "ATTR":
        return this.attribute(line);
      case "":
        return this.outside(line, place);
    }
  }

  private head(next: string, rest: string, place: TextPlace): void {
    if (this.record !== undefined) throw new TextError(place, "};", "The position is not closed.");
    if (next === "PROG") this.begin(rest, place);
    else if (this.section === "") throw new TextError(place, "/PROG", `/${next} stands outside a program.`);
    if (next === "END") {
      const { name, comment, from, code, positions, opened } = this;
      this.programs.push({ name, comment, code: "\n".repeat(from) + code.join("\n"), positions, ...opened });
      this.section = "";
    } else this.section = next;
    this.code.push("");
  }

  private begin(rest: string, place: TextPlace): void {
    if (this.section !== "") throw new TextError(place, "/END", "A program begins inside another.");
    const found = /^([A-Za-z_-][A-Za-z0-9_-]*)/.exec(rest)?.[1];
    if (found === undefined) throw new TextError(place, "the name of the program", "The program has no name.");
    this.name = found;
    this.isGerman = false;
    this.inRegisters = false;
    this.registers.close();
    this.comment = "";
    this.code = [];
    this.positions = new Map();
    this.from = place.line - 1;
    this.opened = place;
  }

  private position(line: string, place: TextPlace): void {
    if (line.trim() === "") return;
    this.record ??= RecordReader.begin(line, place);
    if (!this.record.take(line, place)) return;
    this.positions.set(this.record.number, this.record.done());
    this.record = undefined;
  }

  private attribute(line: string): void {
    this.isGerman ||= isGermanHead(line);
    const found = /^\s*(?:COMMENT|KOMMENTAR)\s*=\s*"([^"]*)"/i.exec(line)?.[1];
    if (found !== undefined) this.comment = found.trim();
  }

  private outside(line: string, place: TextPlace): void {
    if (VARIABLE_HEAD.test(line)) {
      this.registers.head(line);
      this.inRegisters = true;
    } else if (this.inRegisters) this.registers.take(line);
    else if (line.trim() !== "") throw new TextError(place, "/PROG", "The text is no listing of a TP program.");
  }

  end(line: number): { readonly programs: readonly ListedProgram[]; readonly registers: RegisterValues } {
    const { section, programs, registers } = this;
    if (section !== "") throw new TextError({ line, column: 1 }, "/END", `The program ${this.name} has no end.`);
    if (programs.length === 0) throw new TextError({ line, column: 1 }, "/PROG", "The text holds no program.");
    registers.close();
    return { programs, registers: registers.registers };
  }
}

/** The line below the statements of a point's logic, which are numbered on their own. */
const LOGIC_END = /^\s*-{3,}\s*;?\s*$/;

/** A numbered line without its number, its end and the names that people gave to registers. */
function statementOf(
  line: string,
  at: number,
  label: (word: string, number: number, name: string) => void,
  isGerman: boolean,
): string {
  if (LOGIC_END.test(line)) return "";
  const number = NUMBERED.exec(line)?.[0] ?? "";
  if (number === "" && line.trim() !== "" && !/^\s/.test(line))
    throw new TextError({ line: at, column: 1 }, "the number of the line and a colon", "The line has no number.");
  const body = line.slice(number.length);
  let rest = (isGerman ? inEnglish(body) : body)
    .replace(/;\s*(?:(?:!|--|\/\/).*)?$/, end => blank(end))
    .replaceAll(MESSAGE, " ")
    .replaceAll(REMARK, " ");
  const first = rest.trimStart();
  const indent = rest.length - first.length;
  if (first.startsWith("!")) rest = `${blank(rest.slice(0, indent))}${REMARK}${first.slice(1)}`;
  else if (first.startsWith("--eg:")) rest = `${blank(rest.slice(0, indent + 4))}${REMARK}${first.slice(5)}`;
  // A statement that was taken out.
  else if (first.startsWith("//")) rest = "";
  else if (/^MESSAGE\s*\[/i.test(first)) {
    const open = rest.indexOf("[");
    const close = rest.lastIndexOf("]");
    if (close > open)
      rest = `${rest.slice(0, open)}${MESSAGE}${rest.slice(open + 1, close)}${MESSAGE}${rest.slice(close + 1)}`;
  } else {
    // Texts are given to programs that are called; positions of group 1 are those of the arm.
    if (/\bCALL\b/i.test(rest)) rest = rest.replace(/'([^']*)'/g, `${MESSAGE}$1${MESSAGE}`);
    if (rest.includes("[GP1:")) rest = rest.replaceAll("[GP1:", "[    ");
  }
  if (rest.includes(":") && !rest.includes(REMARK) && !/^\s*MESSAGE\b/i.test(rest)) {
    for (const [, word, index, name] of rest.matchAll(/([A-Za-z]+)\[\s*([0-9]+)\s*(?:,[^\]:]*)?:([^\]]*)\]/g))
      label(word!, Number(index), name!.trim());
    rest = rest.replace(LABEL, (whole, open: string) => open + blank(whole.slice(open.length)));
  }
  return blank(number) + rest;
}

const CONFIG = /[CK]ONFIG\s*:\s*'\s*([FN])\s*([UD])\s*([TB])\s*,\s*(-?[0-9]+)\s*,\s*(-?[0-9]+)\s*,\s*(-?[0-9]+)\s*'/i;
const FIELD = /\b(R?[XYZWPR]|J[1-9]|E[1-9])\s*=\s*([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)|\*+)\s*(mm|deg)/gi;
const CARTESIAN = ["X", "Y", "Z", "W", "P", "R"];
const JOINTS = ["J1", "J2", "J3", "J4", "J5", "J6"];

/** One record of /POS, line by line. */
class RecordReader {
  readonly number: number;
  private readonly place: TextPlace;
  private readonly fields = new Map<string, number | undefined>();
  private uf: number | undefined = 0;
  private ut: number | undefined = 0;
  private remote = false;
  private config: Config | undefined;
  private group = 1;
  private others = "";

  private constructor(number: number, place: TextPlace) {
    this.number = number;
    this.place = place;
  }

  static begin(line: string, place: TextPlace): RecordReader {
    const found = /^\s*P\[\s*([0-9]+)\s*(?::[^\]]*)?\]\s*\{/i.exec(line)?.[1];
    if (found === undefined) throw new TextError(place, "P[n]{", "No position begins here.");
    return new RecordReader(Number(found), place);
  }

  /** Whether the record ends in this line. */
  take(line: string, place: TextPlace): boolean {
    const group = /\bGP([0-9])\s*:/i.exec(line)?.[1];
    if (group !== undefined) this.group = Number(group);
    if (this.group === 1) {
      const frames = /UF\s*:\s*([0-9F]+)\s*,\s*UT\s*:\s*([0-9F]+)/i.exec(line);
      if (frames !== null) {
        this.uf = numbered(frames[1]!);
        this.ut = numbered(frames[2]!);
      }
      if (/[CK]ONFIG/i.test(line)) {
        const found = CONFIG.exec(line);
        if (found === null)
          throw new TextError(place, "CONFIG : 'N U T, 0, 0, 0'", "The configuration is not understood.");
        this.config = {
          flip: found[1]!.toUpperCase() === "F",
          up: found[2]!.toUpperCase() === "U",
          toward: found[3]!.toUpperCase() === "T",
          turns: [Number(found[4]), Number(found[5]), Number(found[6])],
        };
      }
      for (const [, name, value] of line.matchAll(FIELD)) this.field(name!.toUpperCase(), value!);
    }
    if (this.group > 1 || /\bE[1-9]\s*=/.test(line))
      for (const [, name, value] of line.matchAll(FIELD))
        if (this.group > 1 || name!.toUpperCase().startsWith("E"))
          this.others += `${this.others === "" ? "" : ", "}GP${this.group} ${name!.toUpperCase()} ${value}`;
    if (/\}\s*;/.test(line)) return true;
    if (this.fields.size > 40 || place.line > this.place.line + 60)
      throw new TextError(place, "};", `The position P[${this.number}] is not closed.`);
    return false;
  }

  /** RX, RY … RR are fields of a position with a remote tool; J7 and later belong to further axes. */
  private field(name: string, value: string): void {
    if (name.length === 2 && name.startsWith("R")) this.remote = true;
    const key = name.length === 2 && name.startsWith("R") ? name.slice(1) : name;
    this.fields.set(key, value.startsWith("*") ? undefined : Number(value));
  }

  done(): PositionRecord {
    const { fields, uf, ut, config, place, others, remote } = this;
    const joints = fields.has("J1");
    const names = joints ? JOINTS : CARTESIAN;
    // A position of further groups alone says nothing of the arm.
    if (fields.size > 0 && !names.every(name => fields.has(name)))
      throw new TextError(place, names.join(", "), `The position P[${this.number}] lacks one of ${names.join(", ")}.`);
    const values = names.map(name => fields.get(name));
    const known = values.filter(value => value !== undefined);
    return {
      uf,
      ut,
      joints,
      config,
      remote,
      values: known.length === names.length ? known : undefined,
      others,
      ...place,
    };
  }
}

/** F stands for the frame or the tool that is in use. */
const numbered = (text: string): number | undefined => (/^[0-9]+$/.test(text) ? Number(text) : undefined);
