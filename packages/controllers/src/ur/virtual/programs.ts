import type { Interpreted, Program, Step } from "@twincell/core";
import { RUNTIME } from "../codec/modes.ts";
import { textSteps } from "../../runner/text.ts";
import { Machine, readScript, type ScriptFault } from "./script/index.ts";
import { robotFunctions, type ScriptHost } from "./functions.ts";
import type { Mover } from "./mover.ts";
import type { NamedLines } from "./lines.ts";

export interface ProgramsOptions {
  readonly host: Omit<ScriptHost, "owner" | "watch">;
  readonly mover: Mover;
  readonly lines: NamedLines;
  /**
   * The language's own interpreter. It is asked first; what it does not understand goes to the machine for control
   * scripts.
   */
  readonly interpret: (text: string) => Interpreted;
  readonly onStarted: (name: string) => void;
  readonly onStopped: (name: string) => void;
  readonly onFault: (fault: ScriptFault) => void;
}
interface Watch {
  readonly input: string;
  readonly within_s: number;
  readonly action: string;
  readonly since_s: number;
}
interface Running {
  readonly name: string;
  /** Goes on by a cycle; true when it is over. */
  readonly cycle: () => boolean;
  readonly line: () => number;
}

/**
 * The program that is running, at most one, and those that run beside it. A text is first shown to the interpreter that
 * was handed in, which knows the language of motions; a script with registers, threads or streams of targets is run by
 * the machine for control scripts.
 */
export class Programs {
  private readonly options: ProgramsOptions;
  private running: Running | null = null;
  private readonly beside: Machine[] = [];
  private readonly watches: Watch[] = [];
  private ending = "";
  private state: number = RUNTIME.STOPPED;
  /** The text that "play" runs. */
  loaded: { readonly name: string; readonly text: string } | null = null;

  constructor(options: ProgramsOptions) {
    this.options = options;
  }

  get runtime(): number {
    return this.state;
  }
  get name(): string {
    return this.running?.name ?? "";
  }
  get line(): number {
    return this.running?.line() ?? 0;
  }
  get isRunning(): boolean {
    return this.running !== null;
  }

  /** Runs a text; it replaces the one that is running. */
  start(text: string): void {
    const { host } = this.options;
    const read = readScript(text);
    if (read.kind === "read" && read.script.isSecondary) {
      this.beside.push(
        new Machine(
          read.script,
          robotFunctions(
            {
              ...host,
              owner: 0,
              watch: () => {
                /* Nothing of its own moves. */
              },
            },
            false,
          ),
          () => {
            /* It moves nothing. */
          },
        ),
      );
      return;
    }
    this.end();
    const answer = this.options.interpret(text);
    if (answer.kind === "ready") {
      this.begin(this.interpreted(read.kind === "read" ? read.script.name : "unnamed", answer));
      return;
    }
    if (read.kind === "not-understood") {
      this.options.onFault(read.fault);
      return;
    }
    this.begin(this.scripted(read.script));
  }

  private begin(running: Running): void {
    this.running = running;
    this.state = RUNTIME.PLAYING;
    this.options.onStarted(running.name);
  }

  private interpreted(name: string, answer: Extract<Interpreted, { kind: "ready" }>): Running {
    const { mover, lines } = this.options;
    const { steps, lineOf } = textSteps(() => answer.run(lines.signals));
    lines.begin(answer.context.signals);
    let now = 0;
    const noted = function* (): Generator<Step> {
      for (const step of steps) {
        now = lineOf(step.id);
        yield step;
      }
    };
    const context: Pick<Program, "tools" | "frames"> = answer.context;
    let moving: ReturnType<Mover["run"]> | null = null;
    return {
      name,
      line: () => now,
      cycle: () => {
        if (!moving) {
          if (mover.isAtRest) moving = mover.run({ [Symbol.iterator]: noted }, context);
          return false;
        }
        if (!moving.over) return false;
        if (moving.sentence !== "") this.options.onFault({ line: now, column: 1, sentence: moving.sentence });
        return true;
      },
    };
  }

  private scripted(script: ConstructorParameters<typeof Machine>[0]): Running {
    const { mover } = this.options;
    const host: ScriptHost = {
      ...this.options.host,
      owner: 0,
      watch: (input, least_Hz, action) => {
        if (least_Hz > 0)
          this.watches.push({ input, within_s: 1 / least_Hz, action, since_s: this.options.host.now_s() });
      },
    };
    const machine = new Machine(script, robotFunctions(host, true), thread => {
      if (host.owner === thread) mover.stop();
    });
    return {
      name: script.name,
      line: () => machine.line,
      cycle: () => {
        const state = machine.cycle();
        if (state.kind === "fault") this.options.onFault(state.fault);
        return state.kind !== "running";
      },
    };
  }

  /** Ends what is running; the arm comes to rest. */
  end(): void {
    this.options.mover.stop();
    this.options.mover.hold(false);
    this.watches.length = 0;
    const ended = this.running;
    this.running = null;
    this.state = RUNTIME.STOPPED;
    if (ended) this.options.onStopped(ended.name);
  }
  endBeside(): void {
    this.beside.length = 0;
  }
  pause(): boolean {
    if (this.state !== RUNTIME.PLAYING) return false;
    this.state = RUNTIME.PAUSED;
    this.options.mover.hold(true);
    return true;
  }
  resume(): boolean {
    if (this.state !== RUNTIME.PAUSED) return false;
    this.state = RUNTIME.PLAYING;
    this.options.mover.hold(false);
    return true;
  }

  /** One cycle. Returns what a program's own watch found, or "". */
  cycle(): string {
    const { host } = this.options;
    const now_s = host.now_s();
    this.ending = "";
    for (let i = this.beside.length - 1; i >= 0; i--)
      if (this.beside[i]!.cycle().kind !== "running") this.beside.splice(i, 1);
    this.options.lines.cycle();
    for (const { input, within_s, action, since_s } of this.watches) {
      if (
        now_s - Math.max(since_s, host.memory.writtenAt_s(input)) <= within_s + host.cycle_s / 2 ||
        action === "ignore"
      )
        continue;
      this.ending = `${input} was not written for ${Math.round(within_s * 1000)} ms.`;
      if (action === "pause") this.pause();
      else this.end();
      break;
    }
    if (this.running && this.state === RUNTIME.PLAYING && this.running.cycle()) this.end();
    return this.ending;
  }
}
