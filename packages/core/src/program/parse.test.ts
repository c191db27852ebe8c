import { readFileSync } from "node:fs";
import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { jsonFault } from "./json-place.ts";
import { parseProgram } from "./parse.ts";
import { serializeProgram } from "./serialize.ts";
import { STEP_TYPES, emptyProgram, type Program } from "./program.ts";

const SEED = 20260411;

const good = {
  format: "twincell.program",
  version: 1,
  name: "Edges",
  robot: "staubli_rx90l",
  tools: { torch: { position: [0, 0, 0.1], quaternion: [0, 0, 0, 1] } },
  frames: { carton: { position: [0.6, 0, 0.3], quaternion: [0, 0, 1, 0] } },
  groups: { edge: { name: "Edge 1", recipe: { chord_m: 1e-4, edges: [1, 2] } } },
  signals: { part: { kind: "digital-in", address: 3 }, lamp: { kind: "digital-out" }, level: { kind: "analogue-in" } },
  pallets: {
    tray: {
      frame: "carton",
      origin: { position: [0, 0, 0], quaternion: [1, 0, 0, 0] },
      rowEnd: [0.2, 0, 0],
      columnEnd: [0.01, 0.3, 0],
      rows: 3,
      columns: 3,
      layers: 2,
      layer_m: 0.05,
      interleave: "odd-rows-shifted",
      order: "rows-zigzag",
    },
  },
  routines: {
    pick: [
      { id: "r1", type: "gripper", closed: true },
      { id: "r2", type: "call", routine: "rest" },
    ],
    rest: [{ id: "r3", type: "wait", s: 1 }],
  },
  steps: [
    { id: "s1", type: "move", path: "ptp", target: { q: [0, -1.5, 1.5, 0, 0, 0] }, speed: { ratio: 0.5 }, blend_m: 0 },
    {
      id: "s2",
      type: "move",
      path: "circ",
      group: "edge",
      name: "Round",
      target: {
        pose: { position: [0, 0, 0], quaternion: [1, 0, 0, 0] },
        frame: "carton",
        tool: "torch",
        branch: { shoulder: "front", elbow: "up", wrist: "positive" },
      },
      via: { pose: { position: [0.1, 0, 0], quaternion: [1, 0, 0, 0] }, frame: "world", tool: "flange" },
      speed: { mps: 0.1 },
      blend_m: 0.005,
    },
    { id: "s3", type: "wait", s: 0.5 },
    { id: "s4", type: "gripper", closed: true },
    { id: "s5", type: "set", signal: "lamp", to: true, pulse_s: 0.2 },
    { id: "s6", type: "wait-for", when: { signal: "part", is: true }, timeout_s: 5 },
    { id: "s7", type: "payload", mass_kg: 2, center_m: [0, 0, 0.05], inertia_kgm2: [0.01, 0.01, 0.02, 0, 0, 0] },
    { id: "s8", type: "message", text: "Tray full." },
    { id: "s9", type: "stop" },
    { id: "s10", type: "comment", text: "One tray" },
    { id: "s11", type: "call", routine: "pick" },
    {
      id: "s12",
      type: "repeat",
      times: 3,
      steps: [{ id: "s13", type: "repeat", times: "forever", steps: [{ id: "s14", type: "wait", s: 1 }] }],
    },
    {
      id: "s15",
      type: "if",
      when: { signal: "level", above: 2.5 },
      then: [{ id: "s16", type: "set", signal: "lamp", to: false }],
      else: [{ id: "s17", type: "wait-for", when: { signal: "level", below: 1 } }],
    },
    {
      id: "s18",
      type: "pallet",
      pallet: "tray",
      steps: [
        {
          id: "s19",
          type: "move",
          path: "lin",
          target: { pose: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] }, frame: "tray", tool: "torch" },
          speed: { mps: 0.1 },
          acceleration: { ratio: 0.5 },
          blend_m: 0,
          blend_ratio: 0.2,
          until: { when: { signal: "part", is: true }, missing: "continue" },
        },
      ],
    },
  ],
};

function faultsOf(value: unknown): readonly { path: string; sentence: string }[] {
  const answer = parseProgram(value);
  if (answer.kind === "program") throw new Error("a program, though a refusal was expected");
  return answer.faults;
}
const changed = (change: (draft: typeof good) => unknown): unknown => {
  const draft = structuredClone(good);
  return change(draft) ?? draft;
};
const firstStep = (fields: object): unknown =>
  changed(draft => ({ ...draft, steps: [{ ...draft.steps[0], ...fields }] }));
const only = (step: object): unknown => changed(draft => ({ ...draft, steps: [step] }));

describe("parseProgram", () => {
  test("reads every step type and gives back what it was given", () => {
    const answer = parseProgram(good);
    expect(answer).toEqual({ kind: "program", program: good });
  });

  test("what is missing gets its default", () => {
    const bare = {
      format: good.format,
      version: 1,
      robot: "staubli_rx90l",
      steps: [
        {
          id: "a",
          type: "move",
          path: "lin",
          target: { pose: { position: [1, 0, 0], quaternion: [0, 0, 0, 1] } },
          speed: { mps: 0.1 },
        },
      ],
    };
    expect(parseProgram(bare)).toMatchObject({
      program: {
        name: "Program",
        tools: {},
        frames: {},
        groups: {},
        signals: {},
        pallets: {},
        routines: {},
        steps: [{ blend_m: 0, target: { frame: "world", tool: "flange" } }],
      },
    });
  });

  test.each<[string, unknown, string, string]>([
    ["no object", 7, "", "The program is an object; here it is 7."],
    [
      "another format",
      { format: "twincell.cell" },
      "format",
      'A program says "format": "twincell.program"; this one says "twincell.cell".',
    ],
    [
      "a newer version",
      { ...good, version: 3 },
      "version",
      "The program is of version 3; this release reads versions up to 2.",
    ],
    [
      "joint count",
      firstStep({ target: { q: [0, 0, 0] } }),
      "steps[0].target.q",
      "The target of step “s1” has 3 joint angles; staubli_rx90l has 6 joints.",
    ],
    [
      "NaN",
      firstStep({ target: { q: [0, 0, Number.NaN, 0, 0, 0] } }),
      "steps[0].target.q[2]",
      "Number 3 of the list of joint angles of the target of step “s1” is a finite number [rad]; here it is NaN.",
    ],
    [
      "infinity",
      firstStep({ blend_m: Number.POSITIVE_INFINITY }),
      "steps[0].blend_m",
      "The blend of step “s1” is a finite number [m]; here it is Infinity.",
    ],
    [
      "unknown type",
      firstStep({ type: "weld" }),
      "steps[0].type",
      'Step “s1” is of type "weld"; a step is one of move, wait, gripper, set, wait-for, payload, message, stop, comment, assign, call, repeat, while, if, pallet.',
    ],
    [
      "unknown tool",
      firstStep({ target: { pose: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] }, frame: "world", tool: "laser" } }),
      "steps[0].target.tool",
      "The target of step “s1” names the tool “laser”, which the program does not have; it has flange, torch.",
    ],
    [
      "unknown frame",
      firstStep({
        target: { pose: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] }, frame: "toString", tool: "torch" },
      }),
      "steps[0].target.frame",
      "The target of step “s1” names the frame “toString”, which the program does not have; it has world, carton.",
    ],
    [
      "duplicate id",
      changed(draft => {
        draft.steps[1]!.id = "s1";
      }),
      "steps[1].id",
      "Step “s1” exists twice: as number 1 and as number 2.",
    ],
    ["no id", firstStep({ id: "" }), "steps[0].id", 'The id of step 1 is a text that is not empty; here it is "".'],
    [
      "no speed",
      firstStep({ speed: undefined }),
      "steps[0].speed",
      "Step “s1” has no speed; give it a ratio, mps or time_s.",
    ],
    [
      "two speeds",
      firstStep({ speed: { ratio: 1, mps: 1 } }),
      "steps[0].speed",
      "The speed of step “s1” is exactly one of ratio, mps and time_s; here are 2 of them.",
    ],
    [
      "speed 0",
      firstStep({ speed: { mps: 0 } }),
      "steps[0].speed.mps",
      "The speed of step “s1” is more than 0 m/s; here it is 0.",
    ],
    [
      "a spelling mistake",
      firstStep({ blend: 0.01 }),
      "steps[0].blend",
      "Step “s1” has no field “blend”; it can have id, type, name, group, path, target, via, speed, acceleration, blend_m, blend_ratio, until.",
    ],
    [
      "a circ without via",
      firstStep({ path: "circ" }),
      "steps[0].via",
      "Step “s1” is a circular move and names no point to pass through.",
    ],
    [
      "quaternion of no length",
      changed(draft => {
        draft.tools.torch.quaternion = [0, 0, 0, 0];
      }),
      "tools.torch.quaternion",
      "The quaternion of the pose of tool “torch” has length 1; here it has 0.000.",
    ],
    [
      "a moved world",
      changed(draft => ({ ...draft, frames: { ...draft.frames, world: draft.frames.carton } })),
      "frames.world",
      "The frame “world” always exists and cannot be moved; give yours another name.",
    ],
    [
      "an unknown type inside a block",
      only({ id: "r", type: "repeat", times: 2, steps: [{ id: "x", type: "weld" }] }),
      "steps[0].steps[0].type",
      'Step “x” is of type "weld"; a step is one of move, wait, gripper, set, wait-for, payload, message, stop, comment, assign, call, repeat, while, if, pallet.',
    ],
    [
      "half a time",
      only({ id: "r", type: "repeat", times: 1.5, steps: [] }),
      "steps[0].times",
      'Step “r” repeats a whole number of times from 0 to 1000000000, or "forever"; here it is 1.5.',
    ],
    [
      "an id used inside a block again",
      only({ id: "r", type: "repeat", times: 1, steps: [{ id: "r", type: "stop" }] }),
      "steps[0].steps[0].id",
      "Step “r” exists twice: as number 1 and as number 2.",
    ],
    [
      "two comparisons",
      only({ id: "w", type: "wait-for", when: { signal: "part", is: true, above: 1 } }),
      "steps[0].when",
      "The condition of step “w” has exactly one of is, above and below; here are 2 of them.",
    ],
    [
      "a pulse of a number",
      only({ id: "w", type: "set", signal: "level", to: 2, pulse_s: 1 }),
      "steps[0].pulse_s",
      "Step “w” sets a number; only true and false can be a pulse.",
    ],
    [
      "an unknown routine",
      only({ id: "w", type: "call", routine: "fly" }),
      "steps[0].routine",
      "Step “w” calls the routine “fly”, which the program does not have; it has pick, rest.",
    ],
    [
      "a routine that calls itself",
      changed(draft => ({
        ...draft,
        routines: {
          ...draft.routines,
          rest: [
            {
              id: "z",
              type: "if",
              when: { signal: "part", is: true },
              then: [{ id: "y", type: "call", routine: "pick" }],
            },
          ],
        },
      })),
      "routines.pick",
      "The routine “pick” calls itself: pick → rest → pick. It would never come back.",
    ],
    [
      "an unknown pallet",
      only({ id: "w", type: "pallet", pallet: "box", steps: [] }),
      "steps[0].pallet",
      "Step “w” names the pallet “box”, which the program does not have; it has tray.",
    ],
    [
      "a pallet inside itself",
      only({
        id: "w",
        type: "pallet",
        pallet: "tray",
        steps: [{ id: "v", type: "pallet", pallet: "tray", steps: [] }],
      }),
      "steps[0].steps[0].pallet",
      "Step “v” visits the pallet “tray” inside itself.",
    ],
    [
      "a place outside its pallet",
      firstStep({ target: { pose: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] }, frame: "tray", tool: "torch" } }),
      "steps[0].target.frame",
      "The target of step “s1” names the pallet “tray” as its frame; that means a place only inside a pallet step of “tray”.",
    ],
    [
      "a pallet named like a frame",
      changed(draft => ({ ...draft, pallets: { carton: draft.pallets.tray } })),
      "pallets.carton",
      "The pallet “carton” has the name of a frame; inside a pallet step the name means its places.",
    ],
    [
      "a shifted pallet of one column",
      changed(draft => ({ ...draft, pallets: { tray: { ...draft.pallets.tray, columns: 1 } } })),
      "pallets.tray.columns",
      "The pallet “tray” has shifted rows, which have one place fewer; it needs 2 columns or more.",
    ],
    [
      "two zones",
      firstStep({ blend_m: 0.01, blend_ratio: 0.1 }),
      "steps[0].blend_ratio",
      "Step “s1” blends by 0.01 m and by a ratio of 0.1; only one of them is not 0.",
    ],
    [
      "an acceleration of 0",
      firstStep({ acceleration: { ratio: 0 } }),
      "steps[0].acceleration.ratio",
      "The acceleration of step “s1” is a ratio above 0 and up to 1 of the joint accelerations; here it is 0.",
    ],
    [
      "another kind of signal",
      changed(draft => ({ ...draft, signals: { ...draft.signals, part: { kind: "fieldbus" } } })),
      "signals.part.kind",
      'The signal “part” is of kind "fieldbus"; a signal is one of digital-in, digital-out, analogue-in, analogue-out.',
    ],
    [
      "a negative payload",
      only({ id: "w", type: "payload", mass_kg: -1, center_m: [0, 0, 0] }),
      "steps[0].mass_kg",
      "The payload of step “w” is 0 kg or more; here it is -1 kg.",
    ],
    [
      "a negative wait",
      changed(draft => ({ ...draft, steps: [{ id: "w", type: "wait", s: -1 }] })),
      "steps[0].s",
      "Step “w” waits -1 s; a wait is 0 s or longer.",
    ],
  ])("names the place and the number: %s", (_name, value, path, sentence) => {
    expect(faultsOf(value)).toContainEqual({ path, sentence });
  });

  test("JSON text with a syntax error: line and column", () => {
    expect(faultsOf('{\n "format": "twincell.program",\n "steps": [1, 2,]\n}')).toEqual([
      { path: "line 3, column 17", sentence: "Line 3, column 17: a value was expected, but there is “]”." },
    ]);
    expect(faultsOf("")).toEqual([
      {
        path: "line 1, column 1",
        sentence: "Line 1, column 1: a value was expected, but there is the end of the text.",
      },
    ]);
  });

  test("serialising and reading again changes nothing", () => {
    const answer = parseProgram(good);
    if (answer.kind !== "program") throw new Error("refused");
    const text = serializeProgram(answer.program);
    expect(parseProgram(text)).toEqual(answer);
    // A line for each step, also inside blocks.
    for (const id of ["s1", "s13", "s17", "r3"])
      expect(text.split("\n").filter(line => line.includes(`"id":"${id}"`))).toHaveLength(1);
    const bare: Program = { ...emptyProgram("staubli_rx90l"), steps: [{ id: "a", type: "stop" }] };
    expect(serializeProgram(bare)).not.toMatch(/signals|pallets|routines/);
    const empty: Program = { ...answer.program, steps: [] };
    expect(parseProgram(serializeProgram(empty))).toEqual({ kind: "program", program: empty });
  });

  test("a name of JavaScript's own is a name like any other", () => {
    const text = JSON.stringify(good).replaceAll('"torch"', '"__proto__"');
    const answer = parseProgram(text);
    expect(answer.kind).toBe("program");
    if (answer.kind === "program") expect(parseProgram(serializeProgram(answer.program))).toEqual(answer);
  });

  test("never throws, whatever it is given", () => {
    const trap = {
      get format(): string {
        throw new Error("trap");
      },
    };
    expect(parseProgram(trap).kind).toBe("not-a-program");
    expect(parseProgram(`${"[".repeat(200_000)}${"]".repeat(200_000)}`).kind).toBe("not-a-program");
    fc.assert(
      fc.property(fc.anything(), value => {
        expect(parseProgram(value).kind).toBe("not-a-program");
      }),
      { seed: SEED, numRuns: 500 },
    );
    fc.assert(
      fc.property(fc.string(), text => {
        expect(parseProgram(text).kind).toBe("not-a-program");
      }),
      { seed: SEED, numRuns: 500 },
    );
  });

  test("a good program with any one value replaced is read or refused with sentences, never thrown", () => {
    const places: string[][] = [];
    const walk = (value: unknown, path: string[]): void => {
      if (path.length > 0) places.push(path);
      if (value !== null && typeof value === "object")
        for (const [key, part] of Object.entries(value)) walk(part, [...path, key]);
    };
    walk(good, []);
    const replace = (value: unknown, path: readonly string[], by: unknown): unknown => {
      const [key, ...rest] = path;
      if (key === undefined) return by;
      if (Array.isArray(value)) return value.map((part, i) => (String(i) === key ? replace(part, rest, by) : part));
      if (value === null || typeof value !== "object") return value;
      return Object.fromEntries(
        Object.entries(value).map(([k, part]) => [k, k === key ? replace(part, rest, by) : part]),
      );
    };
    fc.assert(
      fc.property(fc.constantFrom(...places), fc.oneof(fc.anything(), fc.double()), (path, by) => {
        const answer = parseProgram(replace(good, path, by));
        if (answer.kind === "not-a-program") {
          expect(answer.faults.length).toBeGreaterThan(0);
          for (const fault of answer.faults) expect(fault.sentence).toMatch(/^[A-ZN“].*\.$/s);
        }
      }),
      { seed: SEED, numRuns: 2000 },
    );
  });
});

describe("version 2", () => {
  const newer = {
    format: "twincell.program",
    version: 2,
    name: "Counted",
    robot: "staubli_rx90l",
    signals: { part: { kind: "digital-in", address: 3 }, lamp: { kind: "digital-out" } },
    variables: { count: { type: "int", initial: 3 }, drop: { type: "num", unit: "m" }, ready: { type: "bool" } },
    parameters: { place: { layer: { type: "int" } } },
    routines: {
      place: [
        {
          id: "r1",
          type: "assign",
          variable: "drop",
          to: { op: "*", of: [{ variable: "layer" }, { value: 0.04, unit: "m" }] },
        },
      ],
    },
    steps: [
      { id: "a", type: "assign", variable: "ready", to: { signal: "part" } },
      {
        id: "w",
        type: "while",
        when: { expression: { op: "<", of: [{ variable: "count" }, 9] } },
        steps: [
          {
            id: "c",
            type: "call",
            routine: "place",
            arguments: { layer: { op: "+", of: [{ variable: "count" }, 1] } },
          },
        ],
      },
      {
        id: "p",
        type: "wait-for",
        when: { signal: "part", is: true },
        timeout_s: 2,
        late: [{ id: "l", type: "message", text: "No part." }],
      },
    ],
  };

  test("a program with variables, arguments and steps for being late reads and writes to itself", () => {
    const answer = parseProgram(newer);
    expect(answer).toMatchObject({ kind: "program", program: { ...newer, version: 2 } });
    const text = serializeProgram((answer as Extract<typeof answer, { kind: "program" }>).program);
    const again = parseProgram(text);
    expect(again.kind === "program" && serializeProgram(again.program)).toBe(text);
    expect(text).toContain('"late": [\n   {"id":"l"');
  });

  test("a program that uses nothing new stays version 1, byte for byte, whichever version it says", () => {
    const old = parseProgram(good);
    const lifted = parseProgram({ ...good, version: 2 });
    if (old.kind !== "program" || lifted.kind !== "program") throw new Error("a program was expected");
    expect(serializeProgram(old.program)).toContain('"version": 1');
    expect(serializeProgram(lifted.program)).toBe(serializeProgram(old.program));
    expect(serializeProgram({ ...old.program, variables: {} })).toBe(serializeProgram(old.program));
    expect(serializeProgram({ ...old.program, variables: { n: { type: "int" } } })).toContain('"version": 2');
  });

  test.each([
    ["a variable named as a signal", { variables: { part: { type: "bool" } } }, "variables.part", /name that is taken/],
    [
      "a variable named as an operator",
      { variables: { Mod: { type: "int" } } },
      "variables.Mod",
      /means something else/,
    ],
    ["a unit of a whole number", { variables: { n: { type: "int", unit: "m" } } }, "variables.n.unit", /only a num/],
    ["half a whole number", { variables: { n: { type: "int", initial: 0.5 } } }, "variables.n.initial", /whole number/],
    ["parameters of nobody", { parameters: { pick: { n: { type: "int" } } } }, "parameters.pick", /no routine “pick”/],
    [
      "an assignment to nothing",
      { steps: [{ id: "a", type: "assign", variable: "cuont", to: 1 }] },
      "steps[0].variable",
      /it has count, drop, ready/,
    ],
    [
      "a length for a count",
      { steps: [{ id: "a", type: "assign", variable: "count", to: { value: 1, unit: "m" } }] },
      "steps[0].to",
      /a number in m; here a whole number is wanted/,
    ],
    [
      "a call without its argument",
      { steps: [{ id: "a", type: "call", routine: "place" }] },
      "steps[0].arguments",
      /without a value for “layer”/,
    ],
    [
      "an argument that nobody takes",
      { steps: [{ id: "a", type: "call", routine: "place", arguments: { layer: 1, row: 2 } }] },
      "steps[0].arguments.row",
      /it takes layer/,
    ],
    [
      "a parameter outside its routine",
      { steps: [{ id: "a", type: "assign", variable: "count", to: { variable: "layer" } }] },
      "steps[0].to",
      /no variable “layer” here/,
    ],
    [
      "late steps without a limit",
      { steps: [{ id: "a", type: "wait-for", when: { signal: "part", is: true }, late: [] }] },
      "steps[0].late",
      /give it timeout_s/,
    ],
  ])("names the place: %s", (_, change, path, sentence) => {
    expect(faultsOf({ ...newer, ...change })).toContainEqual({ path, sentence: expect.stringMatching(sentence) });
  });
});

describe("jsonFault", () => {
  test("agrees with JSON.parse on what is JSON", () => {
    const isJson = (text: string): boolean => {
      try {
        JSON.parse(text);
        return true;
      } catch {
        return false;
      }
    };
    const spoilt = fc
      .tuple(fc.json(), fc.nat(), fc.constantFrom("", ",", "}", "]", '"', "\\", "1", ".", "e", ":", "\u0001", "-"))
      .map(([text, at, by]) => {
        const i = at % (text.length + 1);
        return text.slice(0, i) + by + text.slice(i + (by === "" ? 1 : 0));
      });
    fc.assert(
      fc.property(fc.oneof(spoilt, fc.string(), fc.json()), text => {
        expect(jsonFault(text) === undefined).toBe(isJson(text));
      }),
      { seed: SEED, numRuns: 3000 },
    );
  });
});

describe("docs/program.schema.json", () => {
  interface Schema {
    readonly properties?: Readonly<Record<string, Schema & { readonly const?: unknown }>>;
    readonly oneOf?: readonly Schema[];
    readonly $defs?: Readonly<Record<string, Schema>>;
  }
  const schema = JSON.parse(
    readFileSync(new URL("../../../../docs/program.schema.json", import.meta.url), "utf8"),
  ) as Schema;
  /** The fields the reader names when it meets one it does not know. */
  const readerKnows = (value: unknown): string[] => {
    const found = faultsOf(value)
      .map(fault => /has no field “zz”; it can have (.*)\.$/.exec(fault.sentence)?.[1])
      .find(list => list !== undefined);
    return (found ?? "").split(", ").sort();
  };
  const fieldsOf = (part: Schema | undefined): string[] => Object.keys(part?.properties ?? {}).sort();

  test("names the fields the reader knows, no more and no fewer", () => {
    expect(fieldsOf(schema)).toEqual(readerKnows({ ...good, zz: 1 }));
    const kinds = schema.$defs?.step?.oneOf ?? [];
    expect(kinds.map(kind => kind.properties?.type?.const)).toEqual([...STEP_TYPES]);
    for (const kind of kinds) {
      const sample = good.steps.find(step => step.type === kind.properties?.type?.const);
      expect(fieldsOf(kind)).toEqual(readerKnows(only({ type: kind.properties?.type?.const, ...sample, zz: 1 })));
    }
    const { part } = good.signals;
    const { tray } = good.pallets;
    const until = { when: { signal: "part", is: true }, zz: 1 };
    expect(fieldsOf(schema.$defs?.poseTarget)).toEqual(
      readerKnows(firstStep({ target: { pose: good.tools.torch, zz: 1 } })),
    );
    expect(fieldsOf(schema.$defs?.jointTarget)).toEqual(readerKnows(firstStep({ target: { q: [], zz: 1 } })));
    expect(fieldsOf(schema.$defs?.pose)).toEqual(
      readerKnows({ ...good, tools: { torch: { ...good.tools.torch, zz: 1 } } }),
    );
    expect(fieldsOf(schema.$defs?.signal)).toEqual(readerKnows({ ...good, signals: { part: { ...part, zz: 1 } } }));
    expect(fieldsOf(schema.$defs?.pallet)).toEqual(readerKnows({ ...good, pallets: { tray: { ...tray, zz: 1 } } }));
    expect(fieldsOf(schema.$defs?.condition)).toEqual(
      readerKnows(only({ id: "a", type: "wait-for", when: { ...until.when, zz: 1 } })),
    );
    expect(fieldsOf(kinds[0]?.properties?.until)).toEqual(readerKnows(firstStep({ until })));
    expect(fieldsOf(kinds[0]?.properties?.acceleration)).toEqual(
      readerKnows(firstStep({ acceleration: { ratio: 1, zz: 1 } })),
    );
  });
});
