import type { Translation } from "../catalogue.ts";
import type { marker as english } from "../en/marker.ts";

/** German: the view through the camera. */
export const marker = {
  title: "AR auf einem Marker",
  command: "AR auf einem gedruckten Marker …",
  close: "AR verlassen",
  asking: "Der Browser fragt, ob die Kamera benutzt werden darf …",
  looking:
    "Der Marker ist nicht im Bild. Ihn drucken, dort hinlegen, wo die Basis des Roboters steht, und die Kamera " +
    "darauf richten.",
  "seen(m: number, px: number, s: number)":
    "Marker in {m, number, ::.00 group-off} m, {px, number, ::.00 group-off} px, " +
    "{s, number, ::scale/1000 precision-integer group-off} ms je Bild.",
  again: "Noch einmal versuchen",
  settings: "Größe, Marker und Objektiv",
  scale: "Größe",
  scales: { "1": "1:1", "0.5": "1:2", "0.2": "1:5", "0.1": "1:10" },
  objects: "Was gezeichnet wird",
  robotOnly: "Nur Roboter",
  wholeCell: "Ganze Zelle",
  side: "Seite des Markers",
  sheet: "Marker zum Drucken",
  sheetTitle: "Twincell-Marker 0: darauf steht die Basis des Roboters, vorn (+x) ist rechts",
  sheetBelow: "Mit 100 % drucken: diese Linie ist 100 mm lang. Sonst das schwarze Quadrat messen und eintragen.",
  carry: "Halten: das Werkzeug folgt diesem Gerät",
  carrying: "Das Werkzeug folgt. Loslassen hält an.",
  lens: {
    assumed: "Objektiv nicht kalibriert: der Abstand kann um 10 % abweichen.",
    calibrated: "Objektiv kalibriert.",
  },
  board: "Tafel zum Drucken",
  boardTitle: "Twincell-Tafel zum Kalibrieren des Objektivs: flach halten",
  calibrate: "Objektiv kalibrieren",
  cancel: "Abbrechen",
  "views(n: number)":
    "{n} von 12 Ansichten. Die Tafel ruhig halten, dann anders neigen, um 20° bis 40°, näher und weiter weg.",
  notKept: "Das Objektiv ist kalibriert, aber der Speicher des Browsers ist voll: es gilt, bis die Seite schließt.",
} satisfies Translation<typeof english>;
