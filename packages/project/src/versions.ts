/** The version this release writes. */
export const NEWEST = 2;

interface LiftStep {
  readonly says: string;
  readonly lift: (cell: Readonly<Record<string, unknown>>) => Record<string, unknown>;
}

/**
 * Step n lifts a cell of version n to n + 1. A shipped step is never edited; the file of every version that was ever
 * shipped is kept in fixtures/cells.
 */
export const STEPS: Readonly<Record<number, LiftStep>> = {
  // Everything of version 1 means the same in version 2, which only adds: text programs, attached frames, hidden and
  // locked objects and frames, training cells.
  1: {
    says: "The cell is of version 1; it may now also hold vendor programs as text and frames that move with an object.",
    lift: cell => ({ ...cell }),
  },
};

export interface Lifted {
  readonly cell: Record<string, unknown>;
  readonly says: readonly string[];
}

/** The cell in version `to`, with a sentence for each step taken. */
export function lift(
  cell: Readonly<Record<string, unknown>>,
  from: number,
  steps: Readonly<Record<number, LiftStep>> = STEPS,
  to: number = NEWEST,
): Lifted {
  let lifted: Record<string, unknown> = { ...cell };
  const says: string[] = [];
  for (let version = from; version < to; version++) {
    const step = steps[version]!;
    lifted = { ...step.lift(lifted), version: version + 1 };
    says.push(step.says);
  }
  return { cell: lifted, says };
}
