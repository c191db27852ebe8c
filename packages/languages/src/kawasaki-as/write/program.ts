import {
  branchOf,
  compose,
  identity,
  inverse,
  rotate,
  type Branch,
  isCondition,
  type Condition,
  type Predicate,
  type EmittedFile,
  type MoveStep,
  type Pose,
  type Robot,
  type Step,
  type Target,
  type VendorSection,
  wristAboveZero,
} from "@twincell/core";
import { asciiText } from "../../parser/index.ts";
import {
  BlockStepWriter,
  PENDANT_UNITS,
  UnsupportedStep,
  Names,
  Place,
  assignText,
  called,
  expressionText,
  patternOf,
  pitchTerm,
  type ExpressionWords,
  type Pattern,
  shownAxes,
} from "../../emitter/index.ts";
import { LINES } from "../robots.ts";
import { jointsText, mm, num, oatText, transText } from "./pose.ts";
import { RESERVED } from "./reserved.ts";
import { usedNames } from "./used.ts";

/** Names longer than this are cut; a name of one call has a dot before it. */
const LONGEST_NAME = 15;

/** The file: one program and those that it calls; says only what changes from one step to the next. */
export class ProgramWriter extends BlockStepWriter {
  private readonly robot: Robot;
  private readonly section: VendorSection;
  private readonly names = new Names({ most: LONGEST_NAME - 1, reserved: RESERVED, first: "p_", foldsCase: true });
  private readonly saysAcceleration: boolean;
  private tool = "";
  private speed = "";
  private accuracy = "";
  private acceleration = "";

  constructor(place: Place, section: VendorSection) {
    super(place);
    this.robot = place.robot;
    this.section = section;
    this.saysAcceleration = usedNames(place.program).accelerates;
  }

  write(): EmittedFile {
    const { program } = this.place;
    const { out } = this;
    const name = this.named("program", program.name);
    this.part(name, program.steps, () => {
      out.add(`;* ${asciiText(program.name)}`.trimEnd());
      out.add(
        `;* ${asciiText(this.robot.name)}. Lengths in mm, angles in degrees, locations in the base of the robot.`,
      );
      this.declarations();
    });
    for (const [routine, steps] of Object.entries(program.routines))
      this.part(this.named("routine", routine), steps, () => {
        /* nothing before the steps */
      });
    return out.file(`${name}.as`, "\r\n");
  }

  private named(sort: string, name: string): string {
    return this.names.of(sort, name.toLowerCase());
  }

  private part(name: string, steps: readonly Step[], before: () => void): void {
    this.out.add(`.PROGRAM ${name}()`);
    this.out.indented(() => {
      before();
      this.begin();
      this.steps(steps);
    });
    this.out.add(".END");
  }

  /**
   * What the controller would keep from before, and tools, frames and lines under the names that they have in the
   * program.
   */
  private declarations(): void {
    const { place, out } = this;
    const { program } = place;
    const used = usedNames(program);
    for (const line of ["BASE NULL", "CP ON", "ACCEL 100 ALWAYS", "DECEL 100 ALWAYS"]) out.add(line);
    for (const tool of used.tools) out.add(`POINT ${this.named("tool", tool)} = ${transText(place.tool(tool))}`);
    for (const frame of used.frames)
      out.add(`POINT ${this.named("frame", frame)} = ${this.inBase(place.frame(frame))}`);
    for (const [signal, step] of used.signals)
      out.add(`${this.named("signal", signal)} = ${this.numberOf(signal, step)}`);
  }

  private inBase<From extends string>(pose: Pose<"world", From>): string {
    return transText(compose(this.place.baseFromWorld, pose));
  }

  protected override begin(): void {
    super.begin();
    this.tool = "";
    this.speed = "";
    this.accuracy = "";
    this.acceleration = "";
  }

  protected remark(text: string, step: string): void {
    this.out.add(`;${text}`, step);
  }

  protected step(step: Step, next: Step | undefined): void {
    const add = (line: string): void => {
      this.out.add(line, step.id);
    };
    switch (step.type) {
      case "move":
        return this.move(step, next, add);
      case "wait":
        return add(`TWAIT ${num(step.s)}`);
      case "gripper":
        return add(step.closed ? "CLOSEI 1" : "OPENI 1");
      case "set":
        return this.set(step, add);
      case "wait-for":
        return add(`SWAIT ${this.waited(step.when, step)}`);
      case "payload":
        return add(`WEIGHT ${this.load(step)}`);
      case "message":
        return add(`PRINT "${asciiText(step.text).replace(/"/g, "'")}"`);
      case "stop":
        return add("HALT");
      case "comment":
        return add(`;- ${asciiText(step.text)}`.trimEnd());
      case "assign":
        return add(assignText(step, " = ", this.words, this.place.program));
      case "while":
        return this.loop(`WHILE ${this.asked(step.when, step)} DO`, "END", step);
      case "call":
        add(`CALL ${this.named("routine", step.routine)}`);
        return this.begin();
      case "repeat":
        return this.repeat(step);
      case "if":
        return this.choice(step, `IF ${this.asked(step.when, step)} THEN`, "ELSE", "END");
      case "pallet":
        return this.pallet(step);
    }
  }

  private load({ id, name, mass_kg, center_m, inertia_kgm2 }: Extract<Step, { type: "payload" }>): string {
    const [ixx = 0, iyy = 0, izz = 0, ...products] = inertia_kgm2 ?? [];
    if (products.some(product => product !== 0))
      throw new UnsupportedStep(
        id,
        `${called({ id, ...(name === undefined ? {} : { name }) })} gives products of inertia; WEIGHT takes three moments.`,
        "Give the load in its main axes.",
      );
    return [num(mass_kg), ...center_m.map(mm), ...(inertia_kgm2 === undefined ? [] : [ixx, iyy, izz].map(num))].join(
      ",",
    );
  }

  private repeat(step: Extract<Step, { type: "repeat" }>): void {
    this.loop(
      step.times === "forever" ? "WHILE TRUE DO" : `FOR .${this.names.fresh("count")} = 1 TO ${step.times}`,
      "END",
      step,
    );
  }

  /** A loop over layers, lines and places; the place is a location that changes with them. */
  private pallet(step: Extract<Step, { type: "pallet" }>): void {
    const { baseFromWorld, program } = this.place;
    // A pallet of the world is counted in the base of the robot, which turns its pitches.
    const pattern = patternOf(step, program, (v, { frame }) =>
      frame === "world" ? rotate(baseFromWorld.quaternion, v) : v,
    );
    const { pallet, lines, inLine, isShifted } = pattern;
    const { out } = this;
    const variable = this.named("frame", step.pallet);
    const local = (name: string): string => `.${this.names.fresh(name)}`;
    const layer = local("layer");
    const line = local("line");
    const along = local("along");
    const at = local("at");
    const loop = (name: string, last: string, inside: () => void): void => {
      out.block(`FOR ${name} = 0 TO ${last}`, "END", step.id, inside);
    };
    const last = isShifted ? `${inLine - 1}-${line} MOD 2` : `${inLine - 1}`;
    const visit = (): void => {
      out.add(`${at} = ${along}`, step.id);
      if (pattern.isZigzag) {
        out.block(`IF ${line} MOD 2 == 1 THEN`, "END", step.id, () => {
          out.add(`${at} = ${isShifted ? inLine - 2 : inLine - 1}-${along}`, step.id);
        });
      }
      out.add(
        `POINT ${variable} = ${this.placeText(pattern, isShifted ? `(${at}+(${line} MOD 2)/2)` : at, line, layer)}`,
        step.id,
      );
      this.begin();
      this.steps(step.steps);
    };
    loop(layer, `${pallet.layers - 1}`, () => {
      loop(line, `${lines - 1}`, () => {
        loop(along, last, visit);
      });
    });
    this.begin();
  }

  private placeText({ pallet, along_m, away_m, up_m }: Pattern, along: string, line: string, layer: string): string {
    const inWorld = pallet.frame === "world";
    const origin: Pose = inWorld
      ? compose(this.place.baseFromWorld, pallet.origin as Pose as Pose<"world", "place">)
      : pallet.origin;
    const place = ([0, 1, 2] as const).map(
      i =>
        `${mm(origin.position[i])}${pitchTerm(along_m[i], along, mm)}${pitchTerm(away_m[i], line, mm)}${pitchTerm(up_m[i], layer, mm)}`,
    );
    return `${inWorld ? "" : `${this.named("frame", pallet.frame)}+`}TRANS(${place.join(",")},${oatText(origin.quaternion)})`;
  }

  private set(step: Extract<Step, { type: "set" }>, add: (line: string) => void): void {
    const { to, signal } = step;
    const name = this.named("signal", signal);
    if (this.place.program.signals[signal]?.kind !== "digital-out" || typeof to !== "boolean")
      throw new UnsupportedStep(
        step.id,
        `${called(step)} writes ${String(to)} to the line ${signal}, which is no digital output.`,
        "Choose a digital output.",
      );
    if (step.pulse_s === undefined) return add(`SIGNAL ${to ? "" : "-"}${name}`);
    add(`PULSE ${to ? "" : "-"}${name},${num(step.pulse_s)}`);
  }

  private readonly words: ExpressionWords = {
    truth: ["0", "-1"],
    number: num,
    variable: name => this.named("variable", name),
    truthVariable: name => `${this.named("variable", name)} <> 0`,
    line: (signal, step, isDigital) =>
      isDigital ? `SIG(${this.named("signal", signal)})` : this.line({ signal, above: 0 }, step),
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
      "+": " + ",
      "-": " - ",
      "*": " * ",
      "/": " / ",
      mod: " MOD ",
      div: (a, b) => `INT(${a} / ${b})`,
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

  /** A condition of IF and WHILE. */
  private asked(when: Predicate, step: Step): string {
    return isCondition(when)
      ? `SIG(${this.line(when, step)})`
      : expressionText(when.expression, this.words, this.place.program, step);
  }

  private waited(when: Predicate, step: Step): string {
    if (isCondition(when)) return this.line(when, step);
    throw new UnsupportedStep(step.id, `${called(step)} waits for an expression.`, "Wait for one line.");
  }

  /** The line of a condition, with a minus where it shall be off. */
  private line(when: Condition, step: Step): string {
    if (!("is" in when))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} compares the line ${when.signal} with a number.`,
        "Decide by a digital line.",
      );
    return `${when.is ? "" : "-"}${this.named("signal", when.signal)}`;
  }

  private numberOf(signal: string, step: Step): number {
    const { signals } = this.place.program;
    const line = Object.hasOwn(signals, signal) ? signals[signal] : undefined;
    if (line?.address === undefined)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the line ${signal}, whose number is not known.`,
        "Give the line its number in the list of signals.",
      );
    const [first, last] = line.kind === "digital-in" ? LINES.inputs : LINES.outputs;
    if (Number.isInteger(line.address) && line.address >= first && line.address <= last) return line.address;
    throw new UnsupportedStep(
      step.id,
      `${called(step)} uses the line ${signal} with the number ${line.address}; AS counts ${line.kind === "digital-in" ? "inputs" : "outputs"} from ${first} to ${last}.`,
      "Give the line a number of the controller.",
    );
  }

  private move(step: MoveStep, next: Step | undefined, add: (line: string) => void): void {
    const { target } = step;
    const tool = target.tool ?? (step.path === "ptp" && "q" in target ? undefined : "flange");
    if (tool !== undefined && tool !== this.tool) {
      add(tool === "flange" ? "TOOL NULL" : `TOOL ${this.named("tool", tool)}`);
      this.tool = tool;
    }
    const configuration = this.place.posture(step, target, this.near);
    const blend = mm(this.place.blend_m(step, this.before, next));
    this.settings(step, blend, add);
    if (step.path === "ptp") {
      if (!("q" in target)) for (const word of this.postureWords(target.branch, configuration)) add(word);
      add(`JMOVE ${this.goal(target)}`);
    } else if (step.path === "lin") add(`LMOVE ${this.goal(target)}`);
    else {
      if (step.via === undefined)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} has no point to pass through.`,
          "Teach the point on the arc.",
        );
      add(`C1MOVE ${this.goal(step.via)}`);
      add(`C2MOVE ${this.goal(target)}`);
    }
    if (blend === "0") add("BREAK");
    this.near = configuration ?? this.near;
  }

  private settings(step: MoveStep, blend: string, add: (line: string) => void): void {
    const { speed, acceleration } = step;
    const say = (line: string, said: string): string => {
      if (line !== said) add(line);
      return line;
    };
    if (this.saysAcceleration) {
      const percent = num((acceleration?.ratio ?? 1) * 100);
      if (percent !== this.acceleration) {
        add(`ACCEL ${percent} ALWAYS`);
        add(`DECEL ${percent} ALWAYS`);
      }
      this.acceleration = percent;
    }
    if (blend !== "0") this.accuracy = say(`ACCURACY ${blend} ALWAYS`, this.accuracy);
    // A duration holds for the one motion.
    if ("time_s" in speed) add(`SPEED ${num(speed.time_s)} S`);
    else
      this.speed = say(`SPEED ${"mps" in speed ? `${mm(speed.mps)} MM/S` : num(speed.ratio * 100)} ALWAYS`, this.speed);
  }

  private goal(target: Target): string {
    if ("q" in target) return jointsText(shownAxes(this.section, target.q));
    if (target.frame === "world")
      return transText(compose(inverse(this.place.worldFromBase), compose(identity<"world", "frame">(), target.pose)));
    return `${this.named("frame", target.frame)}+${transText(target.pose)}`;
  }

  /** A place alone is reached in the posture that the arm is in; one that was taught is asked for by its words. */
  private postureWords(branch: Branch | undefined, configuration: readonly number[] | undefined): readonly string[] {
    const named = branch === undefined || configuration === undefined ? undefined : branchOf(this.robot, configuration);
    if (named === undefined) return [];
    return [
      named.shoulder === "front" ? "RIGHTY" : "LEFTY",
      named.elbow === "up" ? "ABOVE" : "BELOW",
      named.wrist === wristAboveZero(this.place.robot) ? "UWRIST" : "DWRIST",
    ];
  }
}
