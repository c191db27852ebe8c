import { seededRandom } from "@twincell/core";
import { describe, expect, test } from "vitest";
import {
  COMM,
  MessageReader,
  noPoint,
  noStatus,
  pointBytes,
  readPoint,
  readStatus,
  REPLY,
  SEQUENCE,
  type Status,
} from "../codec/simple-message.ts";
import { bench, HOST, shifted, type StaubliBench } from "../testing/bench.ts";

const farthest = (a: ArrayLike<number>, b: ArrayLike<number>): number =>
  Math.max(...Array.from(b, (q, i) => Math.abs(q - a[i]!)));

/** A client of one socket: what comes back, read. */
async function client({ scheduler, network }: StaubliBench, port: number) {
  const connected = network.connect({ host: HOST, port });
  await scheduler.elapse(0.01);
  const answer = await connected;
  if (answer.kind === "refused") throw new Error(answer.sentence);
  const reader = new MessageReader();
  const replies: [number, number][] = [];
  const statuses: Status[] = [];
  let joints = 0;
  let over = false;
  answer.stream.onBytes(lent => {
    reader.push(lent, message => {
      if (message.type === 11) replies.push([readPoint(message, noPoint()).sequence, message.reply]);
      if (message.type === 13) {
        const status = noStatus();
        readStatus(message, status);
        statuses.push(status);
      }
      if (message.type === 10) joints++;
      return true;
    });
  });
  answer.stream.onEnd(() => {
    over = true;
  });
  return {
    replies,
    statuses,
    over: () => over,
    joints: () => joints,
    close: () => {
      answer.stream.close();
    },
    send: (bytes: Uint8Array) => {
      answer.stream.send(bytes);
    },
    point(sequence: number, q: readonly number[], velocity: number, comm: number = COMM.request) {
      const point = { ...noPoint(), sequence, velocity };
      point.q_rad.set(q);
      answer.stream.send(pointBytes(point, comm, REPLY.none));
    },
  };
}
async function alone(more: Parameters<typeof bench>[0] = {}) {
  const made = await bench(more);
  made.real.disconnect();
  await made.scheduler.elapse(0.1);
  return { ...made, feedback: await client(made, 11_002), motion: await client(made, 11_000) };
}

describe("the controller with ros_server", () => {
  test("nothing is told for a second; then joint angles every 20 ms and the status with every fifth of them", async () => {
    const { scheduler, feedback } = await alone();
    await scheduler.elapse(0.9);
    expect([feedback.joints(), feedback.statuses.length]).toEqual([0, 0]);
    await scheduler.elapse(1.1);
    expect(feedback.joints()).toBeGreaterThanOrEqual(49);
    expect(feedback.joints()).toBeLessThanOrEqual(51);
    expect([9, 10, 11]).toContain(feedback.statuses.length);
    expect(feedback.statuses[0]).toEqual({
      powered: true,
      emergency: false,
      error: 0,
      inError: false,
      moving: false,
      mode: 2,
      possible: true,
    });
  });

  test("points are carried out one behind the other; those beyond limits, without speed or more than the buffer holds are refused; a topic is not answered", async () => {
    const { scheduler, staubli, motion } = await alone();
    await scheduler.elapse(1.5);
    motion.point(1, shifted(0.1), 0.5);
    motion.point(2, shifted(0.3), 1);
    motion.point(3, shifted(9), 1);
    motion.point(4, shifted(0.1), 0);
    motion.point(5, [NaN, 0, 0, 0, 0, 0], 1);
    motion.point(6, shifted(0.2), 1, COMM.topic);
    await scheduler.elapse(4);
    expect(motion.replies).toEqual([
      [1, 1],
      [2, 1],
      [3, 2],
      [4, 2],
      [5, 2],
    ]);
    expect(farthest(staubli.arm.jointAngles(), shifted(0.2))).toBeLessThan(1e-6);
    motion.replies.length = 0;
    for (let i = 0; i < 40; i++) motion.point(100 + i, shifted(i % 2 === 0 ? 0.5 : -0.5), 1);
    await scheduler.elapse(0.1);
    expect(motion.replies.filter(([, reply]) => reply === REPLY.success).length).toBe(10);
    expect(motion.replies.filter(([, reply]) => reply === REPLY.failure).length).toBe(30);
    motion.point(SEQUENCE.stop, [], 0);
    await scheduler.elapse(1);
    expect([motion.replies.at(-1), staubli.waiting, staubli.arm.isMoving()]).toEqual([[-4, 1], 0, false]);
  });

  test("X-41 a client that closes one of its connections stops the robot at once", async () => {
    const made = await alone();
    const { scheduler, staubli, motion, feedback } = made;
    await scheduler.elapse(1.5);
    for (const end of [motion, feedback]) {
      const again = end === motion ? motion : await client(made, 11_000);
      await scheduler.elapse(0.1);
      again.point(1, shifted(end === motion ? 1 : -1), 0.3);
      await scheduler.elapse(0.4);
      expect(staubli.arm.isMoving()).toBe(true);
      end.close();
      await scheduler.elapse(staubli.arm.brakingTime_s + 0.1);
      expect([staubli.arm.isMoving(), staubli.waiting]).toEqual([false, 0]);
    }
  });

  test("a motion that lost its power waits in the stack and goes on when the power is back, unless a stop came", async () => {
    for (const stopped of [false, true]) {
      const { scheduler, staubli, motion } = await alone();
      const { pendant } = staubli;
      await scheduler.elapse(1.5);
      motion.point(1, shifted(0.6), 0.5);
      await scheduler.elapse(0.4);
      pendant.setEmergencyStop(true);
      await scheduler.elapse(1);
      expect([staubli.arm.isMoving(), staubli.waiting, staubli.isPowered]).toEqual([false, 1, false]);
      if (stopped) motion.point(SEQUENCE.stop, [], 0);
      pendant.setEmergencyStop(false);
      await scheduler.elapse(0.1);
      expect(pendant.setPower(true)).toContain("not acknowledged");
      pendant.acknowledge();
      expect(pendant.setPower(true)).toBeNull();
      await scheduler.elapse(4);
      expect(farthest(staubli.arm.jointAngles(), shifted(0.6)) < 1e-6).toBe(!stopped);
    }
  });

  test("manual mode is slow and moves while the enabling switch is pressed; remote mode switches the arm on by itself after a boot", async () => {
    const { scheduler, staubli, real, ended } = await bench();
    const { pendant, arm } = staubli;
    pendant.setMode("manual");
    expect([staubli.isPowered, (await pendant.jog(shifted(0.3))).kind]).toEqual([false, "refused"]);
    pendant.acknowledge();
    pendant.setEnabling(true);
    let last = arm.jointAngles();
    let most_rad_s = 0;
    arm.onSample(({ q_rad }) => {
      most_rad_s = Math.max(most_rad_s, Math.abs(q_rad[0]! - last[0]!) / 0.004);
      last = q_rad.slice();
    });
    expect(await ended(pendant.jog(shifted(0.3)))).toEqual({ kind: "done" });
    // All joints turn at once about a point at least a hand away from the flange.
    expect(most_rad_s).toBeLessThan(0.25 / 0.1);
    pendant.setEnabling(false);
    expect(staubli.isPowered).toBe(false);
    pendant.setMode("remote");
    pendant.acknowledge();
    staubli.reboot();
    await scheduler.elapse(1);
    expect(staubli.isPowered).toBe(false);
    await scheduler.elapse(5);
    expect([staubli.isPowered, real.isConnected]).toEqual([true, true]);
  });

  test("N-62 a VAL 3 text is loaded and started at the pendant, line by line; a text with a fault is not; a stop from the wire ends it", async () => {
    const { scheduler, staubli, motion, ended } = await alone();
    const { pendant, arm } = staubli;
    await scheduler.elapse(1.5);
    expect(await pendant.start()).toBe("No program is loaded.");
    expect(pendant.load("movej 10 20 30 0 20 0\njump high")).toBe("Line 2: This is no joint move.");
    expect(pendant.load("movej 10 20 30 0 20 0\nmovej -10 20 40 0 20 0\n")).toBeNull();
    const running = pendant.start();
    const lines: number[] = [];
    arm.onSample(() => {
      if (staubli.line > 0 && lines.at(-1) !== staubli.line) lines.push(staubli.line);
    });
    await scheduler.elapse(0.1);
    motion.point(1, shifted(0.1), 1);
    await scheduler.elapse(0.1);
    // The program has the arm.
    expect(motion.replies).toEqual([[1, 2]]);
    expect(await ended(running)).toBe("");
    expect(lines).toEqual([1, 2]);
    expect(
      farthest(
        arm.jointAngles(),
        [-10, 20, 40, 0, 20, 0].map(value => (value * Math.PI) / 180),
      ),
    ).toBeLessThan(1e-9);
    const again = pendant.start();
    await scheduler.elapse(0.2);
    motion.point(SEQUENCE.stop, [], 0);
    expect(await ended(again)).toContain("stopped");
  });

  test("any bytes on either port: logged once for each connection, cut off, and the next one is served (200 connections)", async () => {
    const made = await alone();
    const random = seededRandom(4);
    for (let i = 0; i < 200; i++) {
      const before = made.log.length;
      const one = await client(made, i % 2 === 0 ? 11_000 : 11_002);
      for (let k = 0; k < 3 && !one.over(); k++) {
        one.send(Uint8Array.from({ length: 60 }, () => Math.floor(random() * 256)));
        await made.scheduler.elapse(0.01);
      }
      expect(made.log.length - before).toBeLessThanOrEqual(1);
      one.close();
    }
    expect(made.log.length).toBeGreaterThan(150);
    expect(made.log[0]).toContain("The connection is reset.");
    const feedback = await client(made, 11_002);
    const motion = await client(made, 11_000);
    await made.scheduler.elapse(1.5);
    motion.point(1, shifted(0.1), 1);
    await made.scheduler.elapse(0.1);
    expect([motion.replies, feedback.joints() > 10]).toEqual([[[1, 1]], true]);
  });

  test("faults by switch: refusing, dropped after so many messages, byte by byte", async () => {
    const made = await alone();
    const { scheduler, staubli, feedback } = made;
    staubli.faults.split = true;
    await scheduler.elapse(1.5);
    expect(feedback.joints()).toBeGreaterThan(20);
    staubli.faults.dropAfter = 3;
    await scheduler.elapse(0.1);
    expect(feedback.over()).toBe(true);
    staubli.faults.refusing = true;
    const refused = await client(made, 11_002);
    await scheduler.elapse(0.1);
    expect(refused.over()).toBe(true);
  });
});
