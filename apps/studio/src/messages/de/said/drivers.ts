import type { Sentences } from "../../sentences.ts";

/** German: what drivers and virtual controllers of single vendors refuse, and what to do then. */
export const saidByDrivers: Sentences = {
  // State of a controller
  "A program that was not started here is running on {robot}.":
    "Auf {robot} läuft ein Programm, das nicht von hier gestartet wurde.",
  "A protective stop of {robot} can be unlocked {seconds} s after it happened, not sooner.":
    "Ein Schutzhalt von {robot} lässt sich frühestens {seconds} s danach aufheben.",
  "High power is off.": "Die Leistung ist aus.",
  "Its outputs are digital_out_0 to digital_out_17 and analog_out_0 to analog_out_1.":
    "Seine Ausgänge sind digital_out_0 bis digital_out_17 und analog_out_0 bis analog_out_1.",
  "RSI does not run: nothing is heard from the controller's sensor interface.":
    "RSI läuft nicht: Von der Sensorschnittstelle der Steuerung kommt nichts.",
  "RSI ended before the motion did; the robot stopped.": "RSI endete vor der Bewegung; der Roboter hielt an.",
  "The emergency stop is pressed.": "Der Not-Halt ist gedrückt.",
  "The emergency stop of {robot} is pressed.": "Der Not-Halt von {robot} ist gedrückt.",
  "The mode is {mode}; the arm is jogged in manual mode.":
    "Die Betriebsart ist {mode}; verfahren wird der Arm im Handbetrieb.",
  "The motion ended short of its target.": "Die Bewegung endete vor ihrem Ziel.",
  "The motors are off.": "Die Motoren sind aus.",
  "The motors of {robot} are not switched by EGM.": "Die Motoren von {robot} werden nicht über EGM geschaltet.",
  "The motors of {robot} are on, but no program there waits for targets.":
    "Die Motoren von {robot} sind an, aber kein Programm wartet dort auf Ziele.",
  "The pendant is in COMP mode.": "Das Handgerät ist im Modus COMP.",
  "The pendant is not enabled.": "Das Handgerät ist nicht freigegeben.",
  "The robot braked by itself: nothing was heard from here for too long.":
    "Der Roboter bremste selbst: Von hier kam zu lange nichts.",
  "The robot has stood short of its target for {seconds} s; the motion was cancelled.":
    "Der Roboter stand {seconds} s vor seinem Ziel; die Bewegung wurde abgebrochen.",
  "The robot stands {angle}° beside its target.": "Der Roboter steht {angle}° neben seinem Ziel.",
  "The robot stopped before the motion ended.": "Der Roboter hielt an, bevor die Bewegung zu Ende war.",
  "The safeguard of {robot} is open.": "Die Schutzeinrichtung von {robot} ist offen.",
  "The servo power of {robot} did not come on within {seconds} s.":
    "Die Servoleistung von {robot} ging in {seconds} s nicht an.",
  "The servos are off.": "Die Servos sind aus.",
  "The servos are off: {why}.": "Die Servos sind aus: {why}.",
  "The speed of a job of {robot} is set at its pendant.":
    "Die Geschwindigkeit eines Jobs von {robot} wird an seinem Handgerät eingestellt.",
  "{why} It cannot be switched on over this connection.":
    "{why} Einschalten lässt er sich über diese Verbindung nicht.",
  "{why} The motion was cancelled.": "{why} Die Bewegung wurde abgebrochen.",
  "{why} The motion was ended.": "{why} Die Bewegung wurde beendet.",
  "{robot} came to rest before its target.": "{robot} kam vor seinem Ziel zum Stehen.",
  "{robot} is in local control: its teach pendant has it.": "{robot} ist in lokaler Steuerung: Das Handgerät hat ihn.",
  "{robot} is in manual mode: its motors and programs are its pendant's.":
    "{robot} ist im Handbetrieb: Motoren und Programme gehören dem Handgerät.",
  "{robot} is in remote control; its pendant jogs in local control only.":
    "{robot} ist ferngesteuert; sein Handgerät verfährt nur in lokaler Steuerung.",
  "{robot} is not ready to move.": "{robot} ist nicht bereit.",
  "{robot} is not ready to move: robot mode {mode}, safety mode {safety}.":
    "{robot} ist nicht bereit: Robotermodus {mode}, Sicherheitsmodus {safety}.",
  "{robot} is still moving.": "{robot} bewegt sich noch.",
  "{robot} was not {state} within {seconds} s.": "{robot} war in {seconds} s nicht {state}.",
  // Another robot than expected
  "How V+ counts the joints of {robot} is not known.": "Wie V+ die Achsen von {robot} zählt, ist nicht bekannt.",
  "How a FANUC controller shows the joints of {robot} is not known.":
    "Wie eine FANUC-Steuerung die Achsen von {robot} zeigt, ist nicht bekannt.",
  "How a KUKA controller counts the axes of {robot} is not known.":
    "Wie eine KUKA-Steuerung die Achsen von {robot} zählt, ist nicht bekannt.",
  "Joint {n} of the controller's robot stands at {value}, where a {robot} cannot be.":
    "Achse {n} des Roboters der Steuerung steht auf {value}; dort kann ein {robot} nicht sein.",
  "The controller moves a robot of {n} joints; {robot} has {joints}.":
    "Die Steuerung bewegt einen Roboter mit {n} Achsen; {robot} hat {joints}.",
  "The controller tells of a joint {n}; {robot} has {joints}.":
    "Die Steuerung nennt eine Achse {n}; {robot} hat {joints}.",
  "The pulses per degree of this {robot} are not known.": "Die Impulse je Grad dieses {robot} sind nicht bekannt.",
  "The pulses per degree of {n} axes are given for {robot}, which has {axes}.":
    "Die Impulse je Grad sind für {n} Achsen von {robot} angegeben, der {axes} hat.",
  "{robot} counts its joints as V+ does, not as VAL 3: a CS8 or CS9 would move it elsewhere.":
    "{robot} zählt seine Achsen wie V+, nicht wie VAL 3: Eine CS8 oder CS9 würde ihn anderswohin bewegen.",
  "{robot} has {axes} axes; the robot whose controller sends has {n}.":
    "{robot} hat {axes} Achsen; der Roboter, dessen Steuerung sendet, hat {n}.",
  "{robot} has {axes} axes; the {other} that answers has {n}.":
    "{robot} hat {axes} Achsen; der {other}, der antwortet, hat {n}.",
  "{robot} has {joints} joints; a FANUC controller was expected to move {n}.":
    "{robot} hat {joints} Achsen; von einer FANUC-Steuerung wurden {n} erwartet.",
  "{robot} has {joints} joints; robots of Universal Robots have {n}.":
    "{robot} hat {joints} Achsen; Roboter von Universal Robots haben {n}.",
  "{robot} has {joints} joints; the controller of a KUKA counts {n} axes.":
    "{robot} hat {joints} Achsen; die Steuerung eines KUKA zählt {n} Achsen.",
  "{robot} has {joints} joints; the program ros_server moves a Stäubli arm of {n}.":
    "{robot} hat {joints} Achsen; das Programm ros_server bewegt einen Stäubli-Arm mit {n}.",
  '{robot} was expected, known to its controller as "{model}"; the controller says it moves "{other}".':
    "Erwartet wurde {robot}, bei seiner Steuerung „{model}“; die Steuerung sagt, sie bewegt „{other}“.",
  "{robot} was expected, which its controller calls {model}; a {other} answers.":
    "Erwartet wurde {robot}, den seine Steuerung {model} nennt; es antwortet ein {other}.",
  '{robot} was expected; the controller moves the robot "{other}".':
    "Erwartet wurde {robot}; die Steuerung bewegt den Roboter „{other}“.",
  "{robot} was expected; the controller says it moves a {other}.":
    "Erwartet wurde {robot}; die Steuerung sagt, sie bewegt einen {other}.",
  "Choose a robot that stands on a CS7.": "Einen Roboter wählen, der an einer CS7 hängt.",
  "Choose the robot that is there, or give the name that its controller uses.":
    "Den Roboter wählen, der dort steht, oder den Namen angeben, den seine Steuerung benutzt.",
  "Choose the robot that is there, or set the model text that its controller answers.":
    "Den Roboter wählen, der dort steht, oder den Modelltext angeben, den seine Steuerung antwortet.",
  "Choose the robot that is there, or the address of the other one.":
    "Den Roboter wählen, der dort steht, oder die Adresse des anderen.",
  "Choose the robot that is there.": "Den Roboter wählen, der dort steht.",
  "Connect it as a CS7, or describe the robot with VAL 3's zeros.":
    "Ihn als CS7 verbinden, oder den Roboter mit den Nullstellungen von VAL 3 beschreiben.",
  "Give its file a vendor section with the driver fanuc.":
    "Seiner Datei einen Abschnitt „vendor“ mit dem Treiber fanuc geben.",
  "Give the signs and zeros of its axes.": "Vorzeichen und Nullstellungen seiner Achsen angeben.",
  "Take them from the parameter file (ALL.PRM) of its controller.":
    "Sie aus der Parameterdatei (ALL.PRM) seiner Steuerung nehmen.",
  "Take them from the parameter file (ALL.PRM) of the controller.":
    "Sie aus der Parameterdatei (ALL.PRM) der Steuerung nehmen.",
  // The link
  "No EGM message came from {robot} for {ms} ms. Its program was stopped.":
    "Von {robot} kam {ms} ms lang keine EGM-Nachricht. Sein Programm wurde angehalten.",
  "No controller at {address} sends EGM messages to port {port} of this machine.":
    "Keine Steuerung an {address} sendet EGM-Nachrichten an Port {port} dieses Rechners.",
  "No prompt of V+ came within {seconds} s.": "In {seconds} s kam keine Eingabeaufforderung von V+.",
  "Nothing answers at {address} (UDP).": "An {address} (UDP) antwortet nichts.",
  "Robot Web Services of {robot} are gone: {why} The robot was stopped.":
    "Die Robot Web Services von {robot} sind weg: {why} Der Roboter wurde angehalten.",
  "The connection was closed while the robot moved.":
    "Die Verbindung wurde geschlossen, während sich der Roboter bewegte.",
  "The connection was closed while the robot moved; the robot brakes by itself.":
    "Die Verbindung wurde geschlossen, während sich der Roboter bewegte; er bremst selbst.",
  "The controller sent no joint angles and no status within {seconds} s.":
    "Die Steuerung sandte in {seconds} s weder Achswinkel noch Zustand.",
  "The dashboard did not answer “{command}”.": "Das Dashboard antwortete nicht auf „{command}“.",
  "The line to {robot} was closed: without targets it stops by itself.":
    "Die Leitung zu {robot} wurde geschlossen: Ohne Ziele hält er selbst an.",
  "The line to {robot} was closed; a hold was sent as the last word.":
    "Die Leitung zu {robot} wurde geschlossen; zuletzt wurde ein Halt gesendet.",
  "The link was closed.": "Die Verbindung wurde geschlossen.",
  "What {address} answers is too short to be understood.":
    "Was {address} antwortet, ist zu kurz, um verstanden zu werden.",
  "{file}: block {n} came instead of block {wanted}.": "{file}: Block {n} kam statt Block {wanted}.",
  "{file}: more than {n} bytes came.": "{file}: Es kamen mehr als {n} Bytes.",
  "{file}: the controller did not answer for {seconds} s.": "{file}: Die Steuerung antwortete {seconds} s lang nicht.",
  "They are tried again by themselves; motion is not.": "Sie werden von selbst wieder versucht; Bewegungen nicht.",
  // Programs and files
  "The controller did not select and start {program}.": "Die Steuerung hat {program} nicht angewählt und gestartet.",
  "The controller did not start the program {program} ({why}).":
    "Die Steuerung hat das Programm {program} nicht gestartet ({why}).",
  "The controller did not take the file {file}.": "Die Steuerung hat die Datei {file} nicht angenommen.",
  "The controller did not take the motion.": "Die Steuerung hat die Bewegung nicht angenommen.",
  "The controller did not take the point: it lies outside of the software limits set there, its buffer is full, or a program of its pendant has the arm.":
    "Die Steuerung hat den Punkt nicht angenommen: Er liegt außerhalb der dort eingestellten Softwaregrenzen, ihr " +
    "Puffer ist voll, oder ein Programm am Handgerät hat den Arm.",
  "The controller does not tell its axes and its mode.": "Die Steuerung nennt ihre Achsen und Betriebsart nicht.",
  "The controller refused: {why}.": "Die Steuerung lehnte ab: {why}.",
  "The controller stopped the program.": "Die Steuerung hielt das Programm an.",
  "The controller stopped the program: {why}.": "Die Steuerung hielt das Programm an: {why}.",
  "The controller's RSI only sends; it takes no corrections.":
    "Das RSI der Steuerung sendet nur; Korrekturen nimmt es nicht an.",
  "The program cannot be started from here in T1 or T2.":
    "In T1 oder T2 kann das Programm nicht von hier gestartet werden.",
  "The program {program} does not run ({why}).": "Das Programm {program} läuft nicht ({why}).",
  "The program {program} is not in the memory of the controller ({why}).":
    "Das Programm {program} ist nicht im Speicher der Steuerung ({why}).",
  "The program {program} is not on the controller; without it the robot can be watched, not moved.":
    "Das Programm {program} ist nicht auf der Steuerung; ohne es kann der Roboter beobachtet, aber nicht bewegt werden.",
  "The program {program} is not selected{why}.": "Das Programm {program} ist nicht angewählt{why}.",
  "The program {program} on the controller is version {version}; this is version {own}.":
    "Das Programm {program} auf der Steuerung hat Version {version}; hier ist es Version {own}.",
  "The program {program} refused the motion.": "Das Programm {program} lehnte die Bewegung ab.",
  "The proxy on the controller cannot select and start programs.":
    "Der Proxy auf der Steuerung kann Programme nicht anwählen und starten.",
  "The proxy on the controller cannot take files.": "Der Proxy auf der Steuerung kann keine Dateien annehmen.",
  "The proxy on the controller does not read several variables at once.":
    "Der Proxy auf der Steuerung liest nicht mehrere Variablen auf einmal.",
  "There is no RAPID module among the files.": "Unter den Dateien ist kein RAPID-Modul.",
  "There is no TP listing among the files that begins with /PROG and a name.":
    "Unter den Dateien ist kein TP-Listing, das mit /PROG und einem Namen beginnt.",
  "There is no job (.JBI) among the files.": "Unter den Dateien ist kein Job (.JBI).",
  "There is no program text to run.": "Es gibt keinen Programmtext zum Ausführen.",
  "Another program listens there: end it, or set up another port on the controller.":
    "Dort lauscht ein anderes Programm: Es beenden, oder an der Steuerung einen anderen Port einstellen.",
  "Copy the newer files to the controller.": "Die neueren Dateien auf die Steuerung kopieren.",
  "Copy {program}.src and {data}.dat to the controller.": "{program}.src und {data}.dat auf die Steuerung kopieren.",
  "Export the program as INFORM.": "Das Programm als INFORM exportieren.",
  "Export the program in URScript first.": "Das Programm erst als URScript exportieren.",
  "Hand over .LS files, the program to be run first.": "LS-Dateien übergeben, das auszuführende Programm zuerst.",
  "Hand over a .mod with PROC main.": "Eine MOD-Datei mit PROC main übergeben.",
  "LOAD TWINCELL.V2 at the controller, then command the move again.":
    "An der Steuerung LOAD TWINCELL.V2 eingeben, dann die Bewegung noch einmal befehlen.",
  "Load {program} on the controller; the page of ABB's controllers in the documentation says how.":
    "{program} auf die Steuerung laden; wie, steht in der Dokumentation auf der Seite der ABB-Steuerungen.",
  "Put the C3 Bridge, version 1.2 or later, in the place of KUKAVARPROXY.":
    "Die C3 Bridge ab Version 1.2 anstelle von KUKAVARPROXY benutzen.",
  "Set ONLYSEND to FALSE on both sides, or move the robot over its variables.":
    "ONLYSEND auf beiden Seiten auf FALSE setzen, oder den Roboter über seine Variablen bewegen.",
  "Start the program at the pendant, or use the C3 Bridge.":
    "Das Programm am Handgerät starten, oder die C3 Bridge benutzen.",
  "Transfer it by another way.": "Sie auf anderem Weg übertragen.",
  "Try the transfer again.": "Die Übertragung noch einmal versuchen.",
  "Use the C3 Bridge, version 1.1 or later, or copy the files to the controller by hand.":
    "Die C3 Bridge ab Version 1.1 benutzen, oder die Dateien von Hand auf die Steuerung kopieren.",
  "Use up to 32 letters, digits and signs of the Latin alphabet, and .JBI behind them.":
    "Bis zu 32 lateinische Buchstaben, Ziffern und Zeichen verwenden, und .JBI dahinter.",
  // Signals
  "EGM carries targets, no signals.": "EGM überträgt Ziele, keine Signale.",
  "Give it the number of a network input, and let the ladder of the controller pass it on.":
    "Ihm die Nummer eines Netzwerkeingangs geben, und das Kontaktplanprogramm der Steuerung es weitergeben lassen.",
  "Give it the number of a network input, such as 27010.": "Ihm die Nummer eines Netzwerkeingangs geben, etwa 27010.",
  "Give the gripper the number of a network input, such as 27010.":
    "Dem Greifer die Nummer eines Netzwerkeingangs geben, etwa 27010.",
  "Give the number of its DO.": "Die Nummer seines DO angeben.",
  "Give the number of its output.": "Die Nummer seines Ausgangs angeben.",
  "Let the RAPID program on the controller set them.": "Das RAPID-Programm auf der Steuerung sie setzen lassen.",
  "Name a network input (27010 to 29567) instead, or say which one stands for OT#(1).":
    "Stattdessen einen Netzwerkeingang (27010 bis 29567) nennen, oder angeben, welcher für OT#(1) steht.",
  "Name it $OUT[1] to $OUT[4096], or $ANOUT[1] to $ANOUT[32].":
    "Ihn $OUT[1] bis $OUT[4096] nennen, oder $ANOUT[1] bis $ANOUT[32].",
  "Name it DO[1] and so on.": "Ihn DO[1] und so weiter nennen.",
  "Name it as the controller's configuration does (EIO).": "Ihn so nennen wie die Konfiguration der Steuerung (EIO).",
  "Name it out_1 and so on.": "Ihn out_1 und so weiter nennen.",
  "No line is set for the gripper of {robot}.": "Für den Greifer von {robot} ist kein Signal festgelegt.",
  "The control box has no output “{name}”.": "Die Steuerung hat keinen Ausgang „{name}“.",
  'The controller has no signal "{name}".': "Die Steuerung hat kein Signal „{name}“.",
  'The signal "{name}" has no address on this controller.':
    "Das Signal „{name}“ hat auf dieser Steuerung keine Adresse.",
  'The signal "{name}" is line {n}; only network inputs (27010 to 29567) are written from outside.':
    "Das Signal „{name}“ ist {n}; von außen geschrieben werden nur Netzwerkeingänge (27010 bis 29567).",
  'The signal "{name}" is on or off; a level cannot be said to it.':
    "Das Signal „{name}“ ist an oder aus; einen Pegel kann es nicht haben.",
  'The signal "{name}" is output {n}; outputs are switched by the ladder of the controller, and which network input it passes on to them is not said.':
    "Das Signal „{name}“ ist Ausgang {n}; Ausgänge schaltet das Kontaktplanprogramm der Steuerung, und welchen " +
    "Netzwerkeingang es an sie weitergibt, ist nicht angegeben.",
  "Use a register or a variable for levels.": "Für Pegel ein Register oder eine Variable benutzen.",
  "Which output the gripper hangs on is not given.": "An welchem Ausgang der Greifer hängt, ist nicht angegeben.",
  "“{name}” is no digital output of the controller.": "„{name}“ ist kein digitaler Ausgang der Steuerung.",
  "“{name}” is no output of the controller.": "„{name}“ ist kein Ausgang der Steuerung.",
  // What to do at the robot
  "Clear the cause, then command the move again.": "Die Ursache beseitigen, dann die Bewegung noch einmal befehlen.",
  "Close and acknowledge the emergency-stop chain and press the power button of the pendant.":
    "Die Not-Halt-Kette schließen und quittieren und am Handgerät die Leistungstaste drücken.",
  "Close it, then reset.": "Sie schließen, dann quittieren.",
  "Command the move again when the line is steady.": "Die Bewegung noch einmal befehlen, wenn die Leitung stabil ist.",
  "Connect again, then command the move again.": "Neu verbinden, dann die Bewegung noch einmal befehlen.",
  "Connect it again.": "Neu verbinden.",
  "Jog it again.": "Noch einmal verfahren.",
  "Look at its address, its cable, and whether it is on.": "Adresse und Kabel prüfen, und ob die Steuerung an ist.",
  "Look at its cause, then reset again.": "Die Ursache prüfen, dann noch einmal quittieren.",
  "Look at its name and at the memory of the controller.": "Den Namen und den Speicher der Steuerung prüfen.",
  "Look at its pendant.": "Auf sein Handgerät sehen.",
  "Look at its terminal, then command the move again.":
    "Auf sein Terminal sehen, dann die Bewegung noch einmal befehlen.",
  "Look at that line of the program.": "Diese Zeile des Programms prüfen.",
  "Look at the FTP server of the controller (port 21) and at the option for ASCII programs.":
    "Den FTP-Server der Steuerung (Port 21) und die Option für ASCII-Programme prüfen.",
  "Look at the address and the cable, and whether ros_server runs and both of its sockets are set up.":
    "Adresse und Kabel prüfen, ob ros_server läuft, und ob seine beiden Sockets eingerichtet sind.",
  "Look at the address and the cable. A controller with RobotWare 7 (OmniCore) serves other ones, over TLS, which are not spoken here.":
    "Adresse und Kabel prüfen. Eine Steuerung mit RobotWare 7 (OmniCore) bietet andere über TLS an; die werden hier " +
    "nicht unterstützt.",
  "Look at the address of the serial adapter, the cable, and whether another terminal has the line.":
    "Adresse des seriellen Adapters und Kabel prüfen, und ob ein anderes Terminal die Leitung hat.",
  "Look at the address, the cable, and whether option R912 is on the controller.":
    "Adresse und Kabel prüfen, und ob die Steuerung die Option R912 hat.",
  "Look at the address, the cable, and whether the C3 Bridge runs on the controller.":
    "Adresse und Kabel prüfen, und ob auf der Steuerung die C3 Bridge läuft.",
  "Look at the address, the cable, whether the controller is on and its Ethernet server is allowed.":
    "Adresse und Kabel prüfen, ob die Steuerung an und ihr Ethernet-Server erlaubt ist.",
  "Look at the cable and at the program that waits for targets; motion is not tried again.":
    "Kabel und das Programm prüfen, das auf Ziele wartet; die Bewegung wird nicht wiederholt.",
  "Look at the cable and the file port (UDP 10041).": "Kabel und Dateiport (UDP 10041) prüfen.",
  "Look at the link; the robot may still do what it was told.":
    "Die Verbindung prüfen; der Roboter führt vielleicht noch aus, was ihm befohlen wurde.",
  "Look at the log of its controller.": "Ins Protokoll seiner Steuerung sehen.",
  "Look at the messages on its pendant, and whether the drives are on.":
    "Die Meldungen an seinem Handgerät prüfen, und ob die Antriebe an sind.",
  "Look at the messages on its pendant.": "Die Meldungen an seinem Handgerät prüfen.",
  "Look at the messages on its pendant: it names the line it does not understand.":
    "Die Meldungen an seinem Handgerät prüfen: Es nennt die Zeile, die es nicht versteht.",
  "Look at the messages on its pendant; reset the robot, then command the move again.":
    "Die Meldungen an seinem Handgerät prüfen; den Roboter quittieren, dann die Bewegung noch einmal befehlen.",
  "Look at the messages on the pendant, then reset the robot.":
    "Die Meldungen am Handgerät prüfen, dann den Roboter quittieren.",
  "Look at the network of this machine.": "Das Netzwerk dieses Rechners prüfen.",
  "Look at the pendant, then command the move again.":
    "Auf das Handgerät sehen, dann die Bewegung noch einmal befehlen.",
  "Look at the pendant: an emergency stop or a gate may keep it off.":
    "Auf das Handgerät sehen: Ein Not-Halt oder eine Schutztür hält die Leistung vielleicht aus.",
  "Look at the robot's pendant.": "Auf das Handgerät des Roboters sehen.",
  "Look at the settings of its Ethernet server.": "Die Einstellungen seines Ethernet-Servers prüfen.",
  "Look at the terminal of the controller, then command the move again.":
    "Auf das Terminal der Steuerung sehen, dann die Bewegung noch einmal befehlen.",
  "Look at the transmission protocol that is set up on the controller (UCdevice: address of this machine, port), and start the RAPID program that waits for targets.":
    "Das an der Steuerung eingerichtete Übertragungsprotokoll prüfen (UCdevice: Adresse dieses Rechners, Port), und " +
    "das RAPID-Programm starten, das auf Ziele wartet.",
  "Look whether Move is pressed at the pendant, then command the move again.":
    "Prüfen, ob am Handgerät Move gedrückt ist, dann die Bewegung noch einmal befehlen.",
  "Look whether a Yaskawa controller is at this address.": "Prüfen, ob an dieser Adresse eine Yaskawa-Steuerung ist.",
  "Look whether the controller is on and the adapter is set to 9600 baud, 8 bits, no parity.":
    "Prüfen, ob die Steuerung an und der Adapter auf 9600 Baud, 8 Bit, keine Parität eingestellt ist.",
  "Look whether the limits of the corrections are too narrow.": "Prüfen, ob die Grenzen der Korrekturen zu eng sind.",
  "Look whether the program ros_server runs at the controller.":
    "Prüfen, ob auf der Steuerung das Programm ros_server läuft.",
  "Look whether the proxy reaches the controller's variables.":
    "Prüfen, ob der Proxy die Variablen der Steuerung erreicht.",
  "Power it on and release its brakes.": "Ihn einschalten und seine Bremsen lösen.",
  "Press MAN at the pendant and switch high power on.": "Am Handgerät MAN drücken und die Leistung einschalten.",
  "Put it right at the robot first.": "Es erst am Roboter beheben.",
  "Put it right at the robot, then command the move again.":
    "Es am Roboter beheben, dann die Bewegung noch einmal befehlen.",
  "Remote mode, command remote, no running job and no edit lock are needed for it.":
    "Dafür braucht es den Fernbetrieb, Befehle von außen, keinen laufenden Job und keine Bearbeitungssperre.",
  "Reset it, which starts its RAPID program; for motions from here that is one that waits for targets ({program}).":
    "Ihn quittieren, das startet sein RAPID-Programm; für Bewegungen von hier ist das eines, das auf Ziele wartet " +
    "({program}).",
  "Reset it: that powers it on and releases its brakes.": "Ihn quittieren: Das schaltet ihn ein und löst die Bremsen.",
  "Reset the robot here, or select and start TWINCELL_RSI at the pendant.":
    "Den Roboter hier quittieren, oder am Handgerät TWINCELL_RSI anwählen und starten.",
  "Reset the robot here, or select and start it at the pendant.":
    "Den Roboter hier quittieren, oder es am Handgerät anwählen und starten.",
  "Set it there; a speed of 0 holds the job, 100 lets it go on.":
    "Sie dort einstellen; 0 hält den Job an, 100 lässt ihn weitergehen.",
  "Stop it first.": "Es erst anhalten.",
  "Switch it to local control.": "Ihn auf lokale Steuerung umschalten.",
  "Switch it to remote control at the pendant.": "Ihn am Handgerät auf Fernsteuerung umschalten.",
  "Switch the motors on at the cabinet and start the RAPID program that waits for targets.":
    "Am Schaltschrank die Motoren einschalten und das RAPID-Programm starten, das auf Ziele wartet.",
  "Switch the power on at the pendant, then command the move again.":
    "Am Handgerät die Leistung einschalten, dann die Bewegung noch einmal befehlen.",
  "Switch them on at the robot, or from its remote control.":
    "Sie am Roboter einschalten, oder über seine Fernsteuerung.",
  "Turn the button out at the robot, then reset.": "Den Taster am Roboter entriegeln, dann quittieren.",
  "Turn the key at the controller to automatic.": "Den Schlüssel an der Steuerung auf Automatik drehen.",
  "Turn the key to AUT or EXT, or start it at the pendant.":
    "Den Schlüssel auf AUT oder EXT drehen, oder es am Handgerät starten.",
  "Turn the key to T1 and press the enabling switch.": "Den Schlüssel auf T1 drehen und die Zustimmtaste drücken.",
  "Turn the key to T1 and reset the faults.": "Den Schlüssel auf T1 drehen und die Störungen quittieren.",
  "Turn the mode selector to manual and press the enabling switch.":
    "Den Betriebsartenschalter auf Hand stellen und die Zustimmtaste drücken.",
  "Turn the red button out, and press the enabling switch.":
    "Den roten Taster entriegeln und die Zustimmtaste drücken.",
  "Wait until it stands.": "Warten, bis er steht.",
};
