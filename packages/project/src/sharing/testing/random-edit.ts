import { insertSteps, moveBefore, removeSteps, stepById, type Program, type Random, type Step } from "@twincell/core";
import { addProgram, renameProgram } from "../../programs.ts";
import { isTextProgram, type CellDocument, type ObjectRecord } from "../../document.ts";
import { emptyCell } from "../../example/index.ts";

/** What editors wanted, told by each of them when it was done. */
export interface Intents {
  /** Names of things that were added and not taken out: they have to be there. */
  readonly added: Map<string, "step" | "object" | "comment" | "program">;
  /** Names of things that somebody took out: they must not be there. */
  readonly removed: Set<string>;
  /** What an editor last gave a thing that nobody else changes. */
  readonly last: Map<string, number>;
}
export const noIntents = (): Intents => ({ added: new Map(), removed: new Set(), last: new Map() });

const pick = <T>(list: readonly T[], random: Random): T | undefined => list[Math.floor(random() * list.length)];
const step = (id: string, name: string): Step => ({ type: "wait", id, s: 0, name });
const box = (id: string, name: string): ObjectRecord => ({
  id,
  name,
  role: "furniture",
  worldFromObject: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
  shape: { kind: "box", size_m: [1, 1, 1] },
  color: "#808080",
});
const owned = (who: number): string => `own-${who}`;

/** A cell in which each editor has a step and an object of its own, which everybody may put elsewhere in the order. */
export function cellForEditors(count: number): CellDocument {
  const cell = emptyCell();
  const numbers = Array.from({ length: count }, (_, who) => owned(who));
  const [first] = cell.programs;
  if (!first || isTextProgram(first)) throw new Error("The empty cell has no program of steps.");
  return {
    ...cell,
    objects: numbers.map(name => box(name, name)),
    programs: [{ ...first, steps: numbers.map(name => step(name, name)) }],
  };
}

function inProgram(cell: CellDocument, name: string, change: (program: Program) => Program): CellDocument {
  return {
    ...cell,
    programs: cell.programs.map(each => (each.name === name && !isTextProgram(each) ? change(each) : each)),
  };
}

/**
 * One random edit: things are added, changed, put into another order and taken out; ids of steps, objects and programs
 * are often those that somebody else takes at the same time.
 *
 * @param who  number of the editor. @param count  number of this edit, of all that this editor makes.
 * @returns the cell afterwards; the very same where the dice found nothing to change.
 */
export function randomEdit(
  cell: CellDocument,
  who: number,
  count: number,
  random: Random,
  intents: Intents,
): CellDocument {
  const name = `e${who}.${count}`;
  const program = pick(
    cell.programs.filter(each => !isTextProgram(each)),
    random,
  ) as Program;
  const dice = Math.floor(random() * 20);
  if (dice < 5) {
    intents.added.set(name, "step");
    const id = `s${program.steps.length}`;
    return inProgram(cell, program.name, before =>
      insertSteps(before, Math.floor(random() * (before.steps.length + 1)), [step(id, name)]),
    );
  }
  if (dice < 7) {
    const id = `o${cell.objects.length}`;
    if (cell.objects.some(each => each.id === id)) return cell;
    intents.added.set(name, "object");
    return { ...cell, objects: [...cell.objects, box(id, name)] };
  }
  if (dice < 10) return changeOwnStep(cell, who, random() * 100, intents);
  if (dice < 13) {
    const x = random();
    intents.last.set(`object ${owned(who)}`, x);
    return {
      ...cell,
      objects: cell.objects.map(each =>
        each.name === owned(who)
          ? { ...each, worldFromObject: { ...each.worldFromObject, position: [x, 0, 0] as const } }
          : each,
      ),
    };
  }
  if (dice < 16) {
    const [from, to] = [pick(program.steps, random), pick(program.steps, random)];
    return from && to && from !== to
      ? inProgram(cell, program.name, before => moveBefore(before, [from.id], to.id))
      : cell;
  }
  if (dice < 17) {
    const comment = { id: name, program: program.name, step: program.steps[0]?.id ?? "s", who: owned(who), text: name };
    intents.added.set(name, "comment");
    return { ...cell, comments: [...(cell.comments ?? []), { ...comment, at: "2026-11-27T12:00:00Z" }] };
  }
  if (dice < 18) {
    const found = pick(
      program.steps.filter(each => !each.name?.startsWith("own-")),
      random,
    );
    if (found?.name === undefined) return cell;
    intents.removed.add(found.name);
    return inProgram(cell, program.name, before => removeSteps(before, [found.id]));
  }
  if (dice < 19 && cell.programs.length < 4) return addProgram(cell);
  return renameProgram(cell, program.name, `Program ${count % 5}`);
}

function changeOwnStep(cell: CellDocument, who: number, s: number, intents: Intents): CellDocument {
  const isMine = (each: Step): boolean => each.name === owned(who);
  const program = cell.programs.find((each): each is Program => !isTextProgram(each) && each.steps.some(isMine));
  const mine = program?.steps.find(isMine);
  if (!program || mine?.type !== "wait") return cell;
  intents.last.set(`step ${owned(who)}`, s);
  return inProgram(cell, program.name, before => ({
    ...before,
    steps: before.steps.map(each => (each === stepById(before, mine.id) ? { ...mine, s } : each)),
  }));
}

/** The intents that a cell does not show, one sentence each. */
export function lostIntents(cell: CellDocument, { added, removed, last }: Intents): readonly string[] {
  const steps = cell.programs.flatMap(each => (isTextProgram(each) ? [] : each.steps));
  const names = new Set([
    ...steps.map(each => each.name ?? ""),
    ...cell.objects.map(each => each.name),
    ...(cell.comments ?? []).map(each => each.text),
  ]);
  const lost: string[] = [];
  for (const [name, kind] of added)
    if (!names.has(name) && !removed.has(name)) lost.push(`${kind} ${name} was added and is not there.`);
  for (const name of removed) if (names.has(name)) lost.push(`step ${name} was taken out and is there.`);
  for (const [what, value] of last) {
    const [kind, name] = what.split(" ");
    const found =
      kind === "step"
        ? steps.find((each): each is Extract<Step, { type: "wait" }> => each.type === "wait" && each.name === name)?.s
        : cell.objects.find(each => each.name === name)?.worldFromObject.position[0];
    if (found !== value) lost.push(`${what} was last ${value} and is ${found}.`);
  }
  return lost;
}
