import type { ProvenRepair, Robot } from "@twincell/core";
import {
  framesWith,
  nameOfFrame,
  objectsOfFrame,
  repairCell,
  selectedProgram,
  type CellDocument,
} from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { connectionStore } from "../../stores/connection.ts";
import { commit, robotOf } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { playStore } from "../../stores/play.ts";
import { forgetRepairs, repairStore } from "../../stores/repairs.ts";
import { words } from "../../messages/index.ts";
import type { FromPlanner, PlanTask, RepairQuestion } from "../../workers/plan-messages.ts";
import { geometryToCheck, MARGIN_M } from "./checking.ts";
import { BackgroundSearch, workerPlanner, type Planner } from "./planner.ts";

const repairing = new BackgroundSearch();

/** Ways out belong to one verdict: what was found for another is forgotten, and what is looked for is given up. */
export function startRepairing(hire: () => Planner = workerPlanner): () => void {
  repairing.hire = hire;
  const follow = (): void => {
    const { verdict, stale } = playStore.getState();
    const judged = stale ? null : verdict;
    if (repairStore.getState().verdict === judged) return;
    repairing.cancel();
    forgetRepairs(judged);
  };
  follow();
  const stop = playStore.subscribe(follow);
  return () => {
    stop();
    repairing.cancel();
    forgetRepairs(null);
  };
}

/** Whether the program on screen is one whose steps can be changed: a vendor's text is not. */
export const canRepair = (): boolean => repairStore.getState().verdict !== null && question() !== null;

/** Why a bad step cannot be carried out, and what would change that; into the store when it is known. */
export function explainStep(step: string): void {
  repairStore.setState({ current: step, shown: null });
  if (repairStore.getState().explanations.has(step)) return;
  search(
    asked => ({ kind: "explain", step, ...asked }),
    { kind: "explain", step },
    message => {
      if (message.kind !== "explained" || message.explanation === null) return;
      const { explanation } = message;
      repairStore.setState(({ explanations }) => ({ explanations: new Map(explanations).set(step, explanation) }));
    },
  );
}

/** Repairs what can be repaired with the least changes, as one edit. */
export function repairProgram(): void {
  search(
    asked => ({ kind: "repair-all", ...asked }),
    { kind: "all", share: 0 },
    message => {
      if (message.kind !== "repaired") return;
      const { applied, left } = message;
      const done = commit(words.undo.repairAll, cell =>
        applied.reduce((so, { step, repair }) => repairCell(so, so.program, step, repair), cell),
      );
      if (done) notify("done", words.check.repaired(applied.length, left.length));
      else notify("info", words.check.noRepair);
    },
  );
}

/** Carries a way out into the cell, as one edit. */
export function applyRepair(step: string, repair: ProvenRepair): boolean {
  if (repairStore.getState().verdict === null) return false;
  return commit(words.undo.repair, cell => repairCell(cell, cell.program, step, repair));
}

/** Gives up what is being looked for. */
export function cancelRepairing(): void {
  repairing.cancel();
  repairStore.setState({ searching: null });
}

function search(
  task: (asked: RepairQuestion) => PlanTask,
  shown: NonNullable<ReturnType<typeof repairStore.getState>["searching"]>,
  done: (message: FromPlanner) => void,
): void {
  const asked = question();
  if (asked === null || repairStore.getState().verdict === null) return;
  repairStore.setState({ searching: shown });
  repairing.begin(task(asked), message => {
    if (message.kind === "progress") {
      if (shown.kind === "all") repairStore.setState({ searching: { kind: "all", share: message.share } });
      return;
    }
    repairStore.setState({ searching: null });
    if (message.kind === "trouble") notify("bad", message.sentence, words.collide.troubleHint);
    else done(message);
  });
}

/** The program on screen as it is judged; null where its steps cannot be changed, or there is none. */
export function question(): RepairQuestion | null {
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  return document && robot ? asQuestion(document, robot) : null;
}

function asQuestion(document: CellDocument, robot: Robot): RepairQuestion | null {
  const program = selectedProgram(document);
  if (program === undefined) return null;
  return {
    program,
    robot: robot.id,
    cell: geometryToCheck(document, robot),
    margin_m: MARGIN_M,
    parts: Object.fromEntries(
      document.frames.map(({ name }) => [
        name,
        {
          name: nameOfFrame(document, name),
          objects: objectsOfFrame(document, name),
          frames: framesWith(document, name),
        },
      ]),
    ),
    // A connected robot stands where it stands.
    movesBase: connectionStore.getState().station === null,
  };
}
