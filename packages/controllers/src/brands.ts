import { LIBRARY, catalogueRobots, type Robot } from "@twincell/core";
import { abb, abbOverEgm } from "./abb/index.ts";
import { fanuc } from "./fanuc/index.ts";
import { kuka, kukaOverRsi } from "./kuka/index.ts";
import { drivesRobot, type DriverKind } from "./driver/index.ts";
import { staubli } from "./staubli/index.ts";
import { staubliCs7 } from "./staubli-cs7/index.ts";
import { universalRobots } from "./ur/index.ts";
import { yaskawa } from "./yaskawa/index.ts";

/** Every brand there is a driver and a virtual controller for. */
export const DRIVER_KINDS: readonly DriverKind[] = [
  // One a line.
  universalRobots,
  kuka,
  yaskawa,
  fanuc,
  abb,
  staubli,
  staubliCs7,
];
/** Those, and the other ways to the same controllers. */
export const ALL_DRIVER_KINDS: readonly DriverKind[] = [...DRIVER_KINDS, kukaOverRsi, abbOverEgm];
export const driverKindById = (id: string): DriverKind | undefined => ALL_DRIVER_KINDS.find(kind => kind.id === id);
/** Brands whose robots that one is. */
export const driverKindsFor = (vendor: string): readonly DriverKind[] =>
  DRIVER_KINDS.filter(kind => kind.vendor === vendor);
/** Robots of the library, and of a catalogue that was added, that a driver moves. */
export const robotsOf = (kind: Pick<DriverKind, "id" | "drives">): readonly Robot[] =>
  [...LIBRARY, ...catalogueRobots()].filter(robot => drivesRobot(kind, robot));
