import { robotById, seededRandom, type JointSample } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { PathAhead, StraightPath } from "./known-path.ts";
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
