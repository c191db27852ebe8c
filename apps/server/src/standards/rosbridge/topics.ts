import type { RobotState, RobotStates } from "../robot-states.ts";
import { framePrefix, robotDescription, topicOf, transforms } from "../ros-names.ts";

/** ROS 1 counts a stamp in `secs` and `nsecs`, ROS 2 in `sec` and `nanosec`. */
export type RosGeneration = 1 | 2;
export const generationOf = (type: string | null | undefined): RosGeneration =>
  type?.includes("/") === true && !type.includes("/msg/") && !type.includes("/action/") ? 1 : 2;
const stamp = (ms: number, generation: RosGeneration): object => {
  const sec = Math.floor(ms / 1000);
  const nanosec = Math.floor((ms % 1000) * 1e6);
  return generation === 1 ? { secs: sec, nsecs: nanosec } : { sec, nanosec };
};
/** Transforms of all links are told this often at most [s]. */
const TRANSFORMS_S = 0.02;
const typeName = (pkg: string, name: string): string => `${pkg}/msg/${name}`;

export interface RosTopic {
  readonly type: string;
  /** Told with every sample, or when somebody subscribes and each second after. */
  readonly told: "sample" | "kept";
  /** Whose samples; null for all of them. */
  readonly robot: RobotState | null;
  /** Shortest time between two messages [s]. */
  readonly period_s: number;
  readonly message: (generation: RosGeneration) => object | null;
}

/**
 * Topics of the open robots. Each robot has its own behind its id; those of the robot that was opened first are those
 * of a cell with one robot as well. `/tf` is of all of them.
 */
export function rosTopics(states: RobotStates): ReadonlyMap<string, RosTopic> {
  const topics = new Map<string, RosTopic>();
  const add = (path: string, robot: RobotState): void => {
    topics.set(`${path}joint_states`, {
      type: typeName("sensor_msgs", "JointState"),
      told: "sample",
      robot,
      period_s: 0,
      message: generation => jointState(robot, generation),
    });
    topics.set(`${path}robot_description`, {
      type: typeName("std_msgs", "String"),
      told: "kept",
      robot,
      period_s: 0,
      message: () => robot.model && { data: robotDescription(robot.model) },
    });
  };
  let first = true;
  for (const robot of states.all.values()) {
    if (first) add("/", robot);
    first = false;
    add(topicOf(robot, ""), robot);
  }
  topics.set("/tf", {
    type: typeName("tf2_msgs", "TFMessage"),
    told: "sample",
    robot: null,
    period_s: TRANSFORMS_S,
    message: generation => ({
      transforms: [...states.all.values()].flatMap(robot => stamped(states, robot, generation)),
    }),
  });
  return topics;
}

function jointState(
  { joints, q_rad, speed_rad_s, sample, heard_ms }: RobotState,
  generation: RosGeneration,
): object | null {
  if (sample === null) return null;
  return {
    header: { stamp: stamp(heard_ms, generation), frame_id: "" },
    name: joints,
    position: Array.from(q_rad),
    velocity: Array.from(speed_rad_s),
    effort: [],
  };
}
function stamped(states: RobotStates, robot: RobotState, generation: RosGeneration): readonly object[] {
  if (robot.sample === null) return [];
  const header = stamp(robot.heard_ms, generation);
  return transforms(robot, framePrefix(states, robot)).map(({ parent, child, pose: { position, quaternion } }) => ({
    header: { stamp: header, frame_id: parent },
    child_frame_id: child,
    transform: {
      translation: { x: position[0], y: position[1], z: position[2] },
      rotation: { x: quaternion[0], y: quaternion[1], z: quaternion[2], w: quaternion[3] },
    },
  }));
}
