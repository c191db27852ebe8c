/*
 * Register values that a backup holds beside the listings: NUMREG.VA, POSREG.VA and the like, as the controller writes
 * them.
 */

/** X, Y, Z, W, P, R or J1 … J6 of a position register. */
export interface RegisterPosition {
  readonly joints: boolean;
  readonly values: readonly number[];
}
export interface RegisterValues {
  readonly numbers: Map<number, number>;
  readonly positions: Map<number, RegisterPosition>;
}

/** The head of a variable of a backup: `[*NUMREG*]$NUMREG  Storage: …`. */
export const VARIABLE_HEAD = /^\s*\[\*?[A-Za-z0-9_]+\*?\]\s*\$?([A-Za-z0-9_]+)/;
const NUMBER = String.raw`([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[Ee][-+]?[0-9]+)?)`;
const ELEMENT = new RegExp(String.raw`^\s*\[([0-9]+)\]\s*=\s*${NUMBER}`);
const POSITION = /^\s*\[([0-9]+)\s*,\s*([0-9]+)\]\s*=/;
const FIELD = new RegExp(String.raw`\b(X|Y|Z|W|P|R|J[1-6])\s*[:=]\s*${NUMBER}`, "g");
const CARTESIAN = ["X", "Y", "Z", "W", "P", "R"];
const JOINTS = ["J1", "J2", "J3", "J4", "J5", "J6"];

/** Takes the lines of one variable, the head first. Variables that are no registers are passed over. */
export class RegisterReader {
  readonly registers: RegisterValues = { numbers: new Map(), positions: new Map() };
  private variable = "";
  /** The position register of group 1 that is being read, and its fields so far. */
  private open: { readonly number: number; readonly fields: Map<string, number> } | undefined;

  head(line: string): void {
    this.close();
    this.variable = VARIABLE_HEAD.exec(line)?.[1]?.toUpperCase() ?? "";
  }

  take(line: string): void {
    if (this.variable === "NUMREG") {
      const found = ELEMENT.exec(line);
      if (found !== null) this.registers.numbers.set(Number(found[1]), Number(found[2]));
      return;
    }
    if (this.variable !== "POSREG") return;
    const found = POSITION.exec(line);
    if (found !== null) {
      this.close();
      if (found[1] === "1") this.open = { number: Number(found[2]), fields: new Map() };
    }
    // What a person called the register stands between apostrophes and may look like a field.
    const plain = line.replace(/'[^']*'/, "");
    for (const [, name, value] of plain.matchAll(FIELD)) this.open?.fields.set(name!, Number(value));
  }

  /** Ends the register that is being read; one that was never taught is left out. */
  close(): void {
    const { open } = this;
    this.open = undefined;
    if (open === undefined) return;
    const joints = open.fields.has("J1");
    const values = (joints ? JOINTS : CARTESIAN).map(name => open.fields.get(name));
    const known = values.filter(value => value !== undefined);
    if (known.length === 6) this.registers.positions.set(open.number, { joints, values: known });
  }
}
