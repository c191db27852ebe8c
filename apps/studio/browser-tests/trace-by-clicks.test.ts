import { readFileSync } from "node:fs";
import {
  compose,
  emptyProgram,
  flangePose,
  identity,
  planProgram,
  robotById,
  rotate,
  samplePlan,
  type MoveStep,
  type Pose,
  type Step,
  type Vector3,
} from "@twincell/core";
import { vPlus } from "@twincell/languages";
import { edgeTraceCell } from "@twincell/project";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

const robot = robotById("staubli_rx90l")!;
const cell = edgeTraceCell();
const worldFromBase = cell.robot.worldFromBase;

/** The carton's four top edges, from its own place and size: the witness that knows nothing of tracing. */
const carton = cell.objects.find(object => object.id === "carton")!;
const [cx, cy, cz] = carton.worldFromObject.position;
const [sx, sy, sz] = carton.shape.kind === "box" ? carton.shape.size_m : [0, 0, 0];
const corner = (x: number, y: number): Vector3 => [cx + (x * sx) / 2, cy + (y * sy) / 2, cz + sz / 2];
const EDGES = [
  { name: "far", from: corner(1, -1), to: corner(1, 1), outward: [1, 0, 0] },
  { name: "left", from: corner(1, 1), to: corner(-1, 1), outward: [0, 1, 0] },
  { name: "near", from: corner(-1, 1), to: corner(-1, -1), outward: [-1, 0, 0] },
  { name: "right", from: corner(-1, -1), to: corner(1, -1), outward: [0, -1, 0] },
] as const;

/** What the trace panel promises between taught points. */
const TOLERANCE_M = 0.0005;

function toEdge(point: Vector3, { from, to }: (typeof EDGES)[number]): number {
  const along = to.map((value, i) => value - from[i]!);
  const length2 = along.reduce((sum, value) => sum + value * value, 0);
  const part = Math.min(
    1,
    Math.max(0, along.reduce((sum, value, i) => sum + value * (point[i]! - from[i]!), 0) / length2),
  );
  return Math.hypot(...point.map((value, i) => value - from[i]! - part * along[i]!));
}
/** Angle between the tool and the wanted one [°]: 45° down and inwards, square to the edge. */
function off45(tcp: Pose, edge: (typeof EDGES)[number]): number {
  const axis = rotate(tcp.quaternion, [0, 0, 1]);
  const wanted = [-edge.outward[0] * Math.SQRT1_2, -edge.outward[1] * Math.SQRT1_2, -Math.SQRT1_2];
  return (
    (Math.acos(
      Math.min(
        1,
        axis.reduce((sum, value, i) => sum + value * wanted[i]!, 0),
      ),
    ) *
      180) /
    Math.PI
  );
}

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const clickAt = async (page: Page, point: Vector3): Promise<void> => {
  const at = await page.evaluate(where => window.twincellScene!.project(where), point);
  expect(at.visible, `point ${point.join(", ")} is in view`).toBe(true);
  await page.mouse.move(at.x - 3, at.y - 2);
  await page.mouse.move(at.x, at.y);
  await page.waitForFunction(() => window.twincell.stores.traceStore.getState().hovered !== null);
  await page.mouse.click(at.x, at.y);
};

test("N-53 the four top edges of the carton, at 45°, by clicks alone; the exported V+ text keeps to them", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.getByRole("button", { name: /^Trace/ }).click();
  for (const [i, { from, to }] of EDGES.entries()) {
    // A third along: neither a corner nor hidden behind the picture of the close camera.
    await clickAt(page, [0, 1, 2].map(k => from[k]! + (to[k]! - from[k]!) / 3) as Vector3);
    await page.waitForFunction(count => window.twincell.stores.traceStore.getState().chosen.length === count, i + 1);
  }
  await page.screenshot({ path: picture("trace-chosen-edges") });
  await page.getByRole("button", { name: "Make points" }).click();
  await page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict !== null, null, {
    timeout: 60_000,
  });
  expect(
    await page.evaluate(() =>
      window.twincell.stores.playStore.getState().verdict!.steps.filter(step => step.verdict === "bad"),
    ),
  ).toEqual([]);
  await page.screenshot({ path: picture("trace-made-points") });

  await page.getByRole("button", { name: "Export V+" }).click();
  const waiting = [0, 1, 2].map(() => page.waitForEvent("download"));
  await page.getByRole("button", { name: "Single files" }).click();
  const files = new Map(
    await Promise.all(
      waiting.map(async (download, i) => {
        await waiting[i];
        const file = await download;
        return [file.suggestedFilename(), await file.path()] as const;
      }),
    ),
  );
  await page.screenshot({ path: picture("trace-export") });
  expect(problems).toEqual([]);

  const name = [...files.keys()].find(each => each.endsWith(".v2"))!;
  judge(readFileSync(files.get(name)!, "utf8"));
}, 180_000);

/** Executes the text and looks where the tool point goes. */
function judge(text: string): void {
  const interpreted = vPlus.interpret(text, robot, worldFromBase);
  if (interpreted.kind !== "ready") throw new Error(interpreted.faults[0]?.sentence);
  const steps: Step[] = [];
  const run = interpreted.run();
  for (let next = run.next(); !next.done; next = run.next())
    if (next.value.step) steps.push({ ...next.value.step, id: `s${steps.length}` });
  const { tools, frames } = interpreted.context;
  const toolOf = new Map(
    steps.map(step => [step.id, step.type === "move" ? tools[step.target.tool ?? ""] : undefined]),
  );
  const answer = planProgram({ ...emptyProgram(robot.id), tools, frames, steps }, robot, { worldFromBase });
  if (answer.kind !== "planned") throw new Error(answer.stuck.sentence);

  const q = new Float64Array(6);
  const tcpAt = (t_s: number): Pose => {
    const at = samplePlan(answer.plan, t_s, q);
    const tool = toolOf.get(answer.plan.segments[at]!.step) ?? identity<"flange", "tcp">();
    return compose(compose(worldFromBase, flangePose(robot.arm, q)), tool) as Pose;
  };
  const ends = new Map(answer.plan.segments.map(segment => [segment.step, segment.start_s + segment.duration_s]));
  const moves = steps.filter((step): step is MoveStep => step.type === "move");
  for (const edge of EDGES) {
    // The longest stretch of taught points on this edge with the tool as this edge wants it.
    const on = moves.map(move => {
      const tcp = tcpAt(ends.get(move.id)!);
      return toEdge(tcp.position, edge) < 0.001 && off45(tcp, edge) < 5;
    });
    const first = on.indexOf(true);
    const last = on.lastIndexOf(true);
    expect(last - first, `points on the ${edge.name} edge`).toBeGreaterThanOrEqual(1);
    let worst_m = 0;
    let worst_deg = 0;
    let between_m = 0;
    let between_deg = 0;
    for (let i = first; i <= last; i++) {
      const end_s = ends.get(moves[i]!.id)!;
      const tcp = tcpAt(end_s);
      worst_m = Math.max(worst_m, toEdge(tcp.position, edge));
      worst_deg = Math.max(worst_deg, off45(tcp, edge));
      if (i === first) continue;
      const from_s = ends.get(moves[i - 1]!.id)!;
      for (let k = 1; k < 40; k++) {
        const way = tcpAt(from_s + ((end_s - from_s) * k) / 40);
        between_m = Math.max(between_m, toEdge(way.position, edge));
        between_deg = Math.max(between_deg, off45(way, edge));
      }
    }
    const span = Math.hypot(
      ...tcpAt(ends.get(moves[first]!.id)!).position.map(
        (value, k) => value - tcpAt(ends.get(moves[last]!.id)!).position[k]!,
      ),
    );
    expect(span, `length of the ${edge.name} edge`).toBeCloseTo(
      Math.hypot(...edge.to.map((value, k) => value - edge.from[k]!)),
      4,
    );
    expect(worst_m, `${edge.name} edge at taught points [m]`).toBeLessThan(0.00001);
    expect(worst_deg, `${edge.name} edge, tool at taught points [°]`).toBeLessThan(0.1);
    expect(between_m, `${edge.name} edge between taught points [m]`).toBeLessThan(TOLERANCE_M);
    expect(between_deg, `${edge.name} edge, tool between taught points [°]`).toBeLessThan(0.1);
  }
}
