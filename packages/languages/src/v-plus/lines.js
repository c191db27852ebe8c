export const LINES = {
    motion: /^\s*(?:[0-9]+\s+)?(?:DO\s+)?(?:MOVE[ST]?|MOVEST|MOVE[CF]|APPROS?|DEPARTS?|DRIVE|ALIGN|READY|NEST)\b/i,
    opens: /^\s*(?:[0-9]+\s+)?(?:IF\b.*\bTHEN|WHILE\b|FOR\b|CASE\b|DO\s*(?:;.*)?$)/i,
    parts: /^\s*(?:ELSE|VALUE|ANY)\b/i,
    closes: /^\s*(?:END|UNTIL)\b/i,
    keeps: /^\s*\./,
};
