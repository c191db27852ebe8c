/** Sections of a saved file that the programs are made of; everything else belongs to the controller. */
const READ = /^\s*\.(?:PROGRAM|TRANS|JOINTS|REALS|STRINGS|INTEGER|END)\b/i;
const PROGRAM = /^\s*\.PROGRAM\b/i;
const END = /^\s*\.END\b/i;
const WORD = /^\s*\.[A-Z_]/i;
/** A variable of one call that is called `.end`. */
const END_AS_NAME = /(?<![\w.])\.end\b(?![.\w])/gi;
/** A step of block teaching: `JOINT SPEED9 ACCU1 … #[angles]`. */
const TAUGHT_STEP = /^\s*(?:JOINT|LINEAR)\s+SPEED\d+\b[^#;]*(#\[[^\]]*\])/i;

/**
 * A file as SAVE writes it, with its programs and values alone, line for line: the remarks of its head, entries of one
 * line as `.NETCONF`, and the data of the controller are left blank. What teaching blocks hold becomes the move it is.
 */
export function programsOf(text: string): string {
  const parts = text.split(/(\r\n|\n|\r)/);
  const lines = parts.filter((_, i) => i % 2 === 0);
  const kept = new Array<string>(lines.length).fill("");
  for (let i = 0; i < lines.length; i++) {
    const line = lines[i]!;
    if (!READ.test(line)) {
      if (!WORD.test(line)) {
        // Behind a program nothing but its end belongs to it; text that is no section stays, and is a fault.
        if (!/^\s*\.\*/.test(line)) kept[i] = line;
        continue;
      }
      // A section of its own ends where .END stands before the next section; otherwise it is one line.
      const next = lines.findIndex((each, at) => at > i && WORD.test(each));
      if (next >= 0 && END.test(lines[next]!)) i = next;
      continue;
    }
    const isProgram = PROGRAM.test(line);
    for (; i < lines.length; i++) {
      const inside = lines[i]!;
      if (END.test(inside)) {
        kept[i] = inside;
        break;
      }
      kept[i] = isProgram
        ? inside.replace(TAUGHT_STEP, (_, angles: string) => `TAUGHT ${angles}`).replace(END_AS_NAME, ".end_")
        : inside;
    }
  }
  return parts.map((part, i) => (i % 2 === 0 ? kept[i / 2]! : part)).join("");
}
