import {
  LineIndex,
  NUMBER,
  argumentsIn,
  masked,
  together,
  type Defined,
  type PatchFile,
  type PointField,
  type TextPoint,
  type Used,
} from "./points.ts";

const HIDDEN = /"[^"\r\n]*"|;[^\r\n]*|^[ \t]*&[^\r\n]*/gm;
const VALUE =
  /^[ \t]*(?:(?:GLOBAL|DECL|CONST)[ \t]+)*(?:(E6POS|E6AXIS|POS|AXIS|FRAME)[ \t]+)?([A-Z_][\w$]*)[ \t]*=[ \t]*(\{[^{}\r\n]*\})/gim;
const MOTION = /^[ \t]*(?:PTP|LIN|CIRC|SPTP|SLIN|SCIRC|SPL)[ \t]+([^\r\n]*)/gim;
const FIELD = new RegExp(String.raw`([A-Z]\w*)[ \t]+(${NUMBER}|'[BH][0-9A-F]+')`, "gi");
const AXES = /^A[1-6]$/;
const POSE = /^[XYZABCST]$/;

/** E6POS, E6AXIS, POS, AXIS and FRAME of KRL: declared in a .dat or .src, assigned, or written into a motion. */
export function krlPoints(files: readonly PatchFile[]): TextPoint[] {
  const defined: Defined[] = [];
  const used: Used[] = [];
  for (const [file, { text }] of files.entries()) {
    const plain = masked(text, HIDDEN);
    const lines = new LineIndex(text);
    const span = (start: number, end: number) => ({ file, line: lines.lineAt(start), start, end });
    const value = (name: string, start: number, end: number, type = ""): void => {
      const { kind, fields } = fieldsOf(plain, start, end);
      if (kind === undefined) return;
      defined.push({ name, kind, fields, value: span(start, end), taught: type !== "" && type !== "FRAME" });
    };
    for (const match of plain.matchAll(VALUE)) {
      const end = match.index + match[0].length;
      value(match[2]!, end - match[3]!.length, end, match[1]?.toUpperCase());
    }
    for (const match of plain.matchAll(MOTION)) {
      const start = match.index + match[0].length - match[1]!.length;
      for (const part of argumentsIn(plain, start, match.index + match[0].length)) {
        const argument = plain.slice(part.start, part.end);
        const literal = /^\{[^{}]*\}/.exec(argument)?.[0];
        if (literal !== undefined && isAlone(argument.slice(literal.length)))
          value("", part.start, part.start + literal.length);
        const name = /^[A-Z_][\w$]*/i.exec(argument)?.[0];
        if (name === undefined || /^(CA|C_\w+)$/i.test(name)) continue;
        used.push({
          name,
          use: {
            ...span(part.start, part.start + name.length),
            motionLine: lines.lineAt(start),
            whole: isAlone(argument.slice(name.length)),
          },
        });
      }
    }
  }
  return together(files, defined, used);
}

/** What may follow a target that nothing is computed from: how it is passed, and settings of a spline. */
const isAlone = (rest: string): boolean => /^(\s+(C_\w+|WITH\b.*))*\s*$/i.test(rest);

function fieldsOf(
  text: string,
  start: number,
  end: number,
): { readonly kind?: TextPoint["kind"]; readonly fields: readonly PointField[] } {
  const fields: PointField[] = [];
  const pattern = new RegExp(FIELD);
  pattern.lastIndex = start;
  for (let match = pattern.exec(text); match !== null && match.index < end; match = pattern.exec(text)) {
    const to = match.index + match[0].length;
    fields.push({ key: match[1]!.toUpperCase(), start: to - match[2]!.length, end: to });
  }
  if (fields.some(({ key }) => AXES.test(key)))
    return { kind: "joints", fields: fields.filter(({ key }) => AXES.test(key)) };
  if (fields.some(({ key }) => key === "X" || key === "Y" || key === "Z"))
    return { kind: "pose", fields: fields.filter(({ key }) => POSE.test(key)) };
  return { fields };
}
