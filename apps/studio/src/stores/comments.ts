import type { CellDocument, StepComment } from "@twincell/project";
import { cellStore } from "./cell.ts";
import { commit } from "./document.ts";
import { sessionStore } from "./session.ts";
import { togetherStore } from "./together.ts";
import { words } from "../messages/index.ts";

/** Comments on one step of a program, oldest first. */
export const commentsOn = (document: CellDocument | null, program: string, step: string): readonly StepComment[] =>
  (document?.comments ?? [])
    .filter(each => each.program === program && each.step === step)
    .toSorted((a, b) => (a.at < b.at ? -1 : 1));

/** How many comments on a step of the program that is worked on wait to be done. */
export const openComments = ({ document }: { readonly document: CellDocument | null }, step: string): number =>
  document?.comments === undefined
    ? 0
    : document.comments.filter(each => each.step === step && each.program === document.program && !each.done).length;

/** In whose name this person writes. */
export const whoAmI = (): string =>
  togetherStore.getState().who || (sessionStore.getState().info?.name ?? words.together.me);

export function addComment(step: string, text: string): boolean {
  const plain = text.trim();
  const program = cellStore.getState().document?.program;
  if (plain === "" || program === undefined) return false;
  const comment: StepComment = {
    id: Array.from(crypto.getRandomValues(new Uint8Array(9)), byte => byte.toString(36).padStart(2, "0")).join(""),
    program,
    step,
    who: whoAmI(),
    at: new Date().toISOString(),
    text: plain,
  };
  return commit(words.together.undoAdd, document => ({
    ...document,
    comments: [...(document.comments ?? []), comment],
  }));
}
export function setCommentDone(id: string, done: boolean): void {
  commit(words.together.undoDone, document => ({
    ...document,
    comments: (document.comments ?? []).map((each): StepComment => {
      if (each.id !== id) return each;
      const { done: _, ...open } = each;
      return done ? { ...open, done } : open;
    }),
  }));
}
/** A cell without comments says nothing of them, as cells did before there were any. */
export function removeComment(id: string): void {
  commit(words.together.undoRemove, document => {
    const { comments = [], ...rest } = document;
    const left = comments.filter(each => each.id !== id);
    return left.length > 0 ? { ...rest, comments: left } : rest;
  });
}
