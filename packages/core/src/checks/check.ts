import type { CellGeometry } from "../collision/cell.ts";
import type { Payload } from "../dynamics/model.ts";
import type { Robot } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import type { Plan } from "../trajectory/plan.ts";
import { GRIPPER_S } from "../trajectory/planner.ts";
import { motionAssumptions } from "../model/jerk.ts";
import { checkBranch, checkImpasses } from "./branch.ts";
import { checkCollision, keptSentence, type Collisions } from "./collision.ts";
import { layOutProgram, type Layout } from "../trajectory/layout.ts";
import { checkLimits } from "./limits.ts";
import { checkReach } from "./reach.ts";
import type { CheckScene } from "./scene.ts";
import { checkSingular } from "./singular.ts";
import { checkSpeed } from "./speed.ts";
import { checkEdges } from "./edges.ts";
import { FindingCollector } from "./finding-collector.ts";
import { checkFlow } from "./flow.ts";
import { checkCarriedLoad } from "./carried-load.ts";
import { checkPayload } from "./payload.ts";
import { checkSignals } from "./signals.ts";
import { checkStand } from "./stand.ts";
import { checkTorque } from "./torque.ts";
import { checkWorkspace } from "./workspace.ts";
import type { ProgramCertificate, SegmentCertificate } from "./certificate.ts";
import type { CornerArea } from "./corner-area.ts";
import type { CornerCertificate } from "./corner-certificate.ts";
import { GRIP_REACH_M, partsAreFollowed, type CarriedPart } from "./grasped-parts.ts";
import type { Program, Step } from "../program/program.ts";
import type { Finding, Verdict } from "./verdict.ts";
import { predicateVariables } from "../program/predicate.ts";
import { everyStep } from "../program/walk.ts";

export interface CheckOptions {
  /** The cell to keep clear of; without it collisions are not looked at and the verdict says so. */
  readonly cell?: CellGeometry;
  /** Where the robot stands; that of `cell` by default, else the world's origin. */
  readonly worldFromBase?: Pose<"world", "base">;
  /** Posture the program starts from; the robot's home by default. */
  readonly start_rad?: ArrayLike<number>;
  /** Distance the robot keeps from the cell [m], its shape error on top; 0 asks for no contact only. */
  readonly margin_m?: number;
  /** Whether to keep what proves every motion clear of contact, for `verifyProgram`. */
  readonly certify?: boolean;
  /** Whether to keep the areas of the corners that are passed without a stop. */
  readonly cornerAreas?: boolean;
  /** What the flange carries before the first payload step; nothing by default. */
  readonly payload?: Payload;
  /** Called with 0 … 1 now and then. */
  readonly onProgress?: (share: number) => void;
  /** Asked now and then; steps not reached by then are "unknown". */
  readonly cancelled?: () => boolean;
}

export interface Checked {
  readonly verdict: Verdict;
  /** The findings of the verdict that make its steps bad, in order of time; the others warn. */
  readonly bad: readonly Finding[];
  readonly plan: Plan;
  /** The parts of the cell that the program carries, in the order they are taken. */
  readonly carried: readonly CarriedPart[];
  /** With `certify` and a cell: motions that are not clear have none. Steps are named as they are in the plan. */
  readonly certificate?: ProgramCertificate;
  /** With `cornerAreas` and a cell, in order of time. */
  readonly corners?: readonly CornerArea[];
}

/** What is found of collisions without a cell. */
const NOT_LOOKED_AT: Collisions = { clearance_m: null, unproven: new Set(), taken: 0, missed: 0, carried: [] };

/** The part of the work that laying out is when a cell is checked as well. */
const LAYOUT_SHARE = 0.4;

/**
 * Judges a whole program: reach, joint limits, speeds, torques, postures, singular postures and collision, each step
 * with what was found, in numbers and a sentence, and ways out. The plan goes on behind steps that are bad, beyond
 * joint limits where it must, so that everything can be drawn; only a plan whose verdict is ok is one to execute.
 */
export function checkProgram(program: Program, robot: Robot, options: CheckOptions = {}): Checked {
  const { cell, onProgress, cancelled, margin_m = 0 } = options;
  const worldFromBase = options.worldFromBase ?? cell?.worldFromBase;
  const layoutShare = cell === undefined ? 1 : LAYOUT_SHARE;
  const layout = layOutProgram(program, robot, {
    worldFromBase,
    start_rad: options.start_rad,
    onProgress: progressBetween(onProgress, 0, layoutShare),
    cancelled,
  });
  const book = new FindingCollector(program);
  const scene: CheckScene = {
    program,
    robot,
    layout,
    context: { tools: program.tools, frames: program.frames, worldFromBase },
    add: (id, severity, finding) => {
      book.add(id, severity, finding, layout.turns.get(id));
    },
  };
  checkMotions(scene);
  const unweighed = checkPayload(scene);
  checkFlow(scene);
  const torque = checkTorque(scene, options.payload);
  const unjudged = checkPlacing(scene, cell, options.payload);
  const certificates: SegmentCertificate[] | undefined =
    options.certify === true && cell !== undefined ? [] : undefined;
  const cornerProofs: CornerCertificate[] = [];
  const areas: CornerArea[] | undefined = options.cornerAreas === true && cell !== undefined ? [] : undefined;
  const proofs = { certificates, corners: certificates && cornerProofs, areas };
  const told = { onProgress: progressBetween(onProgress, layoutShare, 1), cancelled };
  const collision = cell === undefined ? NOT_LOOKED_AT : checkCollision(scene, { cell, margin_m, ...proofs, ...told });
  if (cell !== undefined) checkCarriedLoad(scene, cell, collision.carried);
  onProgress?.(1);
  const unproven = new Set(Array.from(collision.unproven, id => writtenId(layout, id)));
  const written = [...everyStep(program)];
  const evaluated = (id: string): boolean =>
    (layout.complete || layout.evaluated.has(id)) &&
    !unproven.has(id) &&
    !layout.unjudged.has(id) &&
    !unweighed.has(id);
  const steps = written.map(({ id }) => ({ id, verdict: book.verdictOf(id, evaluated(id)), findings: book.of(id) }));
  const ok = steps.every(step => step.verdict === "ok" || step.verdict === "warn");
  const verdict: Verdict = {
    ok,
    steps,
    duration_s: layout.plan.duration_s,
    clearance_m: collision.clearance_m,
    torque,
    assumptions: [
      ...robot.assumptions,
      ...motionAssumptions(robot),
      ...assumed(written, layout),
      ...unjudged,
      ...(torque.kind === "known" ? ["Torques are those of masses and accelerations; friction is not counted."] : []),
      ...cellAssumptions(cell, margin_m),
      ...(cell === undefined ? [] : carried(program, written, collision)),
    ],
  };
  const plan = asWritten(layout);
  const bad = book.bad();
  const parts = collision.carried;
  const checked: Checked =
    areas === undefined
      ? { verdict, bad, plan, carried: parts }
      : { verdict, bad, plan, carried: parts, corners: areas };
  if (certificates === undefined) return checked;
  const byWrittenId = <T extends { readonly step: string }>(each: T): T => ({
    ...each,
    step: writtenId(layout, each.step),
  });
  return {
    ...checked,
    certificate: {
      robot: robot.id,
      program: program.name,
      margin_m,
      segments: certificates.map(byWrittenId),
      corners: cornerProofs.map(byWrittenId),
    },
  };
}

/** How the objects of a cell stand; what of it could not be judged is returned as assumptions. */
function checkPlacing(
  scene: CheckScene,
  cell: CellGeometry | undefined,
  payload: Payload | undefined,
): readonly string[] {
  if (cell === undefined) return [];
  checkEdges(scene, cell);
  return checkStand(scene, cell, payload?.mass_kg);
}

/** Everything that is judged from the motions alone. */
function checkMotions(scene: CheckScene): void {
  checkReach(scene);
  checkWorkspace(scene);
  checkLimits(scene);
  checkSpeed(scene);
  checkBranch(scene);
  checkImpasses(scene);
  checkSingular(scene);
  checkSignals(scene);
}

/** The progress 0 … 1 of a part of the work, told as `from` … `to` of the whole. */
function progressBetween(onProgress: CheckOptions["onProgress"], from: number, to: number): CheckOptions["onProgress"] {
  if (onProgress === undefined) return undefined;
  return share => {
    onProgress(from + share * (to - from));
  };
}

/** What is taken for true of what stands around the robot. */
function cellAssumptions(cell: CellGeometry | undefined, margin_m: number): string[] {
  if (cell === undefined) return ["Collisions were not looked at: no cell was given."];
  const placed = "Objects stand where the cell draws them.";
  return cell.objects.length === 0 ? [placed] : [placed, keptSentence(cell, margin_m)];
}

/** What is taken for true of the parts that are gripped. */
function carried(program: Program, steps: readonly Step[], { taken, missed }: Collisions): string[] {
  if (!steps.some(step => step.type === "gripper")) return [];
  if (!partsAreFollowed(program))
    return [
      "Gripped parts stand where they were drawn: the program decides between motions, and a part may be held on one side only.",
    ];
  return [
    ...(taken > 0
      ? [
          "The part at the grip point moves with the gripper from where it closes to where it opens, and stays there; nothing that lies on it comes along.",
        ]
      : []),
    ...(missed > 0
      ? [
          `The gripper closes on nothing ${missed === 1 ? "once" : `${missed} times`}: no work piece is drawn within ${GRIP_REACH_M * 1000} mm of its grip point.`,
        ]
      : []),
  ];
}

const writtenId = (layout: Layout, id: string): string => layout.turns.get(id)?.written.id ?? id;

/** The plan with the ids that the program has. */
function asWritten(layout: Layout): Plan {
  if (layout.turns.size === 0) return layout.plan;
  return {
    ...layout.plan,
    segments: layout.plan.segments.map(segment => ({ ...segment, step: writtenId(layout, segment.step) })),
  };
}

const decidesByVariables = (step: Step): boolean =>
  (step.type === "if" || step.type === "wait-for") && predicateVariables(step.when).size > 0;

function assumed(steps: readonly Step[], layout: Layout): string[] {
  const has = (type: Step["type"]): boolean => steps.some(step => step.type === type);
  return [
    ...(has("gripper") ? [`The gripper is given ${GRIPPER_S} s to close or open.`] : []),
    ...(has("wait-for") ? ["Waits for signals are given no time."] : []),
    ...(has("while") || steps.some(decidesByVariables)
      ? ["Decisions that variables alone take were followed; where inputs decide, every way was looked at."]
      : []),
    ...(has("if") ? ["Both sides of every decision were looked at, one after the other in the plan."] : []),
    ...(steps.some(step => step.type === "repeat" && step.times === "forever")
      ? ["Loops without end were looked at twice round."]
      : []),
    ...(steps.some(step => step.type === "move" && step.until !== undefined)
      ? ["Searches were looked at as if nothing is found before their end."]
      : []),
    ...(layout.cut === undefined || !(has("repeat") || has("while"))
      ? []
      : [
          `Beyond ${layout.cut} steps, loops were looked at twice round; the duration is less than that of the whole program.`,
        ]),
  ];
}
