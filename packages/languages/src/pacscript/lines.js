export const LINES = {
    motion: /^\s*(?:Move|Approach|Depart|Draw|DriveA?|RotateH?|ArchMove|GoHome)\b/i,
    opens: /^\s*(?:If\b.*\bThen\s*(?:'.*)?$|For\b|Do\b|While\b|Select\b)/i,
    parts: /^\s*(?:Else|ElseIf|Case)\b/i,
    closes: /^\s*(?:End\s*If|Next|Loop|Wend|End\s+Select)\b/i,
    keeps: /^\s*(?:#|Sub\b|End\s+Sub\b)/i,
};
