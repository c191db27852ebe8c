export const LINES = {
    motion: /^\s*(?:[0-9]+\s+)?(?:[JLXH]MOVE|C[12]MOVE|[JL]APPRO|[JL]DEPART|DRIVE|T?DRAW|ALIGN|HOME2?)\b/i,
    opens: /^\s*(?:[0-9]+\s+)?(?:IF\b.*\bTHEN|WHILE\b|FOR\b|S?CASE\b|DO\s*(?:;.*)?$)/i,
    parts: /^\s*(?:ELSE|S?VALUE|ANY)\b/i,
    closes: /^\s*(?:END|UNTIL)\b/i,
    keeps: /^\s*\./,
};
