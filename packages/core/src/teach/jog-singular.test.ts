import { describe, expect, test } from "vitest";
import {
  angleBetween,
  distance,
  flangePose,
  identity,
  jogScratch,
  jogStep,
  robotById,
  seededRandom,
  type JogCell,
  type JogCommand,
} from "../index.ts";
import { singularJogs } from "./testing/singular-jogs.ts";

const NAMES = { 2: "wrist over axis 1", 3: "arm stretched", 5: "wrist straight" } as const;

// scripts/soak/jog-singular.ts runs a thousand of each.
describe.each(["staubli_rx90l", "kuka_kr6_2", "yaskawa_gp8", "ur10e"])("jogging %s into each singularity", id => {
  test.each([2, 3, 5] as const)(
    "joint %i: every jog can leave, no joint is too fast or leaves its limits, the tip keeps to its way, 0 NaN",
    joint => {
      const { jogs, left, limited, arrived, notNumbers, tooFast, outside, strayed, stuck } = singularJogs(
        robotById(id)!,
        joint,
        24,
        seededRandom(100 + joint),
      );
      expect(stuck, NAMES[joint]).toEqual([]);
      expect(limited).toBeLessThanOrEqual(1);
      expect({ left, notNumbers, tooFast, outside, strayed }).toEqual({
        left: jogs - limited,
        notNumbers: 0,
        tooFast: 0,
        outside: 0,
        strayed: 0,
      });
      expect(arrived).toBeGreaterThan(0.9 * jogs);
    },
  );
});

describe("arms jogged by damped least squares", () => {
  test.each([["abb_crb15000_5_95", 3, 8]] as const)(
    "%s joint %i: jogs leave the singularity within speeds and limits, 0 NaN",
    (id, joint, wanted) => {
      const { jogs, left, notNumbers, tooFast, outside } = singularJogs(
        robotById(id)!,
        joint,
        wanted,
        seededRandom(200 + joint),
      );
      expect({ notNumbers, tooFast, outside }).toEqual({ notNumbers: 0, tooFast: 0, outside: 0 });
      expect(left).toBeGreaterThanOrEqual(0.9 * jogs);
    },
  );

  test.each(["ur10e", "abb_crb15000_5_95", "kuka_lbr_iiwa_14_r820"])(
    "N-38 a step of %s moves the tip by speed times time and by nothing else, and back again",
    id => {
      const robot = robotById(id)!;
      const cell: JogCell = { robot, worldFromBase: identity(), flangeFromTcp: identity() };
      const random = seededRandom(9);
      const scratch = jogScratch();
      const DT = 1 / 60;
      for (let n = 0; n < 20; n++) {
        const q = Float64Array.from(
          robot.arm.joints,
          ({ limits }) =>
            0.5 * Math.max(limits.lower_rad, -2) +
            0.5 * (Math.min(limits.upper_rad, 2) - Math.max(limits.lower_rad, -2)) * random(),
        );
        const start = q.slice();
        const command: JogCommand = {
          kind: "tip",
          linear_mps: [0.1 * (random() - 0.5), 0.1 * (random() - 0.5), 0.1 * (random() - 0.5)],
          angular_rad_s: [0, 0, 0],
          frame: "world",
        };
        const back: JogCommand = {
          ...command,
          linear_mps: [-command.linear_mps[0], -command.linear_mps[1], -command.linear_mps[2]],
        };
        const before = flangePose(robot.arm, q);
        const jogged = jogStep(cell, q, command, DT, q, scratch);
        const after = flangePose(robot.arm, q);
        if (jogged.kind === "blocked" || jogged.blocked.length > 0 || jogged.fraction < 1) continue;
        for (const axis of [0, 1, 2] as const)
          expect(after.position[axis] - before.position[axis]).toBeCloseTo(command.linear_mps[axis] * DT, 8);
        expect(angleBetween(before.quaternion, after.quaternion)).toBeLessThan(2e-8);
        expect(jogStep(cell, q, back, DT, q, scratch).kind).toBe("moved");
        expect(distance(flangePose(robot.arm, q).position, before.position)).toBeLessThan(1e-8);
        expect(Math.max(...q.map((angle, j) => Math.abs(angle - start[j]!)))).toBeLessThan(0.02);
      }
    },
  );
});
