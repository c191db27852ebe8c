import type { Robot } from "@twincell/core";
import { blockEntryPoints, mainScript, type BlockReader } from "../structured/index.ts";
import type { BasicMachine, RunContext } from "./machine.ts";
import type { BasicAnswer } from "./reader.ts";

/** A BASIC: how its text is read, and what executes it on a robot whose controller speaks it. */
export interface BasicLanguage {
  readonly name: string;
  readonly speaks: (robot: Robot) => boolean;
  readonly read: (text: string, asText?: boolean) => BasicAnswer;
  readonly machine: (stage: RunContext) => BasicMachine<object>;
}

/** The two doors through which text of a BASIC comes in. */
export const basicEntryPoints = ({ machine, ...language }: BasicLanguage): BlockReader =>
  blockEntryPoints({
    ...language,
    notExecuted: ({ kept }) => kept,
    script: (source, robot, worldFromBase) =>
      mainScript(source, (declared, signals, notices) =>
        machine({
          source,
          robot,
          worldFromBase,
          declared,
          ...(signals === undefined ? {} : { signals }),
          ...(notices === undefined ? {} : { notices }),
        }),
      ),
  });
