import type { Robot } from "../model/robot.ts";
import { isPassedOver } from "../program/predicate.ts";
import type { MoveStep, Program, Step } from "../program/program.ts";
import { withLists } from "../program/walk.ts";
import { distance } from "../spatial/vector.ts";
import { blends, targetInBase, type PlanContext } from "./moves.ts";

/**
 * How the controllers of a language decide how far from its point they round a corner, where it is not the distance
 * that the program says:
 *
 * - "levels": of joint moves and arcs by the nearest of a few levels (INFORM: PL); of straight paths by distance.
 * - "shares": by a share of the ways before and behind the corner (FANUC: CNT).
 * - "speed": by the speed of the motion and the ramp of the arm (V+).
 * - "whole": as far as the ways go, whatever is said (SPEL+: CP).
 */
export type CornerRule = "levels" | "shares" | "speed" | "whole";

/** The rules by the ids of languages; languages that are not named here say distances. */
export const CORNER_RULES: Readonly<Record<string, CornerRule>> = {
  inform: "levels",
  "fanuc-ls": "shares",
  "v-plus": "speed",
  spel: "whole",
};
export const cornerRuleOf = (language: string): CornerRule | undefined =>
  Object.hasOwn(CORNER_RULES, language) ? CORNER_RULES[language] : undefined;

/** The rules of all languages that the controllers of a robot run. */
export const cornerRulesOf = ({ vendorSection }: Pick<Robot, "vendorSection">): readonly CornerRule[] =>
  (vendorSection?.languages ?? []).flatMap(language => cornerRuleOf(language) ?? []);

/** Where corners begin at the levels 1 … 4 of INFORM as delivered [m]. */
export const CORNER_LEVELS_M: readonly number[] = [0.0125, 0.025, 0.05, 0.1];

/** The level, from 1, whose corner is nearest to that distance [m]. */
export const nearestLevel = (corner_m: number): number =>
  1 +
  CORNER_LEVELS_M.reduce(
    (best, each, i) => (Math.abs(each - corner_m) < Math.abs(CORNER_LEVELS_M[best]! - corner_m) ? i : best),
    0,
  );

/** A motion of given duration says nothing of its speed: it is taken for a slow one [m/s]. */
const SLOW_MPS = 0.25;
/** A corner is never cut by more: at full speed the rule asks for more than most motions are long [m]. */
const LARGEST_CORNER_M = 0.05;

/**
 * How far from its end a motion begins to turn into the next one where the speed decides [m]: when it begins to slow
 * down, v² / 2a before its end, where a takes the arm from full speed to rest in its ramp.
 */
export function speedCorner(robot: Robot, { speed }: Pick<MoveStep, "speed">): number {
  const ramp_s = Math.max(...robot.arm.joints.map(({ limits }) => limits.speed_rad_s / limits.acceleration_rad_s2));
  const full_mps = robot.maxTcpSpeed_mps;
  const speed_mps = "mps" in speed ? speed.mps : "ratio" in speed ? speed.ratio * full_mps : SLOW_MPS;
  return Math.min((speed_mps ** 2 * ramp_s) / (2 * full_mps), LARGEST_CORNER_M);
}

/** The share of the ways that CNT says for a corner, in whole percent; 1 where the ways have no length. */
export function cornerShare({ blend_m, blend_ratio = 0 }: MoveStep, shorterWay_m: number): number {
  const share = blend_ratio > 0 ? blend_ratio : shorterWay_m > 0 ? blend_m / (shorterWay_m / 2) : 1;
  return Math.min(100, Math.max(1, Math.round(100 * share))) / 100;
}

type Corner = Required<Pick<MoveStep, "blend_m" | "blend_ratio">>;
/**
 * The corner at the end of a step as controllers of that rule take it.
 *
 * @param shorterWay_m  the shorter of the chords to the points before and behind it.
 */
export function ruledCorner(rule: CornerRule, robot: Robot, step: MoveStep, shorterWay_m: number): Corner {
  const { blend_m, blend_ratio = 0 } = step;
  if (!blends(step)) return { blend_m, blend_ratio };
  switch (rule) {
    case "levels": {
      const corner_m = blend_ratio > 0 ? (blend_ratio * shorterWay_m) / 2 : blend_m;
      const begins_m = step.path === "lin" ? corner_m : CORNER_LEVELS_M[nearestLevel(corner_m) - 1]!;
      return { blend_m: begins_m, blend_ratio: 0 };
    }
    case "shares":
      return { blend_m: 0, blend_ratio: cornerShare(step, shorterWay_m) };
    case "speed":
      return { blend_m: speedCorner(robot, step), blend_ratio: 0 };
    case "whole":
      return { blend_m: 0, blend_ratio: 1 };
  }
}

/** A program whose steps are sent one by one: the robot stands at each point. */
export const withStops = (program: Program): Program =>
  changed(program, ({ step }) => (blends(step) ? { ...step, ...SHARP } : step));
const SHARP = { blend_m: 0, blend_ratio: 0 } as const;

/** A program with its corners as controllers take them that are given it in a language of that rule. */
export function withRuledCorners(program: Program, robot: Robot, rule: CornerRule, context: PlanContext): Program {
  const at = ({ target }: MoveStep) => targetInBase(target, robot, context).position;
  return changed(program, ({ step, before, behind, next }) => {
    if (!blends(step)) return step;
    // CNT is written between motions that stand beside each other only.
    if (rule === "shares" && behind?.type !== "move") return { ...step, ...SHARP };
    const ways_m = [before, next].flatMap(other => (other?.type === "move" ? [distance(at(step), at(other))] : []));
    const shorter_m = ways_m.length === 0 ? 0 : Math.min(...ways_m);
    return { ...step, ...ruledCorner(rule, robot, step, shorter_m) };
  });
}

/** A step as it is written, what stands beside it without what nobody stops for, and the motion that follows first. */
interface Written {
  readonly step: MoveStep;
  readonly before: Step | undefined;
  readonly behind: Step | undefined;
  readonly next: MoveStep | undefined;
}

function changed(program: Program, change: (written: Written) => MoveStep): Program {
  const list = (steps: readonly Step[]): readonly Step[] =>
    steps.map((step, i) => {
      if (step.type !== "move") return withLists(step, list);
      const rest = steps.slice(i + 1).filter(other => !isPassedOver(other));
      const before = steps.slice(0, i).findLast(other => !isPassedOver(other));
      return change({ step, before, behind: rest[0], next: firstMove(rest) });
    });
  return {
    ...program,
    steps: list(program.steps),
    routines: Object.fromEntries(Object.entries(program.routines).map(([name, steps]) => [name, list(steps)])),
  };
}

/** The motion that follows first, inside a loop where one begins. */
function firstMove(steps: readonly Step[]): MoveStep | undefined {
  const [first] = steps;
  if (first === undefined || first.type === "move") return first;
  const within = first.type === "repeat" || first.type === "pallet" ? first.steps : [];
  return firstMove(within.filter(step => !isPassedOver(step)));
}
