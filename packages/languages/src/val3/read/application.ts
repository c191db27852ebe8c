import type { TextFault, TextPlace } from "@twincell/core";
import { TextError, plainText } from "../../parser/index.ts";
import type { Block, Parameter, Routine, Statement } from "../../parser/structured/index.ts";
import { readCode } from "./code.ts";
import { xmlParts } from "./xml.ts";

/** A datum with the attributes of its values, by their keys. */
export interface DataDeclaration extends TextPlace {
  readonly name: string;
  readonly type: string;
  readonly values: readonly ReadonlyMap<string, string>[];
}
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
        continue;
      }
      switch (name) {
        case "programs":
        case "programlist":
        case "database":
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
          program?.parameters.push({ name: own, type: part.attributes.get("type") ?? "num" });
          break;
        case "local":
          program?.locals.set(own, part.attributes.get("type") ?? "num");
          break;
        case "data": {
          if (!part.attributes.has("name")) break;
          if (data.some(other => other.name === own) && data.length < 2000)
            throw new TextError(part, "a name used once", `The datum ${own} is there twice.`);
          values = [];
          data.push({
            name: own,
            type: part.attributes.get("type") ?? "",
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

function titleOf(block: Block): string | undefined {
  const first = block.find(
    (statement): statement is Extract<Statement, { kind: "comment" }> => statement.kind === "comment",
  );
  return first?.text.startsWith("*") === true ? first.text.slice(1).trim() : undefined;
}
