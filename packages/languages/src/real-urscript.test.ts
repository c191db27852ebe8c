/*
 * What exports of the pendant hold beside the motions: threads, critical sections, calls of other machines. Every
 * program is written for this test; the motions are worked out by hand.
 */
import { robotById, SignalTable, type MoveStep } from "@twincell/core";
import { expect, test } from "vitest";
import { executeText, urScript } from "./index.ts";

const robot = robotById("ur10e")!;
const run = (...lines: string[]): ReturnType<typeof executeText> =>
  executeText(urScript, ["def cell():", ...lines, "end", ""].join("\n"), "cell", robot);
/** Joint angles of every motion, or the first fault. */
function angles(answer: ReturnType<typeof executeText>): unknown {
  if (answer.kind === "not-understood") return `line ${answer.faults[0]!.line}: ${answer.faults[0]!.sentence}`;
  return answer.program.steps
    .filter((step): step is MoveStep => step.type === "move")
    .map(({ target }) => ("q" in target ? target.q.map(x => Math.round(x * 1e6) / 1e6) : "pose"));
}
const COUNTER = [
  "  step_count_1 = 0.0",
  "  thread Step_Counter_1():",
  "    while (True):",
  "      step_count_1 = step_count_1 + 1.0",
  "      sync()",
  "    end",
  "  end",
  "  run Step_Counter_1()",
];

test("the counter thread of an exported program is shown and not executed; the two motions are carried out", () => {
  const answer = run(
    ...COUNTER,
    '  $ 1 "Robot Program"',
    "  enter_critical",
    "  global home=[0.1,-1.2,1.3,-1.6,-1.5,0.2]",
    "  exit_critical",
    '  $ 2 "MoveJ"',
    "  movej(home, a=1.4, v=1.05)",
    "  movej([0.4,-1.2,1.3,-1.6,-1.5,0.2], a=1.4, v=1.05)",
  );
  expect(angles(answer)).toEqual([
    [0.1, -1.2, 1.3, -1.6, -1.5, 0.2],
    [0.4, -1.2, 1.3, -1.6, -1.5, 0.2],
  ]);
  if (answer.kind !== "executed") throw new Error("not executed");
  expect(answer.notExecuted).toEqual([
    {
      line: 3,
      column: 10,
      expected: "one task",
      sentence: "Thread Step_Counter_1 is shown, not executed: it does not move the robot.",
    },
  ]);
});

test("a thread that is started with a handle, killed and joined leaves the motions as they are; that its outputs stay is said", () => {
  const answer = run(
    "  thread lamp():",
    "    while (True):",
    "      set_standard_digital_out(3, True)",
    "      sleep(0.5)",
    "    end",
    "  end",
    "  handle = run lamp()",
    "  movej([0,-1,1,0,1,0])",
    "  kill handle",
    "  join handle",
    "  movej([0,-1,1,0,1,1])",
  );
  expect(angles(answer)).toEqual([
    [0, -1, 1, 0, 1, 0],
    [0, -1, 1, 0, 1, 1],
  ]);
  expect(answer.kind === "executed" && answer.notExecuted[0]!.sentence).toBe(
    "Thread lamp is shown, not executed: it does not move the robot; the outputs that it sets stay as the program leaves them.",
  );
});

test("a thread that moves the robot, and one that changes what the program reads, are refused with their line", () => {
  expect(angles(run("  thread wave():", "    movej([0,-1,1,0,1,0])", "  end", "  run wave()"))).toBe(
    'line 3: Thread wave does "movej" beside the program, which cannot be written one after the other.',
  );
  expect(
    angles(
      run(
        "  n = 0",
        "  thread count():",
        "    n = n + 1",
        "  end",
        "  run count()",
        "  if (n > 3):",
        "    movej([0,-1,1,0,1,0])",
        "  end",
      ),
    ),
  ).toBe('line 4: Thread count changes "n" at a time that nobody knows, and the program reads it.');
});

test("calls of another machine are passed over; a motion that hangs on its answer is refused with the line", () => {
  const before = ['  gripper = rpc_factory("xmlrpc", "http://127.0.0.1:41414")', "  gripper.open(50)"];
  expect(angles(run(...before, "  width = gripper.width()", "  movej([0,-1,1,0,1,0])"))).toEqual([[0, -1, 1, 0, 1, 0]]);
  expect(angles(run(...before, "  turn = gripper.width()", "  movej([turn,-1,1,0,1,0])"))).toBe(
    "line 5: What gripper.width answers in line 4 is not in the text.",
  );
  expect(angles(run("  gripper.open(50)", "  movej([0,-1,1,0,1,0])"))).toBe(
    'line 2: What "gripper" is stands nowhere in the text.',
  );
});

test("a while over a counter with a conditional break and local variables moves four times", () => {
  const text = [
    "  local i = 0",
    "  while (True):",
    "    movej([i * 0.1,-1,1,0,1,0])",
    "    i = i + 1",
    "    if (i == 4):",
    "      break",
    "    end",
    "  end",
  ];
  expect(angles(run(...text))).toEqual([0, 0.1, 0.2, 0.3].map(first => [first, -1, 1, 0, 1, 0]));
});

test("interpreting with inputs given by hand still names the thread", () => {
  const answer = urScript.interpret(["def cell():", ...COUNTER, "  movej([0,-1,1,0,1,0])", "end"].join("\n"), robot);
  if (answer.kind !== "ready") throw new Error(JSON.stringify(answer.faults));
  expect(answer.notExecuted).toHaveLength(1);
  expect([...{ [Symbol.iterator]: () => answer.run(new SignalTable()) }].filter(({ step }) => step)).toHaveLength(1);
});
