import { describe, expect, test } from "vitest";
import { PARALLEL_GRIPPER, robotById } from "@twincell/core";
import {
  createWorld,
  MATRIX_SHAPES,
  pickAndPlace,
  pickAndPlaceProgram,
  pickMatrix,
  pickScene,
  PhysicsRun,
  type MatrixShape,
  type PhysicsEvent,
  type PickCase,
} from "../index.ts";
import { engine } from "../testing/cells.ts";

const robot = robotById("ur10e")!;
const moved = { robot, control: { kind: "moved" } } as const;
const driven = { robot, control: { kind: "computed-torque", bandwidth_rad_s: 60 } } as const;
const a = (more: Partial<PickCase> = {}): PickCase => ({ shape: "box", width_m: 0.05, mass_kg: 1, ...more });

describe("X-34 X-36 pick and place over shapes, sizes and weights", () => {
  test.each(Object.keys(MATRIX_SHAPES) as MatrixShape[])(
    "%s: 30 and 80 mm, 0.1 and 5 kg, each fetched, lifted by 150 mm and put down within 10 mm",
    shape => {
      const table = pickMatrix([shape], [0.03, 0.08], [0.1, 5]).map(which => pickAndPlace(engine, which, moved));
      expect(table.map(({ verdict }) => verdict)).toEqual(["placed", "placed", "placed", "placed"]);
      for (const { highest_m } of table) expect(Math.abs(highest_m - 0.15)).toBeLessThan(0.005);
    },
  );
  test("X-34 what cannot be held is not held: a weak gripper, an oily one, a part wider than it opens", () => {
    const verdict = (which: Partial<PickCase>, gripper = PARALLEL_GRIPPER): string =>
      pickAndPlace(engine, a({ mass_kg: 5, ...which }), { ...moved, gripper }).verdict;
    expect(verdict({}, { ...PARALLEL_GRIPPER, force_N: 20 })).toBe("dropped");
    expect(verdict({}, { ...PARALLEL_GRIPPER, friction: 0.1 })).toBe("dropped");
    const wide = pickAndPlace(engine, a({ width_m: 0.13 }), moved);
    expect(wide.verdict).toBe("refused");
    expect(wide.sentence).toMatch(/^The fingers press on “box of 130 mm” with \d\.\d kN\.$/);
  });
  test.each(["kuka_kr6r900sixx", "staubli_rx90l"])("the same with another arm: %s", id => {
    expect(
      pickAndPlace(engine, a(), { ...moved, robot: robotById(id)!, from_m: [0.5, -0.2], to_m: [0.5, 0.2] }).verdict,
    ).toBe("placed");
  });
});

describe("the UR10e with its own torques", () => {
  test("X-07 9.9 kg are lifted and put down within 10 mm; 10.1 kg are refused with words, before they leave the table", () => {
    const light = pickAndPlace(engine, a({ mass_kg: 9.9 }), { ...driven, ratio: 0.3 });
    expect([light.verdict, light.sentence]).toEqual(["placed", ""]);
    expect(light.highest_m).toBeGreaterThan(0.14);
    const heavy = pickAndPlace(engine, a({ mass_kg: 10.1 }), { ...driven, ratio: 0.3 });
    expect(heavy).toMatchObject({
      verdict: "refused",
      sentence:
        "Universal Robots UR10e carries at most 10 kg; “box of 50 mm” (10.1 kg) with the gripper (0.08 kg) weighs 10.18 kg.",
    });
    expect(heavy.highest_m).toBeLessThan(0.001);
  });
  test("drives that know nothing of coupling place less exactly than computed torque", () => {
    const drives = pickAndPlace(engine, a({ mass_kg: 5 }), {
      robot,
      control: { kind: "drives", bandwidth_rad_s: 30 },
      ratio: 0.4,
    });
    const computed = pickAndPlace(engine, a({ mass_kg: 5 }), { ...driven, ratio: 0.4 });
    expect(computed.off_m).toBeLessThan(0.002);
    expect(drives.off_m).toBeGreaterThan(2 * computed.off_m);
  });
});

function eventsOf(
  which: PickCase,
  most_s = 20,
): { readonly events: readonly PhysicsEvent[]; readonly run: PhysicsRun; readonly close: () => void } {
  const { scene, grip_m } = pickScene(which, moved);
  const answer = createWorld(engine, scene);
  const world = answer.kind === "ready" ? answer.world : expect.fail();
  const events: PhysicsEvent[] = [];
  const run = new PhysicsRun(
    world,
    pickAndPlaceProgram(robot, PARALLEL_GRIPPER, [0.65, -0.2, grip_m], [0.65, 0.25, grip_m], 0.5),
    { onEvent: event => events.push(event) },
  );
  run.runFor(most_s);
  return {
    events,
    run,
    close: () => {
      world.close();
    },
  };
}

test("M-21 on a piece that is fetched and put down the mark goes a, b, c, b, a; X-55 it is weighed while it stands on the table", () => {
  const { events, run, close } = eventsOf(a({ mass_kg: 2.5 }));
  expect(run.state.kind).toBe("done");
  expect(["free", ...events.flatMap(event => (event.kind === "grasp" ? [event.signal] : []))]).toEqual([
    "free",
    "ready",
    "held",
    "ready",
    "free",
  ]);
  const weighed = events.find(event => event.kind === "weighed")!;
  expect(weighed.sentence).toBe("“box of 50 mm” weighs 2.5 kg.");
  expect(weighed.at_s).toBeLessThan(2.6);
  close();
});

test("M-19 fingers that close on a table hold nothing, and the table stays", () => {
  const { scene } = pickScene(a(), moved);
  const post = { ...scene.objects[1]!, role: "fixture" as const, name: "Post" };
  const answer = createWorld(engine, { ...scene, objects: [scene.objects[0]!, post] });
  const world = answer.kind === "ready" ? answer.world : expect.fail();
  const events: PhysicsEvent[] = [];
  const run = new PhysicsRun(
    world,
    pickAndPlaceProgram(robot, PARALLEL_GRIPPER, [0.65, -0.2, 0.125], [0.65, 0.25, 0.125], 0.5),
    { onEvent: event => events.push(event) },
  );
  expect(run.runFor(20).kind).toBe("done");
  expect(events.map(({ kind }) => kind)).toEqual(["done"]);
  world.close();
});

test("a step that cannot be carried out pauses the run with its own words", () => {
  const { scene } = pickScene(a(), moved);
  const answer = createWorld(engine, scene);
  const world = answer.kind === "ready" ? answer.world : expect.fail();
  const run = new PhysicsRun(world, pickAndPlaceProgram(robot, PARALLEL_GRIPPER, [3, 0, 0.2], [0.65, 0.25, 0.2], 0.5));
  const { kind, why } = run.runFor(5);
  expect([kind, why?.sentence]).toEqual(["paused", expect.stringContaining("from the shoulder")]);
  world.close();
});
