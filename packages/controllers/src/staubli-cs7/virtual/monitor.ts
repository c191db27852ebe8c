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
  const shown = new Float64Array(JOINTS);
  const place = (): number[] => {
    const { position, quaternion } = compose(
      inverse(robot.baseFromVendorWorld as Pose),
      flangePose(robot.arm, now_rad) as Pose,
    );
    return [...position.map(value => 1000 * value), ...toVplusYpr(quaternion)];
  };
  const here = (): string =>
    `TRANS(${place()
      .map(value => value.toFixed(3))
      .join(",")})`;
  const value = (expression: string): number | null => {
    const state = /^STATE\s*\(\s*([12])\s*\)$/i.exec(expression);
    if (state) return state[1] === "1" ? machine.state : arm.isMoving() ? 1 : 2;
    if (/^SWITCH\s*\(\s*POWER\s*\)$/i.test(expression)) return machine.isPowered ? -1 : 0;
    return programs.reals.get(expression.toUpperCase()) ?? null;
  };

  function listReals(rest: string): Said {
    const names = rest
      .split(/,(?![^()]*\))/)
      .map(name => name.trim())
      .filter(name => name !== "");
    const found = names.map(name => [name, value(name)] as const);
    return found.some(([, each]) => each === null)
      ? said("*Undefined value*")
      : { text: valuesText(found as readonly (readonly [string, number])[]) };
  }
  function motion(joints_deg: readonly number[], isLine: boolean): Said {
    if (machine.hindrance) return said(machine.hindrance);
    if (programs.isRunning || arm.isMoving()) return said("*Program task already active*");
    programs.carryOut(
      [programs.step(joints_deg, isLine, isLine ? { mps: robot.maxTcpSpeed_mps } : { ratio: 1 }, 1)],
      { tools: {}, frames: {} },
      () => {
        /* The prompt says it. */
      },
      false,
    );
    return { text: "", blocks: true };
  }
  function execute(statement: string): Said {
    const real = REAL.exec(statement);
    const point = POINT.exec(statement);
    const move = MOVE.exec(statement);
    if (real) return said(programs.setReal(real[1]!, Number(real[2])));
    if (point) {
      const values = readPoint(point[2]!);
      return values ? said(programs.setPoint(point[1]!, values)) : interpreted(statement);
    }
    if (move) {
      const values = readPoint(move[2]!) ?? programs.points.get(move[2]!.toUpperCase());
      return values ? motion(values, move[1]!.toUpperCase() === "MOVES") : said("*Undefined value*");
    }
    if (/^BRAKE$/i.test(statement)) {
      arm.stop();
      return said(null);
    }
    return interpreted(statement);
  }
  /** Everything else goes to the interpreter of the language, after what was defined before it. */
  function interpreted(statement: string): Said {
    const own = statement.replace(/\bHERE\b/gi, here());
    const lines = [
      ...programs.definitions,
      `MOVE #PPOINT(${Array.from(axesOfJoints(joints, now_rad, shown)).join(",")})`,
      own,
    ];
    const read = interpret(lines.map(line => `DO ${line}`).join("\n"));
    if (read.kind === "not-understood") return said(wordsOf(read.faults[0]?.sentence ?? "Illegal monitor command"));
    const steps: Step[] = [];
    const run = read.run(arm.signals);
    for (let next = run.next(); !next.done && steps.length < MOST_STEPS; next = run.next())
      if (next.value.line === lines.length && next.value.step) steps.push(next.value.step);
    if (steps.length === 0)
      return said(/^(SET\b|[A-Z][\w.]*\s*=)|\bALWAYS$|^(TOOL|BASE)\b/i.test(own) ? programs.define(own) : null);
    if (machine.hindrance && steps.some(({ type }) => type === "move")) return said(machine.hindrance);
    if (programs.isRunning || arm.isMoving()) return said("*Program task already active*");
    programs.carryOut(
      steps,
      read.context,
      () => {
        /* The prompt says it. */
      },
      false,
    );
    return { text: "", blocks: true };
  }

  return line => {
    const [, word = "", rest = ""] = /^\s*([A-Za-z]+)\s*(.*?)\s*$/.exec(line) ?? [];
    if (line.trim() === "") return said(null);
    const matching = COMMANDS.filter(command => command.startsWith(word.toUpperCase()));
    const command =
      matching.find(each => each === word.toUpperCase()) ?? (matching.length === 1 ? matching[0] : undefined);
    switch (command) {
      case "WHERE":
        return { text: whereText(place(), axesOfJoints(joints, now_rad, shown), digits) };
      case "LISTR":
        return listReals(rest);
      case "LISTL":
        return {
          text: `   X/J1      Y/J2      Z/J3      y/J4      p/J5      r/J6\r\n${[...programs.points].map(([name, values]) => ` ${name.toLowerCase()} ${values.map(each => each.toFixed(3)).join("   ")}\r\n`).join("")}`,
        };
      case "SPEED":
        return said(machine.setSpeed(Number(rest.split(/\s/)[0])) ? null : "*Illegal value*");
      case "ENABLE":
      case "DISABLE": {
        if (!"POWER".startsWith(rest.toUpperCase().slice(0, 5)) || rest === "")
          return said("*Illegal monitor command*");
        if (command === "DISABLE") {
          machine.off();
          return said(null);
        }
        const why = machine.ask();
        return said(why ?? (machine.blinking ? "Press HIGH POWER button to enable power" : null));
      }
      case "PANIC":
        machine.off();
        return said(null);
      case "CALIBRATE":
        return {
          text: "Are you sure (Y/N)? ",
          asks: answer => {
            if (!/^y/i.test(answer.trim())) return said(null);
            if (!machine.isPowered) return said("*Robot power off*");
            machine.calibrated = true;
            return said(null);
          },
        };
      case "EXECUTE": {
        const [, name = ""] = new RegExp(`^(?:[0-9]+\\s*,?\\s*)?(${NAME})`).exec(rest) ?? [];
        return said(name === "" ? "*Undefined program or variable name*" : programs.execute(name));
      }
      case "ABORT":
        programs.abort();
        return said(null);
      case "PROCEED":
        return said(programs.proceed());
      case "LOAD":
        return said(programs.load(rest));
      case "DIRECTORY":
        return {
          text:
            programs.names
              .map(name => `.PROGRAM ${name}`)
              .join("\r\n")
              .replace(/^/gm, " ") + "\r\n",
        };
      case "STATUS":
        return {
          text: `Robot ${stateName(machine.state)}}, speed ${machine.speed}, task 1 ${programs.isRunning ? "executing" : "idle"}\r\n`,
        };
      case "SIGNAL": {
        const lines = rest.split(",").map(Number);
        if (lines.some(n => !Number.isInteger(n) || n === 0 || Math.abs(n) > 512))
          return said("*Illegal digital signal*");
        for (const n of lines) arm.signals.write(`out_${Math.abs(n)}`, n > 0);
        return said(null);
      }
      case "IO":
        return {
          text: Array.from(
            { length: 8 },
            (_, i) =>
              `out_${i + 1} ${arm.signals.read(`out_${i + 1}`) === true ? 1 : 0}   in_${1001 + i} ${arm.signals.read(`in_${1001 + i}`) === true ? 1 : 0}\r\n`,
          ).join(""),
        };
      case "HERE": {
        if (!new RegExp(`^#?${NAME}$`).test(rest)) return said("*Illegal monitor command*");
        const values = rest.startsWith("#") ? Array.from(axesOfJoints(joints, now_rad, shown)) : place();
        const text = values.map(each => each.toFixed(3).padStart(10)).join("");
        const why = rest.startsWith("#") ? programs.setPoint(rest, values) : programs.define(`SET ${rest} = ${here()}`);
        return why ? said(why) : { text: `${text}\r\nChange? `, asks: () => said(null) };
      }
      case "DO":
        return machine.state === STATE.fatal ? said("*Robot power off*") : execute(rest);
      default:
        return said("*Illegal monitor command*");
    }
  };
}
