import { Refusal } from "../refusal.ts";

/**
 * What expanding one file may cost in all: a text that doubles itself, a macro that calls itself and a list of a
 * thousand million items end in a sentence.
 */
export class Budget {
  private work = 20_000_000;
  private elements = 200_000;
  private includes = 1_000;

  /** One unit is an operation, a character put together or an item of a list. */
  spend(work: number): void {
    this.work -= work;
    if (!(this.work >= 0))
      throw new Refusal(
        "The xacro grows without end: more than 20 million characters and operations were made from it.",
      );
  }
  element(): void {
    if (--this.elements < 0) throw new Refusal("The xacro becomes more than 200000 elements.");
  }
  include(): void {
    if (--this.includes < 0) throw new Refusal("The xacro includes more than 1000 files.");
  }
}

/** Macros and includes within each other, and properties that rest on each other. */
export const DEEPEST_NESTING = 150;
