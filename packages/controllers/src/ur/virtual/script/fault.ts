/**
 * Where and why a program cannot be read or goes on no further. Thrown inside this folder only; what is handed out are
 * values.
 */
export interface ScriptFault {
  readonly line: number;
  readonly column: number;
  readonly sentence: string;
}
export interface At {
  readonly line: number;
  readonly column: number;
}

export class ScriptError extends Error {
  readonly fault: ScriptFault;
  constructor({ line, column }: At, sentence: string) {
    super(sentence);
    this.fault = { line, column, sentence };
  }
}
