import { createStore } from "zustand/vanilla";

/** A program text from elsewhere that is run as it stands (row L-67). */
export interface ForeignText {
  readonly name: string;
  readonly dialect: string;
  readonly text: string /** What is not understood is left out. */;
  readonly skipUnknown?: boolean;
  /** It is the program of the cell that is worked on: closed and edited there. */
  readonly ofCell?: true;
}
export interface ForeignState {
  readonly open: ForeignText | null;
  /** "paused": it stands before `line`, at a breakpoint or after a single step. */
  readonly phase: "idle" | "running" | "paused";
  readonly line: number;
  readonly breakpoints: ReadonlySet<number>;
  /** What the person types or pastes, kept while the dialog is closed. */
  readonly draft: { readonly text: string; readonly name: string };
}
export const foreignStore = createStore<ForeignState>(() => ({
  open: null,
  phase: "idle",
  line: 0,
  breakpoints: new Set(),
  draft: { text: "", name: "" },
}));

export const openForeign = (open: ForeignText): void =>
  foreignStore.setState({ open, phase: "idle", line: 0, breakpoints: new Set() });
export const toggleBreakpoint = (line: number): void =>
  foreignStore.setState(({ breakpoints }) => {
    const next = new Set(breakpoints);
    if (!next.delete(line)) next.add(line);
    return { breakpoints: next };
  });
