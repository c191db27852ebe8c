import type { LineShapes } from "@twincell/core";

export const LINES: LineShapes = {
  motion: /^\s*(?:Move|Approach|Depart|Draw|DriveA?|RotateH?|ArchMove|GoHome)\b/i,
  opens: /^\s*(?:If\b.*\bThen\s*(?:'.*)?$|For\b|Do\b|While\b|Select\b)/i,
  parts: /^\s*(?:Else|ElseIf|Case)\b/i,
  closes: /^\s*(?:End\s*If|Next|Loop|Wend|End\s+Select)\b/i,
  callInLine: {
    call: name => new RegExp(String.raw`(?<=\b(?:Then|Else)\s+)(?:Call\s+)?${name}\b(?:\s*\([^)]*\))?`, "i"),
    instead: "Delay 0",
  },
  keeps: /^\s*(?:#|Sub\b|End\s+Sub\b)/i,
};
