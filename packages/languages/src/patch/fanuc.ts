import {
  LineIndex,
  NUMBER,
  masked,
  together,
  type Defined,
  type PatchFile,
  type PointField,
  type TextPoint,
  type Used,
} from "./points.ts";

const RECORD = /^P\[(\d+)(?:[ \t]*:[ \t]*"([^"\r\n]*)")?\][ \t]*\{([^}]*)\}/gm;
const FIELD = new RegExp(
  String.raw`\b(X|Y|Z|W|P|R|J[1-6])[ \t]*=[ \t]?([ \t]*${NUMBER})(?=[ \t]*(?:mm|deg))|\bCONFIG[ \t]*:[ \t]*'([^'\r\n]*)'`,
  "g",
);
/** A motion, or the second line of an arc: the number may be left out there. */
const MOTION = /^[ \t]*\d*[ \t]*:[ \t]*(?:[JLCAS][ \t]+)?P\[(\d+)[^\]\r\n]*\]([^\r\n]*)/gm;

/** The records of /POS in a FANUC listing. Points of a second group, and registers PR[n], are the controller's. */
export function fanucPoints(files: readonly PatchFile[]): TextPoint[] {
  const defined: Defined[] = [];
  const used: Used[] = [];
  for (const [file, { text }] of files.entries()) {
    const head = text.search(/^\/POS\b/m);
    const lines = new LineIndex(text);
    const span = (start: number, end: number) => ({ file, line: lines.lineAt(start), start, end });
    const program = masked(head < 0 ? text : text.slice(0, head), /![^\r\n]*/g);
    let motionLine = 1;
    for (const match of program.matchAll(MOTION)) {
      const start = match.index + match[0].indexOf("P[");
      // An arc goes on in a line without a number.
      if (/^[ \t]*\d/.test(match[0])) motionLine = lines.lineAt(start);
      used.push({
        name: `P[${match[1]!}]`,
        use: {
          ...span(start, program.indexOf("]", start) + 1),
          motionLine,
          whole: !/\b(Offset|Tool_Offset|INC)\b/.test(match[2]!),
        },
      });
    }
    if (head < 0) continue;
    for (const match of text.slice(head).matchAll(RECORD)) {
      const start = head + match.index;
      const body = start + match[0].lastIndexOf("{", match[0].length - match[3]!.length - 1);
      const second = text.indexOf("GP2", body);
      const end = start + match[0].length;
      const fields = fieldsOf(text, body, second > 0 && second < end ? second : end);
      const isJoints = fields.some(({ key }) => key === "J1");
      if (!isJoints && !fields.some(({ key }) => key === "X")) continue;
      defined.push({
        name: `P[${match[1]!}]`,
        kind: isJoints ? "joints" : "pose",
        fields,
        value: span(start, end),
        taught: true,
      });
    }
  }
  return together(files, defined, used);
}

/** A number's field begins after one blank behind the sign: the listing sets numbers flush right. */
function fieldsOf(text: string, start: number, end: number): PointField[] {
  const fields: PointField[] = [];
  const pattern = new RegExp(FIELD);
  pattern.lastIndex = start;
  for (let match = pattern.exec(text); match !== null && match.index < end; match = pattern.exec(text)) {
    const to = match.index + match[0].length;
    if (match[1] !== undefined) fields.push({ key: match[1], start: to - match[2]!.length, end: to });
    else fields.push({ key: "CONFIG", start: to - 1 - match[3]!.length, end: to - 1 });
  }
  return fields;
}
