import type { Scheduler } from "@twincell/core";
import type { ByteStream } from "../../transport/index.ts";
import { commandBytes, MonitorReader } from "../codec/monitor.ts";

interface Asked {
  readonly command: string;
  readonly since_s: number;
  readonly answer: (lines: readonly string[] | null) => void;
}
export interface Line {
  /** The lines that were said to a command, its echo first; null when the line is gone. Commands may be typed ahead. */
  ask(command: string): Promise<readonly string[] | null>;
  /** How long the oldest command has waited [s]. */
  readonly waited_s: number;
  close(): void;
}
export interface LineListener {
  roundTrip(seconds: number): void;
  /** What came without being asked for. */
  aside(lines: readonly string[]): void;
  lost(sentence: string): void;
}

/**
 * Commands and what is said to them, in order. An answer counts from the echo of its command on: what the controller
 * says of its own accord, with a prompt behind it, may stand in between.
 */
export function openLine(stream: ByteStream, scheduler: Scheduler, listener: LineListener): Line {
  const asked: Asked[] = [];
  const reader = new MonitorReader();
  let isOpen = true;
  const same = (line: string, command: string): boolean => line.trim().toUpperCase() === command.trim().toUpperCase();

  function close(): void {
    if (!isOpen) return;
    isOpen = false;
    stream.close();
    for (const { answer } of asked.splice(0)) answer(null);
  }
  stream.onEnd(({ sentence }) => {
    if (isOpen) {
      close();
      listener.lost(sentence);
    }
  });
  stream.onBytes(lent => {
    if (!isOpen) return;
    const why = reader.push(lent, lines => {
      const first = asked[0];
      const at = first ? lines.findIndex(line => same(line, first.command)) : -1;
      if (!first || at < 0) {
        if (lines.some(line => line.trim() !== "")) listener.aside(lines);
        return;
      }
      if (at > 0) listener.aside(lines.slice(0, at));
      asked.shift();
      listener.roundTrip(scheduler.now_s() - first.since_s);
      first.answer(lines.slice(at));
    });
    if (why && isOpen) {
      close();
      listener.lost(why);
    }
  });
  return {
    close,
    get waited_s() {
      return asked[0] ? scheduler.now_s() - asked[0].since_s : 0;
    },
    ask: command =>
      new Promise(answer => {
        if (!isOpen) {
          answer(null);
          return;
        }
        asked.push({ command, since_s: scheduler.now_s(), answer });
        stream.send(commandBytes(command));
      }),
  };
}
