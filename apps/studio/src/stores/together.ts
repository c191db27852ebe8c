import type { Editor, EditingRight } from "@twincell/project/sharing";
import { createStore } from "zustand/vanilla";

/** The open cell as others edit it at the same time. */
export interface TogetherState {
  /** "off": the cell is this browser's own. "offline": the server is out of reach, edits are merged later. */
  readonly state: "off" | "opening" | "online" | "offline";
  /** Name of the cell on the server. */
  readonly cell: string;
  /** As the others see this person. */
  readonly who: string;
  readonly right: EditingRight;
  /** Changes that the server has not confirmed yet. */
  readonly waiting: number;
  /** The others. */
  readonly editors: readonly Editor[];
}
export const ALONE: TogetherState = { state: "off", cell: "", who: "", right: "write", waiting: 0, editors: [] };
export const togetherStore = createStore<TogetherState>(() => ALONE);

/** Of people, and of nothing else on the screen. */
const COLOURS = ["#7fb2e5", "#c7a26b", "#8fc98b", "#d98c9f", "#9aa7d9", "#c9c36a", "#6fc2c0", "#b08fb0"];
export const colourOf = ({ connection }: Pick<Editor, "connection">): string => COLOURS[connection % COLOURS.length]!;

type Point = readonly [number, number, number];
let pointing: (at_m: Point | null) => void = () => undefined;
/** Who shows the others where this person points; nobody while the cell is not shared. */
export const onPoint = (tell: (at_m: Point | null) => void): void => {
  pointing = tell;
};
/** This person points at a place of the world [m], or nowhere. */
export const pointAt = (at_m: Point | null): void => pointing(at_m);
