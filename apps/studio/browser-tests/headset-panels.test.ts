import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { robotById, type JointSample } from "@twincell/core";
import { createRunRecorder, memorySink } from "@twincell/recording";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { Person } from "./support/headset.ts";
import { CAMERA_FLAGS, drawn, picture, Studio } from "./support/studio.ts";

const robot = robotById("staubli_rx90l")!;
const HZ = 100;
const LONG_S = 20;
const ALARM_S = 12.5;
const folder = mkdtempSync(join(tmpdir(), "twincell-past-"));
const run = join(folder, "past.mcap");
/** What was logged at the k-th sample. */
const angles = (k: number): number[] => robot.home_rad.map((home, j) => home + 0.4 * Math.sin(0.3 * (k / HZ) + j));

declare global {
  interface Window {
    readonly cable: MediaStream;
  }
}

let studio: Studio;
beforeAll(async () => {
  const sink = memorySink();
  const recorder = createRunRecorder(sink, {
    robot,
    startedAt_ns: 1_795_219_200_000_000_000n,
    program: "Carton edge",
    cell: "Line 3",
  });
  for (let k = 0; k < LONG_S * HZ; k++) {
    const alarm = k / HZ >= ALARM_S && k / HZ < ALARM_S + 1;
    recorder.record({
      sequence: k,
      time_s: k / HZ,
      q_rad: Float64Array.from(angles(k)),
      moving: true,
      mode: "automatic",
      safety: alarm ? "protective-stop" : "normal",
      override: 1,
      gripperClosed: false,
      step: "edge",
      message: alarm ? "The tool touched the carton." : "",
      signals: new Map(),
    } satisfies JointSample);
  }
  recorder.finish();
  writeFileSync(run, sink.bytes());
  studio = await Studio.start(CAMERA_FLAGS);
});
afterAll(async () => {
  await studio.stop();
  rmSync(folder, { recursive: true });
});

/** Looks ahead and a little down and to the side, in degrees. */
async function look(page: Page, side_deg: number): Promise<void> {
  await page.evaluate(deg => {
    const half = (deg * Math.PI) / 360;
    window.xrDevice.quaternion.set(0, Math.sin(half), 0, Math.cos(half));
  }, side_deg);
}
/** Share of the screen that is bright green, the colour of the browser's made-up camera. */
async function green(page: Page): Promise<number> {
  const shot = (await page.screenshot()).toString("base64");
  return page.evaluate(async data => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d")!;
    context.drawImage(bitmap, 0, 0);
    const pixels = context.getImageData(0, 0, bitmap.width, bitmap.height).data;
    let count = 0;
    for (let i = 0; i < pixels.length; i += 4)
      if (pixels[i + 1]! > 100 && pixels[i]! < 90 && pixels[i + 2]! < 60) count++;
    return count / (bitmap.width * bitmap.height);
  }, shot);
}

test("X-40 in the headset the picture hangs beside the twin; it goes grey when it stands still, and can be put elsewhere", async () => {
  // The cable of the made-up camera is within reach.
  const script =
    "const open = navigator.mediaDevices.getUserMedia.bind(navigator.mediaDevices); navigator.mediaDevices.getUserMedia = async wanted => (window.cable = await open(wanted));";
  const { page, context, problems } = await studio.open({ headset: true, width: 960, height: 480, script });
  await context.grantPermissions(["camera"]);
  await drawn(page);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    window.twincell.run("view.cameras");
  });
  await page.getByRole("region", { name: "This computer's camera" }).getByRole("button").first().click();
  await page.waitForFunction(
    () => document.querySelector(".video-picture")?.getAttribute("data-state") === "fresh",
    null,
    { timeout: 30_000 },
  );
  const person = new Person(page);
  await person.enter(640, 320);
  await look(page, -35);
  await page.waitForFunction(
    () => window.twincellScene!.scene.getObjectByName("camera-picture-0")?.visible === true,
    null,
    { timeout: 30_000 },
  );
  await person.frames(4);
  await expect.poll(() => green(page), { timeout: 30_000 }).toBeGreaterThan(0.02);
  await page.screenshot({ path: picture("headset-camera") });

  await person.press("right", "camera-hold-0");
  expect(await page.evaluate(() => window.twincell.stores.videoStore.getState().heldBy)).not.toBeNull();
  await person.press("right", "camera-hold-0");
  expect(await page.evaluate(() => window.twincell.stores.videoStore.getState().heldBy)).toBeNull();

  // Taken by its bar with the ray and carried along.
  const at = () =>
    page.evaluate(() => {
      const mesh = window.twincellScene!.scene.getObjectByName("camera-picture-0")!;
      mesh.updateWorldMatrix(true, false);
      const { elements: e } = mesh.matrixWorld;
      return [e[12]!, e[13]!, e[14]!];
    });
  const before = await at();
  const tcp = await person.tcp();
  const bar = await person.key("camera-panel-0-bar");
  await person.pointAt("right", bar);
  await person.trigger("right", 1);
  await person.shift("right", [0, 0.15, 0]);
  await person.frames(3);
  await person.trigger("right", 0);
  const after = await at();
  expect(after[1]! - before[1]!).toBeGreaterThan(0.1);
  expect(await person.tcp(), "the ray on the panel leaves the tool alone").toEqual(tcp);

  // The camera's cable is pulled: what stood still is said and grey.
  await page.evaluate(() => {
    for (const track of window.cable.getTracks()) track.stop();
  });
  await expect
    .poll(
      () =>
        page.evaluate(
          () =>
            (
              window.twincellScene!.scene.getObjectByName("camera-picture-0") as unknown as {
                material: { color: { r: number } };
              }
            ).material.color.r,
        ),
      { timeout: 20_000 },
    )
    .toBeLessThan(0.5);
  await page.screenshot({ path: picture("headset-camera-still") });
  await person.open("history");
  await person.press("right", "camera");
  await page.waitForFunction(() => window.twincellScene!.scene.getObjectByName("camera-picture-0") === undefined);
  expect(problems).toEqual([]);
  await context.close();
});

test("T-54 in the headset: travel back with ray, stick and keys; the robot stands as it was logged, to 1e-6 rad; and back to now", async () => {
  const { page, context, problems } = await studio.open({ headset: true, width: 960, height: 480 });
  await drawn(page);
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ coachDone: true, mode: "history" });
  });
  await page.locator("[data-recording-input]").setInputFiles(run);
  await page.waitForFunction(() => window.twincell.stores.historyStore.getState().duration_s > 0, null, {
    timeout: 60_000,
    polling: 100,
  });
  const now = [0.1, -1.2, 1.9, 0.2, 0.5, -0.3];
  await page.evaluate(q => {
    window.twincell.stores.viewStore.setState({ mode: "run" });
    window.twincell.live.showJoints(q);
  }, now);
  const person = new Person(page);
  await person.enter(640, 320);
  await person.open("history");
  await person.press("right", "history");
  await page.waitForFunction(() => window.twincellScene!.scene.getObjectByName("past-line") !== undefined);
  await look(page, 35);
  await person.frames(4);
  await page.screenshot({ path: picture("headset-past") });

  /** How far the robot that is seen stands from the log, at the moment the time line says [rad]. */
  const standsOff = (): Promise<{ readonly t_s: number; readonly off_rad: number }> =>
    page
      .evaluate(() => ({
        t_s: window.twincell.stores.historyStore.getState().t_s,
        q: Array.from(window.twincell.live.shown().q_rad),
      }))
      .then(({ t_s, q }) => {
        const logged = angles(Math.floor(t_s * HZ + 1e-6));
        return { t_s, off_rad: Math.max(...q.map((angle, j) => Math.abs(angle - logged[j]!))) };
      });
  const line = async (part: number) => {
    const { at, normal, along } = await person.place("past-line");
    return { at: at.map((value, k) => value + (part - 0.5) * along[k]!) as [number, number, number], normal };
  };

  // With the ray: pressed at a quarter, drawn on to three quarters.
  await person.pointAt("right", await line(0.25));
  await person.trigger("right", 1);
  await expect.poll(async () => (await standsOff()).t_s).toBeCloseTo(0.25 * LONG_S, 0);
  await expect.poll(async () => (await standsOff()).off_rad).toBeLessThan(1e-6);
  await person.pointAt("right", await line(0.75));
  await person.frames(3);
  await person.trigger("right", 0);
  const drawnOn = await standsOff();
  expect(drawnOn.t_s).toBeCloseTo(0.75 * LONG_S, 0);
  await expect.poll(async () => (await standsOff()).off_rad).toBeLessThan(1e-6);

  await person.press("right", "past-alarm");
  await expect.poll(async () => (await standsOff()).t_s).toBeCloseTo(ALARM_S, 2);
  await expect.poll(async () => (await standsOff()).off_rad).toBeLessThan(1e-6);
  await page.screenshot({ path: picture("headset-past-alarm") });

  // With the stick: over to the left, time runs back; in the middle it stands.
  await page.evaluate(() => {
    window.xrDevice.controllers.right!.updateAxes("thumbstick", -1, 0);
  });
  await page.waitForFunction(from => window.twincell.stores.historyStore.getState().t_s < from - 0.5, ALARM_S);
  await page.evaluate(() => {
    window.xrDevice.controllers.right!.updateAxes("thumbstick", 0, 0);
  });
  await person.frames(4);
  const rested = await standsOff();
  await person.frames(4);
  expect((await standsOff()).t_s).toBe(rested.t_s);
  await expect.poll(async () => (await standsOff()).off_rad).toBeLessThan(1e-6);

  await person.press("right", "past-now");
  await page.waitForFunction(() => window.twincell.stores.viewStore.getState().mode === "run");
  expect(await page.evaluate(() => Array.from(window.twincell.live.now().q_rad))).toEqual(now);
  expect(problems).toEqual([]);
  await context.close();
});
