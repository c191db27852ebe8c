import { CellCollider, linkSolids, robotById } from "@twincell/core";
import { cellGeometry, edgeTraceCell } from "@twincell/project";
import { beforeEach, describe, expect, test } from "vitest";
import { programCommands } from "../../commands/program.ts";
import { cellStore } from "../../stores/cell.ts";
import { chooseBehaviour, collideStore } from "../../stores/collide.ts";
import { commit, redo, showDocument, theProgram, undo } from "../../stores/document.ts";
import { noticeStore } from "../../stores/notices.ts";
import { keepPreferences } from "../../stores/preferences.ts";
import type { FromPlanner, ToPlanner } from "../../workers/plan-messages.ts";
import { startFollowing } from "../robot/follow.ts";
import { tick } from "./jog-frames.ts";
import { goThere } from "./go-to-point.ts";
import { contactAt, moveByHand } from "./hand-motion.ts";
import { showJoints, theLive } from "../live.ts";
import { planTask } from "../planning/plan-task.ts";
import { cancelSearch, findDetour, hirePlanners, learnMatrix } from "../planning/planning.ts";

const cell = edgeTraceCell();
const robot = robotById(cell.robot.id)!;
const HOME = [0, -Math.PI / 2, Math.PI / 2, 0, 0, 0];
/** Arm stretched out level; turned to the left it meets the wall there. */
const OUT = [0, 0, Math.PI / 2, 0, 0, 0];
const INTO_WALL = [Math.PI / 2, ...OUT.slice(1)];
/** On either side of the carton: the straight way meets it. */
const FROM = [0.9, 0.5, 2.2, 0, 0, 0];
const THERE = [-1, 0.5, 2.2, 0, 0, 0];
const collider = new CellCollider(cellGeometry(cell, linkSolids(robot)), robot.arm);
const said = (): string => noticeStore.getState().notices.at(-1)?.sentence ?? "";
const command = (id: string): void => {
  programCommands()
    .find(each => each.id === id)!
    .run();
};
let now_ms = 0;
const frames = (count: number): void => {
  for (let i = 0; i < count; i++) tick((now_ms += 16));
};

/** Answers at once or, held back, when told to. */
function planner(held = false): { readonly asked: ToPlanner[]; answer(): void; closed: number } {
  let hear: (message: FromPlanner) => void = () => undefined;
  const commander = {
    asked: [] as ToPlanner[],
    closed: 0,
    answer: () => {
      for (const message of commander.asked.splice(0))
        hear(
          planTask(
            message,
            () => 0,
            told => {
              hear(told);
            },
          ),
        );
    },
  };
  hirePlanners(() => ({
    post: message => {
      commander.asked.push(message);
      if (!held) commander.answer();
    },
    listen: listen => {
      hear = listen;
    },
    close: () => {
      commander.closed++;
    },
  }));
  return commander;
}

beforeEach(() => {
  cancelSearch();
  showDocument(cell);
  startFollowing();
  chooseBehaviour("refuse");
  showJoints(HOME);
});

describe("T-42 a point in contact", () => {
  test("is refused with what touches what, and is taught where a contact is an alert only", () => {
    const steps = (): number => theProgram()!.steps.length;
    const before = steps();
    showJoints(INTO_WALL);
    expect(contactAt(INTO_WALL)).toMatchObject({ b: "wall-left" });
    command("program.record-ptp");
    expect(steps()).toBe(before);
    expect(said()).toMatch(/^The point was not taught: (the tool|link \d) is in contact with “.+”\.$/);
    chooseBehaviour("alert");
    command("program.record-ptp");
    expect(steps()).toBe(before + 1);
    chooseBehaviour("refuse");
    showJoints(HOME);
    command("program.record-ptp");
    expect(steps()).toBe(before + 2);
  });
});

describe("a hand that leads the arm into the wall", () => {
  /** Steps of 1° to the left until it is stopped or there. */
  const lead = (): ReturnType<typeof moveByHand> => {
    showJoints(OUT);
    for (let i = 0; i < 120; i++) {
      const live = theLive().q_rad;
      const met = moveByHand(Float64Array.from(live, (q, k) => (k === 0 ? q + Math.PI / 180 : q)));
      if (met.kind === "stopped") return met;
      if (collideStore.getState().behaviour !== "alert") expect(collider.collides(theLive().q_rad)).toBe(false);
    }
    return { kind: "moved" };
  };

  test("N-50 alert: goes on", () => {
    chooseBehaviour("alert");
    expect(lead().kind).toBe("moved");
    expect(theLive().q_rad[0]).toBeCloseTo((120 * Math.PI) / 180, 9);
  });

  test("T-43 stop: says what it would have touched, goes back by itself, and has room there", () => {
    chooseBehaviour("stop");
    const met = lead();
    expect(met).toMatchObject({
      kind: "stopped",
      sentence: expect.stringMatching(
        /^Stopped before .+ touches “.+”; going back to where there was room\.$/,
      ) as string,
    });
    const stood = theLive().q_rad[0]!;
    frames(200);
    expect(theLive().q_rad[0]).toBeLessThan(stood);
    expect(
      collider.clearance(theLive().q_rad, 0.2, undefined, ({ b }) => b.name === "wall-left").distance_m,
    ).toBeGreaterThan(0.01);
  });
});

describe("E-25 going to a posture when something is in the way", () => {
  test("stop: it is not begun, and the sentence says what it would touch and where", () => {
    chooseBehaviour("stop");
    showJoints(FROM);
    expect(collider.collides(FROM) || collider.collides(THERE)).toBe(false);
    goThere(robot, THERE);
    frames(300);
    expect([...theLive().q_rad]).toEqual(FROM);
    expect(said()).toMatch(/^Not gone: after \d+ % of the way .+ would touch “.+”\.$/);
  });

  test("X-28 untangle: it gets there, and nothing is touched in any frame", () => {
    chooseBehaviour("untangle");
    planner();
    showJoints(FROM);
    let arrived = false;
    goThere(robot, THERE, done => {
      arrived = done;
    });
    for (let i = 0; i < 2000 && !arrived; i++) {
      frames(1);
      expect(collider.collides(theLive().q_rad)).toBe(false);
    }
    expect(arrived).toBe(true);
    expect([...theLive().q_rad]).toEqual(THERE.map(q => expect.closeTo(q, 9) as number));
  });
});

describe("searches", () => {
  const blocked = (): void => {
    commit("Test", document => ({
      ...document,
      programs: document.programs.map(program => ({
        ...program,
        steps: [
          { id: "a", type: "move", path: "ptp", target: { q: FROM }, speed: { ratio: 0.4 }, blend_m: 0 },
          { id: "b", type: "move", path: "ptp", target: { q: THERE }, speed: { ratio: 0.4 }, blend_m: 0 },
        ],
      })),
    }));
  };

  test("a way round is one edit that one undo takes back", () => {
    blocked();
    planner();
    const before = theProgram()!;
    findDetour("b");
    expect(theProgram()!.steps.length).toBeGreaterThan(2);
    expect(said()).toMatch(/^The step goes round over \d+ more points?\.$/);
    undo();
    expect(theProgram()).toEqual(before);
    redo();
    expect(theProgram()!.steps.length).toBeGreaterThan(2);
  });

  test("cancelled it changes nothing; an answer for a program that has changed meanwhile is not taken", () => {
    blocked();
    const first = planner(true);
    findDetour("b");
    expect(collideStore.getState().searching).toEqual({ kind: "way", step: "b", share: 0 });
    cancelSearch();
    expect(first.closed).toBe(1);
    const before = theProgram();
    first.answer();
    expect(theProgram()).toBe(before);
    const second = planner(true);
    findDetour("b");
    chooseBehaviour("alert");
    command("program.record-ptp");
    const changed = theProgram();
    second.answer();
    expect(theProgram()).toBe(changed);
    expect(collideStore.getState().searching).toBe(null);
  });

  test("the matrix is learnt, kept in the cell, and can be undone", () => {
    planner();
    learnMatrix();
    const { pairs } = cellStore.getState().document!;
    expect(pairs).toMatchObject({ robot: robot.id, tool: cell.tool });
    expect(pairs!.entries.some(({ watched }) => watched)).toBe(true);
    undo();
    expect(cellStore.getState().document!.pairs).toBeUndefined();
  });
});

test("the behaviour is kept with the preferences; one that is not known is left out", () => {
  let kept = "{}";
  const runStorage = {
    getItem: () => kept,
    setItem: (_: string, text: string) => {
      kept = text;
    },
  };
  const stop = keepPreferences(runStorage, false);
  chooseBehaviour("slide");
  stop();
  chooseBehaviour("alert");
  keepPreferences(runStorage, false)();
  expect(collideStore.getState().behaviour).toBe("slide");
  kept = '{"collision":"explode"}';
  keepPreferences(runStorage, false)();
  expect(collideStore.getState().behaviour).toBe("slide");
});
