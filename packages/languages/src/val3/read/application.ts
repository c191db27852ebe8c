import type { TextFault, TextPlace } from "@twincell/core";
import { TextError, plainText } from "../../parser/index.ts";
import type { Block, Parameter, Routine, Statement } from "../../parser/structured/index.ts";
import { readCode } from "./code.ts";
import { xmlParts, type XmlPart } from "./xml.ts";

/** A datum with the attributes of its values, by their keys. */
export interface DataDeclaration extends TextPlace {
  readonly name: string;
  readonly type: string;
  /** How many values it has; those that are not written are as their type begins. */
  readonly size: number;
  readonly values: readonly ReadonlyMap<string, string>[];
}
/** A program that is not understood, where it is called. */
export const FAULT = "\u0000fault";
const faultStatement = ({ line, column, expected, sentence }: TextFault): Statement => ({
  kind: "do",
  name: FAULT,
  args: [expected, sentence].map(value => ({ value: { kind: "text", value, line, column }, line, column })),
  line,
  column,
});

export interface Application {
  readonly title: string;
  readonly main: Routine;
  /** By "call name". */
  readonly routines: ReadonlyMap<string, Routine>;
  readonly data: readonly DataDeclaration[];
  /** Variables of a program, by its name: each with the value that its type begins with. */
  readonly locals: ReadonlyMap<string, ReadonlyMap<string, string>>;
}
export type ApplicationAnswer =
  | { readonly kind: "source"; readonly source: Application }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

interface OpenProgram extends TextPlace {
  readonly name: string;
  readonly parameters: Parameter[];
  readonly locals: Map<string, string>;
  code?: { readonly text: string; readonly at: TextPlace };
}

/** Reads programs (.pgx) and data (.dtx), one behind the other. */
export function readApplication(text: string): ApplicationAnswer {
  const reader = new PartReader();
  try {
    for (const part of xmlParts(plainText(text).replace(/\r(?!\n)/g, "\n"))) reader.part(part);
    if (!reader.seen || reader.programs.length === 0)
      throw new TextError({ line: 1, column: 1 }, "<Programs>", "The text holds no program of VAL 3.");
  } catch (cause) {
    if (!(cause instanceof TextError)) throw cause;
    return { kind: "not-understood", faults: [cause.fault] };
  }
  return applicationOf(reader.programs, reader.data);
}

type Tag = Extract<XmlPart, { kind: "open" | "close" }>;

class PartReader {
  readonly programs: OpenProgram[] = [];
  readonly data: DataDeclaration[] = [];
  /** Something of VAL 3 was met. */
  seen = false;
  private program: OpenProgram | undefined;
  private values: Map<string, string>[] | undefined;
  /** The section of an older file that is read. */
  private section = "";
  private databases = 0;
  private father = "";

  part(part: XmlPart): void {
    if (part.kind === "data") {
      if (this.program === undefined) throw new TextError(part, "a program", "Code stands outside a program.");
      this.program.code = { text: part.text, at: { line: part.line, column: part.column } };
      return;
    }
    const name = part.name.toLowerCase();
    const own = part.attributes.get("name") ?? "";
    if (part.kind === "close") {
      if (name === "program") this.program = undefined;
      if (name === this.section) this.section = "";
    } else if (this.section !== "") this.older(part, name, own);
    else this.tag(part, name, own);
  }

  private tag(part: Tag, name: string, own: string): void {
    switch (name) {
      case "programs":
      case "programlist":
      case "datalist":
      case "database":
        this.databases++;
        this.seen = true;
        return;
      case "project":
        this.seen = true;
        return;
      case "program":
        return this.beginProgram(part, own);
      case "parameter":
      case "param":
        return this.parameter(part, own);
      case "local":
        this.program?.locals.set(own, newType(part.attributes.get("type") ?? "num"));
        return;
      case "data":
        return this.datum(part, own);
      case "value":
        this.values?.push(new Map(part.attributes));
        return;
      default:
        // The sections of older files: what they hold is told by the name of the tag.
        if (this.seen && this.program === undefined && name.endsWith("section") && !part.isEmpty) this.section = name;
    }
  }

  private beginProgram(part: Tag, own: string): void {
    // A project lists its programs by their files.
    if (!part.attributes.has("name")) return;
    if (this.programs.some(other => other.name === own))
      throw new TextError(part, "a name used once", `The program ${own} is there twice.`);
    this.program = { name: own, parameters: [], locals: new Map(), line: part.line, column: part.column };
    this.programs.push(this.program);
  }

  private parameter({ attributes }: Tag, own: string): void {
    const type = newType(attributes.get("type") ?? "num");
    const isBack = attributes.get("use") === "reference" || attributes.get("byVal") === "false";
    this.program?.parameters.push({ name: own, type, ...(isBack ? { isBack } : {}) });
  }

  private datum(part: Tag, own: string): void {
    if (!part.attributes.has("name")) return;
    // The data of a library behind those of the application: its own are met first.
    const isAgain = this.data.some(other => other.name === own);
    if (isAgain && this.databases < 2)
      throw new TextError(part, "a name used once", `The datum ${own} is there twice.`);
    this.values = [];
    if (!isAgain) this.addDatum(part, own, part.attributes.get("type") ?? "", this.values);
  }

  private addDatum(part: Tag, name: string, type: string, values: Map<string, string>[]): void {
    this.data.push({ name, type, size: sizeOf(part), values, line: part.line, column: part.column });
  }

  /** A part of a section of an older file: a datum, one of its values, or what such a value holds. */
  private older(part: Tag, name: string, own: string): void {
    const isFather = name.endsWith("father");
    const isValue = name.startsWith("value");
    if (this.section === `${name}section` || (own !== "" && !isValue && !isFather && this.values === undefined)) {
      this.values = [];
      this.father = "";
      return this.addDatum(part, own, newType(name), this.values);
    }
    const last = this.values?.at(-1);
    if (isFather) {
      this.father = own;
      last?.set("fatherId", own);
    } else if (isValue) this.values?.push(new Map([...part.attributes, ["fatherId", this.father]]));
    else for (const [key, value] of part.attributes) last?.set(key, value);
  }
}

function applicationOf(programs: readonly OpenProgram[], data: readonly DataDeclaration[]): ApplicationAnswer {
  const faults: TextFault[] = [];
  const routines = new Map<string, Routine>();
  const entry = programs.find(({ name }) => name === "start") ?? programs[0]!;
  for (const { name, parameters, code, line, column } of programs) {
    if (code === undefined) {
      faults.push(new TextError({ line, column }, "<![CDATA[begin … end]]>", `The program ${name} has no code.`).fault);
      continue;
    }
    const read = readCode(
      `${"\n".repeat(code.at.line - 1)}${" ".repeat(code.at.column - 1)}${code.text}`,
      name === entry.name,
    );
    // What is wrong in another program than the first of the text matters where it is called.
    const [fault] = read.faults;
    if (fault !== undefined && name !== programs[0]!.name) {
      routines.set(`call ${name}`, { name: `call ${name}`, parameters, body: [faultStatement(fault)], line, column });
      continue;
    }
    faults.push(...read.faults);
    routines.set(`call ${name}`, { name: `call ${name}`, parameters, body: read.block, line, column });
  }
  if (faults.length > 0) return { kind: "not-understood", faults };
  const main = routines.get(`call ${entry.name}`)!;
  return {
    kind: "source",
    source: {
      title: titleOf(main.body) ?? entry.name,
      main,
      routines,
      data,
      locals: new Map(programs.map(({ name, locals }) => [`call ${name}`, locals])),
    },
  };
}

/** Larger arrays are nobody's data. */
const MOST_VALUES = 100_000;
function sizeOf({ attributes }: Extract<XmlPart, { kind: "open" | "close" }>): number {
  // "3,4" is an array of two dimensions.
  const places = (attributes.get("size") ?? "1").split(",").map(Number);
  const size = places.reduce((product, each) => product * each, 1);
  return Number.isInteger(size) && size >= 0 && size <= MOST_VALUES && places.length === 1 ? size : 1;
}

/** Arms of six axes are meant where older files say only "point". */
const newType = (type: string): string => (type === "point" ? "pointRx" : type === "joint" ? "jointRx" : type);

function titleOf(block: Block): string | undefined {
  const first = block.find(
    (statement): statement is Extract<Statement, { kind: "comment" }> => statement.kind === "comment",
  );
  return first?.text.startsWith("*") === true ? first.text.slice(1).trim() : undefined;
}
