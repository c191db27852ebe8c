import { asciiText } from "../../parser/index.ts";

/** Characters of a name. */
export const LENGTH = 24;
/** Words of the language, and names that a controller has already. */
const RESERVED = new Set([
  "AND",
  "ANIN",
  "ANOUT",
  "AXIS",
  "BAS",
  "BASE_DATA",
  "BOOL",
  "BRAKE",
  "B_AND",
  "B_EXOR",
  "B_NOT",
  "B_OR",
  "CASE",
  "CAST_FROM",
  "CAST_TO",
  "CCLOSE",
  "CHANNEL",
  "CHAR",
  "CIRC",
  "CIRC_REL",
  "CONFIRM",
  "CONST",
  "CONTINUE",
  "COPEN",
  "CREAD",
  "CWRITE",
  "C_DIS",
  "C_ORI",
  "C_PTP",
  "C_SPL",
  "C_VEL",
  "DECL",
  "DEF",
  "DEFAULT",
  "DEFDAT",
  "DEFFCT",
  "DELAY",
  "DIGIN",
  "DISTANCE",
  "DO",
  "E6AXIS",
  "E6POS",
  "ELSE",
  "END",
  "ENDDAT",
  "ENDFCT",
  "ENDFOR",
  "ENDIF",
  "ENDLOOP",
  "ENDSPLINE",
  "ENDSWITCH",
  "ENDWHILE",
  "ENUM",
  "EXIT",
  "EXOR",
  "EXT",
  "EXTFCT",
  "FALSE",
  "FOR",
  "FRAME",
  "GLOBAL",
  "GOTO",
  "HALT",
  "HOME",
  "IF",
  "IMPORT",
  "INT",
  "INTERRUPT",
  "INV_POS",
  "IR_STOPM",
  "IS",
  "LIN",
  "LIN_REL",
  "LOOP",
  "MAXIMUM",
  "MINIMUM",
  "MSGNOTIFY",
  "NOT",
  "OFF",
  "ON",
  "OR",
  "POS",
  "PRIO",
  "PTP",
  "PTP_REL",
  "PUBLIC",
  "PULSE",
  "REAL",
  "REPEAT",
  "RESUME",
  "RETURN",
  "SCIRC",
  "SEC",
  "SIGNAL",
  "SLIN",
  "SPL",
  "SPLINE",
  "SPTP",
  "STEP",
  "STRUC",
  "SWITCH",
  "THEN",
  "TO",
  "TOOL_DATA",
  "TRIGGER",
  "TRUE",
  "UNTIL",
  "WAIT",
  "WHEN",
  "WHILE",
  "WITH",
  "XHOME",
]);

/**
 * A name of KRL: letters, digits and `_`, no digit first, upper case, at most 24 characters, not in `taken`, which
 * receives it.
 */
export function krlName(name: string, taken: Set<string>, prefix = ""): string {
  const plain = asciiText(name)
    .toUpperCase()
    .replace(/[^A-Z0-9_]+/g, "_")
    .replace(/^_+|_+$/g, "");
  const full = `${prefix}${plain}`;
  const stem = (/^[A-Z]/.test(full) ? full : `N_${full}`).slice(0, LENGTH).replace(/_+$/, "");
  for (let i = 1; ; i++) {
    const tail = i === 1 ? "" : `_${i}`;
    const tried = stem.slice(0, LENGTH - tail.length) + tail;
    if (taken.has(tried) || RESERVED.has(tried)) continue;
    taken.add(tried);
    return tried;
  }
}

/**
 * What a person called something, as it can stand in a comment. Marks that the reader of comments keeps for itself are
 * dropped.
 */
export const commentText = (name: string): string =>
  asciiText(name)
    .replace(/^[*;%\s]+/, "")
    .replace(/^(?:END)?FOLD\b/i, "Fold:")
    .slice(0, 200)
    .trim();
