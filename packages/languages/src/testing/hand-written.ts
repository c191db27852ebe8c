/*
 * Programs as people keep them: inline forms with folds, odd spacing, comments with umlauts and kanji, points that
 * several motions share, fields in any order, external axes. Written by hand, not by an emitter.
 */
import type { PatchFile } from "../patch/index.ts";

export interface HandWritten {
  readonly language: string;
  readonly robot: string;
  readonly main: string;
  readonly files: readonly PatchFile[];
  /** Points that can be touched up, by name; "" for each literal in a motion. */
  readonly points: readonly string[];
}

const KRL: HandWritten = {
  language: "krl",
  robot: "kuka_kr6_2",
  main: "weld_bracket.src",
  points: ["XHOME", "XP1", "XP2", "XP3", "XP4", ""],
  files: [
    {
      name: "weld_bracket.src",
      text: [
        "&ACCESS RVP",
        "&REL 14",
        "&COMMENT Halter schwei\u00dfen",
        "DEF weld_bracket( )",
        ";FOLD INI",
        "  ;FOLD BASISTECH INI",
        "    GLOBAL INTERRUPT DECL 3 WHEN $STOPMESS==TRUE DO IR_STOPM ( )",
        "    INTERRUPT ON 3 ",
        "    BAS (#INITMOV,0 )",
        "  ;ENDFOLD (BASISTECH INI)",
        ";ENDFOLD (INI)",
        "",
        "PTP XHOME",
        ";FOLD PTP P1 CONT Vel=60 % PDAT1 Tool[2]:torch Base[1]",
        "  $TOOL={X 0.0,Y 0.0,Z 95.5,A 0.0,B 30.0,C 0.0} ; Brenner {X 1,Y 2}",
        "  $BASE={X 800.0,Y 0.0,Z 400.0,A 0.0,B 0.0,C 0.0}",
        "  BAS(#VEL_PTP,60)",
        "  ptp  XP1  C_PTP",
        ";ENDFOLD",
        "; Naht 1, P2 = {X 0}",
        "  $VEL.CP=0.4",
        "  LIN XP2 C_DIS",
        "  LIN XP3",
        "  CIRC XP4,XP2",
        "\tLIN {X 120,Y 35.50,Z 210.125,A 180.0,B 0,C 180.0}",
        "  LIN XP1",
        "PTP XHOME",
        "END",
        "",
      ].join("\r\n"),
    },
    {
      name: "weld_bracket.dat",
      text: [
        "&ACCESS RVP",
        "&REL 14",
        "DEFDAT  weld_bracket",
        ";FOLD EXTERNAL DECLARATIONS;%{PE}%MKUKATPBASIS,%CEXT,%VCOMMON,%P",
        "EXT  BAS (BAS_COMMAND  :IN,REAL  :IN )",
        ";ENDFOLD (EXTERNAL DECLARATIONS)",
        "DECL E6AXIS XHOME={A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 20.0,A6 0.0,E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}",
        "DECL E6POS XP1={X 120.5,Y 35.50,Z 310.125,A 180.0,B 0.0,C 180.0,S 'B010',T 'B100011',E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}",
        "DECL E6POS XP2={Z 210.0,Y 35.50,X 120.5,C 180.0,B 0.0,A 180.0,S 2,T 35,E1 12.75,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}",
        'DECL FDAT FP1={TOOL_NO 2,BASE_NO 1,IPO_FRAME #BASE,POINT2[] " "}',
        "DECL LDAT LCPDAT1={VEL 2.0,ACC 100.0,APO_DIST 100.0,APO_FAC 50.0,ORI_TYP #VAR}",
        "  decl  pos   xp3 = {X 180,Y -20,Z 210,A 175.0,B 2.5,C 180.0,S 2,T 34}",
        "FRAME XP4={X 150.0,Y 60.0,Z 210.0,A 180.0,B 0.0,C 180.0}   ; Kreis \u00fcber XP4={X 1}",
        "DECL E6POS XOLD={X 1.0,Y 2.0,Z 3.0,A 0.0,B 0.0,C 0.0,S 2,T 2,E1 0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}",
        "ENDDAT",
        "",
      ].join("\r\n"),
    },
  ],
};

const RAPID: HandWritten = {
  language: "rapid",
  robot: "abb_irb120",
  main: "Pick.mod",
  points: ["pHome", "pPick", "pVia", "jPark", ""],
  files: [
    {
      name: "Pick.mod",
      text: [
        "MODULE Pick",
        "  ! Greifen [[1,2,3],[1,0,0,0]] f\u00fcr Linie 3",
        "  PERS tooldata tGrip:=[TRUE,[[0,0,114.2],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];",
        '  TASK PERS wobjdata wTray:=[FALSE,TRUE,"",[[100,0,20],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];',
        "  CONST robtarget pHome:=[[250,0,400],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];",
        "  LOCAL CONST robtarget pPick := [ [ 210.5 , -30.25 , 180 ] , [ 0.0087 , 0 , 0.99996 , 0 ] , [ -1 , 0 , -1 , 0 ] ,",
        "      [ 9E+09 , 9E+09 , 9E+09 , 9E+09 , 9E+09 , 9E+09 ] ];",
        "  CONST robtarget pVia:=[[230,40,200],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];",
        "  CONST jointtarget jPark:=[[0,-20,20,0,45.5,0],[9E9,9E9,9E9,9E9,9E9,9E9]];",
        "  VAR num nCount:=0;",
        "  PROC main()",
        "    MoveAbsJ jPark\\NoEOffs,v500,fine,tGrip\\WObj:=wobj0;",
        "    MoveJ pHome,v300,z10,tGrip\\WObj:=wTray;",
        "    MoveL pPick, v100, fine, tGrip \\WObj:=wTray; ! unten",
        "    MoveL Offs(pPick,0,0,60),v100,z1,tGrip\\WObj:=wTray;",
        "    MoveC pVia,pHome,v100,fine,tGrip\\WObj:=wTray;",
        "    MoveL [[240,10,210],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tGrip\\WObj:=wTray;",
        "    MoveAbsJ jPark\\NoEOffs,v500,fine,tGrip\\WObj:=wobj0;",
        "  ENDPROC",
        "ENDMODULE",
        "",
      ].join("\n"),
    },
  ],
};

const URSCRIPT: HandWritten = {
  language: "urscript",
  robot: "ur10e",
  main: "pick.script",
  points: ["home", "above", "", ""],
  files: [
    {
      name: "pick.script",
      text: [
        "# movej([0,0,0,0,0,0]) \u2013 not a motion",
        "def pick():",
        "  set_tcp(p[0, 0, 0.12, 0, 0, 0])",
        "  global home = [0.0, -1.57, 1.57, -1.57, -1.57, 0]",
        "  above=p[ 0.55, 0.10 ,0.40, 0, 3.1415, 0 ]",
        "  movej(home, a=1.4, v=1.05)",
        "  movel(above, a=1.2, v=0.25)   # p[1,2,3,4,5,6]",
        "  movel(p[0.55,0.1,0.32,0,3.1415,0], v=0.1)",
        "\tmovej([0.1,-1.4,1.5,-1.6,-1.57,0.25], v=0.5)",
        "  movel(above, v=0.25)",
        "  movej(home)",
        "end",
        "",
      ].join("\n"),
    },
  ],
};

const FANUC: HandWritten = {
  language: "fanuc-ls",
  robot: "fanuc_lrmate200id",
  main: "PICK_1.LS",
  points: ["P[1]", "P[2]", "P[3]"],
  files: [
    {
      name: "PICK_1.LS",
      text: [
        "/PROG  PICK_1",
        "/ATTR",
        "OWNER\t\t= MNEDITOR;",
        'COMMENT\t\t= "pick \u90e8\u54c1";',
        "LINE_COUNT\t= 8;",
        "PROTECT\t\t= READ_WRITE;",
        "DEFAULT_GROUP\t= 1,*,*,*,*;",
        "/MN",
        "   1:  !P[1] is home ;",
        "   2:  UFRAME_NUM=0 ;",
        "   3:  UTOOL_NUM=1 ;",
        "   4:J P[1:home] 50% FINE    ;",
        "   5:L P[2] 200mm/sec FINE    ;",
        "   6:C P[3]    ",
        "    :  P[2] 100mm/sec FINE    ;",
        "   7:  WAIT    .50(sec) ;",
        "   8:J P[1:home] 50% FINE    ;",
        "/POS",
        'P[1:"home"]{',
        "   GP1:",
        "\tUF : 0, UT : 1,\t",
        "\tJ1=     0.000 deg,\tJ2=    10.000 deg,\tJ3=    -5.500 deg,",
        "\tJ4=     0.000 deg,\tJ5=   -60.000 deg,\tJ6=     -.384 deg",
        "};",
        "P[2]{",
        "   GP1:",
        "\tUF : 0, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',",
        "\tX =   420.000  mm,\tY =   -20.500  mm,\tZ =   150.250  mm,",
        "\tW =   180.000 deg,\tP =      .000 deg,\tR =     0.000 deg",
        "};",
        "P[3]{",
        "   GP1:",
        "\tUF : 0, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',",
        "\tX =   430.000  mm,\tY =    20.500  mm,\tZ =   180.250  mm,",
        "\tW =   180.000 deg,\tP =     0.000 deg,\tR =     0.000 deg",
        "};",
        "/END",
        "",
      ].join("\r\n"),
    },
  ],
};

export const HAND_WRITTEN: readonly HandWritten[] = [KRL, RAPID, URSCRIPT, FANUC];
