/** The library's joints are KUKA's axes: zero with the arm level in front, A1, A4 and A6 by the left hand. */
const AS_IN_LIBRARY = { signs: [1, 1, 1, 1, 1, 1], offsets_deg: [0, 0, 0, 0, 0, 0] };
const CONVENTIONS = { kuka_kr6r900sixx: AS_IN_LIBRARY, kuka_kr6_2: AS_IN_LIBRARY };
export const axisConvention = (robot) => CONVENTIONS[robot.id];
