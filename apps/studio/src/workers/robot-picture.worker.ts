import "./know-robots.ts";
import { robotById } from "@twincell/core";
import { robotPicture } from "../runtime/pictures/robot-picture.ts";
import type { FromRobotPainter, ToRobotPainter } from "./robot-picture-messages.ts";

addEventListener("message", ({ data: { id, robot: robotId, width, height } }: MessageEvent<ToRobotPainter>) => {
  const robot = robotById(robotId);
  const message: FromRobotPainter = { id, picture: robot ? robotPicture(robot, width, height) : null };
  postMessage(message, { transfer: message.picture ? [message.picture.data.buffer] : [] });
});
