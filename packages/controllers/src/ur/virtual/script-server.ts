import type { ByteStream } from "../../transport/index.ts";
import { lineReader } from "../codec/lines.ts";
import { blockChange } from "../codec/models.ts";
import { LONGEST_SCRIPT } from "./script/index.ts";
import type { Outbox } from "./faults.ts";

export interface ScriptServerOptions {
  readonly name: string;
  readonly outbox: Outbox;
  /** What a new client is told first: the version on the primary interface. */
  readonly greeting: () => readonly Uint8Array[];
  /** A script that is whole: one program, or one line. Without it what comes is not listened to. */
  readonly onScript?: (text: string, answer: (bytes: Uint8Array) => void) => void;
  log(sentence: string): void;
}
const LONGEST_LINE = 1 << 16;

/** A port that tells states and takes scripts. */
export class ScriptServer {
  private readonly options: ScriptServerOptions;
  private readonly streams = new Set<ByteStream>();
  constructor(options: ScriptServerOptions) {
    this.options = options;
  }

  get clients(): number {
    return this.streams.size;
  }

  accept(stream: ByteStream): void {
    const lines = lineReader(LONGEST_LINE);
    const { options } = this;
    const { onScript } = options;
    let text = "";
    let open = 0;
    this.streams.add(stream);
    stream.onEnd(() => {
      this.streams.delete(stream);
    });
    for (const bytes of options.greeting()) options.outbox.send(stream, bytes);
    if (!onScript) {
      stream.onBytes(() => {
        /* Read-only. */
      });
      return;
    }
    const reset = (why: string): void => {
      options.log(`${options.name}: ${why}`);
      this.end(stream);
    };
    stream.onBytes(lent => {
      const why = lines.push(lent, line => {
        if (!this.streams.has(stream) || options.outbox.faults.frozen) return;
        if (text === "" && line.trim() === "") return;
        open = Math.max(0, open + blockChange(line));
        text += `${line}\n`;
        if (text.length > LONGEST_SCRIPT) {
          text = "";
          reset(`a script has at most ${LONGEST_SCRIPT} letters; a longer one came.`);
          return;
        }
        if (open > 0) return;
        const whole = text;
        text = "";
        onScript(whole, bytes => {
          options.outbox.send(stream, bytes);
        });
      });
      if (why !== null && this.streams.has(stream)) reset(why);
    });
  }
  private end(stream: ByteStream): void {
    this.streams.delete(stream);
    stream.close();
  }
  closeAll(): void {
    for (const stream of [...this.streams]) this.end(stream);
  }
  tell(bytes: Uint8Array, isState = false): void {
    for (const stream of this.streams) this.options.outbox.send(stream, bytes, isState);
  }
}
