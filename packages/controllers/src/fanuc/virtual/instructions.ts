import {
  compose,
  flangePose,
  fromFanucWpr,
  pose,
  type MoveStep,
  type Pose,
  type Robot,
  type Step,
  type AxisCounting,
  axesOfJoints,
  jointsOfAxes,
} from "@twincell/core";
import { RMI_ERROR, rmiJoints, rmiNumber, rmiPart, type RmiPacket } from "../codec/rmi.ts";
import { askedConfiguration, branchOfConfiguration, jointsIn, JOINTS } from "../codec/configuration.ts";

export type Instruction =
  | { readonly kind: "step"; readonly make: (q_rad: Float64Array) => Step }
  | { readonly kind: "call"; readonly program: string }
  | { readonly kind: "nothing" }
  | { readonly kind: "error"; readonly id: number };
const PLACE = ["X", "Y", "Z", "W", "P", "R"] as const;
const error = (id: number): Instruction => ({ kind: "error", id });

/**
 * What an instruction makes the arm do; its target may count from where the arm then stands. Passing a point (CNT, CR)
 * ends at it.
 */
export function instructionOf({ name, fields }: RmiPacket, robot: Robot, joints: AxisCounting): Instruction {
  switch (name) {
    case "FRC_WaitTime": {
      const s = rmiNumber(fields, "Time");
      return s >= 0 ? { kind: "step", make: () => ({ id: "wait", type: "wait", s }) } : error(RMI_ERROR.value);
    }
    case "FRC_Call": {
      const program = fields["ProgramName"];
      return typeof program === "string" && /^[A-Za-z][A-Za-z0-9_]{0,35}$/.test(program)
        ? { kind: "call", program }
        : error(RMI_ERROR.value);
    }
    case "FRC_SetUFrame":
    case "FRC_SetUTool":
      return { kind: "nothing" };
    case "FRC_JointMotionJRep":
    case "FRC_LinearMotionJRep":
    case "FRC_JointRelativeJRep": {
      const speed = speedOf(fields, name.startsWith("FRC_Linear"));
      const j_deg = new Float64Array(JOINTS);
      if (!speed) return error(RMI_ERROR.value);
      if (!rmiJoints(fields, j_deg)) return error(RMI_ERROR.position);
      return {
        kind: "step",
        make: q_rad => {
          const target = j_deg.slice();
          if (name === "FRC_JointRelativeJRep")
            axesOfJoints(joints, q_rad, new Float64Array(JOINTS)).forEach((value, i) => {
              target[i]! += value;
            });
          return {
            ...speed,
            path: name.startsWith("FRC_Linear") ? "lin" : "ptp",
            target: { q: [...jointsOfAxes(joints, target, new Float64Array(JOINTS))] },
          };
        },
      };
    }
    case "FRC_LinearMotion":
    case "FRC_JointMotion":
    case "FRC_LinearRelative": {
      const speed = speedOf(fields, name.startsWith("FRC_Linear"));
      const part = rmiPart(fields, "Position");
      const v = PLACE.map(axis => rmiNumber(part, axis));
      if (!speed) return error(RMI_ERROR.value);
      if (!v.every(value => Number.isFinite(value))) return error(RMI_ERROR.position);
      const isJoint = name === "FRC_JointMotion";
      const asked = name === "FRC_LinearRelative" ? null : askedConfiguration(fields);
      const there = compose(
        robot.baseFromVendorWorld as Pose,
        pose([v[0]! / 1000, v[1]! / 1000, v[2]! / 1000], fromFanucWpr(v[3]!, v[4]!, v[5]!)),
      );
      if (asked === undefined) return error(RMI_ERROR.position);
      if (asked && isJoint && !jointsIn(robot, there as Pose<"base", "flange">, asked))
        return error(RMI_ERROR.position);
      return {
        kind: "step",
        make: q_rad => {
          const at: Pose = name === "FRC_LinearRelative" ? moved(robot, q_rad, v) : there;
          const q = asked && isJoint ? jointsIn(robot, at as Pose<"base", "flange">, asked, q_rad) : undefined;
          if (q) return { ...speed, path: "ptp", target: { q } };
          // The base is the world here, and the flange its tool. A line arrives in the posture that it is asked for, or
          // not at all.
          return {
            ...speed,
            path: isJoint ? "ptp" : "lin",
            target: {
              pose: at as Pose<"frame", "tcp">,
              frame: "world",
              tool: "flange",
              ...(asked ? { branch: branchOfConfiguration(robot, asked) } : {}),
            },
          };
        },
      };
    }
    default:
      return error(RMI_ERROR.instruction);
  }
}

/** Along and about the axes of the world. */
function moved(robot: Robot, q_rad: Float64Array, v: readonly number[]): Pose {
  const from = flangePose(robot.arm, q_rad);
  const turn = compose(pose([0, 0, 0], fromFanucWpr(v[3]!, v[4]!, v[5]!)), pose([0, 0, 0], from.quaternion));
  return {
    position: [from.position[0] + v[0]! / 1000, from.position[1] + v[1]! / 1000, from.position[2] + v[2]! / 1000],
    quaternion: turn.quaternion,
  };
}

/** A motion without its target; undefined when its speed is none. */
function speedOf(
  fields: Readonly<Record<string, unknown>>,
  isPath: boolean,
): Omit<MoveStep, "path" | "target"> | undefined {
  const value = rmiNumber(fields, "Speed");
  const kind = fields["SpeedType"];
  const most = rmiNumber(fields, "ACC");
  const base = {
    id: "motion",
    type: "move",
    blend_m: 0,
    ...(Number.isNaN(most) ? {} : { acceleration: { ratio: Math.min(1, Math.max(0.01, most / 100)) } }),
  } as const;
  if (!(value > 0)) return undefined;
  if (kind === "mSec") return { ...base, speed: { time_s: value / 1000 } };
  if (isPath) return kind === "mmSec" ? { ...base, speed: { mps: value / 1000 } } : undefined;
  return kind === "Percent" && value <= 100 ? { ...base, speed: { ratio: value / 100 } } : undefined;
}
