import type { TextFault, TextPlace } from "@twincell/core";
import { textFault } from "./faults.ts";

/** What a notice expects where something that the program needs lives in the controller and is in none of the files. */
export const NOT_GIVEN = "a value in the files";
/** More than this of a text is not read by a person. */
const MOST_NOTICES = 500;

/**
 * What a program that is executed leaves out or takes for granted, each once per line: a register of the controller
 * that no file holds, a motion to a place that nobody knows. The list grows while the program runs.
 */
export class Notices {
  readonly faults: TextFault[] = [];
  /** Notices of which one is told a topic; they come into the list as they are set. */
  readonly byTopic: Map<string, TextFault>;
  private readonly seen = new Set<string>();

  constructor(before: readonly TextFault[] = []) {
    this.faults.push(...before);
    this.byTopic = new ListedNotices(this.faults);
  }

  add({ line, column }: TextPlace, expected: string, sentence: string): void {
    const key = `${line} ${sentence}`;
    if (this.seen.has(key) || this.seen.size >= MOST_NOTICES) return;
    this.seen.add(key);
    this.faults.push(textFault({ line, column }, expected, sentence));
  }

  /** Something that only the controller knows, and what was taken in its place. */
  notGiven(at: TextPlace, sentence: string): void {
    this.add(at, NOT_GIVEN, sentence);
  }
}

class ListedNotices extends Map<string, TextFault> {
  private readonly list: TextFault[] | undefined;
  constructor(list: TextFault[]) {
    super();
    this.list = list;
  }
  override set(topic: string, fault: TextFault): this {
    this.list?.push(fault);
    return super.set(topic, fault);
  }
}
