import { asciiText } from "../parser/index.ts";

export interface NameRules {
  readonly most: number;
  readonly reserved: ReadonlySet<string>;
  readonly first: string /** Whether ABC and abc are one name. */;
  readonly foldsCase: boolean;
}

/** Gives each thing a name of the language, and the same one whenever it is asked for again. */
export class Names {
  private readonly rules: NameRules;
  private readonly taken = new Set<string>();
  private readonly given = new Map<string, string>();

  constructor(rules: NameRules) {
    this.rules = rules;
  }

  /** @param sort  things of two sorts may share a name in the program; here they never do. */
  of(sort: string, name: string): string {
    const key = `${sort}\0${name}`;
    const known = this.given.get(key);
    if (known !== undefined) return known;
    const fresh = this.fresh(name);
    this.given.set(key, fresh);
    return fresh;
  }

  fresh(name: string): string {
    const { most, reserved, first, foldsCase } = this.rules;
    const fold = (text: string): string => (foldsCase ? text.toLowerCase() : text);
    const plain = asciiText(name)
      .replace(/[^A-Za-z0-9_]+/g, "_")
      .replace(/^_+|_+$/g, "");
    const stem = (/^[A-Za-z]/.test(plain) ? plain : `${first}${plain}`).replace(/_$/, "").slice(0, most);
    for (let i = 1; ; i++) {
      const tail = i === 1 ? "" : `_${i}`;
      const tried = stem.slice(0, most - tail.length) + tail;
      if (this.taken.has(fold(tried)) || reserved.has(tried) || reserved.has(fold(tried))) continue;
      this.taken.add(fold(tried));
      return tried;
    }
  }
}

/**
 * What a person called something, as it can stand in a comment. Marks that the reader of comments keeps for itself are
 * dropped.
 */
export const remark = (name: string): string => asciiText(name).replace(/^[*=\-\s]+/, "");
