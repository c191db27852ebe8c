import { Fault, type TextFault, type TextPlace } from "@twincell/core";

/** A fault as a reader of a language reports it: where, what was expected there, and one sentence. */
export function textFault(at: TextPlace, expected: string, sentence: string): TextFault {
  return { line: at.line, column: at.column, expected, sentence };
}

/**
 * Ends the reading of a line, or the execution of a text, at a place. Caught at the door of the dialect that threw it,
 * or by who runs the text.
 */
export class TextError extends Fault {
  readonly code = "language.text";
  readonly hint: string;
  readonly line: number;
  readonly column: number;
  readonly expected: string;
  constructor(at: TextPlace, expected: string, sentence: string) {
    super(sentence);
    this.line = at.line;
    this.column = at.column;
    this.expected = expected;
    this.hint = `Line ${at.line}, column ${at.column}: ${expected}.`;
  }

  get fault(): TextFault {
    return textFault(this, this.expected, this.message);
  }
}

/** A place that only the controller knows stands where one is needed. */
export class NotGiven extends TextError {}
