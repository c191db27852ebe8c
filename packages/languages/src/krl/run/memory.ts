import type { TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Declaration, Expression, Routine, Variable } from "../read/syntax.ts";
import { axesOf, typed, within, type Frame } from "./frame.ts";
import { evaluate, fromFrame, indexed, keyOf, numberOf, whole, type Memory, type Value } from "./values.ts";
import { ExecutedSteps } from "./executed.ts";

/** Where the robot is, was called or will be: where it is sent, since nothing overtakes a motion here. */
const PLACES = /^\$(?:POS|AXIS)_(?:ACT|FOR|BACK|RET|INT|ACT_MES)$/;

/** A line is looked at while what stands before it is not executed yet. Never leaves the machine. */
export class ReadTooEarly extends Error {}

/** Values of a KRL program: of its routines, its data lists and its lines. */
export abstract class ModuleMemory extends ExecutedSteps implements Memory {
  protected abstract enter(routine: Routine, args: readonly (Expression | undefined)[], at: TextPlace): Frame;
  protected abstract instruction(frame: Frame): void;

  /** The data lists: that of the controller first, since the others count on it. */
  protected initialize(): void {
    const modules = [...this.source.modules.values()];
    const own = this.source.main?.module ?? modules[0]?.name;
    for (const module of [
      ...modules.filter(each => each.name.startsWith("$")),
      ...modules.filter(each => !each.name.startsWith("$")),
    ]) {
      this.defining = module.name;
      for (const declaration of module.data)
        this.attempt(module.name === own, () => {
          this.define(declaration, this.globals, this.types, this.homeOf(declaration.name));
        });
      for (const { to, value } of module.elements)
        this.attempt(module.name === own, () => {
          this.assign(to, evaluate(value, this), "");
        });
    }
    this.defining = "";
  }

  /** What is wrong in the data of another file shows when it is asked for. */
  private attempt(isOwn: boolean, act: () => void): void {
    try {
      act();
    } catch (cause) {
      if (isOwn || !(cause instanceof TextError)) throw cause;
    }
  }

  /** The module whose data list a name belongs to, or nothing for what every module knows. */
  private homeOf(name: string): string {
    const owners = this.owners.get(name);
    if (owners === undefined || this.source.modules.size < 2) return "";
    const module = this.stack.at(-1)?.routine.module ?? this.defining;
    if (owners.includes(module)) return `${module} `;
    return this.shared.has(name) || owners.length > 1 ? "" : `${owners[0]!} `;
  }

  /** A routine as the one that is being executed calls it: of its own module first. */
  protected routine(name: string): Routine | undefined {
    const module = this.source.modules.get(this.stack.at(-1)?.routine.module ?? this.source.main?.module ?? "");
    const near = module?.routines.get(name) ?? this.source.shared.get(name);
    if (near !== undefined) return near;
    const others = [...this.source.modules.values()].flatMap(each => each.routines.get(name) ?? []);
    return others.length === 1 ? others[0] : undefined;
  }

  read(key: string, at: TextPlace): Value | undefined {
    const named = this.meant(key);
    if (named !== key) return this.read(named, at);
    if (this.cyclic.size > 0) {
      const cyclic = this.cyclic.get(key);
      if (cyclic !== undefined) return evaluate(cyclic, this);
    }
    const group = this.lines.group(key);
    if (group !== undefined) {
      const bits = group.map(({ wire, address }) => this.read(`$${wire.toUpperCase()}[${address}]`, at));
      return whole(bits.reduce((sum, bit, i) => sum + (bit?.kind === "bool" && bit.value ? 2 ** i : 0), 0));
    }
    const line = this.lines.line(key);
    if (line !== undefined) {
      // Looking at a line stops the advance run: the motion before it ends where it was taught.
      this.settle(false);
      // What was done before is executed first: the statement comes again when it has been.
      if (this.ready.length > 0 && this.onPath === undefined) throw new ReadTooEarly();
      return this.lines.read(line);
    }
    if (key.startsWith("$") && PLACES.test(key)) return this.whereNow(key, at);
    if (key === "PGNO") return this.lines.outsideNumber("PGNO");
    const frame = this.stack.at(-1);
    const name = key.split("[", 1)[0]!;
    if (frame?.own.has(name) === true) return frame.values.get(key);
    return this.globals.get(this.homeOf(name) + key) ?? this.state.system.read(key, at);
  }

  /** The key of what a name stands for: a line that was handed over, or another name of a system variable. */
  protected meant(key: string): string {
    const given = this.stack.at(-1)?.lines;
    const own = given === undefined || given.size === 0 ? key : (given.get(key) ?? key);
    return this.lines.hasNames ? this.lines.alias(own) : own;
  }

  /** A condition with cyclic flags replaced by what they always are. */
  protected unfolded(of: Expression): Expression {
    if (of.kind === "variable") return this.cyclic.get(keyOf(of, this)) ?? of;
    if (of.kind === "unary") return { ...of, of: this.unfolded(of.of) };
    return of.kind === "binary" ? { ...of, left: this.unfolded(of.left), right: this.unfolded(of.right) } : of;
  }

  /** Where the robot is; asking for it stops the advance run. */
  private whereNow(key: string, at: TextPlace): Value {
    this.settle(false);
    if (this.lost !== undefined)
      throw new TextError(at, "a position that is known", `${this.lost} ${key} is not known here.`);
    return key.startsWith("$AXIS")
      ? axesOf(this.state.presentAxes_deg)
      : fromFrame(this.state.here(), { kind: "structure", type: "E6POS", fields: new Map() });
  }

  call(name: string, args: readonly (Expression | undefined)[], at: TextPlace): Value {
    if (name === "VARSTATE") return this.stateOf(args[0], at);
    const routine = this.routine(name);
    if (routine?.isFunction !== true)
      throw new TextError(at, "a function of KRL or of this text", `"${name}" is no function that is understood here.`);
    const depth = this.stack.length;
    const frame = this.enter(routine, args, at);
    const steps = (): number => this.times.size;
    const before = steps();
    while (this.stack.length > depth) this.instruction(this.stack.at(-1)!);
    if (steps() !== before) throw new TextError(at, "a function that computes", `Function ${name} moves the robot.`);
    if (frame.result === undefined)
      throw new TextError(at, "a function with RETURN", `Function ${name} ends without a result.`);
    return frame.result;
  }

  /** VARSTATE("NAME") */
  private stateOf(of: Expression | undefined, at: TextPlace): Value {
    const name = of === undefined ? undefined : evaluate(of, this);
    if (name?.kind !== "text") throw new TextError(at, "a name as a text", "VARSTATE takes the name of a variable.");
    const key = name.value.trim().toUpperCase();
    const isThere = this.read(key, at) !== undefined || this.itemsOf(key).length > 0;
    return { kind: "enum", value: isThere ? "#INITIALIZED" : this.isDeclared(key) ? "#DECLARED" : "#UNDEFINED" };
  }

  protected define(
    { name, type, index, value, ...at }: Declaration,
    values: Map<string, Value>,
    types: Map<string, string>,
    home = "",
  ): void {
    if (type !== "") types.set(home + name, type);
    if (value === undefined) return;
    const key = index.length === 0 ? name : `${name}[${index.map(each => numberOf(each, this)).join(",")}]`;
    if (key.startsWith("$")) this.state.system.write(key, evaluate(value, this), at, "");
    else values.set(home + key, typed(evaluate(value, this), types.get(home + name)));
  }

  protected assign(to: Variable, value: Value, source: string): void {
    const key = keyOf(to, this);
    const [, ...members] = to.parts;
    if (members.length > 0) {
      const before = this.read(key, to);
      return this.store(
        key,
        within(
          before?.kind === "structure" ? before : { kind: "structure", type: undefined, fields: new Map() },
          members.map(({ name, indices }) => indexed(name, indices, this, to)),
          value,
        ),
        to,
        "",
      );
    }
    this.store(key, value, to, source);
  }

  protected store(key: string, value: Value, at: TextPlace, source: string): void {
    if (key.startsWith("$")) return this.state.system.write(key, value, at, source);
    const frame = this.stack.at(-1);
    const name = key.split("[", 1)[0]!;
    if (frame?.own.has(name) === true) {
      frame.values.set(key, typed(value, frame.types.get(name)));
      return;
    }
    const home = this.homeOf(name);
    this.globals.set(home + key, typed(value, this.types.get(home + name)));
    // The system looks these up itself.
    if (/^(?:DEF_|TOOL_DATA|BASE_DATA)/.test(key)) this.state.system.write(key, value, at, source);
  }

  /** The items of an array, each with its place: `[1,2]`. */
  protected itemsOf(name: string): [place: string, value: Value][] {
    const frame = this.stack.at(-1);
    const home = this.homeOf(name) + name;
    const [values, prefix] = frame?.own.has(name) === true ? [frame.values, `${name}[`] : [this.globals, `${home}[`];
    const items: [string, Value][] = [];
    for (const [key, value] of values) if (key.startsWith(prefix)) items.push([key.slice(prefix.length - 1), value]);
    return items;
  }

  takeForInput(variable: Variable): boolean {
    const name = variable.parts[0]!.name;
    const isOne = variable.parts.length === 1 && variable.parts[0]!.indices.length === 0;
    if (!isOne || name.startsWith("$") || this.isDeclared(name) || this.meant(name) !== name) return false;
    if (this.lines.line(name) !== undefined || this.lines.group(name) !== undefined) return true;
    if (this.globals.has(name) || this.state.system.read(name, variable) !== undefined) return false;
    this.lines.takeForInput(name);
    this.remark(
      `input ${name}`,
      variable,
      "the data list that declares it",
      `${name} is declared in no file that is open: it counts as an input, off until it is given by hand.`,
    );
    return true;
  }

  /** Every name of a condition that nothing declares. */
  protected takeAllForInputs(of: Expression): void {
    if (of.kind === "variable") this.takeForInput(of);
    else if (of.kind === "unary" && of.sign === "NOT") this.takeAllForInputs(of.of);
    else if (of.kind === "binary" && (of.right.kind === "bool" || ["AND", "OR", "EXOR"].includes(of.sign))) {
      this.takeAllForInputs(of.left);
      this.takeAllForInputs(of.right);
    }
  }

  protected isDeclared(key: string): boolean {
    const name = key.split("[", 1)[0]!;
    return this.stack.at(-1)?.own.has(name) === true || this.owners.has(name) || this.shared.has(name);
  }
}
