import {
  compose,
  flangePose,
  inverse,
  toVplusYpr,
  type Interpreted,
  type Pose,
  type Robot,
  type Step,
  type AxisCounting,
  axesOfJoints,
} from "@twincell/core";
import type { VirtualController } from "../../virtual/index.ts";
import { readPoint, STATE, stateName, valuesText, whereText, JOINTS } from "../codec/monitor.ts";
import type { Machine } from "./machine.ts";
import type { Programs } from "./programs.ts";

/**
 * What the monitor says to a command: text, then the prompt; `blocks`: the prompt comes when the motion has ended;
 * `asks`: an answer is waited for.
 */
export interface Said {
  readonly text: string;
  readonly blocks?: boolean;
  readonly asks?: (answer: string) => Said;
}
const said = (text: string | null): Said => ({ text: text === null ? "" : `${text}\r\n` });
/** A single statement comes to less. */
const MOST_STEPS = 100;
const COMMANDS = [
  "ABORT",
  "CALIBRATE",
  "DIRECTORY",
  "DISABLE",
  "DO",
  "ENABLE",
  "EXECUTE",
  "HERE",
  "IO",
  "LISTL",
  "LISTR",
  "LOAD",
  "PANIC",
  "PROCEED",
  "SIGNAL",
  "SPEED",
  "STATUS",
  "WHERE",
] as const;
const NAME = "[A-Za-z][A-Za-z0-9._]*";
const REAL = new RegExp(`^(${NAME})\\s*=\\s*(-?[0-9]*\\.?[0-9]+)$`);
const POINT = new RegExp(`^SET\\s+(#${NAME})\\s*=\\s*(#PPOINT\\s*\\(.*\\))$`, "i");
const MOVE = new RegExp(`^(MOVES?)\\s+(#${NAME}|#PPOINT\\s*\\(.*\\))$`, "i");

export interface MonitorOptions {
  readonly robot: Robot;
  readonly arm: VirtualController;
  readonly machine: Machine;
  readonly programs: Programs;
  readonly joints: AxisCounting;
  readonly interpret: (text: string) => Interpreted;
  /** The joints that are told; they may stand still by a fault. */
  readonly now_rad: Float64Array;
  readonly digits: number;
}

/** An error in the monitor's own form: no dot, which would be taken for its prompt. */
const wordsOf = (sentence: string): string =>
  /no value/.test(sentence) ? "*Undefined value*" : `*${sentence.replaceAll(/[.*]/g, "")}*`;

/** The commands of the monitor, one line at a time. */
export function createMonitor({
  robot,
  arm,
  machine,
  programs,
  joints,
  interpret,
  now_rad,
  digits,
}: MonitorOptions): (line: string) => Said {
  return monitorOf(new Monitor({ robot, arm, machine, programs, joints, interpret, now_rad, digits }));
}

class Monitor {
  readonly robot: Robot;
  readonly arm: VirtualController;
  readonly machine: Machine;
  readonly programs: Programs;
  readonly joints: AxisCounting;
  readonly interpret: (text: string) => Interpreted;
  readonly now_rad: Float64Array;
  readonly digits: number;
  readonly shown = new Float64Array(JOINTS);

  constructor({ robot, arm, machine, programs, joints, interpret, now_rad, digits }: MonitorOptions) {
    this.robot = robot;
    this.arm = arm;
    this.machine = machine;
    this.programs = programs;
    this.joints = joints;
    this.interpret = interpret;
    this.now_rad = now_rad;
    this.digits = digits;
  }

  place(): number[] {
    const { position, quaternion } = compose(
      inverse(this.robot.baseFromVendorWorld as Pose),
      flangePose(this.robot.arm, this.now_rad) as Pose,
    );
    return [...position.map(value => 1000 * value), ...toVplusYpr(quaternion)];
  }

  here(): string {
    return `TRANS(${this.place()
      .map(value => value.toFixed(3))
      .join(",")})`;
  }

  value(expression: string): number | null {
    const state = /^STATE\s*\(\s*([12])\s*\)$/i.exec(expression);
    if (state) return state[1] === "1" ? this.machine.state : this.arm.isMoving() ? 1 : 2;
    if (/^SWITCH\s*\(\s*POWER\s*\)$/i.test(expression)) return this.machine.isPowered ? -1 : 0;
    return this.programs.reals.get(expression.toUpperCase()) ?? null;
  }

  listReals(rest: string): Said {
    const names = rest
      .split(/,(?![^()]*\))/)
      .map(name => name.trim())
      .filter(name => name !== "");
    const found = names.map(name => [name, this.value(name)] as const);
    return found.some(([, each]) => each === null)
      ? said("*Undefined value*")
      : { text: valuesText(found as readonly (readonly [string, number])[]) };
  }

  motion(joints_deg: readonly number[], isLine: boolean): Said {
    if (this.machine.hindrance) return said(this.machine.hindrance);
    if (this.programs.isRunning || this.arm.isMoving()) return said("*Program task already active*");
    this.programs.carryOut(
      [this.programs.step(joints_deg, isLine, isLine ? { mps: this.robot.maxTcpSpeed_mps } : { ratio: 1 }, 1)],
      { tools: {}, frames: {} },
      () => {
        /* The prompt says it. */
      },
      false,
    );
    return { text: "", blocks: true };
  }

  execute(statement: string): Said {
    const real = REAL.exec(statement);
    const point = POINT.exec(statement);
    const move = MOVE.exec(statement);
    if (real) return said(this.programs.setReal(real[1]!, Number(real[2])));
    if (point) {
      const values = readPoint(point[2]!);
      return values ? said(this.programs.setPoint(point[1]!, values)) : this.interpreted(statement);
    }
    if (move) {
      const values = readPoint(move[2]!) ?? this.programs.points.get(move[2]!.toUpperCase());
      return values ? this.motion(values, move[1]!.toUpperCase() === "MOVES") : said("*Undefined value*");
    }
    if (/^BRAKE$/i.test(statement)) {
      this.arm.stop();
      return said(null);
    }
    return this.interpreted(statement);
  }

  /** Everything else goes to the interpreter of the language, after what was defined before it. */
  interpreted(statement: string): Said {
    const own = statement.replace(/\bHERE\b/gi, this.here());
    const lines = [
      ...this.programs.definitions,
      `MOVE #PPOINT(${Array.from(axesOfJoints(this.joints, this.now_rad, this.shown)).join(",")})`,
      own,
    ];
    const read = this.interpret(lines.map(line => `DO ${line}`).join("\n"));
    if (read.kind === "not-understood") return said(wordsOf(read.faults[0]?.sentence ?? "Illegal monitor command"));
    const steps: Step[] = [];
    const run = read.run(this.arm.signals);
    for (let next = run.next(); !next.done && steps.length < MOST_STEPS; next = run.next())
      if (next.value.line === lines.length && next.value.step) steps.push(next.value.step);
    if (steps.length === 0)
      return said(/^(SET\b|[A-Z][\w.]*\s*=)|\bALWAYS$|^(TOOL|BASE)\b/i.test(own) ? this.programs.define(own) : null);
    if (this.machine.hindrance && steps.some(({ type }) => type === "move")) return said(this.machine.hindrance);
    if (this.programs.isRunning || this.arm.isMoving()) return said("*Program task already active*");
    this.programs.carryOut(
      steps,
      read.context,
      () => {
        /* The prompt says it. */
      },
      false,
    );
    return { text: "", blocks: true };
  }

  /** What a command of the monitor is answered; null where it is none. */
  command(command: string, rest: string): Said | null {
    return this.listed(command, rest) ?? this.ofPower(command, rest) ?? this.ofProgram(command, rest);
  }
  private listedPoints(): string {
    const rows = [...this.programs.points].map(
      ([name, values]) => ` ${name.toLowerCase()} ${values.map(each => each.toFixed(3)).join("   ")}\r\n`,
    );
    return `   X/J1      Y/J2      Z/J3      y/J4      p/J5      r/J6\r\n${rows.join("")}`;
  }
  private listedLines(): string {
    const bit = (line: string): number => (this.arm.signals.read(line) === true ? 1 : 0);
    return Array.from({ length: 8 }, (_, i) => {
      const [output, input] = [`out_${i + 1}`, `in_${1001 + i}`];
      return `${output} ${bit(output)}   ${input} ${bit(input)}\r\n`;
    }).join("");
  }
  private listed(command: string, rest: string): Said | null {
    switch (command) {
      case "WHERE":
        return { text: whereText(this.place(), axesOfJoints(this.joints, this.now_rad, this.shown), this.digits) };
      case "LISTR":
        return this.listReals(rest);
      case "LISTL":
        return { text: this.listedPoints() };
      case "DIRECTORY":
        return {
          text:
            this.programs.names
              .map(name => `.PROGRAM ${name}`)
              .join("\r\n")
              .replace(/^/gm, " ") + "\r\n",
        };
      case "STATUS":
        return {
          text:
            `Robot ${stateName(this.machine.state)}, speed ${this.machine.speed}, ` +
            `task 1 ${this.programs.isRunning ? "executing" : "idle"}\r\n`,
        };
      case "IO":
        return { text: this.listedLines() };
      default:
        return null;
    }
  }
  private ofPower(command: string, rest: string): Said | null {
    switch (command) {
      case "SPEED":
        return said(this.machine.setSpeed(Number(rest.split(/\s/)[0])) ? null : "*Illegal value*");
      case "ENABLE":
      case "DISABLE": {
        if (!"POWER".startsWith(rest.toUpperCase().slice(0, 5)) || rest === "")
          return said("*Illegal monitor command*");
        if (command === "DISABLE") {
          this.machine.off();
          return said(null);
        }
        const why = this.machine.ask();
        return said(why ?? (this.machine.blinking ? "Press HIGH POWER button to enable power" : null));
      }
      case "PANIC":
        this.machine.off();
        return said(null);
      case "CALIBRATE":
        return {
          text: "Are you sure (Y/N)? ",
          asks: answer => {
            if (!/^y/i.test(answer.trim())) return said(null);
            if (!this.machine.isPowered) return said("*Robot power off*");
            this.machine.calibrated = true;
            return said(null);
          },
        };
      default:
        return null;
    }
  }
  private ofProgram(command: string, rest: string): Said | null {
    switch (command) {
      case "EXECUTE": {
        const [, name = ""] = new RegExp(`^(?:[0-9]+\\s*,?\\s*)?(${NAME})`).exec(rest) ?? [];
        return said(name === "" ? "*Undefined program or variable name*" : this.programs.execute(name));
      }
      case "ABORT":
        this.programs.abort();
        return said(null);
      case "PROCEED":
        return said(this.programs.proceed());
      case "LOAD":
        return said(this.programs.load(rest));
      case "SIGNAL": {
        const lines = rest.split(",").map(Number);
        if (lines.some(n => !Number.isInteger(n) || n === 0 || Math.abs(n) > 512))
          return said("*Illegal digital signal*");
        for (const n of lines) this.arm.signals.write(`out_${Math.abs(n)}`, n > 0);
        return said(null);
      }
      case "HERE": {
        if (!new RegExp(`^#?${NAME}$`).test(rest)) return said("*Illegal monitor command*");
        const values = rest.startsWith("#")
          ? Array.from(axesOfJoints(this.joints, this.now_rad, this.shown))
          : this.place();
        const text = values.map(each => each.toFixed(3).padStart(10)).join("");
        const why = rest.startsWith("#")
          ? this.programs.setPoint(rest, values)
          : this.programs.define(`SET ${rest} = ${this.here()}`);
        return why ? said(why) : { text: `${text}\r\nChange? `, asks: () => said(null) };
      }
      case "DO":
        return this.machine.state === STATE.fatal ? said("*Robot power off*") : this.execute(rest);
      default:
        return null;
    }
  }
}

function monitorOf(own: Monitor): (line: string) => Said {
  return line => {
    const [, word = "", rest = ""] = /^\s*([A-Za-z]+)\s*(.*?)\s*$/.exec(line) ?? [];
    if (line.trim() === "") return said(null);
    const matching = COMMANDS.filter(command => command.startsWith(word.toUpperCase()));
    const command =
      matching.find(each => each === word.toUpperCase()) ?? (matching.length === 1 ? matching[0] : undefined);
    return (command && own.command(command, rest)) ?? said("*Illegal monitor command*");
  };
}
