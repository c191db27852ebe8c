/** Die Teach-Seite eines Telefons. */
export const phone = {
  title: "Teachen mit den Fingern",
  steps: "Schritte",
  noSteps: "Noch kein Schritt: Zustimmung halten, Werkzeug bewegen, dann PTP oder LIN.",
  move: "Ort",
  turn: "Drehung",
  pad: "Was das Feld bewegt",
  "padOf(up, left)": "Feld: oben ist {up}+, links ist {left}+",
  "rockerOf(axis)": "Wippe: {axis}",
  open: "Auf",
  close: "Zu",
  enabled: "Frei, solange gehalten",
  letGo: "Antriebe an, loslassen hält an",
  holdHint: "Dann mit dem anderen Daumen das Feld",
  holdFirst: "Zuerst mit dem anderen Daumen die Zustimmung halten.",
};
