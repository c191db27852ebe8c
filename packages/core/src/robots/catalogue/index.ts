import type { Robot } from "../robot.ts";
import { ABB } from "./abb.ts";
import { AUBO } from "./aubo.ts";
import { DENSO } from "./denso.ts";
import { DOBOT } from "./dobot.ts";
import { DOOSAN } from "./doosan.ts";
import { FANUC } from "./fanuc.ts";
import { FRANKA_ROBOTICS } from "./franka-robotics.ts";
import { KAWASAKI } from "./kawasaki.ts";
import { KINOVA } from "./kinova.ts";
import { KUKA } from "./kuka.ts";
import { MITSUBISHI_ELECTRIC } from "./mitsubishi-electric.ts";
import { RETHINK_ROBOTICS } from "./rethink-robotics.ts";
import { STAUBLI } from "./staubli.ts";
import { TECHMAN } from "./techman.ts";
import { UFACTORY } from "./ufactory.ts";
import { UNIVERSAL_ROBOTS } from "./universal-robots.ts";
import { YASKAWA } from "./yaskawa.ts";
import { robotOfEntry, type CatalogueEntry, type CatalogueMaker } from "./entry.ts";

export type { CatalogueEntry, CatalogueMaker } from "./entry.ts";

/**
 * Robots by their makers' public descriptions, beside the library: data alone, drawn from their dimensions. A robot is made of
 * its entry when it is asked for the first time, so that the list costs nothing at the start.
 */
export const CATALOGUE: readonly CatalogueMaker[] = [
  ABB,
  AUBO,
  DENSO,
  DOBOT,
  DOOSAN,
  FANUC,
  FRANKA_ROBOTICS,
  KAWASAKI,
  KINOVA,
  KUKA,
  MITSUBISHI_ELECTRIC,
  RETHINK_ROBOTICS,
  STAUBLI,
  TECHMAN,
  UFACTORY,
  UNIVERSAL_ROBOTS,
  YASKAWA,
];

const made = new Map<string, Robot>();
let entries: ReadonlyMap<string, readonly [entry: CatalogueEntry, vendor: string]> | undefined;

/** The robot of the catalogue with that id, or undefined; the same object every time. */
export function catalogueRobot(id: string): Robot | undefined {
  const known = made.get(id);
  if (known !== undefined) return known;
  entries ??= new Map(
    CATALOGUE.flatMap(({ vendor, robots }) => robots.map(each => [each.id, [each, vendor]] as const)),
  );
  const found = entries.get(id);
  if (found === undefined) return undefined;
  const robot = robotOfEntry(...found);
  made.set(id, robot);
  return robot;
}

/** Every robot of the catalogue, made of its entry. */
export const catalogueRobots = (): readonly Robot[] =>
  CATALOGUE.flatMap(({ robots }) => robots.map(({ id }) => catalogueRobot(id)!));
