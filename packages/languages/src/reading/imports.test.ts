import { degrees, everyStep, robotById, unrolled, type Program } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { dialectById } from "../index.ts";
import { FLOW_GRAMMARS, flowText, randomFlow, type FlowProgram } from "../testing/control-flow.ts";
import { disagreement } from "../testing/import-agreement.ts";

const PROGRAMS = 30;

const read = (id: string, text: string, skipUnknown = false) => {
  const dialect = dialectById(id)!;
  const robot = robotById(FLOW_GRAMMARS[id]!.robot)!;
  return dialect.parse(text, robot, undefined, { skipUnknown });
};
/** The first joint of each joint move of a program whose blocks are loops that count, calls and nothing else [°]. */
const firstJoints = (program: Program): number[] =>
  [...unrolled(program)].flatMap(step =>
    step.type === "move" && "q" in step.target ? [Math.round(degrees(step.target.q[0]!))] : [],
  );
const programOf = (id: string, text: string, skipUnknown = false): Program => {
  const parsed = read(id, text, skipUnknown);
  if (parsed.kind === "not-understood") throw new Error(JSON.stringify(parsed.faults));
  return parsed.program;
};
const textOf = (id: string, flow: FlowProgram): string => flowText(flow, FLOW_GRAMMARS[id]!.grammar);
const LANGUAGES = Object.keys(FLOW_GRAMMARS);
const hasAngles = (id: string): boolean => id !== "inform" && id !== "urscript";

describe("a program that tells its rounds apart", () => {
  const flow: FlowProgram = {
    main: [{ kind: "call" }, { kind: "call" }],
    routine: [
      {
        kind: "if-below",
        variable: "n",
        limit: 1,
        then: [{ kind: "move", to: 0 }],
        otherwise: [{ kind: "move", to: 1 }],
      },
      { kind: "add", by: 1 },
    ],
  };
  test.each(LANGUAGES.filter(hasAngles))("a routine that is called in another state is not its first pass (%s)", id => {
    expect(firstJoints(programOf(id, textOf(id, flow)))).toEqual([10, 20]);
  });
  test.each(LANGUAGES.filter(hasAngles))("a loop whose body hangs on its counter is not its first pass (%s)", id => {
    const loop: FlowProgram = {
      main: [
        {
          kind: "for",
          depth: 0,
          times: 3,
          body: [
            {
              kind: "if-below",
              variable: 0,
              limit: 3,
              then: [{ kind: "move", to: 0 }],
              otherwise: [{ kind: "move", to: 1 }],
            },
          ],
        },
      ],
      routine: [],
    };
    expect(firstJoints(programOf(id, textOf(id, loop)))).toEqual([10, 10, 20]);
  });
  test.each(LANGUAGES)("a decision by an input inside a loop that is written out stays a decision (%s)", id => {
    const loop: FlowProgram = {
      main: [
        {
          kind: "for",
          depth: 0,
          times: 2,
          body: [
            {
              kind: "if-input",
              input: 0,
              then: [{ kind: "move", to: 2 }],
              otherwise: [{ kind: "move", to: 3 }],
            },
            {
              kind: "if-below",
              variable: 0,
              limit: 2,
              then: [{ kind: "move", to: 0 }],
              otherwise: [{ kind: "move", to: 1 }],
            },
          ],
        },
      ],
      routine: [],
    };
    const decisions = [...everyStep(programOf(id, textOf(id, loop)))].filter(step => step.type === "if");
    expect(decisions).toHaveLength(2);
    for (const each of decisions) expect(each).toMatchObject({ then: [{ type: "move" }], else: [{ type: "move" }] });
  });
  test("one endless loop whose rounds differ is refused with the line, both values and the way out", () => {
    const parsed = read(
      "rapid",
      textOf("rapid", flow)
        .replace("PROC main()", "PROC main()\nWHILE TRUE DO")
        .replace("away;\naway;", "away;\nENDWHILE"),
    );
    expect(parsed).toMatchObject({
      kind: "not-understood",
      faults: [
        {
          line: 16,
          sentence: expect.stringMatching(/\[20\.00.*\[10\.00.*`run` executes the text as it stands\.$/) as string,
        },
      ],
    });
  });
  test.each(LANGUAGES)("ids are unique whatever is written out (%s)", id => {
    for (let seed = 1; seed <= PROGRAMS; seed++) {
      const ids = Array.from(everyStep(programOf(id, textOf(id, randomFlow(seed)))), step => step.id);
      expect(new Set(ids).size).toBe(ids.length);
    }
  });
});

describe("inputs", () => {
  test.each(["krl", "inform"])("IF on an input keeps both sides (%s)", id => {
    const text = textOf(id, {
      main: [
        { kind: "move", to: 0 },
        { kind: "if-input", input: 1, then: [{ kind: "move", to: 1 }], otherwise: [{ kind: "output", on: true }] },
        { kind: "move", to: 2 },
      ],
      routine: [],
    });
    const { steps } = programOf(id, text);
    expect(steps.map(({ type }) => type)).toEqual(["move", "if", "move"]);
    expect(steps[1]).toMatchObject({
      when: { is: true },
      then: [{ type: "move" }],
      else: [{ type: "set", to: true }],
    });
  });
  test("KRL: a loop that waits for an input is a wait for it", () => {
    const text = FLOW_GRAMMARS["krl"]!.grammar.text(
      ["PTP XP0", "WHILE NOT $IN[3]", "ENDWHILE", "PTP XP1"],
      ["PTP XP2"],
    );
    expect(programOf("krl", text).steps.map(step => (step.type === "wait-for" ? step.when : step.type))).toEqual([
      "move",
      { signal: "in_3", is: true },
      "move",
    ]);
  });
});

test("URScript: a parameter that is given a value leaves the global of its name alone", () => {
  const text = [
    "def flow():",
    "  global x = 0.1",
    "  def away(x):",
    "    x = x + 0.5",
    "    movej([x, -1.57, 1.57, -1.57, -1.57, 0])",
    "  end",
    "  away(0.2)",
    "  movej([x, -1.57, 1.57, -1.57, -1.57, 0])",
    "end",
    "",
  ].join("\n");
  expect(firstJoints(programOf("urscript", text))).toEqual([40, 6]);
});

describe("an import does what its text does", () => {
  test.each(Object.entries(FLOW_GRAMMARS))(
    `${PROGRAMS} generated programs with counters, state, inputs, loops and calls: 0 disagreements, all imported (%s)`,
    (id, { robot: robotId, grammar }) => {
      const dialect = dialectById(id)!;
      const robot = robotById(robotId)!;
      const refused: string[] = [];
      for (let seed = 1; seed <= PROGRAMS; seed++) {
        const text = flowText(randomFlow(seed), grammar);
        const parsed = dialect.parse(text, robot);
        if (parsed.kind === "not-understood") {
          refused.push(`seed ${seed}: line ${parsed.faults[0]!.line}: ${parsed.faults[0]!.sentence}\n${text}`);
          continue;
        }
        expect(disagreement(dialect, text, parsed, robot, [11, 12, 13, 14]), text).toBeUndefined();
      }
      expect(refused).toEqual([]);
    },
  );
});
