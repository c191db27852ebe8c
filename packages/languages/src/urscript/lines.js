export const LINES = {
    motion: /^\s*(?:move[a-z]|servo[a-z]+|speed[jl]|speed[jl]_init|force_mode|teach_mode|freedrive_mode)\s*\(/,
    opens: /^\s*(?:if|while|thread|sec|switch)\b.*:\s*(?:#.*)?$/,
    parts: /^\s*(?:elif\b.*|else\s*|case\b.*|default\s*):\s*(?:#.*)?$/,
    closes: /^\s*end\b/,
    keeps: /^\s*def\b/,
};
