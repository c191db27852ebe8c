import type { Sentences } from "../../sentences.ts";

/** German: what readers of files, texts and recordings, cameras and the physics say. */
export const saidByReaders: Sentences = {
  // Robots out of picked axes
  "A robot has at least one axis: pick a bore, a shaft or a round edge.":
    "Ein Roboter hat mindestens eine Achse: eine Bohrung, eine Welle oder eine runde Kante wählen.",
  "A robot has at least one part.": "Ein Roboter hat mindestens ein Teil.",
  "The axis of {joint} has no direction.": "Die Achse von {joint} hat keine Richtung.",
  "The lower limit of {joint} is not below its upper one.":
    "Die untere Grenze von {joint} liegt nicht unter der oberen.",
  "The speed of {joint} is not above 0.": "Die Geschwindigkeit von {joint} ist nicht über 0.",
  "joint {n}": "Achse {n}",
  "{name} belongs to link {n}, but the last link is {last}.":
    "{name} gehört zu Glied {n}, aber das letzte Glied ist {last}.",
  "The density is above 0.": "Die Dichte ist über 0.",
  "Masses and inertias are those of solids of {density} kg/m³.":
    "Massen und Trägheiten sind die von Vollkörpern mit {density} kg/m³.",
  "{name} is not closed: it weighs as much as the box around it.":
    "{name} ist nicht geschlossen: Es wiegt so viel wie der Quader darum.",
  "Link {n} has no part: the robot has no masses, and torques are not computed.":
    "Glied {n} hat kein Teil: Der Roboter hat keine Massen, und Momente werden nicht berechnet.",
  "Joint accelerations were not given: full joint speed is assumed to be reached in {s} s.":
    "Achsbeschleunigungen wurden nicht angegeben: Die volle Achsgeschwindigkeit sei in {s} s erreicht.",
  "Axes that were picked on the parts, with typed limits and speeds.":
    "Achsen, die an den Teilen gewählt wurden, mit eingegebenen Grenzen und Geschwindigkeiten.",
  // Shapes
  "{triangles} without area left out.": "{triangles} ohne Fläche ausgelassen.",
  "{triangles} with coordinates that are not numbers left out.":
    "{triangles} mit Koordinaten, die keine Zahlen sind, ausgelassen.",
  "1 triangle": "1 Dreieck",
  "{n} triangles": "{n} Dreiecke",
  "1 edge": "1 Kante",
  "{n} edges": "{n} Kanten",
  "The file gives 1 part no colour; ours is used.": "Die Datei gibt 1 Teil keine Farbe; eine eigene wird verwendet.",
  "The file gives {n} parts no colour; ours are used.":
    "Die Datei gibt {n} Teilen keine Farbe; eigene werden verwendet.",
  "The surface is open along {edges}: inside and outside are not certain there.":
    "Die Oberfläche ist entlang {edges} offen: Innen und außen sind dort nicht sicher.",
  "The surface is open along {edges}: inside and outside are not certain.":
    "Die Oberfläche ist entlang {edges} offen: Innen und außen sind nicht sicher.",
  "More than two triangles, or triangles of opposite winding, meet in {edges}.":
    "Mehr als zwei Dreiecke, oder gegensinnige Dreiecke, treffen sich in {edges}.",
  "No triangle of the file has an area and finite coordinates.":
    "Kein Dreieck der Datei hat eine Fläche und endliche Koordinaten.",
  "{name} is not there or cannot be read.": "{name} ist nicht da oder nicht lesbar.",
  "{name} is empty.": "{name} ist leer.",
  "The file is empty.": "Die Datei ist leer.",
  "The file holds no faces.": "Die Datei enthält keine Flächen.",
  "The file has {n} bytes; at most {most} are read.": "Die Datei hat {n} Bytes; höchstens {most} werden gelesen.",
  "{name} is no shape that is read: STL, OBJ, PLY, DAE, GLB, glTF and STEP are.":
    "{name} ist keine lesbare Form: STL, OBJ, PLY, DAE, GLB, glTF und STEP sind es.",
  "There is no shape and no robot description in it.": "Darin ist weder eine Form noch eine Roboterbeschreibung.",
  "{triangles} triangles are too few.": "{triangles} Dreiecke sind zu wenige.",
  "Ask for at least {n}.": "Mindestens {n} verlangen.",
  "Each vertex has a colour; the part gets their mean.":
    "Jeder Eckpunkt hat eine Farbe; das Teil erhält ihren Mittelwert.",
  "The file says {up}; z was taken for up.": "Die Datei sagt {up}; z wurde als oben genommen.",
  "The file is {up}: it was turned upright.": "Die Datei ist {up}: Sie wurde aufgerichtet.",
  "The file counts in {unit}: lengths were turned into metres.":
    "Die Datei zählt in {unit}: Längen wurden in Meter umgerechnet.",
  "{n} surfaces wear a picture, which an object of a cell cannot: their base colour is kept.":
    "{n} Flächen tragen ein Bild, was ein Objekt einer Zelle nicht kann: Ihre Grundfarbe bleibt.",
  "Every joint stands at 0.": "Jede Achse steht auf 0.",
  "The file is no STEP file that the CAD kernel can read.":
    "Die Datei ist keine STEP-Datei, die der CAD-Kern lesen kann.",
  "The STEP file holds no solid or surface.": "Die STEP-Datei enthält weder Körper noch Fläche.",
  "Curved faces became triangles that stand at most {mm} mm off, and turn at most {angle} rad from one to the next.":
    "Gekrümmte Flächen wurden Dreiecke, die höchstens {mm} mm abweichen und von einem zum nächsten höchstens {angle} " +
    "rad drehen.",
  "The unit was chosen: {unit}.": "Die Einheit wurde gewählt: {unit}.",
  "The file states its unit: {unit}.": "Die Datei nennt ihre Einheit: {unit}.",
  "The file states its unit ({unit}), but that makes it {size} long.":
    "Die Datei nennt ihre Einheit ({unit}), aber damit wird sie {size} lang.",
  "{format} files state no unit; {size} would be too long for a cell, so millimetres are taken: {taken}.":
    "{format}-Dateien nennen keine Einheit; {size} wären zu lang für eine Zelle, also gelten Millimeter: {taken}.",
  "The file states no unit; in millimetres the longest side would be {size}, so metres are taken: {taken}.":
    "Die Datei nennt keine Einheit; in Millimetern wäre die längste Seite {size}, also gelten Meter: {taken}.",
  "Joint {name} has no limits in the file: {range} are assumed.":
    "Achse {name} hat in der Datei keine Grenzen: {range} werden angenommen.",
  "Joint {name} has no speed in the file: {speed} is assumed.":
    "Achse {name} hat in der Datei keine Geschwindigkeit: {speed} wird angenommen.",
  "{file} is missing.": "{file} fehlt.",
  "{file} was found as {other}.": "{file} wurde als {other} gefunden.",

  // Cells, programs, recordings
  "The file is not JSON: {why}.": "Die Datei ist kein JSON: {why}.",
  "The file holds no JSON object.": "Die Datei enthält kein JSON-Objekt.",
  'A cell says "format": "twincell.cell"; this file says {format}.':
    'Eine Zelle sagt "format": "twincell.cell"; diese Datei sagt {format}.',
  "The cell is of version 1; it may now also hold vendor programs as text and frames that move with an object.":
    "Die Zelle ist von Version 1; sie darf jetzt auch Herstellerprogramme als Text und Frames " +
    "enthalten, die mit einem " +
    "Objekt wandern.",
  "“{name}” could not be read.": "„{name}“ konnte nicht gelesen werden.",
  "This cell is no longer there.": "Diese Zelle gibt es nicht mehr.",
  "The file does not begin like an MCAP file.": "Die Datei beginnt nicht wie eine MCAP-Datei.",
  "The recording ends before its first sample.": "Die Aufzeichnung endet vor ihrem ersten Abtastwert.",
  "The recording is of {robot}, a robot that is not known here.":
    "Die Aufzeichnung ist von {robot}, einem hier unbekannten Roboter.",
  "The recording has {joints} joints; {robot} has {n}.": "Die Aufzeichnung hat {joints} Achsen; {robot} hat {n}.",
  "The recording cannot be read: {why}.": "Die Aufzeichnung kann nicht gelesen werden: {why}.",
  "the reader stopped without saying why": "der Leser brach ab, ohne zu sagen, warum",
  "The recording could not be kept: {why}.": "Die Aufzeichnung konnte nicht aufbewahrt werden: {why}.",
  "The browser has no room left for this recording.": "Der Browser hat keinen Platz mehr für diese Aufzeichnung.",
  "Make room, then start a new recording. The part written so far can be opened.":
    "Platz schaffen, dann eine neue Aufzeichnung beginnen. Der bisher geschriebene Teil lässt sich öffnen.",
  "{file} was executed line by line and meets all {n} steps within {mm} mm and {deg}°.":
    "{file} wurde Zeile für Zeile ausgeführt und trifft alle {n} Schritte auf {mm} mm und {deg}° genau.",
  "The controller of the {robot} does not speak {language}.": "Die Steuerung des {robot} spricht kein {language}.",
  "Export in the language of this robot's own controller.": "In der Sprache der Steuerung dieses Roboters exportieren.",
  "Check the program: it says what would bring the step into reach.":
    "Das Programm prüfen: Es sagt, was den Schritt erreichbar macht.",
  "Say it in another way, or take the step out.": "Anders ausdrücken, oder den Schritt herausnehmen.",
  "The program was taught on {robot} and is written for {other}.":
    "Das Programm wurde auf {robot} geteacht und wird für {other} geschrieben.",
  "Teach the step again on this robot.": "Den Schritt auf diesem Roboter neu teachen.",
  "Move the point, or choose another branch for it.":
    "Den Punkt verschieben, oder eine andere Konfiguration für ihn wählen.",
  "There is no language “{language}” for the robot “{robot}”.":
    "Es gibt keine Sprache „{language}“ für den Roboter „{robot}“.",
  "The text could not be written.": "Der Text konnte nicht geschrieben werden.",
  "Line {line}, column {column}: {why}": "Zeile {line}, Spalte {column}: {why}",
  "Change the numbers in the text itself.": "Die Zahlen im Text selbst ändern.",
  "Touch the point up on a motion that goes straight to it.":
    "Den Punkt auf einer Bewegung nachteachen, die direkt zu ihm führt.",
  "Move the robot to a place that it reaches with this tool and frame.":
    "Den Roboter an einen Ort fahren, den er mit diesem Werkzeug und Frame erreicht.",

  // Examples
  "Click the top edges of a carton and get the program that traces them.":
    "Die oberen Kanten eines Kartons anklicken und das Programm erhalten, das sie abfährt.",
  "All four edges of the carton, traced with the torch at 45°.":
    "Alle vier Kanten des Kartons, mit dem Brenner unter 45° abgefahren.",
  "Boxes come on a belt, a photo-cell stops it, nine places take them.":
    "Kisten kommen auf einem Band, eine Lichtschranke hält es an, neun Plätze nehmen sie auf.",
  "A part is carried from one side of a table to the other.":
    "Ein Teil wird von einer Seite eines Tisches zur anderen getragen.",
  "Nine boxes from a feeder onto a pallet of three by three.":
    "Neun Kisten aus einer Zuführung auf eine Palette von drei mal drei.",
  "A lap for a twin: connect a virtual Yaskawa, run it there, and travel back along it.":
    "Eine Runde für einen Zwilling: eine virtuelle Yaskawa verbinden, dort ausführen und zurückblicken.",
  "A line that leaves the reach of the arm: find out where, and mend it.":
    "Eine Linie, die die Reichweite des Arms verlässt: herausfinden, wo, und beheben.",
  "A raw part goes into the vice when the machine asks for it.":
    "Ein Rohteil kommt in den Schraubstock, wenn die Maschine es verlangt.",
  "A spindle goes round the top edges of a block.": "Eine Spindel fährt die oberen Kanten eines Blocks ab.",
  "Two parallel seams, the arc on along each.": "Zwei parallele Nähte, auf jeder brennt der Lichtbogen.",
  "A bead of glue along three sides of a cover.": "Eine Kleberaupe entlang dreier Seiten eines Deckels.",
  "A camera looks at five points of a part and is told when to measure.":
    "Eine Kamera sieht fünf Punkte eines Teils an und erfährt, wann sie messen soll.",

  "Edge trace": "Kanten abfahren",
  "Traced carton": "Abgefahrener Karton",
  "Conveyor and pallet": "Förderer und Palette",
  "Pick and place": "Greifen und Ablegen",
  "Pallet of nine": "Palette mit neun Plätzen",
  "Twin of a GP8": "Zwilling eines GP8",
  "A line out of reach": "Eine Linie außer Reichweite",
  "Machine tending": "Maschinenbeschickung",
  Deburring: "Entgraten",
  "Welding two seams": "Zwei Nähte schweißen",
  "Gluing a cover": "Deckel kleben",
  "Inspection at five points": "Prüfen an fünf Punkten",

  // Workers
  "The collision check could not run: {why}.": "Die Kollisionsprüfung konnte nicht laufen: {why}.",
  "The collision check stopped: {why}.": "Die Kollisionsprüfung brach ab: {why}.",
  "Reload the page; nothing is lost.": "Die Seite neu laden; nichts geht verloren.",
  "Physics could not run: {why}.": "Die Physik konnte nicht laufen: {why}.",
  "Physics stopped: {why}.": "Die Physik brach ab: {why}.",
  "The check stopped without saying why.": "Die Prüfung brach ab, ohne zu sagen, warum.",

  // Physics
  "The program has come to its end.": "Das Programm ist am Ende.",
  "Nothing touches “{name}”.": "Nichts berührt „{name}“.",
  "The fingers touch “{name}”.": "Die Finger berühren „{name}“.",
  "“{name}” is held.": "„{name}“ ist gegriffen.",
  "“{name}” slipped out of the fingers.": "„{name}“ rutschte aus den Fingern.",
  "“{name}” weighs {kg} kg.": "„{name}“ wiegt {kg} kg.",
  "{person} entered “{zone}”.": "{person} betrat „{zone}“.",
  "{person} left “{zone}”.": "{person} verließ „{zone}“.",
  "“{name}” was tripped.": "„{name}“ hat geschaltet.",
  "“{name}” is free again.": "„{name}“ ist wieder frei.",
  "The robot is stopped; it goes on when somebody lets it.":
    "Der Roboter ist angehalten; er fährt weiter, wenn jemand ihn lässt.",
  "The robot is slowed down to {percent} %.": "Der Roboter ist auf {percent} % verlangsamt.",
  "The robot runs at its own speed again.": "Der Roboter fährt wieder mit eigener Geschwindigkeit.",
  "Somebody is in “{zone}”: the robot stays where it is.": "Jemand ist in „{zone}“: Der Roboter bleibt, wo er ist.",
  "“{name}” is tripped: the robot stays where it is.": "„{name}“ hat geschaltet: Der Roboter bleibt, wo er ist.",
  "Let the arm be moved as told instead of driven.": "Den Arm wie befohlen bewegen lassen statt angetrieben.",
  "Look at the shapes and masses of the cell.": "Formen und Massen der Zelle prüfen.",
  "“{a}” and “{b}” are {mm} mm inside one another at the start.":
    "„{a}“ und „{b}“ stecken am Anfang {mm} mm ineinander.",
  "Move one of them away; they may touch.": "Eines davon wegschieben; berühren dürfen sie sich.",
  "The fingers press on “{name}” with {force} kN.": "Die Finger drücken mit {force} kN auf „{name}“.",
  "Move the point where the arm goes down, or open the gripper wider.":
    "Den Punkt verschieben, an dem der Arm hinunterfährt, oder den Greifer weiter öffnen.",
  "Look for solids that are pressed into one another, or take a shorter step.":
    "Nach Körpern suchen, die ineinandergedrückt sind, oder einen kürzeren Zeitschritt nehmen.",
  "“{name}” encloses no volume: it is not a solid.": "„{name}“ umschließt kein Volumen: Es ist kein Körper.",
  "Close its mesh, or give it a thickness.": "Das Netz schließen, oder ihm eine Dicke geben.",
  "“{name}” weighs {kg} kg: what falls and is carried needs a mass.":
    "„{name}“ wiegt {kg} kg: Was fällt und getragen wird, braucht eine Masse.",
  "Give it a mass in kg, or let it follow from its volume.":
    "Eine Masse in kg angeben, oder sie aus dem Volumen folgen lassen.",
  "The mass of {names} follows from the volume at 500 kg/m³.":
    "Die Masse von {names} folgt aus dem Volumen mit 500 kg/m³.",
  "Surfaces that say nothing have a friction of 0.6.": "Flächen ohne Angabe haben eine Reibung von 0,6.",
  "Joints have no friction of their own and no play.": "Achsen haben keine eigene Reibung und kein Spiel.",
  "The arm is moved as told, whatever it touches: its torques are unknown.":
    "Der Arm bewegt sich wie befohlen, was er auch berührt: Seine Drehmomente sind unbekannt.",

  // Cameras
  "A browser gives a camera only to a secure page: open it by https, or on the computer itself.":
    "Ein Browser gibt eine Kamera nur an eine sichere Seite: über https öffnen, oder auf dem Rechner selbst.",
  "This browser has no access to cameras.": "Dieser Browser hat keinen Zugriff auf Kameras.",
  "The camera was not allowed. Allow it for this page beside the address, then try again.":
    "Die Kamera wurde nicht erlaubt. Neben der Adresse für diese Seite erlauben, dann noch einmal versuchen.",
  "No camera was found on this device. Plug one in, then try again.":
    "Auf diesem Gerät wurde keine Kamera gefunden. Eine einstecken, dann noch einmal versuchen.",
  "That camera is no longer there. Choose another.": "Diese Kamera gibt es nicht mehr. Eine andere wählen.",
  "Another program uses the camera. Close it, then try again.":
    "Ein anderes Programm benutzt die Kamera. Es schließen, dann noch einmal versuchen.",
  "The camera could not be started: {why}.": "Die Kamera konnte nicht starten: {why}.",
  "The server is of another release than this page. Load the page again.":
    "Der Server ist von einer anderen Version als diese Seite. Die Seite neu laden.",
  "The Twincell server does not answer. It is tried again.":
    "Der Twincell-Server antwortet nicht. Es wird wieder versucht.",
  "Nothing was heard of the server for {s} s. It is tried again.":
    "Vom Server kam seit {s} s nichts. Es wird wieder versucht.",
  "A picture of {mb} MB is too large to be sent.": "Ein Bild von {mb} MB ist zu groß zum Senden.",
  "The picture could not be made into a JPEG: {why}.": "Aus dem Bild konnte kein JPEG werden: {why}.",
  "The picture could not be taken from the camera: {why}.":
    "Das Bild konnte nicht von der Kamera genommen werden: {why}.",
  "The camera was taken away or its permission withdrawn.":
    "Die Kamera wurde entfernt oder die Erlaubnis zurückgezogen.",
  "The file is no JSON.": "Die Datei ist kein JSON.",
  "The file is no lesson of version 1.": "Die Datei ist keine Übung der Version 1.",
  "The lesson has no goals with a position and an axis of three numbers.":
    "Die Übung hat keine Ziele mit Position und Achse aus je drei Zahlen.",
  "The lesson lacks its tolerances, or time and way of whoever made it.":
    "Der Übung fehlen die Toleranzen, oder Zeit und Weg der Vorlage.",
  "The lesson says neither its name nor its robot.": "Die Übung nennt weder Namen noch Roboter.",
};
