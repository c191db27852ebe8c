/** JSON Schemas of what is told, under the names by which Foxglove draws it. */
const number = { type: "number" };
const text = { type: "string" };
const whole = { type: "integer" };
const flag = { type: "boolean" };
const fields = (properties: object): object => ({ type: "object", properties });
const time = fields({ sec: whole, nsec: whole });
const list = (items: object): object => ({ type: "array", items });
const named = (schemaName: string, properties: object) => ({
  schemaName,
  schema: JSON.stringify({ title: schemaName, type: "object", properties }),
});

export type ChannelKind = "joints" | "transforms" | "description" | "state";
export const ADVERTISED = {
  joints: named("foxglove.JointStates", {
    timestamp: time,
    joints: list(fields({ name: text, position: number, velocity: number })),
  }),
  transforms: named("foxglove.FrameTransforms", {
    transforms: list(
      fields({
        timestamp: time,
        parent_frame_id: text,
        child_frame_id: text,
        translation: fields({ x: number, y: number, z: number }),
        rotation: fields({ x: number, y: number, z: number, w: number }),
      }),
    ),
  }),
  description: named("std_msgs/String", { data: text }),
  state: named("twincell.RobotState", {
    timestamp: time,
    connected: flag,
    mode: text,
    safety: text,
    moving: flag,
    override: number,
    step: text,
    message: text,
    holder: text,
    signals: { type: "object" },
  }),
  log: named("foxglove.Log", {
    timestamp: time,
    level: whole,
    message: text,
    name: text,
    file: text,
    line: whole,
  }),
} as const;
