import type { EmittedFile } from "@twincell/core";
import { asciiText } from "../../parser/index.ts";
import { TooLong } from "../../emitter/index.ts";
import { positionLines, type Position } from "./positions.ts";

/** Lines have four places for their number. */
const MOST_LINES = 9999;
const COMMENT_LENGTH = 16;

/** A comment that has to be cut says less than the name of the program. */
const shortOr = (comment: string): string => (comment.length <= COMMENT_LENGTH ? comment : "");

interface Line {
  readonly text: string;
  readonly isMotion: boolean;
  readonly step: string;
}

/** One program as the controller lists it: attributes, numbered lines, positions. */
export class Listing {
  readonly name: string;
  private readonly comment: string;
  private readonly statements: Line[] = [];
  private readonly positions: Position[] = [];
  private readonly numbers = new Map<string, number>();
  private labels = 0;
  /** Labels behind the end at which the program is aborted. */
  private abort: number | undefined;

  constructor(name: string, comment: string) {
    this.name = name;
    this.comment = shortOr(asciiText(comment).replace(/["']/g, ""));
  }

  add(text: string, step = ""): void {
    this.statements.push({ text, isMotion: false, step });
  }
  motion(text: string, step: string): void {
    this.statements.push({ text, isMotion: true, step });
  }
  label(): number {
    return ++this.labels;
  }
  /** A label where the program ends with a fault. */
  abortLabel(): number {
    return (this.abort ??= this.label());
  }

  /** The number of a position; the same record is kept once for each step. */
  position(position: Position): number {
    const key = JSON.stringify(position);
    const known = this.numbers.get(key);
    if (known !== undefined) return known;
    this.positions.push(position);
    this.numbers.set(key, this.positions.length);
    return this.positions.length;
  }

  file(): EmittedFile {
    if (this.abort !== undefined) for (const line of ["END", `LBL[${this.abort}]`, "ABORT"]) this.add(line);
    const { statements, name } = this;
    const last = statements.at(-1);
    const texts: string[] = [];
    const lines: string[] = [];
    if (statements.length > MOST_LINES)
      throw new TooLong(
        last!.step,
        `The program ${name} has ${statements.length} lines; a listing numbers ${MOST_LINES}.`,
        "Put parts of it into routines of their own.",
      );
    const put = (text: string, step = ""): void => {
      texts.push(`${text}\r\n`);
      lines.push(step);
    };
    put(`/PROG  ${name}`);
    for (const line of [
      "/ATTR",
      "OWNER\t\t= MNEDITOR;",
      `COMMENT\t\t= "${this.comment}";`,
      "PROG_SIZE\t= 0;",
      "FILE_NAME\t= ;",
      "VERSION\t\t= 0;",
      `LINE_COUNT\t= ${statements.length};`,
      "MEMORY_SIZE\t= 0;",
      "PROTECT\t\t= READ_WRITE;",
      "TCD:  STACK_SIZE\t= 0,",
      "      TASK_PRIORITY\t= 50,",
      "      TIME_SLICE\t= 0,",
      "      BUSY_LAMP_OFF\t= 0,",
      "      ABORT_REQUEST\t= 0,",
      "      PAUSE_REQUEST\t= 0;",
      "DEFAULT_GROUP\t= 1,*,*,*,*;",
      "CONTROL_CODE\t= 00000000 00000000;",
      "/MN",
    ])
      put(line);
    for (const [i, { text, isMotion, step }] of statements.entries()) {
      const [first, ...more] = text.split("\n");
      const number = `${i + 1}`.padStart(4);
      put(`${number}:${isMotion ? "" : "  "}${first!}${more.length > 0 ? "    " : isMotion ? "    ;" : " ;"}`, step);
      for (const line of more) put(`    :  ${line}    ;`, step);
    }
    put("/POS");
    for (const [i, position] of this.positions.entries())
      for (const line of positionLines(i + 1, position)) put(line, position.step);
    put("/END");
    return { name: `${name}.LS`, text: texts.join(""), lines };
  }
}
