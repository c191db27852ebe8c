import {
  sectionForLanguage,
  type Emitted,
  type MoveStep,
  type Program,
  type Robot,
  type TextForm,
} from "@twincell/core";
import { BlockWriter, shownAxes } from "../emitter/index.ts";

const AXES = 6;
/** Significant digits of the published file. */
const DIGITS = 6;
/** Speed and acceleration of every axis in percent (row M-53). */
const PERCENT = 100;

/**
 * The list of axis positions of the KUKA teaching system (rows M-50 … M-53): speeds and accelerations of all axes, then
 * one PTP with inline axis values per step. It is a format of its own: it holds joint motions to taught joint angles,
 * and a program with anything else is refused.
 */
export const axisList: TextForm = {
  id: "axis-list",
  name: "PTP_AXIS list",
  emit: emitPtpAxis,
  said: program => ({
    ...program,
    steps: program.steps.map(step => (step.type === "move" ? { ...step, speed: { ratio: 1 }, blend_m: 0 } : step)),
  }),
  // Half of the sixth digit of an angle of three digits before the point, at the reach of a large arm.
  resolution: { position_m: 5e-5, angle_rad: 2e-5 },
};

function emitPtpAxis(program: Program, robot: Robot): Emitted {
  const convention = sectionForLanguage(robot, "krl");
  if (convention === undefined)
    return {
      kind: "cannot",
      step: "",
      sentence: `How KRL counts the axes of the ${robot.name} is not known.`,
      hint: "Export in the language of this robot's own controller.",
    };
  const isAxisMove = (
    step: Program["steps"][number],
  ): step is MoveStep & { readonly target: { readonly q: readonly number[] } } =>
    step.type === "move" && step.path === "ptp" && "q" in step.target;
  const out = new BlockWriter();
  out.add("DEF PTP_AXIS()");
  for (let axis = 1; axis <= AXES; axis++) out.add(`$VEL_AXIS[${axis}] = ${PERCENT}`);
  out.add("");
  for (let axis = 1; axis <= AXES; axis++) out.add(`$ACC_AXIS[${axis}] = ${PERCENT}`);
  out.add("");
  for (const step of program.steps) {
    if (!isAxisMove(step))
      return {
        kind: "cannot",
        step: step.id,
        sentence: `Step ${step.name ?? step.id} is no joint motion to joint angles, and the list of axis positions holds nothing else.`,
        hint: "Export as KRL.",
      };
    const [a1, a2, a3, a4, a5, a6] = shownAxes(convention, step.target.q).map(value =>
      String(Number(value.toPrecision(DIGITS)) + 0),
    );
    out.add(`PTP {AXIS:A1 ${a1!}, A2 ${a2!},A3 ${a3!}, A4 ${a4!}, A5 ${a5!}, A6 ${a6!}}`, step.id);
  }
  out.add("END");
  const paced = program.steps.some(step => step.type === "move" && !("ratio" in step.speed && step.speed.ratio === 1));
  return {
    kind: "emitted",
    files: [out.file("PTP_AXIS.src")],
    warnings: paced ? [`The list moves every axis at ${PERCENT} %, whatever speed was taught.`] : [],
  };
}
