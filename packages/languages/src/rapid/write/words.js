/** Words that a name must not be: those of the language, and data, functions and instructions that every controller has. Lower case. */
export const WORDS = new Set([
    "alias", "and", "backward", "case", "connect", "const", "default", "div", "do", "else", "elseif", "endfor", "endfunc", "endif", "endmodule", "endproc",
    "endrecord", "endtest", "endtrap", "endwhile", "error", "exit", "false", "for", "from", "func", "goto", "if", "inout", "local", "mod", "module", "not", "nostepin",
    "noview", "or", "pers", "proc", "raise", "readonly", "record", "retry", "return", "step", "sysmodule", "task", "test", "then", "to", "trap", "true", "trynext",
    "undo", "var", "viewonly", "while", "with", "xor",
    "main", "tool0", "wobj0", "load0", "fine", "vmax", "pi", "high", "low", "edge", "user", "base", "errno", "dogripper",
    "num", "dnum", "bool", "string", "pos", "orient", "pose", "robtarget", "jointtarget", "confdata", "tooldata", "wobjdata", "loaddata", "speeddata", "zonedata",
    "moveabsj", "movej", "movel", "movec", "searchl", "searchc", "waittime", "waitdi", "waitdo", "waitai", "waitao", "waituntil", "set", "reset", "setdo", "setao",
    "pulsedo", "gripload", "tpwrite", "accset", "velset", "confj", "confl", "stop", "break", "offs", "reltool", "posemult", "poseinv", "crobt", "cjointt",
    "dinput", "doutput", "ainput", "aoutput", "testdi", "abs", "sqrt", "sin", "cos", "tan", "atan", "atan2", "round", "trunc", "distance", "present",
]);
/** Speeds and zones that every controller has: the tool's in mm/s, and in mm. */
export const SPEEDS = [5, 10, 20, 30, 40, 50, 60, 80, 100, 150, 200, 300, 400, 500, 600, 800, 1000, 1500, 2000, 2500, 3000, 4000, 5000, 6000, 7000];
export const ZONES = [1, 5, 10, 15, 20, 30, 40, 50, 60, 80, 100, 150, 200];
