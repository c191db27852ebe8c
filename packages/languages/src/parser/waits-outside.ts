import { Fault, type TextPlace } from "@twincell/core";

/**
 * A program that goes round without a motion until a line from outside changes: it shows only when it runs beside such
 * lines.
 */
export class WaitsOutside extends Fault {
  readonly code = "language.waits-outside";
  readonly hint: string;
  /** @param asks  what a person or another machine is asked for, where it is no line. */
  constructor({ line, column }: TextPlace, called = "program", asks?: string) {
    super(
      asks === undefined
        ? `The ${called} turns in a circle until a line from outside changes.`
        : `The ${called} waits until somebody answers "${asks}".`,
    );
    this.hint = `Line ${line}, column ${column}: ${asks === undefined ? "set the line that it looks at" : `give "${asks}" as an input`}.`;
  }
}
