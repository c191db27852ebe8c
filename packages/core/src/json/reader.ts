import type { Pose } from "../spatial/pose.ts";
import { normalizeQuaternion, type Quaternion } from "../spatial/quaternion.ts";
import type { Vector3 } from "../spatial/vector.ts";

/** A quaternion off length 1 by more than this is a mistake, not rounding. */
const QUATERNION_SLACK = 1e-3;

export type Fields = Readonly<Record<string, unknown>>;

/** The names of a type's fields, checked against the type: `keys<Step>()("id", "type")`. */
export const keys =
  <T>() =>
  (...names: readonly (T extends unknown ? keyof T & string : never)[]): readonly string[] =>
    names;

/**
 * Looks at unknown values and collects one sentence per fault. Every method returns undefined when the value cannot be
 * used; the fault is then already written down, so callers carry on and one reading finds all faults.
 */
export class Reader {
  readonly faults: { readonly path: string; readonly sentence: string }[] = [];
  private readonly most: number;
  constructor(most: number) {
    this.most = most;
  }

  fault(path: string, sentence: string): undefined {
    // Callers name things as inside a sentence ("the target of step 3"); here the sentence begins.
    if (this.faults.length < this.most)
      this.faults.push({ path, sentence: sentence.charAt(0).toUpperCase() + sentence.slice(1) });
    return undefined;
  }

  /** A value as a person would quote it, short. */
  shown(value: unknown): string {
    if (value === undefined) return "nothing";
    if (Array.isArray(value)) return `a list of ${value.length}`;
    if (value !== null && typeof value === "object") return "an object";
    if (typeof value === "string") return value.length > 40 ? `"${value.slice(0, 40)}…"` : `"${value}"`;
    return String(value);
  }

  object(value: unknown, path: string, what: string): Fields | undefined {
    return isFields(value) ? value : this.fault(path, `${what} is an object; here it is ${this.shown(value)}.`);
  }

  list(value: unknown, path: string, what: string): readonly unknown[] | undefined {
    return Array.isArray(value) ? value : this.fault(path, `${what} is a list; here it is ${this.shown(value)}.`);
  }

  number(value: unknown, path: string, what: string, unit: string): number | undefined {
    return typeof value === "number" && Number.isFinite(value)
      ? value
      : this.fault(
          path,
          `${what} is a finite number${unit === "" ? "" : ` [${unit}]`}; here it is ${this.shown(value)}.`,
        );
  }

  text(value: unknown, path: string, what: string): string | undefined {
    return typeof value === "string" ? value : this.fault(path, `${what} is a text; here it is ${this.shown(value)}.`);
  }

  /** A text that something else refers to by: not empty. */
  name(value: unknown, path: string, what: string): string | undefined {
    return typeof value === "string" && value !== ""
      ? value
      : this.fault(path, `${what} is a text that is not empty; here it is ${this.shown(value)}.`);
  }

  onlyKeys(fields: Fields, path: string, what: string, known: readonly string[]): void {
    for (const key of Object.keys(fields)) {
      if (!known.includes(key) && !/^(\$|_|x-)/.test(key)) {
        this.fault(
          path === "" ? key : `${path}.${key}`,
          `${what} has no field “${key}”; it can have ${known.join(", ")}.`,
        );
      }
    }
  }

  numbers(value: unknown, path: string, what: string, unit: string, count: number | undefined): number[] | undefined {
    const list = this.list(value, path, what);
    if (list === undefined) return undefined;
    if (count !== undefined && list.length !== count)
      return this.fault(path, `${what} has ${count} numbers; here it has ${list.length}.`);
    const numbers: number[] = [];
    for (let i = 0; i < list.length; i++) {
      const number = this.number(list[i], `${path}[${i}]`, `Number ${i + 1} of ${what}`, unit);
      if (number !== undefined) numbers.push(number);
    }
    return numbers.length === list.length ? numbers : undefined;
  }

  pose<Into extends string, From extends string>(
    value: unknown,
    path: string,
    what: string,
  ): Pose<Into, From> | undefined {
    const fields = this.object(value, path, what);
    if (fields === undefined) return undefined;
    this.onlyKeys(fields, path, what, ["position", "quaternion"]);
    const position = this.numbers(fields.position, `${path}.position`, `the position of ${what}`, "m", 3);
    const quaternion = this.numbers(fields.quaternion, `${path}.quaternion`, `the quaternion of ${what}`, "", 4);
    if (position === undefined || quaternion === undefined) return undefined;
    const [x, y, z, w] = quaternion as Quaternion;
    const length = Math.hypot(x, y, z, w);
    if (!(Math.abs(length - 1) <= QUATERNION_SLACK)) {
      return this.fault(
        `${path}.quaternion`,
        `The quaternion of ${what} has length 1; here it has ${length.toPrecision(4)}.`,
      );
    }
    // What is already a unit quaternion keeps its bits, so that reading and writing again changes nothing.
    const unit: Quaternion = Math.abs(length - 1) < 1e-12 ? [x, y, z, w] : normalizeQuaternion([x, y, z, w]);
    return { position: position as Vector3, quaternion: unit };
  }
}

export const isFields = (value: unknown): value is Fields =>
  value !== null && typeof value === "object" && !Array.isArray(value);
