import type { SerialArm } from "../model/arm.ts";
import { seededRandom } from "../random.ts";
import { CellCollider } from "./cell-collider.ts";
import type { CellGeometry } from "./cell.ts";
import type { PairEntry, PairMatrix, PairReason } from "./pairs.ts";

/**
 * Learns the matrix of links and tool from random postures inside the joint limits. The same seed gives the same
 * matrix.
 *
 * @param free_rad  a posture known to be free, such as home: what touches there does so by design.
 */
export function learnPairs(
  cell: CellGeometry,
  arm: SerialArm,
  seed: number,
  samples: number,
  free_rad?: ArrayLike<number>,
): PairMatrix {
  const collider = new CellCollider({ ...cell, objects: [], pairs: { seed, entries: [] } }, arm);
  const random = seededRandom(seed);
  const q = new Float64Array(arm.joints.length);
  const parts = [...new Set(cell.links.map(({ link }) => link))].sort((a, b) => a - b).map(link => `link ${link}`);
  if (cell.tool) parts.push("tool");
  const touches = new Map<string, number>(collider.pairs.map(({ contact: { a, b } }) => [keyOf(a, b), 0]));
  for (let i = 0; i < samples; i++) {
    arm.joints.forEach(({ limits: { lower_rad, upper_rad } }, k) => {
      q[k] = lower_rad + random() * (upper_rad - lower_rad);
    });
    for (const { a, b } of collider.check(q)) touches.set(keyOf(a, b), touches.get(keyOf(a, b))! + 1);
  }
  const atHome = new Set(free_rad === undefined ? [] : collider.check(free_rad).map(({ a, b }) => keyOf(a, b)));
  const allowed = new Set(cell.allowedPairs.map(([a, b]) => keyOf(a, b)));
  const entries: PairEntry[] = [];
  parts.forEach((a, i) => {
    for (const b of parts.slice(i + 1)) {
      const met = touches.get(keyOf(a, b));
      if (met === undefined) {
        entries.push({
          a,
          b,
          reason: allowed.has(keyOf(a, b)) ? "allowed" : "adjacent",
          samples: 0,
          touches: 0,
          watched: false,
        });
        continue;
      }
      const reason: PairReason =
        met === 0 ? "never seen" : met === samples ? "always" : atHome.has(keyOf(a, b)) ? "at home" : "sometimes";
      entries.push({ a, b, reason, samples, touches: met, watched: reason === "sometimes" || reason === "never seen" });
    }
  });
  return { seed, entries };
}

/** The matrix with one pair watched or not, as a person decides; a pair of neighbours stays unwatched. */
export const editPair = ({ seed, entries }: PairMatrix, a: string, b: string, watched: boolean): PairMatrix => ({
  seed,
  entries: entries.map(entry =>
    keyOf(entry.a, entry.b) === keyOf(a, b) && entry.reason !== "adjacent" ? { ...entry, watched } : entry,
  ),
});

/** What `CellGeometry.allowedPairs` takes: every pair of the matrix that is not watched. */
export const allowedPairs = ({ entries }: PairMatrix): [string, string][] =>
  entries.filter(({ watched }) => !watched).map(({ a, b }) => [a, b]);

const keyOf = (a: string, b: string): string => (a < b ? `${a}\n${b}` : `${b}\n${a}`);
