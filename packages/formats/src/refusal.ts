/** Why a file was not read: one sentence, and the line when there is one; the file where one draws in others. */
export interface NotUnderstood {
  readonly kind: "not-understood";
  readonly sentence: string;
  readonly line?: number;
  readonly file?: string;
}

/** Thrown inside a reader and caught at its door; never seen outside this package. */
export class Refusal extends Error {
  line: number | undefined;
  file: string | undefined;
  constructor(sentence: string, line?: number, file?: string) {
    super(sentence);
    this.line = line;
    this.file = file;
  }
}

/** Runs a reader; a refusal becomes an answer, anything else is a fault of ours and passes. */
export function answering<T>(read: () => T): T | NotUnderstood {
  try {
    return read();
  } catch (error) {
    if (!(error instanceof Refusal)) throw error;
    const { message, line, file } = error;
    return {
      kind: "not-understood",
      sentence: message,
      ...(line === undefined ? {} : { line }),
      ...(file === undefined ? {} : { file }),
    };
  }
}

/** Runs a step that belongs to a place; a refusal that names none gets this one. */
export function locating<T>(place: { readonly line: number; readonly file?: string }, step: () => T): T {
  try {
    return step();
  } catch (error) {
    if (error instanceof Refusal) {
      error.line ??= place.line;
      error.file ??= place.file;
    }
    throw error;
  }
}
