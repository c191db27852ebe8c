import { createStore } from "zustand/vanilla";

/** Which panels stand in the room of a headset, besides the menu on the wrist. */
export interface RoomState {
  readonly cameras: boolean;
  readonly history: boolean;
  /** Numbers are typed. */
  readonly keypad: boolean;
}
export const roomStore = createStore<RoomState>(() => ({ cameras: true, history: false, keypad: false }));
export const toggleRoom = (panel: keyof RoomState): void => roomStore.setState(state => ({ [panel]: !state[panel] }));
