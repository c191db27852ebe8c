import { linkSolids, type Robot } from "@twincell/core";
import { cellGeometry } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { collideStore, type Search } from "../../stores/collide.ts";
import { commit, programOf, robotOf } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { repairStep } from "../../stores/program.ts";
import { words } from "../../messages/index.ts";
import { solidName } from "../../messages/phrases.ts";
import type { FromPlanner, PlanTask } from "../../workers/plan-messages.ts";
import { interpolateAlong } from "../jog/joint-interpolation.ts";
import { theLive } from "../live.ts";
import { BackgroundSearch, type Planner } from "./planner.ts";

const planning = new BackgroundSearch();
/** Another planner from now on. */
export function hirePlanners(how: () => Planner): void {
  cancelSearch();
  planning.hire = how;
}

/** Gives up what is being searched for. */
export function cancelSearch(): void {
  planning.cancel();
  collideStore.setState({ searching: null });
}

function search(task: PlanTask, shown: Search, done: (message: FromPlanner) => void): void {
  collideStore.setState({ searching: shown });
  planning.begin(task, message => {
    if (message.kind === "progress") {
      collideStore.setState(({ searching }) =>
        searching === null || searching.kind === "learn" ? {} : { searching: { ...searching, share: message.share } },
      );
      return;
    }
    collideStore.setState({ searching: null });
    if (message.kind === "trouble") notify("bad", message.sentence, words.collide.troubleHint);
    else done(message);
  });
}

/** Searches for points that lead a step past what it meets, and puts them into the program as one edit. */
export function findDetour(step: string): void {
  const { document } = cellStore.getState();
  const program = programOf(document);
  const robot = robotOf(document);
  if (!document || !program || !robot) return;
  search(
    { kind: "way", program, step, robot: robot.id, cell: cellGeometry(document, linkSolids(robot)), margin_m: 0 },
    { kind: "way", step, share: 0 },
    message => {
      if (message.kind !== "way" || message.answer.kind === "cancelled") return;
      const { answer } = message;
      if (answer.kind === "none") {
        notify("bad", answer.why.sentence, answer.why.hint);
        return;
      }
      if (programOf(cellStore.getState().document) !== program) {
        notify("info", words.collide.changed, words.collide.changedHint);
        return;
      }
      if (repairStep(step, answer.repair)) notify("done", words.collide.found(answer.points));
    },
  );
}

/** Searches for a way to a posture and goes it. */
export function goAround(robot: Robot, to_rad: ArrayLike<number>, done: (arrived: boolean) => void): void {
  const { document } = cellStore.getState();
  if (!document) return;
  const from_rad = [...theLive().q_rad];
  search(
    {
      kind: "go",
      robot: robot.id,
      cell: cellGeometry(document, linkSolids(robot)),
      from_rad,
      to_rad: Array.from(to_rad),
    },
    { kind: "go", share: 0 },
    message => {
      if (message.kind !== "go") return;
      const { answer } = message;
      if (answer.kind === "found") {
        // Whoever moved the robot meanwhile wants it elsewhere.
        if (theLive().q_rad.some((q, i) => Math.abs(q - from_rad[i]!) > 1e-6)) return;
        notify("info", words.collide.goes[answer.how]);
        interpolateAlong(robot, answer.way, done);
      } else if (answer.kind === "blocked")
        notify(
          "bad",
          words.collide.blocked(
            answer.end,
            solidName(answer.contact.a, document.objects),
            solidName(answer.contact.b, document.objects),
          ),
          words.collide.hint,
        );
      else if (answer.kind !== "cancelled") notify("bad", words.collide.noWay, words.collide.hint);
    },
  );
}

/** Learns the matrix of the robot's pairs anew and keeps it in the cell. */
export function learnMatrix(): void {
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  if (!document || !robot) return;
  const { tool } = document;
  search(
    { kind: "learn", robot: robot.id, cell: cellGeometry(document, linkSolids(robot)) },
    { kind: "learn" },
    message => {
      if (message.kind !== "learnt" || robotOf(cellStore.getState().document)?.id !== robot.id) return;
      commit(words.undo.pairs, before => ({ ...before, pairs: { robot: robot.id, tool, ...message.matrix } }));
    },
  );
}
