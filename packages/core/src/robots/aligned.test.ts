import { expect, test } from "vitest";
import { flangePose, linkPoses } from "../kinematics/forward.ts";
import { seededRandom } from "../random.ts";
import { identity } from "../spatial/pose.ts";
import { angleBetween } from "../spatial/quaternion.ts";
import { distance } from "../spatial/vector.ts";
import { alignedWithBase } from "./aligned.ts";
import { LIBRARY } from "./library/index.ts";

test.each(LIBRARY.map(robot => [robot.id, robot.arm] as const))(
  "L-10 %s: n + 1 link frames, at the joints, turned as the base when all angles are 0; the flange goes where it went",
  (_, arm) => {
    const aligned = alignedWithBase(arm);
    const n = arm.joints.length;
    const random = seededRandom(10);
    const links = (of: typeof arm, q: number[]) => {
      const out = Array.from({ length: n + 1 }, () => identity<"base", "link">());
      linkPoses(of, q, out);
      return out;
    };
    const zero = links(
      aligned,
      arm.joints.map(() => 0),
    );
    expect(zero.length).toBe(n + 1);
    for (const { quaternion } of zero) expect(angleBetween(quaternion, [0, 0, 0, 1])).toBe(0);
    for (let k = 0; k < 20; k++) {
      const q = arm.joints.map(() => 6 * random() - 3);
      const one = flangePose(arm, q);
      const other = flangePose(aligned, q);
      const before = links(arm, q);
      const after = links(aligned, q);
      expect(
        Math.max(distance(one.position, other.position), angleBetween(one.quaternion, other.quaternion)),
      ).toBeLessThan(1e-12);
      before.forEach(({ position }, i) => {
        expect(distance(position, after[i]!.position)).toBeLessThan(1e-12);
      });
    }
  },
);
