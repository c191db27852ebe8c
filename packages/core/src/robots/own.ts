import type { Robot } from "../model/robot.ts";
import { libraryRobotOf } from "./identity.ts";
import { parseRobot, type RobotAnswer } from "./parse-robot.ts";
import { robotFileOf, type RobotFile } from "./write-robot.ts";

/** The robot of a robot file that is kept with a cell. Read once for each value: it is asked for with every edit. */
const read = new WeakMap<object, RobotAnswer>();
/** The last file of each id: a cell that is opened again has the same robot, not another one like it. */
const last = new Map<string, { readonly text: string; readonly answer: RobotAnswer }>();

export function robotOfFile(file: unknown): RobotAnswer {
  if (typeof file !== "object" || file === null) return parseRobot(file);
  const known = read.get(file);
  if (known !== undefined) return known;
  const text = JSON.stringify(file);
  const id = "id" in file && typeof file.id === "string" ? file.id : "";
  const before = last.get(id);
  const answer = before?.text === text ? before.answer : parseRobot(file);
  last.set(id, { text, answer });
  read.set(file, answer);
  return answer;
}

/**
 * A robot that a person brought as the file that is kept with cells. Its id ends in a hash of everything that is in the
 * file: the same file is the same robot everywhere, and two arms that are called alike never stand in for each other.
 * An arm with the kinematics and limits of a library robot gets that robot's way of counting its axes, its home, and
 * with that its languages and drivers.
 */
export function ownRobotFile(robot: Robot): RobotFile {
  const known = robot.vendorSection === undefined ? libraryRobotOf(robot) : undefined;
  const whole: Robot =
    known?.vendorSection === undefined
      ? robot
      : {
          ...robot,
          vendor: known.vendor,
          vendorSection: known.vendorSection,
          home_rad: known.home_rad,
          baseFromVendorWorld: known.baseFromVendorWorld,
          ...(robot.payload_kg === undefined && known.payload_kg !== undefined ? { payload_kg: known.payload_kg } : {}),
          assumptions: [
            // What the library knows need not be assumed.
            ...robot.assumptions.filter(says => known.payload_kg === undefined || !says.startsWith("The payload is")),
            `The kinematics and limits of the file are those of the ${known.name}: its conventions are used.`,
          ],
        };
  const stem = robot.id.replace(HASHED, "").replace(/[^A-Za-z0-9_.-]+/g, "_") || "robot";
  const file = robotFileOf({ ...whole, id: stem });
  return { ...file, id: `${stem}_${hashOf(JSON.stringify(file))}` };
}

const HASHED = /_[0-9a-f]{8}$/;

/** FNV-1a, 32 bits: tells files apart, and protects from nobody. */
function hashOf(text: string): string {
  let hash = 0x811c9dc5;
  for (let i = 0; i < text.length; i++) hash = Math.imul(hash ^ text.charCodeAt(i), 0x01000193);
  return (hash >>> 0).toString(16).padStart(8, "0");
}
