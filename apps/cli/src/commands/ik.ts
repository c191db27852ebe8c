import {
  allBranches,
  compose,
  explainReach,
  inverse,
  solveAll,
  solverScratch,
  travel,
  type Pose,
  type Reach,
} from "@twincell/core";
import { given } from "../io/arguments.ts";
import { methodOf, tried } from "../io/ik-methods.ts";
import { jsonLines, lineWriter } from "../io/json-lines.ts";
import { robotOf, ROBOT_HELP, ROBOT_OPTIONS } from "../io/robot.ts";
import { UseFault, type Command } from "../io/usage.ts";
import { poseOf } from "../io/values.ts";

export const ikCommand: Command = {
  name: "ik",
  summary: "pose of the tip in, all joint angles that reach it out, or why none do",
  usage: `twincell ik --robot R [--base LINK] [--tip LINK] [--within-limits] [--near q1,q2,…] [--elbow RAD]  < poses.jsonl

Reads POSE lines {"position":[x,y,z],"quaternion":[x,y,z,w]} and writes {"solutions":[[…],…],"reach":{…}} lines.
${ROBOT_HELP}
Every distinct branch, angles in (−π, π]. An unreachable pose is an answer: "reach" says why.

  --within-limits   adds whole turns inside the limits and drops the rest
  --near q1,q2,…    sorts by least total travel from these angles (radians)
  --elbow RAD       elbow angle of a seven-joint arm: 0 is upwards in the vertical plane through shoulder and wrist, counted about the line
                    from shoulder to wrist; without it that of --near, or 0, or the nearest to these that the limits allow
  --method M        closed (as above), dls (damped least squares), fabrik, gradient, or compare (all four): one answer each, found from
                    --near or from home, as {"tried":[{"method","q","position_error_m","angle_error_rad","iterations","jump_rad","took_ms","sentence"}]};
                    gradient looks at the position alone; "q" is where the method ended, met or not`,
  async run(args) {
    const options = given(args, {
      ...ROBOT_OPTIONS,
      "within-limits": { type: "boolean" },
      near: { type: "string" },
      elbow: { type: "string" },
      method: { type: "string" },
      json: { type: "boolean" },
    });
    const { robot, baseFromRoot, flangeFromTip } = await robotOf(options);
    const near = options.numbers("near");
    const joints = robot.arm.joints.length;
    if (near && near.length !== joints) throw new UseFault(`--near wants ${joints} angles, not ${near.length}.`);

    const elbow_rad = options.number("elbow");
    if (elbow_rad !== undefined && robot.family.kind !== "spherical-seven")
      throw new UseFault(
        `${robot.name} has no elbow angle.`,
        "--elbow is for arms with seven joints, three of them in the shoulder and three in the wrist.",
      );

    const methods = methodOf(options.text("method"));
    const rootFromBase = inverse(baseFromRoot);
    const tipFromFlange = inverse(flangeFromTip);
    const scratch = solverScratch();
    const writer = lineWriter();
    for await (const { line, value } of jsonLines()) {
      const baseFromFlange = compose(compose(rootFromBase, poseOf(value, line)), tipFromFlange) as Pose<
        "base",
        "flange"
      >;
      if (methods) {
        writer.write({ tried: tried(methods, robot, baseFromFlange, near ?? robot.home_rad) });
        continue;
      }
      const reach = solveAll(
        robot,
        baseFromFlange,
        { ...(near === undefined ? {} : { near }), ...(elbow_rad === undefined ? {} : { elbow_rad }) },
        scratch,
      );
      const solutions = options.flag("within-limits")
        ? reach.kind === "reached"
          ? reach.solutions.map(solution => solution.q_rad)
          : []
        : allBranches(robot, baseFromFlange, near, scratch, elbow_rad);
      if (near) solutions.sort((a, b) => travel(a, near) - travel(b, near));
      writer.write({ solutions: solutions.map(q => Array.from(q)), reach: said(reach) });
    }
    await writer.end();
    return 0;
  },
};

/** The reason with its numbers and its sentence; the solutions stand beside it. */
function said(reach: Reach): Record<string, unknown> {
  const sentence = explainReach(reach);
  if (reach.kind === "reached")
    return {
      kind: reach.kind,
      ...(reach.method === undefined ? {} : { method: reach.method }),
      singular: reach.singular,
      considered: reach.considered,
      sentence,
    };
  return { ...reach, sentence };
}
