import type { EmittedFile } from "@twincell/core";

/**
 * The variable protocol moves no robot: a program on the controller does, which carries out what a client puts into its
 * global variables. Both sides know these names. The last one written is TWC_CMD, a number that was not there before;
 * when the command has ended the program writes TWC_RESULT and then the same number to TWC_DONE.
 *
 * While a motion is under way $TIMER[10] counts up from −TWC_WATCH ms and the client sets it back; when it reaches 0
 * the robot brakes: a watchdog on the robot's side, which the protocol itself does not have.
 *
 * The protocol has no way to the drives either. Where a cell wires outputs to the inputs $DRIVES_ON and (inverted)
 * $DRIVES_OFF of Automatic External, TWC_ON and TWC_OFF in the data list are their numbers; 0 says there is no such
 * wire.
 */
export const LOOP_NAME = "TWINCELL";
export const LOOP_VERSION = 1;
export const TWC = {
  version: "TWC_VERSION",
  kind: "TWC_KIND",
  axis: "TWC_AXIS",
  position: "TWC_POS",
  via: "TWC_VIA",
  ratio: "TWC_RATIO",
  acceleration: "TWC_ACC",
  speed: "TWC_SPEED",
  command: "TWC_CMD",
  done: "TWC_DONE",
  result: "TWC_RESULT",
  stop: "TWC_STOP",
  lock: "TWC_LOCK",
  watch: "TWC_WATCH",
  drivesOn: "TWC_ON",
  drivesOff: "TWC_OFF",
} as const;
export const TWC_KIND = { joints: 1, line: 2, arc: 3, rsi: 4 } as const;
export const TWC_RESULT = { running: 0, done: 1, stopped: 2, refused: 3, silent: 4 } as const;
export const WATCH_TIMER = 10;

const HEADER = ["&ACCESS RVP", "&REL 1", "&COMMENT Carries out what Twincell asks for"];
const SRC = [
  ...HEADER,
  "DEF TWINCELL( )",
  ";Interrupts 20 and 21 and timer 10 belong to this program.",
  "INTERRUPT DECL 20 WHEN TWC_STOP==TRUE DO TWC_BRAKE( )",
  `INTERRUPT DECL 21 WHEN $TIMER_FLAG[${WATCH_TIMER}]==TRUE DO TWC_BRAKE( )`,
  ";FOLD INI",
  "BAS(#INITMOV,0)",
  ";ENDFOLD (INI)",
  "$ADVANCE=0",
  "$TOOL=$NULLFRAME",
  "$BASE=$ROBROOT",
  `$TIMER_STOP[${WATCH_TIMER}]=TRUE`,
  `$TIMER[${WATCH_TIMER}]=-1000`,
  "TWC_DONE=TWC_CMD",
  "TWC_STOP=FALSE",
  ";Coincidence with the path where the robot stands",
  "PTP $AXIS_ACT",
  "LOOP",
  "  WAIT FOR (TWC_CMD<>TWC_DONE) OR TWC_STOP",
  "  IF TWC_STOP THEN",
  ";A stop also takes back the command that came with it",
  "    TWC_RESULT=2",
  "    TWC_DONE=TWC_CMD",
  "    TWC_STOP=FALSE",
  "  ELSE",
  "    TWC_MOVE( )",
  "  ENDIF",
  "ENDLOOP",
  "END",
  "",
  "DEF TWC_MOVE( )",
  "DECL INT I",
  "TWC_NOW=TWC_CMD",
  "TWC_RESULT=0",
  "IF TWC_LOCK THEN",
  "  TWC_RESULT=3",
  "ELSE",
  `  $TIMER[${WATCH_TIMER}]=-1*TWC_WATCH`,
  `  $TIMER_STOP[${WATCH_TIMER}]=FALSE`,
  "  INTERRUPT ON 20",
  "  INTERRUPT ON 21",
  ";A stop that came before the interrupt was on",
  "  IF TWC_STOP THEN",
  "    TWC_RESULT=2",
  "    TWC_STOP=FALSE",
  "  ELSE",
  "    FOR I=1 TO 6",
  "      $VEL_AXIS[I]=TWC_RATIO",
  "      $ACC_AXIS[I]=TWC_ACC",
  "    ENDFOR",
  "    $VEL.CP=TWC_SPEED",
  "    SWITCH TWC_KIND",
  "    CASE 1",
  "      PTP TWC_AXIS",
  "    CASE 2",
  "      LIN TWC_POS",
  "    CASE 3",
  "      CIRC TWC_VIA,TWC_POS",
  "    DEFAULT",
  "      TWC_RESULT=3",
  "    ENDSWITCH",
  "  ENDIF",
  "  INTERRUPT OFF 20",
  "  INTERRUPT OFF 21",
  `  $TIMER_STOP[${WATCH_TIMER}]=TRUE`,
  "  IF TWC_RESULT==0 THEN",
  "    TWC_RESULT=1",
  "  ENDIF",
  "ENDIF",
  "TWC_DONE=TWC_NOW",
  "END",
  "",
  "DEF TWC_BRAKE( )",
  "INTERRUPT OFF 20",
  "INTERRUPT OFF 21",
  "BRAKE",
  `$TIMER_STOP[${WATCH_TIMER}]=TRUE`,
  "TWC_RESULT=2",
  `IF $TIMER_FLAG[${WATCH_TIMER}]==TRUE THEN`,
  "  TWC_RESULT=4",
  "ENDIF",
  "TWC_DONE=TWC_NOW",
  "TWC_STOP=FALSE",
  "RESUME",
  "END",
];
const NO_AXES = "A1 0.0,A2 0.0,A3 0.0,A4 0.0,A5 0.0,A6 0.0,E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0";
const NO_PLACE = "X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0,E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0";
/** Every global with the value it has on delivery. TWC_NOW is the program's own. */
export const LOOP_GLOBALS: readonly (readonly [string, "INT" | "REAL" | "BOOL" | "E6AXIS" | "E6POS", string])[] = [
  [TWC.version, "INT", String(LOOP_VERSION)],
  [TWC.kind, "INT", "0"],
  [TWC.axis, "E6AXIS", `{${NO_AXES}}`],
  [TWC.position, "E6POS", `{${NO_PLACE}}`],
  [TWC.via, "E6POS", `{${NO_PLACE}}`],
  [TWC.ratio, "INT", "10"],
  [TWC.acceleration, "INT", "100"],
  [TWC.speed, "REAL", "0.1"],
  [TWC.command, "INT", "0"],
  ["TWC_NOW", "INT", "0"],
  [TWC.done, "INT", "0"],
  [TWC.result, "INT", "0"],
  [TWC.stop, "BOOL", "FALSE"],
  [TWC.lock, "BOOL", "FALSE"],
  [TWC.watch, "INT", "500"],
  [TWC.drivesOn, "INT", "0"],
  [TWC.drivesOff, "INT", "0"],
];
const DAT = [
  ...HEADER,
  "DEFDAT TWINCELL PUBLIC",
  "EXT BAS(BAS_COMMAND :IN,REAL :IN)",
  ...LOOP_GLOBALS.map(([name, type, value]) => `DECL GLOBAL ${type} ${name}=${value}`),
  "ENDDAT",
];

const file = (name: string, lines: readonly string[]): EmittedFile => ({
  name,
  text: `${lines.join("\r\n")}\r\n`,
  lines: lines.map(() => ""),
});
/**
 * The program under which a sensor moves the robot by corrections; it needs the RSI option and the signal flow
 * TWINCELL.rsi.
 */
export const RSI_NAME = "TWINCELL_RSI";
export const RSI_FILE: EmittedFile = file("TWINCELL_RSI.src", [
  "&ACCESS RVP",
  "&REL 1",
  "&COMMENT Lets Twincell move the robot by RSI",
  "DEF TWINCELL_RSI( )",
  "DECL INT RET",
  "INTERRUPT DECL 20 WHEN TWC_STOP==TRUE DO TWC_RSI_END( )",
  ";FOLD INI",
  "BAS(#INITMOV,0)",
  ";ENDFOLD (INI)",
  "TWC_STOP=FALSE",
  "INTERRUPT ON 20",
  ";Coincidence with the path where the robot stands",
  "PTP $AXIS_ACT",
  'RET=RSI_CREATE("TWINCELL.rsi")',
  "RET=RSI_ON(#RELATIVE)",
  "RSI_MOVECORR( )",
  "RET=RSI_OFF( )",
  "END",
  "",
  "DEF TWC_RSI_END( )",
  "DECL INT RET",
  "INTERRUPT OFF 20",
  "BRAKE",
  "RET=RSI_OFF( )",
  "TWC_STOP=FALSE",
  "HALT",
  "END",
]);
/** The two files that a person puts on the controller once. */
export const LOOP_FILES: readonly [EmittedFile, EmittedFile] = [file("TWINCELL.src", SRC), file("TWINCELL.dat", DAT)];
