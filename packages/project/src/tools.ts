import {
  compose,
  everyStep,
  flangePose,
  identity,
  inverse,
  nearestSolution,
  robotById,
  solverScratch,
  withLists,
  type Pose,
  type Program,
  type Step,
  type Target,
} from "@twincell/core";
import { isTextProgram, type CellDocument, type ObjectRecord, type ToolRecord } from "./document.ts";
import { partById, partNumbers, type PartKind, type PartNumbers } from "./parts/index.ts";

/** A tool of the library under that name; undefined for a part that is none. */
export function toolOfPart(kind: PartKind, name: string, given: PartNumbers = {}): ToolRecord | undefined {
  if (kind.tool === undefined) return undefined;
  const numbers = partNumbers(kind, given);
  return { name, ...kind.tool(numbers), shape: { kind: "part", part: kind.id, parameters: numbers } };
}

/** The tool with other numbers: its TCP follows them, unless a person moved it. */
export function changedTool(tool: ToolRecord, given: PartNumbers): ToolRecord {
  if (tool.shape?.kind !== "part") return tool;
  const kind = partById(tool.shape.part);
  if (kind?.tool === undefined) return tool;
  const before = kind.tool(partNumbers(kind, tool.shape.parameters));
  const numbers = partNumbers(kind, { ...tool.shape.parameters, ...given });
  const isMoved = JSON.stringify(before.flangeFromTcp) !== JSON.stringify(tool.flangeFromTcp);
  const after = kind.tool(numbers);
  return {
    ...tool,
    ...after,
    flangeFromTcp: isMoved ? tool.flangeFromTcp : after.flangeFromTcp,
    shape: { ...tool.shape, parameters: numbers },
  };
}

/**
 * An object of the cell as a tool: its frame on the flange, the TCP where it ends along its own z axis.
 *
 * @param end_m  that end.
 */
export const toolOfObject = (object: ObjectRecord, name: string, end_m: number): ToolRecord => ({
  name,
  flangeFromTcp: { position: [0, 0, end_m], quaternion: [0, 0, 0, 1] },
  shape: object.shape,
  ...(object.mass_kg === undefined ? {} : { mass_kg: object.mass_kg }),
});

/** A name that no tool of the cell has. */
export function freeToolName({ tools }: CellDocument, wanted: string): string {
  const taken = new Set(["flange", ...tools.map(({ name }) => name)]);
  let name = wanted;
  for (let n = 2; taken.has(name); n++) name = `${wanted} ${n}`;
  return name;
}

/** The cell with one more tool, which is in use from now on. What was taught keeps the tool it was taught with. */
export const withNewTool = (cell: CellDocument, tool: ToolRecord): CellDocument => ({
  ...cell,
  tools: [...cell.tools, tool],
  tool: tool.name,
});

/** The tool a point was taught with; joint angles that name none are of no tool, as a home position is. */
const toolIn = (target: Target): string | undefined => target.tool;

/** How many points of the cell were taught with that tool. */
export function pointsTaughtWith({ programs }: CellDocument, name: string): number {
  let points = 0;
  for (const program of programs)
    if (!isTextProgram(program))
      for (const step of everyStep(program)) if (step.type === "move" && toolIn(step.target) === name) points++;
  return points;
}

/**
 * Everything that was taught with one tool ("flange" for none) is carried out with another one of the cell, which is in
 * use from then on (row M-63): its tip goes where the old one went. Points that are joint angles become the nearest
 * angles that bring the new tip there.
 */
export function swappedTool(cell: CellDocument, from: string, name: string): CellDocument {
  if (from === name || (name !== "flange" && !cell.tools.some(tool => tool.name === name))) return cell;
  const robot = robotById(cell.robot.id);
  const poseOf = (tool: string): Pose<"flange", "tcp"> =>
    cell.tools.find(each => each.name === tool)?.flangeFromTcp ?? identity();
  const oldFromNew = compose(poseOf(from), inverse(poseOf(name)));
  const scratch = solverScratch();
  const retooled = (target: Target): Target => {
    if (toolIn(target) !== from) return target;
    if (!("q" in target)) return { ...target, tool: name };
    if (robot === undefined) return target;
    const baseFromFlange = flangePose(robot.arm, target.q);
    const q = Float64Array.from(target.q);
    if (nearestSolution(robot, compose(baseFromFlange, oldFromNew as Pose<"flange", "flange">), target.q, q, scratch))
      return { q: Array.from(q), tool: name };
    // Out of reach with the new tool: the place is kept, and the check says so.
    const tip = compose(compose(cell.robot.worldFromBase, baseFromFlange), poseOf(from));
    return { pose: { position: tip.position, quaternion: tip.quaternion }, frame: "world", tool: name };
  };
  const list = (steps: readonly Step[]): readonly Step[] =>
    steps.map((step): Step => {
      if (step.type !== "move") return withLists(step, list);
      const moved = { ...step, target: retooled(step.target) };
      return step.via === undefined ? moved : { ...moved, via: retooled(step.via) };
    });
  return {
    ...cell,
    tool: name,
    programs: cell.programs.map(program => (isTextProgram(program) ? program : withSteps(program, list))),
  };
}

const withSteps = (program: Program, change: (steps: readonly Step[]) => readonly Step[]): Program => ({
  ...program,
  steps: change(program.steps),
  routines: Object.fromEntries(Object.entries(program.routines).map(([name, steps]) => [name, change(steps)])),
});
