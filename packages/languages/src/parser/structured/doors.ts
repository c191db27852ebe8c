import {
  emptyProgram,
  identity,
  type Dialect,
  type Executed,
  type Interpreted,
  type Pose,
  type Robot,
  type Signals,
  type Step,
  type TextFault,
} from "@twincell/core";
import type { CheckedReader, ReadSteps } from "../../reading/checked-import.ts";
import { TextError, textFault } from "../faults.ts";
import { Notices } from "../notices.ts";
import { dryRun } from "../rehearse.ts";
import { createDeclaredCell, type DeclaredCell } from "../declared-cell.ts";
import { RunsOnTheSpot } from "./machine.ts";
import { WaitsOutside } from "../waits-outside.ts";
import { Outline, type OutlineMachine } from "./outline.ts";
import type { Block } from "./tree.ts";

/** A text that was read, for one robot: its title, and how it is executed and written down. */
export interface Script<M> {
  readonly title: string;
  /**
   * A machine before its first statement. It adds the tools, frames and lines that it meets to `declared`. With
   * `notices` it may go on without what only the controller knows, and says so there; without, it refuses.
   */
  readonly machine: (declared: DeclaredCell, signals?: Signals, notices?: Notices) => M;
  /** The one that writes the program down, where that takes another. */
  readonly writer?: (declared: DeclaredCell) => M;
  readonly run: (machine: M) => Generator<Executed, unknown>;
  /** The statements of the program that is started, with `machine` ready to evaluate them. */
  readonly block: (machine: M) => Block;
  /** Steps that loops and calls cannot be kept of; by default they are outlined. May throw a TextError. */
  readonly unrolled?: ((machine: M) => Step[]) | undefined;
  /** What a person should know of what was written down. */
  readonly warnings?: (machine: M) => readonly TextFault[];
}
/** A text whose program stands in it as statements, outside of routines. */
export const mainScript = <M extends { program(block: Block): Generator<Executed, unknown> }>(
  { title, main }: { readonly title: string; readonly main: Block },
  machine: Script<M>["machine"],
): Script<M> => ({ title, machine, run: started => started.program(main), block: () => main });
/** A text whose program is a routine that its machine finds. */
export const routineScript = <M extends { main(): Generator<Executed, unknown>; open(): Block }>(
  title: string,
  machine: Script<M>["machine"],
): Script<M> => ({ title, machine, run: started => started.main(), block: started => started.open() });

/** A language of blocks: who speaks it, and how a text of it is read. */
export interface BlockLanguage<S, M> {
  readonly name: string;
  readonly speaks: (robot: Robot) => boolean;
  /**
   * With `asText` the text is only executed, not kept as steps: statements that do not move the robot may be left out
   * and named.
   */
  readonly read: (text: string, asText?: boolean) => { readonly kind: "source"; readonly source: S } | NotUnderstood;
  readonly script: (source: S, robot: Robot, worldFromBase: Pose<"world", "base">) => Script<M>;
  /**
   * What of the text is kept and shown but not executed. Throws a TextError where that could change how the robot
   * moves.
   */
  readonly notExecuted?: (source: S) => readonly TextFault[];
}
/** Both ways to take a text of a language of blocks: as steps, which are still to be compared with it, and executed. */
export type BlockReader = Pick<Dialect, "interpret"> & Pick<CheckedReader, "parse">;
interface NotUnderstood {
  readonly kind: "not-understood";
  readonly faults: readonly TextFault[];
}

/**
 * The two doors through which text of a language of blocks comes in. Read as a program, loops that do the same each
 * time stay loops, nests of loops over a pattern of places become pallets, decisions by one line and calls stay what
 * they are, and everything else comes out as what it does.
 */
export function blockEntryPoints<S, V, M extends OutlineMachine<V> & { spelt?(name: string): string }>({
  name,
  speaks,
  read,
  script,
  notExecuted,
}: BlockLanguage<S, M>): BlockReader {
  function open(
    text: string,
    robot: Robot,
    worldFromBase: Pose<"world", "base">,
    asText: boolean,
  ): { readonly kind: "open"; readonly script: Script<M>; readonly kept: readonly TextFault[] } | NotUnderstood {
    if (!speaks(robot))
      return refusal(
        textFault(
          { line: 1, column: 1 },
          `a robot whose controller speaks ${name}`,
          `The controller of the ${robot.name} does not speak ${name}.`,
        ),
      );
    const answer = read(text, asText);
    if (answer.kind === "not-understood") return answer;
    try {
      const kept = notExecuted?.(answer.source) ?? [];
      return { kind: "open", script: script(answer.source, robot, worldFromBase), kept };
    } catch (cause) {
      if (!(cause instanceof TextError)) throw cause;
      return refusal(cause.fault);
    }
  }
  function executable(script: Script<M>, kept: readonly TextFault[]): Extract<Interpreted, { kind: "ready" }> {
    const declared = createDeclaredCell();
    const notices = new Notices(kept);
    const run = function* (signals?: Signals): Generator<Executed, void> {
      const asked = new AskedSignals(signals);
      try {
        const machine = script.machine(declared, asked, notices);
        machine.notes = notices.byTopic;
        yield* script.run(machine);
      } catch (cause) {
        // What turns in a circle while inputs are looked at goes on when they change.
        if (cause instanceof RunsOnTheSpot && asked.isAsked) throw new WaitsOutside(cause);
        throw cause;
      }
    };
    return { kind: "ready", run, context: declared, notExecuted: notices.faults };
  }
  return {
    interpret(text, robot, worldFromBase = identity()): Interpreted {
      const opened = open(text, robot, worldFromBase, true);
      if (opened.kind === "not-understood") return opened;
      const ready = executable(opened.script, opened.kept);
      const fault = dryRun({ [Symbol.iterator]: () => ready.run() });
      return fault === undefined ? ready : refusal(fault);
    },
    parse(text, robot, worldFromBase = identity()): ReadSteps {
      const opened = open(text, robot, worldFromBase, false);
      if (opened.kind === "not-understood") return opened;
      const { title, machine: start, writer = start, block, unrolled, warnings } = opened.script;
      const declared = createDeclaredCell();
      try {
        const machine = writer(declared);
        const outline = new Outline(machine, called => machine.spelt?.(called) ?? called);
        const steps = unrolled === undefined ? outline.steps(block(machine)) : unrolled(machine);
        const { groups, routines, pallets } = outline;
        const kept = [...opened.kept, ...machine.notes.values()];
        return {
          kind: "parsed",
          executable: () => executable(opened.script, opened.kept),
          warnings: [...outline.warnings, ...kept, ...(warnings?.(machine) ?? [])],
          program: { ...emptyProgram(robot.id, title), ...declared, groups, pallets, routines, steps },
        };
      } catch (cause) {
        if (!(cause instanceof TextError)) throw cause;
        return refusal(cause.fault);
      }
    },
  };
}

/** Inputs that are all off where nobody says anything, and whether one was asked. */
class AskedSignals implements Signals {
  isAsked = false;
  private readonly outside: Signals | undefined;
  constructor(outside: Signals | undefined) {
    this.outside = outside;
  }
  read(signal: string): boolean | number {
    this.isAsked = true;
    return this.outside?.read(signal) ?? false;
  }
  write(signal: string, value: boolean | number): void {
    this.outside?.write(signal, value);
  }
}

const refusal = (fault: TextFault): NotUnderstood => ({ kind: "not-understood", faults: [fault] });
