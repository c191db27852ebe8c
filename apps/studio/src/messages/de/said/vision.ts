import type { Sentences } from "../../sentences.ts";

/** German: lens calibration and registration. */
export const saidByVision: Sentences = {
  "{least} views of the board are the least; {n} were given.":
    "Mindestens {least} Ansichten der Tafel sind nötig; es waren {n}.",
  "The views fit no lens. Print the board at 100 % and keep it flat.":
    "Die Ansichten passen zu keinem Objektiv. Die Tafel mit 100 % drucken und flach halten.",
  "The points miss by {off} px; {allowed} px is allowed. Keep the board flat and still.":
    "Die Punkte liegen um {off} px daneben; {allowed} px ist erlaubt. Die Tafel flach und ruhig halten.",
  "The focal length is known to {share} %; 1 % is needed. Tilt the board by 20° to 40° in different directions.":
    "Die Brennweite ist auf {share} % bekannt; 1 % ist nötig. Die Tafel um 20° bis 40° in verschiedene Richtungen " +
    "neigen.",
  "Calibrated from {n} views: {rms} px root mean square, focal length {focal} ± {spread} px.":
    "Kalibriert aus {n} Ansichten: {rms} px quadratisches Mittel, Brennweite {focal} ± {spread} px.",
  "A coordinate of point {n} is not a finite number.": "Eine Koordinate von Punkt {n} ist keine endliche Zahl.",
  "{least} touched points are the least; {n} were given.":
    "Mindestens {least} berührte Punkte sind nötig; es waren {n}.",
  "The base is known to {bound} mm (95 %), from {n} touched points; they are met to {rms} mm (root mean square).":
    "Die Basis ist auf {bound} mm bekannt (95 %), aus {n} berührten Punkten; sie werden auf {rms} mm getroffen " +
    "(quadratisches Mittel).",
  "{least} touched points or {poses} driven poses are the least; {n} and {driven} were given.":
    "Mindestens {least} berührte Punkte oder {poses} gefahrene Posen sind nötig; es waren {n} und {driven}.",
  "The points lie in one line to {spread} mm; one must stand aside for the turn about that line.":
    "Die Punkte liegen auf {spread} mm in einer Linie; einer muss daneben liegen, für die Drehung um diese Linie.",
  "The tool was not turned enough: turn it by 30° or more about two different axes.":
    "Das Werkzeug wurde nicht genug gedreht: um 30° oder mehr um zwei verschiedene Achsen drehen.",
  "The samples do not tell how the base is turned: spread them farther.":
    "Die Messungen sagen nicht, wie die Basis gedreht ist: weiter verteilen.",
  "The points disagree by {rms} mm (root mean square), {ratio} times what the tracking's noise explains. Take them again.":
    "Die Punkte widersprechen sich um {rms} mm (quadratisches Mittel), das {ratio}-fache dessen, was das Rauschen " +
    "erklärt. Noch einmal aufnehmen.",
  "The base is known to {bound} mm (95 %), from {n} touched points and {driven} driven poses; they are met to {rms} mm (root mean square).":
    "Die Basis ist auf {bound} mm bekannt (95 %), aus {n} berührten Punkten und {driven} gefahrenen Posen; sie werden " +
    "auf {rms} mm getroffen (quadratisches Mittel).",
  "The registration holds: {off} mm off, {allowed} mm allowed (95 %).":
    "Die Einmessung gilt: {off} mm daneben, {allowed} mm erlaubt (95 %).",
  "The registration has drifted: {off} mm off, {allowed} mm allowed (95 %). Register again.":
    "Die Einmessung hat sich verschoben: {off} mm daneben, {allowed} mm erlaubt (95 %). Neu einmessen.",
};
