import {
  checkProgram,
  emptyProgram,
  linkSolids,
  pose,
  robotById,
  samplePlan,
  seededRandom,
  type JointSample,
  type MoveStep,
  type Program,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { PathAhead, PlannedPath, StraightPath } from "./known-path.ts";
import { StopForecast } from "./stop-forecast.ts";

const robot = robotById("yaskawa_gp8")!;
const n = robot.arm.joints.length;
const FROM = new Float64Array(n);
const TO = Float64Array.from(FROM, (_, i) => (i === 0 ? 1 : 0.2));
const at = (part: number): Float64Array => FROM.map((from, i) => from + part * (TO[i]! - from));
const REACH_S = 0.5;
/** Something stands beyond the target: no point of the path is in it. */
const beyond = (q_rad: ArrayLike<number>): boolean => q_rad[0]! <= 1.000001;

describe("a path that is known", () => {
  test("what stands beyond the target stops nothing, wherever the joints point", () => {
    const look = new PathAhead(new StraightPath(FROM, TO), n);
    for (let part = 0; part <= 1; part += 0.01) expect(look.look(at(part), at(part + 2), REACH_S, beyond)).toBe("free");
  });
  test("what stands on the way is found as soon as a stop would end in it, and not before", () => {
    const look = new PathAhead(new StraightPath(FROM, TO), n);
    const isSafe = (q_rad: ArrayLike<number>): boolean => q_rad[0]! < 0.6;
    const found: number[] = [];
    for (let part = 0; part <= 0.5; part += 0.01)
      if (look.look(at(part), at(part + 0.2), REACH_S, isSafe) === "unsafe") found.push(part);
    expect(found[0]).toBeCloseTo(0.4, 1);
  });
  test("a robot that left it is no longer looked for on it", () => {
    const look = new PathAhead(new StraightPath(FROM, TO), n);
    const aside = at(0.3);
    aside[4]! += 0.2;
    expect(look.look(aside, at(0.4), REACH_S, () => true)).toBe("off");
  });
  test("beside it, what is met on the way back to it is found", () => {
    const look = new PathAhead(new StraightPath(FROM, TO), n);
    const aside = at(0.3);
    aside[4]! += 0.03;
    expect(look.look(aside, at(0.4), REACH_S, q_rad => q_rad[4]! < 0.085)).toBe("unsafe");
    expect(look.look(aside, at(0.4), REACH_S, () => true)).toBe("free");
  });
  test("in a cell that changed it is looked along again", () => {
    const look = new PathAhead(new StraightPath(FROM, TO), n);
    expect(look.look(at(0.1), at(0.5), REACH_S, () => true)).toBe("free");
    const isSafe = (q_rad: ArrayLike<number>): boolean => q_rad[0]! < 0.3 || q_rad[0]! > 0.4;
    expect(look.look(at(0.1), at(0.5), REACH_S, isSafe)).toBe("free");
    look.forget();
    expect(look.look(at(0.1), at(0.5), REACH_S, isSafe)).toBe("unsafe");
  });
});

describe("T-63 a corner of a plan, which a controller rounds in a way of its own", () => {
  const posture = (s: number, l: number): Float64Array => Float64Array.from(FROM, (_, i) => [s, l][i] ?? 0);
  const step = (id: string, q: Float64Array, blend_m: number): MoveStep => ({
    id,
    type: "move",
    path: "ptp",
    target: { q: [...q] },
    speed: { ratio: 0.3 },
    blend_m,
  });
  const CORNER = 0.8;
  const program: Program = {
    ...emptyProgram(robot.id),
    steps: [step("a", posture(CORNER, 0), 0.3), step("b", posture(CORNER, 0.8), 0)],
  };
  const cell = { worldFromBase: pose<"world", "base">(), links: linkSolids(robot), objects: [], allowedPairs: [] };
  const { plan, corners } = checkProgram(program, robot, {
    start_rad: FROM,
    cell: { ...cell, shapeError_m: 0 },
    cornerAreas: true,
  });
  const [area] = corners!;
  /** A controller that begins to turn as early and ends as late as it may, straight from there to there. */
  const cut = (part: number): Float64Array => {
    const [first, last] = [posture(0, 0), posture(0, 0)];
    samplePlan(plan, area!.from_s, first);
    samplePlan(plan, area!.to_s, last);
    return first.map((q, i) => q + part * (last[i]! - q));
  };
  /** Looks along the plan, then along the way that cuts its corner off; the joints point where they go. */
  function goRound(isSafe: (q_rad: ArrayLike<number>) => boolean, areas = corners): readonly string[] {
    const path = new PlannedPath(plan, n, areas ?? []);
    const ahead = new PathAhead(path, n);
    const looks: string[] = [];
    const look = (q_rad: Float64Array, before: Float64Array): void => {
      path.take(q_rad);
      const ahead_rad = q_rad.map((q, i) => q + 20 * (q - before[i]!));
      looks.push(ahead.look(q_rad, ahead_rad, 0.3, isSafe));
    };
    let before = posture(0, 0);
    for (let t_s = 0; t_s < area!.from_s; t_s += 0.01) {
      const q_rad = posture(0, 0);
      samplePlan(plan, t_s, q_rad);
      look(q_rad, before);
      before = q_rad;
    }
    for (let part = 0; part <= 1; part += 0.02) {
      look(cut(part), before);
      before = cut(part);
    }
    return looks;
  }
  const isAt = (q_rad: ArrayLike<number>, place: Float64Array, within: number): boolean =>
    place.every((q, i) => Math.abs(q - q_rad[i]!) < within);

  test("is not entered where something is in its area that the planned curve does not meet", () => {
    const inside = cut(0.5);
    const isSafe = (q_rad: ArrayLike<number>): boolean => !isAt(q_rad, inside, 0.06);
    const onPlan = posture(0, 0);
    for (let t_s = 0; t_s <= plan.duration_s; t_s += 0.005) {
      samplePlan(plan, t_s, onPlan);
      expect(isSafe(onPlan)).toBe(true);
    }
    const entered = Math.ceil(area!.from_s / 0.01);
    const looks = goRound(isSafe);
    expect(looks.slice(0, entered)).toContain("unsafe");
    expect(looks.indexOf("unsafe"), "as late as a stop allows").toBeGreaterThan(entered - 40);
    // Without the area it is found too late: the way that is known does not come there.
    expect(goRound(isSafe, []).slice(0, entered)).not.toContain("unsafe");
  });

  test("is free where all of its area is, wherever in it the robot is", () => {
    const looks = goRound(() => true);
    expect(new Set(looks)).toEqual(new Set(["free"]));
    expect(new Set(goRound(() => true, []))).toContain("off");
  });

  test("is looked at again in a cell that changed", () => {
    const path = new PlannedPath(plan, n, corners!);
    const ahead = new PathAhead(path, n);
    path.take(FROM);
    expect(ahead.look(FROM, FROM, 10, () => true)).toBe("free");
    const inside = cut(0.5);
    const isSafe = (q_rad: ArrayLike<number>): boolean => !isAt(q_rad, inside, 0.06);
    expect(ahead.look(FROM, FROM, 10, isSafe)).toBe("free");
    ahead.forget();
    expect(ahead.look(FROM, FROM, 10, isSafe)).toBe("unsafe");
  });
});

test("samples whose times are uneven by a third gain no speed that a joint cannot gain", () => {
  const random = seededRandom(3);
  const RATE = 0.5;
  const BRAKING_S = 0.5;
  const DELAY_S = 0.02;
  const forecast = new StopForecast(robot, FROM, BRAKING_S, DELAY_S);
  const sample = { q_rad: new Float64Array(n) } as unknown as JointSample & { q_rad: Float64Array };
  let most = 0;
  for (let k = 1; k < 500; k++) {
    sample.q_rad[0] = 0.01 * k * RATE;
    forecast.take(sample, 0.01 * (2 / 3 + (2 / 3) * random()));
    most = Math.max(most, forecast.ahead_rad[0]! - sample.q_rad[0]);
  }
  const { speed_rad_s, acceleration_rad_s2 } = robot.arm.joints[0]!.limits;
  const fastest = Math.min(speed_rad_s, 1.5 * RATE + acceleration_rad_s2 * (0.01 + DELAY_S + 0.01));
  expect(most).toBeLessThanOrEqual(fastest * (0.02 + DELAY_S + BRAKING_S / 2));
});
