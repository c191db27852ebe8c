import type { Payload } from "../dynamics/model.ts";
import type { Joint } from "../model/arm.ts";
import { isSlide } from "../model/slide.ts";
import { loadsAlong, torqueModel, type TorqueModel } from "../trajectory/torque/loads.ts";
import { keptShare, torquePeaks, worstPeak, type TorquePeak } from "../trajectory/torque/within.ts";
import type { Segment } from "../trajectory/plan.ts";
import type { MoveStep } from "../program/program.ts";
import type { JointTorque, Repair, TorqueVerdict } from "./verdict.ts";
import { slower } from "./slower.ts";
import type { CheckScene } from "./scene.ts";

/**
 * Torques of the plan against what the joints can give (rows, L-15, L-70): a step that asks too much is
 * named with the joint and its torque, the speed at which it would hold, and the load with which it would.
 *
 * @param carried  the load before the first payload step.
 */
export function checkTorque(scene: CheckScene, carried?: Payload): TorqueVerdict {
  const {
    robot,
    layout: { plan },
    context,
  } = scene;
  const known = torqueModel(robot, context.worldFromBase);
  if (known.kind === "unknown") return known;
  const loads = loadsAlong(plan, scene.program, carried);
  const most = new Map<number, JointTorque>();
  plan.segments.forEach((segment, s) => {
    const peaks = torquePeaks([segment], [known.carrying(loads[s])], known.limits_Nm);
    for (const { joint, torque_Nm, limit_Nm, t_s } of peaks) {
      const before = most.get(joint);
      if (before === undefined || Math.abs(torque_Nm) > Math.abs(before.torque_Nm))
        most.set(joint, {
          joint,
          torque_Nm,
          limit_Nm: Number.isFinite(limit_Nm) ? limit_Nm : null,
          at_s: segment.start_s + t_s,
          step: written(scene, segment.step),
        });
    }
    const worst = worstPeak(peaks);
    if (worst !== undefined) report(scene, known, segment, loads[s], worst);
  });
  const joints = [...most.values()].sort((a, b) => a.joint - b.joint);
  return { kind: "known", joints, sentence: summary(joints, robot.arm.joints) };
}

/** Which joint uses most of what it can give. */
function summary(all: readonly JointTorque[], joints: readonly Joint[]): string {
  let most: JointTorque | undefined;
  let share = 0;
  for (const each of all) {
    const used = each.limit_Nm === null ? 0 : Math.abs(each.torque_Nm) / each.limit_Nm;
    if (used > share) {
      most = each;
      share = used;
    }
  }
  if (most === undefined || most.limit_Nm === null) return "No joint is asked for torque.";
  return `Joint ${most.joint} is asked most: ${Math.abs(most.torque_Nm).toFixed(1)} of ${most.limit_Nm.toFixed(1)} ${isSlide(joints[most.joint - 1]!) ? "N" : "N m"} at ${most.at_s.toFixed(2)} s.`;
}

const written = ({ layout }: CheckScene, step: string): string => layout.turns.get(step)?.written.id ?? step;

function report(
  scene: CheckScene,
  known: Extract<TorqueModel, { kind: "known" }>,
  segment: Segment,
  load: Payload | undefined,
  peak: TorquePeak,
): void {
  const { joint, torque_Nm, weight_Nm, limit_Nm } = peak;
  const slides = isSlide(scene.robot.arm.joints[joint - 1]!);
  const unit = slides ? "N" : "Nm";
  const at_s = segment.start_s + peak.t_s;
  const said = (value: number): string => `${Math.abs(value).toFixed(1)} ${slides ? "N" : "N m"}`;
  const carrying = load !== undefined && load.mass_kg > 0 ? ` with ${load.mass_kg} kg` : "";
  const lighter = lighterLoad(known, segment, load);
  if (peak.share === 0) {
    scene.add(segment.step, "bad", {
      code: "torque.weight",
      joint,
      value: Math.abs(weight_Nm),
      limit: limit_Nm,
      unit,
      at_s,
      sentence: `The weight of the arm${carrying} asks ${said(weight_Nm)} of joint ${joint}; its limit is ${said(limit_Nm)}.`,
      repairs: lighter,
    });
    return;
  }
  const move = scene.layout.moves.get(segment.step)?.step;
  const repairs = [...(move === undefined ? [] : gentler(scene, move, keptShare(peak))), ...lighter];
  scene.add(segment.step, "bad", {
    code: "torque.joint",
    joint,
    value: Math.abs(torque_Nm),
    limit: limit_Nm,
    unit,
    at_s,
    sentence: `Joint ${joint} would need ${said(torque_Nm)}${carrying}; its limit is ${said(limit_Nm)}.`,
    repairs,
  });
}

/** The step at a share of its speed, and with so much less acceleration that it is the same motion, only slower. */
function gentler(scene: CheckScene, step: MoveStep, share: number): Repair[] {
  const ratio = Math.floor(100 * (step.acceleration?.ratio ?? 1) * share ** 2) / 100;
  if (!(ratio > 0)) return [];
  return slower(scene, step, 1 / share, 1 / share).map(({ kind = "slower", sentence, replace }) =>
    replace?.type !== "move" || "time_s" in replace.speed
      ? { kind, sentence, ...(replace === undefined ? {} : { replace }) }
      : {
          kind,
          sentence: `${sentence.slice(0, -1)} and the acceleration to ${Math.round(ratio * 100)} %.`,
          replace: { ...replace, acceleration: { ratio } },
        },
  );
}

/** The greatest load with which the segment holds at its speed: torques grow evenly with a load whose centre stays. */
function lighterLoad(
  known: Extract<TorqueModel, { kind: "known" }>,
  segment: Segment,
  load: Payload | undefined,
): Repair[] {
  if (load === undefined || !(load.mass_kg > 0)) return [];
  const scaled = (share: number): Payload => {
    const { mass_kg, center_m, inertia_kgm2 } = load;
    const [xx, yy, zz, xy, xz, yz] = inertia_kgm2 ?? [0, 0, 0, 0, 0, 0];
    return {
      mass_kg: mass_kg * share,
      center_m,
      inertia_kgm2: [xx * share, yy * share, zz * share, xy * share, xz * share, yz * share],
    };
  };
  const holds = (share: number): boolean =>
    worstPeak(torquePeaks([segment], [known.carrying(scaled(share))], known.limits_Nm)) === undefined;
  if (!holds(0)) return [];
  let low = 0;
  let high = 1;
  for (let halved = 0; halved < 8; halved++) {
    const middle = (low + high) / 2;
    if (holds(middle)) low = middle;
    else high = middle;
  }
  const kg = Math.floor(low * load.mass_kg * 10) / 10;
  return kg > 0 ? [{ sentence: `Carry at most ${kg} kg; at this speed it is held.` }] : [];
}
