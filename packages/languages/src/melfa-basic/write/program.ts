import {
  branchOf,
  compose,
  type Condition,
  type EmittedFile,
  type MoveStep,
  type Pallet,
  type PalletStep,
  type Pose,
  type Step,
  type Target,
  type VendorSection,
  jointsOfAxes,
  wristAboveZero,
  type Speed,
} from "@twincell/core";
import { asciiText } from "../../parser/index.ts";
import {
  BasicProgram,
  BlockWriter,
  UnsupportedStep,
  Names,
  called,
  fixed,
  inUse,
  mmText,
  turnTexts,
  type Add,
  type InUse,
  type Place,
  shownAxes,
  degreesText,
} from "../../emitter/index.ts";
import { LINES } from "../robots.ts";
import { RESERVED } from "./reserved.ts";

const LONGEST_NAME = 16;
const LONGEST_STEP = 127;
const MOST_STEPS = 32767;
const RIGHT = 4;
const ABOVE = 2;
const NONFLIP = 1;

/** The file: the program with its step numbers, the routines that it calls, and its positions behind them. */
export class MelfaProgram extends BasicProgram {
  private readonly section: VendorSection;
  private readonly used: InUse;
  /** Positions in the order in which they were made: name and value. */
  private readonly positions: (readonly [name: string, value: string])[] = [];
  /** Frames with the posture that is reached from them. */
  private readonly frames = new Map<string, string>();
  private points = 0;
  private joints = 0;
  /** The posture at the places of the pattern that is written. */
  private patternFlag: string | undefined;
  /** Where the hand is, as the text names it, and with which tool. */
  private last: { readonly goal: string; readonly tool: string | undefined } | undefined;
  /** The tool that was said last, where that is known. */
  private tool: string | undefined;

  constructor(place: Place, section: VendorSection) {
    super(place, new Names({ most: LONGEST_NAME, reserved: RESERVED, first: "n_", foldsCase: true }), {
      endIf: "EndIf",
      forever: ["While 1", "WEnd"],
      whileTrue: ["While", "WEnd"],
      mm: mmText,
    });
    this.section = section;
    this.used = inUse(place.program);
  }

  write(): EmittedFile {
    const { program, robot } = this.place;
    const { out } = this;
    out.add(`'* ${asciiText(program.name)}`.trimEnd());
    out.add(`'* ${asciiText(robot.name)}. Lengths in mm, angles in degrees, positions in the base of the robot.`);
    for (const line of ["Base P_NBase", "Ovrd 100", "Accel 100, 100", "Cnt 0"]) out.add(line);
    for (const tool of this.used.tools)
      this.positions.push([this.named("tool", tool, "p"), `${sixText(this.place.tool(tool))}(0,0)`]);
    for (const [signal, step] of this.used.signals)
      out.add(`${this.named("signal", signal, "m")}=${this.address(signal, step)}`);
    this.begin();
    this.steps(program.steps);
    out.add("End");
    for (const [routine, steps] of Object.entries(program.routines)) {
      out.add(`*${this.label(routine)}`);
      this.begin();
      this.steps(steps);
      out.add("Return");
    }
    return this.numbered(out);
  }

  /** Steps have numbers; positions stand behind them without. */
  private numbered(out: BlockWriter): EmittedFile {
    const { text, lines } = out.file("", "\n");
    const steps = text.split("\n").slice(0, -1);
    const name = this.names.fresh(this.place.program.name);
    if (steps.length > MOST_STEPS)
      throw new UnsupportedStep(
        "",
        `The program has ${steps.length} steps; a controller numbers up to ${MOST_STEPS}.`,
        "Divide the program.",
      );
    for (const [i, step] of steps.entries()) {
      if (step.trim().length > LONGEST_STEP)
        throw new UnsupportedStep(
          lines[i] ?? "",
          `Step ${i + 1} of the text has ${step.trim().length} characters; a controller takes ${LONGEST_STEP}.`,
          "Shorten the text or the names.",
        );
    }
    const all = [
      ...steps.map((step, i) => `${i + 1} ${step}`.trimEnd()),
      ...this.positions.map(([position, value]) => `${position}=${value}`),
    ];
    return {
      name: `${name}.prg`,
      text: all.map(line => `${line}\r\n`).join(""),
      lines: [...lines, ...this.positions.map(() => "")],
    };
  }

  /** The first letter of a variable says what it holds; an underscore behind it makes it the controller's. */
  private named(sort: string, name: string, letter: "p" | "m"): string {
    const small = name.toLowerCase();
    return this.names
      .of(sort, small.startsWith(letter) && small[1] !== "_" ? small : `${letter}${small}`)
      .toUpperCase();
  }
  private label(routine: string): string {
    return this.names.of("routine", routine.toLowerCase()).toUpperCase();
  }

  private address(signal: string, step: Step): number {
    const { signals } = this.place.program;
    const address = Object.hasOwn(signals, signal) ? signals[signal]!.address : undefined;
    const [first, last] = LINES;
    if (address === undefined)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the line ${signal}, whose number is not known.`,
        "Give the line its number in the list of signals.",
      );
    if (!Number.isInteger(address) || address < first || address > last)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the line ${signal} with the number ${address}; MELFA-BASIC counts lines from ${first} to ${last}.`,
        "Give the line a number of the controller.",
      );
    return address;
  }

  protected override begin(): void {
    super.begin();
    this.last = undefined;
    this.tool = undefined;
  }

  protected counter(name: string): string {
    return this.names.fresh(`m${name}`).toUpperCase();
  }
  protected wait(s: number, add: Add): void {
    add(`Dly ${fixed(s, 6)}`);
  }
  protected grip(closed: boolean, add: Add): void {
    add(`${closed ? "HClose" : "HOpen"} 1`);
  }
  protected set({ to, pulse_s }: Extract<Step, { type: "set" }>, line: string, add: Add): void {
    add(`M_Out(${line})=${to === true ? 1 : 0}${pulse_s === undefined ? "" : ` Dly ${fixed(pulse_s, 6)}`}`);
  }
  protected asked({ signal, is }: Extract<Condition, { readonly is: unknown }>, line: string): string {
    return `${this.place.program.signals[signal]?.kind === "digital-out" ? "M_Out" : "M_In"}(${line})=${is ? 1 : 0}`;
  }
  protected waitFor(condition: string, _step: Step, add: Add): void {
    add(`Wait ${condition}`);
  }
  protected payload(): void {
    /* declared under cannot */
  }
  protected message(): void {
    /* declared under cannot */
  }
  protected stop(add: Add): void {
    add("Hlt");
  }
  protected call(routine: string, add: Add): void {
    add(`GoSub *${this.label(routine)}`);
  }
  protected variableName(name: string): string {
    return this.named("variable", name, "m");
  }
  protected line(signal: string): string {
    return this.named("signal", signal, "m");
  }

  /** The posture of a pattern is that of the first move inside it. */
  protected palletPlace(
    step: PalletStep,
    pallet: Pallet,
    coordinates: readonly string[],
    turn: Pose["quaternion"],
    add: Add,
  ): void {
    const numbers = coordinates.map((coordinate, i) => {
      const variable = this.counter("xyz"[i]!);
      add(`${variable}=${coordinate}`);
      return variable;
    });
    const first = step.steps.find(({ type }) => type === "move") as MoveStep | undefined;
    this.patternFlag = first === undefined ? "(7,0)" : this.flagOf(this.place.posture(first, first.target, this.near));
    const turned = this.point(`(0,0,0,${turnTexts(turn).join(",")})${this.patternFlag}`);
    const inFrame = `${turned}+SetPos(${numbers.join(",")})`;
    add(
      `${this.named("pallet", step.pallet, "p")}=${pallet.frame === "world" ? inFrame : `${this.frame(pallet.frame, this.patternFlag)}*(${inFrame})`}`,
    );
  }

  private pace(speed: Exclude<Speed, { readonly time_s: number }>, isJoint: boolean, add: Add): void {
    const most_mps = this.place.robot.maxTcpSpeed_mps;
    if (isJoint)
      this.say(
        "speed",
        `JOvrd ${fixed(Math.min(100, ("mps" in speed ? speed.mps / most_mps : speed.ratio) * 100), 5)}`,
        add,
      );
    else this.say("path speed", `Spd ${fixed(("mps" in speed ? speed.mps : speed.ratio * most_mps) * 1000, 4)}`, add);
  }

  protected move(step: MoveStep, next: Step | undefined, add: Add): void {
    const { target, speed, path } = step;
    const isJoint = path === "ptp";
    const tool = toolOf(step);
    if (tool !== undefined)
      this.say("tool", tool === "flange" ? "Tool P_NTool" : `Tool ${this.named("tool", tool, "p")}`, add);
    this.tool = tool ?? this.tool;
    const percent = fixed((step.acceleration?.ratio ?? 1) * 100, 4);
    this.say("acceleration", `Accel ${percent}, ${percent}`, add);
    if ("time_s" in speed) return;
    this.pace(speed, isJoint, add);
    const blend = mmText(this.place.blend_m(step, this.before, next));
    const flag = this.flagOf(this.place.posture(step, target, this.near));
    // The hand stands before another tool is taken: what is said of places counts for the one in use.
    const passes =
      blend !== "0" && !(next?.type === "move" && toolOf(next) !== undefined && toolOf(next) !== this.tool);
    this.say("passing", passes ? `Cnt 1, ${blend}, ${blend}` : "Cnt 0", add);
    const goal = isJoint && "q" in target ? this.angles(target.q) : this.goal(step, target, flag);
    if (path === "circ") {
      if (step.via === undefined)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} has no point to pass through.`,
          "Teach the point on the arc.",
        );
      add(`Mvr ${this.start(add)},${this.goal(step, step.via, flag)},${goal}`);
    } else add(`${isJoint ? "Mov" : "Mvs"} ${goal}`);
    this.last = { goal: isJoint && "q" in target ? `JtoP(${goal})` : goal, tool: this.tool };
    this.near = this.place.posture(step, target, this.near) ?? this.near;
  }

  /** An arc says where it starts: where the last motion went, else where the hand is. */
  private start(add: Add): string {
    const from = this.last !== undefined && this.last.tool === this.tool ? this.last.goal : "P_Curr";
    if (from !== "P_Curr" && !from.startsWith("JtoP")) return from;
    const here = this.names.of("here", "phere").toUpperCase();
    add(`${here}=${from}`);
    return here;
  }

  private goal(step: MoveStep, target: Target, flag: string): string {
    // The place that the text's own angles reach.
    if ("q" in target) return this.point(`${sixText(this.place.tip({ ...target, q: this.written(target.q) }))}${flag}`);
    const { pallets } = this.place.program;
    const { frame } = target;
    if (frame === "world") return this.point(`${sixText(this.inBase(target))}${flag}`);
    const inFrame = this.point(`${sixText(target.pose)}(0,0)`);
    if (!Object.hasOwn(pallets, frame)) return `${this.frame(frame, flag)}*${inFrame}`;
    if (step.path === "ptp" && flag !== this.patternFlag)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} reaches the places of ${frame} in another posture than the first move there.`,
        "Reach the places of a pallet in one posture.",
      );
    return `${this.named("pallet", frame, "p")}*${inFrame}`;
  }

  private point(value: string): string {
    const name = this.names.fresh(`p${++this.points}`).toUpperCase();
    this.positions.push([name, value]);
    return name;
  }

  /** The joint angles that are left of those when they are written down. */
  private written(q_rad: readonly number[]): number[] {
    return jointsOfAxes(this.section, shownAxes(this.section, q_rad).map(degreesText).map(Number), [] as number[]);
  }

  private angles(q_rad: readonly number[]): string {
    const name = this.names.fresh(`j${++this.joints}`).toUpperCase();
    this.positions.push([name, `(${shownAxes(this.section, q_rad).map(degreesText).join(",")})`]);
    return name;
  }

  /** What is counted from a frame has the posture of the frame: one that is reached in two of them is there twice. */
  private frame(name: string, flag: string): string {
    const key = `${name}\0${flag}`;
    const known = this.frames.get(key);
    if (known !== undefined) return known;
    const isFirst = ![...this.frames.keys()].some(other => other.startsWith(`${name}\0`));
    const variable = isFirst
      ? this.named("frame", name, "p")
      : this.names.fresh(this.named("frame", name, "p").toLowerCase()).toUpperCase();
    this.frames.set(key, variable);
    this.positions.push([variable, `${sixText(compose(this.place.baseFromWorld, this.place.frame(name)))}${flag}`]);
    return variable;
  }

  /**
   * (posture, turns): 4 for a wrist in front of joint 1, 2 for a forearm that is folded forwards, 1 for a wrist that is
   * not flipped. Every joint is within half a turn.
   */
  private flagOf(q: readonly number[] | undefined): string {
    const named = q === undefined ? undefined : branchOf(this.place.robot, q);
    if (named === undefined) return `(${RIGHT + ABOVE + NONFLIP},0)`;
    const configuration =
      (named.shoulder === "front" ? RIGHT : 0) +
      ((named.shoulder === "front") === (named.elbow === "up") ? ABOVE : 0) +
      (named.wrist === wristAboveZero(this.place.robot) ? NONFLIP : 0);
    return `(${configuration},0)`;
  }
}

/** Joint angles alone ask for no tool. */
const toolOf = ({ path, target }: MoveStep): string | undefined =>
  target.tool ?? (path === "ptp" && "q" in target ? undefined : "flange");

/** (x, y, z, a, b, c): mm and degrees. */
const sixText = ({ position, quaternion }: Pose): string =>
  `(${[...position.map(mmText), ...turnTexts(quaternion)].join(",")})`;
