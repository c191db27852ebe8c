import { readFileSync } from "node:fs";
import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { jsonFault } from "./json-place.ts";
import { parseProgram, serializeProgram } from "./parse.ts";
import type { Program } from "./program.ts";

const SEED = 20260411;

const good = {
  format: "twincell.program", version: 1, name: "Edges", robot: "staubli_rx90l",
  tools: { torch: { position: [0, 0, 0.1], quaternion: [0, 0, 0, 1] } },
  frames: { carton: { position: [0.6, 0, 0.3], quaternion: [0, 0, 1, 0] } },
  groups: { edge: { name: "Edge 1", recipe: { chord_m: 1e-4, edges: [1, 2] } } },
  steps: [
    { id: "s1", type: "move", path: "ptp", target: { q: [0, -1.5, 1.5, 0, 0, 0] }, speed: { ratio: 0.5 }, blend_m: 0 },
    {
      id: "s2", type: "move", path: "circ", group: "edge", name: "Round",
      target: { pose: { position: [0, 0, 0], quaternion: [1, 0, 0, 0] }, frame: "carton", tool: "torch", branch: { shoulder: "front", elbow: "up", wrist: "positive" } },
      via: { pose: { position: [0.1, 0, 0], quaternion: [1, 0, 0, 0] }, frame: "world", tool: "flange" }, speed: { mps: 0.1 }, blend_m: 0.005,
    },
    { id: "s3", type: "wait", s: 0.5 },
    { id: "s4", type: "gripper", closed: true },
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
const firstStep = (fields: object): unknown => changed(draft => ({ ...draft, steps: [{ ...draft.steps[0], ...fields }] }));

describe("parseProgram", () => {
  test("reads every step type and gives back what it was given", () => {
    const answer = parseProgram(good);
    expect(answer).toEqual({ kind: "program", program: good });
  });

  test("what is missing gets its default", () => {
    const bare = { format: good.format, version: 1, robot: "staubli_rx90l", steps: [{ id: "a", type: "move", path: "lin", target: { pose: { position: [1, 0, 0], quaternion: [0, 0, 0, 1] } }, speed: { mps: 0.1 } }] };
    expect(parseProgram(bare)).toMatchObject({ program: { name: "Program", tools: {}, frames: {}, groups: {}, steps: [{ blend_m: 0, target: { frame: "world", tool: "flange" } }] } });
  });

  test.each<[string, unknown, string, string]>([
    ["no object", 7, "", "The program is an object; here it is 7."],
    ["another format", { format: "twincell.cell" }, "format", "A program says \"format\": \"twincell.program\"; this one says \"twincell.cell\"."],
    ["a newer version", { ...good, version: 3 }, "version", "The program is of version 3; this release reads versions up to 1."],
    ["joint count", firstStep({ target: { q: [0, 0, 0] } }), "steps[0].target.q", "The target of step “s1” has 3 joint angles; staubli_rx90l has 6 joints."],
    ["NaN", firstStep({ target: { q: [0, 0, Number.NaN, 0, 0, 0] } }), "steps[0].target.q[2]", "Number 3 of the list of joint angles of the target of step “s1” is a finite number [rad]; here it is NaN."],
    ["infinity", firstStep({ blend_m: Number.POSITIVE_INFINITY }), "steps[0].blend_m", "The blend of step “s1” is a finite number [m]; here it is Infinity."],
    ["unknown type", firstStep({ type: "weld" }), "steps[0].type", "Step “s1” is of type \"weld\"; a step is a \"move\", a \"wait\" or a \"gripper\"."],
    ["unknown tool", firstStep({ target: { pose: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] }, frame: "world", tool: "laser" } }), "steps[0].target.tool", "The target of step “s1” names the tool “laser”, which the program does not have; it has flange, torch."],
    ["unknown frame", firstStep({ target: { pose: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] }, frame: "toString", tool: "torch" } }), "steps[0].target.frame", "The target of step “s1” names the frame “toString”, which the program does not have; it has world, carton."],
    ["duplicate id", changed(draft => { draft.steps[1]!.id = "s1"; }), "steps[1].id", "Step “s1” exists twice: as number 1 and as number 2."],
    ["no id", firstStep({ id: "" }), "steps[0].id", "The id of step 1 is a text that is not empty; here it is \"\"."],
    ["no speed", firstStep({ speed: undefined }), "steps[0].speed", "Step “s1” has no speed; give it a ratio, mps or time_s."],
    ["two speeds", firstStep({ speed: { ratio: 1, mps: 1 } }), "steps[0].speed", "The speed of step “s1” is exactly one of ratio, mps and time_s; here are 2 of them."],
    ["speed 0", firstStep({ speed: { mps: 0 } }), "steps[0].speed.mps", "The speed of step “s1” is more than 0 m/s; here it is 0."],
    ["a spelling mistake", firstStep({ blend: 0.01 }), "steps[0].blend", "Step “s1” has no field “blend”; it can have id, type, name, group, path, target, via, speed, blend_m."],
    ["a circ without via", firstStep({ path: "circ" }), "steps[0].via", "Step “s1” is a circular move and names no point to pass through."],
    ["quaternion of no length", changed(draft => { draft.tools.torch.quaternion = [0, 0, 0, 0]; }), "tools.torch.quaternion", "The quaternion of the pose of tool “torch” has length 1; here it has 0.000."],
    ["a moved world", changed(draft => ({ ...draft, frames: { ...draft.frames, world: draft.frames.carton } })), "frames.world", "The frame “world” always exists and cannot be moved; give yours another name."],
    ["a negative wait", changed(draft => ({ ...draft, steps: [{ id: "w", type: "wait", s: -1 }] })), "steps[0].s", "Step “w” waits -1 s; a wait is 0 s or longer."],
  ])("names the place and the number: %s", (_name, value, path, sentence) => {
    expect(faultsOf(value)).toContainEqual({ path, sentence });
  });

  test("JSON text with a syntax error: line and column", () => {
    expect(faultsOf("{\n \"format\": \"twincell.program\",\n \"steps\": [1, 2,]\n}")).toEqual([
      { path: "line 3, column 17", sentence: "Line 3, column 17: a value was expected, but there is “]”." },
    ]);
    expect(faultsOf("")).toEqual([{ path: "line 1, column 1", sentence: "Line 1, column 1: a value was expected, but there is the end of the text." }]);
  });

  test("serialising and reading again changes nothing", () => {
    const answer = parseProgram(good);
    if (answer.kind !== "program") throw new Error("refused");
    const text = serializeProgram(answer.program);
    expect(parseProgram(text)).toEqual(answer);
    const empty: Program = { ...answer.program, steps: [] };
    expect(parseProgram(serializeProgram(empty))).toEqual({ kind: "program", program: empty });
  });

  test("a name of JavaScript's own is a name like any other", () => {
    const text = JSON.stringify(good).replaceAll("\"torch\"", "\"__proto__\"");
    const answer = parseProgram(text);
    expect(answer.kind).toBe("program");
    if (answer.kind === "program") expect(parseProgram(serializeProgram(answer.program))).toEqual(answer);
  });

  test("never throws, whatever it is given", () => {
    const trap = { get format(): string { throw new Error("trap"); } };
    expect(parseProgram(trap).kind).toBe("not-a-program");
    expect(parseProgram(`${"[".repeat(200_000)}${"]".repeat(200_000)}`).kind).toBe("not-a-program");
    fc.assert(fc.property(fc.anything(), value => { expect(parseProgram(value).kind).toBe("not-a-program"); }), { seed: SEED, numRuns: 500 });
    fc.assert(fc.property(fc.string(), text => { expect(parseProgram(text).kind).toBe("not-a-program"); }), { seed: SEED, numRuns: 500 });
  });

  test("a good program with any one value replaced is read or refused with sentences, never thrown", () => {
    const places: string[][] = [];
    const walk = (value: unknown, path: string[]): void => {
      if (path.length > 0) places.push(path);
      if (value !== null && typeof value === "object") for (const [key, part] of Object.entries(value)) walk(part, [...path, key]);
    };
    walk(good, []);
    const replace = (value: unknown, path: readonly string[], by: unknown): unknown => {
      const [key, ...rest] = path;
      if (key === undefined) return by;
      if (Array.isArray(value)) return value.map((part, i) => (String(i) === key ? replace(part, rest, by) : part));
      if (value === null || typeof value !== "object") return value;
      return Object.fromEntries(Object.entries(value).map(([k, part]) => [k, k === key ? replace(part, rest, by) : part]));
    };
    fc.assert(fc.property(fc.constantFrom(...places), fc.oneof(fc.anything(), fc.double()), (path, by) => {
      const answer = parseProgram(replace(good, path, by));
      if (answer.kind === "not-a-program") {
        expect(answer.faults.length).toBeGreaterThan(0);
        for (const fault of answer.faults) expect(fault.sentence).toMatch(/^[A-ZN“].*\.$/s);
      }
    }), { seed: SEED, numRuns: 2000 });
  });
});

describe("jsonFault", () => {
  test("agrees with JSON.parse on what is JSON", () => {
    const isJson = (text: string): boolean => { try { JSON.parse(text); return true; } catch { return false; } };
    const spoilt = fc.tuple(fc.json(), fc.nat(), fc.constantFrom("", ",", "}", "]", "\"", "\\", "1", ".", "e", ":", "\u0001", "-"))
      .map(([text, at, by]) => { const i = at % (text.length + 1); return text.slice(0, i) + by + text.slice(i + (by === "" ? 1 : 0)); });
    fc.assert(fc.property(fc.oneof(spoilt, fc.string(), fc.json()), text => { expect(jsonFault(text) === undefined).toBe(isJson(text)); }), { seed: SEED, numRuns: 3000 });
  });
});

describe("docs/program.schema.json", () => {
  interface Schema { readonly properties?: Readonly<Record<string, Schema & { readonly const?: unknown }>>; readonly oneOf?: readonly Schema[]; readonly $defs?: Readonly<Record<string, Schema>> }
  const schema = JSON.parse(readFileSync(new URL("../../../../docs/program.schema.json", import.meta.url), "utf8")) as Schema;
  /** The fields the reader names when it meets one it does not know. */
  const readerKnows = (value: unknown): string[] => {
    const found = faultsOf(value).map(fault => /has no field “zz”; it can have (.*)\.$/.exec(fault.sentence)?.[1]).find(list => list !== undefined);
    return (found ?? "").split(", ").sort();
  };
  const fieldsOf = (part: Schema | undefined): string[] => Object.keys(part?.properties ?? {}).sort();

  test("names the fields the reader knows, no more and no fewer", () => {
    expect(fieldsOf(schema)).toEqual(readerKnows({ ...good, zz: 1 }));
    const kinds = schema.$defs?.step?.oneOf ?? [];
    expect(kinds.map(kind => kind.properties?.type?.const)).toEqual(["move", "wait", "gripper"]);
    const samples = [good.steps[0], good.steps[2], good.steps[3]];
    kinds.forEach((kind, i) => { expect(fieldsOf(kind)).toEqual(readerKnows({ ...good, steps: [{ ...samples[i], zz: 1 }] })); });
    expect(fieldsOf(schema.$defs?.poseTarget)).toEqual(readerKnows(firstStep({ target: { pose: good.tools.torch, zz: 1 } })));
    expect(fieldsOf(schema.$defs?.jointTarget)).toEqual(readerKnows(firstStep({ target: { q: [], zz: 1 } })));
    expect(fieldsOf(schema.$defs?.pose)).toEqual(readerKnows({ ...good, tools: { torch: { ...good.tools.torch, zz: 1 } } }));
  });
});
