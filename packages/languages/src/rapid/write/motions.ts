import {
  compose,
  inverse,
  pose,
  type MoveStep,
  type Pose,
  type Robot,
  type SignalLine,
  type Speed,
  type Step,
  type Target,
  type VendorSection,
} from "@twincell/core";
import {
  BlockStepWriter,
  PENDANT_UNITS,
  UnsupportedStep,
  Place,
  called,
  fixed,
  remark,
  type ExpressionWords,
  shownAxes,
  BASIC_SIGNS,
  lineKind,
} from "../../emitter/index.ts";
import { confText, jointsText, mm, objectText, part, targetText, toolText } from "./data.ts";
import { Declarations } from "./declarations.ts";
import { WORDS } from "./words.ts";

const LEAST_ACCELERATION = 0.2;

/** Writes motions of RAPID with their points, tools and work objects. */
export abstract class MotionWriter extends BlockStepWriter {
  readonly warnings = new Set<string>();
  protected readonly robot: Robot;
  private readonly section: VendorSection;
  protected readonly data = new Declarations();
  protected readonly code = this.out;
  protected readonly local = new Set<string>();
  /** Whether postures are known: without one there is no configuration to ask for. */
  protected readonly solves: boolean;
  private points = 0;
  /** The tool of the last move; undefined where another routine or another round may have used another. */
  protected tool: string | undefined;
  protected acceleration = 1;

  constructor(place: Place, section: VendorSection) {
    super(place);
    this.robot = place.robot;
    this.section = section;
    // cfx is defined for a spherical wrist; of another nobody has said what it means.
    this.solves = place.robot.family.kind === "ortho-parallel";
  }

  /** The name of a line is that of the controller's configuration: it is written as it is, or not at all. */
  protected signalName(signal: string, step?: Step): string {
    if (/^[A-Za-z][A-Za-z0-9_]{0,31}$/.test(signal) && !WORDS.has(signal.toLowerCase())) {
      if (this.data.names.of("signal", signal) === signal) return signal;
    }
    if (step === undefined) return "";
    throw new UnsupportedStep(
      step.id,
      `${called(step)} uses the line "${signal}", which is no name of RAPID.`,
      "Lines have the names of the controller's configuration: letters, digits and _, at most 32, a letter first.",
    );
  }

  protected lineOf(signal: string, step: Step): { readonly name: string; readonly kind: SignalLine["kind"] } {
    const name = this.signalName(signal, step);
    return { name, kind: lineKind(this.place.program, signal, step) };
  }

  protected readonly words: ExpressionWords = {
    truth: ["FALSE", "TRUE"],
    number: part,
    variable: name => this.variableName(name),
    line: (signal, step, isDigital) => {
      const { name, kind } = this.lineOf(signal, step);
      const word = kind.endsWith("-in") ? "Input" : "Output";
      return isDigital ? `D${word}(${name})=1` : `A${word}(${name})`;
    },
    not: inner => `NOT ${inner}`,
    signs: BASIC_SIGNS,
    calls: {
      abs: x => `Abs(${x})`,
      sqrt: x => `Sqrt(${x})`,
      sin: x => `Sin(${x})`,
      cos: x => `Cos(${x})`,
      trunc: x => `Trunc(${x})`,
    },
    scale: PENDANT_UNITS,
  };

  protected abstract variableName(variable: string): string;

  private accelerate(step: MoveStep, add: (line: string) => void): void {
    const ratio = step.acceleration?.ratio ?? 1;
    if (ratio < LEAST_ACCELERATION)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} accelerates by ${part(100 * ratio)} %; RAPID goes down to ${100 * LEAST_ACCELERATION} %.`,
        "Let it accelerate more, or move more slowly.",
      );
    if (ratio !== this.acceleration) add(`AccSet ${part(100 * ratio)},100;`);
    this.acceleration = ratio;
  }

  protected move(step: MoveStep, next: Step | undefined, add: (line: string) => void): void {
    const { target, path } = step;
    const tool = target.tool ?? (path === "ptp" && "q" in target ? (this.tool ?? "flange") : "flange");
    this.tool = tool;
    this.accelerate(step, add);
    const posture = this.place.posture(step, path === "ptp" ? target : this.place.asPose(target), this.near);
    const at = `${this.speed(step)},${this.data.zone(this.zone_mm(step, next))},${this.toolName(tool, step.id)}`;
    this.near = posture ?? this.near;
    if (path === "ptp" && !this.solves && "pose" in target && target.branch !== undefined) {
      throw new UnsupportedStep(
        step.id,
        `${called(step)} asks for a posture; what the configuration numbers of the ${this.robot.name} mean is not known here.`,
        "Teach the point as joint angles, or leave the posture to the robot.",
      );
    }
    if (path === "ptp" && "q" in target) return add(`MoveAbsJ ${this.joints(step, target.q)},${at};`);
    const frame = "q" in target ? "world" : target.frame;
    const object = frame === "world" ? "" : `\\WObj:=${this.frame(frame, step.id)}`;
    const goal = this.point(step, this.inFrame(target, frame), posture, "");
    if (step.until !== undefined) return this.search(step, goal, object, tool, add);
    if (path === "ptp") return add(`MoveJ ${goal},${at}${object};`);
    if (path === "lin") return add(`MoveL ${goal},${at}${object};`);
    add(`MoveC ${this.via(step, frame)},${goal},${at}${object};`);
  }

  private via(step: MoveStep, frame: string): string {
    if (step.via === undefined)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} has no point to pass through.`,
        "Teach the point on the arc.",
      );
    return this.point(step, this.inFrame(step.via, frame), this.near, "_via");
  }

  /** A target as it is seen from a work object; both points of an arc count from one. */
  private inFrame(target: Target, frame: string): Pose<"frame", "tcp"> {
    if ("pose" in target && target.frame === frame && frame !== "world") return target.pose;
    return compose(
      inverse(frame === "world" ? pose<"base", "frame">() : this.inBase(this.place.frame(frame))),
      this.place.tip(target),
    );
  }

  private search(step: MoveStep, goal: string, object: string, tool: string, add: (line: string) => void): void {
    const { when } = step.until!;
    if (step.path !== "lin" && step.path !== "circ")
      throw new UnsupportedStep(
        step.id,
        `${called(step)} is a search along a joint move; RAPID searches on straight lines and arcs.`,
        "Make it a straight move.",
      );
    const { name, kind } = this.lineOf(when.signal, step);
    if (!("is" in when) || !kind.startsWith("digital"))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} searches for a level; RAPID searches for a digital line.`,
        "Search for a digital line.",
      );
    this.data.add("found", `VAR robtarget ${this.data.names.of("found", "found")};`);
    const found = this.data.names.of("found", "found");
    const via = step.path === "circ" ? `${this.via(step, "q" in step.target ? "world" : step.target.frame)},` : "";
    add(
      `Search${step.path === "lin" ? "L" : "C"}\\Stop,${name}\\${when.is ? "HighLevel" : "LowLevel"},${found},${via}${goal},${this.speed(step)},${this.toolName(tool, step.id)}${object};`,
    );
  }

  private zone_mm(step: MoveStep, next: Step | undefined): string {
    return step.until === undefined ? mm(this.place.blend_m(step, this.before, next)) : "0";
  }

  private joints(step: MoveStep, q: readonly number[]): string {
    const text = jointsText(shownAxes(this.section, q));
    const name = this.pointName(step, "");
    this.data.add(`point ${name}`, `CONST jointtarget ${name}:=${text};`, step.id);
    return name;
  }

  private point(
    step: MoveStep,
    inFrame: Pose<"frame", "tcp">,
    posture: readonly number[] | undefined,
    ending: string,
  ): string {
    if (!this.solves)
      this.warnings.add(
        "What the configuration numbers mean for this arm is not known here: they are written as 0 and not asked for. Try the first motion slowly.",
      );
    const text = targetText(
      inFrame,
      confText(this.robot, this.section, this.solves ? posture : undefined, this.solves),
    );
    const name = this.pointName(step, ending);
    this.data.add(`point ${name}`, `CONST robtarget ${name}:=${text};`, step.id);
    return name;
  }

  /** What a person called it, or p10, p20 and so on. */
  private pointName({ name }: MoveStep, ending: string): string {
    const stem = name === undefined || remark(name) === "" ? `p${10 * ++this.points}` : remark(name);
    return this.data.names.fresh(stem + ending);
  }

  private toolName(tool: string, step: string): string {
    if (tool === "flange") return "tool0";
    const name = this.data.names.of("tool", tool);
    this.data.add(`tool ${tool}`, `PERS tooldata ${name}:=${toolText(this.place.tool(tool))};`, step);
    return name;
  }

  protected frame(frame: string, step: string): string {
    const name = this.data.names.of("frame", frame);
    if (!Object.hasOwn(this.place.program.pallets, frame))
      this.data.add(
        `frame ${frame}`,
        `PERS wobjdata ${name}:=${objectText(this.inBase(this.place.frame(frame)))};`,
        step,
      );
    return name;
  }

  protected inBase<From extends string>(worldFromOther: Pose<"world", From>): Pose<"base", From> {
    return compose(this.place.baseFromWorld, worldFromOther);
  }

  private speed({ speed, path }: MoveStep): string {
    const full_mps = this.robot.maxTcpSpeed_mps;
    if ("time_s" in speed) return `v1000\\T:=${part(speed.time_s)}`;
    if ("ratio" in speed && path === "ptp")
      this.warnings.add(
        "RAPID holds speeds of the tool: a joint move at a share of the full joint speed gets that share of the tool's full speed.",
      );
    return this.data.speed(fixed(1000 * pace(speed, full_mps), 4));
  }
}

const pace = (speed: Exclude<Speed, { readonly time_s: number }>, full_mps: number): number =>
  "mps" in speed ? speed.mps : speed.ratio * full_mps;
