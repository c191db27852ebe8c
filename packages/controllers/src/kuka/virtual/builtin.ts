/** A program that the controller executes itself instead of handing its text to an interpreter. */
export interface Builtin {
  /** From the first line, which moves nothing. */
  begin(): void;
  /** The start key after a stop. */
  goOn(): void;
  /** Once a cycle while the program is active. */
  cycle(): void;
  /** Deselected. */
  abandon(): void;
  /** The robot was stopped, by whatever. */
  interrupted?(): void;
}
