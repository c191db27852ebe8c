import type { Explanation, ProvenRepair, Verdict } from "@twincell/core";
import { createStore } from "zustand/vanilla";

/** A way out that is being looked at and not applied. */
export interface ShownRepair {
  readonly step: string;
  readonly repair: ProvenRepair;
  /** Its place in the list, from 0; it has the colour of its number. */
  readonly index: number;
  /** It stays when the pointer leaves. */
  readonly pinned: boolean;
}
export interface RepairState {
  /** The verdict that all of this is about; another one empties it. */
  readonly verdict: Verdict | null;
  /** By the id of the step. */
  readonly explanations: ReadonlyMap<string, Explanation>;
  readonly searching:
    | { readonly kind: "explain"; readonly step: string }
    | { readonly kind: "all"; readonly share: number }
    | null;
  /** The step whose ways out are open: 1, 2 and 3 show them. */
  readonly current: string | null;
  readonly shown: ShownRepair | null;
}
const NOTHING: RepairState = { verdict: null, explanations: new Map(), searching: null, current: null, shown: null };
export const repairStore = createStore<RepairState>(() => NOTHING);

/** Begins again with another verdict, or with none. */
export const forgetRepairs = (verdict: Verdict | null): void => repairStore.setState({ ...NOTHING, verdict });
export const showRepair = (shown: ShownRepair | null): void => {
  if (repairStore.getState().shown !== shown) repairStore.setState({ shown });
};
const offered = (index: number): ShownRepair | null => {
  const { current, explanations } = repairStore.getState();
  const repair = current === null ? undefined : explanations.get(current)?.repairs[index];
  return current === null || repair === undefined ? null : { step: current, repair, index, pinned: true };
};
/** Whether the open step has a way out of that number, from 0. */
export const repairOffered = (index: number): boolean => offered(index) !== null;
/** Shows that way out of the open step, or takes it away again where it is shown. */
export function toggleRepair(index: number): void {
  const next = offered(index);
  const { shown } = repairStore.getState();
  showRepair(shown?.pinned === true && shown.repair === next?.repair ? null : next);
}
