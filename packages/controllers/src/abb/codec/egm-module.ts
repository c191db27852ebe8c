/**
 * The program that waits for targets, as it stands on a controller: motions that are guided from here need it there and
 * running.
 */
export const EGM_MODULE = "TwincellEGM";
export const EGM_FILE = `${EGM_MODULE}.mod`;

/**
 * For a controller whose transmission protocol (UCdevice) is called UCdevice1. Takes joint targets until they fail to
 * come for a second.
 */
export const EGM_TEXT = `MODULE ${EGM_MODULE}
  VAR egmident twincell_id;
  PROC main()
    EGMReset twincell_id;
    EGMGetId twincell_id;
    EGMSetupUC ROB_1,twincell_id,"default","UCdevice1"\\Joint\\CommTimeout:=1;
    EGMStreamStart twincell_id;
    WHILE TRUE DO
      EGMActJoint twincell_id\\J1:=twincell_range\\J2:=twincell_range\\J3:=twincell_range\\J4:=twincell_range\\J5:=twincell_range\\J6:=twincell_range\\MaxSpeedDeviation:=1000;
      EGMRunJoint twincell_id,EGM_STOP_HOLD\\J1\\J2\\J3\\J4\\J5\\J6\\CondTime:=3600000\\RampInTime:=0.05\\PosCorrGain:=1;
    ENDWHILE
  ENDPROC
  CONST egm_minmax twincell_range:=[-0.001,0.001];
ENDMODULE
`;

/** Whether a module is guided from outside instead of moving by itself. */
export const isStreamed = (text: string): boolean => /^\s*EGMRun(?:Joint|Pose)\b/im.test(text);
/** How long such a module waits for a target [s]. */
export function commTimeout_s(text: string): number | undefined {
  const seconds = Number(/\\CommTimeout\s*:=\s*([0-9]+(?:\.[0-9]+)?)/i.exec(text)?.[1]);
  return seconds > 0 ? seconds : undefined;
}
