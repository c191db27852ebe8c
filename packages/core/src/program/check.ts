import type { CellGeometry } from "../collision/cell.ts";
import type { Robot } from "../robots/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import type { Plan } from "../trajectory/plan.ts";
import { durationAssumptions } from "../trajectory/planner.ts";
import { checkBranch } from "./checks/branch.ts";
import { checkCollision } from "./checks/collision.ts";
import { layOut } from "./checks/layout.ts";
import { checkLimits } from "./checks/limits.ts";
import { checkReach } from "./checks/reach.ts";
import type { CheckScene, Severity } from "./checks/scene.ts";
import { checkSingular } from "./checks/singular.ts";
import { checkSpeed } from "./checks/speed.ts";
import { checkWorkspace } from "./checks/workspace.ts";
import type { Program } from "./program.ts";
import type { Finding, StepVerdict, Verdict } from "./verdict.ts";

export interface CheckOptions {
  /** The cell to keep clear of; without it collisions are not looked at and the verdict says so. */
  readonly cell?: CellGeometry;
  /** Where the robot stands; that of `cell` by default, else the world's origin. */
  readonly worldFromBase?: Pose<"world", "base">;
  /** Posture the program starts from; the robot's home by default. */
  readonly start_rad?: ArrayLike<number>;
  /** Distance the robot keeps from the cell [m], its shape error on top; 0 asks for no contact only. */
  readonly margin_m?: number;
  /** Called with 0 … 1 now and then. */
  readonly onProgress?: (share: number) => void;
  /** Asked now and then; steps not reached by then are "unknown". */
  readonly cancelled?: () => boolean;
}

export interface Checked { readonly verdict: Verdict; readonly plan: Plan }

/** The part of the work that laying out is when a cell is checked as well. */
const LAYOUT_SHARE = 0.4;

/**
 * Judges a whole program: reach, joint limits, speeds, postures, singular postures and collision, each step with what
 * was found, in numbers and a sentence, and ways out. The plan goes on behind steps that are bad, beyond joint limits
 * where it must, so that everything can be drawn; only a plan whose verdict is ok is one to execute.
 */
export function checkProgram(program: Program, robot: Robot, options: CheckOptions = {}): Checked {
  const { cell, onProgress, cancelled } = options, worldFromBase = options.worldFromBase ?? cell?.worldFromBase;
  const layoutShare = cell === undefined ? 1 : LAYOUT_SHARE;
  const layout = layOut(program, robot, {
    ...(worldFromBase === undefined ? {} : { worldFromBase }),
    ...(options.start_rad === undefined ? {} : { start_rad: options.start_rad }),
    ...(onProgress === undefined ? {} : { onProgress: (share: number) => { onProgress(share * layoutShare); } }),
    ...(cancelled === undefined ? {} : { cancelled }),
  });
  const book = new Book();
  const scene: CheckScene = {
    program, robot, layout,
    context: { tools: program.tools, frames: program.frames, ...(worldFromBase === undefined ? {} : { worldFromBase }) },
    add: (step, severity, finding) => { book.add(step, severity, finding); },
  };
  checkReach(scene);
  checkWorkspace(scene);
  checkLimits(scene);
  checkSpeed(scene);
  checkBranch(scene);
  checkSingular(scene);
  const collision = cell === undefined ? undefined : checkCollision(scene, {
    cell, margin_m: options.margin_m ?? 0,
    ...(onProgress === undefined ? {} : { onProgress: (share: number) => { onProgress(layoutShare + share * (1 - layoutShare)); } }),
    ...(cancelled === undefined ? {} : { cancelled }),
  });
  onProgress?.(1);
  const steps = program.steps.map(step => {
    const evaluated = layout.evaluated.has(step.id) && collision?.unproven.has(step.id) !== true;
    return { id: step.id, verdict: book.verdictOf(step.id, evaluated), findings: book.of(step.id) };
  });
  const ok = steps.every(step => step.verdict === "ok" || step.verdict === "warn");
  const verdict: Verdict = {
    ok, steps, duration_s: layout.plan.duration_s, clearance_m: collision?.clearance_m ?? null,
    assumptions: [
      ...durationAssumptions(program, robot),
      cell === undefined ? "Collisions were not looked at: no cell was given." : "Objects stand where the cell draws them; gripped objects are not carried along.",
    ],
  };
  return { verdict, plan: layout.plan };
}

/** Findings by step, the worst first. */
class Book {
  private readonly found = new Map<string, { readonly severity: Severity; readonly finding: Finding }[]>();

  add(step: string, severity: Severity, finding: Finding): void {
    const list = this.found.get(step) ?? [];
    // A joint that is over its limit is not also near it, and one sentence per fact is enough.
    if (list.some(one => one.finding.code === finding.code && one.finding.joint === finding.joint)) return;
    list.push({ severity, finding });
    this.found.set(step, list);
  }

  of(step: string): readonly Finding[] {
    const list = this.found.get(step) ?? [];
    return [...list.filter(one => one.severity === "bad"), ...list.filter(one => one.severity === "warn")].map(one => one.finding);
  }

  verdictOf(step: string, evaluated: boolean): StepVerdict {
    const list = this.found.get(step) ?? [];
    if (list.some(one => one.severity === "bad")) return "bad";
    if (!evaluated) return "unknown";
    return list.length > 0 ? "warn" : "ok";
  }
}
