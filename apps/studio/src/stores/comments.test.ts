import { createHistory, edgeTraceCell } from "@twincell/project";
import { beforeEach, expect, test } from "vitest";
import { cellStore } from "./cell.ts";
import { addComment, commentsOn, openComments, removeComment, setCommentDone } from "./comments.ts";
import { commit, shareHistory, showDocument, undo } from "./document.ts";
import { dismissAll, noticeStore } from "./notices.ts";
import { ALONE, togetherStore } from "./together.ts";

const document = () => cellStore.getState().document!;
beforeEach(() => {
  togetherStore.setState(ALONE);
  dismissAll();
  showDocument(edgeTraceCell());
});

test("a comment stands on its step in the name of whoever wrote it, is done and open again, and goes with undo and removal without a trace", () => {
  const before = document();
  togetherStore.setState({ who: "Vic" });
  expect(addComment("s1", "  ")).toBe(false);
  expect(addComment("s1", " Too fast? ")).toBe(true);
  const [comment] = commentsOn(document(), document().program, "s1");
  expect(comment).toMatchObject({ who: "Vic", text: "Too fast?", program: document().program, step: "s1" });
  expect([openComments({ document: document() }, "s1"), openComments({ document: document() }, "s2")]).toEqual([1, 0]);
  setCommentDone(comment!.id, true);
  expect(openComments({ document: document() }, "s1")).toBe(0);
  setCommentDone(comment!.id, false);
  expect(openComments({ document: document() }, "s1")).toBe(1);
  removeComment(comment!.id);
  expect(document()).toEqual(before);
  expect(Object.hasOwn(document(), "comments")).toBe(false);
  undo();
  expect(openComments({ document: document() }, "s1")).toBe(1);
});

test("in a shared cell a change that its editor may not make changes nothing and is said; another cell ends the sharing once", () => {
  let ended = 0;
  shareHistory(createHistory(document()), {
    refuses: (_, after) => (after.name === "No" ? "You may look at this cell, and not change it." : null),
    ended: () => ended++,
  });
  expect(commit("name", cell => ({ ...cell, name: "No" }))).toBe(false);
  expect(document().name).toBe(edgeTraceCell().name);
  expect(noticeStore.getState().notices.map(({ sentence }) => sentence)).toEqual([
    "You may look at this cell, and not change it.",
  ]);
  expect(commit("name", cell => ({ ...cell, name: "Yes" }))).toBe(true);
  showDocument(edgeTraceCell());
  showDocument(edgeTraceCell());
  expect(ended).toBe(1);
  expect(commit("name", cell => ({ ...cell, name: "No" }))).toBe(true);
});
