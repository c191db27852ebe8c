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

const HIDDEN = /"[^"\r\n]*"|'[^'\r\n]*'|#[^\r\n]*/g;
const VALUE = /^[ \t]*(?:global[ \t]+|local[ \t]+)?([A-Za-z_]\w*)[ \t]*=[ \t]*(?=p?\[)/gm;
const MOTION = /\b(move[jlpc]|servoj|servoc)[ \t]*\(/g;
const KEYS = {
  pose: ["X", "Y", "Z", "RX", "RY", "RZ"],
  joints: ["J1", "J2", "J3", "J4", "J5", "J6"],
} as const;

/** p[…] and […] of URScript: given to a name that a motion goes to, or written into the motion. */
export function urscriptPoints(files: readonly PatchFile[]): TextPoint[] {
  const defined: Defined[] = [];
  const used: Used[] = [];
  for (const [file, { text }] of files.entries()) {
    const plain = masked(text, HIDDEN);
    const lines = new LineIndex(text);
    const span = (start: number, end: number) => ({ file, line: lines.lineAt(start), start, end });
    const value = (name: string, start: number, motion = start): void => {
      const isPose = plain[start] === "p";
      const end = closing(plain, isPose ? start + 1 : start);
      if (end < 0) return;
      const numbers = numbersIn(plain, start, end);
      // Six numbers and nothing else: d2r(90) or a name among them is computed.
      if (numbers.length !== 6 || !/^p?\[[-+\d.eE,\s]*\]$/.test(plain.slice(start, end))) return;
      const kind = isPose ? "pose" : "joints";
      defined.push({
        name,
        kind,
        fields: KEYS[kind].map((key, i) => ({ key, ...numbers[i]! })),
        value: span(start, end),
        motionLine: lines.lineAt(motion),
        taught: false,
      });
    };
    for (const match of plain.matchAll(VALUE)) value(match[1]!, match.index + match[0].length);
    for (const match of plain.matchAll(MOTION)) {
      const open = match.index + match[0].length - 1;
      const end = closing(plain, open);
      if (end < 0) continue;
      for (const part of argumentsIn(plain, open + 1, end - 1).slice(0, match[1] === "movec" ? 2 : 1)) {
        const argument = plain.slice(part.start, part.end);
        // A pose in a frame is still a taught pose: pose_trans(frame, p[…]).
        const inFrame = /^pose_trans\(\s*[A-Za-z_]\w*\s*,\s*(.*)\)$/s.exec(argument)?.[1];
        const target = inFrame ?? argument;
        const start = part.start + (inFrame === undefined ? 0 : argument.lastIndexOf(target));
        if (/^p?\[/.test(target)) value("", start, open);
        const alone = /^[A-Za-z_]\w*$/.exec(target)?.[0];
        const inside = /\(\s*([A-Za-z_]\w*)/.exec(target)?.[1];
        const name = alone ?? inside;
        if (name === undefined) continue;
        const at = start + target.indexOf(name, alone === undefined ? target.indexOf("(") : 0);
        used.push({
          name,
          use: { ...span(at, at + name.length), motionLine: lines.lineAt(open), whole: alone !== undefined },
        });
      }
    }
  }
  return together(files, defined, used);
}
