import { sectionForLanguage, type Step } from "@twincell/core";
import { TextError, textFault } from "../parser/index.ts";
import { blockEntryPoints, type BlockReader } from "../parser/structured/index.ts";
import { readSource } from "./read/source.ts";
import { Machine } from "./run/machine.ts";
import { assumption } from "./run/setups.ts";

/** A program with more steps than this is taken to repeat itself for ever. */
const MOST_STEPS = 200_000;

/**
 * Executes and reads one listing, or several one behind the other of which the first is started. Pallets are read from
 * shifted points. A program with jumps other than those of loops and decisions is executed with every input off and
 * comes out as what it does.
 */
export const { interpret: interpretFanucLs, parse: parseFanucLs }: BlockReader = blockEntryPoints({
  name: "FANUC TP",
  speaks: robot => sectionForLanguage(robot, "fanuc-ls") !== undefined,
  read: readSource,
  notExecuted: ({ kept }) => kept,
  script: (source, robot, worldFromBase) => ({
    title: source.title,
    machine: (declared, signals, notices) =>
      new Machine(source, robot, worldFromBase, declared, signals, false, notices),
    writer: declared => new Machine(source, robot, worldFromBase, declared, undefined, true),
    run: machine => machine.main(),
    block: machine => machine.open(),
    unrolled: source.hasJumps ? executed : undefined,
    warnings: ({ assumed }) => [
      ...[...assumed].map(([name, at]) => textFault(at, `${name.replace(" ", "[")}=PR[n]`, assumption(name))),
      ...(source.hasJumps
        ? [
            textFault(
              source.main,
              "loops and decisions",
              "The program jumps: it was executed with every input off and written out.",
            ),
          ]
        : []),
    ],
  }),
});

function executed(machine: Machine): Step[] {
  const steps: Step[] = [];
  for (const { step, line } of machine.main()) {
    if (step === undefined) continue;
    if (steps.length >= MOST_STEPS)
      throw new TextError(
        { line, column: 1 },
        "a program that ends",
        `The program has more than ${MOST_STEPS} steps: it repeats itself for ever.`,
      );
    steps.push(step);
  }
  return steps;
}
