/** Why a file was not read: one sentence, and the line when there is one. */
export interface NotUnderstood { readonly kind: "not-understood"; readonly sentence: string; readonly line?: number }

/** Thrown inside a reader and caught at its door; never seen outside this package. */
export class Refusal extends Error {
  readonly line: number | undefined;
  constructor(sentence: string, line?: number) {
    super(sentence);
    this.line = line;
  }
}

/** Runs a reader; a refusal becomes an answer, anything else is a fault of ours and passes. */
export function answering<T>(read: () => T): T | NotUnderstood {
  try {
    return read();
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    return { kind: "not-understood", sentence: error.message, ...(error.line === undefined ? {} : { line: error.line }) };
  }
}
