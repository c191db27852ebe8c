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
  const programs: OpenProgram[] = [];
  const data: DataDeclaration[] = [];
  let program: OpenProgram | undefined;
  let values: Map<string, string>[] | undefined;
  let seen = false;
  let section = "";
  let databases = 0;
  let father = "";
  /** A part of a section of an older file: a datum, one of its values, or what such a value holds. */
  const older = (part: Extract<XmlPart, { kind: "open" | "close" }>, name: string, own: string): void => {
    if (
      section === `${name}section` ||
      (own !== "" && !name.startsWith("value") && !name.endsWith("father") && values === undefined)
    ) {
      values = [];
      father = "";
      data.push({ name: own, type: newType(name), size: sizeOf(part), values, line: part.line, column: part.column });
      return;
    }
    if (name.endsWith("father")) {
      father = own;
      values?.at(-1)?.set("fatherId", own);
    } else if (name.startsWith("value")) values?.push(new Map([...part.attributes, ["fatherId", father]]));
    else for (const [key, value] of part.attributes) values?.at(-1)?.set(key, value);
  };
  try {
    for (const part of xmlParts(plainText(text).replace(/\r(?!\n)/g, "\n"))) {
      if (part.kind === "data") {
        if (program === undefined) throw new TextError(part, "a program", "Code stands outside a program.");
        program.code = { text: part.text, at: { line: part.line, column: part.column } };
        continue;
      }
      const name = part.name.toLowerCase();
      const own = part.attributes.get("name") ?? "";
      if (part.kind === "close") {
        if (name === "program") program = undefined;
        if (name === section) section = "";
        continue;
      }
      if (section !== "") {
        older(part, name, own);
        continue;
      }
      switch (name) {
        case "programs":
        case "programlist":
        case "datalist":
        case "database":
          databases++;
          seen = true;
          break;
        case "project":
          seen = true;
          break;
        case "program":
          // A project lists its programs by their files.
          if (!part.attributes.has("name")) break;
          if (programs.some(other => other.name === own))
            throw new TextError(part, "a name used once", `The program ${own} is there twice.`);
          program = { name: own, parameters: [], locals: new Map(), line: part.line, column: part.column };
          programs.push(program);
          break;
        case "parameter":
        case "param": {
          const type = newType(part.attributes.get("type") ?? "num");
          const isBack = part.attributes.get("use") === "reference" || part.attributes.get("byVal") === "false";
          program?.parameters.push({ name: own, type, ...(isBack ? { isBack } : {}) });
          break;
        }
        case "local":
          program?.locals.set(own, newType(part.attributes.get("type") ?? "num"));
          break;
        case "data": {
          if (!part.attributes.has("name")) break;
          // The data of a library behind those of the application: its own are met first.
          const isAgain = data.some(other => other.name === own);
          if (isAgain && databases < 2)
            throw new TextError(part, "a name used once", `The datum ${own} is there twice.`);
          values = [];
          if (isAgain) break;
          data.push({
            name: own,
            type: part.attributes.get("type") ?? "",
            size: sizeOf(part),
            values,
            line: part.line,
            column: part.column,
          });
          break;
        }
        case "value":
          values?.push(new Map(part.attributes));
          break;
        default:
          // The sections of older files: what they hold is told by the name of the tag.
          if (seen && program === undefined && name.endsWith("section") && !part.isEmpty) section = name;
          break;
      }
    }
    if (!seen || programs.length === 0)
      throw new TextError({ line: 1, column: 1 }, "<Programs>", "The text holds no program of VAL 3.");
  } catch (cause) {
    if (!(cause instanceof TextError)) throw cause;
    return { kind: "not-understood", faults: [cause.fault] };
  }
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
