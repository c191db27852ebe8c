import type { Sentences } from "../../sentences.ts";

/** German: what readers and writers of program texts say. */
export const saidByTexts: Sentences = {
  "A list of numbers stands where a value is expected.": "Wo ein Wert erwartet wird, steht eine Liste von Zahlen.",
  "Another loop is closed than the last one that was opened.":
    "Eine andere Schleife wird geschlossen als die zuletzt geöffnete.",
  "Blocks are nested more than {n} deep.": "Blöcke sind mehr als {n}-fach geschachtelt.",
  "Choose a digital output.": "Einen digitalen Ausgang wählen.",
  "Choose another pallet.": "Eine andere Palette wählen.",
  "Decide by a digital line.": "Nach einem digitalen Signal entscheiden.",
  "Divide the program.": "Das Programm teilen.",
  "Give every line a number of its own.": "Jedem Signal eine eigene Nummer geben.",
  "Give the line a number of the controller.": "Dem Signal eine Nummer der Steuerung geben.",
  "Give the line another number.": "Dem Signal eine andere Nummer geben.",
  "Give the line its number in the list of signals.": "Dem Signal seine Nummer in der Signalliste geben.",
  "Give the signal a number from {numbers}.": "Dem Signal eine Nummer aus {numbers} geben.",
  "Label {label} is in {called} {name} twice.": "Die Marke {label} steht in {called} {name} zweimal.",
  "Label {label} is not in {called} {name}.": "Die Marke {label} steht nicht in {called} {name}.",
  "Line {line}, column {column}: {expected}.": "Zeile {line}, Spalte {column}: {expected}.",
  "Line {line} has more than {n} characters.": "Zeile {line} hat mehr als {n} Zeichen.",
  "Line {line} has {n} characters.": "Zeile {line} hat {n} Zeichen.",
  "Only a variable can be given a value.": "Nur eine Variable kann einen Wert erhalten.",
  "Only a wait for one line can be carried out.": "Nur ein Warten auf ein einzelnes Signal ist ausführbar.",
  'The character "{letter}" has no meaning here.': "Das Zeichen „{letter}“ hat hier keine Bedeutung.",
  "The choice has no case.": "Die Auswahl hat keinen Fall.",
  "The decision leaves its block, which steps cannot.":
    "Die Entscheidung verlässt ihren Block; das können Schritte nicht.",
  "The divisor is 0.": "Der Teiler ist 0.",
  "The expression is nested more than {n} deep.": "Der Ausdruck ist mehr als {n}-fach geschachtelt.",
  "The file has no index and is larger than {n} MB.": "Die Datei hat keinen Index und ist größer als {n} MB.",
  "The line ends where {expected} is expected.": "Die Zeile endet, wo {expected} erwartet wird.",
  "The loop has the step 0.": "Die Schleife hat die Schrittweite 0.",
  "The loop is left from inside, which steps cannot.":
    "Die Schleife wird von innen verlassen; das können Schritte nicht.",
  "The loop of line {line} was written out: it became {n} steps.":
    "Die Schleife aus Zeile {line} wurde ausgeschrieben: Sie wurde zu {n} Schritten.",
  "The place cannot be reached in the posture that is asked for.":
    "Der Ort ist in der verlangten Stellung nicht erreichbar.",
  "The program has executed {n} statements without a motion: it runs on the spot for ever.":
    "Das Programm hat {n} Anweisungen ohne Bewegung ausgeführt: Es läuft endlos auf der Stelle.",
  "The program has more than {n} steps: it repeats itself for ever.":
    "Das Programm hat mehr als {n} Schritte: Es wiederholt sich endlos.",
  "The program uses {n} {what}; a controller keeps {limit}.":
    "Das Programm verwendet {n} {what}; eine Steuerung hält {limit}.",
  "The program waits for an output that nothing here changes.":
    "Das Programm wartet auf einen Ausgang, den hier nichts ändert.",
  "The red button is pressed.": "Der rote Knopf ist gedrückt.",
  "The result is not a number.": "Das Ergebnis ist keine Zahl.",
  "The connection broke.": "Die Verbindung brach ab.",
  "The connection was closed here.": "Die Verbindung wurde hier geschlossen.",
  "The other side closed the connection.": "Die Gegenseite hat die Verbindung geschlossen.",
  "Nobody answers at {address}.": "An {address} antwortet niemand.",
  "Make room, or choose another folder.": "Platz schaffen, oder einen anderen Ordner wählen.",
  "No recording can be begun: {why}.": "Es kann keine Aufzeichnung begonnen werden: {why}.",
  "There is a station “{name}” already.": "Eine Station „{name}“ gibt es schon.",
  "Close it first, or give the new one another name.": "Erst schließen, oder der neuen einen anderen Namen geben.",
  "{n} stations are open, which is the most.": "{n} Stationen sind offen; mehr sind nicht möglich.",
  "Close one first.": "Erst eine schließen.",
  "Open it first.": "Erst öffnen.",
  "Export it again.": "Noch einmal exportieren.",
  "{name} is a real controller: its pendant is at the robot.":
    "{name} ist eine reale Steuerung: Ihr Handgerät ist am Roboter.",
  "Go there.": "Dorthin gehen.",
  "Disconnect it instead.": "Stattdessen trennen.",
  "This server is for training: it opens virtual controllers only.":
    "Dieser Server ist zum Üben: Er öffnet nur virtuelle Steuerungen.",
  "For a real robot start it without --training.": "Für einen realen Roboter ohne --training starten.",
  "{host} is not among the addresses that this server may connect to.":
    "{host} gehört nicht zu den Adressen, mit denen sich dieser Server verbinden darf.",
  "There is no driver for “{brand}”.": "Für „{brand}“ gibt es keinen Treiber.",
  "The connection to the plug-in is gone.": "Die Verbindung zum Plug-in ist weg.",
  "Start the plug-in, or look at its address.": "Das Plug-in starten, oder seine Adresse prüfen.",
  "{name} is called here and is in none of the files: give the file that holds it as well, or let the call do nothing.":
    "{name} wird hier aufgerufen und steht in keiner der Dateien: die Datei dazu auch öffnen, oder den Aufruf " +
    "nichts tun lassen.",
  "{name} is called here and is in none of the files: what it does, motions too, is not executed.":
    "{name} wird hier aufgerufen und steht in keiner der Dateien: Was es tut, auch Bewegungen, wird nicht ausgeführt.",
};
