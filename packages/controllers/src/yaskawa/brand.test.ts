import { manualScheduler } from "@twincell/core";
import { expect, test } from "vitest";
import { driverKindById } from "../brands.ts";
import { createRealController } from "../driver/index.ts";
import { memoryNetwork } from "../transport/index.ts";
import { gp8, interpret, turned } from "./testing/bench.ts";

async function opened() {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const brand = driverKindById("yaskawa")!;
  const host = "127.0.0.7";
  const started = await brand.virtual({ robot: gp8, scheduler, network, host, interpret });
  if (started.kind === "taken") throw new Error(started.sentence);
  const { virtual } = started;
  const real = createRealController({
    face: brand.face({ robot: gp8, scheduler, network, host, ports: virtual.ports }),
    scheduler,
  });
  const connecting = real.connect();
  await scheduler.elapse(0.2);
  expect(await connecting).toEqual({ kind: "done" });
  return { scheduler, network, brand, host, virtual, real };
}

test("the brand's own virtual controller is driven without being told its pulses, lines and gripper; a second one is refused the ports", async () => {
  const { scheduler, network, brand, host, virtual, real } = await opened();
  expect(virtual.ports).toEqual({ robot: 10_040, files: 10_041 });
  let gripperClosed = false;
  real.onSample(lent => {
    gripperClosed = lent.gripperClosed;
  });
  const run = real.run(
    [
      { id: "a", type: "move", path: "ptp", target: { q: turned(0.2) }, speed: { ratio: 1 }, blend_m: 0 },
      { id: "g", type: "gripper", closed: true },
      { id: "i", type: "set", signal: "in_3", to: true },
    ],
    { tools: {}, frames: {} },
  );
  await scheduler.elapse(4);
  expect(await run).toEqual({ kind: "done" });
  expect(gripperClosed).toBe(true);
  expect(real.signals?.read("in_3")).toBe(true);
  virtual.pendant.setInput("in_5", true);
  expect(Math.abs(virtual.jointAngles()[0]! - real.jointAngle(1))).toBeLessThan(1e-5);
  expect(await brand.virtual({ robot: gp8, scheduler, network, host, interpret })).toMatchObject({ kind: "taken" });
});

test("its pendant: modes, red button, gate, a stop by itself, off and on again", async () => {
  const { scheduler, virtual, real } = await opened();
  const seen: string[] = [];
  real.onSample(({ mode, safety }) => {
    if (seen.at(-1) !== `${mode} ${safety}`) seen.push(`${mode} ${safety}`);
  });
  const { pendant } = virtual;
  await scheduler.elapse(0.1);
  for (const act of [
    () => {
      pendant.setMode("manual");
    },
    () => {
      pendant.setMode("automatic");
    },
    () => {
      pendant.setMode("remote");
    },
    () => {
      pendant.setGuardOpen(true);
    },
    () => {
      pendant.setGuardOpen(false);
    },
    () => {
      pendant.protectiveStop("Joint 2 met something.");
    },
    () => {
      void real.reset();
    },
    () => {
      pendant.emergencyStop(true);
    },
    () => {
      pendant.emergencyStop(false);
      void real.reset();
    },
  ]) {
    act();
    await scheduler.elapse(1.5);
  }
  expect(seen).toEqual([
    "remote normal",
    "manual normal",
    "automatic normal",
    "remote normal",
    "remote guard-stop",
    "remote normal",
    "remote protective-stop",
    "remote emergency-stop",
    "remote normal",
    "remote emergency-stop",
    "remote normal",
  ]);
  virtual.reboot();
  await scheduler.elapse(0.5);
  expect(real.isConnected).toBe(false);
  await scheduler.elapse(12);
  expect(real.isConnected).toBe(true);
  virtual.close();
});
