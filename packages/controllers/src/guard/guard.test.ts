import {
  distance,
  flangePose,
  identity,
  manualScheduler,
  robotById,
  type JointSample,
  type RobotController,
  type Vector3,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { describeController } from "../testing/index.ts";
import { createTwin } from "../twin/index.ts";
import { createVirtualController } from "../virtual/index.ts";
import { createGuard } from "./guard.ts";
import type { GuardOptions } from "./interface.ts";
import { jointMoveSpeed, speedBound } from "./speed.ts";

const robot = robotById("staubli_rx90l")!;
/** Arm stretched forward and bent, so that turning joint 1 sweeps the flange around. */
const START = [0, -0.6, 1.8, 0, 0.4, 0];
const turned = (by: number): number[] => [by, ...START.slice(1)];

describeController("guarded virtual RX90L", {
  robot,
  scheduler: manualScheduler,
  make: options => {
    const commander = createGuard({ controller: createVirtualController(options), scheduler: options.scheduler }).seat(
      "test",
    );
    commander.acquireLease();
    return commander.robot;
  },
});

describeController("guarded twin of a virtual RX90L, enabling switch pressed", {
  robot,
  scheduler: manualScheduler,
  make: options => {
    const { scheduler } = options;
    const commander = createGuard({
      controller: createTwin({ real: createVirtualController(options), scheduler }),
      scheduler,
    }).seat("test");
    commander.acquireLease();
    commander.setEnabled(true);
    return commander.robot;
  },
});

/** A link that can be cut: while it is, samples are lost. Stops are counted with their time. */
function cable(inner: RobotController, now_s: () => number) {
  const stops_s: number[] = [];
  const link = { up: true, stops_s };
  const controller: RobotController = {
    ...inner,
    onSample: listen =>
      inner.onSample(sample => {
        if (link.up) listen(sample);
      }),
    stop(emergency) {
      stops_s.push(now_s());
      inner.stop(emergency);
    },
  };
  return { link, controller };
}

/** A guard whose own thread can be held up, watching a motion that is under way. */
function stallingBench() {
  const scheduler = manualScheduler();
  const { link, controller } = cable(createVirtualController({ robot, scheduler, start_rad: START }), () =>
    scheduler.now_s(),
  );
  const thread = { heldUp: false };
  const guard = createGuard({
    controller,
    scheduler: {
      now_s: () => scheduler.now_s(),
      every: (period_s, tick) =>
        scheduler.every(period_s, () => {
          if (!thread.heldUp) tick();
        }),
    },
    heartbeat_s: 0.08,
    silence_s: 0.06,
  });
  const me = guard.seat("me");
  me.acquireLease();
  return { scheduler, link, guard, me, thread, command: me.robot.moveJoints(turned(0.1)) };
}

function bench(options: Partial<GuardOptions> = {}) {
  const scheduler = manualScheduler();
  const real = createVirtualController({ robot, scheduler, start_rad: START });
  const { link, controller } = cable(real, () => scheduler.now_s());
  const guard = createGuard({ controller, scheduler, deadMan: true, ...options });
  const me = guard.seat("me");
  const other = guard.seat("other");
  const notices: string[] = [];
  guard.onNotice(why => notices.push(why.code));
  me.acquireLease();
  me.setEnabled(true);
  return { scheduler, real, link, guard, me, other, notices };
}

describe("guard", () => {
  test("one commander at a time; anyone may stop", async () => {
    const { scheduler, me, other } = bench();
    expect(other.acquireLease()).toMatchObject({
      kind: "refused",
      why: { code: "guard.lease-taken", sentence: `${robot.name} is commanded by me.` },
    });
    expect(await other.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "guard.lease-taken" } });
    expect(other.robot.setSpeed(10).kind).toBe("refused");
    const command = me.robot.moveJoints(turned(1));
    await scheduler.elapse(0.2);
    other.robot.stop();
    await scheduler.elapse(1);
    expect((await command).kind).toBe("stopped");
    me.releaseLease();
    expect(await me.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "guard.no-lease" } });
    expect(other.acquireLease().kind).toBe("done");
  });

  test("a guard whose own thread was held up for 200 ms hears first what was said meanwhile; silence after it counts as ever", async () => {
    for (const cut of [false, true]) {
      const { scheduler, link, guard, me, command, thread } = stallingBench();
      const alive = scheduler.every(0.02, () => {
        if (!thread.heldUp) me.alive();
      });
      await scheduler.elapse(0.1);
      thread.heldUp = true;
      link.up = false;
      await scheduler.elapse(0.2);
      // What was said waited to be read: the next look comes before it.
      thread.heldUp = false;
      await scheduler.elapse(0.02);
      expect(guard.state.link).toBe("up");
      link.up = !cut;
      await scheduler.elapse(0.1);
      expect(guard.state.link).toBe(cut ? "lost" : "up");
      expect(link.stops_s.length).toBe(cut ? 1 : 0);
      if (!cut) {
        await scheduler.elapse(3);
        expect(await command).toEqual({ kind: "done" });
      }
      alive();
      guard.close();
    }
  });

  test("on a thread that comes 40 ms late to every look, again and again, its own lateness is no silence; a robot that is silent is found out all the same", async () => {
    for (const cut of [false, true]) {
      const { scheduler, link, guard, me, command, thread } = stallingBench();
      await scheduler.elapse(0.04);
      me.alive();
      for (let stall = 0; stall < 20; stall++) {
        thread.heldUp = true;
        link.up = false;
        await scheduler.elapse(0.059);
        thread.heldUp = false;
        // The look comes first, then what was said meanwhile.
        await scheduler.elapse(0.02);
        if (!cut) {
          link.up = true;
          me.alive();
        }
        await scheduler.elapse(0.021);
      }
      expect(guard.state.link).toBe(cut ? "lost" : "up");
      expect(link.stops_s.length > 0).toBe(cut);
      if (!cut) {
        const alive = scheduler.every(0.02, () => me.alive());
        await scheduler.elapse(3);
        expect(await command).toEqual({ kind: "done" });
        alive();
      }
      guard.close();
    }
  });

  test("letting the enabling switch go stops, and nothing moves without it", async () => {
    const { scheduler, real, me } = bench();
    const command = me.robot.moveJoints(turned(1));
    await scheduler.elapse(0.2);
    me.setEnabled(false);
    await scheduler.elapse(real.brakingTime_s + 0.01);
    expect(real.isMoving()).toBe(false);
    expect(await command).toMatchObject({ kind: "stopped", why: { code: "guard.enabling-switch" } });
    expect(await me.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "guard.enabling-switch" } });
    me.setEnabled(true);
    const again = me.robot.moveJoints(turned(0.1));
    await scheduler.elapse(3);
    expect(await again).toEqual({ kind: "done" });
  });

  test("a real robot wants a enabling switch unless told otherwise, a virtual one does not", async () => {
    const scheduler = manualScheduler();
    const virtual = createVirtualController({ robot, scheduler });
    for (const [kind, outcome] of [
      ["virtual", "done"],
      ["real", "refused"],
      ["twin", "refused"],
    ] as const) {
      const commander = createGuard({ controller: { ...virtual, kind }, scheduler }).seat("me");
      commander.acquireLease();
      const command = commander.robot.moveJoint(1, 0.1);
      await scheduler.elapse(3);
      expect((await command).kind).toBe(outcome);
    }
  });

  test("X-41 a cut link is answered with a stop within 100 ms, and nothing moves again without a person's word", async () => {
    for (let cutAfter_s = 0.1; cutAfter_s < 0.13; cutAfter_s += 0.003) {
      const { scheduler, real, link, me, guard, notices } = bench();
      const command = me.robot.moveJoints(turned(2));
      await scheduler.elapse(cutAfter_s);
      link.up = false;
      const cut_s = scheduler.now_s();
      await scheduler.elapse(0.1);
      expect(link.stops_s.length).toBe(1);
      expect(link.stops_s[0]! - cut_s).toBeLessThanOrEqual(0.1);
      expect(notices).toEqual(["guard.link-lost"]);
      await scheduler.elapse(real.brakingTime_s);
      expect(real.isMoving()).toBe(false);
      expect(await command).toMatchObject({ kind: "stopped", why: { code: "guard.link-lost" } });
      expect(await me.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "guard.link-lost" } });
      const rest = real.jointAngles();
      link.up = true;
      await scheduler.elapse(2);
      expect(real.jointAngles()).toEqual(rest);
      expect(guard.state.link).toBe("unconfirmed");
      expect(await me.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "guard.link-unconfirmed" } });
      expect(me.acknowledge().kind).toBe("done");
      const again = me.robot.moveJoints(START);
      await scheduler.elapse(5);
      expect(await again).toEqual({ kind: "done" });
    }
  });

  test("X-41 a commander who falls silent is answered the same way", async () => {
    const { scheduler, link, me, notices } = bench({ heartbeat_s: 0.06 });
    const beat = scheduler.every(0.02, () => {
      me.alive();
    });
    const command = me.robot.moveJoints(turned(2));
    await scheduler.elapse(0.3);
    expect(link.stops_s).toEqual([]);
    beat();
    const silent_s = scheduler.now_s();
    await scheduler.elapse(1);
    expect(link.stops_s[0]! - silent_s).toBeLessThanOrEqual(0.1);
    expect(notices).toEqual(["guard.commander-lost"]);
    expect((await command).kind).toBe("stopped");
    expect(await me.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "guard.link-unconfirmed" } });
  });

  describe("clearance", () => {
    const MARGIN_M = 0.05;
    /** A post beside the robot, in the way of the flange when joint 1 turns through 1 rad. */
    const post: Vector3 = [...flangePose(robot.arm, turned(1)).position];
    const RADIUS_M = 0.1;
    const clearance_m = (q_rad: ArrayLike<number>): number =>
      distance(flangePose(robot.arm, q_rad).position, post) - RADIUS_M;
    const isSafe = (q_rad: Float64Array): boolean => clearance_m(q_rad) >= MARGIN_M;

    test("T-42 a point too near is refused with the reason, as a target and for a program", async () => {
      const { me, guard, link } = bench({ isSafe });
      expect(guard.pointRefusal(turned(1))).toMatchObject({ code: "guard.clearance" });
      expect(guard.pointRefusal(turned(2))).toBeNull();
      expect(guard.pointRefusal(turned(9))).toMatchObject({ code: "limits.joint", joint: 1 });
      expect(await me.robot.moveJoints(turned(1))).toMatchObject({ kind: "refused", why: { code: "guard.clearance" } });
      expect(link.stops_s).toEqual([]);
    });

    test("T-43, T-63 driven at an obstacle at full speed it stops before the margin, goes back, and is clear", async () => {
      const { scheduler, real, me, guard, notices } = bench({ isSafe });
      let least_m = Infinity;
      real.onSample(lent => {
        least_m = Math.min(least_m, clearance_m(lent.q_rad));
      });
      const command = me.robot.moveJoints(turned(2));
      await scheduler.elapse(0.6);
      const outcome = await command;
      expect(outcome).toMatchObject({ kind: "stopped", why: { code: "guard.clearance" } });
      const stood = real.jointAngles();
      await scheduler.elapse(2);
      expect(notices).toEqual(["guard.clearance"]);
      expect(least_m).toBeGreaterThan(0);
      expect(least_m).toBeGreaterThanOrEqual(MARGIN_M - 0.005);
      expect(clearance_m(real.jointAngles())).toBeGreaterThan(MARGIN_M);
      expect(real.jointAngles()[0]).toBeLessThan(stood[0]! + 1e-9);
      expect(guard.state).toMatchObject({ motion: "at-rest", trip: "none" });
      const away = me.robot.moveJoints(turned(-0.5));
      await scheduler.elapse(3);
      expect(await away).toEqual({ kind: "done" });
    });

    test("T-43 without the enabling switch it does not go back by itself; a person's word sends it", async () => {
      const { scheduler, real, me, guard } = bench({ isSafe });
      const command = me.robot.moveJoints(turned(2));
      let before = -1;
      while (guard.state.trip === "none" && before !== scheduler.now_s()) {
        before = scheduler.now_s();
        await scheduler.elapse(0.004);
      }
      me.setEnabled(false);
      await scheduler.elapse(2);
      expect((await command).kind).toBe("stopped");
      expect(guard.state).toMatchObject({ motion: "at-rest", trip: "return-wanted" });
      const stood = real.jointAngles();
      me.setEnabled(true);
      expect(await me.robot.moveJoints(START)).toMatchObject({ kind: "refused", why: { code: "guard.return-wanted" } });
      await scheduler.elapse(1);
      expect(real.jointAngles()).toEqual(stood);
      me.acknowledge();
      await scheduler.elapse(2);
      expect(guard.state).toMatchObject({ motion: "at-rest", trip: "none" });
      expect(real.jointAngles()[0]).toBeLessThan(stood[0]!);
      expect(clearance_m(real.jointAngles())).toBeGreaterThan(MARGIN_M);
    });

    test("T-43 a stop on the way back is obeyed", async () => {
      const { scheduler, real, me, other, guard } = bench({ isSafe });
      const command = me.robot.moveJoints(turned(2));
      for (let i = 0; i < 500 && guard.state.motion !== "returning"; i++) await scheduler.elapse(0.004);
      expect(guard.state.motion).toBe("returning");
      other.robot.stop();
      await scheduler.elapse(1);
      const stood = real.jointAngles();
      await scheduler.elapse(1);
      expect(real.jointAngles()).toEqual(stood);
      expect(guard.state).toMatchObject({ motion: "at-rest", trip: "return-wanted" });
      expect((await command).kind).toBe("stopped");
    });

    test("T-44 the robot is kept from its own stand", async () => {
      const stand = (q_rad: ArrayLike<number>): boolean => flangePose(robot.arm, q_rad).position[2] > 0.1;
      const { scheduler, real, me, guard } = bench({ isSafe: stand });
      let lowest_m = Infinity;
      real.onSample(lent => {
        lowest_m = Math.min(lowest_m, flangePose(robot.arm, lent.q_rad).position[2]);
      });
      const low = [0, 0.75, 1.5, 0, 0, 0];
      expect(stand(START)).toBe(true);
      expect(await me.robot.moveJoints(low)).toMatchObject({ kind: "refused", why: { code: "guard.clearance" } });
      // Steps are not looked at beforehand; the motion is.
      const command = me.robot.run(
        [{ id: "down", type: "move", path: "ptp", target: { q: low }, speed: { ratio: 1 }, blend_m: 0 }],
        { tools: {}, frames: {} },
      );
      await scheduler.elapse(3);
      expect(await command).toMatchObject({ kind: "stopped", why: { code: "guard.clearance" } });
      expect(lowest_m).toBeGreaterThan(0.1);
      expect(lowest_m).toBeLessThan(0.2);
      expect(guard.state).toMatchObject({ motion: "at-rest", trip: "none" });
    });

    test("a virtual robot that was put elsewhere is not taken for one that raced there", async () => {
      const { scheduler, real, me, guard } = bench({ isSafe: q_rad => q_rad[0]! < 0.9 });
      await scheduler.elapse(0.1);
      // Far from where it stood, and on towards what is in the way: 0.6 rad in one sample would not be stopped in time.
      expect(real.jumpTo(turned(0.6)).kind).toBe("done");
      guard.jumped();
      const there = me.robot.run(
        [{ id: "on", type: "move", path: "ptp", target: { q: turned(0.7) }, speed: { ratio: 0.2 }, blend_m: 0 }],
        { tools: {}, frames: {} },
      );
      await scheduler.elapse(3);
      expect(await there).toEqual({ kind: "done" });
    });

    test("a robot that stands too near to something may move away, not nearer", async () => {
      const { scheduler, real, me } = bench({ isSafe });
      real.jumpTo(turned(0.95));
      await scheduler.elapse(0.1);
      expect(await me.robot.moveJoints(turned(1))).toMatchObject({ kind: "refused", why: { code: "guard.clearance" } });
      const away = me.robot.moveJoints(turned(0.2));
      await scheduler.elapse(3);
      expect(await away).toEqual({ kind: "done" });
    });
  });

  describe("manual mode", () => {
    const fastest = (real: ReturnType<typeof createVirtualController>) => {
      const before = identity<"base", "flange">();
      const here = identity<"base", "flange">();
      const most = { mps: 0 };
      let known = false;
      real.onSample((lent: JointSample) => {
        flangePose(robot.arm, lent.q_rad, here);
        if (known) most.mps = Math.max(most.mps, distance(before.position, here.position) / 0.004);
        flangePose(robot.arm, lent.q_rad, before);
        known = true;
      });
      return most;
    };
    /** Reports manual mode while it takes commands, as robots with an external enabling switch do. */
    const manualBench = () => {
      const scheduler = manualScheduler();
      const real = createVirtualController({ robot, scheduler, start_rad: START });
      const guard = createGuard({
        scheduler,
        deadMan: false,
        controller: {
          ...real,
          onSample: listen =>
            real.onSample(lent => {
              listen({ ...lent, mode: "manual" });
            }),
        },
      });
      const me = guard.seat("me");
      me.acquireLease();
      return { scheduler, real, me, most: fastest(real) };
    };

    test("the tool stays below 250 mm/s, and joint moves use what is allowed", async () => {
      const { scheduler, real, me, most } = manualBench();
      await scheduler.elapse(0.1);
      // Far enough for the joint to reach its full speed.
      const command = me.robot.moveJoints(turned(2));
      await scheduler.elapse(20);
      expect(await command).toEqual({ kind: "done" });
      expect(most.mps).toBeLessThanOrEqual(0.25 * 1.001);
      expect(most.mps).toBeGreaterThan(0.2);
      expect(real.jointAngles()[0]).toBeCloseTo(2, 6);
    });

    test("programs stay below it too", async () => {
      const { scheduler, me, most } = manualBench();
      await scheduler.elapse(0.1);
      const command = me.robot.run(
        [{ id: "a", type: "move", path: "ptp", target: { q: turned(0.05) }, speed: { ratio: 1 }, blend_m: 0 }],
        { tools: {}, frames: {} },
      );
      await scheduler.elapse(30);
      expect(await command).toEqual({ kind: "done" });
      expect(most.mps).toBeGreaterThan(0);
      expect(most.mps).toBeLessThanOrEqual(0.25);
    });

    test("a robot that goes faster all the same is stopped", async () => {
      const scheduler = manualScheduler();
      const real = createVirtualController({ robot, scheduler, start_rad: START });
      const stops: number[] = [];
      const guard = createGuard({
        scheduler,
        deadMan: false,
        controller: {
          ...real,
          setSpeed: () => ({ kind: "done" }),
          stop: () => {
            stops.push(scheduler.now_s());
            real.stop();
          },
          onSample: listen =>
            real.onSample(lent => {
              listen({ ...lent, mode: "manual" });
            }),
        },
      });
      const me = guard.seat("me");
      me.acquireLease();
      await scheduler.elapse(0.1);
      const command = me.robot.moveJoints(turned(2));
      await scheduler.elapse(2);
      expect(await command).toMatchObject({ kind: "stopped", why: { code: "guard.speed" } });
      expect(stops.length).toBe(1);
    });

    test("the speed of a joint move agrees with its measured peak; the bound is above it", () => {
      const tool = identity<"flange", "tcp">();
      const speed = robot.arm.joints[0]!.limits.speed_rad_s;
      const [x, y] = flangePose(robot.arm, START).position;
      expect(jointMoveSpeed(robot, START, turned(1), tool)).toBeCloseTo(speed * Math.hypot(x, y), 2);
      expect(jointMoveSpeed(robot, START, START, tool)).toBe(0);
      expect(speedBound(robot, tool)).toBeGreaterThan(speed * Math.hypot(x, y));
    });
  });

  test("an emergency stop lasts until reset; speed set by a seat survives it", async () => {
    const { scheduler, real, me } = bench();
    me.robot.setSpeed(50);
    const command = me.robot.moveJoints(turned(1));
    await scheduler.elapse(0.2);
    me.robot.stop(true);
    expect(await me.robot.reset()).toMatchObject({ kind: "refused", why: { code: "controller.braking" } });
    await scheduler.elapse(1);
    expect((await command).kind).toBe("stopped");
    expect(await me.robot.moveToZero()).toMatchObject({ kind: "refused", why: { code: "safety.emergency-stop" } });
    expect((await me.robot.reset()).kind).toBe("done");
    const again = me.robot.moveToZero();
    await scheduler.elapse(6);
    expect(await again).toEqual({ kind: "done" });
    expect(real.isMoving()).toBe(false);
  });

  test("a driver that throws leaves the robot stopped and the guard ready", async () => {
    const scheduler = manualScheduler();
    const real = createVirtualController({ robot, scheduler });
    const stops: number[] = [];
    const controller: RobotController = {
      ...real,
      stop: () => {
        stops.push(scheduler.now_s());
      },
      moveJoints: () => Promise.reject(new Error("The cable was pulled.")),
    };
    const guard = createGuard({ controller, scheduler });
    const me = guard.seat("me");
    me.acquireLease();
    await expect(me.robot.moveJoints(START)).rejects.toThrow("The cable was pulled.");
    expect(stops.length).toBe(1);
    expect(guard.state.motion).toBe("at-rest");
  });

  test("closing the guard stops what moves", async () => {
    const { scheduler, link, me, guard } = bench();
    void me.robot.moveJoints(turned(1));
    await scheduler.elapse(0.1);
    guard.close();
    expect(link.stops_s.length).toBe(1);
  });
});
