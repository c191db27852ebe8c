import {
  everyStep,
  type Capability,
  type Dialect,
  type Emitted,
  type MoveStep,
  type Program,
  type Robot,
  type Step,
  type VendorSection,
} from "@twincell/core";
import type { PulseData } from "./pulses.ts";
import { Controller } from "./write/controller.ts";
import { JobWriter } from "./write/job.ts";
import { jobName } from "./write/names.ts";
import {
  INFORM_LINES,
  WalkedPlace,
  arcWithoutVia,
  called,
  counted,
  firstFlaw,
  inParts,
  lacking,
  tellsRobot,
  unresolved,
  wholeEmitterOf,
  type Cannot,
  type NumberedLines,
} from "../emitter/index.ts";
import { configurationsOf } from "./write/postures.ts";
import { FASTEST_MPS, pathSpeed } from "./write/speed.ts";

/** What is written with other instructions, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["timeout", "late", "wait-expression", "arguments", "truth-values"];

/** What INFORM has no instruction for. */
export const CANNOT: Dialect["cannot"] = [
  { what: "duration", because: "INFORM gives a motion a speed and no duration." },
  {
    what: "read-analogue",
    because: "INFORM decides by digital lines; analogue inputs need an option of the controller.",
  },
  {
    what: "wait-expression",
    because: "INFORM computes by one instruction at a time; this release writes none of them.",
  },
  { what: "payload", because: "The load belongs to the tool data of the controller, not to a job." },
];
const HINTS: Readonly<Record<string, string>> = {
  duration: "Give the step a speed instead.",
  "read-analogue": "Let the controller compare the value and decide by a digital line.",
  payload: "Set the load in the tool data and take the step out.",
};
const LONGEST_WAIT_S = 655.35;
/** Positions of one job. */
const MOST_POSITIONS = 9999;
/** Steps of a part: an arc has three positions. */
const MOST_STEPS = 3000;

const LINES: NumberedLines = { language: "INFORM", ranges: INFORM_LINES, counting: "IN# and OT# count from 1" };

/**
 * Jobs (.JBI), the main job first, with the tools and user frames whose numbers they mean; or the step that stands in
 * the way: never a part of a program.
 *
 * @param pulses  write positions in pulses, by these numbers of the controller; left out, in X, Y, Z.
 */
export const emitInform = (pulses: PulseData | undefined): Dialect["emit"] =>
  wholeEmitterOf({
    id: "inform",
    cannot: CANNOT,
    idioms: IDIOMS,
    strange: robot => `How INFORM counts the axes of the ${robot.name} is not known.`,
    write: ({ place, section }) => jobs(place, section, pulses),
  });

function jobs(place: WalkedPlace, convention: VendorSection, pulses: PulseData | undefined): Emitted {
  const { program, robot, worldFromBase } = place;
  const steps = [...everyStep(program)];
  const refusal =
    strangePulses(robot, pulses) ??
    firstFlaw(steps, refused) ??
    firstFlaw(steps, step => unresolved(program, step, LINES) ?? palletInPulses(step, pulses));
  if (refusal !== undefined) return refusal;
  const whole = written(place, convention, pulses);
  if (whole.kind !== "too-long") return whole;
  const parts = inParts(program, MOST_STEPS);
  const again = written(new WalkedPlace(parts, robot, worldFromBase), convention, pulses);
  if (again.kind === "too-long")
    return { kind: "cannot", step: "", sentence: again.sentence, hint: "Put parts of it into routines of their own." };
  return again.kind === "cannot"
    ? again
    : {
        ...again,
        warnings: [
          `The program has more positions than one job holds: it was written as ${1 + Object.keys(parts.routines).length} jobs that are called one after the other.`,
          ...again.warnings,
        ],
      };
}

function strangePulses(robot: Robot, pulses: PulseData | undefined): Cannot | undefined {
  if (
    pulses === undefined ||
    (pulses.pulsesPerDegree.length === robot.arm.joints.length &&
      pulses.pulsesPerDegree.every(value => Number.isFinite(value) && value !== 0))
  )
    return undefined;
  return {
    kind: "cannot",
    step: "",
    sentence: `${pulses.pulsesPerDegree.length} pulse ratios are given; the ${robot.name} has ${robot.arm.joints.length} axes, and no ratio is 0.`,
    hint: "Take the pulses per degree of every axis from the controller's parameter file.",
  };
}

function written(
  place: WalkedPlace,
  convention: VendorSection,
  pulses: PulseData | undefined,
): Emitted | { readonly kind: "too-long"; readonly sentence: string } {
  const { program, robot } = place;
  const steps = [...everyStep(program)];
  const configurations = configurationsOf(place, convention, pulses !== undefined);
  if (configurations.kind === "cannot") return configurations;

  const controller = new Controller(place);
  const taken = new Set<string>();
  const main = jobName(program.name, taken);
  const names = new Map(Object.keys(program.routines).map(name => [name, jobName(name, taken)]));
  const setting = { place, controller, convention, pulses, postures: configurations.of, jobs: names };
  const files = [new JobWriter(setting, true).write(main, program.name, program.steps)];
  for (const [name, job] of names) files.push(new JobWriter(setting, false).write(job, name, program.routines[name]!));
  for (const what of controller.spent)
    return {
      kind: "cannot",
      step: "",
      sentence: `The program needs more ${what} than the controller has.`,
      hint: "Export it in parts.",
    };
  for (const { name, text } of files) {
    const count = Number(/^\/\/\/NPOS ([0-9]+)/m.exec(text)?.[1] ?? 0);
    if (count > MOST_POSITIONS)
      return {
        kind: "too-long",
        sentence: `Job ${name} would have ${count} positions; a job holds ${MOST_POSITIONS}.`,
      };
  }
  return {
    kind: "emitted",
    files: [...files, ...controller.files()],
    warnings: warnings(program, robot, steps, pulses, controller),
  };
}

/** Why INFORM has no instruction for a step. */
function refused(step: Step): Cannot | undefined {
  const lack = lacking(step, { language: "INFORM", cannot: CANNOT, hints: HINTS });
  if (lack !== undefined) return lack;
  if (step.type === "wait" && step.s > LONGEST_WAIT_S)
    return {
      kind: "cannot",
      step: step.id,
      sentence: `${called(step)} waits ${step.s} s; TIMER ends at ${LONGEST_WAIT_S} s.`,
      hint: "Wait several times.",
    };
  if (step.type === "set" && step.pulse_s !== undefined && step.to === false)
    return {
      kind: "cannot",
      step: step.id,
      sentence: `${called(step)} is a pulse that takes an output off; PULSE of INFORM puts it on.`,
      hint: "Write two steps with a wait between them.",
    };
  return arcWithoutVia(step);
}

const palletInPulses = (step: Step, pulses: PulseData | undefined): Cannot | undefined =>
  step.type === "pallet" && pulses !== undefined
    ? {
        kind: "cannot",
        step: step.id,
        sentence: `${called(step)} is a pallet, whose places are shifts in X, Y, Z: positions in pulses are not shifted.`,
        hint: "Export with positions in X, Y, Z.",
      }
    : undefined;

function warnings(
  program: Program,
  robot: Robot,
  steps: readonly Step[],
  pulses: PulseData | undefined,
  controller: Controller,
): string[] {
  const said = tellsRobot(program, robot);
  const moves = steps.filter((step): step is MoveStep => step.type === "move");
  const max = robot.maxTcpSpeed_mps;
  if (pulses?.source === "example")
    said.push(
      "The pulses per degree are an example for the virtual controller: on a real robot these positions are others.",
    );
  else if (pulses !== undefined) said.push(`Positions are in pulses by ${pulses.source}: they fit that robot alone.`);
  const paced = moves.filter(({ path, speed }) => path === "ptp" && "mps" in speed).length;
  if (paced > 0)
    said.push(
      `INFORM gives joint motions a share of the axis speeds: on ${counted(paced, "joint motion", "joint motions")} the speed in mm/s became its share of ${max} m/s.`,
    );
  const cut = moves.filter(({ path, speed }) => path !== "ptp" && pathSpeed(speed, max) > FASTEST_MPS).length;
  if (cut > 0)
    said.push(`${counted(cut, "path is", "paths are")} slowed down to ${FASTEST_MPS * 1000} mm/s, where V= ends.`);
  if (moves.some(({ path, blend_m, blend_ratio = 0 }) => path !== "lin" && (blend_m > 0 || blend_ratio > 0)))
    said.push(
      "Corners off straight paths are written as the position level that is nearest to their size; the sizes are parameters of the controller.",
    );
  if (moves.some(({ path, blend_m, blend_ratio = 0 }) => path === "lin" && (blend_m > 0 || blend_ratio > 0)))
    said.push("CR= needs a DX100 or later.");
  if (steps.some(({ type }) => type === "gripper"))
    said.push("The gripper is HAND 1 of the handling application, ON closes.");
  const names = controller
    .files()
    .map(({ name }) => name)
    .join(" and ");
  if (names !== "")
    said.push(
      `${names} say which tools and user frames the numbers of the job mean. Loading them replaces what the controller has under these numbers.`,
    );
  return said;
}
