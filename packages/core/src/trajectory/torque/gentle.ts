import type { Payload } from "../../dynamics/model.ts";
import type { Step } from "../../program/program.ts";
import { isSlide } from "../../model/slide.ts";
import type { Robot } from "../../model/robot.ts";
import type { Pose } from "../../spatial/pose.ts";
import type { MotionSegment } from "../plan.ts";
import type { Stuck } from "../stop.ts";
import { torqueModel, type TorqueModel } from "./loads.ts";
import { keptShare, slowedBy, torquePeaks, worstPeak, type TorquePeak } from "./within.ts";

/** A run that was slowed so that a joint keeps within its torque. `peak` is what it would have been asked for. */
export interface Gentled {
  readonly step: string;
  readonly at_s: number;
  readonly share: number;
  readonly peak: TorquePeak;
}

export type Held =
  | { readonly kind: "held"; readonly parts: readonly MotionSegment[] }
  | { readonly kind: "too-heavy"; readonly stuck: Stuck };

/**
 * Slows runs of motions for their torques, load by load. A run is slowed as a whole: its way and its blends stay as
 * they are. Where torques are unknown, or nobody asked, runs go through as they come.
 */
export class Gentler {
  readonly gentled: Gentled[] = [];
  private readonly robot: Robot;
  private readonly known: TorqueModel | undefined;
  private load: Payload | undefined;

  constructor(
    robot: Robot,
    {
      withinTorque,
      worldFromBase,
    }: {
      readonly withinTorque?: { readonly payload?: Payload };
      readonly worldFromBase?: Pose<"world", "base"> | undefined;
    },
  ) {
    this.robot = robot;
    this.known = withinTorque === undefined ? undefined : torqueModel(robot, worldFromBase);
    this.load = withinTorque?.payload;
  }

  /** A payload step changes what is carried from here on; every other step does not. */
  carry(step: Step): void {
    if (step.type === "payload") this.load = step;
  }

  /** @param at_s  when the run begins. */
  hold(parts: readonly MotionSegment[], at_s: number): Held {
    if (this.known?.kind !== "known") return { kind: "held", parts };
    const model = this.known.carrying(this.load);
    const peak = worstPeak(
      torquePeaks(
        parts,
        parts.map(() => model),
        this.known.limits_Nm,
      ),
    );
    if (peak === undefined) return { kind: "held", parts };
    const step = parts[peak.segment]!.step;
    const share = keptShare(peak);
    if (!(share > 0)) return { kind: "too-heavy", stuck: this.tooHeavy(step, peak) };
    this.gentled.push({ step, at_s, share, peak });
    return { kind: "held", parts: slowedBy(parts, share) };
  }

  private tooHeavy(step: string, { joint, weight_Nm, limit_Nm }: TorquePeak): Stuck {
    const unit = isSlide(this.robot.arm.joints[joint - 1]!) ? "N" : "N m";
    const carrying = this.load === undefined ? "" : ` with ${this.load.mass_kg} kg`;
    return {
      step,
      code: "torque.weight",
      hint: "Carry less, or keep the load nearer to the robot.",
      sentence: `In step “${step}” the weight of the arm${carrying} asks ${Math.abs(weight_Nm).toFixed(1)} ${unit} of joint ${joint}; its limit is ${limit_Nm.toFixed(1)} ${unit}.`,
    };
  }
}
