import { fitsQuery, modelQuery } from "@twincell/project";
import type { StoredCell } from "../../stores/library.ts";
import { words } from "../../messages/index.ts";
import { day } from "../../messages/numbers.ts";

export interface FoundCell {
  readonly cell: StoredCell;
  /** The name inside the cell by which it was found; null when it was its own name or that of its robot. */
  readonly where: string | null;
}

/**
 * Cells whose name, robot or anything inside has all words of the query, or that hold a model with the properties asked
 * for: `conveyor speed > 0.2`. Capitals do not count.
 */
export function findCells(
  cells: readonly StoredCell[],
  query: string,
  robotName: (id: string) => string,
): readonly FoundCell[] {
  const wanted = query.trim().toLowerCase();
  if (wanted === "") return cells.map(cell => ({ cell, where: null }));
  const asked = modelQuery(query);
  return cells.flatMap((cell): FoundCell[] => {
    if (`${cell.name} ${cell.robotName ?? robotName(cell.robot)}`.toLowerCase().includes(wanted))
      return [{ cell, where: null }];
    const where =
      cell.names.find(name => name.toLowerCase().includes(wanted)) ??
      (asked ? cell.models?.find(model => fitsQuery(model, asked)) : undefined)?.name;
    return where === undefined ? [] : [{ cell, where }];
  });
}

const MINUTE_MS = 60_000;
const HOUR_MS = 60 * MINUTE_MS;
const DAY_MS = 24 * HOUR_MS;

/** When something was, as a person says it. */
export function sayWhen(then_ms: number, now_ms: number): string {
  const ago_ms = now_ms - then_ms;
  if (ago_ms < MINUTE_MS) return words.cells.ago.now;
  if (ago_ms < HOUR_MS) return words.cells.ago.minutes(Math.floor(ago_ms / MINUTE_MS));
  if (ago_ms < DAY_MS) return words.cells.ago.hours(Math.floor(ago_ms / HOUR_MS));
  if (ago_ms < 2 * DAY_MS) return words.cells.ago.yesterday;
  return day(then_ms);
}
