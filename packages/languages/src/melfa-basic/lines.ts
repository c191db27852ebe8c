import type { LineShapes } from "@twincell/core";

export const LINES: LineShapes = {
  motion: /^\s*(?:[0-9]+\s+)?(?:Mov|Mvs|Mvr[23]?|Mvc|Mva|MvSpl)\b/i,
  opens: /^\s*(?:[0-9]+\s+)?(?:If\b.*\bThen\s*(?:'.*)?$|For\b|While\b|Select\b)/i,
  parts: /^\s*(?:[0-9]+\s+)?(?:Else|ElseIf|Case|Default)\b/i,
  closes: /^\s*(?:[0-9]+\s+)?(?:EndIf|Next|WEnd|End\s*Select)\b/i,
  callInLine: {
    call: name => new RegExp(String.raw`(?<=\b(?:Then|Else)\s+)CallP\s*"${name}"(?:\s*,(?:(?!\bElse\b)[^'])*)?`, "i"),
    instead: "Dly 0 ",
  },
  keeps: /^\s*(?:[0-9]+\s+)?(?:\*|Return\b|End\s*(?:'.*)?$)/i,
};
