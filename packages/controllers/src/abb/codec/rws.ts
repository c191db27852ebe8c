import { latin1Bytes } from "../../http/index.ts";

/** Robot Web Services 1.0, of RobotWare 6: resources over HTTP, told as JSON where `json=1` asks for it. */
export const RWS_PORT = 80;
export const RWS_LOGIN = { user: "Default User", password: "robotics" } as const;
export const RWS_REALM = "validusers@robapi.abb";
export const SESSION_COOKIES = ["-http-session-", "ABBCX"] as const;

export type CtrlState =
  | "init"
  | "motoroff"
  | "motoron"
  | "guardstop"
  | "emergencystop"
  | "emergencystopreset"
  | "sysfail";
export type OpMode = "INIT" | "AUTO_CH" | "MANF_CH" | "MANR" | "MANF" | "AUTO" | "UNDEF";
export const TASK = "T_ROB1";
export const UNIT = "ROB_1";
/** Axes that are not there. */
export const NO_AXIS = 9e9;
export const ROBOT_AXES = ["rax_1", "rax_2", "rax_3", "rax_4", "rax_5", "rax_6"] as const;
export const EXTERNAL_AXES = ["eax_a", "eax_b", "eax_c", "eax_d", "eax_e", "eax_f"] as const;

/** Codes of refusals that are known from records; the sentence beside them says what it was. */
export const RWS_CODE = { refused: -1073445859, exists: -1073445879 } as const;
/** Events of a controller's log. */
export const EVENT = {
  motorsOff: 10010,
  motorsOn: 10011,
  guardStop: 10012,
  emergencyStop: 10013,
  manual: 10015,
  automatic: 10017,
  started: 10150,
  ready: 10123,
  stopped: 10125,
  failed: 10126,
  egm: 50457,
} as const;

/** One state of a resource: `<li class="type" title="title">`, and what stands in it. */
export interface RwsState {
  readonly type: string;
  readonly title: string;
  readonly fields: Readonly<Record<string, string>>;
}
export type RwsAnswer =
  | { readonly kind: "states"; readonly states: readonly RwsState[] }
  | { readonly kind: "error"; readonly code: number; readonly msg: string };

/** Letters beyond ASCII are escaped, so that a letter is a byte. */

const ascii = (json: string): string =>
  json.replace(/[^\x00-\x7F]/g, sign => `\\u${sign.charCodeAt(0).toString(16).padStart(4, "0")}`);

export const statesJson = (states: readonly RwsState[], base: string): Uint8Array =>
  latin1Bytes(
    ascii(
      JSON.stringify({
        _links: { base: { href: base } },
        _embedded: { _state: states.map(({ type, title, fields }) => ({ _type: type, _title: title, ...fields })) },
      }),
    ),
  );
export const errorJson = (code: number, msg: string): Uint8Array =>
  latin1Bytes(ascii(JSON.stringify({ _links: { base: { href: "/" } }, _embedded: { status: { code, msg } } })));

const escaped = (text: string): string =>
  ascii(text).replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;").replace(/"/g, "&quot;");
/** The same for who asks for no JSON. @param link  where the state itself is found. */
export function statesHtml(states: readonly RwsState[], link?: string): Uint8Array {
  const items = states.map(
    ({ type, title, fields }) =>
      `<li class="${escaped(type)}" title="${escaped(title)}">${link === undefined ? "" : `<a href="${escaped(link)}" rel="self"/>`}${Object.entries(
        fields,
      )
        .map(([name, value]) => `<span class="${escaped(name)}">${escaped(value)}</span>`)
        .join("")}</li>`,
  );
  return latin1Bytes(
    `<?xml version="1.0" encoding="UTF-8"?><html xmlns="http://www.w3.org/1999/xhtml"><head><title>rws</title></head><body><div class="state"><ul>${items.join("")}</ul></div></body></html>`,
  );
}

type Table = Readonly<Record<string, unknown>>;
const tableOf = (value: unknown): Table | null =>
  typeof value === "object" && value !== null && !Array.isArray(value) ? (value as Table) : null;
const textOf = (value: unknown): string =>
  typeof value === "string" ? value : typeof value === "number" || typeof value === "boolean" ? String(value) : "";

/** Reads the JSON of an answer; null when it is none of these services. */
export function readRws(text: string): RwsAnswer | null {
  let parsed: unknown;
  try {
    parsed = JSON.parse(text);
  } catch {
    return null;
  }
  const embedded = tableOf(tableOf(parsed)?.["_embedded"]);
  const status = tableOf(embedded?.["status"]);
  const list = embedded?.["_state"];
  if (status) return { kind: "error", code: Number(textOf(status["code"])), msg: textOf(status["msg"]) };
  if (!Array.isArray(list)) return null;
  const states: RwsState[] = [];
  for (const each of list as unknown[]) {
    const table = tableOf(each);
    if (!table) return null;
    const fields: Record<string, string> = {};
    for (const [name, value] of Object.entries(table))
      if (!name.startsWith("_") && typeof value !== "object") fields[name] = textOf(value);
    states.push({ type: textOf(table["_type"]), title: textOf(table["_title"]), fields });
  }
  return { kind: "states", states };
}

/** Joint angles out of a `ms-jointtarget` [deg]; how many there are, or 0 when one is no number. */
export function readJoints(fields: Readonly<Record<string, string>>, out: Float64Array): number {
  let count = 0;
  for (const name of [...ROBOT_AXES, ...EXTERNAL_AXES]) {
    const text = fields[name];
    const value = Number(text);
    if (text === undefined || text.trim() === "" || !Number.isFinite(value)) return 0;
    if (Math.abs(value) >= NO_AXIS / 10) continue;
    if (count < out.length) out[count] = value;
    count++;
  }
  return count;
}

/**
 * Whether what a controller calls its robot, "IRB 120-3/0.6", is that one of the library, "ABB IRB 120-3/0.6". Either
 * may leave out the end.
 */
export function isAbbModel(name: string, said: string): boolean {
  const plain = (text: string): string =>
    text
      .toUpperCase()
      .replace(/^ABB\b/, "")
      .replace(/\s+/g, "");
  const [short, long] = [plain(name), plain(said)].sort((a, b) => a.length - b.length) as [string, string];
  return short !== "" && long.startsWith(short) && !/^[0-9.]/.test(long.slice(short.length));
}
