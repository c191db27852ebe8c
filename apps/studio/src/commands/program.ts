import type { Program } from "@twincell/core";
import { goThere } from "../runtime/jog/go-to-point.ts";
import { contactAt, namesOf } from "../runtime/jog/hand-motion.ts";
import { theLive } from "../runtime/live.ts";
import { solveStep } from "../runtime/jog/solve.ts";
import { touchUpSelected } from "../runtime/text-program.ts";
import { cellStore } from "../stores/cell.ts";
import { keepPose } from "../stores/poses.ts";
import {
  addMessage,
  addPallet,
  addPayload,
  addRoutine,
  addStop,
  recordedTarget,
  touchedTarget,
} from "../stores/structure.ts";
import { collideStore } from "../stores/collide.ts";
import type { Command } from "../stores/commands.ts";
import { textOf, theProgram, theRobot } from "../stores/document.ts";
import { notify } from "../stores/notices.ts";
import {
  addComment,
  addGripper,
  addAssign,
  addCall,
  addIf,
  addRepeat,
  addWhile,
  addSet,
  addWait,
  addWaitFor,
  clearProgram,
  copySteps,
  deleteSteps,
  findStep,
  recordArcTo,
  recordPoint,
  stepWords,
  touchUp,
} from "../stores/program.ts";
import { recordMoving, recordStore } from "../stores/record.ts";
import { seekStep } from "../stores/seek.ts";
import { selectionStore } from "../stores/selection.ts";
import { sound } from "../stores/sound.ts";
import { words } from "../messages/index.ts";

/** Joint angles closer than this are the same point [rad, m]. */
const SAME_RAD = 1e-4;

const selectedStep = (): string | null => {
  const { selected } = selectionStore.getState();
  return selected?.kind === "step" ? selected.id : null;
};
const stepOf = (id: string | null): ReturnType<typeof findStep> => {
  const program = theProgram();
  return program && id !== null ? findStep(program, id) : undefined;
};
const isMove = (id: string | null): boolean => stepOf(id)?.step.type === "move";
const hasProgram = (): boolean => theProgram() !== null;
const tool = (): string => cellStore.getState().document?.tool ?? "flange";
const nameOf = (id: string): string => {
  const found = stepOf(id);
  return found ? stepWords(found.step, found.index) : id;
};

/** Row T-42: a point in contact is not taught, unless a contact is to be an alert only. Says what touches what. */
function refused(): boolean {
  const contact = collideStore.getState().behaviour === "alert" ? null : contactAt(theLive().q_rad);
  if (contact === null) return false;
  const [a, b] = namesOf(contact);
  sound("limit");
  notify("bad", words.collide.refused(a, b), words.collide.refusedHint);
  return true;
}
function record(path: "ptp" | "lin"): void {
  if (refused()) return;
  if (!recordPoint(path, theLive().q_rad, tool(), recordedTarget)) return;
  const id = selectedStep();
  const step = stepOf(id)?.step;
  if (!id || step?.type !== "move") return;
  const pallet = "frame" in step.target ? step.target.frame : undefined;
  if (pallet === undefined) notify("done", words.jog.recorded(nameOf(id)));
  else notify("done", words.editor.recordedAtPlace(nameOf(id), pallet));
}
/** The first press keeps the point in between, the second ends the arc there; another program forgets it. */
let via: { readonly program: Program; readonly q_rad: readonly number[] } | null = null;
function recordArc(): void {
  const program = theProgram();
  if (!program || refused()) return;
  const { q_rad } = theLive();
  if (via?.program !== program) {
    via = { program, q_rad: Array.from(q_rad) };
    notify("info", words.headset.viaKept);
    return;
  }
  if (via.q_rad.every((angle, i) => Math.abs(angle - q_rad[i]!) < SAME_RAD)) {
    notify("warn", words.headset.viaNone);
    return;
  }
  if (recordArcTo(via.q_rad, q_rad, tool())) via = null;
  const id = selectedStep();
  if (id && via === null) notify("done", words.jog.recorded(nameOf(id)));
}
function gripper(closed: boolean): void {
  if (addGripper(closed)) sound("grip");
}

export const programCommands = (): readonly Command[] => [
  {
    id: "program.record-ptp",
    group: "program",
    words: words.commands.recordPtp,
    keys: ["P"],
    can: hasProgram,
    run: () => record("ptp"),
  },
  {
    id: "program.record-lin",
    group: "program",
    words: words.commands.recordLin,
    keys: ["Shift+P"],
    can: hasProgram,
    run: () => record("lin"),
  },
  { id: "program.record-circ", group: "program", words: words.commands.recordCirc, can: hasProgram, run: recordArc },
  {
    id: "program.record-moving",
    group: "program",
    words: words.commands.recordMoving,
    keys: ["Shift+R"],
    can: hasProgram,
    run: () => recordMoving(!recordStore.getState().moving),
  },
  {
    id: "program.touch-up",
    group: "program",
    words: words.commands.touchUp,
    keys: ["Shift+U"],
    can: () => isMove(selectedStep()),
    run: () => {
      if (textOf(cellStore.getState().document)) {
        if (!refused()) void touchUpSelected();
        return;
      }
      const id = selectedStep();
      if (id && !refused() && touchUp(id, theLive().q_rad, tool(), touchedTarget))
        notify("done", words.jog.touched(nameOf(id)));
    },
  },
  {
    id: "program.wait",
    group: "program",
    words: words.commands.wait,
    can: hasProgram,
    run: () => {
      addWait(0.5);
    },
  },
  {
    id: "program.wait-for",
    group: "program",
    words: words.commands.waitFor,
    can: hasProgram,
    run: () => {
      addWaitFor();
    },
  },
  {
    id: "program.set",
    group: "program",
    words: words.commands.set,
    can: hasProgram,
    run: () => {
      addSet();
    },
  },
  {
    id: "program.repeat",
    group: "program",
    words: words.commands.repeat,
    can: hasProgram,
    run: () => {
      addRepeat();
    },
  },
  {
    id: "program.while",
    group: "program",
    words: words.commands.while,
    can: hasProgram,
    run: () => {
      addWhile();
    },
  },
  {
    id: "program.if",
    group: "program",
    words: words.commands.if,
    can: hasProgram,
    run: () => {
      addIf();
    },
  },
  {
    id: "program.assign",
    group: "program",
    words: words.commands.assign,
    can: hasProgram,
    run: () => {
      addAssign();
    },
  },
  {
    id: "program.call",
    group: "program",
    words: words.commands.call,
    can: () => Object.keys(theProgram()?.routines ?? {}).length > 0,
    run: () => {
      addCall();
    },
  },
  {
    id: "program.pallet",
    group: "program",
    words: words.editor.commands.pallet,
    can: hasProgram,
    run: () => {
      addPallet(theLive().worldFromTcp);
    },
  },
  {
    id: "program.payload",
    group: "program",
    words: words.editor.commands.payload,
    can: hasProgram,
    run: () => {
      addPayload();
    },
  },
  {
    id: "program.message",
    group: "program",
    words: words.editor.commands.message,
    can: hasProgram,
    run: () => {
      addMessage();
    },
  },
  {
    id: "program.stop",
    group: "program",
    words: words.editor.commands.stop,
    can: hasProgram,
    run: () => {
      addStop();
    },
  },
  {
    id: "program.routine",
    group: "program",
    words: words.editor.commands.routine,
    can: hasProgram,
    run: () => {
      addRoutine();
    },
  },
  {
    id: "program.keep-pose",
    group: "program",
    words: words.editor.commands.keepPose,
    keys: ["Shift+K"],
    run: () => {
      if (keepPose(theLive().worldFromTcp)) notify("done", words.editor.poseKept);
    },
  },
  {
    id: "program.comment",
    group: "program",
    words: words.commands.comment,
    can: hasProgram,
    run: () => {
      addComment();
    },
  },
  {
    id: "program.gripper-close",
    group: "program",
    words: words.commands.gripperClose,
    can: hasProgram,
    run: () => gripper(true),
  },
  {
    id: "program.gripper-open",
    group: "program",
    words: words.commands.gripperOpen,
    can: hasProgram,
    run: () => gripper(false),
  },
  {
    id: "program.go-to",
    group: "program",
    words: words.tree.goTo,
    keys: ["G"],
    can: () => selectedStep() !== null,
    run: () => {
      const id = selectedStep();
      const robot = theRobot();
      const step = stepOf(id)?.step;
      if (step?.type !== "move" || !robot) {
        if (id) seekStep(id);
        return;
      }
      const there = solveStep(step, theLive().q_rad);
      if (there.kind === "reached") goThere(robot, there.q_rad);
      else notify("warn", there.sentence);
    },
  },
  {
    id: "program.duplicate",
    group: "program",
    words: words.commands.duplicate,
    keys: ["Mod+D"],
    can: () => selectedStep() !== null,
    run: () => {
      const id = selectedStep();
      if (id) copySteps([id]);
    },
  },
  {
    id: "program.delete",
    group: "program",
    words: words.commands.remove,
    keys: ["Delete"],
    can: () => selectedStep() !== null,
    run: () => {
      const id = selectedStep();
      if (id) deleteSteps([id]);
    },
  },
  {
    id: "program.clear",
    group: "program",
    words: words.commands.clear,
    can: () => (theProgram()?.steps.length ?? 0) > 0,
    run: () => {
      clearProgram();
    },
  },
];
