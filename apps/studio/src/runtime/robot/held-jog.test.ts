import {
  boxMesh,
  CellCollider,
  emptyProgram,
  flangePose,
  linkSolids,
  PathValidator,
  robotAndCell,
  manualScheduler,
  pose,
  robotById,
  seededRandom,
  type CommandOutcome,
  jointWay,
} from "@twincell/core";
import { clearOf, driverKindById, openRobotConnection, type CellDefinition } from "@twincell/controllers";
import { urScript } from "@twincell/languages";
import { expect, test } from "vitest";
import { heldJog, type FreeWay } from "./held-jog.ts";

const DONE: CommandOutcome = { kind: "done" };
const refused = (code: string): CommandOutcome => ({ kind: "refused", why: { code, sentence: code, hint: "" } });

const STEP_M = 0.01;
/** A sliding joint jogged from 0 to `to` [m], something in the way behind `free`: what was gone, how it ended. */
async function press(to: number, free: number, more: Partial<Parameters<typeof heldJog>[0]> = {}) {
  let now = 0;
  const speeds: number[] = [];
  const met = { a: "link 6", b: "post", between: "other" } as const;
  const outcome = await heldJog({
    wayFromHere: () =>
      Array.from({ length: Math.ceil((to - now) / STEP_M) }, (_, i) => [Math.min(to, now + (i + 1) * STEP_M)]),
    freeWay: (way, room_m) => {
      const count = way.findIndex(([q]) => q! > free - room_m);
      return count < 0 ? { free: way.length, met: null } : { free: count, met };
    },
    wayOut: () => 0,
    go: ([q], speed) => {
      now = q!;
      speeds.push(speed);
      return Promise.resolve(DONE);
    },
    isHeld: () => true,
    nowhere: () => refused("jog.end"),
    blocked: ({ a, b }) => refused(`${a} ${b}`),
    ...more,
  });
  return { now, speeds, said: outcome.kind === "done" ? "done" : outcome.why.code };
}

test("nearer to something it goes slower and stands 8 to 18 mm before it, for 2,000 seeded distances", async () => {
  const random = seededRandom(12);
  for (let n = 0; n < 2000; n++) {
    const free = 0.1 + 2 * random();
    const { now, speeds, said } = await press(3, free);
    expect(said).toBe("link 6 post");
    expect(now).toBeLessThanOrEqual(free - 0.008);
    expect(now).toBeGreaterThan(free - 0.008 - STEP_M - 1e-9);
    expect(speeds).toEqual(speeds.toSorted((a, b) => b - a));
    expect(speeds[0]).toBe(1);
  }
});

test("a free way is gone in one motion; a refusal, a stop, a key let go end it; no way is said to be none", async () => {
  expect(await press(0.5, 9)).toMatchObject({ speeds: [1], said: "done" });
  expect(await press(0, 9)).toMatchObject({ speeds: [], said: "jog.end" });
  expect(await press(1, 0.5, { isHeld: () => false })).toMatchObject({ speeds: [1], said: "done" });
  const stopped: CommandOutcome = { kind: "stopped", why: { code: "guard.stop", sentence: "", hint: "" } };
  expect(await press(1, 0.5, { go: () => Promise.resolve(stopped) })).toMatchObject({ said: "guard.stop" });
  // Who stands before it already, and pushes on, is told so and nothing moves.
  expect(await press(1, 0)).toMatchObject({ now: 0, speeds: [], said: "link 6 post" });
});

test("what stands too near to something is led out slowly, then goes as ever; deeper it goes nowhere", async () => {
  const out = (count: number) => ({ wayOut: (way: readonly (readonly number[])[]) => Math.min(count, way.length) });
  expect(await press(1, 0.5, out(3))).toMatchObject({ speeds: [0.1, 1, 0.35, 0.1], said: "link 6 post" });
  expect(await press(1, 9, out(3))).toMatchObject({ now: 1, speeds: [0.1, 1], said: "done" });
  expect(await press(0.02, 9, out(3))).toMatchObject({ now: 0.02, speeds: [0.1], said: "done" });
  expect(await press(1, 9, { ...out(3), isHeld: () => false })).toMatchObject({ speeds: [0.1], said: "done" });
  expect(await press(1, 0)).toMatchObject({ now: 0, speeds: [], said: "link 6 post" });
});

test("a virtual UR10e jogged at a post stands before it, and comes away when it stands too near", async () => {
  const robot = robotById("ur10e")!;
  const scheduler = manualScheduler();
  const ready = robot.home_rad.map((q, i) => (i === 1 ? q + 0.8 : q));
  const AT_RAD = 0.7;
  const [x, y] = flangePose(robot.arm, ready.with(0, ready[0]! + AT_RAD)).position;
  const cell: CellDefinition = {
    worldFromBase: pose(),
    allowedPairs: [],
    shapeError_m: robot.shapeError_m,
    objects: [{ id: "post", name: "Post", worldFromObject: pose([x, y, 1]), mesh: boxMesh([0.06, 0.06, 2]) }],
  };
  const clear = clearOf({ ...cell, links: linkSolids(robot) }, robot);
  const ended = async <T>(promise: Promise<T>): Promise<T> => {
    let over = false;
    void promise.finally(() => {
      over = true;
    });
    while (!over) await scheduler.elapse(0.02);
    return promise;
  };
  const opened = await openRobotConnection({
    id: "arm",
    brand: driverKindById("ur")!,
    robot,
    scheduler,
    dialect: urScript,
    deadMan: false,
    cell,
    readCell: document => ({ kind: "cell", cell: document as CellDefinition }),
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  expect(await ended(station.connect())).toEqual(DONE);
  const seat = station.commander("you");
  seat.acquireLease();
  expect(await ended(seat.robot.moveJoints(ready))).toEqual(DONE);
  let now_rad: number[] = [...ready];
  station.onSample(({ q_rad }) => {
    now_rad = Array.from(q_rad);
  });
  let collider = new CellCollider({ ...cell, links: linkSolids(robot) }, robot.arm);
  const validatorOf = (room_m: number): PathValidator =>
    new PathValidator(collider, robot.arm, { margin_m: room_m, keepsMargin: robotAndCell });
  const freeWay: FreeWay = (way, room_m) => {
    const validator = validatorOf(room_m);
    for (const [free, q_rad] of way.entries()) {
      const met = validator.inTheWay(q_rad);
      if (met) return { free, met };
    }
    return { free: way.length, met: null };
  };
  const jogged = (sign: 1 | -1): Promise<CommandOutcome> =>
    heldJog({
      wayFromHere: () => jointWay(robot, now_rad, 1, sign * Infinity),
      freeWay,
      wayOut: (way, room_m) => validatorOf(room_m).wayOut(now_rad, way),
      go: (q, share, despite) => {
        const program = emptyProgram(robot.id, "Jog");
        const speed = { ratio: 0.1 * share };
        const step = { id: "jog", type: "move", path: "ptp", target: { q: [...q] }, speed, blend_m: 0 } as const;
        return station.run(seat, { ...program, steps: [step] }, false, despite);
      },
      isHeld: () => true,
      nowhere: () => refused("jog.end"),
      blocked: ({ a, b }) => refused(`${a} ${b}`),
    });
  expect(await ended(jogged(1))).toMatchObject({
    kind: "refused",
    why: { code: expect.stringMatching(/^link \d post$/) as string },
  });
  const turned_rad = now_rad[0]! - ready[0]!;
  expect(turned_rad).toBeGreaterThan(0.45);
  expect(turned_rad).toBeLessThan(AT_RAD);
  expect(clear.contactsAt(Float64Array.from(now_rad))).toEqual([]);
  // The error of the place turns out to be 20 mm larger: it stands too near now, and comes away from there only.
  const before_rad = now_rad[0]!;
  const unsure = { ...cell, shapeError_m: (cell.shapeError_m ?? 0) + 0.02 };
  collider = new CellCollider({ ...unsure, links: linkSolids(robot) }, robot.arm);
  expect(station.setCell(unsure)).toEqual(DONE);
  expect(await ended(jogged(1))).toMatchObject({ kind: "refused" });
  expect(now_rad[0]).toBeCloseTo(before_rad, 6);
  // Away from it the key turns it the other way round, up to the same post from behind: the guard never stopped it.
  expect(await ended(jogged(-1))).toMatchObject({
    kind: "refused",
    why: { code: expect.stringMatching(/^link \d post$/) as string },
  });
  expect(now_rad[0]! - ready[0]!).toBeLessThan(-1);
  expect(clear.contactsAt(Float64Array.from(now_rad))).toEqual([]);
  station.close();
}, 60_000);
