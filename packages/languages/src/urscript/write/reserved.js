/** Words of the language. */
export const RESERVED = new Set([
    "and", "or", "not", "xor", "if", "elif", "else", "while", "def", "thread", "end", "return", "break", "continue", "global", "local", "halt",
    "run", "kill", "join", "sec", "enter_critical", "exit_critical", "True", "False", "pass", "p",
]);
/** Functions of the controller that a program must not hide. */
export const TAKEN = [
    "movej", "movel", "movep", "movec", "sleep", "sync", "textmsg", "popup", "set_tcp", "set_payload", "set_target_payload", "set_gravity",
    "pose_trans", "pose_add", "pose_inv", "pose_sub", "pose_dist", "point_dist", "interpolate_pose", "get_inverse_kin", "get_forward_kin", "flange",
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "pow", "sqrt", "floor", "ceil", "log", "d2r", "r2d", "norm", "size", "length", "abs", "random",
];
