import { createStore } from "zustand/vanilla";

/** The target sphere that the arm follows, and how far the tool is from it (rows ). */
export interface FollowTargetState {
  /** The jog keys, the keyboard and the gamepad move the sphere; the arm follows it. */
  readonly on: boolean;
  readonly kind: "on-target" | "behind" | "out-of-reach";
  /** From the tool tip to the sphere [m], to a tenth of a millimetre. */
  readonly off_m: number;
  /** From 1: the joint that sets the pace while the arm is behind; null otherwise. */
  readonly joint: number | null;
  /** Why the arm cannot get there; null where it can. */
  readonly why: string | null;
}
const AT_REST = { kind: "on-target", off_m: 0, joint: null, why: null } as const;
export const followTargetStore = createStore<FollowTargetState>(() => ({ on: false, ...AT_REST }));

export const showFollowTarget = (on: boolean): void => followTargetStore.setState({ on, ...AT_REST });

/** Says how following stands; tells nobody when nothing that is shown changed. */
export function tellFollowing(next: Omit<FollowTargetState, "on">): void {
  const off_m = Math.round(next.off_m * 1e4) / 1e4;
  const before = followTargetStore.getState();
  if (before.kind === next.kind && before.off_m === off_m && before.joint === next.joint && before.why === next.why)
    return;
  followTargetStore.setState({ ...next, off_m });
}
