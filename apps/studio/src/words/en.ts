import { videoWords } from "./video.ts";

/** English. Field terms as a programmer says them; sentences end with a full stop and carry the number and the unit. */
const plural = (count: number, one: string, many = `${one}s`): string => `${count} ${count === 1 ? one : many}`;

/** What of a text was left out, the worst of it by name. */
function leftOut(all: readonly { readonly what: "motion" | "branch" | "statement" }[]): string {
  const count = (what: string): number => all.filter(each => each.what === what).length, motions = count("motion"), branches = count("branch");
  if (motions + branches === 0) return `${plural(all.length, "statement")} left out.`;
  const worst = [motions > 0 ? plural(motions, "motion") : "", branches > 0 ? plural(branches, "branch", "branches") : ""].filter(each => each !== "").join(" and ");
  return `${plural(all.length, "statement")} left out, among them ${worst}: the robot does not do what the text says.`;
}

export const en = {
  common: {
    close: "Close", cancel: "Cancel", apply: "Apply", show: "Show", hide: "Hide", remove: "Delete", rename: "Rename", duplicate: "Duplicate", done: "Done", more: "More",
    on: "on", off: "off", none: "none", copy: "Copy", copied: "Copied.", download: "Download", open: "Open", undo: "Undo", redo: "Redo",
  },
  app: {
    name: "Twincell", notSafety: "Not a safety device.",
    notSafetyHint: "Twincell may refuse a motion. It can never guarantee one: people and machines are protected by the robot's own safety functions.",
    loadingScene: "The cell is being drawn …", sceneTrouble: "The 3D view could not start:",
    sceneHint: "Everything else works. A browser with WebGL 2 draws the cell.",
    skip: "Skip to the program", region: { cell: "Cell and program", view: "Cell, seen in 3D", side: "Tools", time: "Timeline", sheet: "Tools" },
  },
  mode: {
    label: "Mode", teach: "Teach", check: "Check", run: "Run", history: "History",
    teachTip: "Jog, trace edges and record points", checkTip: "See what is reached, how close it gets, and what would fix it",
    runTip: "Run the exported text on the virtual controller", historyTip: "Look back at any moment of a run",
  },
  saving: { saved: "saved", saving: "saving …", unsaved: "not saved yet", problem: "not saved", tip: "Kept in this browser after every change." },
  top: {
    rename: "Name of the cell", menu: "Cell menu", speed: "Speed", speedTip: "Speed override. 0 % holds the robot.", stop: "STOP", stopTip: "Stops everything that moves. Also: Pause, or Esc twice.",
    headset: "Headset", headsetTip: "Enter the cell at 1:1",
    palette: "All commands", theme: "Light or dark", mute: "Mute sounds", unmute: "Sounds on", stopped: "Everything was stopped.", stoppedHint: "Motion goes on only when you command it again.",
    stopTrouble: "One part did not answer to STOP:",
  },
  control: {
    title: "Controller", commander: "Commanded by", mode: "Mode", latency: "Latency", safety: "Safety", state: "State", speed: "Speed",
    modes: { manual: "manual", automatic: "automatic", remote: "remote" },
    safetyStates: { normal: "normal", "guard-stop": "guard open: robot held", "protective-stop": "protective stop", "emergency-stop": "emergency stop: drives off" },
    running: "runs a program", idle: "at rest", you: "you", commands: (who: string) => (who === "you" ? "you command" : `${who} commands`), unknown: "not measured yet", ms: (ms: number) => `${ms < 10 ? ms.toFixed(1) : ms.toFixed(0)} ms`, reset: "Reset after stop",
    virtualNote: "This controller lives in the page. Nothing outside moves.",
  },
  stations: {
    title: "Other controllers", add: "Add a controller", addTitle: "Add a controller to the cell", none: "No other controller yet. Virtual ones speak their maker's own protocol here in the page; real ones are reached through the server.",
    brand: "Maker", robot: "Robot", where: "Where it is", here: "Virtual, in this page", there: "On the network", address: "Address", addressHint: "For instance 192.168.0.10", port: (name: string) => `Port ${name}`,
    numbers: "One number a joint, commas between", stand: "Stands at", x: "x", y: "y", turned: "Turned", connecting: "Connecting …", addAndConnect: "Add and connect",
    connect: "Connect", disconnect: "Disconnect", run: "Run here", runAll: "Run on all", stop: "Stop", reset: "Reset", remove: "Remove", confirm: "Go on", confirmTip: "The link is back. Motion goes on only after a person says so.",
    pull: "Pull the plug", plugIn: "Put the plug back", hold: "Hold to move", holdTip: "A real robot moves only while this is held.",
    virtual: "virtual", links: { closed: "not connected", connecting: "connecting", open: "connected", lost: "connection lost" },
    figures: (hz: string, late: string, missing: number) => `${hz} Hz · ${late} late · ${missing} missing`, trip: (ms: string) => `answers in ${ms}`,
    plan: "From the plan", command: "From the command", watchdog: "If nobody commands", mode: "Mode", safety: "Safety", step: "Step", ms: (s: number) => `${(s * 1000).toFixed(1)} ms`,
    pendant: "Cabinet", key: "Mode switch", gate: "Gate", gateOpen: "Open the gate", gateClose: "Close the gate", red: "Press the red button", redOut: "Turn the red button out", reboot: "Off and on again",
    noServer: "Real controllers are reached through the Twincell server.", noServerHint: "Start npx twincell serve and open the address it prints.", gone: "This controller is no longer there.",
    unreached: (robot: string, n: number) => `${robot} does not reach ${plural(n, "step")} of the program.`, unreachedHint: "Bring the points nearer, or choose a larger robot.", faultHint: "Its controllers were closed here. Nothing goes on by itself.",
    done: (name: string) => `${name}: the program is done.`, card: (name: string) => `Controller ${name}`,
  },
  tree: {
    cell: "Cell", program: "Program", axes: (n: number) => `${n} axes`, noTool: "No tool (flange)", robot: "Robot", tool: "Tool", object: "Object", frame: "Frame",
    roles: { workpiece: "work piece", fixture: "fixture", furniture: "furniture", wall: "wall" },
    points: (n: number) => plural(n, "point"), expand: "Open the group", collapse: "Close the group", addStep: "Add a step", empty: "No steps yet. Trace an edge (T), or jog somewhere and record a point (P).",
    stepActions: "Actions for this step", steps: (n: number) => plural(n, "step"), up: "Move up", down: "Move down", reorderHint: "Alt with ↑ or ↓ moves it.",
    moved: (name: string, place: number, of: number) => `${name} is now step ${place} of ${of}.`, goTo: "Go there", gone: "no longer there", addBox: "Add a box", deleteObject: "Delete object", useTool: "Use this tool",
    verdicts: { ok: "fine", warn: "near a limit", bad: "not possible", unknown: "not checked yet" },
  },
  step: {
    point: (n: number) => `Point ${n}`, wait: (s: number) => `Wait ${s} s`, open: "Open gripper", close: "Close gripper",
    set: (signal: string, to: string) => `Set ${signal} to ${to}`, pulse: (signal: string, to: string, s: number) => `Pulse ${signal} ${to} for ${s} s`, waitFor: (condition: string) => `Wait until ${condition}`,
    is: (signal: string, to: string) => `${signal} is ${to}`, above: (signal: string, level: number) => `${signal} is above ${level}`, below: (signal: string, level: number) => `${signal} is below ${level}`,
    payload: (kg: number) => `Payload ${kg} kg`, say: (text: string) => `Say “${text}”`, stop: "End the program", comment: "Comment", call: (routine: string) => `Do ${routine}`,
    repeat: (times: number) => (times === 1 ? "Once" : `Repeat ${times} times`), forever: "Repeat for ever", if: (condition: string) => `If ${condition}`, else: "Otherwise", input: "Input 1", output: "Output 1", signal: "Signal", to: "To", until: "Until it is", text: "Text", times: "Times", endless: "For ever", counted: "Counted", routine: (name: string) => `Routine ${name}`, pallet: (pallet: string) => `At each place of ${pallet}`, path: { ptp: "PTP", lin: "LIN", circ: "CIRC", spline: "SPL" },
    pathLabel: "Path", speed: "Speed", ofJoint: "of joint speed", blend: "Blend", target: "Target", waitTime: "Waiting time", joints: "Joints", position: "Position", gripper: "Gripper", open2: "open", closed: "closed",
    name: "Name", unreachable: (sentence: string) => `The point stays where it was. ${sentence}`, duration: "Duration", kindOfSpeed: "Speed as",
    kinds: { ratio: "% of joints", mps: "TCP speed", time_s: "duration" },
  },
  undo: {
    recordPoint: "Record point", recordPath: "Record path", addWait: "Add wait", addGripper: "Add gripper step", addSet: "Add signal step", addWaitFor: "Add wait for a signal", addComment: "Add comment", addRepeat: "Add loop", signal: "Change signal", comment: "Change comment", times: "Change loop", touchUp: "Touch up point", rename: "Rename", deleteSteps: (n: number) => `Delete ${plural(n, "step")}`, duplicate: "Duplicate",
    reorder: "Reorder", clear: "Clear program", repair: "Apply repair", pairs: "Change checked pairs", repairAll: "Repair all", moveObject: "Move object", size: "Change size", tool: "Choose tool", trace: "Trace edges", speed: "Change speed", blend: "Change blend",
    path: "Change path", target: "Change target", wait: "Change wait", addObject: "Add object", deleteObject: "Delete object", import: "Import program", cellName: "Rename cell", moveRobot: "Move robot", robot: (name: string) => `Change the robot to ${name}`, selectProgram: (name: string) => `Work on ${name}`, addProgram: "New program", duplicateProgram: "Duplicate program", renameProgram: "Rename program", removeProgram: (name: string) => `Delete program ${name}`, gripper: "Change gripper",
    done: (label: string) => `Undone: ${label}.`, redone: (label: string) => `Done again: ${label}.`, nothing: "There is nothing to undo.", nothingAhead: "There is nothing to redo.",
  },
  field: {
    notUnderstood: (text: string, unit: string) => `“${text}” is not a number I can read. Type one, for instance 25${unit && ` ${unit}`}, +10 or 90/4.`,
    atLeast: (name: string, limit: string, unit: string) => `${name} is at least ${limit} ${unit}.`, atMost: (name: string, limit: string, unit: string) => `${name} is at most ${limit} ${unit}.`,
  },
  inspector: {
    nothing: "Nothing is selected. Click a part of the cell or a step to see and change its numbers.", robot: "Robot", base: "Stands at", joints: "Joint angles", reach: "Reach", payload: "Payload", repeatability: "Repeatability", tcpSpeed: "Fastest TCP", shapeError: "Drawn shape is off by up to", mass: "Mass", massLoaded: (robot: number, total: number) => `${robot} kg, ${total} kg with payload`,
    assumptions: "Assumed, not published", object: "Object", position: "Position", size: "Size", role: "Role", tool: "Tool", tcp: "TCP on the flange", frame: "Frame", width: "along x", depth: "along y", height: "along z", step: "Step",
    joint: (n: number) => `Joint ${n}`, margin: (deg: string) => `${deg}° to the limit`, rotation: "Turned", shape: "Shape", shapes: { box: "box", cylinder: "cylinder", revolved: "turned part", mesh: "mesh" }, group: "Group",
    manySteps: (n: number) => `${n} points of one trace`, speedAll: "Speed of all points",
  },
  jog: {
    title: "Pendant", frame: "Frame", frames: { joint: "Joint", base: "Base", tool: "Tool", user: "User", world: "World" }, axes: ["X", "Y", "Z", "Rx", "Ry", "Rz"],
    minus: (axis: string) => `Jog ${axis} down`, plus: (axis: string) => `Jog ${axis} up`, manner: "Manner", hold: "While held", steps: "In steps", step: "Step", speed: "Jog speed", closest: (joint: number, deg: string) => `Closest to a limit: joint ${joint}, ${deg}° left.`,
    ready: "Do Ready", readyTip: "Moves to the home position", zero: "All joints to zero", aidNext: "Next orientation", aidPrevious: "Previous orientation", aid: (n: number, of: number) => `Aid ${n} of ${of}`, aidFree: "Tool free", aids: "Orientation",
    record: "Record", recordPtp: "PTP", recordLin: "LIN", recordTip: "Records where the robot stands", touchUp: "Touch up", touchUpTip: "The selected point becomes where the robot stands", touchUpNone: "Select the point that is to be touched up.",
    gripperOpen: "Open", gripperClose: "Close", gripper: "Gripper", message: "Last message", quiet: "No message.", noUser: "The cell has no user frame yet.", dead: "On this virtual controller the held button is itself the dead-man.",
    recordMoving: "While moving", recordMovingTip: "Records the way of the hand: a point every 1 mm or 1° while the robot is jogged or dragged", pathGroup: "Recorded path", pathRecorded: (n: number) => `${plural(n, "point")} of the way were recorded.`,
    pathFull: (n: number) => `${n} points were recorded without letting go; recording has ended.`, pathFullHint: "Switch it on again to record more.",
    recorded: (name: string) => `${name} was recorded.`, touched: (name: string) => `${name} was touched up.`, busy: "The robot is running a program; jogging waits until it is done or stopped.", noIk: "Moving in a straight line needs the inverse of this robot, which the library does not have.",
    speedOf: (percent: number) => `${percent} % of 250 mm/s`, stepOf: (mm: string, deg: string) => `${mm} mm · ${deg}°`,
    atLimit: (joint: number, deg: string, limit: string) => `Joint ${joint} is at ${deg}°; its limit is ${limit}°.`, gripperClosed: "closed", gripperOpened: "open", aidUnreachable: (n: number, why: string) => `Orientation aid ${n} cannot be taken here. ${why}`,
  },
  pad: {
    lost: "The gamepad was disconnected; the robot was stopped.", lostHint: "Plug it in again or press one of its buttons.", found: (name: string) => `Gamepad ready: ${name}.`, none: "No gamepad is connected. Plug one in and press any of its buttons.",
    title: "Controls", keyboard: "Keyboard", gamepad: "Gamepad", press: "Press a key …", pressButton: "Press a button …", rebind: (what: string) => `Change the control for ${what}`, reset: "Back to the standard table", button: (n: number) => `Button ${n}`, stick: (n: number) => `Stick axis ${n}`, unbound: "not set",
    while: "Hold a key to move, let go to stop. Click an entry, then press what should do it.",
    actions: {
      "x+": "+X · joint 1 +", "x-": "−X · joint 1 −", "y+": "+Y · joint 2 +", "y-": "−Y · joint 2 −", "z+": "+Z · joint 3 +", "z-": "−Z · joint 3 −",
      "rx+": "turn +X · joint 4 +", "rx-": "turn −X · joint 4 −", "ry+": "turn +Y · joint 5 +", "ry-": "turn −Y · joint 5 −", "rz+": "turn +Z · joint 6 +", "rz-": "turn −Z · joint 6 −",
      "turn-back": "hold first: turn the other way", "aid-next": "next orientation", "aid-previous": "previous orientation", record: "record a point", ready: "Do Ready", camera: "main or close camera", tilt: "tilt of the close camera",
    },
    sticks: { x: "X", y: "Y", z: "Z", rx: "turn X", ry: "turn Y", rz: "turn Z", "-x": "X, reversed", "-y": "Y, reversed", "-z": "Z, reversed", "-rx": "turn X, reversed", "-ry": "turn Y, reversed", "-rz": "turn Z, reversed" },
  },
  view: {
    tcp: "TCP", inFrame: (frame: string) => `TCP in ${frame}`, tcpAxes: ["X", "Y", "Z", "Rx", "Ry", "Rz"], hintTrace: [["Click", "traces an edge"], ["Shift", "the whole loop"], ["Esc", "leaves"]], hintTeach: [["Drag the ring", "moves the tool"], ["click", "selects"], ["T", "traces edges"]],
    hintCheck: [["Click a point", "says why"], ["drag the timeline", "moves the robot"]], hintRun: [["Run", "proves the exported text"], ["Pause", "holds"]], hintHistory: [["Drag the timeline", "looks back"]], close: "Close camera", main: "Overview", camera: "Main or close camera",
    touching: (names: string) => `Contact: ${names}.`,
  },
  trace: {
    process: "Process", processNone: "As set below", processSays: "Starting values, to be tuned to your material and tool.",
    processes: { "arc-welding": "Arc welding", deburring: "Deburring", soldering: "Soldering", chamfering: "Chamfering", gluing: "Gluing", "water-jet": "Water jet", inspection: "Inspection" },
    title: "Trace edges", tool: "Trace", tip: "Click edges of an object and get points along them", tilt: "Tool angle", leadIn: "Lead-in", leadOut: "Lead-out", chord: "Chord tolerance", tolerance: "Path tolerance", motion: "Motion", joint: "PTP between points", straight: "LIN", speed: "Speed",
    loop: "Whole loop", chosen: "Chosen edges", none: "Click an edge in the view. Shift takes its whole loop.", make: "Make points", clear: "Clear", working: "Points are being laid …", edge: (n: number, mm: string) => `Edge ${n} · ${mm} mm`, remove: (n: number) => `Take edge ${n} out`,
    made: (points: number, edges: number, inserted: number) => `${plural(points, "point")} on ${plural(edges, "edge")}; ${inserted} of them inserted to stay within tolerance.`, deviation: (mm: string, tolerance: string) => `Largest deviation from the edge: ${mm} mm (allowed ${tolerance} mm).`,
    group: (n: number) => `Edge ${n}`, loopGroup: (n: number) => `Loop ${n}`, approach: "Approach", retreat: "Retreat", last: "Last trace", options: "Tool angle and tolerances", stopped: "The points could not be laid.", cannot: (edge: number, why: string) => `Edge ${edge} cannot be traced. ${why}`, cannotHint: "Change the tool angle, move the object, or trace fewer edges.", leave: "Done tracing", home: "Home",
  },
  collide: {
    title: "Collision", menu: "Collision …", behaviour: "Where a motion by hand would touch something",
    behaviours: { alert: "Alert only", refuse: "Refuse the point", stop: "Stop and go back", slide: "Slide along", untangle: "Find another way" },
    says: {
      alert: "It goes on. What touches turns red and a sound tells once.", refuse: "It goes on and alerts, but a point cannot be taught in contact.",
      stop: "It stops before the contact and goes back to the last posture with room around it.", slide: "It goes on along the surface, 2 mm from it.",
      untangle: "Go there and Do Ready lead round what is in the way; by hand it slides along.",
    },
    kept: "Kept from the cell", shapeError: "Shape error of the drawn links", braking: "Braking from full speed", keptSays: (mm: string) => `${mm} mm`, brakingSays: (s: string, mm: string) => `${s} s, up to ${mm} mm of the tool`,
    precision: "The answer is only as good as the cell: the shape error is added to what is kept between links and objects.",
    matrix: "Pairs of the robot's own parts", learn: "Learn again", learnFirst: "Learn", learning: "Postures are being tried …", matrixNone: "Parts that touch at the home posture are left out, all others are checked. Learn the matrix to see and change that.", matrixHint: "Click a pair to check it or leave it out.",
    matrixStale: "The matrix was learnt with another tool; pairs of the tool are checked as usual until it is learnt again.",
    reasons: { adjacent: "joined by a joint", always: "touched in every posture that was tried", "at home": "touch at the home posture, by design", allowed: "allowed by the cell", sometimes: "touched in some postures", "never seen": "never touched" },
    pair: (a: string, b: string, watched: boolean, why: string) => `${a} and ${b}: ${watched ? "checked" : "left out"}, ${why}`, checked: "checked", leftOut: "left out", joined: "joined", tried: (n: number) => `${n.toLocaleString("en")} postures tried.`,
    clearance: "Clearance", nearest: (a: string, b: string) => `${a} – ${b}`, plenty: (mm: string) => `over ${mm}`, contact: "contact",
    solid: (id: string, objects: readonly { readonly id: string; readonly name: string }[]) => { const object = objects.find(each => each.id === id); return object ? `“${object.name}”` : id === "tool" ? "the tool" : id; },
    refused: (a: string, b: string) => `The point was not taught: ${a} is in contact with ${b}.`, refusedHint: "Move until nothing is red, or allow it under Collision in the cell menu.",
    held: (a: string, b: string) => `Stopped: ${a} would touch ${b}.`, back: (a: string, b: string) => `Stopped before ${a} touches ${b}; going back to where there was room.`,
    onTheWay: (a: string, b: string, percent: number) => `Not gone: after ${percent} % of the way ${a} would touch ${b}.`, tooNear: "Not gone: the way comes too near to something to be proven free.", goHint: "Jog round it, or choose Find another way under Collision in the cell menu.",
    blocked: (end: string, a: string, b: string) => `There is no way: at the ${end} ${a} is in contact with ${b}.`, noWay: "No free way was found.", hint: "Make room in the cell, or go there in parts by hand.",
    goes: { straight: "The straight way is free.", "other way round": "It goes the other way round.", "back first": "It turns back first, then goes there.", searched: "It goes by a way round." },
    wayRound: "Find a way round", searching: (percent: number) => `Searching a way … ${percent} %`, found: (points: number) => (points === 0 ? "The step is a joint move now; nothing is in its way." : `The step goes round over ${plural(points, "more point")}.`),
    changed: "A way was found, but the program has changed meanwhile.", changedHint: "Search again.", trouble: "The search stopped without saying why.", troubleHint: "Nothing was changed. Try it again.",
  },
  check: {
    title: "Verdict", clearance: "Clearance", margin: "Joint margin", reach: "Reach", cycle: "Cycle", reachOk: (n: number) => `${n} of ${n}`, reachBad: (bad: number, all: number) => `${bad} of ${all} fail`, notMeasured: "not measured",
    checking: "Checking …", percent: (p: number) => `Checking … ${p} %`, cancel: "Cancel check", again: "Check again", repairAll: (n: number) => `Repair all (${n})`, fine: "Every step can be carried out.", none: "There is nothing to check yet. Add a step first.", notYet: "Not checked yet.",
    assumptions: "What this rests on", cancelled: "The check was cancelled.", stale: "The program changed; it is being checked again.", why: "Why", whyNone: "Nothing stands in the way.", more: (n: number) => `and ${n} more`, affected: (n: number) => `${plural(n, "point")} ${n === 1 ? "is" : "are"} affected.`, repaired: (n: number) => `${plural(n, "repair")} applied.`,
    shown: "This is how it would stand. Esc goes back.", at: (s: string) => `at ${s} s`, trouble: "The program could not be checked:", joint: "Joints at this moment",
  },
  time: {
    play: "Play", pause: "Pause", step: "Step", back: "Step back", of: "/", plots: "Plots", scrubber: "Time", empty: "The program appears here as blocks on a time line.", speed: "Playback speed", angles: "Joint angles", speeds: "Joint speeds", torques: "Torques", limit: "limit", percent: " %", over: (name: string, n: number) => `${name}, ${plural(n, "finding")}`,
    s: (s: number) => s.toFixed(2), seconds: "s", joint: (n: number) => `J${n}`, deg: "°", degS: "°/s", start: "To the start",
  },
  run: {
    title: "Run", text: (language: string) => `${language} text`, neutral: (robot: string) => `No language here speaks for the ${robot}: the steps themselves run on the virtual controller, and the twin on screen mirrors it.`, signals: "Signals", input: (name: string) => `Input ${name}`, kinds: { "digital-in": "in", "digital-out": "out", "analogue-in": "analogue in", "analogue-out": "analogue out" }, run: "Run", again: "Run again", hold: "Pause", resume: "Resume", stop: "Stop", running: (line: number) => `Line ${line} runs.`, idle: "The exported text runs statement by statement on the virtual controller; the twin on screen mirrors it.", twin: "Twin error",
    nothing: "There is nothing to run yet. Add a step first.", done: (s: string) => `The run is done after ${s} s.`, refused: (why: string) => `The controller refused: ${why}`, stopped: (why: string) => `The run was stopped: ${why}`, recording: "Every run is recorded.", notEmitted: (language: string) => `This program cannot be said in ${language}:`, notUnderstood: "The text could not be read:", kept: "The run is in the history.",
    start: "To the first point", io: "Gripper",
  },
  physics: {
    toggle: "Physics", tip: "Play with contact: parts fall, are gripped and carried, belts run, sensors trip", title: "With physics", sensors: "Sensors", tripped: "tripped", free: "free", restsOn: "This rests on", go: "Let it go on", again: "Play again",
    status: { idle: "Press Play: the program is carried out with contact.", loading: "The engine is loaded …", running: "Runs", held: "Held", stopped: "Stopped for safety", paused: "Could not go on", done: "Done" },
  },
  history: {
    title: "Runs", moment: "Moment of the run", none: "No run yet. Every run is recorded and appears here.", open: "Open run", endings: { done: "done", stopped: "stopped", refused: "refused", running: "runs now", "cut-off": "cut off" }, remove: "Delete run", download: "Download .mcap", events: "Events", noEvents: "Nothing happened in this run but motion.", loading: "The recording is being read …", unreadable: "The recording could not be read:", choose: "Open a run to look back at any moment of it.",
    size: (bytes: number) => (bytes < 1e6 ? `${Math.round(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`), full: "There is no room left in this browser for the recording of this run.", fullHint: "Delete older runs, or download them first.", name: (cell: string, n: number) => `${cell}, run ${n}`, deleted: "The run was deleted.", back: "Back to now",
    unknownRobot: (robot: string) => `The recording is of ${robot}, a robot that is not known here.`, otherJoints: (joints: number, robot: string, has: number) => `The recording has ${joints} joints; ${robot} has ${has}.`, unreadableHint: "Record anew, or look for a copy of the file.", unreadableKept: "Download the file to keep it, or delete the run.",
    tidied: (n: number) => `${plural(n, "old run")} went: runs are kept for 90 days and up to 1 GB.`, keeping: "Runs are kept in this browser for 90 days and up to 1 GB; the oldest go first. Download what must stay.", noAlarm: "There is no alarm in this recording.", openFile: "Open .mcap files …", dropHint: "Recordings of any length open here, also several files at once.",
    views: "What is shown", momentView: "Moment", cyclesView: "Cycles", figuresView: "Figures", lastAlarm: "Last alarm", share: "Share this moment", branch: "Branch from here", branchSays: "Starts a simulation from this instant: posture, lines and step as they were.",
    shared: "A link to this moment is in the clipboard.", sharedInBar: "The address bar shows a link to this moment.", sharedHint: "It opens in this browser, where the run is kept. Elsewhere it asks for the downloaded file.", sharedFileHint: (name: string) => `It asks for the file ${name} where it is opened.`, notHere: (name: string) => `The link names a moment of ${name}, which is not kept in this browser.`, notHereHint: "Drop that .mcap file here; it opens at the moment of the link.",
    branchOther: (recorded: string, robot: string) => `The recording is of ${recorded}; the robot in the cell is the ${robot}.`, branchOtherHint: "Put the recorded robot into the cell, then branch.", branchNoStep: (step: string) => `The step “${step}” of that moment is no longer in the program: it runs from its beginning.`,
    mode: "Mode", safety: "Safety", gripper: "Gripper", closed: "closed", opened: "open", lines: "Lines", noStep: "no step", gap: "Nothing was recorded at this moment; this is how it stood before.", modes: { manual: "manual", automatic: "automatic", remote: "remote" }, safeties: { "normal": "normal", "guard-stop": "stopped by the guard", "protective-stop": "protective stop", "emergency-stop": "emergency stop" },
    zoom: "Time shown", zooms: { all: "All", hour: "1 h", tenMinutes: "10 min", minute: "1 min", ten: "10 s" }, overview: "Where the time shown lies in the recording", moreMarks: (n: number) => `and ${n} more; zoom in to see them.`,
    noCycles: "No cycle yet: a cycle begins where a program starts.", cycle: (n: number) => `Cycle ${n}`, overlaySays: "Choose two cycles to lay them over each other in the view.", first: "first", second: "second", cycleEnds: { again: "then the next", done: "done", stopped: "stopped", refused: "refused", open: "not ended" }, endOverlay: "Take the overlay away",
    longer: (s: string) => `The second takes ${s} s longer.`, shorter: (s: string) => `The second takes ${s} s less.`, asLong: "Both take the same time.", apart: (mm: string, s: string) => `At the same time since the start they are at most ${mm} mm apart, after ${s} s.`, offPath: (mm: string) => `The ways themselves lie at most ${mm} mm apart.`,
    notReported: "not reported", cycleTimes: "Cycle times", cyclesSay: (n: number, median: string, fastest: string, slowest: string) => `${plural(n, "cycle")}, ${median} s in the middle, ${fastest} … ${slowest} s`, use: "Use", useSays: (moving: string, stopped: string, recorded: string) => `${moving} % in motion, ${stopped} % stopped by safety, of ${recorded} recorded`, alarms: "Alarms", noAlarms: "No alarm.", alarmTimes: (n: number) => plural(n, "time"), load: "Joint load", temperature: "Joint temperature", travel: "Travel per joint", perHour: "per hour", hints: "Hints", noHints: "Nothing stands out.", noService: "Service intervals: not reported. Robots here come without their makers' papers.",
    slower: (percent: string, from: string, to: string) => `Cycles became ${percent} % slower: from ${from} s to ${to} s.`, loadRises: (joint: number, percent: string) => `The load of joint ${joint} rose by ${percent} %: look for friction, or a heavier part.`, temperatureRises: (joint: number, percent: string) => `Joint ${joint} became ${percent} % warmer.`, repeats: (code: string, n: number) => `${code} came ${plural(n, "time")}.`, serviceDue: (joint: number, percent: string) => `Joint ${joint} used up ${percent} % of its service interval.`, percent: "%", joint: (n: number) => `J${n}`,
  },
  file: {
    save: "Save to file", load: "Open file …", example: "Open the edge-trace example", fresh: "New empty cell", drop: "Drop a cell, program or CAD file to open it.", opened: (name: string) => `${name} is open.`, saved: (name: string) => `${name} was saved to your downloads.`, lifted: (text: string) => `The file was brought up to date: ${text}`, tooNew: (version: number, newest: number) => `This file says version ${version}; this Twincell reads up to version ${newest}.`, tooNewHint: "Open it with a newer Twincell.",
    notCell: (name: string, why: string) => `${name} was not opened. ${why}`, notCellHint: "What you had is still open.", fullDisk: "The browser has no room left to keep this cell.", fullDiskHint: "Nothing is lost: it stays open. Save it to a file, or delete old runs in History.", noKeep: (why: string) => `The browser did not keep the cell: ${why}`, noKeepHint: "Nothing is lost: it stays open. Save it to a file.",
    damaged: "The cell kept in this browser could not be read; an earlier copy was opened.", lost: "The cell kept in this browser could not be read; the example was opened instead.", unreadable: (name: string) => `${name} could not be read from the disk.`, mesh: (name: string, faces: number) => `${name} was added with ${faces.toLocaleString("en")} triangles.`, unknownKind: (name: string) => `${name} is neither a cell, nor a recording, nor a program text of a language known here, nor an STL or OBJ mesh.`, unknownHint: "Drop a .json cell saved by Twincell, a recording (.mcap), a program text (.v2, .src, .script, .mod, .JBI …), or an STL or OBJ mesh.",
  },
  welcome: {
    title: "Start with a cell", example: "Open an example", exampleSays: "A Stäubli RX90L, a carton on a table, four edges to trace.", drop: "Drop a CAD file", dropSays: "STL, OBJ and PLY meshes become objects; cells and program texts open.", connect: "Connect a controller", connectSays: (robot: string) => `The virtual ${robot} is connected. Real controllers come later.`, robot: "Choose a robot", robotSays: (robots: number) => `Or take one of the ${robots} robots of the library.`, connected: "connected", empty: "Empty cell", choose: "Choose a file",
  },
  export: {
    title: "Export", dialect: "Language", files: "Files", text: "Text", warnings: "Notes", none: "No notes.", download: "Download as zip", downloadFiles: "Single files", copy: "Copy text", step: (name: string) => `from ${name}`, cannot: "This program cannot be written in this language:", manifest: "Manifest", lines: (n: number) => plural(n, "line"), copied: "The text is in the clipboard.", notCopied: "The browser did not allow copying.", notCopiedHint: "Select the text and copy it by hand.",
    proof: (mm: string, deg: string) => `Read back by an independent interpreter: every point within ${mm} mm and ${deg}°.`, import: "Import or run a program text", importSays: "Paste or drop a program of any language known here.", paste: "Program text", line: (line: number, column: number, sentence: string) => `Line ${line}, column ${column}: ${sentence}`, imported: (n: number) => `${plural(n, "step")} imported.`, proven: "proven by interpreting the text", experimental: "Experimental: written from public sources and proven by interpreting the text; not yet tried on a controller of this make.", experimentalTag: "experimental", noLanguage: (robot: string) => `No language here speaks for the ${robot}. Its programs can be taught, checked and run, not exported.`, button: (language: string) => (language === "" ? "Export" : `Export ${language}`), refusedBy: "For other controllers",
    cannotDo: "What this language cannot say",
  },
  robots: {
    title: "Another robot", another: "Another robot …", search: "Search by name, maker or number of axes", none: (text: string) => `No robot of the library is called “${text}”.`, vendor: "Maker", axes: "Axes", here: "in the cell", madeUp: "made-up geometry",
    madeUpSays: "Nobody publishes the lengths of this arm; they were made up. What is found here says nothing about the real robot.", facts: (axes: number, kg: number, mm: string) => `${axes} axes · ${kg} kg · ${mm} mm`,
    use: (name: string) => `Use the ${name}`, useNone: "Use this robot", already: "This robot is in the cell.", keeps: "The cell stays; the program is taught anew so that the tool goes where it went.", busy: "The robot is running a program; stop it first.",
    changed: (name: string, kept: number, points: number) => (points === 0 ? `The ${name} is in the cell.` : kept === points ? `The ${name} is in the cell; all ${plural(points, "point")} were kept.` : `The ${name} is in the cell; ${kept} of ${plural(points, "point")} were kept, ${points - kept} cannot be reached.`), changedHint: "Check says why, and what would fix it.",
  },
  programs: { switch: "Stored programs", new: "New program", duplicate: "Duplicate this program", rename: "Rename this program", remove: "Delete this program", name: "Name of the program", plain: "Program", removed: (name: string) => `${name} was deleted. Undo brings it back.` },
  poses: {
    title: "Saved poses", none: "No pose is kept yet. Jog the tool somewhere and keep it.", add: "Keep pose", addTip: "A frame of the cell where the tool tip is now", put: (name: string) => `Put “${name}” where the tool is`, putTip: "Put it where the tool is now, reachable or not",
    load: "Load …", save: "Save …", loaded: (n: number) => `${plural(n, "pose")} loaded.`, through: "Move through", throughTip: "The program goes on through all of them, in their order", remove: "Forget all", removed: "All saved poses are gone. Undo brings them back.",
  },
  foreign: {
    guess: "Find out", nothing: "Nothing to read yet.", reads: (language: string, steps: number) => `Read as ${language}: ${plural(steps, "step")}.`, cannotRead: (language: string) => `Read as ${language}, it is not understood:`, skip: "Skip what is not understood",
    skipSays: "Statements that are not understood are left out. The robot then does something else than the text says.", skipped: leftOut,
    steps: "Make steps", asText: "Run as text", pasted: "Pasted text",
    asTextSays: "Run as text executes it line by line on the virtual controller, with breakpoints. Your program stays as it is.", run: "Run the text", step: "One statement", paused: (line: number) => `It stands before line ${line}.`, idle: "Click a line number to stop there.",
    breakpoint: (line: number) => `Stop before line ${line}`, edit: "Edit the text", back: "Back to the program", done: "The text is done.", fault: (line: number, why: string) => `Line ${line} could not be executed: ${why}`,
  },
  palette: { title: "Commands", search: "Type a command", none: "No command is called that.", groups: { file: "Cell", edit: "Edit", program: "Program", jog: "Robot", view: "View", play: "Timeline", help: "Help" } },
  shortcuts: { title: "Keyboard", open: "Keyboard shortcuts" },
  coach: {
    title: "First trace", of: (n: number, all: number) => `${n} of ${all}`, skip: "Do not show this again", next: "Next",
    steps: [
      ["Look around", "Drag to orbit, wheel to zoom, right-drag to pan. Click a part to see its numbers."],
      ["Turn on Trace", "Press T. Edges light up under the pointer."],
      ["Click the four top edges", "Or hold Shift and take the whole loop at once."],
      ["Make points", "The tool leans 45° into the edge; points are added until the path stays within tolerance."],
      ["Check it", "Blue is fine, yellow is near a limit, red is not possible. Why cards say what would fix it."],
      ["Run it", "The text of the robot's own language runs on the virtual controller, and every run is recorded."],
    ],
  },
  commands: {
    stop: "Stop everything", undo: "Undo", redo: "Redo", save: "Save to file", load: "Open file …", example: "Open the edge-trace example", fresh: "New empty cell", palette: "All commands", shortcuts: "Keyboard shortcuts", controls: "Controls: keys and gamepad", collision: "Collision …", export: "Export the program", import: "Import or run a program text",
    teach: "Teach", check: "Check", run: "Run", history: "History", theme: "Theme: light or dark", mute: "Sounds on or off", camera: "Main or close camera", headset: "Enter the headset", trace: "Trace edges", recordPtp: "Record point, PTP", recordLin: "Record point, LIN", recordMoving: "Record while moving: on or off", touchUp: "Touch up the selected point", wait: "Add a wait", gripperClose: "Add: close gripper", gripperOpen: "Add: open gripper", set: "Add: set a signal", waitFor: "Add: wait for a signal", comment: "Add: comment", repeat: "Add: loop around the step",
    ready: "Do Ready: go home", zero: "All joints to zero", aidNext: "Next orientation aid", aidPrevious: "Previous orientation aid", remove: "Delete what is selected", duplicate: "Duplicate the selected step", clear: "Clear the program", anotherRobot: "Another robot …", play: "Play or pause", physics: "Play with physics, or without", resume: "Let the robot go on", conveyor: "Open the conveyor example", stepOn: "Next step", stepBack: "Previous step", start: "To the start", checkNow: "Check now", repairAll: "Repair all", plots: "Plots", up: "Move the step up", down: "Move the step down", rename: "Rename", startRun: "Run on the virtual controller", frame: (name: string) => `Jog in ${name}`, coach: "Show the coach again", box: "Add a box", deselect: "Leave",
  },
  video: videoWords,
  sheet: { label: "Tools", jog: "Jog", program: "Program", why: "Why", run: "Run", dead: "Hold to move" },
};
