import type { MoveStep, Search, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Expression, Motion, Statement, Trigger, Variable } from "../read/syntax.ts";
import { inlineSetting } from "./bas.ts";
import type { Frame } from "./frame.ts";
import { spelling, type System } from "./system.ts";
import { evaluate, keyOf, numberOf, structureOf, type Structure, type Value } from "./values.ts";
import { ModuleMemory } from "./memory.ts";

export const hasAlternatives = (of: Expression): boolean =>
  of.kind === "binary" && (of.sign === "OR" || hasAlternatives(of.left) || hasAlternatives(of.right));

/** Motions of KRL with what happens on their way. */
export abstract class Motions extends ModuleMemory {
  protected abstract statement(statement: Statement, frame: Frame): void;

  protected motion(motion: Motion, at: TextPlace): void {
    const { system } = this.state;
    const settings = [...(this.spline?.settings ?? []), ...motion.settings];
    if (motion.motion === "SPL" && this.spline === undefined)
      throw new TextError(at, "SPLINE before it", "SPL stands outside a SPLINE block.");
    const before =
      settings.length === 0 ? undefined : { values: new Map(system.values), tool: system.tool, base: system.base };
    for (const [to, value] of settings) this.setting(to, value);
    const via = motion.via === undefined ? undefined : structureOf(motion.via, this);
    const target = this.pointOf(motion, at);
    if (target === undefined) return this.leftOut(before);
    if (this.onPath !== undefined)
      throw new TextError(at, "a routine that does not move", "What a trigger does must not move the robot here.");
    this.knowsWhere(motion, target, at);
    this.fire("start");
    this.settle(true);
    const until = this.search();
    this.lost = until === undefined ? undefined : "The robot may stop anywhere on the way of the search before this.";
    const step = this.state.move(this.stepId(at.line), motion, target, via, at);
    this.pending = {
      line: at.line,
      step: until === undefined ? step : { ...step, until },
      passing: this.passing(motion, step),
    };
    if (this.spline !== undefined) this.spline.any = true;
    if (before !== undefined) this.takeBack(before);
    this.idle = 0;
    this.fire("end");
  }

  /** What WITH set holds for one motion only. */
  private takeBack({
    values,
    tool,
    base,
  }: Pick<System, "tool" | "base"> & { readonly values: Map<string, Value> }): void {
    const { system } = this.state;
    system.values.clear();
    for (const [key, value] of values) system.values.set(key, value);
    system.tool = tool;
    system.base = base;
  }

  /** The target of a motion, or undefined for a point that only the controller has. */
  private pointOf({ target, relative }: Motion, at: TextPlace): Structure | undefined {
    const name = target.kind === "variable" && target.parts.length === 1 ? keyOf(target, this) : undefined;
    if (
      relative ||
      name === undefined ||
      name.startsWith("$") ||
      this.isDeclared(name) ||
      this.read(name, at) !== undefined
    )
      return structureOf(target, this);
    this.remark(
      `point ${name}`,
      at,
      "the data list that holds the point",
      `The motion to ${name} is left out: the point is kept on the controller. Put its data list beside the program. The robot goes on to the next point from where it is.`,
    );
    return undefined;
  }

  private leftOut(before: Parameters<Motions["takeBack"]>[0] | undefined): void {
    if (before !== undefined) this.takeBack(before);
    this.settle(false);
    this.triggers = [];
    this.lost = "The robot was to be at a point that is kept on the controller.";
  }

  /** After a motion whose end is not known nothing counts from where the robot is. */
  private knowsWhere({ relative }: Motion, target: Structure, at: TextPlace): void {
    if (this.lost === undefined) return;
    const isWhole = (["X", "Y", "Z", "A", "B", "C"] as const).every(name => target.fields.has(name));
    const isAxes = (["A1", "A2", "A3", "A4", "A5", "A6"] as const).every(name => target.fields.has(name));
    if (relative || (!isWhole && !isAxes))
      throw new TextError(at, "a whole position", `${this.lost} What counts from there is not carried out.`);
  }

  /** Does what was asked for at the start or at the end of a motion, while the robot goes on. */
  private fire(which: "start" | "end"): void {
    if (this.triggers.length === 0) return;
    const isAtStart = ({ distance, onStart }: Trigger): boolean =>
      distance === undefined ? onStart : numberOf(distance, this) === 0;
    const due = this.triggers.filter(each => which === "end" || isAtStart(each));
    this.triggers = this.triggers.filter(each => !due.includes(each));
    for (const each of due) this.trigger(each);
  }

  private trigger({ path, delay, action, ...at }: Extract<Statement, { kind: "trigger" }>): void {
    const way_mm = path === undefined ? 0 : numberOf(path, this);
    const later_ms = delay === undefined ? 0 : numberOf(delay, this);
    if (way_mm !== 0 || later_ms !== 0)
      this.remark(
        `trigger ${at.line}`,
        at,
        "a trigger at the point itself",
        `The trigger acts at the point itself: ${way_mm} mm along the path and ${later_ms} ms from there are not carried out.`,
      );
    const depth = this.stack.length;
    const { onPath } = this;
    this.onPath = depth;
    this.statement(action, this.stack.at(-1)!);
    while (this.stack.length > depth && !this.stopped) this.instruction(this.stack.at(-1)!);
    this.onPath = onPath;
  }

  /** How the robot would pass the point if a motion follows. */
  private passing({ approximation }: Motion, { path }: MoveStep): Partial<Pick<MoveStep, "blend_m" | "blend_ratio">> {
    const { system } = this.state;
    if (this.spline !== undefined) return path === "spline" ? {} : { blend_m: system.approximation_m };
    if (approximation.length === 0) return {};
    // C_PTP counts in percent of the way, everything else by the distance.
    return path === "ptp" && approximation[0] === "C_PTP" && !approximation.includes("C_DIS")
      ? { blend_ratio: Math.min(1, system.approximationRatio) }
      : { blend_m: system.approximation_m };
  }

  protected endSpline({ approximation }: Extract<Statement, { kind: "end-spline" }>): void {
    const { spline, pending } = this;
    this.spline = undefined;
    if (spline?.any !== true || pending === undefined) return;
    this.pending = {
      ...pending,
      passing: approximation.length === 0 ? {} : { blend_m: this.state.system.approximation_m },
    };
    // What follows a block that ends with a stop does not belong to its curve.
    if (approximation.length === 0) this.settle(false);
  }

  /** One setting of a WITH: a variable, or what a function of the controller makes of it. */
  private setting(to: Variable, value: Expression): void {
    const { system } = this.state;
    const first = value.kind === "call" ? value.args[0] : undefined;
    if (value.kind === "call" && first !== undefined) {
      if (value.name === "STOOL2" || value.name === "SBASE")
        return this.chooseFrame(value.name === "STOOL2" ? "TOOL" : "BASE", first);
      if (inlineSetting(value.name, first, system, this) === "done") return;
    }
    this.assign(to, evaluate(value, this), value.kind === "variable" ? spelling(value) : "");
  }

  private chooseFrame(which: "TOOL" | "BASE", of: Expression): void {
    const value = evaluate(of, this);
    const index = value.kind === "structure" ? value.fields.get(`${which}_NO`) : value;
    if (index?.kind === "number") this.state.system.choose(which, index.value, of);
  }

  /**
   * The search that a motion is while an interrupt is on whose routine brakes. RESUME leaves the routine of the motion,
   * so what follows in it is only done when nothing was met: a HALT there is what "not found" leads to.
   */
  private search(): Search | undefined {
    for (const [number, { on, condition, routine }] of this.interrupts) {
      if (!on) continue;
      const reaction = this.routine(routine)?.instructions ?? [];
      if (!reaction.some(each => each.kind === "statement" && each.statement.kind === "brake")) continue;
      const watched = this.unfolded(condition);
      if (hasAlternatives(watched)) {
        this.remark(
          `interrupt ${number}`,
          condition,
          "one line to watch",
          `Interrupt ${number} stops the robot at one of several inputs: it is not watched.`,
        );
        continue;
      }
      const frame = this.stack.at(-1)!;
      const rest = frame.routine.instructions.slice(frame.at);
      const halts = rest.some(each => each.kind === "statement" && each.statement.kind === "halt");
      if (this.stack.length > 1) frame.at = frame.routine.instructions.length;
      return {
        when: this.lines.condition(
          watched,
          variable => this.meant(keyOf(variable, this)),
          each => numberOf(each, this),
        ),
        missing: halts && this.stack.length > 1 ? "fault" : "continue",
      };
    }
    return undefined;
  }

  protected switchInterrupt({ on, number }: Extract<Statement, { kind: "interrupt-switch" }>): void {
    const which = number === undefined ? undefined : numberOf(number, this);
    for (const [key, interrupt] of this.interrupts) if (which === undefined || key === which) interrupt.on = on;
  }
}
