import type { ImportFormat, UnitGuess } from "./part.ts";

/** Nothing in a robot cell is longer: longer numbers are no metres. */
const LONGEST_M = 100;
/** A part whose longest side counts less than this is hardly given in millimetres. */
const SHORTEST_MM = 3;
/** What a stated unit may lead to without a question [m]. */
const PLAUSIBLE_M = [0.001, 100] as const;

/**
 * How many metres a unit of the file is.
 *
 * A unit that the file states counts. Else the longest side L decides: L > 100 can be no metres, L < 3 hardly
 * millimetres; between the two both are possible (a 9 mm part, a 12 m scan), and the answer is `doubtful`: a person has
 * to say.
 *
 * @param longest  longest side of the box around everything, in the file's units.
 * @param stated   metres per unit as the file says.
 * @param chosen   metres per unit as a person says: always taken.
 */
export function guessUnit(
  format: ImportFormat,
  longest: number,
  stated: number | undefined,
  chosen: number | undefined,
): UnitGuess {
  if (chosen !== undefined)
    return { metresPerUnit: chosen, certainty: "chosen", sentence: `The unit was chosen: ${unitText(chosen)}.` };
  if (stated !== undefined) {
    const size_m = longest * stated;
    const isPlausible = longest === 0 || (size_m >= PLAUSIBLE_M[0] && size_m <= PLAUSIBLE_M[1]);
    return {
      metresPerUnit: stated,
      certainty: isPlausible ? "stated" : "doubtful",
      sentence: isPlausible
        ? `The file states its unit: ${unitText(stated)}.`
        : `The file states its unit (${unitText(stated)}), but that makes it ${lengthText(size_m)} long.`,
    };
  }
  if (longest > LONGEST_M)
    return {
      metresPerUnit: 0.001,
      certainty: "likely",
      sentence: `${format} files state no unit; ${lengthText(longest)} would be too long for a cell, so millimetres are taken: ${lengthText(longest * 0.001)}.`,
    };
  if (longest < SHORTEST_MM)
    return {
      metresPerUnit: 1,
      certainty: "likely",
      sentence: `The file states no unit; in millimetres the longest side would be ${lengthText(longest * 0.001)}, so metres are taken: ${lengthText(longest)}.`,
    };
  // Scanners write metres, CAD systems millimetres.
  const metresPerUnit = format.startsWith("PLY") || format === "COLLADA" ? 1 : 0.001;
  return {
    metresPerUnit,
    certainty: "doubtful",
    sentence: `The file states no unit: the longest side is ${lengthText(longest)} if it counts in metres, ${lengthText(longest * 0.001)} if in millimetres. ${unitText(metresPerUnit).replace(/^./, letter => letter.toUpperCase())} are taken.`,
  };
}

/** A unit in words, in the plural. @param metresPerUnit  its length [m]. */
export function unitText(metresPerUnit: number): string {
  const known = [
    [1, "metres"],
    [0.1, "decimetres"],
    [0.01, "centimetres"],
    [0.001, "millimetres"],
    [0.0254, "inches"],
    [0.3048, "feet"],
  ] as const;
  const found = known.find(([length]) => Math.abs(metresPerUnit / length - 1) < 1e-6);
  return found ? found[1] : `units of ${Number(metresPerUnit.toPrecision(6))} m`;
}

/** A length as people write it: m from 1 m on, else mm. */
export const lengthText = (length_m: number): string =>
  length_m >= 1 ? `${Number(length_m.toPrecision(4))} m` : `${Number((length_m * 1000).toPrecision(4))} mm`;
