import { z } from "zod";

const name = z.string().min(1).max(256);
const id = z.exactOptional(z.string().max(256));
const fields = z.record(z.string(), z.unknown());

/** What a client of rosbridge v2 (RobotWebTools/rosbridge_suite, ROSBRIDGE_PROTOCOL.md) says and is answered. */
export const rosbridgeRequest = z.discriminatedUnion("op", [
  z.object({ op: z.literal("advertise"), id, topic: name, type: name }),
  z.object({ op: z.literal("unadvertise"), id, topic: name }),
  z.object({ op: z.literal("publish"), id, topic: name, msg: fields.default({}) }),
  z.object({
    op: z.literal("subscribe"),
    id,
    topic: name,
    type: z.exactOptional(z.string().max(256).nullable()),
    throttle_rate: z.exactOptional(z.number().min(0).max(3_600_000).nullable()),
    compression: z.exactOptional(z.string().nullable()),
  }),
  z.object({ op: z.literal("unsubscribe"), id, topic: name }),
  z.object({ op: z.literal("call_service"), id, service: name, args: z.unknown() }),
  z.object({
    op: z.literal("send_action_goal"),
    id,
    action: name,
    action_type: z.exactOptional(z.string().max(256).nullable()),
    args: z.unknown(),
    feedback: z.exactOptional(z.boolean().nullable()),
  }),
  z.object({ op: z.literal("cancel_action_goal"), id, action: name }),
  z.object({ op: z.literal("set_level"), id }),
  z.object({ op: z.literal("status"), id }),
]);
export type RosbridgeRequest = z.infer<typeof rosbridgeRequest>;
export type RosbridgeRequestOf<Op extends RosbridgeRequest["op"]> = Extract<RosbridgeRequest, { readonly op: Op }>;

/** Durations of ROS 2 and of ROS 1. */
const duration = z.union([
  z.object({ sec: z.int(), nanosec: z.int().min(0).default(0) }).transform(({ sec, nanosec }) => sec + nanosec / 1e9),
  z.object({ secs: z.int(), nsecs: z.int().min(0).default(0) }).transform(({ secs, nsecs }) => secs + nsecs / 1e9),
]);
/** Goal of `control_msgs/action/FollowJointTrajectory`; tolerances and velocities of points are not looked at. */
export const trajectoryGoal = z.object({
  trajectory: z.object({
    joint_names: z.array(name).min(1).max(16),
    points: z
      .array(z.object({ positions: z.array(z.number()).min(1).max(16), time_from_start: duration }))
      .min(1)
      .max(1000),
  }),
});
export type TrajectoryGoal = z.infer<typeof trajectoryGoal>;
