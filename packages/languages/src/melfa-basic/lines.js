export const LINES = {
    motion: /^\s*(?:[0-9]+\s+)?(?:Mov|Mvs|Mvr[23]?|Mvc|Mva|MvSpl)\b/i,
    opens: /^\s*(?:[0-9]+\s+)?(?:If\b.*\bThen\s*(?:'.*)?$|For\b|While\b|Select\b)/i,
    parts: /^\s*(?:[0-9]+\s+)?(?:Else|ElseIf|Case|Default)\b/i,
    closes: /^\s*(?:[0-9]+\s+)?(?:EndIf|Next|WEnd|End\s*Select)\b/i,
    keeps: /^\s*(?:[0-9]+\s+)?(?:\*|Return\b|End\s*(?:'.*)?$)/i,
};
