import { Fault } from "@twincell/core";

/** Wrong use or unreadable input: exit 2, one sentence on stderr that names the line or step. */
export class UseFault extends Fault {
  readonly code = "cli.use";
  readonly hint: string;
  constructor(sentence: string, hint = "") {
    super(sentence);
    this.hint = hint;
  }
}

/** One command of the command line: one file each. */
export interface Command {
  readonly name: string;
  readonly summary: string;
  /** Shown by --help. */
  readonly usage: string;
  /** Exit code: 0 fine, 1 the thing checked is not fine. Wrong use throws a `UseFault` (exit 2). */
  run(args: readonly string[]): Promise<number>;
}
