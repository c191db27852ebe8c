import { expect, test } from "vitest";
import { FrameMeter } from "./frame-meter.ts";

test("script and draw time are summed per frame and kept apart", () => {
  const meter = new FrameMeter();
  for (let i = 1; i <= 100; i++) {
    meter.addScript(i / 2);
    meter.addScript(i / 2);
    meter.addDraw(7);
    meter.endFrame();
  }
  const { frames, script, draw } = meter.summary();
  expect(frames).toBe(100);
  expect(script).toEqual({ median: 51, p95: 96, worst: 100 });
  expect(draw).toEqual({ median: 7, p95: 7, worst: 7 });
});

test("only the last 1024 frames count", () => {
  const meter = new FrameMeter();
  meter.addScript(500);
  meter.endFrame();
  for (let i = 0; i < 1024; i++) {
    meter.addScript(1);
    meter.endFrame();
  }
  expect(meter.summary().script.worst).toBe(1);
});
