/** Who touches whom: bits of contype and conaffinity. The robot's own pairs are judged elsewhere, exactly. */
export const CONTACT = {
  robot: { contype: 1, conaffinity: 6 },
  fixture: { contype: 2, conaffinity: 5 },
  part: { contype: 4, conaffinity: 7 },
  none: { contype: 0, conaffinity: 0 },
} as const;

/** Groups by which rays tell what they hit. */
export const GROUP = { fixture: 0, part: 1, robot: 2, person: 3, sensor: 4 } as const;
