import type { Robot } from "@twincell/core";
import { blockDoors, mainScript, type BlockReader } from "../structured/index.ts";
import type { BasicMachine, Stage } from "./machine.ts";
import type { BasicAnswer } from "./reader.ts";

/** A BASIC: how its text is read, and what executes it on a robot whose controller speaks it. */
export interface BasicLanguage {
  readonly name: string;
  readonly speaks: (robot: Robot) => boolean;
  readonly read: (text: string) => BasicAnswer;
  readonly machine: (stage: Stage) => BasicMachine<object>;
}

/** The two doors through which text of a BASIC comes in. */
export const basicDoors = ({ machine, ...language }: BasicLanguage): BlockReader =>
  blockDoors({
    ...language,
    script: (source, robot, worldFromBase) =>
      mainScript(source, (surroundings, signals) =>
        machine({ source, robot, worldFromBase, surroundings, ...(signals === undefined ? {} : { signals }) }),
      ),
  });
