import type { LineShapes } from "@twincell/core";

export const LINES: LineShapes = {
  motion: /^\s*[0-9]*\s*:\s*[JLCAS]\s+P(?:R)?\[/i,
  opens: /^\s*[0-9]*\s*:\s*(?:IF\b.*\bTHEN|FOR\b)/i,
  parts: /^\s*[0-9]*\s*:\s*ELSE\b/i,
  closes: /^\s*[0-9]*\s*:\s*(?:ENDIF|ENDFOR)\b/i,
  keeps: /^\s*(?:\/|P\[|GP[0-9]|UF\b|\}|[XJ][0-9]?\s*=)/i,
  // Lines are counted: the number stays.
  blank: line => {
    const number = /^\s*[0-9]+\s*:/.exec(line);
    return number === null ? "" : `${number[0]}   ;`;
  },
};
