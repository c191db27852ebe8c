import type { Sentences } from "../../sentences.ts";

/** German: what the check finds, why, and the ways out. */
export const saidByChecks: Sentences = {
  // Reach
  "The pose can be reached in 1 way.": "Die Pose ist auf eine Art erreichbar.",
  "The pose can be reached in {n} ways.": "Die Pose ist auf {n} Arten erreichbar.",
  "The wrist would be {far} from the shoulder; the arm is {reach} long.":
    "Das Handgelenk wäre {far} von der Schulter entfernt; der Arm ist {reach} lang.",
  "The wrist would be {near} from the shoulder; it cannot come nearer than {least}.":
    "Das Handgelenk wäre {near} von der Schulter entfernt; näher als {least} kann es nicht kommen.",
  "The wrist would be {far} from axis 2; the maker declares a reach of {reach}.":
    "Das Handgelenk wäre {far} von Achse 2 entfernt; der Hersteller gibt {reach} Reichweite an.",
  "The wrist would be {far} from axis 2; {robot} is declared to reach {reach}.":
    "Das Handgelenk wäre {far} von Achse 2 entfernt; für {robot} sind {reach} Reichweite angegeben.",
  "The wrist can be brought there, but its axes 4 and 5 would have to stand {angle} off the angle they are built at.":
    "Das Handgelenk kommt dorthin, aber seine Achsen 4 und 5 müssten {angle} von dem Winkel abweichen, in dem sie " +
    "gebaut sind.",
  "Joint {n} would turn to {value}; its limit is {limit}.":
    "Achse {n} würde auf {value} drehen; ihre Grenze ist {limit}.",
  "Joint {n} would slide to {value}; its limit is {limit}.":
    "Achse {n} würde auf {value} fahren; ihre Grenze ist {limit}.",
  "Joint {n} turns to {value}, {room} before its limit of {limit}.":
    "Achse {n} dreht auf {value}, {room} vor ihrer Grenze von {limit}.",
  "Joint {n} slides to {value}, {room} before its limit of {limit}.":
    "Achse {n} fährt auf {value}, {room} vor ihrer Grenze von {limit}.",
  "No posture of {robot} was found for this pose.": "Für diese Pose wurde keine Stellung des {robot} gefunden.",
  "No solution of the wanted branch exists for this pose.":
    "Für diese Pose gibt es in der gewünschten Konfiguration keine Lösung.",
  "A coordinate of the pose is not a finite number.": "Eine Koordinate der Pose ist keine endliche Zahl.",
  "There is no robot in the cell.": "In der Zelle steht kein Roboter.",
  "{robot} has no closed-form solver, and following from the posture before did not reach the pose.":
    "{robot} hat keine geschlossene Lösung, und von der vorigen Stellung aus wurde die Pose nicht erreicht.",

  // Singularities
  "The wrist is {angle} from straight; below {least} joints 4 and 6 turn fast.":
    "Das Handgelenk ist {angle} von der Strecklage entfernt; unter {least} drehen die Achsen 4 und 6 schnell.",
  "The elbow is {angle} from stretched; below {least} joints 2 and 3 turn fast.":
    "Der Ellbogen ist {angle} von der Strecklage entfernt; unter {least} drehen die Achsen 2 und 3 schnell.",
  "Joint 5 is {angle}° from where axes 4 and 6 are in line.":
    "Achse 5 ist {angle}° von der Lage entfernt, in der die Achsen 4 und 6 fluchten.",
  "Joint 5 is {angle}° from where axes 4 and 6 are parallel.":
    "Achse 5 ist {angle}° von der Lage entfernt, in der die Achsen 4 und 6 parallel sind.",
  "Joint 3 is {angle}° from where the arm is in one line.":
    "Achse 3 ist {angle}° von der Strecklage des Arms entfernt.",
  "Joint 4 is {angle} from where the arm is in one line.": "Achse 4 ist {angle} von der Strecklage des Arms entfernt.",
  "Joint 6 is {angle} from where axes 5 and 7 are in line.":
    "Achse 6 ist {angle} von der Lage entfernt, in der die Achsen 5 und 7 fluchten.",
  "Joint 2 is {angle} from where axes 1 and 3 are in line.":
    "Achse 2 ist {angle} von der Lage entfernt, in der die Achsen 1 und 3 fluchten.",
  "The wrist centre is {far} mm from axis 1, where joint 1 has no hold on it.":
    "Der Mittelpunkt des Handgelenks ist {far} mm von Achse 1 entfernt; dort kann Achse 1 ihn nicht bewegen.",

  "Joint {n} is taught beyond its limit.": "Achse {n} ist jenseits ihrer Grenze geteacht.",
  "The arm is taught beyond its workspace.": "Der Arm ist jenseits seines Arbeitsraums geteacht.",

  // Branch
  "Joint {n} turns by {angle} while the arm changes from {before} to {after}.":
    "Achse {n} dreht um {angle}, während der Arm von {before} nach {after} wechselt.",
  "Joint {n} would be at {value} at the end of the path; it was taught at {taught}.":
    "Achse {n} stünde am Ende der Bahn bei {value}; geteacht wurde sie bei {taught}.",
  "The path ends with {arrived}; it was taught with {taught}.":
    "Die Bahn endet mit {arrived}; geteacht wurde sie mit {taught}.",
  "The path can only go on if the arm turns over before this step: joint {n} by {angle} where it stands.":
    "Die Bahn geht nur weiter, wenn der Arm vor diesem Schritt umschlägt: Achse {n} um {angle} auf der Stelle.",
  "The path can only go on if the arm turns over before this step from {before} to {after}: joint {n} by {angle} where it stands.":
    "Die Bahn geht nur weiter, wenn der Arm vor diesem Schritt von {before} nach {after} umschlägt: Achse {n} um " +
    "{angle} auf der Stelle.",
  "shoulder {shoulder}, elbow {elbow}, wrist {wrist}": "Schulter {shoulder}, Ellbogen {elbow}, Handgelenk {wrist}",
  front: "vorn",
  back: "hinten",
  up: "oben",
  down: "unten",
  positive: "positiv",
  negative: "negativ",

  // Collision
  "{a} comes within {distance} of {b} at {time}; the margin is {margin}.":
    "{a} kommt {b} bei {time} auf {distance} nahe; der Sicherheitsabstand ist {margin}.",
  "{a} comes within {distance} of {b} at {time}; the margin is {margin}, {shape} of it for the error of the drawn shape.":
    "{a} kommt {b} bei {time} auf {distance} nahe; der Sicherheitsabstand ist {margin}, davon {shape} für den " +
    "Formfehler.",
  "{a} touches {b} at {time}.": "{a} berührt {b} bei {time}.",
  "{what} The controller may round this corner otherwise than planned: use zone 0, or leave more room.":
    "{what} Die Steuerung kann diese Ecke anders verschleifen als geplant: Zone 0 nehmen oder mehr Platz lassen.",
  "The corner at {time} is not proven clear all over: the arm does not reach all of what a controller may make of it in this posture. Use zone 0, or a smaller one.":
    "Die Ecke bei {time} ist nicht überall als frei bewiesen: Der Arm erreicht in dieser Stellung nicht alles, was eine " +
    "Steuerung daraus machen kann. Zone 0 nehmen oder eine kleinere.",
  "Stop at the point: zone 0.": "Am Punkt halten: Zone 0.",
  "{a} would touch {b} at {time}.": "{a} würde {b} bei {time} berühren.",
  "{a} would touch {b}.": "{a} würde {b} berühren.",
  "Something would be touched.": "Etwas würde berührt.",
  "the tool": "das Werkzeug",
  "The tool": "Das Werkzeug",
  tool: "Werkzeug",
  "link {n}": "Glied {n}",
  "Link {n}": "Glied {n}",
  "the held {name}": "das gegriffene {name}",
  "The held {name}": "Das gegriffene {name}",
  "Between the robot and what stands around it {total} are kept: {parts}.":
    "Zwischen dem Roboter und dem, was um ihn steht, werden {total} eingehalten: {parts}.",

  // Speed, torque, load
  "Joint {n} would turn at {value}; its limit is {limit}.":
    "Achse {n} würde mit {value} drehen; ihre Grenze ist {limit}.",
  "Joint {n} would slide at {value}; its limit is {limit}.":
    "Achse {n} würde mit {value} fahren; ihre Grenze ist {limit}.",
  "Joint {n} would accelerate at {value}²; its limit is {limit}².":
    "Achse {n} würde mit {value}² beschleunigen; ihre Grenze ist {limit}².",
  "Joint {n} would need a jerk of {value}³; its limit is {limit}³.":
    "Achse {n} bräuchte einen Ruck von {value}³; ihre Grenze ist {limit}³.",
  "Joint {n} would need {value}; its limit is {limit}.": "Achse {n} bräuchte {value}; ihre Grenze ist {limit}.",
  "Joint {n} would need {value} with {load} kg; its limit is {limit}.":
    "Achse {n} bräuchte {value} mit {load} kg; ihre Grenze ist {limit}.",
  "The weight of the arm asks {value} of joint {n}; its limit is {limit}.":
    "Das Gewicht des Arms verlangt {value} von Achse {n}; ihre Grenze ist {limit}.",
  "The weight of the arm with {load} kg asks {value} of joint {n}; its limit is {limit}.":
    "Das Gewicht des Arms mit {load} kg verlangt {value} von Achse {n}; ihre Grenze ist {limit}.",
  "No joint is asked for torque.": "Von keiner Achse wird Drehmoment verlangt.",
  "Joint {n} is asked most: {value} of {limit} N m at {time} s.":
    "Am meisten verlangt wird von Achse {n}: {value} von {limit} N m bei {time} s.",
  "Joint {n} is asked most: {value} of {limit} N at {time} s.":
    "Am meisten verlangt wird von Achse {n}: {value} von {limit} N bei {time} s.",
  "The torques of {robot} cannot be judged: what its joints can give is not published.":
    "Die Drehmomente des {robot} lassen sich nicht beurteilen: Was seine Achsen leisten, ist nicht veröffentlicht.",
  "The {what} weighs {load} kg; the {robot} lifts at most {limit} kg.":
    "{what}: {load} kg; der {robot} hebt höchstens {limit} kg.",
  "The {what} weighs {load} kg; above {limit} kg the {robot} moves at reduced speed.":
    "{what}: {load} kg; über {limit} kg bewegt sich der {robot} langsamer.",
  "tool alone": "Werkzeug allein",
  "tool with “{part}”": "Werkzeug mit „{part}“",
  "The load is {load} kg; the {robot} lifts at most {limit} kg.":
    "Die Last ist {load} kg; der {robot} hebt höchstens {limit} kg.",
  "The load is {load} kg; above {limit} kg the {robot} moves at reduced speed.":
    "Die Last ist {load} kg; über {limit} kg fährt der {robot} mit verminderter Geschwindigkeit.",
  "{robot} weighs {mass} kg; {stand} carries {limit} kg.": "{robot} wiegt {mass} kg; {stand} trägt {limit} kg.",
  "{robot} weighs {mass} kg and carries {load} kg, {total} kg together; {stand} carries {limit} kg.":
    "{robot} wiegt {mass} kg und trägt {load} kg, zusammen {total} kg; {stand} trägt {limit} kg.",
  "The {what} of {name} is not published: whether its stand carries it is not judged.":
    "{what} von {name} ist nicht veröffentlicht: Ob der Sockel ihn trägt, wird nicht beurteilt.",
  "Carry at most {load} kg; at this speed it is held.":
    "Höchstens {load} kg tragen; bei dieser Geschwindigkeit hält es.",

  // Flow, signals, edges
  "The loop goes round for ever without a motion or a wait.": "Die Schleife läuft endlos ohne Bewegung oder Warten.",
  "The program never comes to this step.": "Das Programm kommt nie zu diesem Schritt.",
  "The program has no signal “{signal}”.": "Das Programm hat kein Signal „{signal}“.",
  "“{signal}” is an input; only outputs can be set.": "„{signal}“ ist ein Eingang; nur Ausgänge lassen sich setzen.",
  "“{signal}” is a digital signal; it is on or off and has no level.":
    "„{signal}“ ist ein digitales Signal; es ist ein oder aus und hat keinen Pegel.",
  "“{signal}” is an analogue signal; it has a level and is not on or off.":
    "„{signal}“ ist ein analoges Signal; es hat einen Pegel und ist nicht ein oder aus.",
  "Use “{signal}”.": "„{signal}“ verwenden.",
  "{object} no longer has the edge that {name} was traced on. Trace it again.":
    "{object} hat die Kante nicht mehr, an der {name} abgefahren wurde. Neu abfahren.",
  "The object that {name} was traced on is no longer in the cell. Trace the edge of another, or delete these points.":
    "Das Objekt, an dem {name} abgefahren wurde, steht nicht mehr in der Zelle. Die Kante eines anderen " +
    "abfahren, oder " +
    "diese Punkte löschen.",
  "{off} mm off the edge of {object} it was traced on; {limit} mm are allowed. Trace the edge again, or attach the points to {other} before you move it.":
    "{off} mm neben der abgefahrenen Kante von {object}; {limit} mm sind erlaubt. Die Kante neu abfahren, oder die " +
    "Punkte an {other} befestigen, bevor es bewegt wird.",
  "{place}: {finding} One more place has the same finding.":
    "{place}: {finding} Ein weiterer Platz hat denselben Befund.",
  "{place}: {finding} {n} more places have the same finding.":
    "{place}: {finding} {n} weitere Plätze haben denselben Befund.",
  "The next time round: {finding}": "Beim nächsten Durchlauf: {finding}",
  "Place {n} of {of}: {finding}": "Platz {n} von {of}: {finding}",
  "Place {n} of {of}": "Platz {n} von {of}",

  // Ways out
  "Make it a joint move.": "Als Achsbewegung (PTP) fahren.",
  "Raise the target by {height}.": "Das Ziel um {height} anheben.",
  "Go there over a point {height} above the target.": "Über einen Punkt {height} über dem Ziel anfahren.",
  "Bring joint {n} back to {value}.": "Achse {n} auf {value} zurücknehmen.",
  "Move the point {by}.": "Den Punkt {by} verschieben.",
  "Move “{name}” {by}.": "„{name}“ {by} verschieben.",
  "Move the robot {by}.": "Den Roboter {by} umstellen.",
  "{value} in {axis}": "{value} in {axis}",
  "{a} in {axis} and {b} in {other}": "{a} in {axis} und {b} in {other}",
  "{value} mm up": "{value} mm nach oben",
  "{value} mm down": "{value} mm nach unten",
  "Turn the tool by {angle} about its own axis.": "Das Werkzeug um {angle} um die eigene Achse drehen.",
  "Turn the tool by {angle} about its own axis, at {n} points.":
    "Das Werkzeug an {n} Punkten um {angle} um die eigene Achse drehen.",
  "Tilt the tool by {angle} about its {axis} axis.": "Das Werkzeug um {angle} um seine {axis}-Achse kippen.",
  "Tilt the tool by {angle} about its {axis} axis, at {n} points.":
    "Das Werkzeug an {n} Punkten um {angle} um seine {axis}-Achse kippen.",
  "Tilt the tool by {angle} about an axis {from} from its x axis.":
    "Das Werkzeug um {angle} um eine Achse kippen, die {from} neben seiner x-Achse liegt.",
  "Take the posture with shoulder {shoulder}, elbow {elbow}, wrist {wrist}.":
    "Die Stellung mit Schulter {shoulder}, Ellbogen {elbow}, Handgelenk {wrist} nehmen.",
  "Go there by a joint move with shoulder {shoulder}, elbow {elbow}, wrist {wrist}.":
    "Mit einer Achsbewegung hinfahren, mit Schulter {shoulder}, Ellbogen {elbow}, Handgelenk {wrist}.",
  "Turn the tool by {angle}° about its own axis.": "Das Werkzeug um {angle}° um die eigene Achse drehen.",
  "Tilt the tool by {angle}° about its {axis} axis.": "Das Werkzeug um {angle}° um seine {axis}-Achse kippen.",
  "Move the target {mm} mm towards the robot.": "Das Ziel {mm} mm zum Roboter hin verschieben.",
  "Move the target {mm} mm away from the robot.": "Das Ziel {mm} mm vom Roboter weg verschieben.",
  "Lower the speed to {value}.": "Die Geschwindigkeit auf {value} senken.",
  "Lower the speed to {value} %.": "Die Geschwindigkeit auf {value} % senken.",
  "Lower the speed to {value} and the acceleration to {percent} %.":
    "Die Geschwindigkeit auf {value} und die Beschleunigung auf {percent} % senken.",
  "Give it {time} and the acceleration to {percent} %.":
    "Der Bewegung {time} Zeit geben und die Beschleunigung auf {percent} % senken.",
  "Give it {time}.": "Der Bewegung {time} Zeit geben.",
  "Put the point back onto the edge of {object}.": "Den Punkt auf die Kante von {object} zurücklegen.",
  "Put {points} back onto the edge of {object}.": "{points} auf die Kante von {object} zurücklegen.",
  "{n} points": "{n} Punkte",
  "Go there by a joint move; nothing is in its way.": "Mit einer Achsbewegung hinfahren; ihr ist nichts im Weg.",
  "Go round over one more point.": "Über einen weiteren Punkt herumfahren.",
  "Go round over {n} more points.": "Über {n} weitere Punkte herumfahren.",
  "{name} does not help.": "{name} hilft nicht.",
  "The search ended after {n} checks of the whole program.":
    "Die Suche endete nach {n} Prüfungen des ganzen Programms.",
  "The robot is not moved: the program has points that are joint angles.":
    "Der Roboter wird nicht umgestellt: Das Programm hat Punkte aus Achswinkeln.",
  "There the tool stands {angle}° off straight down, {far} mm from axis 1.":
    "Dort steht das Werkzeug {angle}° schräg, {far} mm von Achse 1.",
  "That is so at {at} of the step.": "Das ist so bei {at} des Schritts.",
  "That is so from {from} to {to} of the step.": "Das ist so von {from} bis {to} des Schritts.",
  "The pose can be reached.": "Die Pose ist erreichbar.",
  "With {branch} it can be reached.": "Mit {branch} ist sie erreichbar.",
  "The one posture that reaches the pose touches something.":
    "Die einzige Stellung, die die Pose erreicht, berührt etwas.",
  "All {n} postures that reach the pose touch something.":
    "Alle {n} Stellungen, die die Pose erreichen, berühren etwas.",

  // Detours
  "This step is no move that can be carried out, so there is nothing to lead round.":
    "Dieser Schritt ist keine ausführbare Bewegung; es gibt nichts herumzuführen.",
  "Mend what stops it first; the check says what it is.": "Erst beheben, was ihn aufhält; die Prüfung nennt es.",
  "Mend the step before, where the robot comes to stand like this.":
    "Den Schritt davor ändern, in dem der Roboter so zu stehen kommt.",
  "Move the target, or tilt the tool.": "Das Ziel verschieben, oder das Werkzeug kippen.",
  "Bring the joint inside its limits first.": "Erst die Achse in ihre Grenzen bringen.",
  "Make room in the cell, or split the move with a point of your own.":
    "In der Zelle Platz schaffen, oder die Bewegung mit einem eigenen Punkt teilen.",
  "A free way was found, but a joint move along it fails the program's check.":
    "Ein freier Weg wurde gefunden, aber eine Achsbewegung darauf besteht die Prüfung des Programms nicht.",
  "Lower the speed of the step, then try again.":
    "Die Geschwindigkeit des Schritts senken, dann noch einmal versuchen.",
  "The search was cancelled.": "Die Suche wurde abgebrochen.",
  "Start it again when you like.": "Sie lässt sich jederzeit neu starten.",
  "At the start of the step {a} is in contact with {b}; no way leads out of that.":
    "Am Anfang des Schritts hat {a} Kontakt mit {b}; kein Weg führt da heraus.",
  "At the target {a} is in contact with {b}; no way leads into that.":
    "Am Ziel hat {a} Kontakt mit {b}; kein Weg führt da hinein.",
  "At the start of the step joint {n} is at {value}; its limit is {limit}.":
    "Am Anfang des Schritts steht Achse {n} bei {value}; ihre Grenze ist {limit}.",
  "At the target joint {n} is at {value}; its limit is {limit}.":
    "Am Ziel steht Achse {n} bei {value}; ihre Grenze ist {limit}.",
  "No free way was found in {n} postures; there may be none.":
    "In {n} Stellungen wurde kein freier Weg gefunden; vielleicht gibt es keinen.",

  // What a result rests on
  "Torques are those of masses and accelerations; friction is not counted.":
    "Drehmomente stammen aus Massen und Beschleunigungen; Reibung ist nicht eingerechnet.",
  "Collisions were not looked at: no cell was given.": "Kollisionen wurden nicht geprüft: Keine Zelle war gegeben.",
  "Objects stand where the cell draws them.": "Objekte stehen dort, wo die Zelle sie zeichnet.",
  "Gripped parts stand where they were drawn: the program decides between motions, and a part may be held on one side only.":
    "Gegriffene Teile stehen, wo sie gezeichnet wurden: Das Programm entscheidet zwischen Bewegungen, " +
    "und ein Teil wird " +
    "womöglich nur auf einer Seite gehalten.",
  "The part at the grip point moves with the gripper from where it closes to where it opens, and stays there; nothing that lies on it comes along.":
    "Das Teil am Greifpunkt bewegt sich mit dem Greifer vom Schließen bis zum Öffnen und bleibt dort; " +
    "was darauf liegt, " +
    "kommt nicht mit.",
  "The gripper closes on nothing once: no work piece is drawn within {mm} mm of its grip point.":
    "Der Greifer schließt einmal ins Leere: Im Umkreis von {mm} mm um seinen Greifpunkt ist kein Werkstück gezeichnet.",
  "The gripper closes on nothing {n} times: no work piece is drawn within {mm} mm of its grip point.":
    "Der Greifer schließt {n}-mal ins Leere: Im Umkreis von {mm} mm um seinen Greifpunkt ist kein Werkstück " +
    "gezeichnet.",
  "The gripper is given {s} s to close or open.": "Der Greifer erhält {s} s zum Schließen oder Öffnen.",
  "Decisions that variables alone take were followed; where inputs decide, every way was looked at.":
    "Entscheidungen, die allein Variablen treffen, wurden verfolgt; wo Eingänge entscheiden, wurde jeder Weg betrachtet.",
  "Waits for signals are given no time.": "Warten auf Signale wird keine Zeit gegeben.",
  "Both sides of every decision were looked at, one after the other in the plan.":
    "Beide Seiten jeder Entscheidung wurden geprüft, im Plan nacheinander.",
  "Loops without end were looked at twice round.": "Endlose Schleifen wurden zwei Durchläufe lang geprüft.",
  "Searches were looked at as if nothing is found before their end.":
    "Suchfahrten wurden geprüft, als würde bis zu ihrem Ende nichts gefunden.",
  "Beyond {n} steps, loops were looked at twice round; the duration is less than that of the whole program.":
    "Ab {n} Schritten wurden Schleifen zwei Durchläufe lang geprüft; die Dauer ist kürzer als die des " +
    "ganzen Programms.",
  "Joint jerks are not published: full joint acceleration is assumed to be reached in {s} s.":
    "Die Achsrucke sind nicht veröffentlicht: Es wird angenommen, dass die volle Achsbeschleunigung in " +
    "{s} s erreicht " +
    "wird.",
  "Joint accelerations are not published: full joint speed is assumed to be reached in 0.25 s.":
    "Die Achsbeschleunigungen sind nicht veröffentlicht: Es wird angenommen, dass die volle Achsgeschwindigkeit in " +
    "0,25 s erreicht wird.",
  "Joint accelerations are not in the robot file: full joint speed is assumed to be reached in {s} s.":
    "Die Achsbeschleunigungen stehen nicht in der Roboterdatei: Es wird angenommen, dass die volle " +
    "Achsgeschwindigkeit " +
    "in {s} s erreicht wird.",
  "The largest speed of the tool tip is not published: {speed} m/s is assumed.":
    "Die Höchstgeschwindigkeit der Werkzeugspitze ist nicht veröffentlicht: {speed} m/s werden angenommen.",
  "The largest speed of the tool tip is not known: {speed} m/s is assumed.":
    "Die Höchstgeschwindigkeit der Werkzeugspitze ist nicht bekannt: {speed} m/s werden angenommen.",
  "Link shapes are drawn from castings fitted to published meshes; how far they are off was measured and comes on top of every clearance margin.":
    "Die Glieder sind nach Formen gezeichnet, die an veröffentlichte Netze angepasst sind; ihre Abweichung wurde " +
    "gemessen und kommt zu jedem Sicherheitsabstand hinzu.",
  "Link shapes are drawn from the published dimensions, not from the vendor's CAD; how far they are off is an estimate.":
    "Die Glieder sind nach den veröffentlichten Maßen gezeichnet, nicht nach dem CAD des Herstellers; " +
    "ihre Abweichung " +
    "ist geschätzt.",
  "Link shapes are drawn from the made-up lengths.": "Die Glieder sind nach den erfundenen Längen gezeichnet.",
  "Commonly quoted from the vendor's data sheet; not checked against the document.":
    "Üblicherweise nach dem Datenblatt des Herstellers zitiert; nicht am Dokument geprüft.",
  "Masses of the links are not published.": "Die Massen der Glieder sind nicht veröffentlicht.",
  "Centres of mass and inertias of the links are not published.":
    "Schwerpunkte und Trägheiten der Glieder sind nicht veröffentlicht.",
  "Part of the name that the maker gives the model.": "Teil des Namens, den der Hersteller dem Modell gibt.",
  "The maker's data sheet of the model.": "Das Datenblatt des Herstellers zum Modell.",
  "Computed from these lengths.": "Aus diesen Längen errechnet.",
  "The payload is not stated: whether the robot carries a load is unknown.":
    "Die Traglast ist nicht angegeben: Ob der Roboter eine Last trägt, ist unbekannt.",
};
