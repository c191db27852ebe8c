import { seededRandom, type Random } from "@twincell/core";

/**
 * A program with control flow before it is text of any language: one variable n, two inputs, one output, one routine.
 */
export type FlowStatement =
  | { readonly kind: "move"; readonly to: number }
  | { readonly kind: "output"; readonly on: boolean }
  /** n = n + by */
  | { readonly kind: "add"; readonly by: number }
  | {
      readonly kind: "if-input";
      readonly input: number;
      readonly then: readonly FlowStatement[];
      readonly otherwise: readonly FlowStatement[];
    }
  | {
      readonly kind: "if-below";
      /** The variable n, or the counter of the loop around at that depth. */
      readonly variable: "n" | 0 | 1;
      readonly limit: number;
      readonly then: readonly FlowStatement[];
      readonly otherwise: readonly FlowStatement[];
    }
  | { readonly kind: "for"; readonly depth: 0 | 1; readonly times: number; readonly body: readonly FlowStatement[] }
  /** Adds 1 to n at the end of each round. */
  | { readonly kind: "while"; readonly limit: number; readonly body: readonly FlowStatement[] }
  | { readonly kind: "call" };
export interface FlowProgram {
  readonly main: readonly FlowStatement[];
  readonly routine: readonly FlowStatement[];
}

const STATEMENTS = 4;
const DEEP = 3;

/** The same program for the same seed. It always ends: n only grows. */
export function randomFlow(seed: number): FlowProgram {
  const random = seededRandom(seed);
  return { main: block(random, 0, 0, true), routine: block(random, 1, 2, false) };
}

const below = (random: Random, count: number): number => Math.floor(random() * count);

function block(random: Random, deep: number, loops: 0 | 1 | 2, calls: boolean): FlowStatement[] {
  const list: FlowStatement[] = [];
  for (let i = 1 + below(random, STATEMENTS); i > 0; i--) list.push(statement(random, deep, loops, calls));
  return list;
}

function statement(random: Random, deep: number, loops: 0 | 1 | 2, calls: boolean): FlowStatement {
  const sort = random();
  const inside = (more: 0 | 1 = 0): FlowStatement[] =>
    block(random, deep + 1, Math.min(2, loops + more) as 0 | 1 | 2, calls);
  if (deep < DEEP) {
    if (sort < 0.12)
      return { kind: "if-input", input: below(random, 2), then: inside(), otherwise: random() < 0.5 ? inside() : [] };
    if (sort < 0.26) {
      const inLoop = calls && loops > 0 && random() < 0.6;
      const variable = inLoop ? (below(random, loops) as 0 | 1) : "n";
      return { kind: "if-below", variable, limit: 1 + below(random, 4), then: inside(), otherwise: inside() };
    }
    if (sort < 0.4 && loops < 2 && calls)
      return { kind: "for", depth: loops as 0 | 1, times: 1 + below(random, 3), body: inside(1) };
    if (sort < 0.48) return { kind: "while", limit: 1 + below(random, 4), body: inside() };
  }
  if (sort < 0.6 && calls) return { kind: "call" };
  if (sort < 0.7) return { kind: "add", by: 1 + below(random, 2) };
  if (sort < 0.78) return { kind: "output", on: random() < 0.5 };
  return { kind: "move", to: below(random, 4) };
}

/** How a language says each of them, as lines. */
export interface FlowGrammar {
  readonly move: (to: number) => string;
  readonly output: (on: boolean) => string;
  readonly n: string;
  readonly counters: readonly [string, string];
  readonly add: (by: number) => string;
  readonly input: (input: number) => string;
  readonly if: (condition: string) => string;
  readonly else: string;
  readonly endIf: string;
  readonly for: (counter: string, times: number) => string;
  readonly endFor: (counter: string) => string;
  /** Left out where the language has none: the loop is left out with it. */
  readonly while?: (condition: string) => string;
  readonly endWhile?: string;
  readonly call: string;
  readonly less?: string;
  readonly text: (main: readonly string[], routine: readonly string[]) => string;
}

export function flowText({ main, routine }: FlowProgram, grammar: FlowGrammar): string {
  return grammar.text(linesOf(main, grammar), linesOf(routine, grammar));
}

function linesOf(block: readonly FlowStatement[], grammar: FlowGrammar): string[] {
  const less = grammar.less ?? "<";
  return block.flatMap((statement): string[] => {
    switch (statement.kind) {
      case "move":
        return [grammar.move(statement.to)];
      case "output":
        return [grammar.output(statement.on)];
      case "add":
        return [grammar.add(statement.by)];
      case "call":
        return [grammar.call];
      case "if-input":
      case "if-below": {
        const condition =
          statement.kind === "if-input"
            ? grammar.input(statement.input)
            : `${statement.variable === "n" ? grammar.n : grammar.counters[statement.variable]}${less}${statement.limit}`;
        const otherwise = linesOf(statement.otherwise, grammar);
        return [
          grammar.if(condition),
          ...linesOf(statement.then, grammar),
          ...(otherwise.length === 0 ? [] : [grammar.else, ...otherwise]),
          grammar.endIf,
        ];
      }
      case "for": {
        const counter = grammar.counters[statement.depth];
        return [grammar.for(counter, statement.times), ...linesOf(statement.body, grammar), grammar.endFor(counter)];
      }
      case "while":
        return grammar.while === undefined
          ? []
          : [
              grammar.while(`${grammar.n}${less}${statement.limit}`),
              ...linesOf(statement.body, grammar),
              grammar.add(1),
              grammar.endWhile!,
            ];
    }
  });
}

const J1_DEG = [10, 20, 30, 40] as const;
const HEAD_LS = '/ATTR\nCOMMENT = "";\n/MN\n';
const posLs = (): string =>
  `/POS\n${J1_DEG.map(
    (angle, i) =>
      `P[${i + 1}]{\n   GP1:\n\tUF : 0, UT : 1,\n\tJ1 = ${angle} deg, J2 = 0 deg, J3 = 0 deg,\n\tJ4 = 0 deg, J5 = -90 deg, J6 = 0 deg\n};\n`,
  ).join("")}/END\n`;
const val3 = (name: string, lines: readonly string[]): string =>
  `<Programs><Program name="${name}" access="public"><Locals><Local name="l_a" type="num" xsi:type="array" size="1"/><Local name="l_b" type="num" xsi:type="array" size="1"/></Locals><Code><![CDATA[\nbegin\n${lines.join("\n")}\nend\n]]></Code></Program></Programs>\n`;
const val3Data = (name: string, type: string, value: string): string =>
  `<Data name="${name}" access="private" xsi:type="array" type="${type}" size="1"><Value key="0" ${value}/></Data>\n`;
const inform = (name: string, lines: readonly string[]): string =>
  [
    "/JOB",
    `//NAME ${name}`,
    "//POS",
    "///NPOS 4,0,0,0,0,0",
    "///TOOL 0",
    "///POSTYPE BASE",
    "///RECTAN",
    "///RCONF 0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0",
    ...J1_DEG.map((_, i) => `C0000${i}=${370 - 10 * i}.000,${40 + 30 * i}.000,305.000,180.0000,0.0000,10.0000`),
    "//INST",
    "///DATE 2026/01/01 00:00",
    "///ATTR SC,RW,RJ",
    "////FRAME BASE",
    "///GROUP1 RB1",
    "NOP",
    ...lines,
    "END",
    "",
  ].join("\n");

/** Robot and grammar of each language that has loops and decisions, by its id. */
export const FLOW_GRAMMARS: Readonly<Record<string, { readonly robot: string; readonly grammar: FlowGrammar }>> = {
  rapid: {
    robot: "abb_irb120",
    grammar: {
      move: to => `MoveAbsJ p${to},v500,fine,tool0;`,
      output: on => `SetDO lamp,${on ? 1 : 0};`,
      n: "n",
      counters: ["a", "b"],
      add: by => `n:=n+${by};`,
      input: input => `DInput(di${input})=1`,
      if: condition => `IF ${condition} THEN`,
      else: "ELSE",
      endIf: "ENDIF",
      for: (counter, times) => `FOR ${counter} FROM 1 TO ${times} DO`,
      endFor: () => "ENDFOR",
      while: condition => `WHILE ${condition} DO`,
      endWhile: "ENDWHILE",
      call: "away;",
      text: (main, routine) =>
        [
          "MODULE Flow",
          "VAR num n:=0;",
          ...J1_DEG.map((a, i) => `CONST jointtarget p${i}:=[[${a},0,0,0,90,0],[9E9,9E9,9E9,9E9,9E9,9E9]];`),
          "PROC main()",
          ...main,
          "ENDPROC",
          "PROC away()",
          ...routine,
          "ENDPROC",
          "ENDMODULE",
          "",
        ].join("\n"),
    },
  },
  urscript: {
    robot: "ur10e",
    grammar: {
      move: to => `movej([0.${to + 1}, -1.57, 1.57, -1.57, -1.57, 0])`,
      output: on => `set_standard_digital_out(1, ${on ? "True" : "False"})`,
      n: "n",
      counters: ["a", "b"],
      add: by => `n = n + ${by}`,
      input: input => `get_standard_digital_in(${input})`,
      if: condition => `if ${condition}:`,
      else: "else:",
      endIf: "end",
      for: (counter, times) => `${counter} = 1\nwhile ${counter} <= ${times}:`,
      endFor: counter => `${counter} = ${counter} + 1\nend`,
      while: condition => `while ${condition}:`,
      endWhile: "end",
      call: "away()",
      text: (main, routine) =>
        ["def flow():", "global n = 0", "def away():", ...routine, "end", ...main, "end", ""].join("\n"),
    },
  },
  "fanuc-ls": {
    robot: "fanuc_lrmate200id",
    grammar: {
      move: to => `J P[${to + 1}] 50% FINE`,
      output: on => `DO[5]=${on ? "ON" : "OFF"}`,
      n: "R[1]",
      counters: ["R[2]", "R[3]"],
      add: by => `R[1]=R[1]+${by}`,
      input: input => `DI[${input + 1}]=ON`,
      if: condition => `IF (${condition}) THEN`,
      else: "ELSE",
      endIf: "ENDIF",
      for: (counter, times) => `FOR ${counter}=1 TO ${times}`,
      endFor: () => "ENDFOR",
      call: "CALL AWAY",
      text: (main, routine) => {
        const numbered = (lines: readonly string[]): string =>
          lines.map((line, i) => `${String(i + 1).padStart(4)}:  ${line} ;\n`).join("");
        return `/PROG  FLOW\n${HEAD_LS}${numbered(["R[1]=0", ...main])}${posLs()}/PROG  AWAY\n${HEAD_LS}${numbered(routine)}${posLs()}`;
      },
    },
  },
  val3: {
    robot: "staubli_rx160",
    grammar: {
      move: to => `movej(p${to},flange,m)\nwaitEndMove()`,
      output: on => `lamp=${on}`,
      n: "n",
      counters: ["l_a", "l_b"],
      add: by => `n=n+${by}`,
      input: input => `in${input}==true`,
      if: condition => `if ${condition}`,
      else: "else",
      endIf: "endIf",
      for: (counter, times) => `for ${counter}=1 to ${times} step 1`,
      endFor: () => "endFor",
      while: condition => `while ${condition}`,
      endWhile: "endWhile",
      call: "call away()",
      text: (main, routine) =>
        `${val3("start", ["n=0", ...main])}${val3("away", routine)}<Database><Datas>\n${val3Data("m", "mdesc", 'accel="100" vel="50" decel="100" tmax="99999" rmax="99999" blend="off" leave="50" reach="50"')}${val3Data("n", "num", 'value="0"')}${["lamp", "in0", "in1"].map(name => val3Data(name, "dio", 'link=""')).join("")}${J1_DEG.map((a, i) => val3Data(`p${i}`, "jointRx", `j1="${a}" j2="0" j3="90" j4="0" j5="90" j6="0"`)).join("")}</Datas></Database>\n`,
    },
  },
  "kawasaki-as": {
    robot: "kawasaki_rs007l",
    grammar: {
      move: to => `JMOVE #[${J1_DEG[to]},0,-90,0,-90,0]\nBREAK`,
      output: on => `SIGNAL ${on ? "" : "-"}5`,
      n: "n",
      counters: ["a", "b"],
      add: by => `n = n + ${by}`,
      input: input => `SIG(${1001 + input})`,
      if: condition => `IF ${condition} THEN`,
      else: "ELSE",
      endIf: "END",
      for: (counter, times) => `FOR ${counter} = 1 TO ${times}`,
      endFor: () => "END",
      while: condition => `WHILE ${condition} DO`,
      endWhile: "END",
      call: "CALL away",
      text: (main, routine) =>
        [".PROGRAM flow()", "n = 0", ...main, ".END", ".PROGRAM away()", ...routine, ".END", ""].join("\n"),
    },
  },
  spel: {
    robot: "epson_c4_a601s",
    grammar: {
      move: to => `Go JA(${J1_DEG[to]}, 0, 0, 0, -90, 0)`,
      output: on => `${on ? "On" : "Off"} 5`,
      n: "n",
      counters: ["a", "b"],
      add: by => `n = n + ${by}`,
      input: input => `Sw(${input + 1}) = On`,
      if: condition => `If ${condition} Then`,
      else: "Else",
      endIf: "EndIf",
      for: (counter, times) => `For ${counter} = 1 To ${times}`,
      endFor: counter => `Next ${counter}`,
      while: condition => `Do While ${condition}`,
      endWhile: "Loop",
      call: "Call away",
      text: (main, routine) =>
        [
          "Global Integer n",
          "Function main",
          "Integer a, b",
          "n = 0",
          ...main,
          "Fend",
          "Function away",
          ...routine,
          "Fend",
          "",
        ].join("\n"),
    },
  },
  "melfa-basic": {
    robot: "mitsubishi_rv7fl",
    grammar: {
      move: to => `Mov J${to + 1}`,
      output: on => `M_Out(5)=${on ? 1 : 0}`,
      n: "M1",
      counters: ["M2", "M3"],
      add: by => `M1=M1+${by}`,
      input: input => `M_In(${input + 1})=1`,
      if: condition => `If ${condition} Then`,
      else: "Else",
      endIf: "EndIf",
      for: (counter, times) => `For ${counter} = 1 To ${times}`,
      endFor: counter => `Next ${counter}`,
      while: condition => `While ${condition}`,
      endWhile: "WEnd",
      call: "GoSub *AWAY",
      text: (main, routine) =>
        [
          ...["M1=0", ...main, "End", "*AWAY", ...routine, "Return"].flatMap(line => line.split("\n")),
          ...J1_DEG.map((a, i) => `J${i + 1}=(${a},0,90,0,90,0)`),
          "",
        ].join("\n"),
    },
  },
  pacscript: {
    robot: "denso_vs060",
    grammar: {
      move: to => `Move P, @0 J(${J1_DEG[to]}, 0, 90, 0, 90, 0), Speed = 50`,
      output: on => `${on ? "Set" : "Reset"} IO[5]`,
      n: "I[1]",
      counters: ["a", "b"],
      add: by => `I[1] = I[1] + ${by}`,
      input: input => `IO[${input + 1}] = On`,
      if: condition => `If ${condition} Then`,
      else: "Else",
      endIf: "End If",
      for: (counter, times) => `For ${counter} = 1 To ${times}`,
      endFor: counter => `Next ${counter}`,
      while: condition => `Do While ${condition}`,
      endWhile: "Loop",
      call: "Call away",
      text: (main, routine) =>
        [
          "Sub Main",
          "Dim a As Integer",
          "Dim b As Integer",
          "TakeArm Keep = 0",
          "I[1] = 0",
          ...main,
          "GiveArm",
          "End Sub",
          "Sub away",
          ...routine,
          "End Sub",
          "",
        ].join("\n"),
    },
  },
  "v-plus": {
    robot: "staubli_rx90l",
    grammar: {
      move: to => `MOVE #PPOINT(${J1_DEG[to]},-90,90,0,0,0)\nBREAK`,
      output: on => `SIGNAL ${on ? "" : "-"}5`,
      n: "n",
      counters: ["a", "b"],
      add: by => `n = n+${by}`,
      input: input => `SIG(${1001 + input})`,
      if: condition => `IF ${condition} THEN`,
      else: "ELSE",
      endIf: "END",
      for: (counter, times) => `FOR ${counter} = 1 TO ${times}`,
      endFor: () => "END",
      while: condition => `WHILE ${condition} DO`,
      endWhile: "END",
      call: "CALL away()",
      text: (main, routine) =>
        [".PROGRAM flow()", "n = 0", ...main, ".END", ".PROGRAM away()", ...routine, ".END", ""].join("\n"),
    },
  },
  krl: {
    robot: "kuka_kr6_2",
    grammar: {
      move: to => `PTP XP${to}`,
      output: on => `$OUT[5]=${on ? "TRUE" : "FALSE"}`,
      n: "N",
      counters: ["CA", "CB"],
      add: by => `N=N+${by}`,
      input: input => `$IN[${input + 1}]`,
      if: condition => `IF ${condition} THEN`,
      else: "ELSE",
      endIf: "ENDIF",
      for: (counter, times) => `FOR ${counter}=1 TO ${times}`,
      endFor: () => "ENDFOR",
      while: condition => `WHILE ${condition}`,
      endWhile: "ENDWHILE",
      call: "AWAY( )",
      text: (main, routine) =>
        [
          "DEF FLOW( )",
          "BAS(#INITMOV,0)",
          "BAS(#VEL_PTP,50)",
          ...main,
          "END",
          "DEF AWAY( )",
          ...routine,
          "END",
          "DEFDAT FLOW",
          "DECL INT N=0",
          "DECL INT CA=0",
          "DECL INT CB=0",
          ...J1_DEG.map((a, i) => `DECL E6AXIS XP${i}={A1 ${a},A2 -90,A3 90,A4 0,A5 90,A6 0}`),
          "ENDDAT",
          "",
        ].join("\n"),
    },
  },
  inform: {
    robot: "yaskawa_gp8",
    grammar: {
      move: to => `MOVJ C0000${to} VJ=50.00 PL=0`,
      output: on => `DOUT OT#(5) ${on ? "ON" : "OFF"}`,
      n: "I010",
      counters: ["I000", "I001"],
      add: by => `ADD I010 ${by}`,
      input: input => `IN#(${input + 1})=ON`,
      if: condition => `IFTHENEXP ${condition}`,
      else: "ELSE",
      endIf: "ENDIF",
      for: (counter, times) => `FOR ${counter} START= 1 TO ${times}`,
      endFor: counter => `NEXT ${counter}`,
      call: "CALL JOB:AWAY",
      text: (main, routine) => inform("FLOW", ["SET I010 0", ...main]) + inform("AWAY", routine),
    },
  },
};
