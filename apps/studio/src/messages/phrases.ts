import { words } from "./index.ts";

/** A solid of the collision check as a person reads it: an object by its name, the tool, a link by its number. */
export function solidName(id: string, objects: readonly { readonly id: string; readonly name: string }[]): string {
  const object = objects.find(each => each.id === id);
  if (object) return words.collide.solid(object.name);
  const link = /^link (\d+)$/.exec(id)?.[1];
  return id === "tool" ? words.collide.solidTool : link === undefined ? id : words.collide.solidLink(Number(link));
}

/** What of a text was left out, the worst of it by name. */
export function skippedWords(all: readonly { readonly what: "motion" | "branch" | "statement" }[]): string {
  const count = (what: string): number => all.filter(each => each.what === what).length;
  const motions = count("motion");
  const branches = count("branch");
  if (motions + branches === 0) return words.foreign.skipped(all.length);
  const ofMotions = words.foreign.skippedMotions(motions);
  const ofBranches = words.foreign.skippedBranches(branches);
  const worst =
    motions > 0 && branches > 0
      ? words.foreign.skippedBoth(ofMotions, ofBranches)
      : motions > 0
        ? ofMotions
        : ofBranches;
  return words.foreign.skippedWorst(all.length, worst);
}

/** How old a picture is. */
export const ageWords = (age_s: number): string =>
  Number.isNaN(age_s) ? words.video.ageUnknown : words.video.ms(age_s);

/** A text that begins a sentence. */
export const capital = (text: string): string => `${text.charAt(0).toUpperCase()}${text.slice(1)}`;

const PARTS: Readonly<Record<string, string>> = words.parts.names;

/** What a part of the library is called. */
export const partName = (part: string): string => PARTS[part] ?? part;
