import {
  emptyProgram,
  manualScheduler,
  planProgram,
  robotById,
  samplePlan,
  type MoveStep,
  type Program,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { createRealController } from "../driver/index.ts";
import { inMemoryAdapter } from "../testing/index.ts";
import { PlanFollower } from "../twin/index.ts";
import { createRobotConnection } from "./index.ts";

const robot = robotById("staubli_rx90l")!;
const shifted = (by_rad: number): number[] => Array.from(robot.home_rad, q => q + by_rad);
const move = (id: string, q: readonly number[]): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  target: { q },
  speed: { ratio: 0.5 },
  blend_m: 0,
});
const program: Program = {
  ...emptyProgram(robot.id),
  steps: [move("there", shifted(0.4)), move("back", [...robot.home_rad])],
};

async function bench() {
  const scheduler = manualScheduler();
  const adapter = inMemoryAdapter(robot, scheduler);
  const station = createRobotConnection({
    controller: createRealController({ face: adapter, scheduler, name: "Cell 1" }),
    scheduler,
    deadMan: false,
    alarm_rad: 0.02,
  });
  await station.connect();
  await scheduler.elapse(0.1);
  const seat = station.commander("you");
  const notices: string[] = [];
  station.onNotice(why => {
    notices.push(why.code);
  });
  seat.acquireLease();
  return { scheduler, face: adapter, station, seat, notices };
}
const planned = () => {
  const answer = planProgram(program, robot);
  if (answer.kind !== "planned") throw new Error("The plan of the test fails.");
  return answer.plan;
};

describe("a station", () => {
  test("T-24 T-25 runs a program through its guard, its twin follows, and it stays on its plan at any override", async () => {
    const { scheduler, station, seat } = await bench();
    const running = station.carryOut(seat, { program, steps: () => program.steps, plan: planned() });
    let worst_rad = 0;
    station.onSample(() => {
      worst_rad = Math.max(worst_rad, station.deviation.plan_rad || 0);
    });
    await scheduler.elapse(0.5);
    seat.robot.setSpeed(30);
    await scheduler.elapse(30);
    expect(await running).toEqual({ kind: "done" });
    expect(worst_rad).toBeGreaterThan(0);
    expect(worst_rad).toBeLessThan(0.005);
    expect(station.twin.accuracy.mirror_rad).toBe(0);
    expect(station.deviation.plan_rad).toBeNaN();
  });

  test("a robot that leaves its plan is said aloud, once", async () => {
    const { scheduler, face: adapter, station, seat, notices } = await bench();
    const other = [
      move(
        "there",
        shifted(0.4).map((q, i) => (i === 2 ? q - 0.3 : q)),
      ),
    ];
    const running = station.carryOut(seat, { program, steps: () => other, plan: planned() });
    await scheduler.elapse(10);
    await running;
    expect(notices).toEqual(["twin.deviation"]);
    expect(adapter.virtual.jointAngle(3)).toBeCloseTo(robot.home_rad[2]! + 0.1, 6);
  });

  test("X-41 the plug is pulled: the guard lets nothing move until a person says so, though the link is back", async () => {
    const { scheduler, face: adapter, station, seat } = await bench();
    const running = station.carryOut(seat, { program, steps: () => program.steps });
    await scheduler.elapse(0.3);
    adapter.silent = true;
    await scheduler.elapse(0.1);
    expect(await running).toMatchObject({ kind: "stopped" });
    adapter.silent = false;
    adapter.virtual.stop();
    await scheduler.elapse(2);
    expect(station.link).toMatchObject({ state: "open" });
    expect(await seat.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "guard.link-unconfirmed" } });
    expect(seat.acknowledge()).toEqual({ kind: "done" });
    const again = seat.robot.moveJoints(shifted(0.1));
    await scheduler.elapse(5);
    expect(await again).toEqual({ kind: "done" });
  });

  test.each(["disconnect", "close"] as const)(
    "X-41 %s of a moving robot stops it first: it stands when the connection is gone, and no later than its braking time",
    async what => {
      const { scheduler, face: adapter, station, seat } = await bench();
      void seat.robot.moveJoints(shifted(0.8));
      await scheduler.elapse(0.3);
      expect(adapter.virtual.isMoving()).toBe(true);
      const before_rad = adapter.virtual.jointAngle(1);
      station[what]();
      expect(station.link).toMatchObject({ state: "open" });
      await scheduler.elapse(2);
      expect(station.link).toMatchObject({ state: "closed" });
      expect(adapter.virtual.isMoving()).toBe(false);
      const stood_rad = adapter.virtual.jointAngle(1);
      expect(stood_rad).toBeLessThan(robot.home_rad[0]! + 0.7);
      expect(stood_rad).toBeGreaterThanOrEqual(before_rad);
      await scheduler.elapse(10);
      expect(adapter.virtual.jointAngle(1)).toBe(stood_rad);
    },
  );

  test("X-41 after a person disconnected it a robot that is connected again within 50 ms moves only after a person's word", async () => {
    const { scheduler, station, seat } = await bench();
    station.disconnect();
    await scheduler.elapse(0.02);
    const connecting = station.connect();
    await scheduler.elapse(0.03);
    expect(await connecting).toEqual({ kind: "done" });
    expect(await seat.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "guard.link-unconfirmed" } });
    expect(seat.acknowledge()).toEqual({ kind: "done" });
  });

  test("T-10 drives that somebody's emergency stop took off come on again for the one who commands alone", async () => {
    const { scheduler, station, seat } = await bench();
    const other = station.commander("somebody else");
    other.robot.stop(true);
    await scheduler.elapse(1);
    expect(await other.robot.reset()).toMatchObject({ kind: "refused", why: { code: "guard.lease-taken" } });
    seat.releaseLease();
    expect(await seat.robot.reset()).toMatchObject({ kind: "refused", why: { code: "guard.no-lease" } });
    seat.acquireLease();
    const reset = seat.robot.reset();
    await scheduler.elapse(1);
    expect(await reset).toEqual({ kind: "done" });
  });

  test("X-41 a line that breaks and is back sooner than anybody would call it silent asks for a person's word all the same", async () => {
    const scheduler = manualScheduler();
    const adapter = inMemoryAdapter(robot, scheduler);
    const station = createRobotConnection({
      controller: createRealController({ face: adapter, scheduler, name: "Cell 1" }),
      scheduler,
      deadMan: false,
      silence_s: 5,
    });
    const seat = station.commander("you");
    await station.connect();
    await scheduler.elapse(0.1);
    seat.acquireLease();
    const moving = seat.robot.moveJoints(shifted(0.5));
    await scheduler.elapse(0.3);
    adapter.breakLine();
    adapter.virtual.stop();
    await scheduler.elapse(0.5);
    expect((await moving).kind).toBe("stopped");
    expect(station.link).toMatchObject({ state: "open" });
    expect(await seat.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "guard.link-unconfirmed" } });
  });

  test("two people: one commands, anyone stops", async () => {
    const { scheduler, station, seat } = await bench();
    const other = station.commander("somebody");
    expect(other.acquireLease()).toMatchObject({ kind: "refused", why: { code: "guard.lease-taken" } });
    const running = seat.robot.moveJoints(shifted(0.5));
    await scheduler.elapse(0.2);
    other.robot.stop();
    await scheduler.elapse(1);
    expect(await running).toMatchObject({ kind: "stopped" });
  });
});

test("the place on a plan is found again sample by sample, also where the plan turns back", () => {
  const plan = planned();
  const follower = new PlanFollower(plan, 6);
  const q = new Float64Array(6);
  let worst_rad = 0;
  for (let t_s = 0; t_s <= plan.duration_s; t_s += 0.02) {
    samplePlan(plan, t_s, q);
    worst_rad = Math.max(worst_rad, follower.take(q));
    expect(Math.abs(follower.at_s - t_s)).toBeLessThan(0.5);
  }
  expect(worst_rad).toBeLessThan(0.005);
});
