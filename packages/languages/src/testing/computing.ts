import {
  emptyProgram,
  seededRandom,
  type Expression,
  type Predicate,
  type Program,
  type Random,
  type Robot,
  type Step,
  type ValueType,
} from "@twincell/core";

/** Addresses of two inputs and an output that a controller has. */
export interface ComputingLines {
  readonly inputs: readonly [number, number];
  readonly output: number;
}

/** What is left out of the drawn programs because a language has no word for it. */
export interface ComputingWords {
  readonly div?: boolean;
  readonly mod?: boolean;
  /** Whether it computes with numbers that are not whole. */
  readonly numbers?: boolean;
  /** Whether a routine can end the program. */
  readonly stopInRoutine?: boolean;
}

const pick = <T>(random: Random, list: readonly T[]): T => list[Math.floor(random() * list.length)]!;

/**
 * A program that computes: counters, flags and lengths, loops and decisions by them and by lines, waits with limits,
 * routines that are given values. Every loop ends, since its counter is changed by it alone.
 */
export function computingProgram(
  robot: Robot,
  seed: number,
  { inputs, output }: ComputingLines,
  words: ComputingWords = {},
): Program {
  const maker = new Maker(robot, seededRandom(seed), words);
  const steps = maker.list(5, 0);
  return {
    ...emptyProgram(robot.id, `Counts ${seed}`),
    version: 2,
    signals: {
      part: { kind: "digital-in", address: inputs[0] },
      tray: { kind: "digital-in", address: inputs[1] },
      lamp: { kind: "digital-out", address: output },
    },
    variables: maker.variables,
    parameters: { turns: { times: { type: "int" }, quick: { type: "bool" } } },
    routines: { turns: maker.routine() },
    steps,
  };
}

class Maker {
  readonly variables: Record<string, ValueType & { readonly initial?: boolean | number }> = {
    count: { type: "int", initial: 2 },
    total: { type: "int" },
    ready: { type: "bool", initial: true },
    seen: { type: "bool" },
  };
  private readonly robot: Robot;
  private readonly random: Random;
  private readonly words: ComputingWords;
  private made = 0;
  private inRoutine = false;

  constructor(robot: Robot, random: Random, words: ComputingWords) {
    this.robot = robot;
    this.random = random;
    this.words = words;
    if (words.numbers === false) return;
    this.variables.gap = { type: "num", unit: "m", initial: 0.125 };
    this.variables.share = { type: "num" };
  }

  list(length: number, depth: number): readonly Step[] {
    return Array.from({ length }, () => this.step(depth)).flat();
  }

  routine(): readonly Step[] {
    this.inRoutine = true;
    const steps = this.counted("times", 1, { variable: "times" });
    const more = this.list(2, 1);
    this.inRoutine = false;
    return [...steps, ...more];
  }

  private id(): string {
    return `c${++this.made}`;
  }

  private step(depth: number): readonly Step[] {
    const { random } = this;
    switch (Math.floor(random() * (depth < 2 ? 10 : 5))) {
      case 0:
        return [this.move()];
      case 1:
      case 2:
        return [this.assign()];
      case 3:
        return [{ id: this.id(), type: "set", signal: "lamp", to: random() < 0.5 }];
      case 4:
        return [{ id: this.id(), type: "wait", s: 0.25 }];
      case 5:
        return [
          {
            id: this.id(),
            type: "if",
            when: this.predicate(),
            then: this.list(2, depth + 1),
            ...(random() < 0.6 ? { else: this.list(1, depth + 1) } : {}),
          },
        ];
      case 6:
        return this.counted(`n${++this.made}`, depth, 1 + Math.floor(random() * 3));
      case 7:
        return [
          {
            id: this.id(),
            type: "wait-for",
            when: this.predicate(),
            timeout_s: pick(random, [0.04, 0.1]),
            ...(random() < 0.7 || (this.inRoutine && this.words.stopInRoutine === false)
              ? { late: this.list(1, depth + 1) }
              : {}),
          },
        ];
      case 8:
        return this.inRoutine || depth > 0
          ? [this.assign()]
          : [
              {
                id: this.id(),
                type: "call",
                routine: "turns",
                arguments: { times: Math.floor(random() * 3), quick: this.truth(1) },
              },
            ];
      default:
        return [
          {
            id: this.id(),
            type: "while",
            when: { expression: { op: "and", of: [{ op: "<", of: [{ variable: "total" }, 3] }, this.truth(1)] } },
            steps: [
              { id: this.id(), type: "wait", s: 0.5 },
              { id: this.id(), type: "assign", variable: "total", to: { op: "+", of: [{ variable: "total" }, 1] } },
            ],
          },
        ];
    }
  }

  /** A loop with a counter of its own. */
  private counted(name: string, depth: number, times: Expression): readonly Step[] {
    const counter = `k_${name}`;
    this.variables[counter] = { type: "int" };
    return [
      { id: this.id(), type: "assign", variable: counter, to: 0 },
      {
        id: this.id(),
        type: "while",
        when: { expression: { op: "<", of: [{ variable: counter }, times] } },
        steps: [
          ...this.list(1, depth + 1),
          { id: this.id(), type: "assign", variable: counter, to: { op: "+", of: [{ variable: counter }, 1] } },
        ],
      },
    ];
  }

  private move(): Step {
    const q = this.robot.home_rad.map((angle, i) => {
      const { lower_rad, upper_rad } = this.robot.arm.joints[i]!.limits;
      const wanted = angle + (this.random() - 0.5) * 0.4;
      return Math.min(upper_rad - 0.05, Math.max(lower_rad + 0.05, wanted));
    });
    return { id: this.id(), type: "move", path: "ptp", target: { q }, speed: { ratio: 0.5 }, blend_m: 0 };
  }

  private assign(): Step {
    const variable = pick(this.random, [
      "count",
      "ready",
      "seen",
      ...(this.words.numbers === false ? [] : ["gap", "share"]),
    ]);
    const type = this.variables[variable]!;
    const to =
      type.type === "bool" ? this.truth(0) : type.type === "int" ? this.whole(0) : this.number(variable === "gap", 0);
    return { id: this.id(), type: "assign", variable, to };
  }

  private predicate(): Predicate {
    return this.random() < 0.3 ? { signal: "part", is: this.random() < 0.5 } : { expression: this.truth(0) };
  }

  private truth(depth: number): Expression {
    const { random } = this;
    const deeper = (): Expression => this.truth(depth + 1);
    switch (Math.floor(random() * (depth < 2 ? 7 : 3))) {
      case 0:
        return { signal: pick(random, ["part", "tray"]) };
      case 1:
        return { variable: pick(random, ["ready", "seen"]) };
      case 2:
        return {
          op: pick(random, ["<", "<=", ">", ">=", "=", "<>"] as const),
          of: [this.whole(2), this.whole(2)],
        };
      case 3:
        return { op: "not", of: [deeper()] };
      case 4:
        if (this.words.numbers === false) return true;
        return {
          op: pick(random, ["<", ">"] as const),
          of: [this.number(true, 1), { value: pick(random, [0.1, 0.2, 0.3]), unit: "m" }],
        };
      default:
        return { op: pick(random, ["and", "or"] as const), of: [deeper(), deeper()] };
    }
  }

  private whole(depth: number): Expression {
    const { random, words } = this;
    const deeper = (): Expression => this.whole(depth + 1);
    switch (Math.floor(random() * (depth < 2 ? 6 : 2))) {
      case 0:
        return Math.floor(random() * 9) - 3;
      case 1:
        return { variable: this.inRoutine ? "times" : pick(random, ["count", "total"]) };
      case 2:
        return words.mod === false ? 5 : { op: "mod", of: [deeper(), 5] };
      case 3:
        return words.div === false ? 4 : { op: "div", of: [deeper(), 3] };
      default:
        return { op: pick(random, ["+", "-"] as const), of: [deeper(), deeper()] };
    }
  }

  /** Lengths are eighths of a metre, so that single precision holds them exactly. */
  private number(isLength: boolean, depth: number): Expression {
    const { random } = this;
    if (random() < 0.4 || depth > 1)
      return isLength
        ? random() < 0.5
          ? { variable: "gap" }
          : { value: pick(random, [0.125, 0.25, 0.5]), unit: "m" }
        : random() < 0.5
          ? { variable: "share" }
          : pick(random, [0.5, 1.5, 0.25]);
    return {
      op: pick(random, ["+", "-"] as const),
      of: [this.number(isLength, depth + 1), isLength ? { value: 0.125, unit: "m" } : 0.5],
    };
  }
}
