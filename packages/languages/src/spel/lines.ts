import type { LineShapes } from "@twincell/core";

export const LINES: LineShapes = {
  motion: /^\s*(?:Go|Move|TGo|TMove|BGo|BMove|Jump\w*|Arc3?|CVMove|Pass|Home|Pulse)\b/i,
  opens: /^\s*(?:If\b.*\bThen\s*(?:'.*)?$|For\b|Do\b|While\b|Select\b)/i,
  parts: /^\s*(?:Else|ElseIf|Case|Default)\b/i,
  closes: /^\s*(?:EndIf|Next|Loop|Wend|Send)\b/i,
  callInLine: {
    call: name => new RegExp(String.raw`(?<=\b(?:Then|Else)\s+)(?:Call\s+)?${name}\b(?:\s*\([^)]*\))?`, "i"),
    instead: "Wait 0",
  },
  keeps: /^\s*(?:#|Function\b|Fend\b)/i,
};
