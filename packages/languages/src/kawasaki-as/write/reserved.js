/** Words of the language, functions and system variables that a name must not hide. */
export const RESERVED = new Set([
    "above", "abs", "accel", "accuracy", "align", "always", "and", "any", "atan2", "base", "below", "bits", "break", "by", "c1move", "c2move", "call", "case", "clamp",
    "close", "closei", "cos", "cp", "decel", "decompose", "delay", "dext", "distance", "do", "draw", "drive", "dwrist", "dx", "dy", "dz", "else", "elseif", "end", "false",
    "fine", "for", "frame", "goto", "halt", "here", "hmove", "home", "if", "int", "jappro", "jdepart", "jmove", "lappro", "ldepart", "lefty", "lmove", "maxval", "minval",
    "mod", "mon_speed", "not", "null", "of", "off", "on", "oni", "open", "openi", "or", "pause", "pi", "point", "print", "pulse", "reset", "return", "righty", "rx", "ry", "rz",
    "scall", "shift", "sig", "signal", "sin", "speed", "sqrt", "step", "stop", "swait", "tan", "tdraw", "then", "timer", "to", "tool", "trans", "true", "twait", "type",
    "until", "uwrist", "value", "wait", "weight", "while", "xmove", "xor",
]);
