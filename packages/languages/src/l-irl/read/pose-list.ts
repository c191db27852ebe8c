import type { Group, Pose, Step } from "@twincell/core";

/** A pose that the list names. */
export interface NamedPose {
  readonly worldFromTcp: Pose<"world", "tcp">;
  readonly line: number;
}

/** A list as it was read. Names are as they stand in the text. */
export interface PoseList {
  readonly program: string;
  readonly tools: ReadonlyMap<string, Pose<"flange", "tcp">>;
  readonly frames: ReadonlyMap<string, Pose<"world", "frame">>;
  readonly groups: ReadonlyMap<string, Group>;
  readonly poses: ReadonlyMap<string, NamedPose>;
  readonly steps: readonly { readonly line: number; readonly step: Step }[];
}
