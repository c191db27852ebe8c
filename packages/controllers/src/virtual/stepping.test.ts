import { flangePose, manualScheduler, robotById, type MoveStep } from "@twincell/core";
import { expect, test } from "vitest";
import { createVirtualController } from "./controller.ts";

const robot = robotById("staubli_rx90l")!;
const down = { quaternion: [0, 1, 0, 0] as [number, number, number, number] };
const lin = (id: string, x: number, y: number, z: number, path: "ptp" | "lin" = "lin"): MoveStep => ({
  id,
  type: "move",
  path,
  target: { pose: { position: [x, y, z], ...down }, frame: "world", tool: "flange" },
  speed: { mps: 0.2 },
  blend_m: 0,
});

test("a straight move keeps the flange on its line, counted from where the robot stands", async () => {
  const scheduler = manualScheduler();
  const worldFromBase = {
    position: [0, 0, 0.75] as [number, number, number],
    quaternion: [0, 0, 0, 1] as [number, number, number, number],
  };
  const controller = createVirtualController({ robot, scheduler, worldFromBase });
  const seen: number[][] = [];
  controller.onSample(({ q_rad, step }) => {
    if (step === "b") seen.push([...flangePose(robot.arm, q_rad).position]);
  });
  const outcome = controller.run([lin("a", 0.6, -0.2, 0.9, "ptp"), lin("b", 0.6, 0.2, 0.9)], { tools: {}, frames: {} });
  await scheduler.elapse(20);
  expect(await outcome).toEqual({ kind: "done" });
  expect(seen.length).toBeGreaterThan(400);
  for (const [x, , z] of seen) {
    expect(x).toBeCloseTo(0.6, 5);
    expect(z).toBeCloseTo(0.15, 5);
  }
  expect(flangePose(robot.arm, controller.jointAngles()).position[1]).toBeCloseTo(0.2, 9);
});

test("a step that cannot be reached ends the run with its reason", async () => {
  const scheduler = manualScheduler();
  const controller = createVirtualController({ robot, scheduler });
  const outcome = controller.run([lin("a", 0.6, 0, 0.5, "ptp"), lin("far", 2.6, 0, 0.5)], { tools: {}, frames: {} });
  await scheduler.elapse(10);
  const ended = await outcome;
  expect(ended.kind).toBe("stopped");
  expect(ended.kind === "stopped" && ended.why.sentence).toMatch(/\d/);
});
