import { describe, expect, test } from "vitest";
import { checkJointLine } from "@twincell/core";
import { isThere, sharedCell } from "../../../../bench/collision.ts";

const there = isThere() ? sharedCell() : undefined;

describe.skipIf(!there)(
  "the KR 6 R900 among boxes and a concave jig (skipped where the shared cell is not beside the checkout)",
  () => {
    test("1,000 verdicts on exact meshes agree with coal's", () => {
      const { collider, cases } = there!;
      expect(cases.length).toBe(1000);
      expect(cases.filter(({ q_rad, collides }) => collider.collides(q_rad) !== collides)).toEqual([]);
      expect(cases.filter(({ q_rad, collides }) => collider.check(q_rad).length > 0 !== collides)).toEqual([]);
    });

    test("motions proven clear hold no colliding sample, and no first contact is later than the first sample that collides", () => {
      const { collider, cases } = there!;
      const free = cases.filter(({ collides }) => !collides).map(({ q_rad }) => q_rad);
      const verdicts = { clear: 0, contact: 0, undecided: 0 };
      for (let i = 0; i < 40; i++) {
        const from = free[2 * i]!;
        const to = free[2 * i + 1]!;
        const verdict = checkJointLine(collider, from, to);
        verdicts[verdict.kind]++;
        for (let s = 0; s <= 200; s++) {
          if (!collider.collides(from.map((q, k) => q + ((to[k]! - q) * s) / 200))) continue;
          expect(verdict.kind === "contact" ? verdict.at : Infinity).toBeLessThanOrEqual(s / 200 + 1e-3);
          break;
        }
      }
      expect(verdicts.clear).toBeGreaterThan(10);
      expect(verdicts.contact).toBeGreaterThan(3);
      expect(verdicts.undecided).toBe(0);
    });
  },
);
