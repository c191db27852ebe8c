import type { DriverKind } from "@twincell/controllers";
import { seededRandom } from "@twincell/core";
import { DOINGS, noWorst, oneCase, type Worst } from "./case.ts";
import { openCell } from "./cell.ts";
import { FAULTS } from "./kinds.ts";

export interface Broken {
  readonly seed: number;
  readonly fault: string;
  readonly doing: string;
  readonly law: string;
}
export interface Soaked {
  readonly faults: number;
  readonly seconds: number;
  readonly crashes: number;
  readonly broken: readonly Broken[];
  readonly worst: Worst;
  readonly counts: Readonly<Record<string, number>>;
  readonly outcomes: Readonly<Record<string, number>>;
}

/**
 * Cases of one cell: enough that what one leaves behind shows in the next, few enough that one is found again quickly.
 */
const PER_CELL = 12;
const STRIDE = 7919;

/**
 * So many faults between the driver of that brand and its virtual controller.
 *
 * @param only    the faults to choose from; all of them when left out, and each in its turn instead of by chance when
 *   asked for.
 * @param now_ms  of the machine, for how long it took.
 */
export async function soak(
  kind: DriverKind,
  faults: number,
  seed: number,
  now_ms: () => number,
  only: readonly string[] = Object.keys(FAULTS),
  inTurn = false,
): Promise<Soaked> {
  const begun_ms = now_ms();
  const worst = noWorst();
  const broken: Broken[] = [];
  const counts: Record<string, number> = {};
  const outcomes: Record<string, number> = {};
  const count = (where: Record<string, number>, what: string): void => {
    where[what] = (where[what] ?? 0) + 1;
  };
  let done = 0;
  let crashes = 0;
  for (let n = 0; done < faults; n++) {
    const own = seed + STRIDE * n;
    const random = seededRandom(own);
    const cell = await openCell(kind, own);
    cell.seat.acquireLease();
    cell.seat.setEnabled(true);
    for (let i = 0; i < PER_CELL && done < faults; i++, done++) {
      const name = only[inTurn ? done % only.length : Math.floor(random() * only.length)]!;
      const doing = DOINGS[Math.floor(random() * DOINGS.length)]!;
      count(counts, name);
      try {
        const ended = await oneCase(cell, name, doing, worst);
        count(outcomes, `${doing}: ${ended.outcome}`);
        for (const law of ended.broken) broken.push({ seed: own, fault: name, doing, law });
        // What is broken is not carried into the next case.
        if (ended.broken.length > 0) {
          done++;
          break;
        }
      } catch (reason) {
        crashes++;
        broken.push({
          seed: own,
          fault: name,
          doing,
          law: `it crashed: ${reason instanceof Error ? (reason.stack ?? reason.message) : String(reason)}`,
        });
        done++;
        break;
      }
    }
    cell.close();
  }
  return {
    faults: done,
    seconds: Math.round((now_ms() - begun_ms) / 100) / 10,
    crashes,
    broken,
    worst,
    counts,
    outcomes,
  };
}
