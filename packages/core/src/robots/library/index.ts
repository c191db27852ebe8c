import { catalogueRobot } from "../catalogue/index.ts";
import type { Robot } from "../../model/robot.ts";
import { abbCrb15000 } from "./abb-crb15000.ts";
import { abbIrb120 } from "./abb-irb120.ts";
import { densoVs060 } from "./denso-vs060.ts";
import { epsonC4A601s } from "./epson-c4-a601s.ts";
import { fanucLrmate200id } from "./fanuc-lrmate200id.ts";
import { kawasakiRs007l } from "./kawasaki-rs007l.ts";
import { kukaKr6R900 } from "./kuka-kr6-r900.ts";
import { kukaKr6p2 } from "./kuka-kr6-2.ts";
import { kukaLbrIiwa14 } from "./kuka-lbr-iiwa14.ts";
import { lolaRl15 } from "./lola-rl15.ts";
import { mitsubishiRv7fl } from "./mitsubishi-rv7fl.ts";
import { staubliRx160 } from "./staubli-rx160.ts";
import { staubliRx90l } from "./staubli-rx90l.ts";
import { ur10e } from "./ur10e.ts";
import { yaskawaGp8 } from "./yaskawa-gp8.ts";

/** The robots whose castings are drawn. A new one is one data file and one line here. */
export const LIBRARY: readonly Robot[] = [
  staubliRx90l,
  staubliRx160,
  yaskawaGp8,
  kukaKr6R900,
  kukaKr6p2,
  kukaLbrIiwa14,
  abbIrb120,
  abbCrb15000,
  fanucLrmate200id,
  ur10e,
  kawasakiRs007l,
  mitsubishiRv7fl,
  densoVs060,
  epsonC4A601s,
  lolaRl15,
];

const own = new Map<string, Robot>();

/** The robot of that id in the library or the catalogue, or undefined. */
export const publishedRobot = (id: string): Robot | undefined =>
  LIBRARY.find(robot => robot.id === id) ?? catalogueRobot(id);

/**
 * Makes a robot from a file known to `robotById`, in the place of one of the same id. Whoever adds it has asked
 * `falseIdentity` before: an id of the library stays with that arm.
 */
export const addOwnRobot = (robot: Robot): void => {
  own.set(robot.id, robot);
  for (const hear of listeners) hear(robot);
};

const listeners = new Set<(robot: Robot) => void>();

/** Tells of every robot that is added from now on: threads that work beside share no memory. */
export const onOwnRobot = (hear: (robot: Robot) => void): void => {
  listeners.add(hear);
};

/** The robot of that id: one that was added from a file, else that of the library or the catalogue, or undefined. */
export const robotById = (id: string): Robot | undefined => own.get(id) ?? publishedRobot(id);
/** All robots that were added from files, the newest last. */
export const ownRobots = (): readonly Robot[] => [...own.values()];
/** Whether a robot was added from a file. */
export const isOwnRobot = (robot: Robot): boolean => own.get(robot.id) === robot;
