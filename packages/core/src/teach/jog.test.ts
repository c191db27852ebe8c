import { expect, test } from "vitest";
import {
  angleBetween,
  compose,
  distance,
  flangePose,
  identity,
  jogScratch,
  jogStep,
  pose,
  radians,
  robotById,
  seededRandom,
  span,
  toMatrix,
  fromAxisAngle,
  type JogCell,
  type JogCommand,
  type Pose,
  type Vector3,
} from "../index.ts";

const robot = robotById("staubli_rx90l")!;
const DT = 1 / 60;
const plain: JogCell = { robot, worldFromBase: identity(), flangeFromTcp: pose([0, 0, 0.2]) };
const tcpOf = (cell: JogCell, q: ArrayLike<number>): Pose<"world", "tcp"> =>
  compose(compose(cell.worldFromBase, flangePose(cell.robot.arm, q)), cell.flangeFromTcp);
const tip = (
  linear_mps: Vector3,
  angular_rad_s: Vector3 = [0, 0, 0],
  frame: Extract<JogCommand, { kind: "tip" }>["frame"] = "world",
): JogCommand => ({ kind: "tip", linear_mps, angular_rad_s, frame });
const degs = (...angles: number[]): Float64Array => Float64Array.from(angles, radians);
const insideLimits = (q: ArrayLike<number>): boolean =>
  robot.arm.joints.every(({ limits }, j) => q[j]! >= limits.lower_rad - 1e-8 && q[j]! <= limits.upper_rad + 1e-8);
const withinSpeed = (a: ArrayLike<number>, b: ArrayLike<number>, dt: number): boolean =>
  robot.arm.joints.every(({ limits }, j) => Math.abs(a[j]! - b[j]!) <= limits.speed_rad_s * dt * (1 + 1e-9));

test("N-38 a step moves the tip by speed times time along the axes of the chosen frame and by nothing else", () => {
  const cell: JogCell = {
    robot,
    worldFromBase: pose([1, 2, 0.5], fromAxisAngle([0, 0, 1], 0.7)),
    flangeFromTcp: pose([0.02, 0, 0.2], fromAxisAngle([0, 1, 0], 0.4)),
  };
  const q = degs(20, -60, 110, 15, 40, -30);
  const out = new Float64Array(6);
  const before = tcpOf(cell, q);
  const user = fromAxisAngle([0.6, 0, 0.8], 1.1);
  const axes = { world: identity().quaternion, base: cell.worldFromBase.quaternion, tool: before.quaternion };
  for (const frame of ["world", "base", "tool", user] as const) {
    const R = toMatrix(typeof frame === "string" ? axes[frame] : frame);
    for (const axis of [0, 1, 2] as const) {
      const along: Vector3 = [0, 0, 0];
      along[axis] = 0.12;
      expect(jogStep(cell, q, tip(along, [0, 0, 0], frame), DT, out)).toMatchObject({
        kind: "moved",
        fraction: 1,
        blocked: [],
      });
      const after = tcpOf(cell, out);
      for (const i of [0, 1, 2] as const)
        expect(after.position[i] - before.position[i]).toBeCloseTo(R[3 * i + axis]! * 0.12 * DT, 10);
      expect(angleBetween(before.quaternion, after.quaternion)).toBeLessThan(1e-10);

      along[axis] = 0.5;
      expect(jogStep(cell, q, tip([0, 0, 0], along, frame), DT, out)).toMatchObject({ kind: "moved", fraction: 1 });
      const turned = tcpOf(cell, out);
      const worldAxis: Vector3 = [R[axis]!, R[3 + axis]!, R[6 + axis]!];
      const wanted = compose(pose([0, 0, 0], fromAxisAngle(worldAxis, 0.5 * DT)), pose([0, 0, 0], before.quaternion));
      expect(distance(turned.position, before.position)).toBeLessThan(1e-10);
      expect(angleBetween(turned.quaternion, wanted.quaternion)).toBeLessThan(1e-10);
    }
  }
});

test("N-38 joints run at the wanted speed, slowed together, and stop at their limits one by one", () => {
  const q = degs(0, -60, 100, 0, 119.9, 0);
  const out = new Float64Array(6);
  const fast = robot.arm.joints[0]!.limits.speed_rad_s * 2;
  expect(jogStep(plain, q, { kind: "joints", speed_rad_s: [fast, fast / 4, 0, 0, 0, 0] }, DT, out)).toMatchObject({
    kind: "moved",
    fraction: 0.5,
    blocked: [],
  });
  expect(out[0]! - q[0]!).toBeCloseTo((fast / 2) * DT, 12);
  expect(out[1]! - q[1]!).toBeCloseTo((fast / 8) * DT, 12);
  const stopped = jogStep(plain, q, { kind: "joints", speed_rad_s: [0.1, 0, 0, 0, 1, 0] }, DT, out);
  expect(stopped).toMatchObject({
    kind: "moved",
    blocked: [{ coordinate: 5, reach: { kind: "outside-limits", joint: 5 } }],
  });
  expect(stopped.blocked[0]!.sentence).toBe("Joint 5 would turn to 120.9°; its limit is 120.0°.");
  expect(out[4]).toBe(robot.arm.joints[4]!.limits.upper_rad);
  expect(jogStep(plain, out, { kind: "joints", speed_rad_s: [0, 0, 0, 0, 1, 0] }, DT, out).kind).toBe("blocked");
});

test("N-39 at the edge of reach that coordinate blocks and says why, the others go on", () => {
  const q = degs(0, -10, 30, 0, 40, 0);
  const scratch = jogScratch();
  let last = jogStep(plain, q, tip([0.25, 0, 0]), DT, q, scratch);
  for (let i = 0; i < 600 && last.blocked.length === 0; i++)
    last = jogStep(plain, q, tip([0.25, 0, 0]), DT, q, scratch);
  expect(last).toMatchObject({ kind: "blocked", blocked: [{ coordinate: "x", reach: { kind: "too-far" } }] });
  expect(last.blocked[0]!.sentence).toMatch(/^The wrist would be \d+ mm from the shoulder; the arm is 1100 mm long\.$/);
  const { distance_m, farthest_m } = span(robot, flangePose(robot.arm, q));
  expect(farthest_m - distance_m).toBeLessThan(0.25 * DT);

  const held = q.slice();
  const before = tcpOf(plain, q);
  expect(jogStep(plain, q, tip([0.25, 0, 0]), DT, q, scratch).kind).toBe("blocked");
  expect(q).toEqual(held);
  const inward = before.position[2] > 0.42 ? -1 : 1;
  const both = jogStep(plain, q, tip([0.25, 0, inward * 0.05]), DT, q, scratch);
  expect(both.kind).toBe("moved");
  expect(both.blocked.map(({ coordinate }) => coordinate)).toEqual(["x"]);
  const after = tcpOf(plain, q);
  expect(after.position[0]).toBeCloseTo(before.position[0], 9);
  expect(after.position[2] - before.position[2]).toBeCloseTo(inward * 0.05 * DT, 9);
  expect(jogStep(plain, q, tip([-0.25, 0, 0]), DT, q, scratch)).toMatchObject({ kind: "moved", blocked: [] });
});

test("N-39 a jog ends at the edge itself, within 0.1 mm of reach and within 0.01° of a limit, at every speed", () => {
  for (const [x, y, z] of [
    [0.25, 0, 0],
    [0.5, 0.3, 0],
    [0.05, -0.02, 0.03],
    [0, 0, -0.4],
  ] as const) {
    const q = degs(0, -10, 30, 0, 40, 0);
    const scratch = jogScratch();
    let last = jogStep(plain, q, tip([x, y, z]), DT, q, scratch);
    for (let i = 0; i < 2000 && last.kind === "moved"; i++) {
      const from = q.slice();
      last = jogStep(plain, q, tip([x, y, z]), DT, q, scratch);
      expect(withinSpeed(from, q, DT)).toBe(true);
    }
    const reach = last.blocked[0]!.reach;
    if (reach.kind === "too-far") {
      const { distance_m, farthest_m } = span(robot, flangePose(robot.arm, q));
      expect(farthest_m - distance_m).toBeLessThan(1e-4);
    } else if (reach.kind === "outside-limits")
      expect(Math.abs(q[reach.joint - 1]! - reach.limit_rad)).toBeLessThan(radians(0.01));
    else throw new Error(reach.kind);
  }
});

test("N-41 rotation out of space stops every angle, position goes on", () => {
  const q = degs(0, -60, 110, 0, 118, 0);
  const scratch = jogScratch();
  let last = jogStep(plain, q, tip([0, 0, 0], [0, 0.5, 0]), DT, q, scratch);
  for (let i = 0; i < 200 && last.blocked.length === 0; i++)
    last = jogStep(plain, q, tip([0, 0, 0], [0, 0.5, 0]), DT, q, scratch);
  expect(last).toMatchObject({
    kind: "blocked",
    blocked: [{ coordinate: "rotation", reach: { kind: "outside-limits", joint: 5 } }],
  });
  const before = tcpOf(plain, q);
  const more = jogStep(plain, q, tip([0, 0.1, 0], [0.3, 0.5, 0.2]), DT, q, scratch);
  expect(more.kind).toBe("moved");
  expect(more.blocked.map(({ coordinate }) => coordinate)).toEqual(["rotation"]);
  const after = tcpOf(plain, q);
  expect(angleBetween(before.quaternion, after.quaternion)).toBeLessThan(1e-9);
  expect(after.position[1] - before.position[1]).toBeCloseTo(0.1 * DT, 9);
});

test("N-18 from the singular start posture every direction that stays in reach is left by turning in place, never by a jump", () => {
  const home = Float64Array.from(robot.home_rad);
  const bent = degs(10, -120, 150, 0, 0, 25); // wrist straight
  const above = degs(0, -90 - 40, 90 + 80, 30, 50, 0); // wrist centre near axis 1
  above[1] = -Math.PI / 2 - Math.atan2(0.65 * Math.sin(radians(80)), 0.45 + 0.65 * Math.cos(radians(80)));
  for (const start of [home, bent, above]) {
    for (const linear of [
      [0.1, 0, -0.05],
      [0, 0.1, -0.05],
      [-0.07, 0.07, -0.1],
      [0, -0.1, -0.02],
      [0, 0.001, -0.0005],
    ] as const) {
      const enough = (100 * DT * Math.hypot(...linear)) / 2;
      const q = start.slice();
      const before = tcpOf(plain, q);
      const scratch = jogScratch();
      for (let i = 0; i < 400; i++) {
        const from = q.slice();
        const at = tcpOf(plain, q);
        const step = jogStep(plain, q, tip([...linear]), DT, q, scratch);
        expect(q.every(Number.isFinite)).toBe(true);
        expect(withinSpeed(from, q, DT)).toBe(true);
        const moved = distance(at.position, tcpOf(plain, q).position);
        expect(moved).toBeLessThanOrEqual(Math.hypot(...linear) * DT + 1e-8);
        if (step.kind === "blocked" || distance(before.position, tcpOf(plain, q).position) > enough) break;
      }
      expect(distance(before.position, tcpOf(plain, q).position)).toBeGreaterThan(enough);
    }
  }
});

test("N-18 turning out of the straight wrist works about every axis, at full and at creeping speed", () => {
  for (const [x, y, z] of [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [0.6, -0.8, 0],
    [-0.48, 0.6, 0.64],
  ] as const) {
    for (const rate of [0.5, 0.005]) {
      const q = degs(10, -120, 150, 20, 0, 25);
      const before = tcpOf(plain, q);
      const scratch = jogScratch();
      for (let i = 0; i < 200; i++) {
        const from = q.slice();
        expect(jogStep(plain, q, tip([0, 0, 0], [x * rate, y * rate, z * rate]), DT, q, scratch)).toMatchObject({
          kind: "moved",
          blocked: [],
        });
        expect(withinSpeed(from, q, DT)).toBe(true);
        if (angleBetween(before.quaternion, tcpOf(plain, q).quaternion) > 50 * DT * rate) break;
      }
      expect(angleBetween(before.quaternion, tcpOf(plain, q).quaternion)).toBeGreaterThan(50 * DT * rate);
      expect(distance(before.position, tcpOf(plain, q).position)).toBeLessThan(1e-6);
    }
  }
});

test("N-38 random jogs into and past every singularity keep speeds, limits and the exact tip, seed 7", () => {
  const random = seededRandom(7);
  const between = (a: number, b: number): number => a + (b - a) * random();
  for (let run = 0; run < 60; run++) {
    const q = Float64Array.from(robot.arm.joints, ({ limits }) => between(limits.lower_rad, limits.upper_rad));
    if (run % 3 === 0) q[4] = run % 2 === 0 ? 0 : between(-1e-6, 1e-6);
    if (run % 3 === 1) q[2] = Math.PI / 2 + (run % 2 === 0 ? 0 : between(-1e-6, 1e-6));
    const scratch = jogScratch();
    const direction: Vector3 = [between(-1, 1), between(-1, 1), between(-1, 1)];
    const spin: Vector3 = [between(-1, 1), between(-1, 1), between(-1, 1)];
    for (let i = 0; i < 120; i++) {
      const from = q.slice();
      const at = tcpOf(plain, q);
      const step = jogStep(plain, q, tip(direction, run % 2 === 0 ? [0, 0, 0] : spin), DT, q, scratch);
      expect(q.every(Number.isFinite)).toBe(true);
      expect(withinSpeed(from, q, DT)).toBe(true);
      expect(insideLimits(q)).toBe(true);
      const now = tcpOf(plain, q);
      if (step.kind === "blocked") {
        expect(q).toEqual(from);
        break;
      }
      const stood = new Set(step.blocked.map(({ coordinate }) => coordinate));
      for (const axis of [0, 1, 2] as const) {
        const wanted = stood.has((["x", "y", "z"] as const)[axis]) ? 0 : direction[axis] * DT * step.fraction;
        expect(Math.abs(now.position[axis] - at.position[axis] - wanted)).toBeLessThan(1e-8);
      }
    }
  }
});

test("N-38 nothing sticks on or beside a singularity: a jog moves on, turns in place for a bounded while, or says why not, seed 99", () => {
  const random = seededRandom(99);
  const between = (a: number, b: number): number => a + (b - a) * random();
  for (let run = 0; run < 600; run++) {
    const cell: JogCell = {
      robot,
      worldFromBase: pose([between(-1, 1), between(-1, 1), 0], fromAxisAngle([0, 0, 1], between(-3, 3))),
      flangeFromTcp: pose([between(-0.1, 0.1), 0, between(0, 0.3)], fromAxisAngle([0, 1, 0], between(-1, 1))),
    };
    const q = Float64Array.from(robot.arm.joints, ({ limits }) => between(limits.lower_rad, limits.upper_rad));
    const aside = between(-1, 1) * 10 ** between(-11, -6);
    const t2 = between(-1.2, 0.5);
    const t23 = Math.asin((-0.45 * Math.sin(t2)) / 0.65);
    if (run % 4 === 0) q[4] = run % 8 === 0 ? 0 : aside;
    if (run % 4 === 1) q[2] = Math.PI / 2 + (run % 8 === 1 ? 0 : aside);
    if (run % 4 === 2) {
      q[1] = t2 - Math.PI / 2 + (run % 8 === 2 ? 0 : aside);
      q[2] = t23 - t2 + Math.PI / 2;
    }
    if (run % 4 === 3 && run % 8 === 3) q.set(robot.home_rad);
    const command = tip(
      [between(-0.3, 0.3), between(-0.3, 0.3), between(-0.3, 0.3)],
      run % 2 === 0 ? [0, 0, 0] : [between(-1, 1), between(-1, 1), between(-1, 1)],
      (["world", "base", "tool"] as const)[run % 3]!,
    );
    const scratch = jogScratch();
    let standing = 0;
    let idle = 0;
    for (let i = 0; i < 150; i++) {
      const from = q.slice();
      const step = jogStep(cell, q, command, DT, q, scratch);
      expect(q.every(Number.isFinite)).toBe(true);
      expect(withinSpeed(from, q, DT)).toBe(true);
      if (step.kind === "blocked") break;
      standing = step.fraction < 1e-3 && step.blocked.length === 0 ? standing + 1 : 0;
      const share = Math.max(
        ...robot.arm.joints.map(({ limits }, j) => Math.abs(q[j]! - from[j]!) / (limits.speed_rad_s * DT)),
      );
      idle = step.fraction < 1e-3 && share < 0.3 ? idle + 1 : 0;
      expect(idle).toBeLessThan(5);
      expect(standing).toBeLessThan(75); // half a turn of joint 1 takes 46 steps; at a limit the coordinates that go may change
    }
  }
});

test("N-38 at a limit on a singularity the arm does not rock to and fro: it goes on or stands and says why, seed 5", () => {
  const random = seededRandom(5);
  const between = (a: number, b: number): number => a + (b - a) * random();
  for (let run = 0; run < 700; run++) {
    const cell: JogCell = {
      robot,
      worldFromBase: identity(),
      flangeFromTcp: pose([between(-0.1, 0.1), 0, between(0, 0.3)], fromAxisAngle([0, 1, 0], between(-1, 1))),
    };
    const q = Float64Array.from(robot.arm.joints, ({ limits }) => between(limits.lower_rad, limits.upper_rad));
    q[4] = 0;
    const joint = Math.floor(random() * 6);
    if (joint !== 4 && run % 2 === 0) {
      const { lower_rad, upper_rad } = robot.arm.joints[joint]!.limits;
      q[joint] = random() < 0.5 ? lower_rad : upper_rad;
    }
    const command = tip(
      [between(-0.3, 0.3), between(-0.3, 0.3), between(-0.3, 0.3)],
      run % 3 === 0 ? [0, 0, 0] : [between(-1, 1), between(-1, 1), between(-1, 1)],
    );
    const scratch = jogScratch();
    const past: Float64Array[] = [q.slice()];
    const apart = (a: Float64Array, b: Float64Array): number =>
      Math.max(...a.map((angle, j) => Math.abs(angle - b[j]!)));
    let rocking = 0;
    for (let i = 0; i < 120 && jogStep(cell, q, command, DT, q, scratch).kind === "moved"; i++) {
      past.unshift(q.slice());
      const back = [2, 3, 4].some(
        steps => past.length > steps && apart(past[0]!, past[steps]!) < 1e-4 && apart(past[0]!, past[1]!) > 1e-3,
      );
      rocking = back ? rocking + 1 : 0;
      expect(rocking).toBeLessThan(3);
    }
  }
});

test("numbers that are none are refused with a sentence and move nothing", () => {
  const q = degs(0, -60, 110, 0, 40, 0);
  const out = new Float64Array(6);
  for (const command of [
    tip([NaN, 0, 0]),
    tip([0, 0, 0], [Infinity, 0, 0]),
    { kind: "joints", speed_rad_s: [NaN, 0, 0, 0, 0, 0] } as const,
  ]) {
    const refused = jogStep(plain, q, command, DT, out);
    expect(refused.kind).toBe("blocked");
    expect(refused.blocked[0]!.sentence).toMatch(/not a finite number\.$/);
    expect(out).toEqual(q);
  }
});
