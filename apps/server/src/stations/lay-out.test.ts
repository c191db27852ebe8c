import { prepareJob } from "@twincell/controllers";
import { emptyProgram, robotById, samplePlan, type MoveStep, type Program } from "@twincell/core";
import { urScript } from "@twincell/languages";
import { afterEach, expect, test } from "vitest";
import { prepareJobInWorker } from "./lay-out.ts";

const robot = robotById("ur10e")!;
const start_rad = Float64Array.from(robot.home_rad);
const move = (id: string, by_rad: number): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  target: { q: robot.home_rad.map((q, i) => (i === 0 ? q + by_rad : q)) },
  speed: { ratio: 0.3 },
  blend_m: 0,
});
const program = (moves: number): Program => ({
  ...emptyProgram(robot.id, "To and fro"),
  steps: Array.from({ length: moves }, (_, i) => move(`s${i + 1}`, i % 2 === 0 ? 0.4 : -0.2)),
});

const open: { close(): void }[] = [];
afterEach(() => {
  for (const each of open.splice(0)) each.close();
});
function elsewhere(): ReturnType<typeof prepareJobInWorker> {
  const made = prepareJobInWorker();
  open.push(made);
  return made;
}

test("a program comes back from the other thread as it would have been laid out here", async () => {
  const question = { program: program(6), robot, start_rad, dialect: urScript };
  const there = await elsewhere().layOut(question);
  const here = prepareJob(question);
  expect({ ...there, plan: null }).toEqual({ ...here, plan: null });
  expect(there.files?.[0]?.text).toContain("movej");
  const a = new Float64Array(6);
  const b = new Float64Array(6);
  for (let t = 0; t < here.plan!.duration_s; t += 0.05) {
    samplePlan(there.plan!, t, a);
    samplePlan(here.plan!, t, b);
    expect(a).toEqual(b);
  }
});

test("X-41 while a long program is laid out this thread goes on: no link waits for it", async () => {
  const { layOut: lay } = elsewhere();
  let turns = 0;
  let over = false;
  await lay({ program: program(1), robot, start_rad });
  const turn = (): void => {
    turns++;
    if (!over) setImmediate(turn);
  };
  turn();
  const { findings, plan } = await lay({ program: program(400), robot, start_rad });
  over = true;
  expect([plan === null, findings.length]).toEqual([false, 0]);
  expect(turns).toBeGreaterThan(1000);
});

test("what cannot be planned is refused with its sentence; a thread that ends leaves nobody waiting, and there is another one", async () => {
  const made = elsewhere();
  expect(
    (await made.layOut({ program: program(1), robot: { ...robot, id: "nobody" }, start_rad })).unwritten,
  ).toMatchObject({
    code: "station.lay-out",
    sentence: "The program could not be planned: There is no robot “nobody” in the library.",
  });
  const waiting = made.layOut({ program: program(400), robot, start_rad });
  made.close();
  expect((await waiting).unwritten?.sentence).toBe("The program could not be planned: the server is closing.");
  expect((await made.layOut({ program: program(2), robot, start_rad })).plan?.segments.length).toBeGreaterThan(1);
});
