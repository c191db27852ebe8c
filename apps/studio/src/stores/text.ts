import type { TextPoint } from "@twincell/languages";
import { createStore } from "zustand/vanilla";
import type { LinePlace, ReadTextProgram } from "../workers/text-messages.ts";

/** What is known of the vendor text that is worked on. The text itself is in the document. */
export interface TextState {
  /** Text side by side with the 3D view, or the view alone with its panels. */
  readonly layout: "side" | "3d";
  readonly reading: boolean;
  readonly read: ReadTextProgram | null;
  readonly trouble: string | null;
  /** Where the person is in the text. */
  readonly cursor: LinePlace;
  /** The texts as they were opened or last exported, by the name of the program: what changed since is shown. */
  readonly base: Readonly<Record<string, readonly string[]>>;
}
export const textStore = createStore<TextState>(() => ({
  layout: "side",
  reading: false,
  read: null,
  trouble: null,
  cursor: { file: 0, line: 1 },
  base: {},
}));

export const pointsOf = ({ read }: Pick<TextState, "read">): readonly TextPoint[] =>
  read?.points.kind === "found" ? read.points.points : [];

/** The point of a line: the one it goes to, or the one whose value stands there. */
export const pointAt = (points: readonly TextPoint[], { file, line }: LinePlace): TextPoint | undefined =>
  points.find(({ uses }) => uses.some(use => use.file === file && (use.line === line || use.motionLine === line))) ??
  points.find(({ value }) => value.file === file && value.line === line);

/** The first step that goes to a point, in the order of execution; undefined when the text never gets there. */
export function stepOfPoint({ read }: Pick<TextState, "read">, point: TextPoint): string | undefined {
  return read?.places.find(([, place]) =>
    point.uses.some(use => use.whole && use.file === place.file && use.motionLine === place.line),
  )?.[0];
}

export const stepAt = ({ read }: Pick<TextState, "read">, { file, line }: LinePlace): string | undefined =>
  read?.places.find(([, place]) => place.file === file && place.line === line)?.[0];

export const placeOf = ({ read }: Pick<TextState, "read">, step: string): LinePlace | undefined =>
  read?.places.find(([id]) => id === step)?.[1];
