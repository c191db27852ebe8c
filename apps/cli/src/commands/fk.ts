import { armScratch, compose, flangePose, identity, type Pose } from "@twincell/core";
import { given } from "../io/arguments.ts";
import { jsonLines, lineWriter } from "../io/json-lines.ts";
import { robotOf, ROBOT_HELP, ROBOT_OPTIONS } from "../io/robot.ts";
import { jointsOf } from "../io/values.ts";
import type { Command } from "../io/usage.ts";

export const fkCommand: Command = {
  name: "fk",
  summary: "joint angles in, pose of the tip out",
  usage: `twincell fk --robot R [--base LINK] [--tip LINK]  < joints.jsonl > poses.jsonl

Reads JSON lines {"q":[…]} (radians) and writes POSE lines {"position":[x,y,z],"quaternion":[x,y,z,w]} of the tip in the base.
${ROBOT_HELP}`,
  async run(args) {
    const options = given(args, { ...ROBOT_OPTIONS, json: { type: "boolean" } });
    const { robot, baseFromRoot, flangeFromTip } = await robotOf(options);
    const writer = lineWriter();
    const scratch = armScratch();
    const flange = identity<"base", "flange">();
    const tip: Pose = identity();
    for await (const { line, value } of jsonLines()) {
      const q = jointsOf(value, line, robot.arm.joints.length, robot.name);
      compose(compose(baseFromRoot, flangePose(robot.arm, q, flange, scratch) as Pose, tip), flangeFromTip, tip);
      writer.write({ position: tip.position, quaternion: tip.quaternion });
    }
    await writer.end();
    return 0;
  },
};
