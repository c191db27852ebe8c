/** A picture that was older than this when it was shown is late [s]. */
export const LATE_S = 0.25;
/** Nothing new for longer than this is a picture that stands still [s]. */
export const STILL_S = 1;

/** Times of what is shown, all of the page's clock [s]. `captured_s` is NaN when nobody knows it. */
export interface PictureTimes {
  readonly captured_s: number;
  readonly shown_s: number;
}

/**
 * How a picture stands to now. `age_s` is from the light on the sensor to the picture on screen, NaN where that is not
 * known. "late": what is seen was otherwise when it was seen. "still": nothing has come for `still_s`; the room may
 * look quite different.
 */
export type Freshness =
  | { readonly kind: "none" }
  | { readonly kind: "fresh"; readonly age_s: number }
  | { readonly kind: "late"; readonly age_s: number }
  | { readonly kind: "still"; readonly still_s: number };

export function freshness(times: PictureTimes | null, now_s: number): Freshness {
  if (!times) return { kind: "none" };
  const still_s = now_s - times.shown_s;
  const age_s = Math.max(0, times.shown_s - times.captured_s);
  if (still_s > STILL_S) return { kind: "still", still_s };
  return { kind: age_s > LATE_S ? "late" : "fresh", age_s };
}
