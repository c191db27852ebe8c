import {
  everyStep,
  flangeOfTcp,
  nearestTo,
  snapPoint,
  taughtAgain,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
} from "@twincell/core";
import { selectedProgram, type CellDocument } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { collideStore } from "../../stores/collide.ts";
import { isLive } from "../../stores/connection.ts";
import { flangeFromTcpOf, robotOf } from "../../stores/document.ts";
import { editStore } from "../../stores/edit-point.ts";
import { notify } from "../../stores/notices.ts";
import { playStore, verdictOf } from "../../stores/play.ts";
import { changeMove, findStep, stepWords } from "../../stores/program.ts";
import { select } from "../../stores/selection.ts";
import { sound } from "../../stores/sound.ts";
import { onStop } from "../../stores/stop.ts";
import { words } from "../../messages/index.ts";
import { fixed } from "../../messages/numbers.ts";
import { theLive } from "../live.ts";
import { worldFromTarget } from "../planning/target-pose.ts";
import { contactAt, namesOf } from "./hand-motion.ts";
import { onFrame } from "./jog-frames.ts";
import { interpolateTo } from "./joint-interpolation.ts";

/** A point within this is snapped to [m]. */
export const SNAP_M = 0.12;
/** The program is judged again as often as this while the point is moved. */
const STORE_EVERY_MS = 250;
/** A joint that moved less has not [rad, m]. */
const STILL = 1e-6;

interface Editing {
  readonly step: string;
  readonly robot: Robot;
  readonly gesture: string;
  /** Where the tool snapped to; null on the way there. */
  snapped_rad: Float64Array | null;
  stored_rad: Float64Array;
  readonly end: () => void;
}
let editing: Editing | null = null;
let gestures = 0;

/**
 * EDIT pressed (row L-42): the tool snaps to the nearest point that cannot be carried out, or else to the nearest of
 * all, within 120 mm; of one out of reach it goes as near as the robot can. Says whether there is one. What is moved
 * from then on is stored in the point, and the program judged again, while EDIT is held.
 */
export function beginEdit(): boolean {
  if (editing) return true;
  const { document } = cellStore.getState();
  const program = document ? selectedProgram(document) : undefined;
  const robot = robotOf(document);
  if (!document || !program || !robot) {
    notify("info", words.edit.none);
    return false;
  }
  if (isLive()) {
    notify("warn", words.edit.live, words.edit.liveHint);
    return false;
  }
  const { verdict } = playStore.getState();
  const moves = Array.from(everyStep(program)).filter((step): step is MoveStep => step.type === "move");
  const points = moves.flatMap(step => {
    const worldFromTcp = worldFromTarget(document, program, robot, step.target);
    return worldFromTcp ? [{ id: step.id, worldFromTcp, bad: verdictOf(verdict, step.id) === "bad" }] : [];
  });
  const snap = snapPoint(points, theLive().worldFromTcp.position, SNAP_M);
  if (snap.kind === "none") {
    notify("info", words.edit.none);
    return false;
  }
  const { id, worldFromTcp } = snap.point;
  const found = findStep(program, id);
  const name = found ? stepWords(found.step, found.index) : id;
  if (snap.kind === "too-far") {
    notify("info", words.edit.tooFar(name, millimetres(snap.distance_m)), words.edit.tooFarHint);
    return false;
  }
  const step = moves.find(each => each.id === id)!;
  begin({ document, program, robot, step, name, worldFromTcp });
  return true;
}

interface Beginning {
  readonly document: CellDocument;
  readonly program: Program;
  readonly robot: Robot;
  readonly step: MoveStep;
  readonly name: string;
  readonly worldFromTcp: Pose<"world", "tcp">;
}
function begin({ document, program, robot, step, name, worldFromTcp }: Beginning): void {
  const { id } = step;
  const tool = step.target.tool ?? document.tool;
  const flangeFromTcp = program.tools[tool] ?? flangeFromTcpOf(document);
  const near = theLive().q_rad;
  const there =
    "q" in step.target && insideLimits(robot, step.target.q)
      ? { q_rad: Float64Array.from(step.target.q), short_m: 0 }
      : nearestTo(robot, flangeOfTcp(document.robot.worldFromBase, worldFromTcp, flangeFromTcp), near);
  let stored_ms = 0;
  const stopListening = onStop(endEdit);
  const stopFrames = onFrame(now_ms => {
    if (now_ms - stored_ms < STORE_EVERY_MS) return;
    stored_ms = now_ms;
    store();
  });
  const mine: Editing = {
    step: id,
    robot,
    gesture: `edit ${id} ${++gestures}`,
    snapped_rad: null,
    stored_rad: there.q_rad,
    end: () => {
      stopListening();
      stopFrames();
    },
  };
  editing = mine;
  select({ kind: "step", id });
  editStore.setState({ edited: { step: id, name, short_m: there.short_m } });
  sound("grip");
  interpolateTo(robot, there.q_rad, arrived => {
    if (editing !== mine) return;
    if (arrived) mine.snapped_rad = there.q_rad;
    // The hand was faster: it moves the point from where it took the tool.
    else mine.snapped_rad = Float64Array.from(theLive().q_rad);
    mine.stored_rad = mine.snapped_rad;
  });
}

/** Whether the robot was moved since it snapped, or since it was stored. */
const differs = (from_rad: Float64Array): boolean =>
  theLive().q_rad.some((angle, joint) => Math.abs(angle - from_rad[joint]!) > STILL);

/** The point becomes where the robot stands; not in contact, unless a contact is to be an alert only. */
function store(): "stored" | "still" | "contact" {
  const { document } = cellStore.getState();
  const program = document ? selectedProgram(document) : undefined;
  if (!editing || !document || !program || editing.snapped_rad === null || !differs(editing.stored_rad)) return "still";
  const { q_rad } = theLive();
  if (collideStore.getState().behaviour !== "alert" && contactAt(q_rad) !== null) return "contact";
  const { robot, step, gesture } = editing;
  editing.stored_rad = Float64Array.from(q_rad);
  changeMove(
    step,
    words.undo.editPoint,
    before => ({ ...before, target: taughtAgain(before.target, robot, q_rad, program, document.robot.worldFromBase) }),
    gesture,
  );
  return "stored";
}

/** EDIT let go: the point is where the tool was brought. Where it was not moved, nothing changes. */
export function endEdit(): void {
  if (!editing) return;
  const { edited } = editStore.getState();
  const moved = editing.snapped_rad !== null && differs(editing.snapped_rad);
  const last = store();
  editing.end();
  editing = null;
  editStore.setState({ edited: null });
  if (!moved || edited === null) return;
  if (last === "contact") {
    const contact = contactAt(theLive().q_rad);
    if (contact) notify("bad", words.edit.contact(edited.name, ...namesOf(contact)), words.collide.refusedHint);
    return;
  }
  notify("done", words.edit.stored(edited.name));
}

export const isEditing = (): boolean => editing !== null;

const insideLimits = ({ arm }: Robot, q_rad: readonly number[]): boolean =>
  q_rad.length === arm.joints.length &&
  arm.joints.every(({ limits }, joint) => q_rad[joint]! >= limits.lower_rad && q_rad[joint]! <= limits.upper_rad);
const millimetres = (length_m: number): string => fixed(length_m * 1000, 0);
