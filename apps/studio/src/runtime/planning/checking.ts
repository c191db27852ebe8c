import { withRobots } from "../hire.ts";
import { linkSolids, OtherArm, samplePlan, type CellGeometry, type CellObject, type Robot } from "@twincell/core";
import { cellGeometry, type CellDocument } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { programOf, robotOf } from "../../stores/document.ts";
import { playStore } from "../../stores/play.ts";
import { textStore } from "../../stores/text.ts";
import { stationStore } from "../../stores/stations.ts";
import type { FromChecker, ToChecker } from "../../workers/check-messages.ts";
import { loadReel } from "../history/playhead.ts";
import { stationLive } from "../robot/stations.ts";

/** Who judges: a worker of the page, or a double in a test. */
export interface Checker {
  post(message: ToChecker): void;
  listen(hear: (message: FromChecker) => void): void;
  close(): void;
}
export function workerChecker(): Checker {
  const worker = withRobots(new Worker(new URL("../../workers/check.worker.ts", import.meta.url), { type: "module" }));
  return {
    post: message => worker.postMessage(message),
    listen: hear => {
      worker.addEventListener("message", ({ data }: MessageEvent<FromChecker>) => hear(data));
      worker.addEventListener("error", event =>
        hear({ kind: "trouble", id: -1, sentence: event.message || "The check stopped without saying why." }),
      );
    },
    close: () => worker.terminate(),
  };
}

/** Typing and dragging settle first. */
const WAIT_MS = 180;
/** Distance kept from everything [m]: contact is what is refused, nearness is shown. */
export const MARGIN_M = 0;

/**
 * Judges the program after every edit, away from the page. The newest edit wins; what is under way is given up for it.
 */
export interface Checking {
  now(): void;
  cancel(): void;
  stop(): void;
}
export function startChecking(hire: () => Checker = workerChecker): Checking {
  let checker: Checker | null = null;
  let id = 0;
  let busy = false;
  /** Something changed that no check was asked for yet. */
  let due = false;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let geometry: CellGeometry | null = null;
  let solids: CellDocument | null = null;
  let sent: CellGeometry | null = null;

  const fire = (): void => {
    checker?.close();
    checker = null;
    sent = null;
    busy = false;
  };
  const hear = (message: FromChecker): void => {
    if (message.id !== id && message.id !== -1) return;
    switch (message.kind) {
      case "progress":
        playStore.setState({ checking: message.share });
        return;
      case "trouble":
        fire();
        loadReel(null);
        playStore.setState({
          checking: null,
          stale: due,
          trouble: message.sentence,
          plan: null,
          verdict: null,
          path: [],
          carried: [],
        });
        return;
      case "checked": {
        busy = false;
        const { plan, verdict, path, carried } = message;
        playStore.setState({ checking: null, stale: due, trouble: null, plan, verdict, path, carried });
        loadReel(
          plan.segments.length > 0
            ? {
                duration_s: plan.duration_s,
                sampleAt: (t_s, out) => {
                  samplePlan(plan, t_s, out);
                },
              }
            : null,
        );
      }
    }
  };
  const ask = (): void => {
    clearTimeout(timer);
    due = false;
    const { document } = cellStore.getState();
    const program = programOf(document);
    const robot = robotOf(document);
    if (!document || !robot) return;
    if (!program) {
      if (textStore.getState().reading) return;
      // A text that is not understood, or not executed yet, does nothing.
      if (busy) fire();
      loadReel(null);
      playStore.setState({
        checking: null,
        stale: false,
        trouble: null,
        plan: null,
        verdict: null,
        path: [],
        carried: [],
      });
      return;
    }
    if (busy) fire();
    id++;
    if (program.steps.length === 0) {
      loadReel(null);
      playStore.setState({
        checking: null,
        stale: false,
        trouble: null,
        plan: null,
        verdict: null,
        path: [],
        carried: [],
      });
      return;
    }
    if (!checker) {
      checker = hire();
      checker.listen(hear);
    }
    const { withOthers } = playStore.getState();
    if (!geometry || !solids || withOthers || solidsDiffer(document, solids))
      geometry = geometryToCheck(document, robot);
    // Where the others stood is not where they stand the next time.
    solids = withOthers ? null : document;
    busy = true;
    playStore.setState({ checking: 0, stale: true, trouble: null });
    checker.post({
      id,
      program,
      robot: robot.id,
      margin_m: MARGIN_M,
      ...(sent === geometry ? {} : { cell: geometry }),
    });
    sent = geometry;
  };
  const later = (): void => {
    clearTimeout(timer);
    due = true;
    playStore.setState({ stale: true });
    timer = setTimeout(ask, WAIT_MS);
  };

  let judged = cellStore.getState().document;
  let { executions } = cellStore.getState();
  const stop = cellStore.subscribe(({ document, executions: now }) => {
    // A vendor's text says what it does a while after it changed.
    if (now !== executions) {
      executions = now;
      later();
    }
    if (document === judged) return;
    // A plan of another robot has other joints.
    if (document?.robot.id !== judged?.robot.id) {
      loadReel(null);
      playStore.setState({ plan: null, verdict: null, path: [], carried: [] });
    }
    const matters = !document || !judged || programOf(document) !== programOf(judged) || solidsDiffer(document, judged);
    judged = document;
    if (matters) later();
  });
  if (judged) later();
  return {
    now: ask,
    cancel: () => {
      clearTimeout(timer);
      if (busy) {
        fire();
        playStore.setState({ checking: null });
      }
    },
    stop: () => {
      stop();
      clearTimeout(timer);
      fire();
    },
  };
}

/** The solids that a program of the cell is judged with. */
export function geometryToCheck(document: CellDocument, robot: Robot): CellGeometry {
  const geometry = cellGeometry(document, linkSolids(robot));
  const others = playStore.getState().withOthers ? otherRobots() : [];
  return others.length === 0 ? geometry : { ...geometry, objects: [...geometry.objects, ...others] };
}

/** The robots of the other controllers as they stand now. */
const otherRobots = (): CellObject[] =>
  stationStore.getState().stations.flatMap(({ id, name, stand }) => {
    const live = stationLive(id);
    return live ? new OtherArm(id, name, live.robot, linkSolids(live.robot), stand, live.q_rad).objects : [];
  });

const solidsDiffer = (a: CellDocument, b: CellDocument): boolean =>
  a.objects !== b.objects ||
  a.tools !== b.tools ||
  a.tool !== b.tool ||
  a.robot !== b.robot ||
  a.allowedPairs !== b.allowedPairs ||
  a.pairs !== b.pairs ||
  a.errors !== b.errors;
