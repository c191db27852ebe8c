/**
 * How parts are laid along one side of a surface: spread with the same gap everywhere, from edge to edge, without gaps
 * in the middle or from one of the ends, or in the middle with a gap of their own.
 */
export const GRID_RULES = ["even", "edges", "middle", "low", "high", "spaced"] as const;
export type GridRule = (typeof GRID_RULES)[number];

/** Places along one side, in the frame whose origin is its middle [m]. */
export interface GridLine {
  readonly rule: GridRule;
  readonly count: number;
  readonly first_m: number;
  readonly pitch_m: number;
}
/** A line of places with the place of each observation, and what is left, in standard deviations squared. */
export interface FittedLine extends GridLine {
  readonly slots: readonly number[];
  readonly misfit: number;
}

/** A hand puts a part down this near to where it wants it (one standard deviation) [m]. */
export const HAND_M = 0.003;
/** A gap of its own is believed only where no rule explains what was shown. */
const SPACED_COST = 9;
/** Different rules along the two sides are rarer than one for both. */
const MIXED_COST = 6;

/** Every way in which so many parts can be laid along a side, fitted to what was seen there. */
export function fittedLines(side_m: number, part_m: number, count: number, seen_m: readonly number[]): FittedLine[] {
  const room = side_m - count * part_m;
  if (count < 1 || room < -1e-9) return [];
  const line = (rule: GridRule, first_m: number, pitch_m: number): GridLine => ({ rule, count, first_m, pitch_m });
  const from_m = -side_m / 2 + part_m / 2;
  const gap = room / (count + 1);
  const lines = [
    line("even", from_m + gap, part_m + gap),
    line("middle", (-(count - 1) * part_m) / 2, part_m),
    line("low", from_m, part_m),
    line("high", from_m + room, part_m),
  ];
  if (count > 1) lines.push(line("edges", from_m, (side_m - part_m) / (count - 1)));
  const pitch_m = ownPitch(count, part_m, side_m, seen_m);
  if (pitch_m !== undefined) lines.push(line("spaced", (-(count - 1) * pitch_m) / 2, pitch_m));
  return lines.map(each => {
    const slots = seen_m.map(at => slotOf(each, at));
    const misfit = seen_m.reduce(
      (sum, at, i) => sum + ((at - each.first_m - slots[i]! * each.pitch_m) / HAND_M) ** 2,
      0,
    );
    return { ...each, slots, misfit: misfit + (each.rule === "spaced" ? SPACED_COST : 0) };
  });
}

const slotOf = ({ count, first_m, pitch_m }: GridLine, at_m: number): number =>
  Math.max(0, Math.min(count - 1, Math.round((at_m - first_m) / pitch_m)));

/**
 * The pitch about the middle that fits best: whichever place the part farthest out may lie at, by least squares over
 * all of them.
 */
function ownPitch(count: number, part_m: number, side_m: number, seen_m: readonly number[]): number | undefined {
  if (count < 2) return undefined;
  const middle = (count - 1) / 2;
  const most_m = (side_m - part_m) / (count - 1);
  const farthest_m = Math.max(...seen_m.map(Math.abs));
  let best: number | undefined;
  let least = Infinity;
  for (let outermost = middle; outermost > 0; outermost--) {
    const guess_m = Math.max(part_m, Math.min(most_m, farthest_m / outermost));
    const slots = seen_m.map(at => Math.round(at / guess_m + middle) - middle);
    const along = seen_m.reduce((sum, at, i) => sum + slots[i]! * at, 0);
    const squares = slots.reduce((sum, slot) => sum + slot * slot, 0);
    const pitch_m = squares > 0 ? Math.max(part_m, Math.min(most_m, along / squares)) : guess_m;
    const left = seen_m.reduce((sum, at, i) => sum + (at - slots[i]! * pitch_m) ** 2, 0);
    if (left < least) [least, best] = [left, pitch_m];
  }
  return best;
}

const classOf = (rule: GridRule): string => (rule === "low" || rule === "high" ? "end" : rule);

export interface FittedGrid {
  readonly x: FittedLine;
  readonly y: FittedLine;
  /** Of the whole grid, so that several can be compared. */
  readonly cost: number;
}

/**
 * The grid of a surface that explains best where parts were put down.
 *
 *   cost = Σ (r_x² + r_y²) / σ² + 2 n ln(places) + (rules differ ? 6 : 0),   σ = 3 mm
 *
 * The second term keeps a finer grid, which is near to anything, from being believed for that alone.
 *
 * @param size_m   of the surface along x and y.
 * @param part_m   of the part along x and y, as it lies there.
 * @param seen_m   where its middle was put, from the middle of the surface.
 * @param places   how many there are; undefined: to be found as well.
 */
export function fittedGrid(
  size_m: readonly [number, number],
  part_m: readonly [number, number],
  seen_m: readonly (readonly [number, number])[],
  places?: number,
): FittedGrid | undefined {
  const most = size_m.map((side, k) => Math.floor(side / part_m[k]! + 1e-9)) as [number, number];
  const lines = ([0, 1] as const).map(k =>
    Array.from({ length: most[k] }, (_, i) =>
      fittedLines(
        size_m[k],
        part_m[k],
        i + 1,
        seen_m.map(at => at[k]),
      ),
    ),
  );
  let best: FittedGrid | undefined;
  for (const xs of lines[0]!)
    for (const ys of lines[1]!) {
      const count = (xs[0]?.count ?? 0) * (ys[0]?.count ?? 0);
      if (places !== undefined && count !== places) continue;
      for (const x of xs)
        for (const y of ys) {
          const keys = new Set(x.slots.map((slot, i) => `${slot} ${y.slots[i]!}`));
          if (keys.size < seen_m.length) continue;
          const mixed = x.count > 1 && y.count > 1 && classOf(x.rule) !== classOf(y.rule);
          const cost = x.misfit + y.misfit + 2 * seen_m.length * Math.log(count) + (mixed ? MIXED_COST : 0);
          if (cost < (best?.cost ?? Infinity) - 1e-9) best = { x, y, cost };
        }
    }
  return best;
}
