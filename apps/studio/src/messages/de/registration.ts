import type { Translation } from "../catalogue.ts";
import type { registration as english } from "../en/registration.ts";

/** German: where a real robot stands in the cell. */
export const registration = {
  title: "Roboter einmessen",
  command: "Roboter in der Zelle einmessen …",
  says:
    "Die Spitze des Roboters auf 3 bis 6 Punkte fahren, deren Ort in der Zelle bekannt ist, um die Arbeit verteilt, " +
    "und jeden hinzufügen. Eintragen, wo der Punkt in der Zelle ist; der Rest kommt vom Roboter.",
  point: "Punkt",
  "pointOf(n: number)": "Punkt {n}",
  "axis(name)": "{name} in der Zelle, mm",
  off: "Ab, mm",
  add: "Punkt an der Spitze hinzufügen",
  touch: "Genauigkeit einer Berührung (1 σ)",
  "bound(mm)": "Dafür frei gehalten: {mm} mm (95 %, am größten an Basis und Punkten).",
  "kept(mm)":
    "Die Zelle hält jetzt {mm} mm für die Einmessung frei. Jeder Abstand, der geprüft oder überwacht wird, ist um so " +
    "viel kleiner.",
  apply: "Roboter dorthin stellen, Fehler in der Zelle behalten",
  again: "Noch einmal berühren",
  againTip: "Mit der Spitze wieder auf diesem Punkt: sagt, ob die Einmessung noch gilt",
  "remove(n: number)": "Punkt {n} entfernen",
} satisfies Translation<typeof english>;
