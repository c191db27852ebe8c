import {
  compose,
  expressionOf,
  isCondition,
  isPassedOver,
  type Condition,
  type Predicate,
  type EmittedFile,
  type MoveStep,
  type PalletStep,
  type Pose,
  type SetStep,
  type Step,
  type Target,
  type VendorSection,
} from "@twincell/core";
import type { PulseData } from "../pulses.ts";
import type { Controller } from "./controller.ts";
import { fixed } from "./location.ts";
import { commentText, titleText } from "./names.ts";
import { PalletLoop } from "./pallet.ts";
import { Computing } from "./computing.ts";
import { Points, type Arrival } from "./points.ts";
import { BlockWriter, corner_m, goesOn, type WalkedPlace } from "../../emitter/index.ts";
import type { ConfigurationMap } from "./postures.ts";
import { accelerationText, cornerText, speedText } from "./speed.ts";

/** Jobs carry a date; one that does not depend on when they were written. */
const DATE = "2000/01/01 00:00";

const WORDS: Readonly<Record<MoveStep["path"], string>> = { ptp: "MOVJ", lin: "MOVL", circ: "MOVC", spline: "MOVS" };

export interface JobSetting {
  readonly place: WalkedPlace;
  readonly controller: Controller;
  readonly convention: VendorSection;
  readonly pulses: PulseData | undefined;
  readonly postures: ConfigurationMap;
  /** Names of the jobs that routines became. */
  readonly jobs: ReadonlyMap<string, string>;
}

/** One job: positions first, then the instructions. */
export class JobWriter {
  private readonly setting: JobSetting;
  private readonly out = new BlockWriter();
  private readonly points: Points;
  private readonly variables: string[] = [];
  private readonly pallets = new Map<string, PalletLoop>();
  private readonly isMain: boolean;
  private arrival: Arrival | undefined;
  private here: string | undefined;
  private readonly computing: Computing;
  private shift = "";
  private group = "";
  private labels = 0;

  constructor(setting: JobSetting, isMain: boolean) {
    this.setting = setting;
    this.isMain = isMain;
    const { place, controller, convention, pulses } = setting;
    this.points = new Points(place, controller, convention, pulses);
    this.computing = new Computing(
      place.program,
      controller,
      controller.spare,
      () => this.label(),
      (line, step) => {
        this.out.add(line, step);
      },
    );
  }

  write(name: string, title: string, steps: readonly Step[]): EmittedFile {
    this.steps(steps, undefined);
    const file = new BlockWriter();
    const { points, variables, setting } = this;
    for (const variable of variables) points.variable(variable);
    file.add("/JOB");
    file.add(`//NAME ${name}`);
    file.add("//POS");
    file.add(`///NPOS ${points.count},0,0,${variables.length},0,0`);
    file.append(points.out);
    file.add("//INST");
    file.add(`///DATE ${DATE}`);
    if (title !== "") file.add(`///COMM ${titleText(title)}`);
    // Positions in X, Y, Z make a relative job.
    const isRelative = setting.pulses === undefined && points.count > 0;
    file.add(`///ATTR SC,RW${isRelative ? ",RJ" : ""}`);
    if (isRelative) file.add("////FRAME BASE");
    file.add("///GROUP1 RB1");
    file.add("NOP");
    file.append(this.out);
    file.add("END");
    return file.file(`${name}.JBI`);
  }

  private steps(steps: readonly Step[], after: Step | undefined): void {
    for (const [i, step] of steps.entries()) {
      const next = steps.slice(i + 1).find(each => !isPassedOver(each)) ?? after;
      this.step(
        step,
        next,
        steps.slice(0, i).findLast(each => !isPassedOver(each)),
      );
    }
  }

  private step(step: Step, next: Step | undefined, before: Step | undefined): void {
    const add = (...lines: string[]): void => {
      for (const line of lines) this.out.add(line, step.id);
    };
    this.title(step);
    switch (step.type) {
      case "move":
        return this.move(step, next, before);
      case "wait":
        return add(`TIMER T=${fixed(Math.max(0.01, step.s), 2)}`);
      case "gripper":
        return add(`HAND 1 ${step.closed ? "ON" : "OFF"}`);
      case "set":
        return add(this.set(step));
      case "wait-for":
        return add(`WAIT ${this.asked(step.when)}`);
      case "message":
        return add(`MSG "${commentText(step.text.replace(/"/g, "'"))}"`);
      case "stop":
        return add("ABORT");
      case "comment":
        return add(`'* ${commentText(step.text, 29)}`);
      case "call":
        this.shiftOff(step.id);
        add(`CALL JOB:${this.setting.jobs.get(step.routine)!}`);
        this.arrival = undefined;
        return;
      case "repeat":
        return this.repeat(step.id, step.times, step.steps);
      case "if":
        if (!isCondition(step.when)) return this.decision(step, next);
        this.block(
          step.id,
          `IFTHENEXP ${this.asked(step.when)}`,
          step.then,
          next,
          step.else === undefined ? "ENDIF" : "",
        );
        if (step.else !== undefined) this.block(step.id, "ELSE", step.else, next, "ENDIF");
        return;
      case "pallet":
        return this.pallet(step);
      case "assign":
        return this.computing.assign(step);
      case "while":
        return this.whileLoop(step);
      // Refused before.
      case "payload":
        return;
    }
  }

  /** A label, a jump out of it and a jump back. */
  private whileLoop(step: Extract<Step, { type: "while" }>): void {
    const [again, done] = [this.label(), this.label()];
    this.shiftOff(step.id);
    this.out.add(again, step.id);
    this.computing.unless(expressionOf(step.when), done, step);
    this.block(step.id, "", step.steps, undefined, `JUMP ${again}`);
    this.out.add(done, step.id);
  }

  private decision(step: Extract<Step, { type: "if" }>, next: Step | undefined): void {
    const [otherwise, done] = [this.label(), this.label()];
    this.shiftOff(step.id);
    this.computing.unless(expressionOf(step.when), otherwise, step);
    this.block(step.id, "", step.then, next, step.else === undefined ? "" : `JUMP ${done}`);
    this.out.add(otherwise, step.id);
    if (step.else !== undefined) this.block(step.id, "", step.else, next, done);
  }

  private label(): string {
    return `*ROUND${++this.labels}`;
  }

  private repeat(id: string, times: number | "forever", steps: readonly Step[]): void {
    if (times === "forever") {
      const label = this.label();
      return this.block(id, label, steps, undefined, `JUMP ${label}`);
    }
    const counter = this.setting.controller.variable("I");
    this.block(id, `FOR ${counter} START= 1 TO ${times}`, steps, undefined, `NEXT ${counter}`);
  }

  /** A block is entered and left from several sides. */
  private block(id: string, head: string, steps: readonly Step[], after: Step | undefined, end: string): void {
    this.shiftOff(id);
    if (head !== "") this.out.add(head, id);
    this.arrival = undefined;
    this.group = "";
    this.steps(steps, after);
    this.shiftOff(id);
    this.arrival = undefined;
    this.group = "";
    if (end !== "") this.out.add(end, id);
  }

  private pallet(step: PalletStep): void {
    const { controller, place } = this.setting;
    const pallet = place.program.pallets[step.pallet]!;
    this.shiftOff(step.id);
    const loop = new PalletLoop(step, pallet, controller, place.vendorFromWorld, (line, id) => {
      this.out.add(line, id);
    });
    this.variables.push(loop.shift);
    loop.begin();
    this.pallets.set(step.pallet, loop);
    this.arrival = undefined;
    this.steps(step.steps, undefined);
    this.shiftOff(step.id);
    this.arrival = undefined;
    this.pallets.delete(step.pallet);
    loop.end();
  }

  private title(step: Step): void {
    const group =
      step.group === undefined
        ? ""
        : commentText(this.setting.place.program.groups[step.group]?.name ?? step.group, 28);
    if (group !== this.group) this.out.add(`'== ${group}`.trimEnd());
    this.group = group;
    const name = commentText(step.name ?? "");
    if (name !== "") this.out.add(`'${name}`, step.id);
  }

  private set({ signal, to, pulse_s }: SetStep): string {
    const { address } = this.setting.place.program.signals[signal]!;
    if (typeof to === "number") return `AOUT AO#(${address}) ${fixed(to, 2)}`;
    return pulse_s === undefined
      ? `DOUT OT#(${address}) ${to ? "ON" : "OFF"}`
      : `PULSE OT#(${address}) T=${fixed(Math.max(0.01, pulse_s), 2)}`;
  }

  private asked(when: Predicate): string {
    return isCondition(when) ? this.condition(when) : "";
  }

  private condition(when: Condition, opposite = false): string {
    const { kind, address } = this.setting.place.program.signals[when.signal]!;
    return `${kind === "digital-in" ? "IN" : "OT"}#(${address})=${("is" in when && when.is) !== opposite ? "ON" : "OFF"}`;
  }

  // Motion
  // --------------------------------------------------------------------------------------------------------------

  private move(step: MoveStep, next: Step | undefined, before: Step | undefined): void {
    const { place, postures: configurations } = this.setting;
    const add = (line: string): void => {
      this.out.add(line, step.id);
    };
    const { q_rad, via_rad } = configurations.get(step.id)!;
    const { target, frame, loop } = this.taught(step.target);
    const tool = this.toolOf(step);
    this.shiftFor(loop, step.id);
    const speed = speedText(step, place.robot.maxTcpSpeed_mps);
    const acceleration = accelerationText(step);
    const cornerBegin_m =
      step.until === undefined && goesOn(place, next, this.isMain) ? corner_m(place, step, before, next) : 0;
    const corner = cornerText(step.path, cornerBegin_m);
    const isOnCurve = before?.type === "move" && before.path === "spline" && this.arrival !== undefined;
    if (step.path === "circ" || (step.path === "spline" && !isOnCurve)) this.beginCurve(step, frame, tool, speed);
    if (step.path === "circ") {
      const via = this.taught(step.via!);
      add(`MOVC ${this.points.add(step, via.target, frame, tool, via_rad ?? q_rad).name} ${speed}`);
    }
    const { name, arrival } = this.points.add(step, target, frame, tool, q_rad);
    const end = step.path === "circ" ? " FPT" : "";
    add(`${WORDS[step.path]} ${name} ${speed}${corner}${acceleration}${end}${this.until(step)}`);
    if (step.until?.missing === "fault") add(`ABORT IF ${this.condition(step.until.when, true)}`);
    this.arrival = loop === undefined && step.until === undefined ? arrival : undefined;
  }

  /** Joint angles are reached with any tool; the one in force stays. */
  private toolOf({ path, target }: MoveStep): string {
    return target.tool ?? (path === "ptp" ? this.arrival?.written?.tool : undefined) ?? "flange";
  }

  private until({ until }: MoveStep): string {
    return until === undefined ? "" : ` UNTIL ${this.condition(until.when)}`;
  }

  /** Arcs and curves begin with the point that the robot stands at. */
  private beginCurve(step: MoveStep, frame: string, tool: string, speed: string): void {
    const word = WORDS[step.path];
    if (this.arrival !== undefined)
      return this.out.add(`${word} ${this.points.repeat(step, this.arrival, frame, tool)} ${speed} PL=0`, step.id);
    // Reached from several sides: the robot is asked where it stands.
    this.here ??= this.setting.controller.variable("P");
    this.out.add(`GETS PX${this.here.slice(1)} $PX000`, step.id);
    this.out.add(`${word} ${this.here} ${speed} PL=0`, step.id);
  }

  /** A target as it is taught: at the first place, when it is on a pallet. */
  private taught(target: Target): {
    readonly target: Target;
    readonly frame: string;
    readonly loop: PalletLoop | undefined;
  } {
    const { frames, pallets } = this.setting.place.program;
    if ("q" in target) return { target, frame: "world", loop: undefined };
    const loop = this.pallets.get(target.frame);
    if (loop !== undefined) {
      const { frame, origin } = pallets[target.frame]!;
      return {
        target: {
          ...target,
          frame,
          pose: compose(origin as Pose as Pose<"frame", "place">, target.pose as Pose as Pose<"place", "tcp">),
        },
        frame,
        loop,
      };
    }
    return { target, frame: Object.hasOwn(frames, target.frame) ? target.frame : "world", loop: undefined };
  }

  private shiftFor(loop: PalletLoop | undefined, id: string): void {
    const line = loop?.on() ?? "";
    if (line === this.shift) return;
    this.shiftOff(id);
    if (line !== "") this.out.add(line, id);
    this.shift = line;
  }

  private shiftOff(id: string): void {
    if (this.shift !== "") this.out.add("SFTOF", id);
    this.shift = "";
  }
}
