import type { Robot } from "@twincell/core";

/**
 * How V+ counts the joints of a robot:  joint_deg = sign · degrees(q) + offset_deg.  One line per robot whose
 * controller speaks V+; a robot without a line is refused instead of guessed.
 */
export interface JointConvention {
  readonly signs: readonly number[];
  readonly offsets_deg: readonly number[];
}

const CONVENTIONS: Readonly<Record<string, JointConvention>> = {
  // The library's zero of the RX90L is V+'s own: home is 0, −90, 90, 0, 0, 0 in both.
  staubli_rx90l: { signs: [1, 1, 1, 1, 1, 1], offsets_deg: [0, 0, 0, 0, 0, 0] },
};

export const jointConvention = (robot: Robot): JointConvention | undefined => CONVENTIONS[robot.id];
