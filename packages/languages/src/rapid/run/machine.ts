import type { Condition, Executed, Pose, Step, TextPlace } from "@twincell/core";
import { TextError, missingProgram, WaitsOutside } from "../../parser/index.ts";
import type { Argument, Do, Expression, Flow, WaitUntil } from "../../parser/structured/index.ts";
import { Arguments } from "./arguments.ts";
import { ANSWERS, GRIPPER, HALTS, OUTSIDE, QUESTIONS, REFUSED, SILENT } from "./instructions.ts";
import { KIND_OF_WAIT } from "./lines.ts";
import { loadOf } from "./records.ts";
import { asTruth } from "./values.ts";
import { Motions } from "./motions.ts";
import { FAULT, LATE_CALL } from "../read/statements.ts";

/** Executes RAPID statement by statement. */
export class Machine extends Motions {
  protected *waitUntil(statement: WaitUntil): Generator<Executed, void> {
    const when = this.condition(statement.when);
    if (when === undefined) {
      if (!asTruth(this.evaluate(statement.when), statement.when))
        throw new TextError(
          statement.when,
          "a condition that comes true",
          "The program waits for a condition that nothing here makes true.",
        );
      yield { line: statement.line };
      return;
    }
    yield this.waitFor(statement, when, statement.timeout === undefined ? undefined : this.numberOf(statement.timeout));
  }

  private waitFor(at: TextPlace, when: Condition, timeout_s: number | undefined): Executed {
    return this.done(at, {
      id: this.stepId(at),
      type: "wait-for",
      when,
      ...(timeout_s === undefined ? {} : { timeout_s }),
    });
  }

  protected *instruction(statement: Do): Generator<Executed, Flow | undefined> {
    const { name } = statement;
    if (name === FAULT || name === LATE_CALL) return yield* this.unread(statement);
    if (Object.hasOwn(WITH_EVENT, name)) return yield* this.withEvent(statement, WITH_EVENT[name]!);
    const args = new Arguments(this.spelt(name), this.present(statement.args), statement, each => this.evaluate(each));
    if (HALTS.has(name)) {
      yield this.done(statement, { id: this.stepId(statement), type: "stop" });
      return "halt";
    }
    const step = this.step(name, args, statement);
    yield step === undefined ? { line: statement.line } : this.done(statement, step);
    return undefined;
  }

  /** A statement that was not understood, or a call whose routine is named by a text. */
  private *unread(statement: Do): Generator<Executed, Flow> {
    const [first, second, ...others] = statement.args;
    if (statement.name === FAULT) {
      const text = (argument: Argument | undefined): string =>
        argument?.value?.kind === "text" ? argument.value.value : "";
      throw new TextError(statement, text(first), text(second));
    }
    const called = first?.value === undefined ? "" : this.evaluate(first.value);
    const routine = typeof called === "string" ? this.routine(called.toLowerCase()) : undefined;
    if (routine === undefined) throw missingProgram(statement, String(called));
    return yield* this.call(routine, second === undefined ? others : [second, ...others], statement);
  }

  /** A motion with something that happens on its way: at its end here, which is said where it is not that. */
  private *withEvent(statement: Do, { motion, event }: WithEvent): Generator<Executed, Flow> {
    const isArc = motion === "movec";
    const free = statement.args.filter(each => each.name === undefined);
    const at = event === "trigg" ? (isArc ? 3 : 2) : -1;
    const last = isArc ? 5 : 4;
    const events = event === "trigg" ? free.slice(at, at + 1) : free.slice(last);
    const rest = statement.args.filter(each => !events.includes(each) && !/^t[2-8]$/.test(each.name ?? ""));
    const triggers = event === "trigg" ? statement.args.filter(each => /^t[2-8]$/.test(each.name ?? "")) : [];
    const move = new Arguments(this.spelt(motion), this.present(rest), statement, each => this.evaluate(each));
    yield this.done(statement, this.move(motion, move, this.stepId(statement)));
    switch (event) {
      case "do":
      case "ao": {
        const [signal, value] = events.map(each => each.value!);
        if (signal?.kind !== "variable" || value === undefined)
          throw new TextError(statement, "a line and its value", `${this.spelt(statement.name)} sets a line.`);
        const number = this.numberOf(value);
        yield this.done(statement, this.write(signal.name, event === "do" ? number !== 0 : number, statement));
        return "next";
      }
      case "sync": {
        const called = events[0]?.value === undefined ? "" : this.evaluate(events[0].value);
        const routine = typeof called === "string" ? this.routine(called.toLowerCase()) : undefined;
        if (routine === undefined) throw missingProgram(statement, String(called));
        return yield* this.call(routine, [], statement);
      }
      case "trigg":
        for (const { value } of [...events, ...triggers]) yield* this.trigger(value, statement);
        return "next";
    }
  }

  /** What TriggIO or TriggEquip said is done on the way. */
  private *trigger(of: Expression | undefined, at: TextPlace): Generator<Executed, void> {
    const known = of?.kind === "variable" ? this.triggers.get(of.name) : undefined;
    if (of?.kind !== "variable" || known === undefined)
      throw new TextError(at, "TriggIO or TriggEquip before it", "What happens on the way is not said before.");
    if (known.distance_mm !== 0)
      this.remark(
        `trigger ${of.name}`,
        at,
        "an event at the end of the motion",
        `${this.spelt(of.name)} acts at the end of the motion here, and not ${known.distance_mm} mm from it.`,
      );
    yield this.done(at, this.write(known.signal, known.to, at));
  }

  private step(name: string, args: Arguments, at: TextPlace): Step | undefined {
    const id = (): string => this.stepId(at);
    switch (name) {
      case "moveabsj":
      case "movej":
      case "movel":
      case "movec": {
        const goal = args.given(name === "movec" ? 1 : 0, "a target");
        if (this.leaveOut(goal)) return undefined;
        const step = this.move(name, args, id());
        this.lost = undefined;
        return step;
      }
      case "searchl":
      case "searchc":
        return this.search(name, args, id());
      case "waittime": {
        const s = args.number(0, "a time");
        if (!(s >= 0)) throw new TextError(at, "a time of 0 s or more", `The time is ${s} s.`);
        return { id: id(), type: "wait", s };
      }
      case "waitdi":
      case "waitdo":
      case "waitai":
      case "waitao":
      case "waituntil":
        return this.wait(name, args, at);
      case "set":
      case "reset":
        return this.write(args.nameOf(0, "a line"), name === "set", at);
      default:
        return this.written(name, args, at);
    }
  }

  /** Lines that are set, and what is set for the motions that follow. */
  private written(name: string, args: Arguments, at: TextPlace): Step | undefined {
    const id = (): string => this.stepId(at);
    switch (name) {
      case "setdo":
        return this.write(args.nameOf(0, "a line"), args.number(1, "a value") !== 0, at);
      case "setao":
        return this.write(args.nameOf(0, "a line"), args.number(1, "a value"), at);
      case "pulsedo": {
        const pulse_s = args.option("plength") ?? 0.2;
        const signal = this.lines.line(args.nameOf(0, "a line"), "digital-out");
        return { id: id(), type: "set", signal, to: true, pulse_s };
      }
      default:
        return this.setting(name, args, at);
    }
  }

  /** What is set for the motions that follow, counted, or told to people. */
  private setting(name: string, args: Arguments, at: TextPlace): Step | undefined {
    const id = (): string => this.stepId(at);
    switch (name) {
      case "gripload":
        return { id: this.stepId(at), type: "payload", ...loadOf(args.value(0, "a load"), this.tool, at) };
      case "tpwrite": {
        const text = args.value(0, "a text");
        if (typeof text !== "string") throw new TextError(at, "a text", "TPWrite writes a text.");
        const number = args.option("num");
        return { id: id(), type: "message", text: number === undefined ? text : `${text}${number}` };
      }
      case "accset":
        this.acceleration = Math.min(1, Math.max(0.2, args.number(0, "a percentage") / 100));
        return undefined;
      case "velset":
        this.override = Math.min(1, Math.max(0.01, args.number(0, "a percentage") / 100));
        this.fastest_mmps = args.number(1, "a speed");
        return undefined;
      default:
        return this.linesAndCounters(name, args, at);
    }
  }

  /** Lines by their groups, counters, and what does not move the robot. */
  private linesAndCounters(name: string, args: Arguments, at: TextPlace): Step | undefined {
    switch (name) {
      case "confj":
        this.asksConfiguration = !args.has("off");
        return undefined;
      case "incr":
      case "decr":
      case "add":
      case "clear":
        return this.counted(name, args);
      case "invertdo": {
        const line = args.nameOf(0, "a line");
        const level = this.lines.read(this.lines.line(line, "digital-out"));
        return this.write(line, level !== true, at);
      }
      case "setgo":
        return this.write(args.nameOf(0, "a line"), args.number(1, "a value"), at);
      case "triggio":
      case "triggequip":
        return this.defineTrigger(args);
      default:
        if (SILENT.has(name)) return undefined;
        if (QUESTIONS.has(name)) return this.asked(args, at);
        if (ANSWERS.has(name)) return this.answered(name, args, at);
        if (OUTSIDE.has(name)) {
          this.remark(
            `${name} ${at.line}`,
            at,
            "a statement about the robot",
            `${this.spelt(name)} is kept and not executed: it does not move the robot.`,
          );
          return undefined;
        }
        // What is no instruction is the name of a procedure.
        throw REFUSED[name] === undefined
          ? missingProgram(at, this.spelt(name))
          : new TextError(at, "an instruction of RAPID", REFUSED[name]);
    }
  }

  private counted(name: string, args: Arguments): undefined {
    const to = args.given(0, "a datum");
    const now = name === "clear" ? 0 : this.numberOf(to);
    this.store(
      to,
      name === "incr" ? now + 1 : name === "decr" ? now - 1 : name === "add" ? now + args.number(1, "a number") : 0,
    );
    return undefined;
  }

  private defineTrigger(args: Arguments): undefined {
    const name = args.nameOf(0, "the name of the event");
    const line = args.optionGiven("dop") ?? args.optionGiven("gop") ?? args.optionGiven("aop");
    if (line?.kind !== "variable") throw new TextError(args.at, "\\DOp:=line", "The event sets no line.");
    const shift = args.count - 2;
    const value = args.number(shift + 1, "a value");
    this.triggers.set(name, {
      signal: line.name,
      to: args.has("dop") ? value !== 0 : value,
      distance_mm: args.has("start") ? Number.NaN : args.number(1, "a distance"),
    });
    return undefined;
  }

  /** The operator is asked: the program goes on with an answer that is given by hand, as an input of that name. */
  private asked(args: Arguments, at: TextPlace): undefined {
    const to = args.given(0, "a datum");
    const name = to.kind === "variable" ? this.spelt(to.name) : "answer";
    const answer = this.lines.given(name);
    if (typeof answer !== "number") throw new WaitsOutside(at, "program", name);
    this.store(to, answer);
    return undefined;
  }

  /** Something outside answers into data: what these are worth is not known, and asking for them is refused. */
  private answered(name: string, args: Arguments, at: TextPlace): undefined {
    for (const expression of args.places()) {
      if (expression.kind !== "variable") continue;
      this.scopes.at(-1)?.names.delete(expression.name);
      this.globals.delete(this.globalKey(expression.name));
      this.foreign.add(expression.name);
    }
    this.remark(
      `${name} ${at.line}`,
      at,
      "a statement about the robot",
      `${this.spelt(name)} is kept and not executed: what another machine answers is not known.`,
    );
    return undefined;
  }

  private wait(name: string, args: Arguments, at: TextPlace): Step {
    const timeout = args.option("maxtime");
    const limit = timeout === undefined ? {} : { timeout_s: timeout };
    const when = name === "waituntil" ? this.condition(args.given(0, "a condition")) : this.waited(name, args);
    if (when !== undefined) return { id: this.stepId(at), type: "wait-for", when, ...limit };
    if (!this.isTrue(args.given(0, "a condition")))
      throw new TextError(
        at,
        "a condition that comes true",
        "The program waits for a condition that nothing here makes true.",
      );
    return { id: this.stepId(at), type: "wait", s: 0 };
  }

  private waited(name: string, args: Arguments): Condition {
    const kind = KIND_OF_WAIT[name]!;
    const signal = this.lines.line(args.nameOf(0, "a line"), kind);
    const value = args.number(1, "a value");
    if (kind.startsWith("digital")) return { signal, is: value !== 0 };
    if (args.has("gt")) return { signal, above: value };
    if (args.has("lt")) return { signal, below: value };
    throw new TextError(args.at, "\\GT or \\LT", "Only a wait for more or for less can be carried out.");
  }

  private write(name: string, to: boolean | number, at: TextPlace): Step {
    if (name === GRIPPER && typeof to === "boolean") return { id: this.stepId(at), type: "gripper", closed: to };
    const signal = this.lines.line(name, typeof to === "boolean" ? "digital-out" : "analogue-out");
    this.lines.write(signal, to);
    return { id: this.stepId(at), type: "set", signal, to };
  }

  placeIn(variable: string): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined {
    return this.objects.placeIn(variable, this.variable(variable), this.globals);
  }

  edge(): void {
    /* every move says everything */
  }

  override remember(): () => void {
    const values = super.remember();
    const arm = this.arm.remember();
    const { acceleration, override, fastest_mmps, asksConfiguration, tool } = this;
    const lines = this.lines.remember();
    return () => {
      values();
      arm();
      this.acceleration = acceleration;
      this.override = override;
      this.fastest_mmps = fastest_mmps;
      this.asksConfiguration = asksConfiguration;
      this.tool = tool;
      lines();
    };
  }
}

interface WithEvent {
  readonly motion: "movej" | "movel" | "movec";
  readonly event: "do" | "ao" | "sync" | "trigg";
}

/** Motions with something that happens on their way. */
const WITH_EVENT: Readonly<Record<string, WithEvent>> = {
  movejdo: { motion: "movej", event: "do" },
  moveldo: { motion: "movel", event: "do" },
  movecdo: { motion: "movec", event: "do" },
  movejao: { motion: "movej", event: "ao" },
  movelao: { motion: "movel", event: "ao" },
  movecao: { motion: "movec", event: "ao" },
  movejsync: { motion: "movej", event: "sync" },
  movelsync: { motion: "movel", event: "sync" },
  movecsync: { motion: "movec", event: "sync" },
  triggj: { motion: "movej", event: "trigg" },
  triggl: { motion: "movel", event: "trigg" },
  triggc: { motion: "movec", event: "trigg" },
};
