import { linkPoses } from "../../kinematics/forward.ts";
import { compose, identity, transformPoint, type Pose } from "../../spatial/pose.ts";
import { cross, distance, normalize, subtract, type Vector3 } from "../../spatial/vector.ts";
import { rotate } from "../../spatial/quaternion.ts";
import type { Robot } from "../../model/robot.ts";
import { merge, prism, type Frame } from "./loft.ts";
import type { LinkDesign } from "./link-shape.ts";
import { circle, filleted } from "./outline.ts";
import { shell } from "./standing.ts";

/** Any two unit vectors u, v with u × v = w. */
function frameAlong(origin: Vector3, w: Vector3): Frame {
  const helper: Vector3 = Math.abs(w[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const u = normalize(cross(helper, w));
  return { origin, u, v: cross(w, u) };
}

/**
 * Drums on the joint axes and tubes between them, seen from the base with all joints at zero:
 * what is drawn of an arm whose form nobody has described.
 */
export function plainArm(robot: Robot): LinkDesign[] {
  const { arm } = robot;
  const n = arm.joints.length;
  const at = Array.from({ length: n + 1 }, () => identity<"base", "link">());
  linkPoses(arm, new Float64Array(n), at);
  const places: Vector3[] = [[0, 0, 0], ...arm.joints.map((_, i) => at[i + 1]!.position)];
  places.push(compose(at[n] as Pose, arm.lastJointFromFlange as Pose).position);
  const thick = robot.reach_m * 0.075;
  return Array.from({ length: n + 1 }, (_, link) => {
    const radius = thick * (1 - 0.6 * (link / (n + 1)));
    const meshes = [];
    const shells = [];
    const from = places[link]!;
    const to = places[link + 1]!;
    const length = distance(from, to);
    if (link > 0) {
      const axis = frameAlong(from, rotate(at[link]!.quaternion, arm.joints[link - 1]!.axis));
      meshes.push(
        prism(
          axis,
          circle(radius),
          filleted(
            [
              [radius * 0.3, -radius * 1.1],
              [0, -radius * 1.1],
              [0, radius * 1.1],
              [radius * 0.3, radius * 1.1],
            ],
            radius * 0.2,
          ),
        ),
      );
      shells.push(shell(axis, circle(radius * 1.01, 12, "around"), -radius * 1.11, radius * 1.11));
    }
    if (length > 1e-6) {
      const along = frameAlong(from, normalize(subtract(to, from)));
      meshes.push(
        prism(along, circle(radius * 0.8), [
          [0, 0],
          [radius * 0.08, length],
        ]),
      );
      shells.push(shell(along, circle(radius * 0.81, 12, "around"), 0, length));
    }
    if (meshes.length === 0) {
      const here = frameAlong(transformPoint(at[link]!, [0, 0, 0]), [0, 0, 1]);
      meshes.push(
        prism(here, circle(radius), [
          [0, -radius],
          [0, radius],
        ]),
      );
      shells.push(shell(here, circle(radius * 1.01, 12, "around"), -radius * 1.01, radius * 1.01));
    }
    return {
      parts: [
        {
          name: link === 0 ? "base" : `link ${link}`,
          material: link > n - 2 ? ("dark" as const) : ("casting" as const),
          mesh: merge(meshes),
        },
      ],
      shells,
    };
  });
}
