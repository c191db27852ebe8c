import type { Executed, Interpreted, Robot, Signals, Step } from "@twincell/core";
import { slowed } from "../../guard/index.ts";
import { withLines } from "../../runner/index.ts";
import { T1_MPS } from "./machine.ts";

type Ready = Extract<Interpreted, { kind: "ready" }>;
/** So many statements without a motion take one cycle: a text that only counts does not stop the clock. */
const LINES_PER_CYCLE = 200;
/** Steps behind the one being executed that are kept to take the program up again. */
const MOST_KEPT = 200;

/**
 * A program text being executed: its steps as the arm takes them, slow enough for the mode, and from where it was
 * stopped. Lines in and out are renamed to the controller's numbers, `$IN[3]`.
 */
export class Job {
  readonly context: Ready["context"];
  private readonly robot: Robot;
  private readonly text: Iterator<Executed, void>;
  private readonly where: () => ArrayLike<number>;
  private kept: Step[] = [];
  private ahead: Step[] = [];
  private count = 0;
  private idle = 0;
  private from: ArrayLike<number> | null = null;
  line = 0;

  /** @param where  the joint angles [rad] at which the robot stands. */
  constructor(interpreted: Ready, robot: Robot, signals: Signals, where: () => ArrayLike<number>) {
    this.context = interpreted.context;
    this.robot = robot;
    this.where = where;
    this.text = interpreted.run({
      read: name => signals.read(this.wire(name)),
      write: (name, value) => {
        signals.write(this.wire(name), value);
      },
    });
  }

  /** The steps up to and with the first motion. */
  *toThePath(slow: boolean): Generator<Step, void> {
    for (let step = this.next(slow); step; step = this.next(slow)) {
      yield step;
      if (step.type === "move") return;
    }
  }
  *rest(slow: boolean): Generator<Step, void> {
    for (let step = this.next(slow); step; step = this.next(slow)) yield step;
  }
  /** After a stop: the step that was under way comes again, and what had been looked ahead to. */
  takeUp(step: string): void {
    const at = this.kept.findIndex(({ id }) => id === step);
    this.ahead = [...(at < 0 ? [] : this.kept.slice(at)), ...this.ahead];
    this.kept = [];
    this.from = null;
  }

  private next(slow: boolean): Step | undefined {
    const step = this.ahead.shift() ?? this.read();
    if (!step) return undefined;
    this.kept.push(step);
    if (this.kept.length > MOST_KEPT) this.kept.shift();
    if (!slow || step.type !== "move") return step;
    const from = this.from ?? this.where();
    this.from = "q" in step.target ? step.target.q : null;
    return slowed(this.robot, step, from, T1_MPS);
  }

  private read(): Step | undefined {
    for (let next = this.text.next(); !next.done; next = this.text.next()) {
      const { line, step } = next.value;
      this.line = line;
      if (step) {
        this.idle = 0;
        return withLines({ ...step, id: `line ${line} #${++this.count}` }, name => this.wire(name));
      }
      if (++this.idle % LINES_PER_CYCLE === 0) return { id: `line ${line} #${++this.count}`, type: "wait", s: 0.004 };
    }
    return undefined;
  }

  private wire(name: string): string {
    const line = this.context.signals?.[name];
    return line?.address === undefined ? name : `${WIRES[line.kind]}[${line.address}]`;
  }
}

const WIRES = { "digital-in": "$IN", "digital-out": "$OUT", "analogue-in": "$ANIN", "analogue-out": "$ANOUT" } as const;
