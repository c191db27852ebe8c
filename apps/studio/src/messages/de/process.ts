import type { Translation } from "../catalogue.ts";
import type { process as english } from "../en/process.ts";

/** Von der leeren Zelle zum laufenden Roboter. */
export const process = {
  title: "In sechs Schritten zur Zelle",
  "done(n: number, of: number)": "{n} von {of}",
  isDone: "erledigt",
  steps: {
    objects: { title: "Objekte", says: "Teile aus der Bibliothek unten in die Zelle ziehen oder eigenes CAD laden." },
    kinematics: {
      title: "Kinematik",
      says: "Den Roboter wählen oder aus importierten Teilen bauen und ein Werkzeug an den Flansch setzen.",
    },
    interactions: {
      title: "Wechselwirkungen",
      says: "Werkstücken diese Rolle geben, Förderer laufen lassen und sagen, welche Paare sich berühren dürfen.",
    },
    scenario: { title: "Ablauf", says: "Dem Roboter zeigen, was er tut: Punkte aufnehmen oder Kanten abfahren." },
    run: {
      title: "Simulieren",
      says: "Hier abspielen: Jede Bewegung wird auf Reichweite, Tempo und Kollision geprüft.",
    },
    execute: {
      title: "Ausführen und korrigieren",
      says: "Auf einer Steuerung ausführen, Befunde ansehen und berichtigen.",
    },
  },
  bringCad: "Eigenes CAD laden",
  chooseRobot: "Roboter wählen",
  makeRobot: "Roboter aus Teilen bauen",
  pairs: "Paare, die sich berühren dürfen",
  teach: "Zu Teachen",
  play: "Abspielen",
  execute: "Zu Ausführen",
  correct: "Zu Prüfen",
} satisfies Translation<typeof english>;
