import { withBranches, type Dialect, type Emitted, type Pose, type Program, type Robot } from "@twincell/core";

/**
 * A program as it is exported and run: with the postures of its plan where the nearest ones would not do, and as text.
 */
export interface Written {
  readonly program: Program;
  /** null when no language speaks for the robot. */
  readonly emitted: Emitted | null;
}

/** Takes as long as planning does: for a worker. */
export function writeProgram(
  dialect: Dialect | null,
  program: Program,
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
): Written {
  const branched = withBranches(program, robot, { where: "needed", worldFromBase });
  return { program: branched, emitted: dialect?.emit(branched, robot, worldFromBase) ?? null };
}
