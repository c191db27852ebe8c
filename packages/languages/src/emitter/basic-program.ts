import {
  compose,
  identity,
  rotate,
  isCondition,
  listsOf,
  type Condition,
  type Predicate,
  type EmittedFile,
  type MoveStep,
  type Pallet,
  type PalletStep,
  type PayloadStep,
  type Pose,
  type Program,
  type Step,
  type Target,
  type Vector3,
} from "@twincell/core";
import { asciiText } from "../parser/index.ts";
import { UnsupportedStep, called } from "./cannot.ts";
import { PENDANT_UNITS, assignText, expressionText, linesLookedAt, type ExpressionWords } from "./expressions.ts";
import type { Names } from "./names.ts";
import { fixed } from "./numbers.ts";
import { patternOf, pitchTerm } from "./pattern.ts";
import type { Place } from "./place.ts";
import { BlockStepWriter } from "./steps.ts";

export type Add = (line: string) => void;
/** How a BASIC says what all of them say. */
export interface BasicWords {
  readonly endIf: string;
  /** The lines around a loop that never ends. */
  readonly forever: readonly [open: string, close: string];
  /** The line that opens a loop with a condition, and the one that closes it. */
  readonly whileTrue: readonly [open: string, close: string];
  /** Most decimals of a length in millimetres. */
  readonly mm: (value_m: number) => string;
}

/**
 * Writes the steps of a program as a BASIC: blocks, loops, patterns and remarks; what instructions look like is the
 * language's own affair.
 */
export abstract class BasicProgram extends BlockStepWriter {
  protected readonly names: Names;
  protected readonly words: BasicWords;
  private readonly said = new Map<string, string>();

  constructor(place: Place, names: Names, words: BasicWords) {
    super(place);
    this.names = names;
    this.words = words;
  }

  abstract write(): EmittedFile;
  protected abstract move(step: MoveStep, next: Step | undefined, add: Add): void;
  protected abstract wait(s: number, add: Add): void;
  protected abstract grip(closed: boolean, add: Add): void;
  protected abstract set(step: Extract<Step, { type: "set" }>, line: string, add: Add): void;
  /** A condition as it is asked for. */
  protected abstract asked(when: Extract<Condition, { readonly is: unknown }>, line: string): string;
  protected abstract waitFor(condition: string, step: Extract<Step, { type: "wait-for" }>, add: Add): void;
  protected abstract payload(step: PayloadStep, add: Add): void;
  protected abstract message(text: string, add: Add): void;
  protected abstract stop(add: Add): void;
  protected abstract call(routine: string, add: Add): void;
  /** The name of a variable of the program. */
  protected abstract variableName(name: string): string;
  /** A fresh variable that counts. */
  protected abstract counter(name: string): string;
  /** The place of a pattern from which steps inside it count. */
  protected abstract palletPlace(
    step: PalletStep,
    pallet: Pallet,
    coordinates: readonly string[],
    turn: Pose["quaternion"],
    add: Add,
  ): void;
  /** The name of a line with the number that the controller knows it by. */
  protected abstract line(signal: string, step: Step): string;

  protected override begin(): void {
    super.begin();
    this.said.clear();
  }

  /** Says a setting where it is not the one that holds. */
  protected say(sort: string, line: string, add: Add): void {
    if (this.said.get(sort) !== line) add(line);
    this.said.set(sort, line);
  }

  protected remark(text: string, step: string): void {
    this.out.add(`'${text}`, step);
  }

  protected step(step: Step, next: Step | undefined): void {
    const add: Add = line => {
      this.out.add(line, step.id);
    };
    switch (step.type) {
      case "move":
        return this.move(step, next, add);
      case "wait":
        return this.wait(step.s, add);
      case "gripper":
        return this.grip(step.closed, add);
      case "set": {
        if (this.place.program.signals[step.signal]?.kind !== "digital-out" || typeof step.to !== "boolean")
          throw new UnsupportedStep(
            step.id,
            `${called(step)} writes ${String(step.to)} to the line ${step.signal}, which is no digital output.`,
            "Choose a digital output.",
          );
        return this.set(step, this.line(step.signal, step), add);
      }
      case "wait-for":
        return this.waitFor(this.condition(step.when, step), step, add);
      case "payload":
        return this.payload(step, add);
      case "message":
        return this.message(asciiText(step.text).replace(/"/g, "'"), add);
      case "stop":
        return this.stop(add);
      case "comment":
        return add(`'- ${asciiText(step.text)}`.trimEnd());
      case "assign":
        return add(assignText(step, " = ", this.computing, this.place.program));
      case "while": {
        const [open, close] = this.words.whileTrue;
        return this.loop(`${open} ${this.condition(step.when, step)}`, close, step);
      }
      case "call":
        this.call(step.routine, add);
        return this.begin();
      case "repeat": {
        if (step.times === "forever") return this.loop(...this.words.forever, step);
        const variable = this.counter("count");
        return this.loop(`For ${variable} = 1 To ${step.times}`, `Next ${variable}`, step);
      }
      case "if":
        return this.choice(step, `If ${this.condition(step.when, step)} Then`, "Else", this.words.endIf);
      case "pallet":
        return this.pallet(step);
    }
  }

  /** Says what must hold before the loops over a pattern. */
  protected beforePattern(_step: PalletStep): void {
    /* most languages say nothing */
  }

  /** Yes is kept as 1 and no as 0. */
  protected readonly computing: ExpressionWords = {
    truth: ["0", "1"],
    number: value => fixed(value, 9),
    variable: name => this.variableName(name),
    truthVariable: name => `${this.variableName(name)} = 1`,
    line: (signal, step) => this.condition({ signal, is: true }, step),
    not: inner => `Not ${inner}`,
    signs: {
      and: " And ",
      or: " Or ",
      "=": " = ",
      "<>": " <> ",
      "<": " < ",
      "<=": " <= ",
      ">": " > ",
      ">=": " >= ",
      "+": " + ",
      "-": " - ",
      "*": " * ",
      "/": " / ",
      mod: " Mod ",
    },
    calls: { abs: x => `Abs(${x})` },
    scale: PENDANT_UNITS,
  };

  private condition(when: Predicate, step: Step): string {
    if (!isCondition(when)) return expressionText(when.expression, this.computing, this.place.program, step);
    if (!("is" in when))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} compares the line ${when.signal} with a number.`,
        "Decide by a digital line.",
      );
    return this.asked(when, this.line(when.signal, step));
  }

  /**
   * A loop over layers, lines and places; the place changes with them. A pallet of the world is counted in the base of
   * the robot, which turns its pitches.
   */
  private pallet(step: PalletStep): void {
    this.beforePattern(step);
    const {
      out,
      place: { baseFromWorld, program },
      words: { endIf, mm },
    } = this;
    const pattern = patternOf(step, program, (v, { frame }) =>
      frame === "world" ? rotate(baseFromWorld.quaternion, v) : v,
    );
    const { pallet, lines, inLine, isShifted } = pattern;
    const [layer, line, along, at] = [
      this.counter("layer"),
      this.counter("line"),
      this.counter("along"),
      this.counter("at"),
    ];
    const loop = (variable: string, last: string, inside: () => void): void => {
      out.block(`For ${variable} = 0 To ${last}`, `Next ${variable}`, step.id, inside);
    };
    const add: Add = text => {
      out.add(text, step.id);
    };
    const odd = isShifted ? inLine - 1 : inLine;
    const visit = (): void => {
      add(`${at} = ${along}`);
      if (pattern.isZigzag && odd > 1)
        out.block(`If ${line} Mod 2 = 1 Then`, endIf, step.id, () => {
          add(`${at} = ${odd - 1} - ${along}`);
        });
      const origin: Pose =
        pallet.frame === "world"
          ? compose(baseFromWorld, pallet.origin as Pose as Pose<"world", "place">)
          : pallet.origin;
      const from = isShifted ? `(${at} + (${line} Mod 2) / 2)` : at;
      const term =
        (i: 0 | 1 | 2) =>
        (by: Vector3, factor: string): string =>
          pitchTerm(by[i], factor, mm, " ");
      const coordinates = ([0, 1, 2] as const).map(
        i =>
          `${mm(origin.position[i])}${term(i)(pattern.along_m, from)}${term(i)(pattern.away_m, line)}${term(i)(pattern.up_m, layer)}`,
      );
      this.palletPlace(step, pallet, coordinates, origin.quaternion, add);
      this.inside(step.steps, step.id);
    };
    loop(layer, `${pallet.layers - 1}`, () => {
      loop(line, `${lines - 1}`, () => {
        loop(along, isShifted ? `${inLine - 1} - ${line} Mod 2` : `${inLine - 1}`, visit);
      });
    });
    this.begin();
  }

  /** The pose of a target in the base, where it counts in the world. */
  protected inBase({ pose, frame }: Extract<Target, { readonly pose: unknown }>): Pose {
    return frame === "world" ? compose(this.place.baseFromWorld, compose(identity<"world", "frame">(), pose)) : pose;
  }
}

/** Tools, frames and lines in the order in which steps first use them. */
export interface InUse {
  readonly tools: ReadonlySet<string>;
  readonly frames: ReadonlySet<string>;
  readonly pallets: ReadonlySet<string>;
  readonly signals: ReadonlyMap<string, Step>;
}

export function inUse({ steps, routines, pallets: known }: Program): InUse {
  const tools = new Set<string>();
  const frames = new Set<string>();
  const pallets = new Set<string>();
  const signals = new Map<string, Step>();
  const frame = (name: string): void => {
    if (name !== "world" && !Object.hasOwn(known, name)) frames.add(name);
  };
  const look = (list: readonly Step[]): void => {
    for (const step of list) {
      for (const signal of step.type === "set" ? [step.signal] : linesLookedAt(step))
        if (!signals.has(signal)) signals.set(signal, step);
      if (step.type === "move") {
        for (const target of step.via === undefined ? [step.target] : [step.via, step.target]) {
          if (target.tool !== undefined && target.tool !== "flange") tools.add(target.tool);
          if ("pose" in target) frame(target.frame);
        }
      }
      if (step.type === "pallet" && Object.hasOwn(known, step.pallet)) {
        pallets.add(step.pallet);
        frame(known[step.pallet]!.frame);
      }
      for (const inner of listsOf(step)) look(inner);
    }
  };
  for (const list of [steps, ...Object.values(routines)]) look(list);
  return { tools, frames, pallets, signals };
}
