import { explainReach, solveAll, type CommandOutcome, type MoveStep, type Pose, type Robot } from "@twincell/core";
import { given, type Given } from "../io/arguments.ts";
import { commandAt, COMMANDER_HELP, COMMANDER_OPTIONS } from "../io/at.ts";
import { poseAt } from "../io/values.ts";
import { codesOf, oneStepProgram } from "../io/one-step.ts";
import { UseFault, type Command } from "../io/usage.ts";

/** A straight move is this fast when nobody says otherwise [m/s]. */
const LINE_MPS = 0.1;
const JOINT_RATIO = 0.25;

export const moveCommand: Command = {
  name: "move",
  summary: "move a robot to joint angles or to a pose, at a server or at its controller",
  usage: `twincell move --at HOST[:PORT] (--joints Q1,Q2,… | --joint N=Q | --pose X,Y,Z,QX,QY,QZ,QW [--line] | --home | --zero)

The robot plans and checks the motion in its cell before it is sent: what touches something, or is out of reach, is refused.

  --joints Q1,…     all joint angles [rad; m where a joint slides]
  --joint N=Q       one joint, from 1
  --pose X,…        the flange in the base: place [m] and quaternion x y z w; --line goes there straight
  --mps V           speed of --line (default ${LINE_MPS} m/s); of the others --ratio R of the joint speeds (default ${JOINT_RATIO})
  --home, --zero    the home posture of the model, or all joints at zero
  --despite CODES   red findings that you have seen and go on in spite of
${COMMANDER_HELP}`,
  async run(args) {
    const options = given(args, {
      ...COMMANDER_OPTIONS,
      joints: { type: "string" },
      joint: { type: "string" },
      pose: { type: "string" },
      line: { type: "boolean" },
      mps: { type: "string" },
      ratio: { type: "string" },
      home: { type: "boolean" },
      zero: { type: "boolean" },
      despite: { type: "string" },
    });
    if (options.positionals.length > 0) throw new UseFault(`move takes no argument "${options.positionals[0]}".`);
    const targets = ["joints", "joint", "pose"].filter(name => options.text(name) !== undefined);
    const flags = ["home", "zero"].filter(name => options.flag(name));
    if (targets.length + flags.length !== 1)
      throw new UseFault("move wants one target.", "One of --joints, --joint, --pose, --home and --zero.");
    const pose = options.text("pose") === undefined ? undefined : poseFrom(options);
    const ratio = options.number("ratio") ?? JOINT_RATIO;
    const mps = options.number("mps") ?? LINE_MPS;
    if (!(ratio > 0 && ratio <= 1)) throw new UseFault(`--ratio wants more than 0, at most 1, not ${ratio}.`);
    if (!(mps > 0)) throw new UseFault(`--mps wants more than 0, not ${mps}.`);
    if (options.flag("line") && !pose) throw new UseFault("--line is for --pose.");
    const joint = options.text("joint") === undefined ? undefined : jointFrom(options.text("joint")!);
    const joints = options.numbers("joints");
    return commandAt(options, async ({ info, robot, sample }, ask) => {
      const station = info.id;
      if (options.flag("zero")) return ask({ type: "zero", station });
      const step: Omit<MoveStep, "target"> = {
        id: "move",
        type: "move",
        path: options.flag("line") ? "lin" : "ptp",
        speed: options.flag("line") ? { mps } : { ratio },
        blend_m: 0,
      };
      const q = pose
        ? postureAt(robot, pose as Pose as Pose<"base", "flange">, sample!.q_rad)
        : jointsFor(robot, joints ?? (joint ? withJoint(sample!.q_rad, joint, robot) : robot.home_rad));
      if ("kind" in q) return q;
      return ask({
        type: "run",
        station,
        program: oneStepProgram(robot, "Move", { ...step, target: { q } }),
        asText: false,
        despite: codesOf(options),
      });
    });
  },
};

/** The joint angles for that pose of the flange that are nearest to where the robot stands, or why there are none. */
function postureAt(
  robot: Robot,
  baseFromFlange: Pose<"base", "flange">,
  near: readonly number[],
): number[] | (CommandOutcome & { readonly kind: "refused" }) {
  const reach = solveAll(robot, baseFromFlange, { near });
  const [first] = reach.kind === "reached" ? reach.solutions : [];
  return first
    ? Array.from(first.q_rad)
    : {
        kind: "refused",
        why: { code: `reach.${reach.kind}`, sentence: explainReach(reach), hint: "Give a pose that the arm reaches." },
      };
}

function poseFrom(options: Given): Pose {
  const numbers = options.numbers("pose")!;
  if (numbers.length !== 7) throw new UseFault(`--pose wants 7 numbers, x,y,z,qx,qy,qz,qw, not ${numbers.length}.`);
  return poseAt({ position: numbers.slice(0, 3), quaternion: numbers.slice(3) }, "--pose");
}

function jointFrom(text: string): { readonly joint: number; readonly angle: number } {
  const [, joint, angle] = /^(\d+)=(-?[\d.]+(?:e-?\d+)?)$/i.exec(text) ?? [];
  if (joint === undefined || !Number.isFinite(Number(angle)))
    throw new UseFault(`--joint wants N=Q, such as 2=0.5, not "${text}".`);
  return { joint: Number(joint), angle: Number(angle) };
}

function withJoint(
  q_rad: readonly number[],
  { joint, angle }: { readonly joint: number; readonly angle: number },
  robot: Robot,
): number[] {
  if (joint < 1 || joint > q_rad.length)
    throw new UseFault(`${robot.name} has joints 1 to ${q_rad.length}, not ${joint}.`);
  return q_rad.map((q, i) => (i === joint - 1 ? angle : q));
}

function jointsFor(robot: Robot, q: readonly number[]): number[] {
  const { length } = robot.arm.joints;
  if (q.length !== length) throw new UseFault(`${robot.name} has ${length} joints but ${q.length} angles were given.`);
  return [...q];
}
