import { flangePose, manualScheduler, robotById, type JointSample, type MoveStep, type Target } from "@twincell/core";
import { expect } from "vitest";
import { createRealController, type ControllerAdapter, type AdapterOptions } from "../../driver/index.ts";
import { endedOn } from "../../testing/index.ts";
import { memoryNetwork } from "../../transport/index.ts";
import { createTwin } from "../../twin/index.ts";
import { createVirtualAbb, type VirtualAbbOptions } from "../virtual/index.ts";

export const HOST = "127.0.0.1";
export const irb120 = robotById("abb_irb120")!;
export const NOTHING = { tools: {}, frames: {} };
const ACCURACY_RAD = (0.001 * Math.PI) / 180;
/** Far enough for full speed. */
export const AROUND = irb120.home_rad.with(0, 2.4);
export const turned = (by_rad: number): number[] => Array.from(irb120.home_rad, q => q + by_rad);

/** A virtual controller and a driver of it that is being connected. */
export async function streamingBench(
  faceOf: (options: AdapterOptions) => ControllerAdapter,
  virtualOptions: Partial<VirtualAbbOptions>,
) {
  const scheduler = manualScheduler();
  const network = memoryNetwork(scheduler);
  const log: string[] = [];
  const heard: JointSample[] = [];
  const links: string[] = [];
  const started = await createVirtualAbb({
    robot: irb120,
    scheduler,
    network,
    host: HOST,
    log: line => {
      log.push(line);
    },
    ...virtualOptions,
  });
  if (started.kind === "taken") throw new Error(started.sentence);
  const { controller: virtual } = started;
  const real = createRealController({ face: faceOf({ robot: irb120, scheduler, network, host: HOST }), scheduler });
  real.onSample(sample => {
    heard.push({
      ...sample,
      q_rad: sample.q_rad.slice(),
      ...(sample.signals ? { signals: new Map(sample.signals) } : {}),
    });
    if (heard.length > 2000) heard.shift();
  });
  real.onLink(({ state, sentence }) => {
    links.push(sentence === "" ? state : `${state}: ${sentence}`);
  });
  const connecting = real.connect();
  await scheduler.elapse(0.1);
  return { scheduler, network, virtual, real, connecting, heard, log, links, carryOut: endedOn(scheduler, 0.05, 40) };
}
export type StreamingBench = Awaited<ReturnType<typeof streamingBench>>;

// What both drivers do the same way, because both guide the robot by EGM.

/** Row T-23, with the rate of EGM. */
export async function endsWhereCommanded({ real, carryOut, scheduler }: StreamingBench): Promise<void> {
  for (const by of [0.3, -0.2, 0.05]) {
    expect(await carryOut(real.moveJoints(turned(by)))).toEqual({ kind: "done" });
    turned(by).forEach((q, i) => {
      expect(Math.abs(real.jointAngle(i + 1) - q)).toBeLessThanOrEqual(ACCURACY_RAD);
    });
  }
  await scheduler.elapse(2);
  expect(real.link).toMatchObject({ rate_Hz: 250, missing: 0 });
}

/** Row T-20. @param again  what starts EGM again. */
export async function errorEndsTheMotion(
  { real, virtual, carryOut, scheduler, heard }: StreamingBench,
  again: () => void,
): Promise<void> {
  const moving = real.moveJoints(AROUND);
  await scheduler.elapse(0.3);
  virtual.pendant.protectiveStop("joint 2 met something");
  expect(await carryOut(moving)).toMatchObject({
    kind: "stopped",
    why: { sentence: `${irb120.name} does not take targets. EGM ended with an error on the controller.` },
  });
  await scheduler.elapse(1);
  expect(heard.at(-1)).toMatchObject({
    safety: "protective-stop",
    message: "EGM ended with an error on the controller.",
  });
  const rest = virtual.neutral.jointAngles();
  again();
  await scheduler.elapse(1);
  expect([...virtual.neutral.jointAngles()].every((q, i) => Math.abs(q - rest[i]!) < 1e-9)).toBe(true);
  expect(await carryOut(real.moveJoints(turned(0)))).toEqual({ kind: "done" });
}

/**
 * Rows T-24, T-25 and T-26. @param told_s  so soon the driver knows the mode; @param within_rad  how near the last
 * state is to where the pendant's jog ended.
 */
export async function followsThePendant(
  { real, virtual, carryOut, scheduler, heard }: StreamingBench,
  told_s: number,
  within_rad: number,
): Promise<void> {
  const twin = createTwin({ real, scheduler });
  await carryOut(twin.moveJoints(turned(0.2)));
  await scheduler.elapse(0.1);
  expect([...twin.jointAngles()]).toEqual([...real.jointAngles()]);
  virtual.pendant.setMode("manual");
  await scheduler.elapse(told_s);
  expect(await real.moveToZero()).toMatchObject({ kind: "refused", why: { code: "controller.manual-mode" } });
  void virtual.pendant.jog(turned(0));
  await scheduler.elapse(0.2);
  expect(heard.at(-1)).toMatchObject({ mode: "manual", moving: true });
  await scheduler.elapse(3);
  expect(Math.abs(real.jointAngle(1) - irb120.home_rad[0]!)).toBeLessThan(within_rad);
}

/** A place of the flange beside where it is. */
export function beside(at = flangePose(irb120.arm, irb120.home_rad)): (dy_m: number, dz_m: number) => Target {
  return (dy, dz) => ({
    pose: { position: [at.position[0], at.position[1] + dy, at.position[2] + dz], quaternion: at.quaternion },
    frame: "world",
    tool: "flange",
  });
}
/** A slanting line at another speed from half a second on, without leaving it. */
export async function keepsToTheLine(
  { real, carryOut, scheduler, heard }: StreamingBench,
  more: Partial<MoveStep> = {},
): Promise<void> {
  const at = flangePose(irb120.arm, real.jointAngles());
  heard.length = 0;
  const running = real.run(
    [
      {
        id: "l",
        type: "move",
        path: "lin",
        target: beside(at)(0.1, -0.1),
        speed: { mps: 0.1 },
        blend_m: 0,
        ...more,
      } as MoveStep,
    ],
    NOTHING,
  );
  await scheduler.elapse(0.5);
  real.setSpeed(30);
  expect(await carryOut(running)).toEqual({ kind: "done" });
  for (const { q_rad } of heard) {
    const [x, y, z] = flangePose(irb120.arm, q_rad).position;
    expect(Math.hypot(x - at.position[0], (y - at.position[1] + (z - at.position[2])) / Math.SQRT2)).toBeLessThan(1e-3);
  }
}

/**
 * Rows T-46, T-47 and X-41: everything cut, noticed within 100 ms; the robot stops by itself within its time-out and
 * braking time, and stays.
 */
export async function stopsWhenCutOff({ real, network, virtual, scheduler }: StreamingBench): Promise<void> {
  const moving = real.moveJoints(AROUND);
  await scheduler.elapse(0.3);
  network.weather.frozen = true;
  const from_s = scheduler.now_s();
  const clock_ms = performance.now();
  real.stop();
  real.jointAngles();
  expect(performance.now() - clock_ms).toBeLessThan(20);
  while (real.isConnected && scheduler.now_s() - from_s < 1) await scheduler.elapse(0.002);
  expect(scheduler.now_s() - from_s).toBeLessThanOrEqual(0.1);
  expect((await moving).kind).toBe("stopped");
  await scheduler.elapse(1 + virtual.brakingTime_s);
  const rest = virtual.neutral.jointAngles();
  network.weather.frozen = false;
  await scheduler.elapse(10);
  expect(real.isConnected).toBe(true);
  expect(virtual.neutral.jointAngles()).toEqual(rest);
}
