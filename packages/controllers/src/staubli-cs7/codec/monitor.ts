/**
 * The monitor of V+ (CS7, Adept MV) on a raw line: a command ends with a carriage return and comes back as an echo;
 * what it says follows, and a dot at the beginning of a line says that the next command may come. Errors stand between
 * asterisks.
 */
export const LINE_PORT = 4001;
/** A task of its own, so that the monitor stays free while the robot moves. */
export const TASK = 1;
/** The program that moves, and what it is told: reals, and the precision point #TWC. */
export const PROGRAM = "TWC.MOVE";
export const POINT = "#TWC";
export const TWC = {
  line: "TWC.LINE",
  speed: "TWC.SPEED",
  accel: "TWC.ACCEL",
  id: "TWC.ID",
  done: "TWC.DONE",
} as const;
export const LONGEST = 512;
const CR = 13;
const LF = 10;
const DOT = 46;
const MOST_LINES = 400;

/** STATE(1): what the robot as a whole is doing. */
export const STATE = {
  resetting: 0,
  fatal: 1,
  powerOff: 2,
  poweringOn: 3,
  manual: 4,
  calibrating: 5,
  program: 7,
  notCalibrated: 8,
} as const;

const STATE_NAMES = [
  "resetting",
  "fatal error",
  "power off",
  "power coming on",
  "manual control",
  "calibrating",
  "",
  "program control",
  "not calibrated",
];
export const stateName = (state: number): string => STATE_NAMES[state] ?? "";

export const textBytes = (text: string): Uint8Array =>
  Uint8Array.from(text, sign => {
    const code = sign.charCodeAt(0);
    return code < 128 ? code : 63;
  });
export const commandBytes = (command: string): Uint8Array => textBytes(`${command}\r`);
/** A byte of a text line: letters, signs, and what moves the cursor. */
export const isText = (byte: number): boolean =>
  (byte >= 32 && byte < 127) || byte === CR || byte === LF || byte === 8 || byte === 9 || byte === 7;

/** Cuts what a monitor says into lines and prompts, however it arrives. One per connection. */
export class MonitorReader {
  private line = "";
  private lines: string[] = [];
  /**
   * @param onAnswer  what was said before a prompt, the echo with it. @returns why the stream cannot go on, or null.
   */
  push(lent: Uint8Array, onAnswer: (lines: readonly string[]) => void): string | null {
    for (const byte of lent) {
      if (!isText(byte)) return `A byte ${byte} came, which is none of a terminal's.`;
      if (byte === LF) {
        this.lines.push(this.line);
        this.line = "";
        if (this.lines.length > MOST_LINES) return `More than ${MOST_LINES} lines came without a prompt.`;
      } else if (byte === DOT && this.line === "") {
        const said = this.lines;
        this.lines = [];
        onAnswer(said);
      } else if (byte !== CR) {
        if (this.line.length >= LONGEST) return `A line of more than ${LONGEST} characters came.`;
        this.line += String.fromCharCode(byte);
      }
    }
    return null;
  }
}

const shown = (values: ArrayLike<number>, digits: number): string =>
  Array.from(values, value => value.toFixed(digits).padStart(10)).join("");
/** The answer to WHERE: place of the tool [mm, deg], opening of the hand, joints [deg]; thousandths on a real one. */
export const whereText = (place: ArrayLike<number>, joints_deg: ArrayLike<number>, digits = 3): string =>
  `   X         Y         Z         y         p         r       Hand\r\n${shown(place, digits)}${shown([0], digits)}\r\n${Array.from(joints_deg, (_, i) => `   J${i + 1}     `).join("")}\r\n${shown(joints_deg, digits)}\r\n`;
const numbers = (line: string): number[] => line.trim().split(/\s+/).map(Number);
/** Joints [deg] of an answer to WHERE, as many as the robot has; null when it is none. */
export function readWhere(lines: readonly string[]): number[] | null {
  const head = lines.findIndex(line => /^\s*(J|jt)\s*1\b/i.test(line));
  const values = head < 0 ? [] : numbers(lines[head + 1] ?? "");
  return values.length > 0 && values.every(value => Number.isFinite(value)) ? values : null;
}
/** The answer to LISTR: one value a line. */
export const valuesText = (values: readonly (readonly [name: string, value: number])[]): string =>
  values.map(([name, value]) => `${name} = ${value}\r\n`).join("");
/** Values of an answer to LISTR, in the order they were asked for. */
export const readValues = (lines: readonly string[]): number[] =>
  [
    ...lines
      .slice(1)
      .join("\n")
      .matchAll(/=\s*(-?[0-9]+(?:\.[0-9]*)?(?:E[+-]?[0-9]+)?)/gi),
  ].map(([, value]) => Number(value));
/** What stands between asterisks, with what stands behind it; "" without an error. */
export const errorOf = (lines: readonly string[]): string =>
  /\*[^*]+\*.*$/.exec(lines.find(line => /\*[^*]+\*/.test(line)) ?? "")?.[0]?.trim() ?? "";
/** Digits behind the point that a precision point is written with. */
const POINT_DIGITS = 4;
export const pointText = (joints_deg: ArrayLike<number>): string =>
  `#PPOINT(${Array.from(joints_deg, value => String(Number(value.toFixed(POINT_DIGITS)))).join(",")})`;
/** Joints [deg] of `#PPOINT(…)`; null when it is none. */
export function readPoint(text: string): number[] | null {
  const inside = /^#PPOINT\s*\(([^()]*)\)$/i.exec(text.trim())?.[1];
  const values = inside?.split(",").map(value => (value.trim() === "" ? NaN : Number(value))) ?? [];
  return values.length > 0 && values.every(value => Number.isFinite(value)) ? values : null;
}

/** Robots on these controllers have six joints. */
export const JOINTS = 6;
