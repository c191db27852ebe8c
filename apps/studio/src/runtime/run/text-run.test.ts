import {
  compose,
  flangePose,
  fromUrVector,
  identity,
  manualScheduler,
  pose,
  posesAgree,
  robotById,
  type Pose,
} from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { expect, test } from "vitest";
import { controlStore } from "../../stores/control.ts";
import type { RunStorage } from "../history/archive.ts";
import { showJoints, theLive } from "../live.ts";
import { readText } from "../planning/reading.ts";
import { controlCell } from "./run.ts";
import { textRun, type TextEnding, type TextRun, type TextRunState } from "./text-run.ts";
import { writeProgram } from "./written-program.ts";

const noShelf: RunStorage = {
  set: async () => undefined,
  get: async () => undefined,
  keys: async () => [],
  remove: async () => undefined,
};
const worldFromBase: Pose<"world", "base"> = pose([0.3, -0.2, 0.5]);

/**
 * Written by hand, as another program would: six points by joint angles and by pose, a loop and a decision by an input.
 */
const TEXT = `def elsewhere():
  set_tcp(p[0,0,0.1,0,0,0])
  movej([0.2,-1.4,1.5,-1.6,-1.5,0.3], a=1.4, v=1.0)
  i = 0
  while i < 2:
    movel(p[-0.6,-0.2,0.4,0,3.14159265,0], a=1.2, v=0.25)
    movel(p[-0.6,-0.3,0.4,0,3.14159265,0], a=1.2, v=0.25)
    i = i + 1
  end
  movej([0.1,-1.5,1.6,-1.6,-1.5,0], a=1.4, v=1.0)
end
`;

function bench(text: string, breakpoints: ReadonlySet<number> = new Set()) {
  const robot = robotById("ur10e")!;
  const scheduler = manualScheduler();
  const states: TextRunState[] = [];
  const endings: TextEnding[] = [];
  showJoints(robot.home_rad);
  const control = controlCell(
    {
      dialect: () => null,
      write: async wanted => writeProgram(null, wanted, robot, worldFromBase),
      scheduler,
      shelf: noShelf,
      clock_ms: () => 0,
    },
    { robot, worldFromBase, flangeFromTcp: identity() },
  );
  const run = textRun(
    control,
    dialectById("urscript")!,
    text,
    { robot, worldFromBase, name: "elsewhere", cellName: "Test" },
    () => breakpoints,
    state => states.push(state),
    ending => endings.push(ending),
  );
  return { robot, scheduler, control, run, states, endings };
}
const started = (run: ReturnType<typeof bench>["run"]): TextRun => {
  if ("kind" in run) throw new Error(run.faults[0]?.sentence);
  return run;
};

test("L-67 a program made elsewhere is replayed: the robot comes to rest at the joint angles and poses of the text", async () => {
  const { robot, scheduler, run, endings } = bench(TEXT, new Set([3, 5, 6, 7, 8, 10, 11]));
  const text = started(run);
  const stood: number[][] = [];
  for (let i = 0; endings.length === 0 && i < 30; i++) {
    void text.run();
    await scheduler.elapse(10);
    stood.push(Array.from(theLive().q_rad));
  }
  expect(endings).toEqual([{ kind: "done" }]);
  const near = (wanted: readonly number[]): boolean =>
    stood.some(q => q.every((angle, j) => Math.abs(angle - wanted[j]!) < 1e-9));
  expect(near([0.2, -1.4, 1.5, -1.6, -1.5, 0.3])).toBe(true);
  expect(near([0.1, -1.5, 1.6, -1.6, -1.5, 0])).toBe(true);
  // The controller counts from the base as its maker draws it, half a turn about z from the URDF's.
  const worldFromMaker = compose(worldFromBase, pose<"base", "maker">([0, 0, 0], [0, 0, 1, 0]));
  const flangeFromTcp = pose<"flange", "tcp">([0, 0, 0.1]);
  for (const y of [-0.2, -0.3]) {
    const wanted = compose(worldFromMaker, pose<"maker", "tcp">([-0.6, y, 0.4], fromUrVector(0, 3.14159265, 0)));
    expect(
      stood.some(q =>
        posesAgree(compose(compose(worldFromBase, flangePose(robot.arm, q)), flangeFromTcp), wanted, 1e-5, 1e-5),
      ),
    ).toBe(true);
  }
}, 60_000);

test("a breakpoint stops before its line, every time round; run goes on from there; a step is one statement", async () => {
  const { scheduler, run, states, endings } = bench(TEXT, new Set([7]));
  const text = started(run);
  void text.run();
  await scheduler.elapse(20);
  expect(states.at(-1)).toEqual({ phase: "paused", line: 7 });
  void text.run();
  await scheduler.elapse(20);
  expect(states.at(-1)).toEqual({ phase: "paused", line: 7 });
  const before = Array.from(theLive().q_rad);
  void text.step();
  await scheduler.elapse(10);
  expect(states.at(-1)?.phase).toBe("paused");
  expect(states.at(-1)?.line).toBeGreaterThan(7);
  expect(Array.from(theLive().q_rad)).not.toEqual(before);
  expect(controlStore.getState().running).toBe(true);
  void text.run();
  await scheduler.elapse(30);
  expect(endings).toEqual([{ kind: "done" }]);
  expect(controlStore.getState().running).toBe(false);
}, 60_000);

test("stop ends it, while it moves and while it waits at a breakpoint, and it does not go on", async () => {
  for (const wait_s of [0.3, 20]) {
    const { scheduler, run, endings, states } = bench(TEXT, new Set([6]));
    const text = started(run);
    void text.run();
    await scheduler.elapse(wait_s);
    text.stop();
    await scheduler.elapse(3);
    expect(endings.map(({ kind }) => kind)).toEqual(["stopped"]);
    expect(states.at(-1)?.phase).toBe("idle");
    void text.run();
    await scheduler.elapse(1);
    expect(endings).toHaveLength(1);
  }
}, 60_000);

test("what the language does not know is named with line and column before anything moves", () => {
  const { run } = bench("def a():\n  movej([0,0,0,0,0,0])\n  fly_away(3)\nend\n");
  expect(run).toMatchObject({ kind: "not-understood", faults: [{ line: 3 }] });
});

test("the language is found by the ending of the file, by how the text begins, and otherwise by what it can be read as", () => {
  const robot = robotById("ur10e")!;
  const rx = robotById("staubli_rx90l")!;
  const kr = robotById("kuka_kr6r900sixx")!;
  const at = identity<"world", "base">();
  expect(readText(TEXT, robot, at)?.dialect.id).toBe("urscript");
  expect(readText(".PROGRAM a()\nMOVE #PPOINT(0,-90,90,0,0,0)\n.END\n", rx, at)?.dialect.id).toBe("v-plus");
  expect(readText("DEF a()\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 10,A6 0}\nEND\n", kr, at)?.dialect.id).toBe("krl");
  expect(readText(".PROGRAM a()\nFLY home\n.END\n", rx, at)).toMatchObject({
    dialect: { id: "v-plus" },
    parsed: { kind: "not-understood", faults: [{ line: 2 }] },
  });
  expect(readText("def a():\n  movej([0,0,0,0,0,0]\nend\n", robot, at)).toMatchObject({
    dialect: { id: "urscript" },
    parsed: { kind: "not-understood" },
  });
  expect(readText(TEXT, robot, at, "x.script", "krl")?.dialect.id).toBe("krl");
});
