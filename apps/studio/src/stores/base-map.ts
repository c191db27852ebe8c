import type { BaseField, SuggestedBase, Vector3 } from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** From where on the floor the program could be carried out. */
export interface BaseMapState {
  readonly on: boolean;
  readonly field: BaseField | null;
  /** Where the robot stood when it was made, in the world [m]. */
  readonly from_m: Vector3;
  /** null: none is good; undefined: not known yet. */
  readonly best: SuggestedBase | null | undefined;
  /** 0 … 1 while it is made; null when it is done. */
  readonly share: number | null;
}
export const baseMapStore = createStore<BaseMapState>(() => ({
  on: false,
  field: null,
  from_m: [0, 0, 0],
  best: undefined,
  share: null,
}));
export const showBaseMap = (on: boolean): void => baseMapStore.setState({ on });
