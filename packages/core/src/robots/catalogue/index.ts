import type { Robot } from "../../model/robot.ts";
import { robotOfEntry, type CatalogueEntry, type CatalogueMaker } from "./entry.ts";

export type { CatalogueEntry, CatalogueMaker } from "./entry.ts";

const made = new Map<string, Robot>();
const entries = new Map<string, readonly [entry: CatalogueEntry, vendor: string]>();

/**
 * Makes the robots of a catalogue known to `robotById` and to everything that asks it. The data are a module of their
 * own (`@twincell/core/catalogue`), so that a page can load them after its start. Adding them again changes nothing.
 */
export function addCatalogue(makers: readonly CatalogueMaker[]): void {
  for (const { vendor, robots } of makers) for (const entry of robots) entries.set(entry.id, [entry, vendor]);
}

/**
 * The robot of the catalogue with that id, made of its entry at first; undefined for others. The same object every
 * time.
 */
export function catalogueRobot(id: string): Robot | undefined {
  const known = made.get(id);
  if (known !== undefined) return known;
  const found = entries.get(id);
  if (found === undefined) return undefined;
  const robot = robotOfEntry(...found);
  made.set(id, robot);
  return robot;
}

/** Every robot of the catalogues that were added, made of its entry. */
export const catalogueRobots = (): readonly Robot[] => Array.from(entries.keys(), id => catalogueRobot(id)!);
