import { folderOf, joinPath, type FileSource } from "../files/source.ts";
import { resolveFile } from "../files/resolve.ts";
import { locating, Refusal } from "../refusal.ts";
import { utf8 } from "../utf8.ts";
import { attributeOf, childrenOf, parseXml, shorten, type Element, type OpenElement } from "../xml.ts";
import { Budget, DEEPEST_NESTING } from "./budget.ts";
import type { Lookup } from "./expression/evaluate.ts";
import { textOf, truthOf, type Value } from "./expression/values.ts";
import { builtIns } from "./built-ins.ts";
import { parametersOf, Scope, type Macro } from "./scope.ts";
import { substitute } from "./substitution.ts";
import { Texts } from "./text.ts";
import { propertyInto } from "./property.ts";

/** What an element costs, made or not, beside its characters: macros that double and make nothing end as well. */
const STEP = 20;

/**
 * Expands one xacro: a walk over the elements that writes a new tree, so that what was read stays as it is and a block
 * or a macro can be used again.
 */
export class Expansion {
  readonly files: FileSource;
  readonly warnings = new Set<string>();
  /** Every file that was drawn in, in the order of reading. */
  readonly read: string[] = [];
  private readonly given: Map<string, string>;
  private readonly budget = new Budget();
  private readonly texts = new Texts(this.budget);
  private readonly names: ReadonlyMap<string, Value>;
  private readonly stack: string[] = [];
  private nesting = 0;

  constructor(files: FileSource, args: Readonly<Record<string, string>>) {
    this.files = files;
    this.given = new Map(Object.entries(args));
    this.names = builtIns({
      budget: this.budget,
      warnings: this.warnings,
      bytes: reference => this.open(reference).bytes,
      argument: name => this.given.get(name),
      expression: text => this.texts.expression(text, name => this.names.get(name)),
    });
  }

  /** The whole file at a path, expanded. */
  whole(path: string): Element {
    const root = this.parse(path);
    const scope = new Scope(this.value);
    this.stack.push(path);
    const out = this.copyOf(root, scope);
    this.children(root, out, scope);
    this.stack.pop();
    for (const name of this.given.keys())
      if (!this.declared.has(name))
        this.warnings.add(`The argument ${shorten(name)} was given, but the file has no such argument.`);
    return out;
  }
  private readonly declared = new Set<string>();

  /** The value of a text in a scope. */
  readonly value = (text: string, scope: Scope): Value => {
    const lookup: Lookup = name => scope.get(name) ?? this.names.get(name);
    return this.texts.valueOf(text, lookup, inside =>
      substitute(inside, {
        files: this.files,
        file: () => this.stack.at(-1) ?? "",
        argument: name => this.given.get(name),
        expression: expression => this.texts.expression(expression, name => lookup(name) ?? this.given.get(name)),
      }),
    );
  };
  private text(text: string, scope: Scope, at: Element): string {
    return locating(at, () => textOf(this.value(text, scope)));
  }

  private parse(path: string): OpenElement {
    const bytes = this.files.read(path);
    if (!bytes) throw new Refusal(`There is no file ${path}.`);
    this.read.push(path);
    return parseXml(utf8(bytes), path);
  }
  /** A file that a file names; beside it, in a package, or moved with it. */
  private open(reference: string): { readonly path: string; readonly bytes: Uint8Array } {
    const found = resolveFile(reference, this.stack.at(-1) ?? "", this.files);
    if (found.kind === "missing") throw new Refusal(found.sentence);
    if (found.note !== undefined) this.warnings.add(found.note);
    return { path: found.path, bytes: this.files.read(found.path) ?? new Uint8Array() };
  }

  /** An element of the result with its attributes worked out and nothing inside yet. */
  private copyOf(element: Element, scope: Scope): OpenElement {
    locating(element, () => {
      this.budget.element();
    });
    const attributes: Record<string, string> = {};
    for (const [name, value] of Object.entries(element.attributes)) {
      if (!name.startsWith("xacro:") && name !== "xmlns:xacro") attributes[name] = this.text(value, scope, element);
    }
    const { name, line, file } = element;
    return {
      name,
      attributes,
      children: [],
      text: element.text === "" ? "" : this.text(element.text, scope, element),
      line,
      ...(file === undefined ? {} : { file }),
    };
  }

  private children(from: Element, into: OpenElement, scope: Scope): void {
    if (++this.nesting > 4 * DEEPEST_NESTING)
      throw new Refusal(`Macros and elements are nested more than ${4 * DEEPEST_NESTING} deep.`, from.line, from.file);
    for (const child of from.children)
      locating(child, () => {
        this.one(child, into, scope);
      });
    this.nesting--;
  }

  private one(element: Element, into: OpenElement, scope: Scope): void {
    this.budget.spend(STEP);
    switch (element.name) {
      case "xacro:property":
        propertyInto(scope, element, this.value);
        return;
      case "xacro:macro":
        scope.setMacro(macroOf(element));
        return;
      case "xacro:arg":
        this.argument(element, scope);
        return;
      case "xacro:include":
        this.include(element, into, scope);
        return;
      case "xacro:insert_block":
        this.insertBlock(element, into, scope);
        return;
      case "xacro:if":
      case "xacro:unless": {
        const written = attributeOf(element, "value", "A condition");
        if (truthOf(this.value(written, scope), written) === (element.name === "xacro:if"))
          this.children(element, into, scope);
        return;
      }
      case "xacro:attribute":
        into.attributes[this.text(attributeOf(element, "name", "An xacro:attribute"), scope, element)] = this.text(
          element.attributes["value"] ?? "",
          scope,
          element,
        );
        return;
      case "xacro:element": {
        const name = this.text(attributeOf(element, "xacro:name", "An xacro:element"), scope, element);
        if (!/^[A-Za-z_][\w.:-]*$/.test(name)) throw new Refusal(`“${shorten(name)}” cannot name an element.`);
        this.one({ ...element, name }, into, scope);
        return;
      }
      case "xacro:call": {
        const name = this.text(attributeOf(element, "macro", "An xacro:call"), scope, element);
        const attributes = Object.fromEntries(Object.entries(element.attributes).filter(([key]) => key !== "macro"));
        this.call(name, { ...element, attributes }, into, scope);
        return;
      }
      default:
        if (element.name.startsWith("xacro:")) {
          this.call(element.name.slice(6), element, into, scope);
          return;
        }
        this.plain(element, into, scope);
    }
  }

  private plain(element: Element, into: OpenElement, scope: Scope): void {
    const copy = this.copyOf(element, scope);
    into.children.push(copy);
    this.children(element, copy, scope);
  }

  private argument(element: Element, scope: Scope): void {
    const name = attributeOf(element, "name", "An xacro:arg");
    const fallback = element.attributes["default"];
    this.declared.add(name);
    if (!this.given.has(name) && fallback !== undefined) this.given.set(name, this.text(fallback, scope, element));
  }

  private include(element: Element, into: OpenElement, scope: Scope): void {
    this.budget.include();
    const reference = this.text(attributeOf(element, "filename", "An xacro:include"), scope, element);
    const space = element.attributes["ns"];
    if (this.stack.length >= 32) throw new Refusal("Files include each other more than 32 deep.");
    let inner = scope;
    if (space !== undefined) {
      inner = new Scope(this.value, scope, true);
      scope.setSpace(this.text(space, scope, element), inner);
    }
    for (const name of this.matching(reference)) {
      const found = resolveFile(name, this.stack.at(-1) ?? "", this.files);
      if (found.kind === "missing") {
        if (
          element.attributes["optional"] === "true" ||
          element.attributes["optional"] === "1" ||
          element.attributes["optional"] === "True"
        )
          continue;
        throw new Refusal(found.sentence);
      }
      if (found.note !== undefined) this.warnings.add(found.note);
      const root = this.parse(found.path);
      this.stack.push(found.path);
      for (const [attribute, value] of Object.entries(root.attributes))
        if (attribute.startsWith("xmlns:") && attribute !== "xmlns:xacro") into.attributes[attribute] ??= value;
      this.children(root, into, inner);
      this.stack.pop();
    }
  }
  /** `folder/*.xacro` is every such file, by name. */
  private matching(reference: string): readonly string[] {
    if (!/[*?]/.test(reference) || reference.includes("://")) return [reference];
    const folder = folderOf(reference);
    const pattern = new RegExp(
      `^${reference
        .slice(folder === "" ? 0 : folder.length + 1)
        .replace(/[.+^${}()|[\]\\]/g, "\\$&")
        .replaceAll("*", "[^/]*")
        .replaceAll("?", "[^/]")}$`,
    );
    const place = folder.startsWith("/") ? folder : joinPath(folderOf(this.stack.at(-1) ?? ""), folder);
    const names = (this.files.list(place) ?? []).filter(name => pattern.test(name)).sort();
    if (names.length === 0) this.warnings.add(`No file matches ${shorten(reference)}.`);
    return names.map(name => joinPath(folder, name));
  }

  private insertBlock(element: Element, into: OpenElement, scope: Scope): void {
    const name = attributeOf(element, "name", "An xacro:insert_block");
    const many = scope.block(`**${name}`);
    const single = scope.block(`*${name}`);
    if (many) this.children(many, into, scope);
    else if (single) this.one(single, into, scope);
    else throw new Refusal(`There is no block ${shorten(name)} to insert.`);
  }

  private call(name: string, element: Element, into: OpenElement, scope: Scope): void {
    const found = scope.macro(name);
    if (!found) throw new Refusal(`There is no macro ${shorten(name)}.`);
    const { macro } = found;
    const inner = new Scope(this.value, found.scope);
    const open = new Map(macro.parameters.map(parameter => [parameter.name, parameter]));
    for (const [key, text] of Object.entries(element.attributes)) {
      if (key.startsWith("xmlns:")) continue;
      if (!open.delete(key)) throw new Refusal(`The macro ${shorten(name)} has no parameter ${shorten(key)}.`);
      inner.set(
        key,
        locating(element, () => this.value(text, scope)),
        false,
      );
    }
    this.blocks(name, macro, element, inner, scope);
    for (const { name: key, fallback, forwarded } of open.values()) {
      if (key.startsWith("*")) continue;
      const around = forwarded ? scope.get(key) : undefined;
      if (around === undefined && fallback === undefined)
        throw new Refusal(`The macro ${shorten(name)} is called without its parameter ${shorten(key)}.`);
      inner.set(key, around ?? this.value(fallback ?? "", scope), false);
    }
    this.children(macro.body, into, inner);
  }
  /** The elements inside a call, expanded where it stands, are its blocks in their order. */
  private blocks(name: string, macro: Macro, element: Element, inner: Scope, scope: Scope): void {
    const wanted = macro.parameters.filter(parameter => parameter.name.startsWith("*"));
    const held: OpenElement = { name: element.name, attributes: {}, children: [], text: "", line: element.line };
    this.children(element, held, scope);
    if (held.children.length < wanted.length)
      throw new Refusal(
        `The macro ${shorten(name)} wants ${wanted.length} blocks and is given ${held.children.length}.`,
      );
    if (held.children.length > wanted.length)
      throw new Refusal(`The macro ${shorten(name)} has no use for <${shorten(held.children[wanted.length]!.name)}>.`);
    wanted.forEach((parameter, i) => {
      inner.setBlock(parameter.name, held.children[i]!);
    });
  }
}

function macroOf(element: Element): Macro {
  const name = attributeOf(element, "name", "A macro").replace(/^xacro:/, "");
  if (name === "call" || name.includes(".")) throw new Refusal(`A macro cannot be called ${shorten(name)}.`);
  return { name, body: element, parameters: parametersOf(element.attributes["params"] ?? "") };
}

/** Whether a robot description is a xacro: something in it is still to be expanded. */
export const isXacro = (root: Element): boolean =>
  root.attributes["xmlns:xacro"] !== undefined ||
  root.children.some(child => child.name.startsWith("xacro:")) ||
  childrenOf(root, "xacro:macro").length > 0;
