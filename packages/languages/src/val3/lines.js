export const LINES = {
    motion: /^\s*(?:\w+\s*=\s*)?move[jlc]\s*\(/i,
    opens: /^\s*(?:if|while|for|switch|do)\b/i,
    parts: /^\s*(?:elseif|else|case|default)\b/i,
    closes: /^\s*(?:endIf|endWhile|endFor|endSwitch|until)\b/i,
    keeps: /^\s*(?:<|\]\]>|begin\s*$|end\s*$)/i,
};
