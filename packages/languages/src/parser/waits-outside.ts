import { Fault, type TextPlace } from "@twincell/core";

/**
 * A program that goes round without a motion until a line from outside changes: it shows only when it runs beside such
 * lines.
 */
export class WaitsOutside extends Fault {
  readonly code = "language.waits-outside";
  readonly hint: string;
  constructor({ line, column }: TextPlace, called = "program") {
    super(`The ${called} turns in a circle until a line from outside changes.`);
    this.hint = `Line ${line}, column ${column}: set the line that it looks at.`;
  }
}
