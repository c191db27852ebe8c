/** So many round trips are kept: the quickest of them tells most. */
const KEPT = 16;

/** How another clock stands to ours, from round trips. */
export interface ClockMap {
  /**
   * A message left at `sent_s` and came back at `back_s` of our clock; between the two the other clock said `there_s`.
   */
  heard(sent_s: number, there_s: number, back_s: number): void;
  /** other = ours + offset [s]; NaN before the first round trip. */
  readonly offset_s: number;
  /** The offset is not off by more than this: half of the quickest round trip [s]. */
  readonly uncertain_s: number;
}

/**
 * The quickest round trip of the last 16 decides: whatever made others slower was a queue on one of the two ways, and
 * would shift the offset by half of it.
 *
 *   offset = there − (sent + back) / 2,   |error| ≤ (back − sent) / 2
 */
export function createClockMap(): ClockMap {
  const trips: { readonly offset_s: number; readonly half_s: number }[] = [];
  let best: { readonly offset_s: number; readonly half_s: number } | null = null;
  return {
    heard(sent_s, there_s, back_s) {
      if (![sent_s, there_s, back_s].every(Number.isFinite) || back_s < sent_s) return;
      trips.push({ offset_s: there_s - (sent_s + back_s) / 2, half_s: (back_s - sent_s) / 2 });
      if (trips.length > KEPT) trips.shift();
      best = trips.reduce((least, trip) => (trip.half_s < least.half_s ? trip : least));
    },
    get offset_s() {
      return best?.offset_s ?? NaN;
    },
    get uncertain_s() {
      return best?.half_s ?? Infinity;
    },
  };
}
