/** Where a real robot stands in the cell. */
export const registration = {
  title: "Register the robot",
  command: "Register the robot in the cell …",
  says:
    "Drive the robot's tip to 3 to 6 points whose places in the cell are known, spread round the work, and add each. " +
    "Type where the point is in the cell; the rest is read from the robot.",
  point: "Point",
  "pointOf(n: number)": "Point {n}",
  "axis(name)": "{name} in the cell, mm",
  off: "Off, mm",
  add: "Add the point at the tip",
  touch: "A touch is good to (1 σ)",
  "bound(mm)": "Kept clear for it: {mm} mm (95 %, the largest at the base and at the points).",
  "kept(mm)":
    "The cell keeps {mm} mm for the registration now. Every distance that is checked or guarded is less by it.",
  apply: "Put the robot there, keep the error in the cell",
  again: "Touch again",
  againTip: "With the tip at this point again: says whether the registration still holds",
  "remove(n: number)": "Remove point {n}",
};
