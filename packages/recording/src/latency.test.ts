import { expect, test } from "vitest";
import { latencyMeter } from "./index.ts";

test("X-48 a latency is said once a second: median, 99th percentile and worst of what came", () => {
  const meter = latencyMeter("sample to picture", "from-robot");
  expect(meter.due(10)).toBeNull();
  for (let i = 1; i <= 100; i++) meter.add(i / 10);
  expect(meter.due(10.9)).toBeNull();
  expect(meter.due(11)).toEqual({
    stage: "sample to picture",
    direction: "from-robot",
    samples: 100,
    median_ms: 5.1,
    p99_ms: 10,
    worst_ms: 10,
  });
  expect(meter.due(12.5)).toBeNull();
  for (let i = 0; i < 5000; i++) meter.add(1);
  meter.add(99);
  expect(meter.due(13.5)).toMatchObject({ samples: 5001, median_ms: 1, worst_ms: 99 });
});
