import { emptyProgram, identity, type Dialect, type Executed, type Interpreted, type Parsed, type Robot, type Signals } from "@twincell/core";
import { TextError, textFault } from "../faults.ts";
import { rehearse } from "../rehearse.ts";
import { Outline } from "../structured/index.ts";
import type { BasicMachine, Stage, Surroundings } from "./machine.ts";
import type { BasicAnswer, BasicSource } from "./reader.ts";

/** A BASIC: how its text is read, and what executes it on a robot whose controller speaks it. */
export interface BasicLanguage {
  readonly name: string;
  readonly speaks: (robot: Robot) => boolean;
  readonly read: (text: string) => BasicAnswer;
  readonly machine: (stage: Stage) => BasicMachine<object>;
}

const surroundings = (): Surroundings => ({ tools: {}, frames: {}, signals: {} });

/** The two doors through which text comes in. */
export function basicDoors({ name, speaks, read, machine }: BasicLanguage): Pick<Dialect, "parse" | "interpret"> {
  const load = (text: string, robot: Robot): BasicAnswer =>
    speaks(robot) ? read(text) : { kind: "not-understood", faults: [textFault({ line: 1, column: 1 }, `a robot whose controller speaks ${name}`, `The controller of the ${robot.name} does not speak ${name}.`)] };
  return {
    interpret: (text, robot, worldFromBase = identity()): Interpreted => {
      const answer = load(text, robot);
      if (answer.kind === "not-understood") return answer;
      const { source } = answer, around = surroundings();
      const run = function* (signals?: Signals): Generator<Executed, void> {
        yield* machine({ source, robot, worldFromBase, surroundings: around, ...(signals === undefined ? {} : { signals }) }).block(source.main);
      };
      const fault = rehearse(run());
      return fault === undefined ? { kind: "ready", run, context: around } : { kind: "not-understood", faults: [fault] };
    },
    parse: (text, robot, worldFromBase = identity()): Parsed => {
      const answer = load(text, robot);
      if (answer.kind === "not-understood") return answer;
      const around = surroundings();
      try {
        const { title, main }: BasicSource = answer.source, outline = new Outline(machine({ source: answer.source, robot, worldFromBase, surroundings: around })), steps = outline.steps(main);
        const { groups, routines, pallets, warnings } = outline;
        return { kind: "parsed", warnings, program: { ...emptyProgram(robot.id, title), ...around, groups, pallets, routines, steps } };
      } catch (cause) {
        if (!(cause instanceof TextError)) throw cause;
        return { kind: "not-understood", faults: [cause.fault] };
      }
    },
  };
}
