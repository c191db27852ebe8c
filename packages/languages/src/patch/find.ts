import { fanucPoints } from "./fanuc.ts";
import { krlPoints } from "./krl.ts";
import type { FoundPoints, PatchFile, TextPoint } from "./points.ts";
import { rapidPoints } from "./rapid.ts";
import { urscriptPoints } from "./urscript.ts";

const FINDERS: Readonly<Record<string, (files: readonly PatchFile[]) => TextPoint[]>> = {
  krl: krlPoints,
  rapid: rapidPoints,
  urscript: urscriptPoints,
  "fanuc-ls": fanucPoints,
};

/** Why the points of a language are not found yet. */
const NOT_YET: Readonly<Record<string, string>> = {
  "v-plus":
    "The taught points of V+ are kept in the controller, or in a location list that is not read as a sibling yet.",
  inform: "Positions of INFORM jobs are pulses or lists by number (C00000, P00000), which are not found yet.",
  val3: "Points of VAL 3 are kept in a .dtx file, whose XML is not patched yet.",
  "kawasaki-as": "Points of AS are kept in the .TRANS and .JOINTS blocks of a save file, which are not found yet.",
  spel: "Points of SPEL+ are kept in .pts files, which are not found yet.",
  "melfa-basic": "Points of MELFA-BASIC are position lines behind the program, which are not found yet.",
  pacscript: "Points of PacScript are the controller's P, J and T variables, which are not found yet.",
  "l-irl": "A pose list is points and nothing else: open it as poses.",
};

/** The taught points of a project's files, with the place of every number. */
export function findPoints(language: string, files: readonly PatchFile[]): FoundPoints {
  const find = FINDERS[language];
  return find === undefined
    ? { kind: "not-yet", because: NOT_YET[language] ?? `The points of the language ${language} are not found yet.` }
    : { kind: "found", points: find(files) };
}
