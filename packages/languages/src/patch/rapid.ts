import {
  LineIndex,
  argumentsIn,
  closing,
  masked,
  numbersIn,
  together,
  type Defined,
  type PatchFile,
  type TextPoint,
  type Used,
} from "./points.ts";

const HIDDEN = /"(?:[^"\r\n]|"")*"|![^\r\n]*/g;
const VALUE = /\b(?:CONST|PERS|VAR)[ \t]+(robtarget|jointtarget)[ \t]+([A-Z]\w*)\s*:=\s*(?=\[)/gi;
const MOTION = /^[ \t]*(Move(?:AbsJ|[JLC])(?:DO|AO|GO|Sync)?)\b([^;]*);/gim;
const KEYS = {
  pose: ["X", "Y", "Z", "Q1", "Q2", "Q3", "Q4", "CF1", "CF4", "CF6", "CFX"],
  joints: ["J1", "J2", "J3", "J4", "J5", "J6"],
} as const;
/** Numbers of a whole robtarget and of a whole jointtarget, external axes included. */
const COUNT = { pose: 17, joints: 12 } as const;

/** robtargets and jointtargets of RAPID: declared, or written into a motion. Arrays of them are not points yet. */
export function rapidPoints(files: readonly PatchFile[]): TextPoint[] {
  const defined: Defined[] = [];
  const used: Used[] = [];
  for (const [file, { text }] of files.entries()) {
    const plain = masked(text, HIDDEN);
    const lines = new LineIndex(text);
    const span = (start: number, end: number) => ({ file, line: lines.lineAt(start), start, end });
    const value = (name: string, kind: TextPoint["kind"], start: number, motion = start): void => {
      const end = closing(plain, start);
      if (end < 0) return;
      const numbers = numbersIn(plain, start, end);
      if (
        numbers.length !== COUNT[kind] ||
        /[A-Z]{2}|[A-DF-Z]/i.test(plain.slice(start, end).replace(/9E\+?0*9/gi, ""))
      )
        return;
      const fields = KEYS[kind].map((key, i) => ({ key, ...numbers[i]! }));
      defined.push({
        name,
        kind,
        fields,
        value: span(start, end),
        taught: name !== "",
        motionLine: lines.lineAt(motion),
      });
    };
    for (const match of plain.matchAll(VALUE))
      value(match[2]!, match[1]!.toLowerCase() === "robtarget" ? "pose" : "joints", match.index + match[0].length);
    for (const match of plain.matchAll(MOTION)) {
      const joints = /^MoveAbsJ/i.test(match[1]!);
      const from = match.index + match[0].indexOf(match[1]!) + match[1]!.length;
      const targets = argumentsIn(plain, from, match.index + match[0].length - 1).filter(
        part => plain[part.start] !== "\\" && part.end > part.start,
      );
      for (const part of targets.slice(0, /^MoveC/i.test(match[1]!) ? 2 : 1)) {
        const argument = plain.slice(part.start, part.end);
        if (argument.startsWith("[")) value("", joints ? "joints" : "pose", part.start, from);
        // The name itself, with its own arguments behind a backslash, or the first name of what computes the target.
        const alone = /^([A-Z]\w*)\s*(?:\\.*)?$/i.exec(argument)?.[1];
        const inside = /\(\s*([A-Z]\w*)/i.exec(argument)?.[1];
        const name = alone ?? inside;
        if (name === undefined) continue;
        const start = part.start + argument.indexOf(name, alone === undefined ? argument.indexOf("(") : 0);
        used.push({
          name,
          use: { ...span(start, start + name.length), motionLine: lines.lineAt(from), whole: alone !== undefined },
        });
      }
    }
  }
  return together(files, defined, used);
}
