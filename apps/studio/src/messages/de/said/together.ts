import type { Sentences } from "../../sentences.ts";

/** German: what is said of a cell that several people edit. */
export const saidTogether: Sentences = {
  "You may look at this cell, and not change it.": "Sie dürfen diese Zelle ansehen und nicht ändern.",
  "You may write comments on steps of this cell, and not change it.":
    "Sie dürfen Schritte dieser Zelle kommentieren und sie nicht ändern.",
  "What you changed does not fit with what others did.":
    "Was Sie geändert haben, passt nicht zu dem, was andere getan haben.",
  "This change builds on one that never came here.": "Diese Änderung baut auf einer auf, die nie hier ankam.",
  "With what others did the cell would be wrong: {why}":
    "Mit dem, was andere getan haben, wäre die Zelle fehlerhaft: {why}",
  "This is no change of a cell: {why}.": "Das ist keine Änderung einer Zelle: {why}.",
};
