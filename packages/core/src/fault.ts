/**
 * Something that should not have happened: a code for programs, a sentence with the numbers, a hint for hands.
 * What a person can cause in daily work is not a fault but a union with a reason (`Reach`, `ProgramAnswer`, …).
 */
export abstract class Fault extends Error {
  abstract readonly code: string;
  abstract readonly hint: string;
}

/** A fault that needs no type of its own. */
export class PlainFault extends Fault {
  readonly code: string;
  readonly hint: string;
  constructor(code: string, sentence: string, hint: string) {
    super(sentence);
    this.code = code;
    this.hint = hint;
  }
}

export class JointCountFault extends Fault {
  readonly code = "kinematics.joint-count";
  readonly hint = "Pass one angle per joint of the chosen robot, base first.";
  constructor(robot: string, wanted: number, got: number) {
    super(`${robot} has ${wanted} joints but ${got} angles were given.`);
  }
}
