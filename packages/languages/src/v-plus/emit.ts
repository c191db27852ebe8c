import {
  capabilitiesUsed,
  everyStep,
  type Capability,
  type MoveStep,
  type Program,
  type Robot,
  type Step,
} from "@twincell/core";
import {
  VPLUS_LINES,
  called,
  counted,
  linesLookedAt,
  outOfRange,
  tellsRobot,
  wholeEmitterOf,
  type Cannot,
} from "../emitter/index.ts";
import { MAX_POINTS, pointList } from "./write/point-list.ts";
import { configurationsOf } from "./write/postures.ts";
import { ProgramWriter } from "./write/program.ts";

/** What is written with other statements, as its programmers do. */
export const IDIOMS: readonly Capability[] = ["timeout", "late", "wait-expression", "arguments", "truth-values"];

/** What V+ has no standard instruction for. */
export const CANNOT: readonly { readonly what: Capability; readonly because: string }[] = [
  { what: "circ", because: "Arcs are an option of the controller that standard V+ does not have." },
  { what: "spline", because: "V+ moves on joint-interpolated and straight paths only." },
  { what: "search", because: "V+ searches by a reaction program (REACTI) that runs beside the motion." },
  { what: "payload", because: "V+ learns the load from the controller's configuration, not from a program." },
  { what: "pulse", because: "V+ sets a signal and leaves it." },
  { what: "set-analogue", because: "Analogue lines are an option of the controller that standard V+ does not have." },
  { what: "read-analogue", because: "Analogue lines are an option of the controller that standard V+ does not have." },
];
/** Whole numbers are exact in the controller's reals up to here. */
const MAX_TIMES = 2 ** 24;

/**
 * The point list of the paper and the runnable program, or the step that stands in the way: never a part of a program.
 */
export const emitVPlus = wholeEmitterOf({
  id: "v-plus",
  cannot: CANNOT,
  idioms: IDIOMS,
  strange: robot => `How V+ counts the joints of the ${robot.name} is not known.`,
  write: ({ place, section }) => {
    const { program, robot } = place;
    const steps = [...everyStep(program)];
    const moves = steps.filter((step): step is MoveStep => step.type === "move");
    const refused = unspeakable(program, steps);
    if (refused !== undefined) return refused;
    if (moves.length > MAX_POINTS) {
      return {
        kind: "cannot",
        step: moves[MAX_POINTS]!.id,
        sentence: `The program has ${moves.length} points; the array of the point list ends after ${MAX_POINTS}.`,
        hint: "Export it in parts.",
      };
    }
    const configurations = configurationsOf(place);
    if (configurations.kind === "cannot") return configurations;
    return {
      kind: "emitted",
      files: [
        new ProgramWriter(place, section, configurations.q_rad).write(),
        pointList(moves, configurations.q_rad, section),
      ],
      warnings: warnings(program, robot, moves),
    };
  },
});

/** The first step that V+ has no words for. */
function unspeakable(program: Program, steps: readonly Step[]): Cannot | undefined {
  const refuse = (step: Step, sentence: string, hint: string): Cannot => ({
    kind: "cannot",
    step: step.id,
    sentence: `${called(step)} ${sentence}`,
    hint,
  });
  const used = capabilitiesUsed(program);
  for (const { what, because } of CANNOT) {
    const step = used.get(what);
    if (step === undefined) continue;
    if (step.type === "move" && step.path === what)
      return refuse(step, `is a ${what} move. ${because}`, "Replace it by straight moves through points on the curve.");
    return refuse(step, `asks for: ${what}. ${because}`, "Say it in another way, or export in another language.");
  }
  for (const step of steps) {
    for (const signal of step.type === "set" ? [step.signal] : linesLookedAt(step)) {
      if ((Object.hasOwn(program.signals, signal) ? program.signals[signal]!.address : undefined) === undefined)
        return refuse(
          step,
          `names the signal “${signal}”, whose number is not known. V+ counts its lines.`,
          "Give the signal its address: outputs count from 1, inputs from 1001.",
        );
      const wrong = outOfRange("V+", VPLUS_LINES, step, signal, program.signals[signal]!);
      if (wrong !== undefined) return { kind: "cannot", step: step.id, ...wrong };
    }
    if (step.type === "repeat" && step.times !== "forever" && step.times > MAX_TIMES)
      return refuse(
        step,
        `repeats ${step.times} times; a loop of V+ counts to ${MAX_TIMES}.`,
        "Put one loop into another.",
      );
    if (step.type !== "pallet") continue;
    const pallet = program.pallets[step.pallet];
    if (pallet?.interleave === "odd-rows-shifted" && pallet.order?.startsWith("columns") === true)
      return refuse(
        step,
        "visits shifted rows column by column, which loops of V+ do not say.",
        "Visit the pallet row by row.",
      );
  }
  return undefined;
}

function warnings(program: Program, robot: Robot, moves: readonly MoveStep[]): string[] {
  const said = tellsRobot(program, robot);
  const blended = moves.filter(step => step.blend_m > 0 || (step.blend_ratio ?? 0) > 0);
  if (blended.length > 0)
    said.push(
      `V+ has no blend radius: ${counted(blended.length, "step passes", "steps pass")} its point on a continuous path whose corner depends on the speed.`,
    );
  const paced = moves.filter(step => step.path === "ptp" && "mps" in step.speed);
  if (paced.length > 0)
    said.push(
      `V+ holds a speed in mm/s on straight paths: on ${counted(paced.length, "joint motion", "joint motions")} it is a guide only.`,
    );
  if (moves.some(({ target }) => "pose" in target))
    said.push(
      "RIGHTY is taken for a wrist in front of the shoulder axis and LEFTY for one behind it; try the first motion slowly.",
    );
  return said;
}
