import { clearOf } from "@twincell/controllers";
import { linkSolids, type CommandOutcome } from "@twincell/core";
import { cellGeometry, type CellDocument } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { registerCommands } from "../../stores/commands.ts";
import { connectionStore } from "../../stores/connection.ts";
import { controlStore } from "../../stores/control.ts";
import { flangeFromTcpOf, programOf, robotOf, textOf } from "../../stores/document.ts";
import { historyStore } from "../../stores/history.ts";
import { onInput } from "../../stores/inputs.ts";
import { theLanguage } from "../../stores/languages.ts";
import { notify } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { sound } from "../../stores/sound.ts";
import { stationOf } from "../../stores/stations.ts";
import { onStop } from "../../stores/stop.ts";
import { viewStore } from "../../stores/view.ts";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { browserRunStorage } from "../history/archive.ts";
import { writtenProgram } from "../planning/posting.ts";
import { showJoints } from "../live.ts";
import { leaveRobot, takeRobot } from "./motion-owner.ts";
import { branchOf, type Branch } from "../history/fork.ts";
import { cellVersion } from "../cell-version.ts";
import { momentFrom, momentHash, type MomentLink } from "../history/moment-link.ts";
import { openInWorker } from "../history/recordings.ts";
import { askBeforeRun, startRunQuestions } from "../run/ask-before-run.ts";
import { controlCell, type CellControl } from "../run/run.ts";
import { pageScheduler } from "../scheduler.ts";
import { connectionCommands } from "./connection-commands.ts";
import { showAs, startCellConnection, tellRefused, theConnected } from "./cell-connection.ts";
import { beginProduction } from "./station-production.ts";
import { runStation, startStations } from "./stations.ts";
import { travelBack, type TravelBack } from "../history/travel-back.ts";

const shelf = browserRunStorage();
let control: CellControl | null = null;
let made: Solids | null = null;

/** What the controller and its guard are made from. */
type Solids = Pick<CellDocument, "robot" | "objects" | "tools" | "tool" | "allowedPairs" | "pairs" | "errors">;
const same = (a: Solids, b: Solids): boolean =>
  a.robot === b.robot &&
  a.objects === b.objects &&
  a.tools === b.tools &&
  a.tool === b.tool &&
  a.allowedPairs === b.allowedPairs &&
  a.pairs === b.pairs &&
  a.errors === b.errors;

/** The controller of the open cell; made anew when robot, tool or surroundings change, but never under a run. */
export function theControl(): CellControl | null {
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  if (!document || !robot) return null;
  if (control && made && (same(made, document) || controlStore.getState().running)) return control;
  control?.close();
  made = document;
  control = controlCell(
    {
      dialect: theLanguage,
      write: program => writtenProgram(program, document),
      scheduler: pageScheduler,
      shelf,
      clock_ms: () => Date.now(),
      cellVersion: () => cellVersion(document),
      elsewhere: () => connectionStore.getState().station !== null,
    },
    {
      robot,
      worldFromBase: document.robot.worldFromBase,
      flangeFromTcp: flangeFromTcpOf(document),
      isSafe: clearOf(cellGeometry(document, linkSolids(robot)), robot).isSafe,
    },
  );
  control.setOverride(playStore.getState().speed);
  return control;
}

export const theHistory: TravelBack = travelBack(shelf, pageScheduler, openInWorker, () => Date.now());

/** On the connected robot, live, recorded as every run. */
async function runConnected(id: string, despite: readonly string[]): Promise<void> {
  showAs("live");
  viewStore.setState({ mode: "run" });
  tellEnd(id, await runStation(id, despite));
}

/** On the connected robot, cycle after cycle. */
async function produceConnected(id: string, despite: readonly string[]): Promise<void> {
  showAs("live");
  viewStore.setState({ mode: "run" });
  tellEnd(id, await beginProduction(id, despite));
}
function tellEnd(id: string, outcome: CommandOutcome): void {
  const name = stationOf(id)?.name ?? id;
  if (outcome.kind === "done") {
    sound("done");
    notify("done", words.stations.done(name), words.run.kept);
  } else notify(outcome.kind === "stopped" ? "warn" : "bad", `${name}: ${outcome.why.sentence}`, outcome.why.hint);
}

/** Runs the program's exported text; says in words how it ended. */
export async function startRun(from?: Branch, despite: readonly string[] = []): Promise<void> {
  const { document } = cellStore.getState();
  const program = programOf(document);
  const running = theControl();
  if (!document || !program || !running) return;
  if (program.steps.length === 0) {
    notify("info", words.run.nothing);
    return;
  }
  const { station } = connectionStore.getState();
  // What goes on from a past moment is a simulation of its own: it is seen on the clone.
  if (station !== null && !from) {
    await runConnected(station, despite);
    return;
  }
  takeRobot("run", () => {
    running.stop();
  });
  viewStore.setState({ mode: "run" });
  const began = performance.now();
  const outcome = await running.run(program, document.name, from);
  leaveRobot("run");
  switch (outcome.kind) {
    case "done":
      sound("done");
      notify("done", words.run.done(fixed((performance.now() - began) / 1000, 2)), words.run.kept);
      break;
    case "stopped":
      notify("warn", words.run.stopped(outcome.why.sentence), outcome.why.hint);
      break;
    case "refused":
      notify("bad", words.run.refused(outcome.why.sentence), outcome.why.hint);
      break;
    case "not-emitted":
      notify("bad", `${words.run.notEmitted(theLanguage()?.name ?? "")} ${outcome.sentence}`, outcome.hint);
      break;
    case "not-understood":
      notify("bad", `${words.run.notUnderstood} ${outcome.sentence}`, outcome.hint);
      break;
  }
}

/** Goes on from the moment that is looked at, as a simulation of its own. */
export async function branchFromHere(): Promise<void> {
  const { document } = cellStore.getState();
  const program = programOf(document);
  const robot = robotOf(document);
  const { moment } = theHistory;
  if (!document || !program || !robot || !moment) return;
  if (theHistory.robot !== robot.id) {
    notify("bad", words.history.branchOther(theHistory.robot, robot.name), words.history.branchOtherHint);
    return;
  }
  theHistory.pause();
  const from = branchOf(moment, program);
  if (from.step === "" && moment.state.step !== "") notify("info", words.history.branchNoStep(moment.state.step));
  showJoints(moment.q_rad);
  await startRun(from);
}

/** The address of the moment that is looked at goes to the clipboard. */
export async function shareMoment(): Promise<void> {
  const { open, name, t_s } = historyStore.getState();
  const { origin, pathname, search } = location;
  const link = `${origin}${pathname}${search}${momentHash({ recording: open ?? name, t_s })}`;
  history.replaceState(null, "", link);
  try {
    await navigator.clipboard.writeText(link);
    notify("done", words.history.shared, open === null ? words.history.sharedFileHint(name) : words.history.sharedHint);
  } catch {
    notify("info", words.history.sharedInBar, words.history.sharedHint);
  } // a browser may forbid the clipboard: the address bar has it too
}

/** Opens the moment that the address of the page names, if it names one. */
async function openLinkedMoment(): Promise<void> {
  const link = momentFrom(location.hash);
  if (!link) return;
  viewStore.setState({ mode: "history" });
  if (!historyStore.getState().runs.some(({ id }) => id === link.recording)) {
    linkedMoment = link;
    notify("warn", words.history.notHere(link.recording), words.history.notHereHint);
    return;
  }
  if (await theHistory.open(link.recording)) theHistory.seek(link.t_s);
}
let linkedMoment: MomentLink | null = null;

/** Opens recordings from outside; one that a link waited for, at its moment. */
export async function openRecordingFiles(files: readonly File[]): Promise<void> {
  viewStore.setState({ mode: "history" });
  if (!(await theHistory.openFiles(files.map(file => ({ name: file.name, blob: file })))) || linkedMoment === null)
    return;
  const { recording, t_s } = linkedMoment;
  if (files.some(({ name }) => name === recording || name === `${recording}.mcap`)) {
    theHistory.seek(t_s);
    linkedMoment = null;
  }
}

/** Starts what runs and recordings need as long as the page lives. */
export function startCellControl(): void {
  theControl();
  void theHistory.refresh().then(openLinkedMoment);
  addEventListener("hashchange", () => {
    void openLinkedMoment();
  });
  startStations();
  startCellConnection();
  // Back on the simulated controller, the chip is its again.
  connectionStore.subscribe((state, before) => {
    if (before.station === null || state.station !== null) return;
    control?.close();
    control = null;
    theControl();
  });
  // Another robot is another controller, as the chip says at once.
  cellStore.subscribe((state, before) => {
    if (state.document?.robot.id !== before.document?.robot.id) theControl();
  });
  onStop(() => {
    control?.stop();
    theHistory.pause();
  });
  playStore.subscribe((state, before) => {
    if (state.speed !== before.speed) control?.setOverride(state.speed);
  });
  viewStore.subscribe((state, before) => {
    if (before.mode === "history" && state.mode !== "history") theHistory.pause();
    if (state.mode === "history" && before.mode !== "history")
      takeRobot("history", () => {
        theHistory.pause();
      });
  });
  onInput((signal, value) => {
    theControl()?.setInput(signal, value);
  });
  startRunQuestions();
  registerCommands([
    ...connectionCommands(),
    {
      id: "run.start",
      group: "play",
      words: words.commands.startRun,
      keys: ["Mod+Shift+Enter"],
      run: () => {
        // A vendor's text runs as it stands, with its breakpoints, where it is seen.
        if (textOf(cellStore.getState().document)) viewStore.setState({ mode: "run" });
        else {
          const { station } = connectionStore.getState();
          askBeforeRun(
            despite => {
              void startRun(undefined, despite);
            },
            station === null ? [] : [station],
          );
        }
      },
    },
    {
      id: "production.begin",
      group: "play",
      words: words.commands.beginProduction,
      can: () => connectionStore.getState().station !== null,
      run: () => {
        const { station } = connectionStore.getState();
        if (station === null) return;
        askBeforeRun(despite => void produceConnected(station, despite), [station]);
      },
    },
    {
      id: "run.reset",
      group: "play",
      words: words.control.reset,
      run: () => {
        const connected = theConnected();
        if (connected) {
          tellRefused(connected.reset());
          return;
        }
        const simulated = theControl();
        if (simulated) tellRefused(simulated.reset());
      },
    },
  ]);
}
