import { cartesianTarget, jointTarget, type CartesianAxis, type CommandOutcome, type MoveStep } from "@twincell/core";
import { given } from "../io/arguments.ts";
import { commandAt, COMMANDER_HELP, COMMANDER_OPTIONS } from "../io/at.ts";
import { oneStepProgram } from "../io/one-step.ts";
import { UseFault, type Command } from "../io/usage.ts";

const AXES = ["x", "y", "z", "rx", "ry", "rz"] as const;
/** Jogging is slow: straight [m/s], and of a joint's speed. */
const JOG_MPS = 0.1;
const JOG_RATIO = 0.1;
const MOST_STEPS = 1000;
const END: CommandOutcome = {
  kind: "refused",
  why: {
    code: "jog.end",
    sentence: "The arm goes no farther in this direction without a joint reaching its limit or a singularity.",
    hint: "Jog by a smaller step, or a joint instead.",
  },
};

export const jogCommand: Command = {
  name: "jog",
  summary: "move a robot by steps: a joint, or the flange along or about an axis",
  usage: `twincell jog --at HOST[:PORT] (--joint N | --axis x|y|z|rx|ry|rz [--frame base|flange]) --by STEP [--steps 1]

  --joint N         joint from 1; --by is in rad, in m where it slides; it stops at the joint's limit
  --axis A          the flange straight along an axis (--by in m) or about one through its own origin (--by in rad)
  --frame F         whose axes: base (default) or flange
  --by STEP         how far a step goes; negative goes the other way
  --steps N         so many steps, one after the other
Every step is planned and checked in its cell by itself.
${COMMANDER_HELP}`,
  async run(args) {
    const options = given(args, {
      ...COMMANDER_OPTIONS,
      joint: { type: "string" },
      axis: { type: "string" },
      frame: { type: "string" },
      by: { type: "string" },
      steps: { type: "string" },
    });
    if (options.positionals.length > 0) throw new UseFault(`jog takes no argument "${options.positionals[0]}".`);
    const joint = options.number("joint");
    const axis = AXES.findIndex(name => name === options.text("axis"));
    const frame = options.text("frame") ?? "base";
    const by = options.number("by");
    const steps = options.number("steps") ?? 1;
    if ((joint === undefined) === (options.text("axis") === undefined))
      throw new UseFault("jog wants --joint N or --axis A.", `Axes: ${AXES.join(", ")}.`);
    if (options.text("axis") !== undefined && axis < 0)
      throw new UseFault(`There is no axis "${options.text("axis")}".`, `Axes: ${AXES.join(", ")}.`);
    if (frame !== "base" && frame !== "flange") throw new UseFault(`--frame wants base or flange, not "${frame}".`);
    if (by === undefined || by === 0) throw new UseFault("--by is missing.", "Give a step, such as 0.01.");
    if (!Number.isInteger(steps) || steps < 1 || steps > MOST_STEPS)
      throw new UseFault(`--steps wants a whole number from 1 to ${MOST_STEPS}, not ${steps}.`);
    return commandAt(options, async (at, ask) => {
      const { robot, info } = at;
      if (joint !== undefined && !(Number.isInteger(joint) && joint >= 1 && joint <= robot.arm.joints.length))
        throw new UseFault(`${robot.name} has joints 1 to ${robot.arm.joints.length}, not ${joint}.`);
      // Each step counts from where the last one was to end, so that what a robot is off does not add up.
      let q_rad: readonly number[] = at.sample!.q_rad;
      let outcome: CommandOutcome = { kind: "done" };
      for (let i = 0; i < steps && outcome.kind === "done"; i++) {
        const next =
          joint === undefined
            ? cartesianTarget(robot, q_rad, axis as CartesianAxis, by, frame)
            : jointTarget(robot, q_rad, joint, by);
        if (!next) return END;
        q_rad = next;
        const step: MoveStep = {
          id: "jog",
          type: "move",
          path: joint === undefined ? "lin" : "ptp",
          target: { q: next },
          speed: joint === undefined ? { mps: JOG_MPS } : { ratio: JOG_RATIO },
          blend_m: 0,
        };
        outcome = await ask({
          type: "run",
          station: info.id,
          program: oneStepProgram(robot, "Jog", step),
          asText: false,
        });
      }
      return outcome;
    });
  },
};
