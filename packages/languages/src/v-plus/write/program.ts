import {
  branchOf,
  capabilitiesUsed,
  compose,
  everyStep,
  inverse,
  millimetres,
  type Branch,
  isCondition,
  isPassedOver,
  type Predicate,
  type EmittedFile,
  type MoveStep,
  type Program,
  type Speed,
  type Step,
  type Target,
  type VendorSection,
  wristAboveZero,
} from "@twincell/core";
import { asciiText, singleText } from "../../parser/index.ts";
import {
  BlockWriter,
  PENDANT_UNITS,
  UnsupportedStep,
  assignText,
  called,
  expressionText,
  linesLookedAt,
  type ExpressionWords,
  type WalkedPlace,
} from "../../emitter/index.ts";
import { ppointText, transText } from "./location.ts";
import { commentText, vPlusName } from "./names.ts";
import { palletLines, type PalletNames } from "./pallet.ts";
import type { ConfigurationMap } from "./postures.ts";

/** The words of the controller for a branch: shoulder, elbow, wrist, which is not flipped where axis 5 is above 0. */
const words = ({ shoulder, elbow, wrist }: Branch, above: Branch["wrist"]): string[] => [
  shoulder === "front" ? "RIGHTY" : "LEFTY",
  elbow === "up" ? "ABOVE" : "BELOW",
  wrist === above ? "NOFLIP" : "FLIP",
];

/** The runnable program (E-08): says only what changes from one step to the next. */
export class ProgramWriter {
  private readonly program: Program;
  private readonly place: WalkedPlace;
  private readonly convention: VendorSection;
  private readonly q_rad: ConfigurationMap;
  private readonly out = new BlockWriter();
  private readonly names = new Set<string>();
  private readonly toolNames = new Map<string, string>();
  private readonly variableNames = new Map<string, string>();
  private readonly signalNames = new Map<string, string>();
  private readonly palletNames = new Map<string, PalletNames>();
  private readonly routineNames = new Map<string, string>();
  private readonly accelerates: boolean;
  private counters = 0;
  /** What the controller is known to be set to; "" and undefined after a loop, a call or a decision. */
  private tool: string | undefined = "flange";
  private speed = "";
  private branch = "";
  private acceleration = "";
  private group = "";
  private indent = "  ";

  constructor(place: WalkedPlace, convention: VendorSection, q_rad: ConfigurationMap) {
    const { program } = place;
    this.q_rad = q_rad;
    this.program = program;
    this.place = place;
    this.convention = convention;
    this.accelerates = capabilitiesUsed(program).has("acceleration");
  }

  write(): EmittedFile {
    const { program, out, place } = this;
    const name = vPlusName(program.name);
    const programs = new Set([name]);
    for (const routine of Object.keys(program.routines)) {
      const called = vPlusName(routine, programs);
      programs.add(called);
      this.routineNames.set(routine, called);
    }
    out.add(`.PROGRAM ${name}() ;${asciiText(program.name)}`);
    out.add(`  ;* ${asciiText(place.robot.name)}. Lengths in mm, angles in degrees, the world at the shoulder.`);
    for (const tool of this.toolsUsed())
      out.add(`  SET ${this.named(this.toolNames, tool)} = ${transText(place.tool(tool))}`);
    for (const signal of signalsUsed(program))
      out.add(`  ${this.named(this.signalNames, signal)} = ${program.signals[signal]!.address!}`);
    this.list(program.steps);
    out.add(".END");
    for (const [routine, steps] of Object.entries(program.routines)) {
      out.add(`.PROGRAM ${this.routineNames.get(routine)!}() ;${asciiText(routine)}`);
      this.forget();
      this.group = "";
      this.list(steps);
      out.add(".END");
    }
    return out.file(`${name}.v2`);
  }

  private toolsUsed(): Set<string> {
    const names = Array.from(everyStep(this.program)).flatMap(step =>
      step.type === "move" ? [toolName(step) ?? "flange"] : [],
    );
    return new Set(names.filter(name => name !== "flange"));
  }

  /** A variable of the program; variables are shared by all programs of the file. */
  private named(names: Map<string, string>, wanted: string): string {
    const known = names.get(wanted);
    if (known !== undefined) return known;
    const variable = this.variable(wanted);
    names.set(wanted, variable);
    return variable;
  }
  private variable(wanted: string): string {
    const variable = vPlusName(wanted, this.names);
    this.names.add(variable);
    return variable;
  }

  private list(steps: readonly Step[]): void {
    for (const [i, step] of steps.entries())
      this.step(
        step,
        steps.slice(i + 1).find(next => !isPassedOver(next)),
      );
  }

  private step(step: Step, next: Step | undefined): void {
    const add = (line: string): void => {
      this.out.add(`${this.indent}${line}`, step.id);
    };
    const group = step.group === undefined ? "" : commentText(this.program.groups[step.group]?.name ?? step.group);
    if (group !== this.group) add(`;== ${group}`.trimEnd());
    this.group = group;
    const name = commentText(step.name ?? "");
    if (name !== "") add(`;${name}`);
    switch (step.type) {
      case "wait":
        return add(`DELAY ${singleText(step.s)}`);
      case "gripper":
        return add(step.closed ? "CLOSEI" : "OPENI");
      case "move":
        return this.move(step, next, add);
      case "set":
        return add(`SIGNAL ${step.to === true ? "" : "-"}${this.signalNames.get(step.signal)!}`);
      case "wait-for":
        return add(`WAIT ${this.condition(step.when, step)}`);
      case "message":
        return add(`TYPE "${asciiText(step.text).replaceAll('"', "'")}"`);
      case "stop":
        return add("HALT");
      case "comment":
        return add(`;- ${asciiText(step.text).trim()}`.trimEnd());
      default:
        return this.flow(step);
    }
  }

  /** What computes, repeats and decides. */
  private flow(
    step: Exclude<Step, { type: "wait" | "gripper" | "move" | "set" | "wait-for" | "message" | "stop" | "comment" }>,
  ): void {
    const add = (line: string): void => {
      this.out.add(`${this.indent}${line}`, step.id);
    };
    switch (step.type) {
      case "assign":
        return add(assignText(step, " = ", this.words, this.program));
      case "while":
        return this.block([`WHILE ${this.condition(step.when, step)} DO`], step.steps, add);
      case "call":
        add(`CALL ${this.routineNames.get(step.routine)!}()`);
        return this.forget();
      case "repeat":
        return this.block(
          step.times === "forever" ? ["WHILE TRUE DO"] : [`FOR ${this.counter()} = 1 TO ${step.times}`],
          step.steps,
          add,
        );
      case "pallet":
        return this.block(
          palletLines(this.program.pallets[step.pallet]!, this.pallet(step.pallet), this.place),
          step.steps,
          add,
        );
      case "if":
        this.block([`IF ${this.condition(step.when, step)} THEN`], step.then, add, step.else !== undefined);
        if (step.else !== undefined) this.block(["ELSE"], step.else, add);
        return;
      // Neither gets here: the export stops before.
      case "payload":
        return;
    }
  }

  /** Lines that open a block, the steps inside, and an END for each that opened one. */
  private block(lines: readonly string[], steps: readonly Step[], add: (line: string) => void, goesOn = false): void {
    const outer = this.indent;
    let opened = 0;
    for (const line of lines) {
      add(line);
      if (!/^(FOR|WHILE|IF|ELSE)\b/.test(line)) continue;
      opened++;
      this.indent += "  ";
    }
    this.forget();
    this.list(steps);
    this.forget();
    for (; opened > 0; opened--) {
      this.indent = this.indent.slice(2);
      if (!goesOn) add("END");
    }
    this.indent = outer;
  }

  /** What was set on another way to here is not known here. */
  private forget(): void {
    this.tool = undefined;
    this.speed = this.branch = this.acceleration = "";
  }

  private counter(): string {
    return this.variable(`n_${++this.counters}`);
  }

  private pallet(name: string): PalletNames {
    const known = this.palletNames.get(name);
    if (known !== undefined) return known;
    const made: PalletNames = {
      place: this.variable(name),
      first: this.variable(`${name}_0`),
      layer: this.counter(),
      outer: this.counter(),
      inner: this.counter(),
      along: this.counter(),
    };
    this.palletNames.set(name, made);
    return made;
  }

  private readonly words: ExpressionWords = {
    truth: ["FALSE", "TRUE"],
    number: singleText,
    variable: name => this.named(this.variableNames, name),
    truthVariable: name => `${this.named(this.variableNames, name)} <> 0`,
    line: (signal, step, isDigital) => {
      if (isDigital) return `SIG(${this.signalNames.get(signal)!})`;
      throw new UnsupportedStep(step.id, `${called(step)} reads the level of ${signal}.`, "Decide by a digital line.");
    },
    not: inner => `NOT ${inner}`,
    signs: {
      and: " AND ",
      or: " OR ",
      "=": " == ",
      "<>": " <> ",
      "<": " < ",
      "<=": " <= ",
      ">": " > ",
      ">=": " >= ",
      "+": "+",
      "-": "-",
      "*": "*",
      "/": "/",
      mod: " MOD ",
      div: (a, b) => `INT(${a}/${b})`,
    },
    calls: {
      abs: x => `ABS(${x})`,
      sqrt: x => `SQRT(${x})`,
      sin: x => `SIN(${x})`,
      cos: x => `COS(${x})`,
      trunc: x => `INT(${x})`,
    },
    scale: PENDANT_UNITS,
  };

  private condition(when: Predicate, step: Step): string {
    if (!isCondition(when)) return expressionText(when.expression, this.words, this.program, step);
    return `SIG(${"is" in when && when.is ? "" : "-"}${this.signalNames.get(when.signal)!})`;
  }

  private move(step: MoveStep, next: Step | undefined, add: (line: string) => void): void {
    // Joint angles do not mind the tool; what was set on another way to here is set anew all the same.
    const tool = toolName(step) ?? this.tool ?? "flange";
    if (tool !== this.tool) add(tool === "flange" ? "TOOL NULL" : `TOOL ${this.toolNames.get(tool)!}`);
    this.tool = tool;
    const speed = speedLine(step.speed);
    if (speed !== this.speed) add(speed);
    this.speed = speed;
    if ("time_s" in step.speed) add(`DURATION ${singleText(step.speed.time_s)}`);
    if (this.accelerates) {
      const percent = singleText((step.acceleration?.ratio ?? 1) * 100);
      const line = `ACCEL ${percent}, ${percent}`;
      if (line !== this.acceleration) add(line);
      this.acceleration = line;
    }
    this.configure(step, add);
    add(`${step.path === "lin" ? "MOVES" : "MOVE"} ${this.location(step.target)}`);
    if (this.stops(step, next)) add("BREAK");
  }

  /**
   * A controller keeps its posture until it is told another, so every transformation is told the one it is reached in.
   * A precision point says its posture itself.
   */
  private configure({ id, target }: MoveStep, add: (line: string) => void): void {
    const branch = "q" in target ? undefined : branchOf(this.place.robot, this.q_rad.get(id)!);
    const said = branch === undefined ? [] : words(branch, wristAboveZero(this.place.robot));
    if (said.join() !== this.branch) for (const word of said) add(word);
    this.branch = said.join();
  }

  private location(target: Target): string {
    if ("q" in target) return ppointText(target.q, this.convention);
    const pallet = this.palletNames.get(target.frame);
    // Inside its step, a pallet's name is the place.
    if (pallet !== undefined) return `${pallet.place}:${transText(target.pose)}`;
    const { place } = this;
    const baseFromTcp = compose(inverse(place.worldFromBase), place.worldFromTarget(target, target.tool));
    return transText(compose(inverse(place.robot.baseFromVendorWorld), baseFromTcp));
  }

  /** The path goes on without a stop only into another motion with the same tool. */
  private stops(step: MoveStep, next: Step | undefined): boolean {
    return (
      !(step.blend_m > 0 || (step.blend_ratio ?? 0) > 0) ||
      next?.type !== "move" ||
      (toolName(next) ?? this.tool) !== this.tool
    );
  }
}

/** The tool that a step needs: on a straight line the tip, on a joint motion to joint angles any. */
function toolName({ path, target }: MoveStep): string | undefined {
  return target.tool ?? (path === "lin" ? "flange" : undefined);
}

function speedLine(speed: Speed): string {
  if ("ratio" in speed) return `SPEED ${singleText(speed.ratio * 100)} ALWAYS`;
  if ("mps" in speed) return `SPEED ${singleText(millimetres(speed.mps))} MMPS ALWAYS`;
  return "SPEED 100 ALWAYS";
}

/** Signals in the order in which steps name them. */
function signalsUsed(program: Program): Set<string> {
  const names = new Set<string>();
  for (const step of everyStep(program)) {
    if (step.type === "set") names.add(step.signal);
    for (const signal of linesLookedAt(step)) names.add(signal);
  }
  return names;
}
