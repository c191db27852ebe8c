import { withRobots } from "../hire.ts";
import {
  freshGroupIds,
  freshStepIds,
  linkSolids,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Step,
} from "@twincell/core";
import { attachSteps, cellGeometry, type CellDocument } from "@twincell/project";
import { cellStore } from "../../stores/cell.ts";
import { flangeFromTcpOf, programOf, robotOf } from "../../stores/document.ts";
import { notify } from "../../stores/notices.ts";
import { addSteps } from "../../stores/program.ts";
import { traceStore, type TraceOptions, type TraceState } from "../../stores/trace.ts";
import { words } from "../../messages/index.ts";
import type { FromTracer } from "../../workers/trace-messages.ts";
import type { TracedPoint, TraceTask } from "./tracing.ts";

/** Joint moves towards and away from the piece. */
const APPROACH_RATIO = 0.3;
/** Points on the edge are passed, not stopped at; the corner this cuts is far inside the path tolerance. */
const PASS_M = 0.0002;

/** The edges a trace goes along. */
type Chosen = readonly Pick<TraceState["chosen"][number], "object" | "edge">[];

let worker: Worker | null = null;
let id = 0;
/** The edges that the question under way is about. */
let asked: Chosen = [];

/** Lays points along the chosen edges, away from the page, and adds them to the program as one undo step. */
export function makeTrace(): void {
  const { document } = cellStore.getState();
  const robot = robotOf(document);
  const program = programOf(document);
  const { chosen, options } = traceStore.getState();
  if (!document || !robot || !program || chosen.length === 0) return;
  const last = program.steps.findLast((step): step is MoveStep => step.type === "move" && "q" in step.target);
  const task: TraceTask = {
    chosen,
    options,
    objects: document.objects,
    robot: robot.id,
    cell: cellGeometry(document, linkSolids(robot)),
    flangeFromTcp: flangeFromTcpOf(document),
    start_rad: last && "q" in last.target ? last.target.q : robot.home_rad,
  };
  worker ??= hired();
  asked = chosen;
  traceStore.setState({ working: true });
  worker.postMessage({ id: ++id, task });
}
export function cancelTrace(): void {
  worker?.terminate();
  worker = null;
  traceStore.setState({ working: false });
}

function hired(): Worker {
  const fresh = withRobots(new Worker(new URL("../../workers/trace.worker.ts", import.meta.url), { type: "module" }));
  fresh.addEventListener("message", ({ data }: MessageEvent<FromTracer>) => {
    if (data.id !== id) return;
    traceStore.setState({ working: false });
    const { answer } = data;
    const { document } = cellStore.getState();
    const robot = robotOf(document);
    if (answer.kind === "cannot") {
      notify(
        "bad",
        answer.edge > 0 ? words.trace.cannot(answer.edge, answer.sentence) : answer.sentence,
        words.trace.cannotHint,
      );
      return;
    }
    if (!document || !robot) return;
    const { options } = traceStore.getState();
    const points = answer.edges.reduce((sum, edge) => sum + edge.length, 0);
    addTrace(answer.edges, options, robot, document.tool, asked);
    const result = { points, edges: answer.edges.length, inserted: answer.inserted, deviation_m: answer.deviation_m };
    traceStore.setState({ chosen: [], hovered: null, last: result });
    const [unreached] = answer.unreached;
    if (unreached)
      notify(
        "warn",
        words.trace.unreached(answer.unreached.length, result.edges, unreached.edge, unreached.sentence),
        words.trace.unreachedHint,
      );
    else notify("done", words.trace.made(points, result.edges, result.inserted));
  });
  fresh.addEventListener("error", event => {
    cancelTrace();
    notify("bad", event.message || words.trace.stopped);
  });
  return fresh;
}

/**
 * Home, then each edge as a group of its own, then home again. The points belong to the object of their edge and move
 * with it; the group remembers the edge, so that the checker can say how far they are off it.
 */
export function addTrace(
  edges: readonly (readonly TracedPoint[])[],
  options: TraceOptions,
  robot: Robot,
  tool: string,
  chosen: Chosen,
): void {
  let ids: readonly EdgeIds[] = [];
  addSteps(
    words.undo.trace,
    program => {
      const made = traceSteps(program, edges, options, robot, tool);
      ids = made.ids;
      return made.steps;
    },
    program => ({ ...program, groups: { ...program.groups, ...traceGroups(program, ids, options, chosen) } }),
    undefined,
    document =>
      chosen.reduce(
        (cell: CellDocument, { object }, i) => attachSteps(cell, cell.program, ids[i]?.all ?? [], object),
        document,
      ),
  );
}

/** Steps of one edge: all of them, and those that lie on it. */
interface EdgeIds {
  readonly all: readonly string[];
  readonly on: readonly string[];
}

const GROUP_PREFIX = "edge-";

function traceGroups(
  program: Program,
  edges: readonly EdgeIds[],
  options: TraceOptions,
  chosen: Chosen,
): Program["groups"] {
  const groups = freshGroupIds(program, edges.length, GROUP_PREFIX);
  return Object.fromEntries(
    edges.map(({ on }, i) => [
      groups[i]!,
      {
        name: words.trace.group(Number(groups[i]!.slice(GROUP_PREFIX.length))),
        recipe: { ...options, object: chosen[i]?.object, edge: chosen[i]?.edge, edgeSteps: on },
      },
    ]),
  );
}

function traceSteps(
  program: Program,
  edges: readonly (readonly TracedPoint[])[],
  options: TraceOptions,
  robot: Robot,
  tool: string,
): { readonly steps: readonly Step[]; readonly ids: readonly EdgeIds[] } {
  const count = edges.reduce((sum, edge) => sum + edge.length, 0);
  const homes = program.steps.length === 0 ? 2 : 1;
  const ids = freshStepIds(program, count + homes, "p");
  const angles = (q: readonly number[]): MoveStep["target"] => (tool === "flange" ? { q } : { q, tool });
  const target = (point: TracedPoint): MoveStep["target"] =>
    "q" in point ? angles(point.q) : { pose: point.worldFromTcp as Pose as Pose<"frame", "tcp">, frame: "world", tool };
  const groups = freshGroupIds(program, edges.length, GROUP_PREFIX);
  let next = 0;
  const home = (): Step => ({
    id: ids[next++]!,
    type: "move",
    name: words.trace.home,
    path: "ptp",
    target: angles(robot.home_rad),
    speed: { ratio: APPROACH_RATIO },
    blend_m: 0,
  });
  const steps: Step[] = homes === 2 ? [home()] : [];
  const made: EdgeIds[] = [];
  for (const [i, edge] of edges.entries()) {
    made.push({
      all: edge.map((_, k) => ids[next + k]!),
      on: edge.flatMap(({ role }, k) => (role === "edge" ? [ids[next + k]!] : [])),
    });
    for (const [k, point] of edge.entries()) {
      const arriving = k === 0;
      const inner = point.role === "edge" && edge[k - 1]?.role === "edge" && edge[k + 1]?.role === "edge";
      const path = arriving
        ? "ptp"
        : point.role === "edge" && edge[k - 1]?.role === "edge" && options.motion === "joint" && "q" in point
          ? "ptp"
          : "lin";
      steps.push({
        id: ids[next++]!,
        type: "move",
        group: groups[i]!,
        path,
        target: target(point),
        speed: arriving ? { ratio: APPROACH_RATIO } : { mps: options.speed_mps },
        blend_m: inner ? PASS_M : 0,
        ...(point.role === "lead-in"
          ? { name: words.trace.approach }
          : point.role === "lead-out"
            ? { name: words.trace.retreat }
            : {}),
      });
    }
  }
  return { steps: [...steps, home()], ids: made };
}
