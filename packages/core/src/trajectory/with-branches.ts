import { branchOf, sameBranch, type Branch } from "../kinematics/branch.ts";
import { isSingularConfiguration } from "../kinematics/singularity.ts";
import type { Robot } from "../model/robot.ts";
import type { Pose } from "../spatial/pose.ts";
import { Follower } from "./follow.ts";
import { GoalFinder } from "./goal.ts";
import type { Move } from "./moves.ts";
import { layOutProgram, type Ends } from "./layout.ts";
import type { MoveStep, Program, Step, Target } from "../program/program.ts";
import { withLists } from "../program/walk.ts";

export interface WithBranchesOptions {
  /**
   * "needed": only where the nearest posture is another one than the plan's. "everywhere": at every pose, for
   * controllers with rules of their own.
   */
  readonly where?: "needed" | "everywhere";
  readonly worldFromBase?: Pose<"world", "base">;
  readonly start_rad?: ArrayLike<number>;
}

/** Two postures this near are one [rad]. */
const SAME_RAD = 1e-6;

/** What a target is given so that a controller ends in the posture of the plan. */
type Addition = { readonly branch: Branch } | { readonly q: readonly number[] };
/** Of all times a step is carried out. `addition` is undefined where nothing would do for all of them. */
interface Wish {
  readonly needed: boolean;
  readonly addition: Addition | undefined;
}

/**
 * The program with the postures of its plan written into it, so that what executes it step by step, an exported text or
 * a controller, goes the same way as the plan that was checked. A pose gets its branch; a joint move for which the
 * branch is not enough, since it should end whole turns away from the nearest posture, becomes a move to joint angles.
 * Targets that have a branch or joint angles keep them, and so does a step that is carried out in different postures,
 * at the places of a pallet for instance.
 *
 * @returns the very same program when nothing is to be written.
 */
export function withBranches(program: Program, robot: Robot, options: WithBranchesOptions = {}): Program {
  const { where = "everywhere", worldFromBase, start_rad } = options;
  const layout = layOutProgram(program, robot, {
    ...(worldFromBase === undefined ? {} : { worldFromBase }),
    ...(start_rad === undefined ? {} : { start_rad }),
  });
  const goals = new GoalFinder(robot, new Follower(robot.arm));
  const wishes = new Map<string, Wish>();
  for (const [id, move] of layout.moves) {
    const ends = layout.ends.get(id);
    const turn = layout.turns.get(id);
    const written = turn?.written.id ?? id;
    if (ends === undefined || move.q_rad !== undefined || move.branch !== undefined) continue;
    // At the places of a pallet joint angles would be another pose each time.
    const wish = wishFor(move, ends, robot, goals, (turn?.visits.length ?? 0) === 0);
    const known = wishes.get(written);
    wishes.set(
      written,
      known === undefined
        ? wish
        : {
            needed: known.needed || wish.needed,
            addition: sameAddition(known.addition, wish.addition) ? wish.addition : undefined,
          },
    );
  }
  const list = (steps: readonly Step[]): readonly Step[] => {
    const after = steps.map((step): Step => {
      if (step.type !== "move") return withLists(step, list);
      const wish = wishes.get(step.id);
      return wish?.addition === undefined || !(wish.needed || where === "everywhere")
        ? step
        : withAddition(step, wish.addition);
    });
    return after.every((step, i) => step === steps[i]) ? steps : after;
  };
  const steps = list(program.steps);
  const routines = Object.fromEntries(Object.entries(program.routines).map(([name, inside]) => [name, list(inside)]));
  const same = Object.entries(routines).every(([name, inside]) => inside === program.routines[name]);
  return same && steps === program.steps
    ? program
    : { ...program, steps, routines: same ? program.routines : routines };
}

function wishFor(move: Move, { from_rad, to_rad }: Ends, robot: Robot, goals: GoalFinder, byJoints: boolean): Wish {
  const branch = isSingularConfiguration(robot, to_rad) ? undefined : branchOf(robot, to_rad);
  // A path keeps the posture it begins with, whatever its target says.
  if (move.step.path !== "ptp") return { needed: false, addition: branch === undefined ? undefined : { branch } };
  const endsThere = (told: Move): boolean => {
    const goal = goals.find(told, from_rad);
    return goal.kind === "posture" && goal.q_rad.every((q, j) => Math.abs(q - to_rad[j]!) <= SAME_RAD);
  };
  const free: Move = {
    step: move.step,
    flangeFromTcp: move.flangeFromTcp,
    tcpFromFlange: move.tcpFromFlange,
    baseFromTcp: move.baseFromTcp,
    baseFromFlange: move.baseFromFlange,
  };
  const needed = !endsThere(free);
  if (branch !== undefined && endsThere({ ...free, branch })) return { needed, addition: { branch } };
  return { needed, addition: needed && byJoints ? { q: Array.from(to_rad) } : undefined };
}

function sameAddition(a: Addition | undefined, b: Addition | undefined): boolean {
  if (a === undefined || b === undefined) return false;
  if ("q" in a) return "q" in b && a.q.every((q, j) => Math.abs(q - b.q[j]!) <= SAME_RAD);
  return "branch" in b && sameBranch(a.branch, b.branch);
}

function withAddition(step: MoveStep, addition: Addition): MoveStep {
  const { target } = step;
  if ("q" in target) return step;
  const next: Target = "q" in addition ? { q: addition.q, tool: target.tool } : { ...target, branch: addition.branch };
  return { ...step, target: next };
}
