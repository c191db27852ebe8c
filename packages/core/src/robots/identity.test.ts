import { expect, test } from "vitest";
import { robotFromArm } from "./foreign.ts";
import { LIBRARY, robotById } from "./library/index.ts";
import type { Robot } from "../model/robot.ts";
import { compareWithLibrary, falseIdentity, libraryRobotOf } from "./identity.ts";

/** The same arm read from a file: another object under another name, its lengths off by `off_m`. */
const copied = (robot: Robot, id: string, off_m = 0): Robot =>
  robotFromArm(
    {
      ...robot.arm,
      joints: robot.arm.joints.map((joint, j) =>
        j === 2
          ? {
              ...joint,
              parentFromJoint: {
                ...joint.parentFromJoint,
                position: [
                  joint.parentFromJoint.position[0],
                  joint.parentFromJoint.position[1] + off_m,
                  joint.parentFromJoint.position[2] + off_m,
                ],
              },
            }
          : joint,
      ),
    },
    { id },
  );

test("each robot of the library is told by its kinematics alone, whatever it is called, and is no other one", () => {
  for (const robot of LIBRARY) {
    expect(libraryRobotOf(copied(robot, "abb_irb120"))?.id).toBe(robot.id);
    for (const other of LIBRARY)
      if (other !== robot) expect(compareWithLibrary(robot, other).kind, `${robot.id} as ${other.id}`).toBe("other");
  }
});

test("an arm with the id of another one is refused with both flange positions and the distance", () => {
  const wrong = copied(robotById("kuka_kr6_2")!, "abb_irb120");
  expect(falseIdentity(wrong)).toMatch(
    /^The robot is called abb_irb120, but is not the ABB IRB 120.*: at joints .* its flange is at \([-0-9., ]+\) mm, that of the ABB IRB 120.* at \([-0-9., ]+\) mm: [0-9.]+ mm and [0-9.]+° apart \(1 mm and 0\.1° are allowed\)\.$/,
  );
  expect(falseIdentity(copied(robotById("abb_irb120")!, "abb_irb120"))).toBeUndefined();
  expect(falseIdentity(copied(robotById("kuka_kr6_2")!, "mine"))).toBeUndefined();
});

test("lengths may be off by rounding, not by 5 mm; limits may be narrower, not wider", () => {
  const robot = robotById("abb_irb120")!;
  expect(compareWithLibrary(copied(robot, "x", 0.0001), robot)).toMatchObject({ kind: "same" });
  expect(compareWithLibrary(copied(robot, "x", 0.005), robot)).toMatchObject({ kind: "other" });
  const limited = (by: number): Robot =>
    robotFromArm({
      ...robot.arm,
      joints: robot.arm.joints.map(joint => ({
        ...joint,
        limits: { ...joint.limits, upper_rad: joint.limits.upper_rad + by },
      })),
    });
  expect(compareWithLibrary(limited(-0.3), robot).kind).toBe("same");
  const wider = compareWithLibrary(limited(0.3), robot);
  expect(wider.kind === "other" && wider.difference).toMatch(
    /^its joint 1 goes from -165\.0° to 182\.2°, that of the ABB IRB 120.* from -165\.0° to 165\.0°$/,
  );
});
