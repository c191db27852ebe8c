import type { Interpreted, Signals, SignalLine, Step } from "@twincell/core";
import { textSteps, withLines } from "../../runner/index.ts";
import { programOf } from "../codec/ftp.ts";

export type Callable =
  | {
      readonly kind: "ready";
      readonly steps: Iterable<Step>;
      readonly context: Extract<Interpreted, { kind: "ready" }>["context"];
    }
  | { readonly kind: "not-understood"; readonly sentence: string };

const MOST_LETTERS = 16_000_000;
const MOST_FILES = 500;
const TERMINALS: Readonly<Record<SignalLine["kind"], string>> = {
  "digital-in": "DI",
  "digital-out": "DO",
  "analogue-in": "AI",
  "analogue-out": "AO",
};

/** TP programs of a controller as their listings, and what one amounts to when it is called. */
export class Programs {
  private readonly files = new Map<string, string>();
  private readonly interpret: (text: string) => Interpreted;
  private held = 0;

  constructor(interpret: (text: string) => Interpreted) {
    this.interpret = interpret;
  }

  get names(): string[] {
    return [...this.files.keys()].sort();
  }
  read(file: string): string | undefined {
    return this.files.get(file);
  }
  remove(file: string): boolean {
    this.held -= this.files.get(file)?.length ?? 0;
    return this.files.delete(file);
  }
  /** Null, or why a listing is not taken. */
  store(file: string, text: string): string | null {
    const program = programOf(text);
    const before = this.files.get(file)?.length ?? 0;
    if (!/^[A-Z][A-Z0-9_]{0,35}\.LS$/.test(file)) return `${file} is no name of a listing (.LS).`;
    if (program === "") return `${file} does not begin with /PROG and a name.`;
    if (`${program}.LS` !== file) return `${file} holds the program ${program}.`;
    if (this.held - before + text.length > MOST_LETTERS || (!this.files.has(file) && this.files.size >= MOST_FILES))
      return "The memory of the controller is full.";
    this.held += text.length - before;
    this.files.set(file, text);
    return null;
  }

  /** A program, with those that it may call behind it. */
  call(program: string, signals: Signals): Callable {
    const file = `${program.toUpperCase()}.LS`;
    const text = this.files.get(file);
    if (text === undefined) return { kind: "not-understood", sentence: `There is no program ${program.slice(0, 40)}.` };
    const read = this.interpret(
      [text, ...[...this.files].filter(([name]) => name !== file).map(([, other]) => other)].join(""),
    );
    if (read.kind === "not-understood") {
      const [fault] = read.faults;
      return {
        kind: "not-understood",
        sentence: `${program}, line ${fault?.line ?? 1}: ${fault?.sentence ?? "not understood"}`,
      };
    }
    const terminal = (name: string): string => {
      const line = read.context.signals?.[name];
      return line?.address === undefined ? name : `${TERMINALS[line.kind]}[${line.address}]`;
    };
    const { steps } = textSteps(() =>
      read.run({
        read: name => signals.read(terminal(name)),
        write: (name, value) => {
          signals.write(terminal(name), value);
        },
      }),
    );
    return {
      kind: "ready",
      context: read.context,
      steps: {
        *[Symbol.iterator]() {
          for (const step of steps) yield withLines(step, terminal);
        },
      },
    };
  }
}
