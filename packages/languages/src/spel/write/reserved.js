/** Words of the language, and functions, that a name must not hide. */
export const RESERVED = new Set([
    "abs", "accel", "accels", "agl", "agltopls", "and", "arc", "arc3", "arch", "arm", "atan2", "base", "bgo", "bmove", "boolean", "brake", "byref", "byte", "byval", "call", "case", "cos", "cp", "ctr", "cu",
    "curpos", "curve", "cv", "cvmove", "cw", "cx", "cy", "cz", "default", "define", "degtorad", "do", "double", "elbow", "else", "elseif", "endif", "err", "error", "exit", "false", "fend", "fine", "fix", "for",
    "function", "global", "go", "gosub", "goto", "halt", "hand", "here", "home", "if", "in", "inertia", "input", "int", "integer", "ja", "jump", "jump3", "limz", "line", "local", "long", "loop", "main", "mod",
    "motor", "move", "next", "not", "off", "on", "oport", "or", "out", "pallet", "pass", "pause", "pi", "point", "power", "preserve", "print", "pulse", "quit", "radtodeg", "real", "reset", "return", "robot",
    "select", "send", "sense", "short", "sin", "speed", "speedr", "speeds", "sqr", "step", "string", "sw", "tan", "tgo", "then", "till", "tlset", "tlx", "tly", "tlz", "tlu", "tlv", "tlw", "tmove", "tmout",
    "tmreset", "to", "tool", "trap", "true", "tw", "until", "wait", "weight", "wend", "where", "while", "wrist", "xor", "xqt", "xy", "x", "y", "z", "u", "v", "w", "r", "l", "a", "b", "f", "nf", "p", "dogripper",
    ...Array.from({ length: 1000 }, (_, i) => `p${i}`), "all", "high", "low", "find", "ljm", "rot", "as", "st", "ecp", "lset", "rset", "trim", "signal",
]);
