import { seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { Machine, readScript, type ScriptFunction, type Value } from "./index.ts";

interface Run {
  readonly notes: Value[];
  readonly cycles: number;
  readonly end: string;
}
/** Runs a script for at most so many cycles; `note(x)` is written down. */
function run(lines: readonly string[], most = 50): Run {
  const read = readScript(`${lines.join("\n")}\n`);
  const notes: Value[] = [];
  if (read.kind === "not-understood")
    return { notes, cycles: 0, end: `${read.fault.line}:${read.fault.column} ${read.fault.sentence}` };
  const note: ScriptFunction = args => {
    notes.push(args.value(0, "x"));
    return null;
  };
  const sync: ScriptFunction = function* () {
    yield;
    return null;
  };
  const machine = new Machine(
    read.script,
    { note, sync, named: args => args.number(1, "b", 7) - args.number(0, "a") },
    thread => {
      notes.push(`killed ${thread}`);
    },
  );
  for (let cycles = 1; cycles <= most; cycles++) {
    const state = machine.cycle();
    if (state.kind !== "running")
      return {
        notes,
        cycles,
        end: state.kind === "done" ? "done" : `${state.fault.line}:${state.fault.column} ${state.fault.sentence}`,
      };
  }
  return { notes, cycles: most, end: "running" };
}
const body = (...lines: string[]): string[] => ["def a():", ...lines, "end"];
const notes = (...lines: string[]): Value[] => {
  const { notes: seen, end } = run(body(...lines));
  expect(end).toBe("done");
  return seen;
};

describe("the machine for control scripts", () => {
  test("numbers, truth and texts, with the usual precedence", () => {
    expect(
      notes(
        "note(1 + 2 * 3 - 8 / 4)",
        "note(-(2 + 3) % 3)",
        "note(not 1 == 2 and (False or 3 >= 3))",
        'note("a" + "b")',
        "note(1.5e-3)",
        "note(.5)",
        "note(2 < 1 xor True)",
      ),
    ).toEqual([5, -2, true, "ab", 0.0015, 0.5, true]);
  });

  test("lists add, subtract and scale item by item; items are read and written; what is given on is a copy", () => {
    expect(
      notes(
        "q = [1, 2, 3]",
        "w = q",
        "w[1] = 9",
        "note(q)",
        "note(w)",
        "note(q + w)",
        "note(2 * q - [1, 1, 1])",
        "note(q[0] + q[2])",
        "p = p[1, 2, 3, 0, 0, 0]",
        "p[0] = 5",
        "note(p)",
        "note(p[2])",
      ),
    ).toEqual([[1, 2, 3], [1, 9, 3], [2, 11, 6], [1, 3, 5], 4, { pose: [5, 2, 3, 0, 0, 0] }, 3]);
  });

  test("decisions, loops, break and continue; a line may go on after the sign of an assignment", () => {
    expect(
      notes(
        "i =",
        "# a comment in between",
        "0",
        "while True:",
        "i = i + 1",
        "if i == 2:",
        "continue",
        "elif i > 4:",
        "break",
        "else:",
        "note(i)",
        "end",
        "end",
        "note(-i)",
      ),
    ).toEqual([1, 3, 4, -5]);
  });

  test("routines take values by place and by name, and return them; what they name first is their own", () => {
    expect(
      notes(
        "x = 1",
        "global y = 2",
        "def f(a, b):",
        "local x = 10",
        "y = y + a",
        "z = 99",
        "return a + b + x",
        "end",
        "note(f(1, b=2))",
        "note([x, y])",
        "note(named(2))",
        "note(named(b=5, a=1))",
      ),
    ).toEqual([13, [1, 3], 5, 4]);
    expect(run(body("def f():", "z = 1", "end", "f()", "note(z)")).end).toBe('6:6 "z" has no value yet.');
  });

  test("threads take turns at sync; kill and join end them; a program ends with its body", () => {
    const {
      notes: seen,
      cycles,
      end,
    } = run(
      body(
        "global n = 0",
        "thread t():",
        "while True:",
        "n = n + 1",
        "sync()",
        "end",
        "end",
        "h = run t()",
        "sync()",
        "sync()",
        "kill h",
        "note(n)",
        "sync()",
        "note(n)",
        "j = run t()",
      ),
    );
    // The body syncs twice; the thread counts once each time it has its turn.
    expect([seen, end]).toEqual([["killed 2", 2, 2], "done"]);
    expect(cycles).toBe(4);
    expect(notes("global n = 0", "thread t():", "sync()", "n = 5", "end", "h = run t()", "join h", "note(n)")).toEqual([
      5,
    ]);
  });

  test("a thread in a critical section is alone until it leaves it", () => {
    expect(
      notes(
        "thread t():",
        'note("t")',
        "end",
        "enter_critical",
        "h = run t()",
        "sync()",
        'note("a")',
        "exit_critical",
        "sync()",
      ),
    ).toEqual(["a", "t"]);
  });

  test("halt ends everything, from a thread too", () => {
    expect(
      run(body("thread t():", "sync()", "halt", "end", "h = run t()", "while True:", "sync()", "end")),
    ).toMatchObject({ end: "done", cycles: 2 });
  });

  test("a loop without an end takes cycles and not the machine", () => {
    expect(run(body("i = 0", "while True:", "i = i + 1", "end"), 5)).toMatchObject({ end: "running", cycles: 5 });
    expect(run(body("while True:", "end"), 5)).toMatchObject({ end: "running" });
  });

  test("faults name their place", () => {
    expect(run(body("x = 1 +", "end")).end).toMatch(/^3:1 A value is expected/);
    expect(run(body("note(1, ")).end).toMatch(/^3:1 /);
    expect(run(body("dance()")).end).toBe('2:1 "dance" is no function of this controller.');
    expect(run(body("x = 1 / 0")).end).toBe("2:7 The divisor is 0.");
    expect(run(body("x = [1][3]")).end).toBe("2:8 There is no item 3 in 1.");
    expect(run(body("if 1:", "end")).end).toBe("2:4 True or False is expected, and a number is given.");
    expect(run(body("x = $")).end).toBe('2:5 "$" stands where no script has it.');
    expect(run(body("def f():", "f()", "end", "f()")).end).toMatch(/More than 64 calls/);
    expect(
      run(body("thread t():", "while True:", "sync()", "end", "end", "while True:", "h = run t()", "end")).end,
    ).toMatch(/More than 32 threads/);
  });

  test("programs by their head: one that runs beside, bare lines, and a text that is none", () => {
    const sec = readScript("sec beside():\n note(1)\nend\n");
    const bare = readScript("note(1)\n");
    expect(sec.kind === "read" && [sec.script.name, sec.script.isSecondary]).toEqual(["beside", true]);
    expect(bare.kind === "read" && [bare.script.name, bare.script.isSecondary]).toEqual(["unnamed", false]);
    expect(readScript(`x = ${"(".repeat(5000)}`).kind).toBe("not-understood");
    expect(readScript("#".repeat(1 << 21))).toMatchObject({
      kind: "not-understood",
      fault: { sentence: expect.stringMatching(/^A script has at most/) as string },
    });
  });

  test("any text: read or a place and a sentence; what is read runs without a crash", () => {
    const words = [
      "def",
      "a",
      "(",
      ")",
      ":",
      "end",
      "while",
      "if",
      "else",
      "elif",
      "thread",
      "run",
      "kill",
      "=",
      "==",
      "1",
      "2.5",
      "[",
      "]",
      ",",
      "p[",
      "note",
      "sync()",
      "\n",
      "\n",
      "return",
      "global",
      "local",
      "+",
      "-",
      "*",
      "not",
      "enter_critical",
      "True",
      '"t"',
      "#",
      "halt",
      "break",
      "join",
    ];
    for (let seed = 1; seed <= 2000; seed++) {
      const random = seededRandom(seed);
      const text = Array.from(
        { length: 1 + Math.floor(random() * 40) },
        () => words[Math.floor(random() * words.length)]!,
      );
      const { end } = run(seed % 2 === 0 ? body(text.join(" ")) : [text.join(" ")], 5);
      expect(end).toMatch(/^(done|running|\d+:\d+ .+\.)$/);
    }
  });
});
