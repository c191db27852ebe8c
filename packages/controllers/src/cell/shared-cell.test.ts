import {
  brakingDistance_m,
  linkSolids,
  manualScheduler,
  OtherArm,
  CellCollider,
  pose,
  robotAndCell,
  robotById,
  seededRandom,
  type Pose,
  type Robot,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createGuard } from "../guard/index.ts";
import { createVirtualController } from "../virtual/index.ts";
import { BETWEEN_ROBOTS_M, createSharedCell, type SharedCell } from "./index.ts";

const ur = robotById("ur10e")!;
const kuka = robotById("kuka_kr6r900sixx")!;
const facing = (x: number, y = 0): Pose<"world", "base"> =>
  ({ ...pose([x, y, 0]), quaternion: [0, 0, 1, 0] }) as Pose<"world", "base">;

function put(
  cell: SharedCell,
  scheduler: ReturnType<typeof manualScheduler>,
  id: string,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  start_rad: ArrayLike<number> = robot.home_rad,
) {
  const real = createVirtualController({ robot, scheduler, start_rad });
  const place = cell.join({ id, name: id, robot, worldFromBase, brakingTime_s: real.brakingTime_s });
  const guard = createGuard({ controller: real, scheduler, deadMan: false, place, brakingTime_s: real.brakingTime_s });
  const commander = guard.seat("me");
  const notices: string[] = [];
  guard.onNotice(why => {
    notices.push(why.code);
  });
  commander.acquireLease();
  return { real, place, guard, seat: commander, notices, robot, worldFromBase };
}
type Put = ReturnType<typeof put>;

/** Measures by itself: the links of one against those of the other, as they are. */
function ruler(a: Put, b: Put) {
  const arm = new OtherArm("b", "b", b.robot, linkSolids(b.robot), b.worldFromBase);
  const collider = new CellCollider(
    {
      worldFromBase: a.worldFromBase,
      links: linkSolids(a.robot),
      objects: arm.objects,
      allowedPairs: [],
      shapeError_m: 0,
    },
    a.robot.arm,
  );
  return () => {
    arm.place(b.real.jointAngles(), collider);
    return collider.clearance(a.real.jointAngles(), 0.2, undefined, robotAndCell).distance_m;
  };
}
/** The UR reaches forward over the place between them. */
const REACHES = [0, -0.6, 0.9, -0.3, 1.57, 0];
const ASIDE = [1.57, -0.6, 0.9, -0.3, 1.57, 0];
const K_REACHES = [0, -0.6, 1.2, 0, 0.6, 0];
const K_ASIDE = [1.57, -0.6, 1.2, 0, 0.6, 0];

describe("robots that share a cell", () => {
  test("T-42 a target beside a robot that stands there is refused with both names and the distance", async () => {
    const scheduler = manualScheduler();
    const cell = createSharedCell();
    const a = put(cell, scheduler, "Anna", ur, pose(), ASIDE);
    const b = put(cell, scheduler, "Bert", kuka, facing(1.3), K_REACHES);
    await scheduler.elapse(0.1);
    const outcome = await a.seat.robot.moveJoints(REACHES);
    expect(outcome).toMatchObject({
      kind: "refused",
      why: {
        code: "cell.target",
        sentence: expect.stringMatching(
          /^At the target Anna would be \d+ mm from Bert; 50 mm are kept between robots\.$/,
        ) as string,
      },
    });
    expect(b.notices).toEqual([]);
    b.guard.close();
    const free = a.seat.robot.moveJoints(REACHES);
    await scheduler.elapse(8);
    expect(await free).toEqual({ kind: "done" });
  });

  test("T-43 T-63 a motion past a robot that stands in its way is stopped before it comes too near; afterwards it may go away, and no nearer", async () => {
    const scheduler = manualScheduler();
    const cell = createSharedCell();
    const a = put(cell, scheduler, "Anna", ur, pose(), ASIDE);
    const b = put(cell, scheduler, "Bert", kuka, facing(1.3), K_REACHES);
    const measure = ruler(a, b);
    await scheduler.elapse(0.1);
    const through = a.seat.robot.moveJoints([-1.57, ...REACHES.slice(1)]);
    let least_m = Infinity;
    for (let i = 0; i < 750; i++) {
      await scheduler.elapse(0.008);
      least_m = Math.min(least_m, measure());
    }
    expect(await through).toMatchObject({
      kind: "stopped",
      why: {
        code: "cell.near",
        sentence: expect.stringMatching(/^Anna would have come within \d+ mm of Bert and was stopped; 50 mm/) as string,
      },
    });
    expect(least_m).toBeGreaterThan(BETWEEN_ROBOTS_M);
    expect(a.guard.state).toMatchObject({ motion: "at-rest", trip: "none" });
    const back = a.seat.robot.moveJoints(ASIDE);
    await scheduler.elapse(6);
    expect(await back).toEqual({ kind: "done" });
  });

  test("the one opened later yields, and says to whom; the other goes on to its end", async () => {
    const scheduler = manualScheduler();
    const cell = createSharedCell();
    const a = put(cell, scheduler, "Anna", ur, pose(), ASIDE);
    const b = put(cell, scheduler, "Bert", kuka, facing(1.5), K_ASIDE);
    const measure = ruler(a, b);
    await scheduler.elapse(0.1);
    // They come at the same time.
    b.seat.robot.setSpeed(35);
    const first = a.seat.robot.moveJoints(REACHES);
    const second = b.seat.robot.moveJoints(K_REACHES);
    let least_m = Infinity;
    for (let i = 0; i < 750; i++) {
      await scheduler.elapse(0.008);
      least_m = Math.min(least_m, measure());
    }
    expect(await second).toMatchObject({ kind: "stopped", why: { code: "cell.yields" } });
    expect(least_m).toBeGreaterThan(BETWEEN_ROBOTS_M);
    expect(await first).toEqual({ kind: "done" });
  });

  test("to one who is only watched or jogged at its pendant everyone yields, whoever was opened first", async () => {
    const scheduler = manualScheduler();
    const cell = createSharedCell();
    const a = put(cell, scheduler, "Anna", ur, pose(), ASIDE);
    const b = put(cell, scheduler, "Bert", kuka, facing(1.5), K_ASIDE);
    await scheduler.elapse(0.1);
    // Nobody's guard moves it.
    b.real.setSpeed(35);
    void b.real.moveJoints(K_REACHES);
    const mine = a.seat.robot.moveJoints(REACHES);
    await scheduler.elapse(6);
    expect(await mine).toMatchObject({ kind: "stopped", why: { code: "cell.yields" } });
  });
});

describe("T-63 any two robots that cross at random", () => {
  const SPEED_MPS = 3;
  test.each(Array.from({ length: 8 }, (_, seed) => seed + 1))(
    "seed %i: never nearer than the margin less the stated braking way",
    async seed => {
      const random = seededRandom(seed);
      const scheduler = manualScheduler();
      const cell = createSharedCell();
      const at_m = 0.9 + 0.5 * random();
      const a = put(cell, scheduler, "Anna", ur, pose(), [Math.PI, -0.6, 0.9, -0.3, 1.57, 0]);
      const b = put(cell, scheduler, "Bert", kuka, facing(at_m, 0.4 * (random() - 0.5)), [
        Math.PI * 0.9,
        -0.6,
        1.2,
        0,
        0.6,
        0,
      ]);
      const measure = ruler(a, b);
      await scheduler.elapse(0.1);
      // Some start nearer than is kept: those may only go away.
      let least_m = measure();
      const kept_m = Math.min(least_m, BETWEEN_ROBOTS_M);
      const braking_m = Math.max(...[a, b].map(({ robot }) => brakingDistance_m(robot, SPEED_MPS)));
      const somewhere = (robot: Robot): number[] =>
        robot.home_rad.map((q, k) => q + (random() - 0.5) * (k === 0 ? 4 : 1.6));
      for (const each of [a, b]) {
        void (async () => {
          for (let i = 0; i < 8; i++) await each.seat.robot.moveJoints(somewhere(each.robot));
        })();
      }
      for (let i = 0; i < 700; i++) {
        await scheduler.elapse(0.008);
        least_m = Math.min(least_m, measure());
      }
      expect(least_m).toBeGreaterThan(0);
      expect(least_m).toBeGreaterThan(kept_m - braking_m);
      expect(least_m).toBeGreaterThan(kept_m - 0.005);
    },
    30_000,
  );

  test.each([1, 2, 3])(
    "seed %i: far apart nothing is refused and nothing stopped",
    async seed => {
      const random = seededRandom(seed);
      const scheduler = manualScheduler();
      const cell = createSharedCell();
      const a = put(cell, scheduler, "Anna", ur, pose());
      const b = put(cell, scheduler, "Bert", kuka, facing(4));
      await scheduler.elapse(0.1);
      const outcomes: string[] = [];
      for (const each of [a, b]) {
        void (async () => {
          for (let i = 0; i < 8; i++)
            outcomes.push(
              (
                await each.seat.robot.moveJoints(
                  each.robot.home_rad.map((q, k) => q + (random() - 0.5) * (k === 0 ? 3 : 1)),
                )
              ).kind,
            );
        })();
      }
      for (let i = 0; i < 400 && outcomes.length < 16; i++) await scheduler.elapse(0.1);
      expect(outcomes).toEqual(Array.from({ length: 16 }, () => "done"));
      expect([...a.notices, ...b.notices]).toEqual([]);
    },
    30_000,
  );
});
