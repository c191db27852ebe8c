import type { TextFault, TextPlace } from "@twincell/core";
import { TextError } from "./faults.ts";

/** What a fault expects where a program is called that is in none of the files. */
export const MISSING_PROGRAM = "a program among the files";

const CALLED = " is called here and is in none of the files: ";

/** A call of what the files do not hold: what it does, motions too, nobody here knows. */
export const missingProgram = (at: TextPlace, name: string): TextError =>
  new TextError(
    at,
    MISSING_PROGRAM,
    `${name}${CALLED}give the file that holds it as well, or let the call do nothing.`,
  );

export const isMissingProgram = ({ expected }: Pick<TextFault, "expected">): boolean => expected === MISSING_PROGRAM;

/** The program that a fault says is missing. */
export const missingName = ({ sentence }: Pick<TextFault, "sentence">): string =>
  sentence.slice(0, sentence.indexOf(CALLED));

/** What is told of a call that was left out because a person wanted that. */
export const leftOutSentence = ({ sentence }: Pick<TextFault, "sentence">): string =>
  `${sentence.slice(0, sentence.indexOf(CALLED))}${CALLED}what it does, motions too, is not executed.`;
