import { SaxesParser } from "saxes";
import { Refusal } from "./refusal.ts";

/** An element with what is in it. */
export interface Element {
  readonly name: string;
  readonly attributes: Readonly<Record<string, string>>;
  readonly children: readonly Element[];
  /** All text directly inside, one piece after the other; where it stood between the children is not kept. */
  readonly text: string;
  /** Where its opening tag ends, counted from 1. */
  readonly line: number;
  /** The file it was read from, when there is more than one. */
  readonly file?: string;
}

/** An element while it is being made. */
export interface OpenElement extends Element {
  text: string;
  readonly attributes: Record<string, string>;
  readonly children: OpenElement[];
}

const LONGEST_TEXT = 32_000_000;
const MOST_ELEMENTS = 200_000;
const DEEPEST = 64;

/** What a reader of XML will take at most. */
export interface XmlBounds {
  readonly characters: number;
  readonly elements: number;
}
const USUAL: XmlBounds = { characters: LONGEST_TEXT, elements: MOST_ELEMENTS };

/**
 * The root element of an XML text. Only the five named entities of XML and character numbers are replaced: a document
 * that defines its own is refused before one is used, so no text can grow.
 */
export function parseXml(text: string, file?: string, bounds = USUAL): OpenElement {
  if (text.length > bounds.characters)
    throw new Refusal(`The file has ${text.length} characters; at most ${bounds.characters} are read.`);
  const parser = new SaxesParser<{ xmlns: false; position: true }>({ position: true, xmlns: false });
  const open: OpenElement[] = [];
  const origin = file === undefined ? {} : { file };
  let root: OpenElement | undefined;
  let count = 0;
  parser.on("error", error => {
    throw new Refusal(`The file is not XML: ${error.message.replace(/^\d+:\d+: |[.]$/g, "")}.`, parser.line);
  });
  parser.on("doctype", doctype => {
    if (doctype.includes("<!ENTITY"))
      throw new Refusal("The file defines XML entities of its own, which are not read.", parser.line);
  });
  parser.on("opentag", ({ name, attributes }) => {
    if (++count > bounds.elements)
      throw new Refusal(`The file has more than ${bounds.elements} elements.`, parser.line);
    if (open.length >= DEEPEST) throw new Refusal(`Elements are nested more than ${DEEPEST} deep.`, parser.line);
    const element: OpenElement = {
      name,
      attributes: { ...attributes },
      children: [],
      text: "",
      line: parser.line,
      ...origin,
    };
    open.at(-1)?.children.push(element);
    root ??= element;
    open.push(element);
  });
  const keep = (piece: string): void => {
    const top = open.at(-1);
    if (top && (top.text !== "" || piece.trim() !== "")) top.text += piece;
  };
  parser.on("text", keep);
  parser.on("cdata", keep);
  parser.on("closetag", () => {
    open.pop();
  });
  try {
    parser.write(text).close();
  } catch (problem) {
    if (problem instanceof Refusal && problem.file === undefined) problem.file = file;
    throw problem;
  }
  if (!root) throw new Refusal("The file holds no XML element.");
  return root;
}

export const childrenOf = (element: Element, name: string): readonly Element[] =>
  element.children.filter(child => child.name === name);
export const childOf = (element: Element, name: string): Element | undefined =>
  element.children.find(child => child.name === name);

/** The attribute, or a refusal that names the element. */
export function attributeOf(element: Element, name: string, of: string): string {
  const value = element.attributes[name];
  if (value === undefined || value === "") throw new Refusal(`${of} has no ${name}.`, element.line);
  return value;
}

const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$/;
/** Larger than any cell or any inertia in it: beyond, sums of squares are no longer exact to a micrometre. */
const LARGEST = 1e9;

/** `count` numbers separated by spaces. NaN, infinity and anything above 10⁹ are refused. */
export function numbersIn(text: string, count: number, of: string, line: number): number[] {
  const words = text.trim().split(/\s+/, count + 1);
  if (words.length !== count || words[0] === "")
    throw new Refusal(`${of} needs ${count === 1 ? "one number" : `${count} numbers`}, not “${shorten(text)}”.`, line);
  return words.map(word => {
    const value = NUMBER.test(word) ? Number(word) : NaN;
    if (!(Math.abs(value) <= LARGEST))
      throw new Refusal(`${of} holds “${shorten(word)}”, which is not a usable number.`, line);
    return value;
  });
}

export const shorten = (text: string): string => (text.length > 40 ? `${text.slice(0, 40)}…` : text);
