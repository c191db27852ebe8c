import type { Sentences } from "../../sentences.ts";

/** German: what writers of program texts say when a program is exported. */
export const saidByExport: Sentences = {
  "RIGHTY is taken for a wrist in front of the shoulder axis and LEFTY for one behind it; try the first motion slowly.":
    "RIGHTY gilt für ein Handgelenk vor der Schulterachse, LEFTY für eines dahinter; die erste Bewegung langsam fahren.",
  "RAPID holds speeds of the tool: a joint move at a share of the full joint speed gets that share of the tool's full speed.":
    "RAPID kennt Geschwindigkeiten des Werkzeugs: Eine Achsbewegung mit einem Anteil der vollen Achsgeschwindigkeit " +
    "erhält diesen Anteil der vollen Werkzeuggeschwindigkeit.",
  "What the configuration numbers mean for this arm is not known here: they are written as 0 and not asked for. Try the first motion slowly.":
    "Was die Konfigurationszahlen für diesen Arm bedeuten, ist hier nicht bekannt: Sie werden als 0 geschrieben und " +
    "nicht verlangt. Die erste Bewegung langsam fahren.",
  "Add it to the list.": "In die Liste aufnehmen.",
  "Ask a digital line whether it is on, an analogue one for a limit.":
    "Ein digitales Signal fragen, ob es ein ist, ein analoges nach einer Grenze.",
  "Choose a payload schedule at the controller.": "An der Steuerung einen Lastdatensatz wählen.",
  "Choose a value of that line.": "Einen Wert dieses Signals wählen.",
  "Choose an output.": "Einen Ausgang wählen.",
  "Give it as a share of the full output.": "Als Anteil des vollen Ausgangs angeben.",
  "Give it its number: lines of FANUC count from 1.": "Seine Nummer angeben: Signale von FANUC zählen ab 1.",
  "Give the arc a speed.": "Dem Bogen eine Geschwindigkeit geben.",
  "Give the inertia about the load's own axes.": "Die Trägheit um die eigenen Achsen der Last angeben.",
  "Let it accelerate more, or move more slowly.": "Stärker beschleunigen lassen, oder langsamer fahren.",
  "Lines have the names of the controller's configuration: letters, digits and _, at most 32, a letter first.":
    "Signale heißen wie in der Konfiguration der Steuerung: Buchstaben, Ziffern und _, höchstens 32, ein Buchstabe zuerst.",
  "Make it a straight move.": "Als gerade Bewegung (LIN) fahren.",
  "One routine of RAPID has one answer to that: put one of the searches into a routine of its own.":
    "Eine RAPID-Routine hat darauf eine Antwort: eine der Suchfahrten in eine eigene Routine legen.",
  "Put a move with the tool before it.": "Eine Bewegung mit dem Werkzeug davorsetzen.",
  "Put parts of it into another program.": "Teile davon in ein anderes Programm legen.",
  "Put parts of it into routines of their own.": "Teile davon in eigene Routinen legen.",
  "Put some of them into another program.": "Einige davon in ein anderes Programm legen.",
  "Say it in fewer words.": "Kürzer fassen.",
  "Search for a digital line.": "Nach einem digitalen Signal suchen.",
  "Speeds of paths end at {speed} mm/s.": "Bahngeschwindigkeiten enden bei {speed} mm/s.",
  "Teach the point as joint angles, or leave the posture to the robot.":
    "Den Punkt als Achswinkel teachen, oder die Stellung dem Roboter überlassen.",
  "Teach the point on the arc.": "Den Punkt auf dem Bogen teachen.",
  "The loops of the program need more than the {n} number registers of the controller.":
    "Die Schleifen des Programms brauchen mehr als die {n} Zahlenregister der Steuerung.",
  "The pallets of the program need more than the {n} position registers of the controller.":
    "Die Paletten des Programms brauchen mehr als die {n} Positionsregister der Steuerung.",
  "The program {name} has {n} lines; a listing numbers {most}.":
    "Das Programm {name} hat {n} Zeilen; eine Liste nummeriert {most}.",
  "Turn the sense of the line in the controller's configuration.":
    "Den Sinn des Signals in der Konfiguration der Steuerung umkehren.",
  "Turn the sense of the line in the controller.": "Den Sinn des Signals in der Steuerung umkehren.",
  "Turn the tool or move the pallet, so that one posture reaches all places, or teach the places one by one.":
    "Das Werkzeug drehen oder die Palette verschieben, so dass eine Stellung alle Plätze erreicht, oder die Plätze " +
    "einzeln teachen.",
  "Use fewer of them in one program.": "Weniger davon in einem Programm verwenden.",
  "Visit it by rows.": "Zeilenweise besuchen.",
  "Wait twice, or for a signal.": "Zweimal warten, oder auf ein Signal.",
  "Step {step} compares the line {signal} with a number.":
    "Schritt {step} vergleicht das Signal {signal} mit einer Zahl.",
  "Step {step} has no point to pass through.": "Schritt {step} hat keinen Hilfspunkt.",
  "Step {step} is a search along a joint move; RAPID searches on straight lines and arcs.":
    "Schritt {step} ist eine Suchfahrt auf einer Achsbewegung; RAPID sucht auf Geraden und Bögen.",
  "Step {step} is a pulse that goes off; PULSE goes on.": "Schritt {step} ist ein Puls nach aus; PULSE geht nach ein.",
  "Step {step} is a pulse that goes off; PulseDO goes on.":
    "Schritt {step} ist ein Puls nach aus; PulseDO geht nach ein.",
  "Step {step} says a load.": "Schritt {step} nennt eine Last.",
  "Step {step} searches for a level; RAPID searches for a digital line.":
    "Schritt {step} sucht einen Pegel; RAPID sucht ein digitales Signal.",
  "Step {step} turns joint {n} to {value}°; it may turn from {lower}° to {upper}°.":
    "Schritt {step} dreht Achse {n} auf {value}°; erlaubt ist {lower}° bis {upper}°.",
  "Step {step} turns axis {n} to {value}°; it may turn from {lower}° to {upper}°.":
    "Schritt {step} dreht Achse {n} auf {value}°; erlaubt ist {lower}° bis {upper}°.",
  "Step {step} holds {n} joint angles; the {robot} has {joints} joints.":
    "Schritt {step} enthält {n} Achswinkel; der {robot} hat {joints} Achsen.",
  "Step {step} uses the line {signal} with the number {n}, which {other} has.":
    "Schritt {step} verwendet das Signal {signal} mit der Nummer {n}, die {other} hat.",
  "Step {step} uses the line {signal} with the number {n}; {language} counts lines from {first} to {last}.":
    "Schritt {step} verwendet das Signal {signal} mit der Nummer {n}; {language} zählt Signale von {first} bis {last}.",
  "Step {step} uses the line {signal}, which is not in the list of signals.":
    "Schritt {step} verwendet das Signal {signal}, das nicht in der Signalliste steht.",
  "Step {step} uses the line {signal}, whose number is not known.":
    "Schritt {step} verwendet das Signal {signal}, dessen Nummer nicht bekannt ist.",
  "Step {step} uses the line {signal}, whose number on the controller is not given.":
    "Schritt {step} verwendet das Signal {signal}, dessen Nummer an der Steuerung nicht angegeben ist.",
  "Step {step} uses the output {n}, which is the gripper's.":
    "Schritt {step} verwendet den Ausgang {n}, der dem Greifer gehört.",
  "Step {step} visits the interleaved pallet {pallet} by columns, which no plain loop does.":
    "Schritt {step} besucht die versetzte Palette {pallet} spaltenweise; das tut keine einfache Schleife.",
  "Step {step} waits {s} s; WAIT goes up to {most} s.": "Schritt {step} wartet {s} s; WAIT geht bis {most} s.",
  "Step {step} works on the pallet {pallet}, which the program does not have.":
    "Schritt {step} arbeitet an der Palette {pallet}, die das Programm nicht hat.",
  "Step {step} writes the line {signal}, which is an input.":
    "Schritt {step} schreibt das Signal {signal}, das ein Eingang ist.",
  "Step {step} writes {value} to the line {signal}, which is no digital output.":
    "Schritt {step} schreibt {value} auf das Signal {signal}, das kein digitaler Ausgang ist.",
  "Step {step} writes {value} to an analogue output; the controller takes 0 to 1.":
    "Schritt {step} schreibt {value} auf einen Analogausgang; die Steuerung nimmt 0 bis 1.",
};
