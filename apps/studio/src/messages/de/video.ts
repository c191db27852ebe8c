import type { Translation } from "../catalogue.ts";
import type { videoWords as english } from "../en/video.ts";

/** German: cameras. */
export const videoWords = {
  title: "Kameras",
  command: "Kameras …",
  tip: "Das Bild des realen Roboters neben dem Zwilling",
  none: "Noch zeigt sich keine Kamera.",
  show: "Zeigen",
  shown: "Gezeigt",
  here: "Kamera dieses Rechners",
  hereSays: "Der Browser fragt nach ihr. Das Bild bleibt auf diesem Rechner.",
  other: "Über den Server",
  phone: "Telefon oder anderen Rechner hinzufügen",
  phoneSays:
    "Diese Adresse dort öffnen, die Kamera erlauben und vor dem Roboter aufstellen. Browser warnen vor " +
    "dem Zertifikat, " +
    "das hier erzeugt wurde.",
  phoneAlone: "Dieses Studio ist nur für diesen Rechner da. Für ein Telefon npx twincell serve --lan starten.",
  sameMachine: "Eine Kamera dieses Rechners lässt sich auch allen Studios dieses Servers zeigen:",
  cameraPage: "Seite der Kamera öffnen",
  server: {
    off: "Der Server ist noch nicht gefragt.",
    connecting: "Der Server wird gefragt …",
    open: "",
    gone: "Der Server antwortet nicht.",
  },
  noneServer: "Über den Server zeigt sich jetzt keine Kamera.",
  "qr(address)": "QR-Code von {address}",
  copy: "Adresse kopieren",
  copied: "Die Adresse wurde kopiert.",
  "panel(name)": "Bild von {name}",
  close: "Bild schließen",
  full: "Vollbild",
  leaveFull: "Vollbild verlassen",
  move: "Bild verschieben: ziehen, oder Pfeiltasten",
  again: "Noch einmal versuchen",
  asking: "Der Browser fragt, ob die Kamera benutzt werden darf …",
  connecting: "Der Server wird erwartet …",
  waiting: "Das erste Bild wird erwartet …",
  "cameraGone(name)": "Die Kamera „{name}“ ist weg. Das letzte Bild bleibt, bis sie wiederkommt.",
  takenAway: "Die Kamera wurde entfernt oder die Erlaubnis zurückgezogen.",
  "unreadable(why)": "Ein Bild konnte nicht entpackt werden: {why}.",
  noSafety: "Eine Ansicht, keine Sicherheitseinrichtung.",
  ageUnknown: "Alter unbekannt",
  "late(s: number)": "Verspätet: Das war vor {s, number, ::scale/1000 precision-integer group-off} ms zu sehen.",
  "still(s: number)": "Das Bild steht seit {s, number, ::.0 group-off} s.",
  ageTip:
    "Vom Licht auf dem Sensor bis zu diesem Bildschirm, für jedes Bild aus seinem Zeitstempel und den Uhren errechnet.",
  "uncertain(s: number)": "± {s, number, ::scale/1000 precision-integer group-off} ms",
  "stages(taken, up, down, unpacked)": "Kamera {taken} · zum Server {up} · hierher {down} · entpackt {unpacked}",
  "ms(s: number)": "{s, number, ::scale/1000 precision-integer group-off} ms",
  hold: "Zwilling auf das Bild zurückhalten",
  holdTip:
    "Zeichnet jeden Roboter so, wie er bei der Aufnahme des Bilds stand, damit beide zusammenpassen. " +
    "Befehle und STOPP " +
    "werden nie zurückgehalten.",
  "heldBack(s: number)":
    "Der Zwilling wird {s, number, ::scale/1000 precision-integer group-off} ms später gezeichnet, wie das Bild.",
  heldNot: "Der Zwilling wird nicht zurückgehalten: Die Zeit des Bilds ist unbekannt oder zu alt.",
  measure: "Latenz messen",
  measureSays:
    "Die Kamera auf das Muster richten, so dass es ein Drittel des Bilds füllt, und zehn Sekunden ruhig halten. Das " +
    "Muster ist eine Uhr: Kommt es im Bild zurück, sagt es, wann es gezeichnet wurde. Je heller der Raum, desto mehr " +
    "Bilder zählen.",
  pattern: "Zeitcode: schwarze und weiße Blöcke, die zehnmal in der Sekunde wechseln",
  sees: {
    read: "Das Muster wird gelesen.",
    mixed: "Zwei Muster laufen ineinander: mehr Licht, oder kürzer belichten.",
    none: "Das Muster wird nicht gefunden: näher, gerader, alles Weiße im Bild.",
    nothing: "Es kommt kein Bild.",
  },
  figures: {
    median: "Median",
    p95: "95 % liegen innerhalb von",
    spread: "Kürzeste … längste",
    n: "Gezählte Bilder",
    estimate: "Aus Zeitstempeln geschätzt",
  },
  glass: "Von Glas zu Glas",
  glassSays:
    "Von einer Änderung vor der Kamera bis zum ersten Bild auf diesem Bildschirm, das sie zeigt: Anzeige, Kamera, " +
    "Packen, Netzwerk, Entpacken und eine halbe Bildperiode.",
  anew: "Neu beginnen",
  camera: {
    title: "Twincell-Kamera",
    says: "Zeigt das Bild dieser Kamera den Studios desselben Servers.",
    name: "Name dieser Kamera",
    start: "Bild zeigen",
    stop: "Anhalten",
    which: "Kamera",
    back: "Rückseite",
    front: "Vorderseite",
    named: "Telefon",
    "watched(n: number)": "{n, plural, =0 {Niemand sieht zu.} one {Ein Studio sieht zu.} other {# Studios sehen zu.}}",
    "rate(n: number, width: number, height: number)": "{n} Bilder je Sekunde, {width} × {height}",
    connecting: "Der Server wird erwartet …",
    awake: "Diese Seite offen und im Vordergrund lassen.",
  },
} satisfies Translation<typeof english>;
