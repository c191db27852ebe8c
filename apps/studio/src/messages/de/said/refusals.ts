import type { Sentences } from "../../sentences.ts";

/** German: refusals and faults of stations, productions, people, virtual pendants, cells and simulation. */
export const saidInRefusals: Sentences = {
  // Stations and their connections
  "The connection to the host of the stations is gone.": "Die Verbindung zum Server der Stationen ist weg.",
  "Connect again; motion goes on only when you command it.":
    "Neu verbinden; Bewegungen gehen erst weiter, wenn Sie sie befehlen.",
  "There is no station “{name}”.": "Eine Station „{name}“ gibt es nicht.",
  "Give the new one another name.": "Der neuen einen anderen Namen geben.",
  "{robot} is a real controller: its plug is in the wall.":
    "{robot} ist eine reale Steuerung: Ihr Stecker ist an der Wand.",
  "A station is named twice in the group.": "Eine Station steht zweimal in der Gruppe.",
  "Name each once.": "Jede einmal nennen.",
  "A cell was given, and nothing here reads cells.": "Eine Zelle wurde angegeben, aber hier liest nichts Zellen.",
  "Open the robot without a cell, or use a program that reads them.":
    "Den Roboter ohne Zelle öffnen, oder ein Programm nehmen, das sie liest.",
  "{robot} has no solver for poses.": "{robot} hat keine Rückwärtskinematik für Posen.",
  "Attach one, or command joint angles.": "Eine anschließen, oder Achswinkel befehlen.",
  "{robot} is in {mode} mode; its pendant jogs in manual mode only.":
    "{robot} ist in der Betriebsart {mode}; sein Handgerät verfährt nur im Handbetrieb.",
  "Turn the mode switch to manual.": "Den Betriebsartenschalter auf Hand stellen.",
  "There is no robot “{name}” in the library.": "Einen Roboter „{name}“ gibt es in der Bibliothek nicht.",
  "Choose one of the library.": "Einen aus der Bibliothek wählen.",
  "Start it with --robots {folder}.": "Mit --robots {folder} starten.",
  "A plug-in runs by itself, and where was not said.": "Ein Plug-in läuft für sich, und wo, wurde nicht angegeben.",
  "Start it and give its address.": "Es starten und seine Adresse angeben.",
  "There are: {names}, {last}.": "Es gibt: {names}, {last}.",
  "Send it again; if it stays so, start the server anew.": "Noch einmal senden; bleibt es so, den Server neu starten.",
  "Start the plug-in for this robot, or choose the robot that it drives, and connect again.":
    "Das Plug-in für diesen Roboter starten, oder den Roboter wählen, den es steuert, und neu verbinden.",
  "Look at the plug-in's own log.": "Ins Protokoll des Plug-ins sehen.",
  "The robot is back at its last safe pose.": "Der Roboter ist wieder in seiner letzten sicheren Stellung.",
  "The guard stopped the robot on its way into contact.":
    "Die Überwachung hielt den Roboter an, bevor er etwas berührte.",
  "The link is open again.": "Die Verbindung steht wieder.",
  "The common run is done.": "Der gemeinsame Lauf ist fertig.",
  "{robot} is recorded again.": "{robot} wird wieder aufgezeichnet.",
  "What it did meanwhile is not kept.": "Was er inzwischen tat, ist nicht aufgezeichnet.",
  // Pendants
  "{robot} has {joints} joints; there is no joint {joint}.":
    "{robot} hat {joints} Achsen; eine Achse {joint} gibt es nicht.",
  "Turn the key to {position}.": "Den Schlüssel auf {position} drehen.",
  "The key has no position “{position}”.": "Der Schlüssel hat keine Stellung „{position}“.",
  "It has: {positions}.": "Er hat: {positions}.",
  "An override of {percent} % is not between 0 and 100 %.":
    "Ein Override von {percent} % liegt nicht zwischen 0 und 100 %.",
  "This is the pendant of {robot} and nothing else.": "Dies ist das Handgerät von {robot} und von nichts anderem.",
  "Command the controller at its own ports, from a station.":
    "Die Steuerung an ihren eigenen Anschlüssen befehlen, von einer Station aus.",
  // Productions
  "The production was stopped while it was held.": "Die Produktion wurde angehalten, während sie unterbrochen war.",
  "Begin it again.": "Noch einmal beginnen.",
  "It runs as text of the controller's own language, which has the place to itself.":
    "Sie läuft als Text in der Sprache der Steuerung; wo sie steht, weiß nur die Steuerung.",
  "Run it by steps, or resume with a cycle from its beginning.":
    "Sie schrittweise ausführen, oder mit einem Zyklus von Anfang an fortsetzen.",
  "The program computes: what its variables are in the middle of a cycle is not known.":
    "Das Programm rechnet: Welche Werte seine Variablen mitten im Zyklus haben, ist nicht bekannt.",
  "Resume with a cycle from its beginning.": "Mit einem Zyklus von Anfang an fortsetzen.",
  "It was in the middle of the step “{step}”, which has steps of its own: how far it was is not known.":
    "Sie war mitten im Schritt „{step}“, der selbst Schritte hat: Wie weit sie war, ist nicht bekannt.",
  "The production is not held.": "Die Produktion ist nicht unterbrochen.",
  "Hold it first.": "Sie erst unterbrechen.",
  "The production ended before its next cycle.": "Die Produktion endete vor ihrem nächsten Zyklus.",
  "Begin it again with the new program.": "Sie mit dem neuen Programm noch einmal beginnen.",
  "The production has ended.": "Die Produktion ist zu Ende.",
  "Another program was given before its cycle came.":
    "Ein anderes Programm wurde angegeben, bevor sein Zyklus an der Reihe war.",
  "No production runs on this robot.": "Auf diesem Roboter läuft keine Produktion.",
  "Begin one.": "Eine beginnen.",
  "{robot} is in production already.": "{robot} produziert schon.",
  "Give it another program with replace, or stop it first.":
    "Ein anderes Programm mit „replace“ geben, oder die Produktion erst anhalten.",
  "Nobody has the lease.": "Niemand steuert den Roboter.",
  "Take the lease first.": "Erst die Steuerung übernehmen.",
  // People
  "Many people sign in at once.": "Viele melden sich gleichzeitig an.",
  "Try again in a moment.": "Gleich noch einmal versuchen.",
  "Passkeys need a part that is not installed.": "Passkeys brauchen einen Teil, der nicht installiert ist.",
  "Nobody signs in by name here.": "Hier meldet sich niemand mit Namen an.",
  "Start the server with --accounts and --data DIR.": "Den Server mit --accounts und --data ORDNER starten.",
  "Too many wrong passwords came from this address.": "Von dieser Adresse kamen zu viele falsche Passwörter.",
  "Wait {seconds} s; others are not kept out.": "{seconds} s warten; andere werden nicht ausgesperrt.",
  "Name and password do not belong together.": "Name und Passwort passen nicht zusammen.",
  "Ask an admin for a new link.": "Einen Verwalter um einen neuen Link bitten.",
  "This link was used already, or has ended.": "Dieser Link wurde schon benutzt oder ist abgelaufen.",
  "Ask an admin for another one.": "Einen Verwalter um einen anderen bitten.",
  "Choose another one.": "Ein anderes wählen.",
  "There is somebody called {name} already.": "Jemanden mit dem Namen {name} gibt es schon.",
  "Choose another name.": "Einen anderen Namen wählen.",
  "Only people who are signed in have passkeys.": "Passkeys hat nur, wer angemeldet ist.",
  "Sign in first.": "Erst anmelden.",
  "This passkey could not be verified.": "Dieser Passkey konnte nicht geprüft werden.",
  "This passkey could not be verified: {why}.": "Dieser Passkey konnte nicht geprüft werden: {why}.",
  "Make it again.": "Ihn noch einmal anlegen.",
  "“{name}” is no name of a person.": "„{name}“ ist kein Name für eine Person.",
  "Begin it with a letter or digit.": "Mit einem Buchstaben oder einer Ziffer beginnen.",
  "There is nobody called {name}.": "Niemand heißt {name}.",
  "GET /api/v1/people lists them.": "GET /api/v1/people nennt alle.",
  "{name} is the only admin.": "{name} ist der einzige Verwalter.",
  "Make somebody else an admin first.": "Erst jemand anderen zum Verwalter machen.",
  // Cells edited by several people
  "Your changes are put on the present state of the cell.":
    "Ihre Änderungen werden auf den jetzigen Stand der Zelle angewandt.",
  "This change is left out; your cell as it was is kept.":
    "Diese Änderung bleibt weg; Ihre Zelle, wie sie war, ist aufbewahrt.",
  "Open the cell again.": "Die Zelle noch einmal öffnen.",
  "It needs the role programmer or admin; your cell as it was is kept.":
    "Dafür braucht es die Rolle Programmierer oder Verwalter; Ihre Zelle, wie sie war, ist aufbewahrt.",
  "Your cell as it was is kept.": "Ihre Zelle, wie sie war, ist aufbewahrt.",
  // Programs, cells and simulation
  "{robot} carries at most {limit}; “{part}”{more}{rest}.": "{robot} trägt höchstens {limit}; „{part}“{more}{rest}.",
  "Take a part that is {mass} lighter, or a robot that carries more.":
    "Ein um {mass} leichteres Teil nehmen, oder einen Roboter, der mehr trägt.",
  "The condition looks at a variable that has no value here.":
    "Die Bedingung liest eine Variable, die hier keinen Wert hat.",
  "Look at the expression of the step.": "Den Ausdruck des Schritts prüfen.",
  "Step “{step}” is of type {type}, which only its program can carry out.":
    "Schritt „{step}“ ist vom Typ {type}; den kann nur sein Programm ausführen.",
  "Hand over the program's unrolled steps.": "Die aufgelösten Schritte des Programms übergeben.",
  "In step “{step}” the weight of the arm{load} asks {value} {unit} of joint {joint}; its limit is {limit} {same}.":
    "Im Schritt „{step}“ verlangt das Gewicht des Arms{load} {value} {unit} von Achse {joint}; Grenze {limit} {same}.",
  "Carry less, or keep the load nearer to the robot.": "Weniger tragen, oder die Last näher am Roboter halten.",
  "A binary STL cannot be named “{name}”.": "Eine binäre STL-Datei kann nicht „{name}“ heißen.",
  "Names that begin with “solid” mark ASCII files: choose another.":
    "Namen, die mit „solid“ beginnen, stehen für ASCII-Dateien: einen anderen wählen.",
  "{why} Its drives cannot be simulated.": "{why} Seine Antriebe können nicht simuliert werden.",
  "The cell cannot be simulated: {why}.": "Die Zelle kann nicht simuliert werden: {why}.",
  "Joint {joint} of {robot} is told to be at no number.": "Für Achse {joint} von {robot} wurde keine Zahl vorgegeben.",
  "Look at the program.": "Das Programm prüfen.",
  "“{part}” flew off: its speed passed {speed} m/s at {time} s.":
    "„{part}“ flog davon: Bei {time} s überschritt seine Geschwindigkeit {speed} m/s.",
  "Move the point.": "Den Punkt verschieben.",
  "The cell is of version {version}, and version {newest} is the newest that is known here.":
    "Die Zelle hat Version {version}; bekannt ist hier höchstens Version {newest}.",
  "The robot is not moved with a cell that nobody can read: save the cell anew with this release, and give it again.":
    "Mit einer Zelle, die niemand lesen kann, wird der Roboter nicht bewegt: Die Zelle mit dieser Version neu " +
    "speichern und wieder angeben.",
  "Import {file} again.": "{file} noch einmal importieren.",
};
