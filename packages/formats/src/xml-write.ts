import type { Element } from "./xml.ts";

/** What is enough of an element to write it. */
export type Written = Pick<Element, "name" | "attributes"> & {
  readonly children?: readonly Written[];
  readonly text?: string;
};

/** An XML document, two spaces per level. */
export function writeXml(root: Written): string {
  const lines: string[] = ['<?xml version="1.0" encoding="UTF-8"?>'];
  writeElement(root, "", lines);
  return `${lines.join("\n")}\n`;
}

function writeElement({ name, attributes, children = [], text = "" }: Written, indent: string, lines: string[]): void {
  const opening = `${indent}<${name}${Object.entries(attributes)
    .map(([key, value]) => ` ${key}="${escaped(value)}"`)
    .join("")}`;
  const inside = text.trim();
  if (children.length === 0) {
    lines.push(inside === "" ? `${opening}/>` : `${opening}>${escaped(inside)}</${name}>`);
    return;
  }
  lines.push(`${opening}>`);
  if (inside !== "") lines.push(`${indent}  ${escaped(inside)}`);
  for (const child of children) writeElement(child, `${indent}  `, lines);
  lines.push(`${indent}</${name}>`);
}

/** Line ends and tabs would be read as spaces in an attribute. */
const escaped = (text: string): string => text.replace(/[&<>"\t\r\n]/g, letter => `&#${letter.charCodeAt(0)};`);
