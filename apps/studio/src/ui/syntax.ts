/** How a language is coloured: its words, how a comment begins, and whether capitals matter. */
export interface Syntax {
  readonly words: ReadonlySet<string>;
  readonly comment: RegExp;
  readonly exact: boolean;
}

const of = (comment: RegExp, words: string, exact = false): Syntax => ({
  words: new Set((exact ? words : words.toUpperCase()).split(/\s+/)),
  comment,
  exact,
});

const SYNTAX: Readonly<Record<string, Syntax>> = {
  "v-plus": of(
    /;.*$/,
    ".PROGRAM .END .LOCATIONS .REALS .JOINTS MOVE MOVES MOVET SPEED ACCEL DELAY TOOL SET BREAK OPEN OPENI CLOSE CLOSEI CALL DO DECOMPOSE BASE IF THEN ELSE END FOR TO WHILE RETURN ALWAYS MMPS TRANS PPOINT RIGHTY LEFTY ABOVE BELOW FLIP NOFLIP SINGLE MULTIPLE DURATION APPRO APPROS DEPART DEPARTS WAIT SIGNAL SIG TYPE STOP",
  ),
  krl: of(
    /;.*$/,
    "DEF END DEFDAT ENDDAT DECL INT REAL BOOL CHAR FRAME POS E6POS E6AXIS AXIS FDAT LDAT PDAT PTP LIN CIRC SPTP SLIN SCIRC SPLINE ENDSPLINE C_PTP C_DIS C_VEL C_ORI BAS WAIT SEC FOR IF THEN ELSE ENDIF TO ENDFOR LOOP ENDLOOP WHILE ENDWHILE REPEAT UNTIL EXIT HALT RETURN INTERRUPT WHEN BRAKE RESUME TRUE FALSE INI GLOBAL CONST PUBLIC ENUM STRUC TRIGGER DELAY PULSE",
  ),
  urscript: of(
    /#.*$/,
    "def end thread if elif else while return True False global local movej movel movep movec set_tcp set_payload sleep set_digital_out set_standard_digital_out get_standard_digital_in popup textmsg sync halt stopl stopj and or not break continue p",
    true,
  ),
  rapid: of(
    /!.*$/,
    "MODULE ENDMODULE PROC ENDPROC VAR PERS CONST LOCAL TASK robtarget jointtarget tooldata wobjdata speeddata zonedata loaddata num bool string MoveAbsJ MoveJ MoveL MoveC SearchL WaitTime WaitDI WaitUntil SetDO SetAO Reset Set PulseDO FOR FROM TO DO ENDFOR IF THEN ELSE ELSEIF ENDIF WHILE ENDWHILE TPWrite Stop Exit RETURN TRUE FALSE GripLoad AccSet",
  ),
  inform: of(
    /'.*$/,
    "/JOB //NAME //POS ///NPOS ///TOOL ///POSTYPE ///RECTAN ///PULSE ///USER ///RCONF //INST ///DATE ///ATTR ///GROUP1 NOP END MOVJ MOVL MOVC MOVS TIMER DOUT DIN WAIT CALL JUMP IF SET INC DEC ADD SUB PULSE RET MSG SPEED VJ V PL UNTIL ON OFF",
  ),
  "fanuc-ls": of(
    /!.*$/,
    "/PROG /ATTR /MN /POS /END J L C A S WAIT CALL LBL JMP IF SELECT DO DI RO RI UFRAME_NUM UTOOL_NUM FINE CNT FOR ENDFOR TO ON OFF PAYLOAD SKIP END UF UT CONFIG",
  ),
  val3: of(
    /\/\/.*$/,
    "begin end movej movel movec if then else endIf while do endWhile for to endFor return call open close delay wait watch put putln dio aio true false here appro setFrame waitEndMove autoConnectMove",
    true,
  ),
  "kawasaki-as": of(
    /;.*$/,
    ".PROGRAM .END .TRANS .JOINTS .REALS JMOVE LMOVE C1MOVE C2MOVE JAPPRO LAPPRO JDEPART LDEPART SPEED ACCURACY ACCEL DECEL TOOL BASE OPENI CLOSEI OPEN CLOSE SIGNAL SWAIT TWAIT DELAY BREAK FOR TO END IF THEN ELSE WHILE DO CALL RETURN ALWAYS FINE POINT TRANS STOP PRINT MM/S",
  ),
  spel: of(
    /'.*$/,
    "Function Fend Call Go Move Arc3 TGo TMove CP XY JA P Here Local Tool TLSet Speed SpeedS Accel AccelS Power Motor High Low On Off Sw Oport Wait Print For To Step Next Do Loop While Until Wend If Then Else ElseIf EndIf Select Case Default Send Integer Real Boolean Global Quit All Exit Mod And Or Not True False define TLX TLY TLZ",
  ),
  "melfa-basic": of(
    /'.*$/,
    "Mov Mvs Mvr Cnt Ovrd JOvrd Spd Accel Dly HOpen HClose Tool Base Wait M_In M_Out P_Curr P_NTool P_NBase SetPos JtoP GoSub Return For To Step Next While WEnd If Then Else EndIf Select Case Default Hlt End Mod And Or Not Servo Def Dim On Off",
  ),
  pacscript: of(
    /'.*$/,
    "Sub End Call Move Approach Depart Draw P L C J V Speed Accel Decel Mps TakeArm GiveArm Tool Work ChangeTool ChangeWork Dev DevH CurPos Set Reset IO Wait Delay Payload PrintDbg Halt Dim As Integer Single Position Joint For To Step Next Do Loop While Until If Then Else ElseIf Select Case Exit Mod And Or Not On Off True False Define Keep",
  ),
  "l-irl": of(
    /\{.*$/,
    "POSES MM M DEG RAD ZYX ZYZ XYZ BASE WORLD ROBOT PROGRAM TOOL FRAME GROUP POSE MOVE PTP LIN SPLINE CIRCLE VIA TO JOINTS AT IN BRANCH FRONT BACK UP DOWN POSITIVE NEGATIVE DET ELBOW SPEED MMPS TIME ACC BLEND NAME WAIT GRIPPER CLOSE OPEN",
  ),
};
const PLAIN: Syntax = { words: new Set(), comment: /(?!)/, exact: true };

export const syntaxOf = (dialect: string): Syntax => SYNTAX[dialect] ?? PLAIN;

export type Ink = "word" | "number" | "comment" | "plain";
export interface Stroke {
  readonly ink: Ink;
  readonly text: string;
}

/** A line as strokes of one colour each; together they are the line. */
export function strokes(line: string, { words, comment, exact }: Syntax): readonly Stroke[] {
  const found = comment.exec(line);
  const code = found ? line.slice(0, found.index) : line;
  const parts = code
    .split(/("[^"]*"|\/{1,3}[A-Za-z]\w*|[.$#]?[A-Za-z_]\w*(?:\/S\b)?|-?\d+\.?\d*(?:[eE][-+]?\d+)?)/)
    .filter(part => part !== "");
  const isWord = (part: string): boolean => words.has(exact ? part : part.toUpperCase());
  return [
    ...parts.map(
      (text): Stroke => ({
        ink: isWord(text) || isWord(text.replace(/^[#$]/, "")) ? "word" : /^-?\d/.test(text) ? "number" : "plain",
        text,
      }),
    ),
    ...(found ? [{ ink: "comment" as const, text: line.slice(found.index) }] : []),
  ];
}
