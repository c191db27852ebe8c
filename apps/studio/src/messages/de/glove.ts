import type { Translation } from "../catalogue.ts";
import type { glove as english } from "../en/glove.ts";

/** German: a glove with a tracker on a serial line. */
export const glove = {
  title: "Handschuh",
  command: "Handschuh: verbinden, kalibrieren, aufnehmen …",
  connect: "Verbinden …",
  disconnect: "Trennen",
  unsupported:
    "Dieser Browser hat keine seriellen Leitungen. Chrome oder Edge nehmen, oder twincell demonstrate raw mit " +
    "einer aufgenommenen Datei.",
  "notOpened(why)": "Die Leitung des Handschuhs ließ sich nicht öffnen: {why}",
  lost: "Der Handschuh ist weg. Der Roboter wurde nicht bewegt.",
  lostHint: "Einstecken und wieder verbinden; was bis dahin aufgenommen wurde, bleibt.",
  notKept: "Der Browser konnte das Profil nicht behalten; es bleibt, bis die Seite geschlossen wird.",
  none: "Kein Handschuh ist verbunden. Er sendet Zeilen mit 115 200 Baud (docs/glove.md).",
  "reads(samples: number, hertz, dropped: number)":
    "{samples, number} Messwerte · {hertz} je Sekunde · {dropped, number} ausgelassen",
  wearer: "Getragen von",
  nobody: "noch niemand",
  fingers: ["Daumen", "Zeigefinger", "Mittelfinger", "Ringfinger", "Kleiner Finger"],
  hand: { open: "offen: ablegen", closed: "geschlossen: greifen" },
  calibrate: "Neues Profil …",
  sweepSays: "1. Die Hand einige Male ganz öffnen und schließen.",
  restSays: "2. Die Hand ruhig ablegen, dann die Ruhe nehmen.",
  rest: "Ruhe nehmen",
  slopeSays: "3. Empfindlichkeit des Trackers, aus seinem Datenblatt.",
  slope: "m/s² je Volt",
  name: "Name",
  keep: "Profil behalten",
  "counts(n: number)": "{n} Stufen",
  record: "Aufnehmen",
  stop: "Aufnahme beenden",
} satisfies Translation<typeof english>;
