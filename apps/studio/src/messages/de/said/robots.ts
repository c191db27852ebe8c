import type { Sentences } from "../../sentences.ts";

/** German: what guards, drivers, connections and runs say. */
export const saidByRobots: Sentences = {
  // Commands
  "{robot} has {joints} joints but {n} angles were given.":
    "{robot} hat {joints} Achsen, aber {n} Winkel wurden angegeben.",
  "Pass one angle per joint, base first.": "Einen Winkel je Achse angeben, die Basis zuerst.",
  "Joint {n} was given {value}, which is no angle.": "Für Achse {n} wurde {value} angegeben; das ist kein Winkel.",
  "Pass a finite angle in radians.": "Einen endlichen Winkel in Radiant angeben.",
  "Keep joint {n} between {lower} and {upper}.": "Achse {n} zwischen {lower} und {upper} halten.",
  "{robot} has joints 1 to {n}; joint {joint} was asked for.":
    "{robot} hat die Achsen 1 bis {n}; verlangt wurde Achse {joint}.",
  "Count joints from 1, base first.": "Achsen ab 1 zählen, die Basis zuerst.",
  "The speed is 0 to 100 %; {percent} was given.": "Die Geschwindigkeit ist 0 bis 100 %; angegeben wurde {percent}.",
  "Pass a percentage; 0 holds the robot where it is.": "Einen Prozentwert angeben; 0 hält den Roboter an, wo er ist.",
  "{robot} is still carrying out the command before.": "{robot} führt noch den vorigen Befehl aus.",
  "Wait until it is done, or stop it.": "Warten, bis er fertig ist, oder anhalten.",
  "The drives of {robot} are off after an emergency stop.": "Die Antriebe von {robot} sind nach einem Not-Halt aus.",
  "Reset the robot, then command the move again.": "Den Roboter quittieren, dann die Bewegung noch einmal befehlen.",
  "The robot made a protective stop: {because}": "Der Roboter machte einen Schutzhalt: {because}",
  "Clear the cause, reset the robot, then command the move again.":
    "Die Ursache beseitigen, den Roboter quittieren, dann die Bewegung noch einmal befehlen.",
  "The guard of {robot} is open or somebody is near it.":
    "Die Schutzeinrichtung von {robot} ist offen, oder jemand ist in der Nähe.",
  "Close the guard or step back, then command the move again.":
    "Die Schutzeinrichtung schließen oder zurücktreten, dann die Bewegung noch einmal befehlen.",
  "{robot} is in manual mode: its teach pendant has it.":
    "{robot} ist im Handbetrieb: Das Programmierhandgerät hat ihn.",
  "Turn the mode switch at the robot to automatic.": "Den Betriebsartenschalter am Roboter auf Automatik stellen.",
  "{robot} was stopped while it was being reset: the stop stays.":
    "{robot} wurde beim Quittieren angehalten: Der Halt bleibt.",
  "Reset it again when the way is clear.": "Noch einmal quittieren, wenn der Weg frei ist.",
  "{robot} has not come to rest yet.": "{robot} steht noch nicht still.",
  "Reset it when it stands.": "Quittieren, wenn er steht.",
  "The guard of {robot} is still open.": "Die Schutzeinrichtung von {robot} ist noch offen.",
  "Close the guard, then reset.": "Die Schutzeinrichtung schließen, dann quittieren.",
  "{robot} was closed.": "{robot} wurde geschlossen.",
  "Open the cell again to get a new controller.": "Die Zelle neu öffnen, um eine neue Steuerung zu erhalten.",
  "Command the move again when the way is clear.": "Die Bewegung noch einmal befehlen, wenn der Weg frei ist.",
  "The program ended with a fault of its own: {why}": "Das Programm endete mit einem eigenen Fehler: {why}",
  "Look at the line it came from.": "Die Zeile ansehen, aus der er kommt.",

  // Productions
  "The production was stopped while it was held.": "Der Lauf wurde angehalten, während er unterbrochen war.",
  "Begin it again.": "Neu beginnen.",
  "It runs as text of the controller's own language, which has the place to itself.":
    "Es läuft als Text der Steuerung, und nur sie kennt die Stelle.",
  "Run it by steps, or resume with a cycle from its beginning.":
    "Schritt für Schritt ausführen, oder mit einem Zyklus von vorn fortfahren.",
  "The program computes: what its variables are in the middle of a cycle is not known.":
    "Das Programm rechnet: Was seine Variablen mitten im Zyklus sind, ist nicht bekannt.",
  "Resume with a cycle from its beginning.": "Mit einem Zyklus von vorn fortfahren.",
  "It was in the middle of the step “{step}”, which has steps of its own: how far it was is not known.":
    "Er war mitten im Schritt „{step}“, der eigene Schritte hat: Wie weit, ist nicht bekannt.",
  "The production is not held.": "Der Lauf ist nicht unterbrochen.",
  "Hold it first.": "Erst halten.",
  "The production ended before its next cycle.": "Der Lauf endete vor seinem nächsten Zyklus.",
  "Begin it again with the new program.": "Mit dem neuen Programm neu beginnen.",
  "The production has ended.": "Der Lauf ist zu Ende.",
  "Another program was given before its cycle came.": "Vor seinem Zyklus kam ein anderes Programm.",
  "No production runs on this robot.": "Auf diesem Roboter läuft nichts Zyklus um Zyklus.",
  "Begin one.": "Einen Lauf beginnen.",
  "{robot} is in production already.": "{robot} läuft schon Zyklus um Zyklus.",
  "Give it another program with replace, or stop it first.": "Ein anderes Programm geben, oder erst anhalten.",

  // Guard
  "Not a certified safety function: it may refuse or stop a motion, it can never guarantee one.":
    "Keine zertifizierte Sicherheitsfunktion: Sie kann eine Bewegung verweigern oder anhalten, aber nie garantieren.",
  "Move another way round, or make room in the cell.": "Anders herumfahren, oder in der Zelle Platz schaffen.",
  "It goes back to its last safe pose. {hint}": "Er fährt zur letzten sicheren Pose zurück. {hint}",
  "{robot} is commanded by {holder}.": "Die Steuerhoheit über {robot} hat {holder}.",
  "somebody else": "jemand anderes",
  "Wait until the lease is given back. Anyone may stop the robot.":
    "Warten, bis die Steuerhoheit zurückgegeben wird. Anhalten darf den Roboter jeder.",
  "Nobody has taken command of {robot}.": "Niemand hat die Steuerhoheit über {robot}.",
  "Take command first.": "Erst die Steuerhoheit übernehmen.",
  "The enabling switch is not pressed.": "Die Zustimmtaste ist nicht gedrückt.",
  "Keep it pressed for as long as the robot is to move.": "Gedrückt halten, solange der Roboter sich bewegen soll.",
  "The link to {robot} is down.": "Die Verbindung zu {robot} ist unterbrochen.",
  "Mend the link, then confirm that motion is wanted.":
    "Die Verbindung wiederherstellen, dann bestätigen, dass Bewegung gewünscht ist.",
  "The link to {robot} was down and is back.": "Die Verbindung zu {robot} war unterbrochen und steht wieder.",
  "Look at the robot, then confirm that motion is wanted.":
    "Den Roboter ansehen, dann bestätigen, dass Bewegung gewünscht ist.",
  "{robot} stands too near to something.": "{robot} steht zu nahe an etwas.",
  "Confirm, and it goes back to its last safe pose.": "Bestätigen, dann fährt er zur letzten sicheren Pose zurück.",
  "{robot} was opened to watch: nothing is commanded from here.":
    "{robot} wurde zum Beobachten geöffnet: Von hier wird nichts befohlen.",
  "Take control first. A stop works all the same.": "Erst die Steuerhoheit übernehmen. Ein Halt wirkt trotzdem.",
  "Nothing was heard of {robot} for {ms} ms. It is only watched and was not stopped.":
    "Von {robot} kam seit {ms} ms nichts. Er wird nur beobachtet und wurde nicht angehalten.",
  "It is looked for by itself.": "Er wird von selbst gesucht.",
  "At the target the robot would be nearer to something than the clearance margin.":
    "Am Ziel wäre der Roboter näher an etwas als der Sicherheitsabstand.",
  "The robot came within the clearance margin of something and was stopped.":
    "Der Roboter kam etwas näher als der Sicherheitsabstand und wurde angehalten.",
  "The cell has changed: the last safe pose is within the clearance margin of something now.":
    "Die Zelle hat sich geändert: Die letzte sichere Pose liegt jetzt näher an etwas als der Sicherheitsabstand.",
  "Look at the robot and jog it away from what is near.": "Den Roboter ansehen und von dem wegfahren, was nahe ist.",
  "Nothing was heard of {robot} for {ms} ms; it was told to stop.":
    "Von {robot} kam seit {ms} ms nichts; ein Halt wurde gesendet.",
  "Nothing was heard of {who} for {ms} ms; the robot was told to stop.":
    "Von {who} kam seit {ms} ms nichts; dem Roboter wurde ein Halt gesendet.",
  "Reconnect, then confirm that motion is wanted.": "Neu verbinden, dann bestätigen, dass Bewegung gewünscht ist.",
  "The enabling switch was let go.": "Die Zustimmtaste wurde losgelassen.",
  "Command was given back while the robot moved.":
    "Die Steuerhoheit wurde zurückgegeben, während der Roboter sich bewegte.",
  "Take command again to go on.": "Die Steuerhoheit wieder übernehmen, um fortzufahren.",
  "The tool moved at {speed} mm/s in manual mode; the cap is {cap} mm/s.":
    "Das Werkzeug fuhr im Handbetrieb mit {speed} mm/s; erlaubt sind {cap} mm/s.",
  "Command it slower, or switch to automatic.": "Langsamer befehlen, oder auf Automatik umschalten.",

  // Connections
  "{name} is not connected.": "{name} ist nicht verbunden.",
  "{name} is not connected: {because}": "{name} ist nicht verbunden: {because}",
  "Connect it, then command the move again.": "Verbinden, dann die Bewegung noch einmal befehlen.",
  "It is tried again by itself; command the move again when the link is back.":
    "Es wird von selbst wieder versucht; die Bewegung noch einmal befehlen, wenn die Verbindung steht.",
  "It is tried again by itself; motion is not.": "Die Verbindung wird von selbst wieder versucht, die Bewegung nicht.",
  "Nothing came from {name} for {ms} ms.": "Von {name} kam seit {ms} ms nichts.",
  "{name} did not answer within {s} s.": "{name} hat innerhalb von {s} s nicht geantwortet.",
  "Look at its address, its cable and whether it is on.":
    "Adresse und Kabel prüfen, und ob die Steuerung eingeschaltet ist.",
  "{name} is being connected, attempt {n}.": "{name} wird verbunden, Versuch {n}.",
  "{robot} cannot be told a spline move by move.": "{robot} lässt sich ein Spline nicht Bewegung für Bewegung sagen.",
  "{robot} cannot be told a search move by move.":
    "{robot} lässt sich eine Suchfahrt nicht Bewegung für Bewegung sagen.",
  "{steps} cannot be carried out over this connection: {because}":
    "{steps} lässt sich über diese Verbindung nicht ausführen: {because}",
  "Nothing has moved.": "Nichts hat sich bewegt.",
  "Standard V+ has no arcs.": "Standard-V+ hat keine Kreisbögen.",
  "Use lines through points of the arc.": "Geraden durch Punkte des Bogens verwenden.",
  "Arcs are not sent over this interface: their points need FANUC's words for a posture, which have not been tried.":
    "Kreisbögen werden über diese Schnittstelle nicht gesendet: Ihre Punkte brauchen die Stellungsangaben von FANUC, die noch nicht erprobt sind.",
  "Run the program as text of the controller's own language, or use lines.":
    "Das Programm als Text in der Sprache der Steuerung ausführen, oder Geraden verwenden.",
  "{robot} cannot be told an arc by a command of its Ethernet server.":
    "{robot} lässt sich über den Ethernet-Server kein Kreisbogen befehlen.",
  "Run the program as a job: INFORM has MOVC.": "Das Programm als Job ausführen: INFORM hat MOVC.",
  "{robot} cannot be told an acceleration by a command of its Ethernet server.":
    "{robot} lässt sich über den Ethernet-Server keine Beschleunigung befehlen.",
  "Run the program as a job: INFORM has ACC= and DEC=.": "Das Programm als Job ausführen: INFORM hat ACC= und DEC=.",
  "{path} cannot be said over this connection: ros_server moves from joint point to joint point and stops at each.":
    "{path} lässt sich über diese Verbindung nicht sagen: ros_server fährt von Gelenkpunkt zu Gelenkpunkt und hält an jedem.",
  "A straight line": "Eine Gerade",
  "An arc": "Ein Kreisbogen",
  "Export the program as VAL 3 and start it at the pendant, or use joint moves.":
    "Das Programm als VAL 3 exportieren und am Bedienpult starten, oder Gelenkbewegungen verwenden.",
  "A softer acceleration cannot be said over this connection: ros_server uses the controller's own.":
    "Eine sanftere Beschleunigung lässt sich über diese Verbindung nicht sagen: ros_server nimmt die der Steuerung.",
  "Leave the acceleration at 100 %, or export the program as VAL 3.":
    "Die Beschleunigung bei 100 % lassen, oder das Programm als VAL 3 exportieren.",
  "The protocol of ros_server carries no signals.": "Das Protokoll von ros_server überträgt keine Signale.",
  "Set them in a VAL 3 program.": "In einem VAL-3-Programm setzen.",
  "Run the program as text of the controller's own language.":
    "Das Programm als Text in der Sprache der Steuerung ausführen.",
  "{robot} cannot be told its payload over this connection.":
    "{robot} lässt sich die Last über diese Verbindung nicht sagen.",
  "Set it at the controller, or run the program as text.":
    "An der Steuerung einstellen, oder das Programm als Text ausführen.",
  "Step “{step}” holds other steps; a controller takes them one by one.":
    "Der Schritt „{step}“ enthält weitere Schritte; eine Steuerung nimmt sie einzeln.",
  "Unroll the program first.": "Erst das Programm ausrollen.",
  "Step “{step}” waited {s} s for the signal “{signal}”.":
    "Der Schritt „{step}“ wartete {s} s auf das Signal „{signal}“.",
  "Look why the signal did not come, or give it more time.":
    "Nachsehen, warum das Signal nicht kam, oder mehr Zeit geben.",
  "{robot} took the reset and still says, {s} s later, that it is stopped.":
    "{robot} nahm das Quittieren an und meldet {s} s später noch immer einen Halt.",
  "Look at the robot what keeps it stopped, then reset again.":
    "Am Roboter nachsehen, was ihn hält, dann noch einmal quittieren.",
  "{robot} was stopped.": "{robot} wurde angehalten.",
  "Choose a pose within reach.": "Eine erreichbare Pose wählen.",
  "{robot} does not stand on a controller of {brand}: its file has no vendor section.":
    "{robot} gehört zu keiner Steuerung von {brand}: seine Datei hat keinen Herstellerteil.",
  "{robot} does not stand on a controller of {brand}; its drivers are {drivers}.":
    "{robot} gehört zu keiner Steuerung von {brand}; seine Treiber sind {drivers}.",
  "{robot} does not stand on a controller of {brand}.": "{robot} gehört zu keiner Steuerung von {brand}.",
  "Choose another controller or another robot, or give its file a vendor section with the driver {driver}.":
    "Eine andere Steuerung oder einen anderen Roboter wählen, oder der Datei einen Herstellerteil mit dem Treiber {driver} geben.",
  "Give the file of the robot itself, with its own vendor section.":
    "Die Datei dieses Roboters selbst angeben, mit seinem eigenen Herstellerteil.",
  "Try it again.": "Noch einmal versuchen.",
  "The robot stops by itself within {ms} ms.": "Der Roboter hält innerhalb von {ms} ms von selbst an.",
  "It would not be sent. Clear the way, or change the program.":
    "Es würde nicht gesendet. Den Weg frei machen, oder das Programm ändern.",
  "It would be sent all the same; this is only told.": "Es würde trotzdem gesendet; dies ist nur ein Hinweis.",
  "It was not sent. Clear the way, or change the program.":
    "Es wurde nicht gesendet. Den Weg frei machen, oder das Programm ändern.",
  "Open it to command; it moves only when it is told to.": "Zum Steuern öffnen; er bewegt sich nur auf Befehl.",
  "Connect it, then try again.": "Verbinden, dann noch einmal versuchen.",
  "{name} is {angle} from where it should be; more than {limit} is said aloud.":
    "{name} steht {angle} neben der Sollstellung; mehr als {limit} wird gemeldet.",
  "Look whether something holds it, or whether another program runs.":
    "Nachsehen, ob etwas ihn hält oder ein anderes Programm läuft.",
  "{name} did not begin to move within {s} s of the common start.":
    "{name} begann nicht innerhalb von {s} s nach dem gemeinsamen Start.",
  "Look what its pendant says; nobody of the group goes on.":
    "Nachsehen, was das Handgerät meldet; niemand der Gruppe fährt weiter.",
  "{name} was moved while its program was being planned.": "{name} wurde bewegt, während sein Programm geplant wurde.",
  "Let it stand, then send the program again.": "Stehen lassen, dann das Programm noch einmal senden.",
  "{name} was stopped while its program was being planned: the program does not begin.":
    "{name} wurde angehalten, während sein Programm geplant wurde: Das Programm beginnt nicht.",
  "Send the program again when the robot may move.": "Das Programm noch einmal senden, wenn der Roboter fahren darf.",
  "{name} was disconnected.": "{name} wurde getrennt.",
  "Connect it, then confirm that motion is wanted.": "Verbinden, dann bestätigen, dass Bewegung gewünscht ist.",
  "{name} is kept from itself only: no cell was given, so tables, walls and tools are not known to its guard.":
    "{name} wird nur vor sich selbst geschützt: Keine Zelle war gegeben, also kennt die Überwachung " +
    "weder Tische noch " +
    "Wände noch Werkzeuge.",
  "Give it the cell it stands in before it moves.": "Die Zelle angeben, in der er steht, bevor er sich bewegt.",
  "{name} comes within {distance} mm of {other}; {kept} mm are kept.":
    "{name} kommt {other} auf {distance} mm nahe; {kept} mm werden eingehalten.",

  // Several robots
  "Wait until the other robot is out of the way, or change who goes first: the one opened first does.":
    "Warten, bis der andere Roboter aus dem Weg ist, oder die Vorfahrt ändern: Der zuerst geöffnete hat sie.",
  "At the target {name} would be {distance} from {other}; {kept} are kept between robots.":
    "Am Ziel wäre {name} {distance} von {other} entfernt; zwischen Robotern werden {kept} eingehalten.",
  "Move {other} away first, or choose another target.": "Erst {other} wegfahren, oder ein anderes Ziel wählen.",
  "{name} would have come within {distance} of {other}, which moves and goes first, and was stopped; {kept} are kept.":
    "{name} wäre {other}, der fährt und Vorfahrt hat, auf {distance} nahe gekommen und wurde " +
    "angehalten; {kept} werden " +
    "eingehalten.",
  "{name} would have come within {distance} of {other} and was stopped; {kept} are kept between robots.":
    "{name} wäre {other} auf {distance} nahe gekommen und wurde angehalten; zwischen Robotern werden {kept} " +
    "eingehalten.",
  "Move {other} away, or move another way round.": "{other} wegfahren, oder anders herumfahren.",

  // Pendant
  "Joint {n} is at its limit.": "Achse {n} ist an ihrer Grenze.",
  "Jog it the other way.": "In die andere Richtung verfahren.",
  "Nothing was heard from the pendant for {ms} ms: the enabling switch counts as let go.":
    "Vom Handgerät kam seit {ms} ms nichts: Die Zustimmtaste gilt als losgelassen.",
  "The arm does not come to rest.": "Der Arm kommt nicht zur Ruhe.",
  "The drives are off.": "Die Antriebe sind aus.",
  "Let the key go and press it again.": "Die Taste loslassen und wieder drücken.",
  "Acknowledge what is wrong and switch them on.": "Den Fehler quittieren und sie einschalten.",
  "The jog keys work in a manual mode only.": "Die Verfahrtasten wirken nur im Handbetrieb.",
  "Hold it, then the jog key.": "Erst sie halten, dann die Verfahrtaste.",
  "Somebody else is jogging.": "Jemand anderes verfährt gerade.",
  "Wait until they have let go.": "Warten, bis losgelassen wurde.",
  "Press another key.": "Eine andere Taste drücken.",
  "Choose one between.": "Einen Wert dazwischen wählen.",

  // Motion
  "Start, via point and target of step “{step}” lie on one line, so no circle passes through them.":
    "Start, Hilfspunkt und Ziel des Schritts „{step}“ liegen auf einer Geraden; durch sie geht kein Kreis.",
  "Move the via point off the line, or make it a straight move.":
    "Den Hilfspunkt von der Geraden wegnehmen, oder geradlinig fahren.",
  "At {percent} % of step “{step}” joint {n} would turn to {value}; its limit is {limit}.":
    "Bei {percent} % des Schritts „{step}“ würde Achse {n} auf {value} drehen; ihre Grenze ist {limit}.",
  "At {percent} % of step “{step}” joint {n} would slide to {value}; its limit is {limit}.":
    "Bei {percent} % des Schritts „{step}“ würde Achse {n} auf {value} fahren; ihre Grenze ist {limit}.",
  "Tilt or turn the tool, or choose another posture of the arm.":
    "Das Werkzeug kippen oder drehen, oder eine andere Stellung des Arms wählen.",
  "Bring the target nearer, or tilt the tool.": "Das Ziel näher legen, oder das Werkzeug kippen.",
  "At {percent} % of step “{step}” the arm would have to turn over at once, with the flange at {place} of the base.":
    "Bei {percent} % des Schritts „{step}“ müsste der Arm auf einmal umschlagen, mit dem Flansch bei " +
    "{place} zur Basis.",
  "Make it a joint move, or tilt the tool so that the wrist is not stretched out on the way.":
    "Als Achsbewegung fahren, oder das Werkzeug so kippen, dass das Handgelenk unterwegs nicht gestreckt ist.",
  "At {percent} % of step “{step}” the flange would be at {place} of the base, where {robot} cannot be.":
    "Bei {percent} % des Schritts „{step}“ wäre der Flansch bei {place} zur Basis; dorthin kommt {robot} nicht.",
  "Bring the path nearer, or make it a joint move.": "Die Bahn näher legen, oder als Achsbewegung fahren.",
  "The search of step “{step}” came to its end without the signal “{signal}”.":
    "Die Suchfahrt des Schritts „{step}“ endete ohne das Signal „{signal}“.",
  "Look at the sensor, or let the search go further.": "Den Sensor prüfen, oder die Suchfahrt weiter fahren lassen.",
  "The arm stands on a singularity; turned in place to either side it meets a limit, and the tip would not move.":
    "Der Arm steht in einer Singularität; auf der Stelle gedreht trifft er zu beiden Seiten eine " +
    "Grenze, und die Spitze " +
    "würde sich nicht bewegen.",
  "In this posture the arm goes no farther that way: it is stretched, folded or stands too near to axis 1, and would have to turn over into another posture.":
    "In dieser Stellung kommt der Arm in dieser Richtung nicht weiter: Er ist gestreckt, gefaltet oder zu nahe an " +
    "Achse 1 und müsste in eine andere Stellung umschlagen.",
  "The arm stands on a singularity, and no turn in place of its joints brings the tip that way.":
    "Der Arm steht in einer Singularität, und keine Drehung seiner Achsen auf der Stelle bringt die Spitze dorthin.",
  "Joint {n} would have to turn by {angle}° at once: axes 4 and 6 are almost in line.":
    "Achse {n} müsste auf einmal um {angle}° drehen: Die Achsen 4 und 6 fluchten fast.",
  "Joint {n} would have to turn by {angle}° at once: the arm is almost singular here.":
    "Achse {n} müsste auf einmal um {angle}° drehen: Der Arm ist hier fast singulär.",
  "Joint {n} would jump by {angle}° on the edge.": "Achse {n} würde an der Kante um {angle}° springen.",
  "More than {n} points would be needed to stay within the tolerance.":
    "Mehr als {n} Punkte wären nötig, um in der Toleranz zu bleiben.",
  "The edge is shorter than its tolerance.": "Die Kante ist kürzer als ihre Toleranz.",
  "The object “{name}” is no longer in the cell.": "Das Objekt „{name}“ steht nicht mehr in der Zelle.",
  "Edge {n} of {object} is no longer there.": "Die Kante {n} von {object} gibt es nicht mehr.",

  // Runs
  "A run is under way.": "Ein Lauf ist im Gange.",
  "Stop it first, or wait until it is done.": "Erst anhalten, oder warten, bis er fertig ist.",
  "The run was stopped before it began.": "Der Lauf wurde angehalten, bevor er begann.",
  "Run it again when the way is clear.": "Noch einmal ausführen, wenn der Weg frei ist.",
  "Export the text and look at that line.": "Den Text exportieren und diese Zeile ansehen.",
  "Try it again, or choose another language.": "Noch einmal versuchen, oder eine andere Sprache wählen.",
  "The run of {program} began.": "Der Lauf von {program} begann.",
  "The run is done.": "Der Lauf ist beendet.",
  "The text was stopped.": "Der Text wurde angehalten.",
  "Run it again from its beginning.": "Von Anfang an noch einmal ausführen.",
  "Back to normal.": "Wieder normal.",
  "The guard stopped the robot.": "Die Überwachung hat den Roboter angehalten.",
  "The robot is in a protective stop.": "Der Roboter ist im Schutzhalt.",
  "The robot is in an emergency stop.": "Der Roboter ist im Not-Halt.",
  "The library has no robot called “{name}”.": "Die Bibliothek hat keinen Roboter namens „{name}“.",
  "Choose another robot.": "Einen anderen Roboter wählen.",
  "There is no virtual controller “{brand}” for “{robot}”.":
    "Es gibt keine virtuelle Steuerung „{brand}“ für „{robot}“.",
  "A page has no network of its own: real controllers are reached through the server.":
    "Eine Seite hat kein eigenes Netzwerk: Reale Steuerungen werden über den Server erreicht.",
  "Start Twincell with npx twincell serve and open its address.":
    "Twincell mit npx twincell serve starten und die Adresse öffnen.",
  "The virtual controllers of the page have stopped.": "Die virtuellen Steuerungen der Seite sind stehen geblieben.",
  "The connection to the server is gone.": "Die Verbindung zum Server ist weg.",
};
