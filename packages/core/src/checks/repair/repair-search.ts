import { CellCollider, clearance, robotAndCell } from "../../collision/cell-collider.ts";
import type { CellGeometry } from "../../collision/cell.ts";
import type { Robot } from "../../model/robot.ts";
import { compose, identity, type Pose } from "../../spatial/pose.ts";
import { rotate } from "../../spatial/quaternion.ts";
import { degrees } from "../../spatial/units.ts";
import type { Vector3 } from "../../spatial/vector.ts";
import { layOutProgram } from "../../trajectory/layout.ts";
import type { Plan } from "../../trajectory/plan.ts";
import { LIMIT_SLACK_RAD } from "../../trajectory/run.ts";
import { armScratch, flangePose } from "../../kinematics/forward.ts";
import { sampleSegment } from "../../trajectory/sample.ts";
import { applyRepair, moveFrameBy } from "../../program/edit.ts";
import type { MoveStep, Program } from "../../program/program.ts";
import { everyStep, stepById } from "../../program/walk.ts";
import { checkProgram, type Checked, type CheckOptions } from "../check.ts";
import { detour } from "../detour.ts";
import { Extremes } from "../limits.ts";
import type { Finding, Repair, RepairKind, StepVerdict, Verdict } from "../verdict.ts";
import {
  baseShifts,
  jointInside,
  movable,
  offered,
  partOf,
  partShifts,
  scopesOf,
  targetShifts,
  toolTurns,
  type Candidate,
  type RepairScene,
} from "./candidates.ts";
import { PathFit, placedMoves, type PlacedMove } from "./path-fit.ts";

export interface RepairOptions extends Omit<CheckOptions, "certify" | "onProgress"> {
  /** Ids of the objects that are moved with a frame of the program; none by default. */
  readonly objectsOf?: (frame: string) => readonly string[];
  /** The frames of the program that are moved with one of them, itself among them; it alone by default. */
  readonly framesOf?: (frame: string) => readonly string[];
  /** What a person calls what stands in a frame; the frame's own name by default. */
  readonly nameOf?: (frame: string) => string;
  /** Whether the robot itself may be moved; true by default. */
  readonly movesBase?: boolean;
  /** How many postures a search for a detour may look at; 0 leaves detours out. */
  readonly detourLooks?: number;
}

/** A way out with which the whole program was checked again: the step is no longer bad, and no other has become so. */
export interface ProvenRepair extends Repair {
  readonly kind: RepairKind;
  /** How far it turns or moves [rad, m]; 1 where it does neither. */
  readonly amount: number;
  readonly unit: "rad" | "m" | "1";
  /** So that kinds can be compared: the smallest comes first. */
  readonly effort: number;
  readonly reaches: RepairOutcome;
}

/** What the program's check says with the repair. */
export interface RepairOutcome {
  /** The joint at fault and where it goes then, in its own unit. */
  readonly joint?: {
    readonly joint: number;
    readonly value: number;
    readonly limit: number;
    readonly unit: "rad" | "m";
  };
  /** The posture at the end of the step then; left out where it has no motion. */
  readonly q_rad?: readonly number[];
  readonly duration_s: number;
  /** Against the program as it was; null where that one could not be laid out whole. */
  readonly change_s: number | null;
  readonly clearance_m: number | null;
  /** Steps that are bad then, and before. */
  readonly bad: number;
  readonly badBefore: number;
}

export type BindingCause = "joint-limit" | "reach" | "singularity" | "collision" | "branch" | "speed" | "other";

/** Why a step cannot be carried out, and what would change that. */
export interface Explanation {
  readonly step: string;
  readonly cause: BindingCause;
  readonly finding: Finding;
  /** Part of the step's own time in which a joint is beyond a limit, 0 … 1; left out where no plan gets there. */
  readonly out?: { readonly from: number; readonly to: number };
  /** What the finding says, and where on the path and of the tool it is so. */
  readonly sentence: string;
  /** Three at most, of different kinds, the least change first. */
  readonly repairs: readonly ProvenRepair[];
  /** What was tried and does not help, one sentence each. */
  readonly tried: readonly string[];
}

const MOST_REPAIRS = 3;
const DETOUR_LOOKS = 20_000;
/** Checks of the whole program for one explanation. */
const MOST_CHECKS = 16;
/** Where something touches, a posture is good that keeps so far from the cell [m]. */
const COMFORTABLE_M = 0.005;

/**
 * Explains the bad steps of one program and proves ways out of them: each is applied and the whole program checked
 * again. One instance for a program that does not change; `cell` and `worldFromBase` are those it was judged with.
 */
export class RepairSearch {
  readonly checked: Checked;
  private readonly program: Program;
  private readonly robot: Robot;
  private readonly options: RepairOptions;
  private readonly worldFromBase: Pose<"world", "base">;
  private readonly moves: readonly PlacedMove[];
  private readonly fit: PathFit;
  private readonly postures: PathFit;
  private readonly whole: boolean;
  private checksLeft = 0;

  constructor(program: Program, robot: Robot, options: RepairOptions = {}, checked?: Checked) {
    this.program = program;
    this.robot = robot;
    this.options = options;
    this.worldFromBase = options.worldFromBase ?? options.cell?.worldFromBase ?? identity();
    this.checked = checked ?? checkProgram(program, robot, options);
    const layout = layOutProgram(program, robot, {
      worldFromBase: this.worldFromBase,
      ...(options.start_rad === undefined ? {} : { start_rad: options.start_rad }),
    });
    this.moves = placedMoves(layout);
    this.whole = layout.complete && layout.obstacles.length === 0;
    this.fit = new PathFit(robot, this.accepts());
    this.postures = new PathFit(robot);
  }

  /** Ids of the bad steps, as they are written. */
  get bad(): readonly string[] {
    return badOf(this.checked.verdict);
  }

  /** Undefined for a step that is not bad. */
  explain(id: string): Explanation | undefined {
    const report = this.checked.verdict.steps.find(step => step.id === id);
    const finding = report?.findings[0];
    if (report?.verdict !== "bad" || finding === undefined) return undefined;
    this.checksLeft = MOST_CHECKS;
    const step = stepById(this.program, id);
    const out = this.beyond(id);
    const place = this.place(finding, id);
    const said = {
      step: id,
      cause: causeOf(finding),
      finding,
      ...(out === undefined ? {} : { out }),
      sentence: [finding.sentence, ...(out === undefined ? [] : [outWords(out)]), ...place].join(" "),
    };
    if (step?.type !== "move") return { ...said, repairs: this.provenOf(id, finding, step?.id), tried: [] };
    const tried: string[] = [];
    return { ...said, repairs: this.search(step, report.findings, tried), tried };
  }

  private search(step: MoveStep, findings: readonly Finding[], tried: string[]): readonly ProvenRepair[] {
    const [finding, ...others] = findings as readonly [Finding, ...Finding[]];
    const { program, robot, worldFromBase, moves, fit, postures, options } = this;
    const scene: RepairScene = {
      program,
      robot,
      context: { tools: program.tools, frames: program.frames, worldFromBase },
      worldFromBase,
      moves,
      fit,
      postures,
      step,
      finding,
      others,
      framesOf: options.framesOf ?? alone,
    };
    const nameOf = options.nameOf ?? ((frame: string) => frame);
    const kinds: readonly (readonly [name: string, candidates: Iterable<Candidate>])[] = [
      ["", offered(scene)],
      ["", jointInside(scene)],
      ...(causeOf(finding) === "speed" ? [] : this.turnsAndShifts(scene, nameOf)),
      ...(finding.code.startsWith("collision.") ? [["A way round", this.detours(step)] as const] : []),
    ];
    const found: ProvenRepair[] = [];
    for (const [name, candidates] of kinds) {
      if (options.cancelled?.() === true || this.checksLeft <= 0) break;
      // Points belong on the edge they were traced on: no turn or shift says it better.
      if (found.some(({ kind }) => kind === "edge")) break;
      const proven = this.first(candidates, step.id, finding);
      if (proven !== undefined) found.push(proven);
      else if (name !== "" && this.checksLeft > 0) tried.push(`${name} does not help.`);
    }
    if (this.checksLeft <= 0) tried.push(`The search ended after ${MOST_CHECKS} checks of the whole program.`);
    if (options.movesBase !== false && !movable(scene))
      tried.push("The robot is not moved: the program has points that are joint angles.");
    return leastOfEachKind(found);
  }

  private turnsAndShifts(
    scene: RepairScene,
    nameOf: (frame: string) => string,
  ): (readonly [string, Iterable<Candidate>])[] {
    const scopes = scopesOf(scene);
    const turns = (kind: "spin" | "tilt"): Iterable<Candidate> =>
      (function* (): Generator<Candidate> {
        for (const ids of scopes) yield* toolTurns(scene, kind, ids);
      })();
    const kinds: (readonly [string, Iterable<Candidate>])[] = [
      ["Turning the tool about its own axis", turns("spin")],
      ["Tilting the tool by up to 45°", turns("tilt")],
      ["Moving the point by up to 1 m", targetShifts(scene)],
      ...(partOf(scene) === undefined ? [] : [["Moving the part by up to 1 m", partShifts(scene, nameOf)] as const]),
      ...(this.options.movesBase === false || !movable(scene)
        ? []
        : [["Moving the robot by up to 1 m", baseShifts(scene)] as const]),
    ];
    return kinds;
  }

  private *detours(step: MoveStep): Generator<Candidate> {
    const { cell, margin_m, start_rad, payload, cancelled, detourLooks = DETOUR_LOOKS } = this.options;
    if (cell === undefined || detourLooks === 0) return;
    const answer = detour(this.program, step.id, this.robot, {
      cell,
      maxLooks: detourLooks,
      ...(margin_m === undefined ? {} : { margin_m }),
      ...(start_rad === undefined ? {} : { start_rad }),
      ...(payload === undefined ? {} : { payload }),
      ...(cancelled === undefined ? {} : { cancelled }),
    });
    if (answer.kind !== "found") return;
    const effort = 0.8 + 0.1 * answer.points;
    yield { repair: { ...answer.repair, kind: "detour" }, amount: 1, unit: "1", effort };
  }

  /** What the check itself offers for a step that is no move. */
  private provenOf(id: string, finding: Finding, step: string | undefined): readonly ProvenRepair[] {
    if (step === undefined) return [];
    return finding.repairs
      .flatMap(
        repair =>
          this.prove(
            { repair: { ...repair, kind: repair.kind ?? "slower" }, amount: 1, unit: "1", effort: 0.5 },
            id,
            finding,
          ) ?? [],
      )
      .slice(0, MOST_REPAIRS);
  }

  private first(candidates: Iterable<Candidate>, id: string, finding: Finding): ProvenRepair | undefined {
    for (const candidate of candidates) {
      const proven = this.prove(candidate, id, finding);
      if (proven !== undefined) return proven;
      if (this.options.cancelled?.() === true || this.checksLeft <= 0) return undefined;
    }
    return undefined;
  }

  /** Applies it and checks the whole program again. */
  private prove({ repair, amount, unit, effort }: Candidate, id: string, finding: Finding): ProvenRepair | undefined {
    const { program, options, robot, checked } = this;
    this.checksLeft--;
    const after = checkRepaired(program, robot, options, id, repair);
    const before = new Map(checked.verdict.steps.map(step => [step.id, step.verdict]));
    const worse = after.verdict.steps.some(step => step.verdict === "bad" && passes(before.get(step.id) ?? "ok"));
    const mended = after.verdict.steps.find(step => step.id === id);
    if (worse || mended === undefined || !passes(mended.verdict)) return undefined;
    const end = after.plan.segments.findLast(segment => segment.step === id && segment.kind === "motion");
    const joint = finding.joint === undefined ? undefined : this.goesTo(after.plan, id, finding.joint);
    return {
      ...repair,
      amount,
      unit,
      effort,
      reaches: {
        ...(joint === undefined ? {} : { joint }),
        ...(end === undefined ? {} : { q_rad: Array.from(end.q_rad.slice(-robot.arm.joints.length)) }),
        duration_s: after.verdict.duration_s,
        change_s: this.whole ? after.verdict.duration_s - checked.verdict.duration_s : null,
        clearance_m: after.verdict.clearance_m,
        bad: badOf(after.verdict).length,
        badBefore: badOf(checked.verdict).length,
      },
    };
  }

  /** Nothing of the robot touches. What is held may: that is known to the program's check only. */
  private accepts(): ((q_rad: Float64Array) => boolean) | undefined {
    const { cell } = this.options;
    if (cell === undefined || [...everyStep(this.program)].some(({ type }) => type === "gripper")) return undefined;
    const collider = new CellCollider(cell, this.robot.arm);
    collider.allowContactsAt(this.robot.home_rad);
    const least_m = COMFORTABLE_M + (this.options.margin_m ?? 0);
    const near = clearance();
    return q_rad => {
      if (collider.collides(q_rad)) return false;
      collider.clearance(q_rad, least_m, near, robotAndCell);
      return near.distance_m >= least_m;
    };
  }

  private goesTo(plan: Plan, id: string, number: number): NonNullable<RepairOutcome["joint"]> | undefined {
    const joint = this.robot.arm.joints[number - 1];
    if (joint === undefined) return undefined;
    const { lower_rad, upper_rad } = joint.limits;
    const extremes = new Extremes(this.robot.arm.joints.length);
    let best: { value: number; limit: number; room: number } | undefined;
    for (const segment of plan.segments) {
      if (segment.step !== id || segment.kind !== "motion") continue;
      extremes.of(segment);
      for (const [value, limit] of [
        [extremes.low[number - 1]!, lower_rad],
        [extremes.high[number - 1]!, upper_rad],
      ] as const) {
        const room = Math.abs(limit - value);
        if (best === undefined || room < best.room) best = { value, limit, room };
      }
    }
    const unit = joint.kind === "prismatic" ? "m" : "rad";
    return best && { joint: number, value: best.value, limit: best.limit, unit };
  }

  /** First and last moment of the step at which a joint is beyond a limit, as parts of its time. */
  private beyond(id: string): { readonly from: number; readonly to: number } | undefined {
    const joints = this.robot.arm.joints;
    const n = joints.length;
    for (const segment of this.checked.plan.segments) {
      if (segment.step !== id || segment.kind !== "motion" || !(segment.duration_s > 0)) continue;
      let from: number | undefined;
      let to = 0;
      for (let i = 0; i < segment.times_s.length; i++) {
        const out = joints.some(({ limits }, j) => {
          const q = segment.q_rad[i * n + j]!;
          return q > limits.upper_rad + LIMIT_SLACK_RAD || q < limits.lower_rad - LIMIT_SLACK_RAD;
        });
        if (!out) continue;
        from ??= segment.times_s[i]! / segment.duration_s;
        to = segment.times_s[i]! / segment.duration_s;
      }
      if (from !== undefined) return { from, to };
    }
    return undefined;
  }

  /** How the tool stands where it is worst, in words. */
  private place({ at_s }: Finding, id: string): readonly string[] {
    const segment = this.checked.plan.segments.findLast(
      each => each.step === id && each.kind === "motion" && each.start_s <= at_s + 1e-9,
    );
    const own = this.moves.find(({ written }) => written === id);
    if (segment === undefined || own === undefined) return [];
    const q = new Float64Array(this.robot.arm.joints.length);
    sampleSegment(segment, at_s - segment.start_s, q);
    const baseFromTcp = compose(flangePose(this.robot.arm, q, identity(), armScratch()), own.move.flangeFromTcp);
    const worldFromTcp = compose(this.worldFromBase, baseFromTcp);
    const [, , down] = rotate(worldFromTcp.quaternion, [0, 0, 1]);
    const off = degrees(Math.acos(Math.max(-1, Math.min(1, -down))));
    const [x, y] = baseFromTcp.position;
    const fromAxis_mm = (Math.hypot(x, y) * 1000).toFixed(0);
    return [`There the tool stands ${off.toFixed(0)}° off straight down, ${fromAxis_mm} mm from axis 1.`];
  }
}

/** The program with a repair, and the cell as it is then. */
export function withRepair(
  program: Program,
  id: string,
  repair: Repair,
  cell: CellGeometry | undefined,
  { objectsOf = () => [], framesOf = alone }: Pick<RepairOptions, "objectsOf" | "framesOf"> = {},
): { readonly program: Program; readonly cell?: CellGeometry } {
  const { moveFrame, moveBase } = repair;
  const others = moveFrame === undefined ? [] : framesOf(moveFrame.frame).filter(frame => frame !== moveFrame.frame);
  const changed = others.reduce(
    (so, frame) => moveFrameBy(so, frame, moveFrame!.by_m),
    applyRepair(program, id, repair),
  );
  if (cell === undefined) return { program: changed };
  const along = new Set(moveFrame === undefined ? [] : objectsOf(moveFrame.frame));
  return {
    program: changed,
    cell: {
      ...cell,
      ...(moveBase === undefined ? {} : { worldFromBase: shiftedPose(cell.worldFromBase, moveBase.by_m) }),
      ...(along.size === 0 || moveFrame === undefined
        ? {}
        : {
            objects: cell.objects.map(object =>
              along.has(object.id)
                ? { ...object, worldFromObject: shiftedPose(object.worldFromObject, moveFrame.by_m) }
                : object,
            ),
          }),
    },
  };
}

/** A pose in the world moved by so much [m]. */
export const shiftedPose = <From extends string>(
  { position, quaternion }: Pose<"world", From>,
  [x, y, z]: Vector3,
): Pose<"world", From> => ({ position: [position[0] + x, position[1] + y, position[2] + z], quaternion });

export function checkRepaired(
  program: Program,
  robot: Robot,
  options: RepairOptions,
  id: string,
  repair: Repair,
): Checked {
  const repaired = withRepair(program, id, repair, options.cell, options);
  const {
    objectsOf: _objects,
    framesOf: _frames,
    nameOf: _name,
    movesBase: _base,
    detourLooks: _looks,
    ...asked
  } = options;
  const stood = options.worldFromBase ?? options.cell?.worldFromBase ?? identity<"world", "base">();
  return checkProgram(repaired.program, robot, {
    ...asked,
    ...(repaired.cell === undefined ? {} : { cell: repaired.cell }),
    ...(repair.moveBase === undefined ? {} : { worldFromBase: shiftedPose(stood, repair.moveBase.by_m) }),
  });
}

const alone = (frame: string): readonly string[] => [frame];
export const passes = (verdict: StepVerdict): boolean => verdict === "ok" || verdict === "warn";
export const badOf = (verdict: Verdict): readonly string[] =>
  verdict.steps.filter(step => step.verdict === "bad").map(({ id }) => id);

function causeOf({ code, sentence }: Finding): BindingCause {
  if (code.startsWith("limits.")) return "joint-limit";
  if (code.startsWith("reach.") || code.startsWith("path.")) return "reach";
  if (code.startsWith("singular.")) return "singularity";
  if (code === "branch.no-way") return sentence.includes("would have to jump") ? "singularity" : "branch";
  if (code.startsWith("branch.")) return "branch";
  if (code.startsWith("collision.")) return "collision";
  return code.startsWith("speed.") || code.startsWith("torque.") ? "speed" : "other";
}

const percent = (share: number): string => `${Math.round(share * 100)} %`;
const outWords = ({ from, to }: { readonly from: number; readonly to: number }): string =>
  to - from < 0.005
    ? `That is so at ${percent(to)} of the step.`
    : `That is so from ${percent(from)} to ${percent(to)} of the step.`;

function leastOfEachKind(found: readonly ProvenRepair[]): readonly ProvenRepair[] {
  const kinds = new Set<RepairKind>();
  return found
    .toSorted((a, b) => a.effort - b.effort)
    .filter(({ kind }) => !kinds.has(kind) && kinds.add(kind))
    .slice(0, MOST_REPAIRS);
}
