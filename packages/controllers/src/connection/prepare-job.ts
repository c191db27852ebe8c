import {
  checkProgram,
  cornerRuleOf,
  identity,
  linkSolids,
  planProgram,
  withBranches,
  withRuledCorners,
  withStops,
  type CarriedPart,
  type CellGeometry,
  type CornerArea,
  type Dialect,
  type EmittedFile,
  type Finding,
  type Plan,
  type Pose,
  type Program,
  type Refusal,
  type Robot,
} from "@twincell/core";
import { notEmitted } from "./words.ts";

/** A cell as it goes from thread to thread: the links of its robot are made from the robot. */
export type CellDefinition = Omit<CellGeometry, "links">;
/** The cell with the links of that robot in it. Pure. */
export const withLinks = (cell: CellDefinition, robot: Robot): CellGeometry => ({ ...cell, links: linkSolids(robot) });

export interface JobQuestion {
  readonly program: Program;
  readonly robot: Robot;
  readonly start_rad: Float64Array;
  readonly worldFromBase?: Pose<"world", "base">;
  /** What it must not touch, with the tool it carries; only itself when left out. */
  readonly cell?: CellDefinition;
  /** The language it is to be written in; its steps are sent when left out. */
  readonly dialect?: Dialect;
}
/** A program as it is sent: plain data, which may come from another thread. */
export interface PreparedJob {
  /** From where the robot stood; null where it cannot be carried out, which `stuck` tells. */
  readonly plan: Plan | null;
  readonly stuck: Refusal | null;
  /** What the check found on the plan, in order of time. */
  readonly findings: readonly Finding[];
  /** Those of them that make the check red. */
  readonly bad: readonly Finding[];
  /** The parts it carries, in the order they are taken. */
  readonly carried: readonly CarriedPart[];
  /** What the controller may make of the corners that it passes without a stop. */
  readonly corners: readonly CornerArea[];
  /** The text, with the postures of the plan; null when steps are sent. */
  readonly files: readonly EmittedFile[] | null;
  /** Why it cannot be written. */
  readonly unwritten: Refusal | null;
}
/**
 * Lays programs out. It takes from milliseconds to seconds: a host whose links must not wait hands it to another
 * thread.
 */
export type PrepareJob = (question: JobQuestion) => Promise<PreparedJob>;

/**
 * A program as the robot will carry it out: steps that are sent end at each point, and a text rounds its corners as its
 * language does.
 */
function asSent({ program, robot, worldFromBase, dialect }: JobQuestion): Program {
  if (!dialect) return withStops(program);
  const rule = cornerRuleOf(dialect.id);
  if (rule === undefined) return program;
  const { tools, frames } = program;
  return withRuledCorners(program, robot, rule, { tools, frames, ...(worldFromBase ? { worldFromBase } : {}) });
}

/** Plans, checks and writes a program. The plan is of what the robot will do with it. Pure. */
export function prepareJob(question: JobQuestion): PreparedJob {
  const { program, robot, start_rad, worldFromBase, cell, dialect } = question;
  const from = { start_rad, ...(worldFromBase ? { worldFromBase } : {}) };
  const sent = asSent(question);
  const answer = planProgram(sent, robot, from);
  const keptClearOf = withLinks(
    cell ?? {
      worldFromBase: worldFromBase ?? identity(),
      objects: [],
      allowedPairs: [],
      shapeError_m: robot.shapeError_m,
    },
    robot,
  );
  const {
    verdict,
    bad,
    carried,
    corners = [],
  } = checkProgram(sent, robot, {
    ...from,
    cell: keptClearOf,
    cornerAreas: true,
  });
  const findings = verdict.steps.flatMap(step => step.findings).sort((a, b) => a.at_s - b.at_s);
  const written = dialect?.emit(
    withBranches(program, robot, { where: "needed", ...(worldFromBase ? { worldFromBase } : {}) }),
    robot,
    worldFromBase,
  );
  return {
    findings,
    bad,
    carried,
    corners,
    plan: answer.kind === "planned" ? answer.plan : null,
    stuck:
      answer.kind === "planned"
        ? null
        : { code: answer.stuck.code, sentence: answer.stuck.sentence, hint: answer.stuck.hint },
    files: written && written.kind !== "cannot" ? written.files : null,
    unwritten: written?.kind === "cannot" ? notEmitted(dialect!.name, written.sentence, written.hint) : null,
  };
}
