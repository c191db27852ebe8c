import { readXml, xmlText, type XmlElement } from "./xml.ts";

/**
 * RobotSensorInterface: the robot sends a telegram every 4 or 12 ms over UDP and the sensor answers each within the
 * cycle:
 *
 *     <Rob Type="KUKA"><AIPos A1="…" …/>…<IPOC>n</IPOC></Rob>     robot → sensor
 *     <Sen Type="ImFree"><AKorr A1="…" …/>…<IPOC>n</IPOC></Sen>   sensor → robot, IPOC as it came
 *
 * IPOC is the robot's clock [ms]. Which elements there are is said by a file that both sides have, seen from the robot:
 * SEND and RECEIVE. Positions are mm and degrees.
 */
export interface RsiElement {
  readonly tag: string;
  readonly type: "BOOL" | "STRING" | "LONG" | "DOUBLE";
  readonly index: number | "INTERNAL" /** A late packet leaves the last value in force (1), or none (0). */;
  readonly holdOn: 0 | 1;
}
export interface RsiConfig {
  /** Where the sensor listens. */
  readonly ip: string;
  readonly port: number;
  /** What the sensor calls itself. */
  readonly senType: string;
  /** The robot only sends. */
  readonly onlySend: boolean;
  readonly send: readonly RsiElement[];
  readonly receive: readonly RsiElement[];
}
export type RsiConfigRead =
  | { readonly kind: "read"; readonly config: RsiConfig }
  | { readonly kind: "not-understood"; readonly sentence: string };
export type RsiValue = number | string | boolean;
export type RsiTelegram = {
  readonly kind: "telegram";
  readonly type: string;
  readonly ipoc: number /** By "AKorr.A1", or the name of an element with text. */;
  readonly values: ReadonlyMap<string, string>;
};
export type RsiRead = RsiTelegram | { readonly kind: "not-understood"; readonly sentence: string };

const numbered = (letter: string, count: number): string[] =>
  Array.from({ length: count }, (_, i) => `${letter}${i + 1}`);
const FRAME = ["X", "Y", "Z", "A", "B", "C"];
const AXES = numbered("A", 6);
const OUTER = numbered("E", 6);
/** What stands behind the robot's own keywords. */
const KEYWORDS: Readonly<Record<string, readonly string[]>> = {
  RIst: FRAME,
  RSol: FRAME,
  AIPos: AXES,
  ASPos: AXES,
  MACur: AXES,
  EIPos: OUTER,
  ESPos: OUTER,
  MECur: OUTER,
  Delay: ["D"],
  ...Object.fromEntries(
    numbered("Tech.C", 6)
      .concat(numbered("Tech.T", 6))
      .map(tag => [tag, numbered(tag.slice(5), 10)]),
  ),
};
const CHANNELS = 64;
const DEFINED = "DEF_";

/** The names of the values of a list, "AIPos.A1", in its order. */
export function rsiKeys(
  elements: readonly RsiElement[],
): { readonly key: string; readonly type: RsiElement["type"]; readonly holdOn: 0 | 1 }[] {
  return elements.flatMap(({ tag, type, holdOn }) => {
    const name = tag.startsWith(DEFINED) ? tag.slice(DEFINED.length) : tag;
    const parts = tag.startsWith(DEFINED) ? KEYWORDS[name] : undefined;
    const element = name.split(".")[0]!;
    return parts === undefined
      ? [{ key: name, type, holdOn }]
      : parts.map(part => ({ key: `${element}.${part}`, type: part === "D" ? ("LONG" as const) : type, holdOn }));
  });
}

/** Telegrams of one layout. Elements that share the name in front of the point are one element with attributes. */
export function rsiWriter(
  root: "Rob" | "Sen",
  type: string,
  elements: readonly RsiElement[],
  decimals = 6,
): (values: ReadonlyMap<string, RsiValue>, ipoc: number) => string {
  const groups = new Map<
    string,
    { readonly part: string; readonly key: string; readonly type: RsiElement["type"] }[]
  >();
  for (const { key, type: kind } of rsiKeys(elements)) {
    const [name, part = ""] = key.split(".");
    groups.set(name!, [...(groups.get(name!) ?? []), { part, key, type: kind }]);
  }
  const layout = [...groups];
  const head = `<${root} Type="${xmlText(type)}">`;
  const text = (value: RsiValue | undefined, kind: RsiElement["type"]): string => {
    if (kind === "STRING") return xmlText(String(value ?? ""));
    const number = Number(value ?? 0);
    return kind === "DOUBLE"
      ? number.toFixed(decimals)
      : String(kind === "BOOL" ? Number(number !== 0) : Math.round(number));
  };
  return (values, ipoc) => {
    let out = head;
    for (const [name, parts] of layout) {
      const [first] = parts;
      if (first!.part === "") {
        out += `<${name}>${text(values.get(first!.key), first!.type)}</${name}>`;
        continue;
      }
      out += `<${name}`;
      for (const { part, key, type: kind } of parts) out += ` ${part}="${text(values.get(key), kind)}"`;
      out += "/>";
    }
    return `${out}<IPOC>${ipoc}</IPOC></${root}>`;
  };
}

/** Any bytes: a telegram of that root, or why it is none. */
export function readRsi(text: string, root: "Rob" | "Sen"): RsiRead {
  const read = readXml(text);
  const fail = (sentence: string): RsiRead => ({ kind: "not-understood", sentence });
  if (read.kind === "not-understood") return fail(`At character ${read.at + 1} ${read.expected} was expected.`);
  const { root: is } = read;
  const values = new Map<string, string>();
  if (is.name !== root) return fail(`The telegram is a ${is.name}, not a ${root}.`);
  for (const element of is.children) {
    if (element.children.length > 0) return fail(`${element.name} holds further elements.`);
    if (element.attributes.size === 0) values.set(element.name, element.text);
    for (const [name, value] of element.attributes) values.set(`${element.name}.${name}`, value);
  }
  const ipoc = values.get("IPOC") ?? "";
  return /^[0-9]{1,15}$/.test(ipoc)
    ? { kind: "telegram", type: is.attributes.get("Type") ?? "", ipoc: Number(ipoc), values }
    : fail("The telegram has no IPOC.");
}
/** A number of a telegram; NaN when it is not there or is none. */
export function rsiNumber(values: ReadonlyMap<string, string>, key: string): number {
  const text = values.get(key);
  return text === undefined || !/^[+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?$/.test(text.trim()) ? NaN : Number(text);
}
/** Six of them into `out`; false when one is missing. */
export function rsiAxes(values: ReadonlyMap<string, string>, element: string, out: Float64Array): boolean {
  for (let i = 0; i < 6; i++) out[i] = rsiNumber(values, `${element}.A${i + 1}`);
  return out.every(value => Number.isFinite(value));
}

const child = (of: XmlElement | undefined, name: string): XmlElement | undefined =>
  of?.children.find(each => each.name === name);

/** The file that says what is sent and received. */
export function readRsiConfig(text: string): RsiConfigRead {
  const read = readXml(text);
  const fail = (sentence: string): RsiConfigRead => ({ kind: "not-understood", sentence });
  if (read.kind === "not-understood") return fail(`At character ${read.at + 1} ${read.expected} was expected.`);
  const config = child(read.root, "CONFIG");
  const value = (name: string): string => child(config, name)?.text ?? "";
  const port = Number(value("PORT"));
  if (read.root.name !== "ROOT" || config === undefined) return fail("The file has no ROOT with a CONFIG.");
  if (!Number.isInteger(port) || port < 1 || port > 65_535) return fail(`PORT is 1 to 65535, not “${value("PORT")}”.`);
  for (const name of ["IP_NUMBER", "SENTYPE"]) if (value(name) === "") return fail(`CONFIG has no ${name}.`);
  if (!["TRUE", "FALSE"].includes(value("ONLYSEND").toUpperCase())) return fail("ONLYSEND is TRUE or FALSE.");
  const lists: RsiElement[][] = [];
  for (const side of ["SEND", "RECEIVE"]) {
    const list: RsiElement[] = [];
    for (const { attributes } of child(child(read.root, side), "ELEMENTS")?.children ?? []) {
      const tag = attributes.get("TAG") ?? "";
      const type = attributes.get("TYPE") ?? "";
      const said = attributes.get("INDX") ?? "";
      const index = said === "INTERNAL" ? said : Number(said);
      if (!/^[A-Za-z_][A-Za-z0-9_]*(\.[A-Za-z0-9_]+)?$/.test(tag)) return fail(`${side}: “${tag}” is no tag.`);
      if (type !== "BOOL" && type !== "STRING" && type !== "LONG" && type !== "DOUBLE")
        return fail(`${side}: ${tag} has the type “${type}”.`);
      if (index !== "INTERNAL" && !(Number.isInteger(index) && index >= 1 && index <= CHANNELS))
        return fail(`${side}: INDX of ${tag} is INTERNAL or 1 to ${CHANNELS}, not “${said}”.`);
      list.push({ tag, type, index, holdOn: attributes.get("HOLDON") === "1" ? 1 : 0 });
    }
    lists.push(list);
  }
  return {
    kind: "read",
    config: {
      ip: value("IP_NUMBER"),
      port,
      senType: value("SENTYPE"),
      onlySend: value("ONLYSEND").toUpperCase() === "TRUE",
      send: lists[0]!,
      receive: lists[1]!,
    },
  };
}

export function rsiConfigText({ ip, port, senType, onlySend, send, receive }: RsiConfig): string {
  const list = (elements: readonly RsiElement[], hold: boolean): string[] =>
    elements.map(
      ({ tag, type, index, holdOn }) =>
        `      <ELEMENT TAG="${tag}" TYPE="${type}" INDX="${index}"${hold && index !== "INTERNAL" ? ` HOLDON="${holdOn}"` : ""} />`,
    );
  return [
    "<ROOT>",
    "  <CONFIG>",
    `    <IP_NUMBER>${xmlText(ip)}</IP_NUMBER>`,
    `    <PORT>${port}</PORT>`,
    `    <SENTYPE>${xmlText(senType)}</SENTYPE>`,
    `    <ONLYSEND>${onlySend ? "TRUE" : "FALSE"}</ONLYSEND>`,
    "  </CONFIG>",
    "  <SEND>",
    "    <ELEMENTS>",
    ...list(send, false),
    "    </ELEMENTS>",
    "  </SEND>",
    "  <RECEIVE>",
    "    <ELEMENTS>",
    ...list(receive, true),
    "    </ELEMENTS>",
    "  </RECEIVE>",
    "</ROOT>",
    "",
  ].join("\n");
}

/**
 * What our driver wants of a robot: actual and set axes and the count of late packets out, corrections of the axes in.
 */
export const axisConfig = (ip: string, port: number): RsiConfig => ({
  ip,
  port,
  senType: "Twincell",
  onlySend: false,
  send: ["DEF_RIst", "DEF_AIPos", "DEF_ASPos", "DEF_Delay"].map(tag => ({
    tag,
    type: tag === "DEF_Delay" ? "LONG" : "DOUBLE",
    index: "INTERNAL",
    holdOn: 0,
  })),
  receive: AXES.map((axis, i) => ({ tag: `AKorr.${axis}`, type: "DOUBLE", index: i + 1, holdOn: 0 })),
});
