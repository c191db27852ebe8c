import { joinedMesh } from "./finish.ts";
import type { ImportedPart } from "./part.ts";

/**
 * Parts with at most so many different colours (T-50): colours that lie nearest to each other become one, weighted by
 * their triangles. Names, places and shapes stay.
 *
 * @param most  colours to keep, at least 1.
 */
export function withFewColors(parts: readonly ImportedPart[], most = 20): readonly ImportedPart[] {
  let colors = [...weights(parts)].map(([color, weight]) => ({ members: [color], rgb: channelsOf(color), weight }));
  if (colors.length <= most) return parts;
  // Thousands of colours are brought to a coarse grid first: comparing every pair takes the square of their number.
  if (colors.length > 400) colors = gathered(colors);
  while (colors.length > most) {
    let best: readonly [number, number] = [0, 1];
    let least = Infinity;
    for (let i = 0; i < colors.length; i++)
      for (let j = i + 1; j < colors.length; j++) {
        const distance = Math.hypot(...colors[i]!.rgb.map((value, k) => value - colors[j]!.rgb[k]!));
        if (distance < least) {
          least = distance;
          best = [i, j];
        }
      }
    const [a, b] = [colors[best[0]]!, colors[best[1]]!];
    colors = [...colors.filter(each => each !== a && each !== b), mixed(a, b)];
  }
  const newOf = new Map(colors.flatMap(({ members, rgb }) => members.map(member => [member, hexOfChannels(rgb)])));
  return parts.map(part => ({ ...part, color: newOf.get(part.color) ?? part.color }));
}

/**
 * All parts of one colour as one part, named after the file: for assemblies with too many parts to be handled one by
 * one.
 */
export function mergedByColor(parts: readonly ImportedPart[], name: string): readonly ImportedPart[] {
  const colors = [...new Set(parts.map(({ color }) => color))];
  return colors.map((color, i) => ({
    name: colors.length === 1 ? name : `${name} ${i + 1}`,
    path: [],
    color,
    mesh: joinedMesh(parts.filter(part => part.color === color).map(({ mesh }) => mesh)),
  }));
}

/** More parts than this become one per colour in a cell, which is handled part by part. */
export const MOST_PARTS = 100;
export const MOST_MATERIALS = 20;

/** The parts as a cell takes them: at most 20 colours, and one part per colour where there are more than 100. */
export function partsForCell(parts: readonly ImportedPart[], name: string): readonly ImportedPart[] {
  const few = withFewColors(parts, MOST_MATERIALS);
  return few.length > MOST_PARTS ? mergedByColor(few, name) : few;
}

interface Cluster {
  readonly members: readonly string[];
  readonly rgb: readonly number[];
  readonly weight: number;
}

function weights(parts: readonly ImportedPart[]): Map<string, number> {
  const sums = new Map<string, number>();
  for (const { color, mesh } of parts) sums.set(color, (sums.get(color) ?? 0) + mesh.indices.length);
  return sums;
}
const channelsOf = (color: string): number[] => [1, 3, 5].map(at => Number.parseInt(color.slice(at, at + 2), 16));
const hexOfChannels = (rgb: readonly number[]): string =>
  `#${rgb.map(value => Math.round(value).toString(16).padStart(2, "0")).join("")}`;

function mixed(a: Cluster, b: Cluster): { members: string[]; rgb: number[]; weight: number } {
  const weight = a.weight + b.weight;
  return {
    members: [...a.members, ...b.members],
    rgb: a.rgb.map((value, k) => (value * a.weight + b.rgb[k]! * b.weight) / weight),
    weight,
  };
}

function gathered(colors: readonly Cluster[]): { members: string[]; rgb: number[]; weight: number }[] {
  const cells = new Map<string, { members: string[]; rgb: number[]; weight: number }>();
  for (const color of colors) {
    const key = color.rgb.map(value => value >> 6).join();
    const known = cells.get(key);
    cells.set(key, known ? mixed(known, color) : { ...color, members: [...color.members], rgb: [...color.rgb] });
  }
  return [...cells.values()];
}
