import { dialectById } from "@twincell/languages";
import { cellStore } from "../../stores/cell.ts";
import { controlStore } from "../../stores/control.ts";
import { robotOf } from "../../stores/document.ts";
import { foreignStore } from "../../stores/foreign.ts";
import { notify } from "../../stores/notices.ts";
import { sound } from "../../stores/sound.ts";
import { onStop } from "../../stores/stop.ts";
import { words } from "../../messages/index.ts";
import { theControl } from "../robot/cell-control.ts";
import { leaveRobot, takeRobot } from "../robot/motion-owner.ts";
import { askBeforeRun } from "./ask-before-run.ts";
import { textRun, type TextEnding, type TextRun } from "./text-run.ts";

let run: TextRun | null = null;
onStop(() => {
  run?.stop();
});

/**
 * Runs the text that is open on the virtual controller, on from where it stands. `single`: one statement. The text of
 * the cell is checked as its steps are, and a check that is not content asks first.
 */
export function runForeign(single: boolean): void {
  if (!run && foreignStore.getState().open?.ofCell === true) {
    askBeforeRun(() => {
      goOn(single);
    });
  } else goOn(single);
}

function goOn(single: boolean): void {
  const { open } = foreignStore.getState();
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  const control = theControl();
  if (!open || !document || !robot || !control) return;
  if (!run) {
    if (controlStore.getState().running) {
      notify("info", words.robots.busy);
      return;
    }
    const dialect = dialectById(open.dialect);
    if (!dialect) return;
    const made = textRun(
      control,
      dialect,
      open.text,
      {
        robot,
        worldFromBase: document.robot.worldFromBase,
        name: open.name,
        cellName: document.name,
        skipUnknown: open.skipUnknown ?? false,
      },
      () => foreignStore.getState().breakpoints,
      state => foreignStore.setState(state),
      ended,
    );
    if ("kind" in made) {
      const [first] = made.faults;
      notify(
        "bad",
        `${words.run.notUnderstood} ${first ? words.export.line(first.line, first.column, first.sentence) : ""}`,
      );
      return;
    }
    run = made;
    takeRobot("run", () => {
      run?.stop();
    });
  }
  void (single ? run.step() : run.run());
}
export const stopForeign = (): void => {
  run?.stop();
};

function ended(ending: TextEnding): void {
  run = null;
  leaveRobot("run");
  switch (ending.kind) {
    case "done":
      sound("done");
      notify("done", words.foreign.done, words.run.kept);
      break;
    case "stopped":
      notify("warn", words.run.stopped(ending.why.sentence), ending.why.hint);
      break;
    case "refused":
      notify("bad", words.run.refused(ending.why.sentence), ending.why.hint);
      break;
    case "fault":
      notify("bad", words.foreign.fault(ending.line, ending.sentence), ending.hint);
      break;
  }
}
