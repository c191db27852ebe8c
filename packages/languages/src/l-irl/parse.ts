import { emptyProgram, type Parsed, type Pose, type Robot, type Step } from "@twincell/core";
import { textFault } from "../parser/index.ts";
import { LINES } from "./lines.ts";
import { readPoseList } from "./read/list.ts";
import type { PoseList } from "./read/pose-list.ts";

/** Share of the full speed at which poses are visited of which the list says only where they are. */
const VISITING_RATIO = 0.2;

/**
 * The program of a list. A list without motions is a list of places: each pose becomes a straight move, in their order.
 */
export function parsePoseList(text: string, robot: Robot, worldFromBase: Pose<"world", "base">): Parsed {
  const read = readPoseList(text, robot, worldFromBase);
  if (read.kind === "not-understood") return read;
  const { list } = read;
  const isPlaces = list.poses.size > 0 && !list.steps.some(({ step }) => step.type !== "comment");
  const warnings = isPlaces
    ? [
        textFault(
          { line: list.poses.values().next().value?.line ?? 1, column: 1 },
          "MOVE",
          `The list names poses and moves to none of them: each of its ${list.poses.size} poses became a step.`,
        ),
      ]
    : [];
  return {
    kind: "parsed",
    warnings,
    program: {
      ...emptyProgram(robot.id, list.program),
      tools: Object.fromEntries(list.tools),
      frames: Object.fromEntries(list.frames),
      groups: Object.fromEntries(list.groups),
      steps: isPlaces ? visits(list) : list.steps.map(({ step }) => step),
    },
  };
}

/** To the first pose by the joints, since the way there is not known, and straight on from it. */
const visits = ({ poses }: PoseList): Step[] =>
  Array.from(
    poses,
    (
      [
        name,
        {
          worldFromTcp: { position, quaternion },
        },
      ],
      i,
    ): Step => ({
      id: `s${i + 1}`,
      name,
      type: "move",
      path: i === 0 ? "ptp" : "lin",
      target: { pose: { position, quaternion }, frame: "world", tool: "flange" },
      speed: { ratio: VISITING_RATIO },
      blend_m: 0,
    }),
  );

/** Whether a list names poses and moves to none of them: no line of it is a motion. */
export const isListOfPlaces = (text: string): boolean =>
  !text.split(/\r\n|\n|\r/).some(line => LINES.motion.test(line));
