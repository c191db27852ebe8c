import { describe, expect, test } from "vitest";
import { flow } from "./flow.ts";
import { lowered } from "./lower.ts";
import { emptyProgram, type Program, type Step } from "./program.ts";
import { holds } from "./signals.ts";

const ALL = { idioms: ["arguments", "late", "timeout", "wait-expression", "truth-values"] } as const;
const wait = (id: string): Step => ({ id, type: "wait", s: 1 });

/** Steps that happen when “part” comes on after so many seconds; a wait that is met takes no time. */
function happens(program: Program, partAt_s: number): string {
  let now_s = 0;
  const signals = { read: (name: string) => name === "part" && now_s >= partAt_s };
  const seen: string[] = [];
  for (const event of flow(program, {
    decide: (when, variable) => holds(when, signals, variable),
    read: signals.read,
  })) {
    if (event.kind !== "step" || event.stands) continue;
    const { step } = event;
    if (step.type === "wait-for") {
      if (!holds(step.when, signals)) now_s = Math.min(partAt_s, now_s + (step.timeout_s ?? Infinity));
      continue;
    }
    if (step.type === "wait") now_s += step.s;
    // Looking again is how a wait is written.
    if (step.type !== "wait" || step.s !== 0.02) seen.push(step.id);
  }
  return seen.join(" ");
}

const program: Program = {
  ...emptyProgram("staubli_rx90l"),
  signals: { part: { kind: "digital-in", address: 1001 } },
  variables: { ready: { type: "bool" }, n: { type: "int", initial: 1 } },
  parameters: { turns: { times: { type: "int" } } },
  routines: {
    turns: [
      { id: "z", type: "assign", variable: "n", to: 0 },
      {
        id: "w",
        type: "while",
        when: { expression: { op: "<", of: [{ variable: "n" }, { variable: "times" }] } },
        steps: [wait("turn"), { id: "i", type: "assign", variable: "n", to: { op: "+", of: [{ variable: "n" }, 1] } }],
      },
    ],
  },
  steps: [
    { id: "f", type: "wait-for", when: { signal: "part", is: true }, timeout_s: 2, late: [wait("late")] },
    {
      id: "a",
      type: "assign",
      variable: "ready",
      to: { op: "and", of: [{ signal: "part" }, { op: "=", of: [{ variable: "n" }, 1] }] },
    },
    { id: "d", type: "if", when: { expression: { variable: "ready" } }, then: [wait("yes")], else: [wait("no")] },
    { id: "c", type: "call", routine: "turns", arguments: { times: { op: "+", of: [{ variable: "n" }, 1] } } },
  ],
};

describe("a program without what a language lacks", () => {
  test.each([0, 1, 1.99, 2.5, 9])("does the same when the part comes after %d s", partAt_s => {
    const plain = lowered(program, ALL);
    expect(happens(plain, partAt_s)).toBe(happens(program, partAt_s));
    expect(happens(program, partAt_s)).toBe(
      partAt_s <= 2 ? "yes turn turn" : partAt_s <= 3 ? "late yes turn turn" : "late no turn turn",
    );
  });

  test("has none of it left, keeps the ids of steps, and leaves a program alone that uses none of it", () => {
    const plain = lowered(program, ALL);
    expect(JSON.stringify(plain)).not.toMatch(/"arguments":|"late":|"timeout_s":|"wait-for"/);
    expect(plain.variables).toMatchObject({ turns_times: { type: "int" }, looks: { type: "int" } });
    expect(new Set(plain.steps.map(step => step.id))).toEqual(new Set(["", "f", "d", "a", "c"]));
    const old: Program = { ...emptyProgram("staubli_rx90l"), steps: [wait("a")] };
    expect(lowered(old, ALL)).toBe(old);
  });
});
