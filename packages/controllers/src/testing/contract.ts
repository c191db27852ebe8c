import {
  flangePose,
  type CommandOutcome,
  type ManualScheduler,
  type Pose,
  type Robot,
  type RobotController,
  type Step,
} from "@twincell/core";
import { afterEach, describe, expect, test } from "vitest";
import type { Cannot } from "../driver/index.ts";
import { onCorruptSample } from "./spoiled.ts";

/** What a bench must be able to set up for a controller under test. */
export interface BenchOptions {
  readonly robot: Robot;
  readonly scheduler: ManualScheduler;
  readonly start_rad: ArrayLike<number>;
  readonly maxSpeed?: number;
  readonly initialize?: () => void;
  readonly onMotion?: (q_rad: ArrayLike<number>) => void;
}
export interface Contract {
  readonly robot: Robot;
  readonly scheduler: () => ManualScheduler;
  /** One that is on a wire may take its time: it moves the clock on itself until it is connected. */
  readonly make: (options: BenchOptions) => RobotController | Promise<RobotController>;
  /**
   * At most so long from a command to its motion and from its end to the answer, together: what a wire and a
   * controller's cycle add to the duration of every move. 0 when left out.
   */
  readonly answer_s?: number;
  /** Rows that this controller cannot meet, with the reason; printed in the table of capabilities. */
  readonly cannot?: readonly Cannot[];
  /**
   * What the wire can say at best, where it is coarser than numbers are: of a joint, and what all joints together do to
   * the flange.
   */
  readonly resolution?: { readonly q_rad: number; readonly position_m: number; readonly angle_rad: number };
}

const FRAME_S = 1 / 90;
const ACCURACY_RAD = (0.001 * Math.PI) / 180;

type FromFlange = Pose<"base", "flange">;
/** One step of every kind and setting, a little from where the robot stands: not every connection can say it. */
const ORDERS: readonly (readonly [string, (here: FromFlange, q_rad: Float64Array) => Step])[] = (() => {
  const beside = ({ position: [x, y, z], quaternion }: FromFlange, dx_m: number, dz_m: number) => ({
    pose: { position: [x - dx_m, y, z - dz_m], quaternion } as unknown as Pose<"frame", "tcp">,
    frame: "world",
    tool: "flange",
  });
  const move = { type: "move", speed: { mps: 0.05 }, blend_m: 0 } as const;
  const joints = (q_rad: Float64Array) => ({
    ...move,
    path: "ptp" as const,
    target: { q: Array.from(q_rad, q => q + 0.01) },
    speed: { ratio: 0.5 },
  });
  return [
    ["joints", (_, q_rad) => ({ ...joints(q_rad), id: "joints 1" })],
    ["joints, softly", (_, q_rad) => ({ ...joints(q_rad), id: "soft 1", acceleration: { ratio: 0.5 } })],
    ["line", here => ({ ...move, id: "line 1", path: "lin", target: beside(here, 0.01, 0) })],
    [
      "line, softly",
      here => ({ ...move, id: "line 2", path: "lin", target: beside(here, 0.01, 0), acceleration: { ratio: 0.5 } }),
    ],
    [
      "arc",
      here => ({ ...move, id: "arc 1", path: "circ", via: beside(here, 0.01, 0.01), target: beside(here, 0.02, 0) }),
    ],
    ["spline", here => ({ ...move, id: "spline 1", path: "spline", target: beside(here, 0.01, 0) })],
    [
      "search",
      here => ({
        ...move,
        id: "search 1",
        path: "lin",
        target: beside(here, 0.01, 0),
        until: { when: { signal: "touch", is: true }, missing: "continue" },
      }),
    ],
    ["gripper", () => ({ id: "gripper 1", type: "gripper", closed: true })],
    ["line out", () => ({ id: "set 1", type: "set", signal: "no such line", to: true })],
    ["payload", () => ({ id: "load 1", type: "payload", mass_kg: 1, center_m: [0, 0, 0.05] })],
  ];
})();

/** One suite for every controller: rows T-01 … T-18. */
export function describeController(name: string, contract: Contract): void {
  const { robot, answer_s = 0, resolution = { q_rad: 0, position_m: 5e-7, angle_rad: 2e-6 } } = contract;
  const n = robot.arm.joints.length;
  const open: RobotController[] = [];
  const row = (title: string, body: () => Promise<void>): void => {
    const exception = contract.cannot?.find(entry => title.startsWith(`${entry.row} `));
    if (exception) test.skip(`${title} (cannot: ${exception.because})`, body);
    else test(title, body);
  };
  /** Angles at the given part of each joint's range. */
  const at = (part: number): Float64Array =>
    Float64Array.from(
      robot.arm.joints,
      ({ limits }) => limits.lower_rad + part * (limits.upper_rad - limits.lower_rad),
    );

  async function bench(options: Partial<BenchOptions> = {}) {
    const scheduler = contract.scheduler();
    const controller = await contract.make({ robot, scheduler, start_rad: at(0.5), ...options });
    open.push(controller);
    /** Lets a command run to its end and says how long that took. */
    const carryOut = async (command: Promise<CommandOutcome>): Promise<{ outcome: CommandOutcome; took_s: number }> => {
      const begun_s = scheduler.now_s();
      let outcome: CommandOutcome | undefined;
      let took_s = 0;
      void command.then(value => {
        outcome = value;
        took_s = scheduler.now_s() - begun_s;
      });
      for (let i = 0; i < 600 && !outcome; i++) await scheduler.elapse(0.1);
      if (!outcome) throw new Error("The command took more than a minute.");
      return { outcome, took_s };
    };
    return { scheduler, controller, carryOut };
  }
  const expectAngles = (controller: RobotController, wanted: ArrayLike<number>): void => {
    const is = controller.jointAngles();
    for (let i = 0; i < n; i++)
      expect(Math.abs(is[i]! - wanted[i]!), `joint ${i + 1}`).toBeLessThanOrEqual(ACCURACY_RAD);
  };

  describe(name, () => {
    afterEach(() => {
      for (const controller of open.splice(0)) controller.close();
    });

    row("T-01 one interface: every method answers on every controller", async () => {
      const { controller, carryOut } = await bench();
      const step = {
        id: "a",
        type: "move",
        path: "ptp",
        target: { q: [...at(0.5)] },
        speed: { ratio: 1 },
        blend_m: 0,
      } as const;
      expect((await carryOut(controller.moveJoint(1, 0.1))).outcome).toEqual({ kind: "done" });
      expect((await carryOut(controller.moveJoints(at(0.5)))).outcome).toEqual({ kind: "done" });
      expect((await carryOut(controller.moveToPose(flangePose(robot.arm, at(0.52))))).outcome).toEqual({
        kind: "done",
      });
      expect((await carryOut(controller.moveToZero())).outcome).toEqual({ kind: "done" });
      expect((await carryOut(controller.run([step], { tools: {}, frames: {} }))).outcome).toEqual({ kind: "done" });
      expect(controller.setSpeed(50)).toEqual({ kind: "done" });
      expect((await carryOut(controller.reset())).outcome).toEqual({ kind: "done" });
      controller.stop();
      expect(controller.isMoving()).toBe(false);
      expect(controller.jointAngle(1)).toBe(controller.jointAngles()[0]);
      expect(controller.robot.id).toBe(robot.id);
      expect(controller.name).not.toBe("");
    });

    row("T-02 the moving flag is up during a move and down after it", async () => {
      const { controller, scheduler, carryOut } = await bench();
      expect(controller.isMoving()).toBe(false);
      const command = controller.moveJoints(at(0.6));
      const flags: boolean[] = [];
      await scheduler.elapse(0.05);
      expect(controller.isMoving()).toBe(true);
      const stop = onCorruptSample(controller, sample => flags.push(sample.moving));
      await carryOut(command);
      await scheduler.elapse(0.05);
      stop();
      expect(controller.isMoving()).toBe(false);
      expect(flags[0]).toBe(true);
      expect(flags.at(-1)).toBe(false);
      expect(flags.filter((flag, i) => i > 0 && flag !== flags[i - 1]).length).toBe(1);
    });

    row("T-03 half the speed takes twice the time", async () => {
      const { controller, carryOut } = await bench();
      const full = await carryOut(controller.moveJoints(at(0.8)));
      controller.setSpeed(50);
      const half = await carryOut(controller.moveJoints(at(0.5)));
      // took = duration + answer, so that twice the one is an answer more than the other.
      expect(Math.abs(half.took_s - 2 * full.took_s)).toBeLessThanOrEqual(FRAME_S + answer_s);
      for (const wrong of [-1, 100.5, NaN]) expect(controller.setSpeed(wrong).kind).toBe("refused");
    });

    row("T-04 one joint reads as commanded", async () => {
      const { controller, carryOut } = await bench();
      await carryOut(controller.moveJoint(3, at(0.7)[2]!));
      expect(Math.abs(controller.jointAngle(3) - at(0.7)[2]!)).toBeLessThanOrEqual(ACCURACY_RAD);
      expect(controller.jointAngle(n + 1)).toBeNaN();
    });

    row("T-05 all joints read in order, as many as there are", async () => {
      const { controller, carryOut } = await bench();
      const target = at(0.5).map((q, i) => q + 0.01 * (i + 1));
      await carryOut(controller.moveJoints(target));
      const out = new Float64Array(n);
      expect(controller.jointAngles(out)).toBe(out);
      expect(controller.jointAngles().length).toBe(n);
      expectAngles(controller, target);
    });

    row("T-06 one joint turns, the others stay", async () => {
      const { controller, carryOut } = await bench();
      const before = controller.jointAngles();
      await carryOut(controller.moveJoint(2, before[1]! + 0.3));
      before[1]! += 0.3;
      expectAngles(controller, before);
      for (const wrong of [0, n + 1, 1.5]) expect((await controller.moveJoint(wrong, 0)).kind).toBe("refused");
    });

    row("T-07 all joints reach their targets", async () => {
      const { controller, carryOut } = await bench();
      for (const part of [0, 1, 0.3]) {
        await carryOut(controller.moveJoints(at(part)));
        expectAngles(controller, at(part));
      }
    });

    row("T-08 a commanded pose is reached", async () => {
      const { controller, carryOut } = await bench({ start_rad: at(0.55) });
      const wanted = flangePose(robot.arm, at(0.6));
      expect((await carryOut(controller.moveToPose(wanted))).outcome).toEqual({ kind: "done" });
      const is = flangePose(robot.arm, controller.jointAngles());
      for (let i = 0; i < 3; i++)
        expect(Math.abs(is.position[i]! - wanted.position[i]!)).toBeLessThan(resolution.position_m);
      const cosine = Math.abs(is.quaternion.reduce((sum, value, i) => sum + value * wanted.quaternion[i]!, 0));
      // The cosine of half the angle between them.
      expect(cosine).toBeGreaterThan(1 - resolution.angle_rad ** 2 / 8 - 5e-13);
    });

    row("T-09 all joints to zero", async () => {
      const { controller, carryOut } = await bench();
      await carryOut(controller.moveToZero());
      expectAngles(controller, new Float64Array(n));
    });

    row("T-10 a stop leaves the drives on, an emergency stop takes them off until reset", async () => {
      const { controller, scheduler, carryOut } = await bench();
      const safety: string[] = [];
      const stopListening = onCorruptSample(controller, sample => {
        if (safety.at(-1) !== sample.safety) safety.push(sample.safety);
      });
      const first = controller.moveJoints(at(0.9));
      await scheduler.elapse(0.2);
      controller.stop();
      const ended = await carryOut(first);
      expect(ended.outcome.kind).toBe("stopped");
      expect(ended.took_s).toBeLessThan(1);
      expect(safety).toEqual(["normal"]);

      const second = controller.moveJoints(at(0.1));
      await scheduler.elapse(0.2);
      controller.stop(true);
      expect((await carryOut(second)).outcome.kind).toBe("stopped");
      await scheduler.elapse(0.05);
      expect(safety).toEqual(["normal", "emergency-stop"]);
      const rest = controller.jointAngles();
      for (const command of [
        controller.moveJoints(at(0.5)),
        controller.moveJoint(1, 0),
        controller.moveToZero(),
        controller.moveToPose(flangePose(robot.arm, at(0.5))),
      ]) {
        const outcome = await command;
        expect(outcome.kind).toBe("refused");
        if (outcome.kind === "refused") expect(outcome.why.code).toBe("safety.emergency-stop");
      }
      await scheduler.elapse(0.5);
      expectAngles(controller, rest);
      expect((await carryOut(controller.reset())).outcome).toEqual({ kind: "done" });
      // Drives take their time to come on: the reset is over when the robot says so, not before.
      expect(safety).toEqual(["normal", "emergency-stop", "normal"]);
      expect((await carryOut(controller.moveJoints(at(0.5)))).outcome).toEqual({ kind: "done" });
      stopListening();
    });

    row(
      "T-10 an emergency stop while a reset is under way wins: it ends stopped, and takes no move until the next reset",
      async () => {
        for (const after_s of [0, 0.02, 0.1, 0.5, 1.5]) {
          const { controller, scheduler, carryOut } = await bench();
          let safety = "";
          const stopListening = onCorruptSample(controller, sample => {
            safety = sample.safety;
          });
          controller.stop(true);
          await scheduler.elapse(0.3);
          const reset = controller.reset();
          await scheduler.elapse(after_s);
          controller.stop(true);
          const { outcome } = await carryOut(reset);
          // A reset may be over already; one that is not says that the stop came.
          if (outcome.kind !== "done") expect(outcome.why.code).toBe("controller.stopped-in-reset");
          await scheduler.elapse(10);
          expect(safety).toBe("emergency-stop");
          expect(await controller.moveJoints(at(0.6))).toMatchObject({
            kind: "refused",
            why: { code: "safety.emergency-stop" },
          });
          expect((await carryOut(controller.reset())).outcome).toEqual({ kind: "done" });
          expect((await carryOut(controller.moveJoints(at(0.6)))).outcome).toEqual({ kind: "done" });
          stopListening();
          controller.close();
        }
      },
    );

    row("T-10 a stop in the first moments of a motion wins: only the next command moves the robot", async () => {
      for (const after_s of [0, 0.002, 0.01, 0.03, 0.1]) {
        const { controller, scheduler, carryOut } = await bench();
        const moving = controller.moveJoints(at(0.9));
        await scheduler.elapse(after_s);
        controller.stop();
        expect((await carryOut(moving)).outcome.kind).toBe("stopped");
        // A way back at once, as a guard commands it, is all that moves the robot afterwards.
        const back = controller.jointAngles().slice();
        expect((await carryOut(controller.moveJoints(back))).outcome).toEqual({ kind: "done" });
        await scheduler.elapse(2);
        expectAngles(controller, back);
        expect((await carryOut(controller.moveJoints(at(0.6)))).outcome).toEqual({ kind: "done" });
        controller.close();
      }
    });

    row("T-11 the set-up hook is called once, on load", async () => {
      let calls = 0;
      const { controller, scheduler, carryOut } = await bench({
        initialize: () => {
          calls++;
        },
      });
      expect(calls).toBe(1);
      await scheduler.elapse(0.1);
      await carryOut(controller.moveToZero());
      expect(calls).toBe(1);
    });

    row("T-12 four public moves, one primitive", async () => {
      let calls = 0;
      const { controller, carryOut } = await bench({
        onMotion: () => {
          calls++;
        },
        start_rad: at(0.55),
      });
      await carryOut(controller.moveToPose(flangePose(robot.arm, at(0.56))));
      expect(calls).toBe(1);
      await carryOut(controller.moveJoint(1, 0.2));
      expect(calls).toBe(2);
      await carryOut(controller.moveJoints(at(0.5)));
      expect(calls).toBe(3);
      await carryOut(controller.moveToZero());
      expect(calls).toBe(4);
    });

    const overManyCycles = async (
      controller: RobotController,
      scheduler: ManualScheduler,
      command: () => Promise<CommandOutcome>,
    ): Promise<void> => {
      const before = controller.jointAngles();
      const largest = new Float64Array(n);
      const last = Float64Array.from(before);
      let samples = 0;
      let cycle_s = 0;
      let time_s = NaN;
      let steady = true;
      const stop = onCorruptSample(controller, sample => {
        if (samples++ > 0) {
          cycle_s = Math.max(cycle_s, sample.time_s - time_s);
          steady &&= sample.time_s > time_s;
        }
        time_s = sample.time_s;
        sample.q_rad.forEach((q, i) => {
          largest[i] = Math.max(largest[i]!, Math.abs(q - last[i]!));
          last[i] = q;
        });
      });
      const pending = command();
      expectAngles(controller, before);
      let ended = false;
      void pending.then(() => {
        ended = true;
      });
      for (let i = 0; i < 600 && !ended; i++) await scheduler.elapse(0.1);
      stop();
      expect(ended).toBe(true);
      expect(samples).toBeGreaterThan(20);
      expect(steady).toBe(true);
      robot.arm.joints.forEach(({ limits }, i) =>
        expect(largest[i], `joint ${i + 1}`).toBeLessThanOrEqual(
          limits.speed_rad_s * cycle_s * (1 + 1e-6) + 2 * resolution.q_rad,
        ),
      );
    };
    row("T-13 a joint move runs over many cycles, never faster than a joint may turn", async () => {
      const { controller, scheduler } = await bench({ start_rad: at(0.1) });
      await overManyCycles(controller, scheduler, () => controller.moveJoints(at(0.9)));
    });
    row("T-14 a pose move runs over many cycles, never faster than a joint may turn", async () => {
      const { controller, scheduler } = await bench({ start_rad: at(0.55) });
      await overManyCycles(controller, scheduler, () => controller.moveToPose(flangePose(robot.arm, at(0.62))));
    });

    row("T-15 a target beyond a limit is refused with joint, value and limit", async () => {
      const { controller, scheduler } = await bench();
      const before = controller.jointAngles();
      for (let i = 0; i < n; i++) {
        const target = at(0.5);
        const limit = robot.arm.joints[i]!.limits.upper_rad;
        target[i] = limit + 0.1;
        for (const outcome of [await controller.moveJoints(target), await controller.moveJoint(i + 1, limit + 0.1)]) {
          expect(outcome).toMatchObject({
            kind: "refused",
            why: { code: "limits.joint", joint: i + 1, value: limit + 0.1, limit },
          });
        }
      }
      for (const wrong of [[], new Float64Array(n + 1), new Float64Array(n).fill(NaN)])
        expect((await controller.moveJoints(wrong)).kind).toBe("refused");
      await scheduler.elapse(0.2);
      expectAngles(controller, before);
    });

    row("what a connection cannot say is told before the first motion, with the step and the way out", async () => {
      for (const [what, make] of ORDERS) {
        const motions: ArrayLike<number>[] = [];
        const { controller, scheduler, carryOut } = await bench({
          start_rad: at(0.55),
          onMotion: q_rad => motions.push(q_rad),
        });
        const step = make(flangePose(robot.arm, at(0.55)), at(0.55));
        const why = controller.cannotCarryOut(step);
        if (why === null) {
          const { outcome } = await carryOut(controller.run([step], { tools: {}, frames: {} }));
          expect([what, outcome]).toEqual([what, { kind: "done" }]);
        } else {
          const first: Step = {
            id: "first",
            type: "move",
            path: "ptp",
            target: { q: [...at(0.6)] },
            speed: { ratio: 1 },
            blend_m: 0,
          };
          expect(controller.cannotCarryOut(first)).toBeNull();
          const run = controller.run([first, step], { tools: {}, frames: {} });
          await scheduler.elapse(1);
          expect(await run, what).toMatchObject({
            kind: "refused",
            why: { sentence: expect.stringContaining(`“${step.id}”`), hint: expect.stringMatching(/^[A-Z].*\.$/) },
          });
          expect(motions, what).toEqual([]);
          expectAngles(controller, at(0.55));
        }
        controller.close();
      }
    });

    row("T-16 a robot that is only data can be driven", async () => {
      const copy = JSON.parse(JSON.stringify({ ...robot, id: "a_new_robot", name: "A new robot" })) as Robot;
      const { controller, carryOut } = await bench({ robot: copy });
      expect((await carryOut(controller.moveJoints(at(0.6)))).outcome).toEqual({ kind: "done" });
      expect(controller.robot.name).toBe("A new robot");
    });

    row("T-17 the greatest speed of a robot scales how long it takes", async () => {
      const full = await bench({ maxSpeed: 1 });
      const quarter = await bench({ maxSpeed: 0.25 });
      const fast = await full.carryOut(full.controller.moveJoints(at(0.8)));
      const slow = await quarter.carryOut(quarter.controller.moveJoints(at(0.8)));
      expect(Math.abs(slow.took_s - 4 * fast.took_s)).toBeLessThanOrEqual(FRAME_S + 3 * answer_s);
    });

    row("T-18 an override of 0 holds; only virtual robots jump", async () => {
      const { controller, scheduler, carryOut } = await bench();
      const command = controller.moveJoints(at(0.9));
      await scheduler.elapse(0.2);
      controller.setSpeed(0);
      await scheduler.elapse(1);
      const held = controller.jointAngles();
      expect(controller.isMoving()).toBe(false);
      await scheduler.elapse(2);
      expectAngles(controller, held);
      controller.setSpeed(100);
      expect((await carryOut(command)).outcome).toEqual({ kind: "done" });
      expectAngles(controller, at(0.9));

      if (controller.kind !== "virtual") expect(controller.jumpTo).toBeUndefined();
      else {
        expect(controller.jumpTo?.(at(0.2))).toEqual({ kind: "done" });
        await scheduler.elapse(FRAME_S);
        expectAngles(controller, at(0.2));
        expect(controller.jumpTo?.(at(1.2)).kind).toBe("refused");
      }
    });
  });
}
