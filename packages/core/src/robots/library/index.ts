import type { Robot } from "../robot.ts";
import { staubliRx90l } from "./staubli-rx90l.ts";

/** Every robot of the library. A new robot is one data file and one line here. */
export const LIBRARY: readonly Robot[] = [staubliRx90l];

/** The robot of that id, or undefined. */
export const robotById = (id: string): Robot | undefined => LIBRARY.find(robot => robot.id === id);
