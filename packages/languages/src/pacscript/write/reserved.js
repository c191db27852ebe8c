/** Words of the language, and functions, that a name must not hide. */
export const RESERVED = new Set([
    "abs", "accel", "and", "approach", "archmove", "arrive", "as", "boolean", "byref", "byte", "byval", "c", "call", "case", "changetool", "changework", "cos", "curpos", "decel", "define", "degrad", "delay", "depart", "dev",
    "devh", "dim", "do", "dogripper", "double", "draw", "drive", "drivea", "else", "elseif", "end", "endif", "exit", "extspeed", "false", "fig", "for", "function", "givearm", "gohome", "gosub", "goto", "halt", "hold", "i", "f",
    "if", "int", "integer", "io", "j", "joint", "l", "letf", "long", "loop", "main", "mod", "motor", "move", "mps", "next", "not", "off", "on", "or", "p", "d", "s", "t", "v", "e", "payload", "pi", "position", "posx", "posy", "posz",
    "posrx", "posry", "posrz", "print", "printdbg", "printmsg", "ptp", "raddeg", "rem", "reset", "return", "rotate", "rotateh", "run", "select", "set", "sin", "single", "speed", "sqr", "step", "stop", "string", "sub",
    "suspend", "takearm", "tan", "then", "time", "to", "tool", "true", "until", "vector", "wait", "wend", "while", "work", "xor",
]);
