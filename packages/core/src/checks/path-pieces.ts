import type { CellGeometry } from "../collision/cell.ts";
import { CellCollider } from "../collision/cell-collider.ts";
import { armScratch, flangePose } from "../kinematics/forward.ts";
import type { Robot } from "../model/robot.ts";
import type { Program } from "../program/program.ts";
import { everyStep } from "../program/walk.ts";
import { compose, identity, type Pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";
import type { MotionSegment } from "../trajectory/plan.ts";
import { LIMIT_SLACK_RAD } from "../trajectory/run.ts";
import { sampleSegment } from "../trajectory/sample.ts";
import type { Checked } from "./check.ts";
import { nearLimit } from "./limits.ts";
import type { Finding, StepVerdict } from "./verdict.ts";

/** A stretch of the path of the TCP with one verdict all along it. */
export interface PathPiece {
  readonly step: string;
  readonly verdict: StepVerdict;
  /** When it is passed, from the start of the program [s]; a way that nobody can go has no time, and both are equal. */
  readonly from_s: number;
  readonly to_s: number;
  /** In the world [m]. */
  readonly points: readonly Vector3[];
}

/** Between two points the TCP moves by less than a few millimetres at ordinary speeds. */
const EVERY_S = 0.02;
/** Points of one motion at most. */
const MOST = 120;
/** From one point to the next a verdict changes so often at most. */
const MOST_CHANGES = 4;
/** A change of the verdict within a motion is found to this [s]. */
const EXACT_S = 1e-5;
const WORSE: Readonly<Record<StepVerdict, number>> = { ok: 0, unknown: 1, warn: 2, bad: 3 };

/**
 * The way of the TCP through a checked program, cut where its verdict changes (rows L-38, L-39): within a motion where
 * a joint comes within 10° of its limit, where it passes it, and where something touches. What a finding says of a
 * whole step, as a speed, holds for all of it. A straight line leads to a target that nothing reaches.
 *
 * @param cell  the one that the program was checked with; nothing touches without it.
 */
export function pathPieces(
  checked: Pick<Checked, "plan" | "verdict" | "bad">,
  program: Program,
  robot: Robot,
  cell?: CellGeometry,
  worldFromBase: Pose<"world", "base"> = cell?.worldFromBase ?? identity(),
): readonly PathPiece[] {
  const cutter = new PieceCutter(checked, program, robot, cell, worldFromBase);
  const pieces = checked.plan.segments.flatMap(segment => (segment.kind === "motion" ? cutter.cut(segment) : []));
  return withUnreached(pieces, checked, program);
}

class PieceCutter {
  private readonly robot: Robot;
  private readonly worldFromBase: Pose<"world", "base">;
  private readonly reports: ReadonlyMap<
    string,
    { readonly verdict: StepVerdict; readonly findings: readonly Finding[] }
  >;
  private readonly bad: ReadonlySet<Finding>;
  private readonly tools: ReadonlyMap<string, Pose<"flange", "tcp">>;
  private readonly collider: CellCollider | undefined;
  private readonly scratch = armScratch();
  private readonly q: Float64Array;
  private readonly baseFromFlange = identity<"base", "flange">();
  private readonly worldFromFlange = identity<"world", "flange">();
  private readonly worldFromTcp = identity<"world", "tcp">();

  constructor(
    { verdict, bad }: Pick<Checked, "verdict" | "bad">,
    program: Program,
    robot: Robot,
    cell: CellGeometry | undefined,
    worldFromBase: Pose<"world", "base">,
  ) {
    this.robot = robot;
    this.worldFromBase = worldFromBase;
    this.reports = new Map(verdict.steps.map(report => [report.id, report]));
    this.bad = new Set(bad);
    this.tools = toolsByStep(program);
    this.q = new Float64Array(robot.arm.joints.length);
    if (cell !== undefined && bad.some(({ code }) => code === "collision.contact")) {
      this.collider = new CellCollider(cell, robot.arm);
      this.collider.allowContactsAt(robot.home_rad);
    }
  }

  cut(segment: MotionSegment): readonly PathPiece[] {
    const report = this.reports.get(segment.step);
    const whole = this.ofWholeStep(segment.step);
    const touches = report?.findings.some(({ code }) => code === "collision.contact") === true;
    const judge = (t_s: number): StepVerdict => worst(whole, this.at(segment, t_s, touches));
    const pieces: PathPiece[] = [];
    const begin = (verdict: StepVerdict, from_s: number): void => {
      points = [this.point(segment, from_s)];
      so = verdict;
      since_s = from_s;
    };
    const end = (to_s: number): void => {
      points.push(this.point(segment, to_s));
      const { start_s } = segment;
      pieces.push({ step: segment.step, verdict: so, from_s: start_s + since_s, to_s: start_s + to_s, points });
    };
    let points: Vector3[] = [];
    let so: StepVerdict = "ok";
    let since_s = 0;
    begin(judge(0), 0);
    const count = Math.min(MOST, Math.max(1, Math.ceil(segment.duration_s / EVERY_S)));
    let before_s = 0;
    for (let i = 1; i <= count; i++) {
      const t_s = segment.duration_s * Math.min(i / count, 1 - 1e-9);
      const verdict = judge(t_s);
      for (let change = 0; verdict !== so && change < MOST_CHANGES; change++) {
        before_s = this.change(judge, so, before_s, t_s);
        end(before_s);
        begin(change < MOST_CHANGES - 1 ? judge(before_s) : verdict, before_s);
      }
      if (i < count) points.push(this.point(segment, t_s));
      before_s = t_s;
    }
    end(segment.duration_s * (1 - 1e-9));
    // A finding that no moment of its own shows, as the contact of a part that is held, is one of the whole motion.
    const judged = report?.verdict ?? "unknown";
    return pieces.every(({ verdict }) => WORSE[verdict] < WORSE[judged]) && this.isNowhere(segment.step, judged)
      ? pieces.map(piece => ({ ...piece, verdict: judged }))
      : pieces;
  }

  /** Of what is not said of moments: all findings but those of joint limits and contacts. */
  private ofWholeStep(step: string): StepVerdict {
    const report = this.reports.get(step);
    if (report === undefined || report.verdict === "unknown") return "unknown";
    return report.findings
      .filter(({ code }) => !isLocal(code))
      .reduce<StepVerdict>((so, finding) => worst(so, this.bad.has(finding) ? "bad" : "warn"), "ok");
  }

  /** Whether the worst finding of a step is one that moments show, and none of its motions does. */
  private isNowhere(step: string, judged: StepVerdict): boolean {
    const report = this.reports.get(step);
    return (
      report !== undefined &&
      judged !== "ok" &&
      report.findings.some(finding => isLocal(finding.code) && this.bad.has(finding) === (judged === "bad"))
    );
  }

  private at(segment: MotionSegment, t_s: number, touches: boolean): StepVerdict {
    const { q, robot } = this;
    sampleSegment(segment, t_s, q);
    let so: StepVerdict = "ok";
    for (let j = 0; j < q.length; j++) {
      const joint = robot.arm.joints[j]!;
      const room = Math.min(joint.limits.upper_rad - q[j]!, q[j]! - joint.limits.lower_rad);
      if (room < -LIMIT_SLACK_RAD) return "bad";
      if (room < nearLimit(joint)) so = "warn";
    }
    return touches && this.collider?.collides(q) === true ? "bad" : so;
  }

  /** The moment between two at which the verdict leaves `from` [s]. */
  private change(judge: (t_s: number) => StepVerdict, from: StepVerdict, low_s: number, high_s: number): number {
    let [low, high] = [low_s, high_s];
    while (high - low > EXACT_S) {
      const middle = (low + high) / 2;
      if (judge(middle) === from) low = middle;
      else high = middle;
    }
    return high;
  }

  private point(segment: MotionSegment, t_s: number): Vector3 {
    sampleSegment(segment, t_s, this.q);
    const { worldFromBase, baseFromFlange, worldFromFlange, worldFromTcp } = this;
    compose(worldFromBase, flangePose(this.robot.arm, this.q, baseFromFlange, this.scratch), worldFromFlange);
    compose(worldFromFlange, this.tools.get(segment.step) ?? NO_TOOL, worldFromTcp);
    const [x, y, z] = worldFromTcp.position;
    return [x, y, z];
  }
}

const NO_TOOL: Pose<"flange", "tcp"> = identity();
const isLocal = (code: string): boolean => code.startsWith("limits.") || code === "collision.contact";
const worst = (a: StepVerdict, b: StepVerdict): StepVerdict => (WORSE[b] > WORSE[a] ? b : a);

/** Between the pieces, a straight line to every target that no motion leads to. */
function withUnreached(
  pieces: readonly PathPiece[],
  { verdict }: Pick<Checked, "verdict">,
  program: Program,
): readonly PathPiece[] {
  const bad = new Set(verdict.steps.filter(step => step.verdict === "bad").map(({ id }) => id));
  const byStep = new Map<string, PathPiece[]>();
  for (const piece of pieces) byStep.set(piece.step, [...(byStep.get(piece.step) ?? []), piece]);
  const lines: PathPiece[] = [];
  let last: PathPiece | undefined;
  for (const step of everyStep(program)) {
    const own = byStep.get(step.id);
    if (own !== undefined) {
      last = own.at(-1);
      continue;
    }
    if (step.type !== "move" || !bad.has(step.id) || !("pose" in step.target)) continue;
    const { frame, pose } = step.target;
    const worldFromFrame = frame === "world" ? identity<"world", "frame">() : program.frames[frame];
    if (worldFromFrame === undefined || Object.hasOwn(program.pallets, frame)) continue;
    const [x, y, z] = compose(worldFromFrame, pose).position;
    const from = last?.points.at(-1);
    const at_s = last?.to_s ?? 0;
    last = {
      step: step.id,
      verdict: "bad",
      from_s: at_s,
      to_s: at_s,
      points: from === undefined ? [[x, y, z]] : [from, [x, y, z]],
    };
    if (from !== undefined) lines.push(last);
  }
  return [...pieces, ...lines];
}

function toolsByStep(program: Program): ReadonlyMap<string, Pose<"flange", "tcp">> {
  const tools = new Map<string, Pose<"flange", "tcp">>();
  for (const step of everyStep(program)) {
    const tool = step.type === "move" && step.target.tool !== undefined ? program.tools[step.target.tool] : undefined;
    if (tool) tools.set(step.id, tool);
  }
  return tools;
}
