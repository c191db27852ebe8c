import type { ImportReport, LightReport, UnitGuess } from "@twincell/formats";
import { importedFrom, type CellDocument, type ObjectRecord, type Shape } from "@twincell/project";
import { createStore } from "zustand/vanilla";
import type { KeptRobotFile } from "./own-robots.ts";

/** What is known of a file that was imported. */
export interface ShapeCard {
  readonly file: string;
  readonly unit: UnitGuess;
  readonly report: ImportReport;
  /** What came of making it light. */
  readonly light?: LightReport;
}
export interface FoundRobot {
  readonly name: string;
  readonly file: KeptRobotFile;
  readonly notes: readonly string[];
  /** Its links could also stand in the cell as parts. */
  readonly hasParts: boolean;
}
export interface ShapeState {
  /** The file that is being read or changed. */
  readonly busy: { readonly file: string; readonly what: "reading" | "changing" } | null;
  /** A robot that was read: the question is whether it becomes the robot of the cell. */
  readonly robot: FoundRobot | null;
  /** The file whose report is on screen. */
  readonly shown: string | null;
}
export const shapeStore = createStore<ShapeState>(() => ({ busy: null, robot: null, shown: null }));

/** By the very shapes they tell of: undo brings the old shapes back, and with them what was known of them. */
const cards = new WeakMap<Shape, ShapeCard>();

/** Keeps what is known of objects and shows it. */
export function keepCard(card: ShapeCard, objects: readonly ObjectRecord[]): void {
  for (const { shape } of objects) cards.set(shape, card);
  shapeStore.setState({ shown: card.file });
}

/** What is known of a file as it is in the cell now; undefined after the page was opened anew. */
export function cardOf(document: CellDocument | null, file: string | null): ShapeCard | undefined {
  if (!document || file === null) return undefined;
  for (const { shape } of importedFrom(document, file)) {
    const card = cards.get(shape);
    if (card) return card;
  }
  return undefined;
}
