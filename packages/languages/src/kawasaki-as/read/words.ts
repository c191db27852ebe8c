/** Statements that move the robot. */
export const MOTIONS: ReadonlySet<string> = new Set([
  "jmove",
  "lmove",
  "hmove",
  "c1move",
  "c2move",
  "jappro",
  "lappro",
  "jdepart",
  "ldepart",
  "draw",
  "tdraw",
  "drive",
  "xmove",
  "taught",
]);
/** Statements with values behind them that are executed here. */
export const INSTRUCTIONS: ReadonlySet<string> = new Set([
  ...MOTIONS,
  "break",
  "speed",
  "accuracy",
  "accel",
  "decel",
  "tool",
  "base",
  "twait",
  "delay",
  "stable",
  "signal",
  "pulse",
  "openi",
  "closei",
  "open",
  "close",
  "lefty",
  "righty",
  "above",
  "below",
  "uwrist",
  "dwrist",
  "weight",
  "print",
  "type",
  "ty",
  "sig",
  "here",
  "decompose",
  "mon_speed",
]);
/** Statements that are understood and cannot be written as steps, with what the user is told. */
export const UNSUPPORTED: Readonly<Record<string, string>> = {
  xmove: "XMOVE ends at a signal by an option of the controller, which is not executed here.",
  home: "HOME goes to a posture that only the controller knows.",
  home2: "HOME2 goes to a posture that only the controller knows.",
  align: "ALIGN turns the tool by rules of the controller that are not executed here.",
  pause: "PAUSE waits for a person, who is not here.",
  on: "ON belongs to interrupts, which are not executed here.",
  oni: "ONI belongs to interrupts, which are not executed here.",
  ignore: "IGNORE belongs to interrupts, which are not executed here.",
  pcexecute: "PCEXECUTE starts another task, which is not executed here.",
  scall: "SCALL chooses a program by its name at run time, which is not executed here.",
};
/** Millimetres a second of one unit; 0 for a duration. */
export const SPEED_UNITS: Readonly<Record<string, number>> = {
  "mm/s": 1,
  "mm/min": 1 / 60,
  "cm/min": 10 / 60,
  "cm/s": 10,
  "m/s": 1000,
  s: 0,
};
/** Words that the controller takes in a shorter form. */
export const SHORT: Readonly<Record<string, string>> = { sig: "signal", ty: "type" };

/**
 * Statements that are kept where a text is executed as it is: they speak with people, clocks, the network, the welding
 * source, other tasks or another group of axes, and do not move this arm by themselves.
 */
export const KEPT: ReadonlySet<string> = new Set([
  "abs.speed",
  "bits",
  "disp",
  "errstart",
  "group",
  "hold",
  "ifpwoverwrite",
  "ifpwprint",
  "ignore",
  "lwc",
  "lwe",
  "lws",
  "mc",
  "on",
  "one",
  "oni",
  "out",
  "pause",
  "pcabort",
  "pcend",
  "pcexecute",
  "prefetch.sigins",
  "prompt",
  "qtool",
  "rep_once",
  "runmask",
  "sout",
  "stp_once",
  "timer",
  "unit",
  "w1set",
  "w2set",
  "wait.time",
]);
/** Statements of the network: what they receive is known to nobody here. */
export const RECEIVES = /^(?:tcp|udp)_/;
/** Motions to places that only the controller knows. */
export const AWAY: ReadonlySet<string> = new Set(["home", "home2", "align", "scall"]);
