/** The teaching page of a phone. */
export const phone = {
  title: "Teach by touch",
  steps: "Steps",
  noSteps: "No step yet: hold the switch, move the tool, then PTP or LIN.",
  move: "Move",
  turn: "Turn",
  pad: "What the pad does",
  "padOf(up, left)": "Pad: up is {up}+, left is {left}+",
  "rockerOf(axis)": "Rocker: {axis}",
  open: "Open",
  close: "Close",
  enabled: "Enabled while held",
  letGo: "Drives on, let go to stop",
  holdHint: "Then move the pad with the other thumb",
  holdFirst: "Hold the enabling switch with the other thumb first.",
};
