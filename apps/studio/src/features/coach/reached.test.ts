import { edgeTraceCell, emptyCell } from "@twincell/project";
import { expect, test } from "vitest";
import { words } from "../../messages/index.ts";
import { reachedStep, type Done } from "./reached.ts";

test("the tracing example has six steps to learn, and an empty cell none of its objects or points", () => {
  expect(words.coach.steps.map(([title]) => title)).toEqual([
    "Look around",
    "Turn on Trace",
    "Click the four top edges",
    "Make points",
    "Check it",
    "Run it",
  ]);
  // The example brings the objects and the kinematics; an empty cell has neither piece nor program, and is welcomed
  // instead.
  const example = edgeTraceCell();
  const empty = emptyCell();
  expect([
    example.objects.length > 0,
    example.robot.id,
    empty.objects.length,
    empty.programs[0]?.steps.length ?? 0,
  ]).toEqual([true, "staubli_rx90l", 0, 0]);
});

test("doing what a step asks for leads to the next, in order, to the end", () => {
  const begun: Done = { tracing: false, chosen: 0, steps: 0, mode: "teach", judged: false, runs: 0 };
  const story: readonly Partial<Done>[] = [
    {},
    { tracing: true },
    { chosen: 4 },
    { chosen: 0, steps: 30 },
    { mode: "check", judged: true },
    { mode: "run" },
    { runs: 1 },
  ];
  let done = begun;
  const furthest: number[] = [];
  for (const news of story) {
    done = { ...done, ...news };
    furthest.push(Math.max(furthest.at(-1) ?? 0, reachedStep(done)));
  }
  expect(furthest).toEqual([0, 2, 3, 4, 5, 5, words.coach.steps.length]);
});
