import { Refusal } from "../refusal.ts";
import { shorten, type Element } from "../xml.ts";
import { DEEPEST_NESTING } from "./budget.ts";
import { Names, type Value } from "./expression/values.ts";
import { literalOf } from "./expression/values.ts";

/** A macro as it was written. */
export interface Macro {
  readonly name: string;
  readonly body: Element;
  readonly parameters: readonly Parameter[];
}
/** `a`, `a:=default`, `a:=^` (from around the call), `a:=^|default`, `*block`, `**block`. */
export interface Parameter {
  readonly name: string;
  readonly fallback?: string;
  readonly forwarded: boolean;
}

interface Entry {
  value: Value;
  pending?: string;
  beingRead?: boolean;
}

/**
 * Properties, blocks and macros of one place: a file, a macro call, an included name space. What is not here is looked
 * for outside.
 */
export class Scope {
  readonly outer: Scope | undefined;
  readonly isNameSpace: boolean;
  private readonly values = new Map<string, Entry>();
  private readonly blocks = new Map<string, Element>();
  private readonly macros = new Map<string, Macro>();
  private readonly spaces = new Map<string, Scope>();
  private readonly textIn: (text: string, scope: Scope) => Value;
  private readonly depth: number;

  /** @param textIn  works out a text with expressions in it. */
  constructor(textIn: (text: string, scope: Scope) => Value, outer?: Scope, isNameSpace = false) {
    this.textIn = textIn;
    this.outer = outer;
    this.isNameSpace = isNameSpace;
    this.depth = (outer?.depth ?? 0) + 1;
    if (this.depth > DEEPEST_NESTING) throw new Refusal(`Macros call each other more than ${DEEPEST_NESTING} deep.`);
  }

  /** @param isPending  a text is worked out when it is first asked for, with what the names stand for by then. */
  set(name: string, given: Value, isPending: boolean): void {
    const value = typeof given === "string" ? literalOf(given) : given;
    this.values.set(name, isPending && typeof value === "string" ? { value: null, pending: value } : { value });
  }
  setBlock(name: string, block: Element): void {
    this.blocks.set(name, block);
  }
  setMacro(macro: Macro): void {
    this.macros.set(macro.name, macro);
  }
  setSpace(name: string, space: Scope): void {
    this.spaces.set(name, space);
    this.values.set(name, { value: new Names(name, inner => space.get(inner)) });
  }
  remove(name: string): void {
    this.values.delete(name);
    this.outer?.remove(name);
  }

  has(name: string): boolean {
    return this.values.has(name) || (this.outer?.has(name) ?? false);
  }
  get(name: string): Value | undefined {
    const entry = this.values.get(name);
    if (!entry) return this.outer?.get(name);
    if (entry.pending === undefined) return entry.value;
    if (entry.beingRead) throw new Refusal(`The property ${shorten(name)} rests on itself.`);
    entry.beingRead = true;
    const value = this.textIn(entry.pending, this);
    entry.beingRead = false;
    delete entry.pending;
    return (entry.value = typeof value === "string" ? literalOf(value) : value);
  }
  /** `name` or `*name`, from here outwards. */
  block(name: string): Element | undefined {
    return this.blocks.get(name) ?? this.outer?.block(name);
  }

  /** The macro of a name, dots leading into name spaces, and the scope its names are looked up in. */
  macro(name: string): { readonly macro: Macro; readonly scope: Scope } | undefined {
    const plain = this.macroHere(name);
    if (plain) return { macro: plain, scope: this };
    const dot = name.indexOf(".");
    return dot < 0 ? undefined : this.space(name.slice(0, dot))?.macro(name.slice(dot + 1));
  }
  private macroHere(name: string): Macro | undefined {
    return this.macros.get(name) ?? (this.isNameSpace ? undefined : this.outer?.macroHere(name));
  }
  private space(name: string): Scope | undefined {
    return this.spaces.get(name) ?? this.outer?.space(name);
  }

  /** The outermost scope of the file. */
  top(): Scope {
    return this.outer?.top() ?? this;
  }
  /** Where a macro was called from. */
  caller(): Scope | undefined {
    let scope = this.outer;
    while (!this.isNameSpace && scope?.isNameSpace) scope = scope.outer;
    return scope;
  }
}

const PARAMETER = /^\s*([^\s:=]+?)\s*:?=\s*(\^\|?)?(\$\{.*?\}|\$\(.*?\)|(?:'.*?'|".*?"|[^\s'"]+)+|)(?:\s+|$)/;

/** Takes the `params` of a macro apart. */
export function parametersOf(text: string): Parameter[] {
  const parameters: Parameter[] = [];
  let rest = text.trim();
  while (rest !== "") {
    const match = PARAMETER.exec(rest);
    const name = match?.[1] ?? rest.split(/\s/, 1)[0]!;
    parameters.push(
      match
        ? {
            name,
            forwarded: match[2] !== undefined,
            ...(match[3] === "" || match[3] === undefined ? {} : { fallback: match[3] }),
          }
        : { name, forwarded: false },
    );
    if (parameters.length > 500) throw new Refusal("A macro has more than 500 parameters.");
    rest = rest.slice(match ? match[0].length : name.length).trimStart();
  }
  return parameters;
}
