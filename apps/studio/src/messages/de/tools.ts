import type { Translation } from "../catalogue.ts";
import type { tools as english } from "../en/tools.ts";

/** Werkzeuge des Roboters. */
export const tools: Translation<typeof english> = {
  "mounted(name)": "{name} ist am Flansch.",
  "mountedHint(old)": "Geteachtes behält {old}: im Inspektor tauschen, um es mit dem neuen Werkzeug auszuführen.",
  "takesOver(old)": "Übernehmen, was mit {old} geteacht wurde",
  takesOverSays:
    "Die Spitze dieses Werkzeugs fährt dorthin, wo die andere war; Bahn und Kollisionen werden neu geprüft.",
  "exchanged(from, to, points: number)": "{to} übernimmt von {from}: {points, plural, one {# Punkt} other {# Punkte}}.",
  undoExchange: "Werkzeug tauschen",
  "makeTool(name)": "{name} zum Werkzeug machen",
  makeToolSays: "Sein Koordinatensystem kommt an den Flansch, z von ihm weg; die Spitze liegt an seinem Ende.",
  gripperUrdfSays: "Ein angetriebenes Gelenk und fünf, die ihm folgen, mit Massen und Trägheiten.",
  remove: "Dieses Werkzeug entfernen",
  "stillUsed(name, points: number)":
    "{name} bleibt: {points, plural, one {# Punkt wurde} other {# Punkte wurden}} damit geteacht. Zuerst tauschen.",
  bare: "bloßer Flansch",
};
