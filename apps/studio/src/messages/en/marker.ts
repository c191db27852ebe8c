/** The view through the camera, with the cell on a printed marker. */
export const marker = {
  title: "AR on a marker",
  command: "AR on a printed marker …",
  close: "Leave AR",
  asking: "The browser asks whether the camera may be used …",
  looking: "The marker is not in sight. Print it, lay it where the robot's base stands, and aim the camera at it.",
  "seen(m: number, px: number, s: number)":
    "Marker at {m, number, ::.00 group-off} m, {px, number, ::.00 group-off} px, " +
    "{s, number, ::scale/1000 precision-integer group-off} ms a picture.",
  again: "Try again",
  settings: "Size, marker and lens",
  scale: "Size",
  scales: { "1": "1:1", "0.5": "1:2", "0.2": "1:5", "0.1": "1:10" },
  objects: "What is drawn",
  robotOnly: "Robot only",
  wholeCell: "Whole cell",
  side: "Side of the marker",
  sheet: "Marker to print",
  sheetTitle: "Twincell marker 0: the robot's base stands on it, its front (+x) to the right",
  sheetBelow: "Print at 100 %: this line is 100 mm long. Otherwise measure the black square and type its side.",
  carry: "Hold: the tool follows this device",
  carrying: "The tool follows. Let go to stop.",
  lens: {
    assumed: "Lens not calibrated: the distance may be off by 10 %.",
    calibrated: "Lens calibrated.",
  },
  board: "Board to print",
  boardTitle: "Twincell board for lens calibration: keep it flat",
  calibrate: "Calibrate lens",
  cancel: "Cancel",
  "views(n: number)":
    "{n} of 12 views. Hold the board still, then tilt it another way, by 20° to 40°, nearer and farther.",
  notKept: "The lens was calibrated but this browser's storage is full: it holds until the page closes.",
};
