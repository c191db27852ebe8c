/**
 * Which of the (up to) eight arm postures. Named as a person sees them; vendors' own words live in their dialect.
 * shoulder: the wrist centre is in front of the shoulder axis or behind it. elbow: above or below the line
 * shoulder–wrist. wrist: sign of the wrist-bend angle in the formula's own zero.
 */
export interface Branch {
  readonly shoulder: "front" | "back";
  readonly elbow: "up" | "down";
  readonly wrist: "positive" | "negative";
}
