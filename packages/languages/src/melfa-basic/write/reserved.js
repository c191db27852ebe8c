/** Words of the language, and functions, that a name must not hide. */
export const RESERVED = new Set([
    "abs", "accel", "act", "and", "atn", "atn2", "base", "break", "callp", "case", "chr", "clr", "cmp", "cnt", "cos", "def", "default", "deg", "dim", "dly", "else", "elseif", "end", "endif", "error", "exp", "fine",
    "fix", "for", "fprm", "getm", "gosub", "goto", "hclose", "hlt", "hopen", "if", "input", "int", "inv", "jovrd", "jrc", "loadset", "max", "min", "mod", "mov", "mva", "mvc", "mvr", "mvr2", "mvr3", "mvs", "mvspl",
    "mxt", "next", "not", "oadl", "off", "on", "open", "or", "ovrd", "plt", "pos", "prec", "print", "rad", "rem", "relm", "return", "select", "servo", "setjnt", "setpos", "sgn", "sin", "skip", "spd", "sqr",
    "step", "tan", "then", "to", "tool", "torq", "trk", "type", "wait", "wend", "while", "wth", "wthif", "xor", "xrun", "p_curr", "p_zero", "p_nbase", "p_ntool", "m_in", "m_out", "m_pi", "program",
]);
