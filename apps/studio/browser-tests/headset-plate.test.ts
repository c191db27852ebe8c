import { distance, type Vector3 } from "@twincell/core";
import type { BrowserContext, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { Person } from "./support/headset.ts";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const steps = (page: Page): Promise<{ readonly type: string; readonly path: string; readonly via: boolean }[]> =>
  page.evaluate(() => {
    const { document } = window.twincell.stores.cellStore.getState();
    return document!.programs
      .filter(each => each.format === "twincell.program")
      .find(each => each.name === document!.program)!
      .steps.map(step => ({
        type: step.type,
        path: step.type === "move" ? step.path : "",
        via: step.type === "move" && step.via !== undefined,
      }));
  });

describe("L-05 L-06 in an emulated Quest 3, from the first second on", () => {
  let page: Page;
  let context: BrowserContext;
  let person: Person;
  let problems: string[];
  beforeAll(async () => {
    ({ page, context, problems } = await studio.open({ headset: true, width: 960, height: 480 }));
    await drawn(page);
    person = new Person(page);
    await person.enter();
  });
  afterAll(async () => {
    await context.close();
  });

  test("the robot stands bent, 1.5 to 2 m away, with its tool at the height of the chest, in a bright room, in 100 draw calls", async () => {
    const tcp = await person.tcp();
    expect(tcp[2]).toBeGreaterThan(1);
    expect(tcp[2]).toBeLessThan(1.4);
    const stands = await person.inWorld([0, 0, 0]);
    const base = await page.evaluate(() => {
      const [x, y] = window.twincell.stores.cellStore.getState().document!.robot.worldFromBase.position;
      return [x, y];
    });
    const away_m = Math.hypot(stands[0] - base[0]!, stands[1] - base[1]!);
    expect(away_m).toBeGreaterThanOrEqual(1.5);
    expect(away_m).toBeLessThanOrEqual(2);
    // Never over the head, and never so near that the robot stands in the person.
    expect(Math.hypot(tcp[0] - stands[0], tcp[1] - stands[1])).toBeGreaterThan(0.4);
    expect(await page.evaluate(() => window.twincell.live.touching().size)).toBe(0);
    const { calls, triangles } = await page.evaluate(() => window.twincellScene!.drawn());
    expect(calls).toBeLessThanOrEqual(100);
    expect(triangles).toBeLessThanOrEqual(300_000);
    expect(await brightness(page), "the middle of what the screen shows").toBeGreaterThan(0.6);
    await page.screenshot({ path: picture("headset-welcome") });
  });

  test("the hint shows the gesture at the ring, leaves when it was done, and stays away", async () => {
    const hint = (): Promise<boolean> =>
      page.evaluate(() => window.twincellScene!.scene.getObjectByName("grab-hint") !== undefined);
    expect(await hint()).toBe(true);
    const start = await person.tcp();
    await person.reach("right", start);
    await person.squeeze("right", 1);
    await person.squeeze("right", 0);
    expect(await hint()).toBe(false);
    expect(distance(await person.tcp(), start)).toBeLessThan(1e-6);
  });

  test("L-31 PTP, LIN and CIRC are chosen at the wrist and recorded so; the grip is a step; undo takes it back", async () => {
    await person.press("right", "record");
    await person.press("right", "path");
    await drag([0.1, 0, 0.05]);
    await person.press("right", "record");
    await person.press("right", "path");
    await drag([0, 0.08, 0.05]);
    await person.press("right", "record");
    expect(await steps(page), "the point in between waits for the end of the arc").toHaveLength(2);
    await drag([0.05, 0.08, -0.05]);
    await person.press("right", "record");
    await person.press("right", "grip");
    expect(await steps(page)).toEqual([
      { type: "move", path: "ptp", via: false },
      { type: "move", path: "lin", via: false },
      { type: "move", path: "circ", via: true },
      { type: "gripper", path: "", via: false },
    ]);
    await person.press("right", "undo");
    expect(await steps(page)).toHaveLength(3);
    await page.screenshot({ path: picture("headset-steps") });
  });

  test("L-31 the way of the hand is recorded as poses while the tool is held", async () => {
    await person.open("teach");
    await page.evaluate(() => {
      window.twincell.stores.headsetStore.setState({ recordAs: "circ" });
    });
    await person.press("right", "path");
    expect(await page.evaluate(() => window.twincell.stores.headsetStore.getState().recordAs)).toBe("way");
    const before = (await steps(page)).length;
    await drag([0.04, 0, 0.03], 0.01);
    await expect.poll(async () => (await steps(page)).length, { timeout: 60_000 }).toBeGreaterThan(before + 4);
    await person.press("right", "path");
    await person.press("right", "undo");
    expect(await steps(page)).toHaveLength(before);
  });

  test("L-28 L-30 the tool goes a tenth of the way of the hand, and keeps its place or its turn when that is locked", async () => {
    await person.open("teach", 3);
    for (let i = 0; i < 3; i++) await person.press("right", "ratio");
    const start = await person.tcp();
    await drag([0, 0, 0.1]);
    expect((await person.tcp())[2] - start[2]).toBeCloseTo(0.01, 4);
    await person.press("right", "ratio");
    await person.press("right", "lock");
    await person.press("right", "lock");
    const turnOnly = await person.tcp();
    await drag([0.05, 0, 0.05]);
    expect(distance(await person.tcp(), turnOnly)).toBeLessThan(1e-4);
    await person.press("right", "lock");
    expect(await page.evaluate(() => window.twincell.stores.headsetStore.getState().lock)).toBe("free");
  });

  test("the emergency stop is pressed by hand alone, holds the robot, and is reset on the plate", async () => {
    // A ray and a trigger do nothing.
    const button = await person.place("emergency-stop");
    await person.pointAt("right", button);
    await person.trigger("right", 1);
    await person.trigger("right", 0);
    expect(await emergency()).toBe(false);
    await person.press("right", "tab-run");
    await page.evaluate(() => {
      window.twincell.stores.playStore.setState({ speed: 0.05 });
    });
    await person.press("right", "play");
    await page.waitForFunction(() => window.twincell.stores.playStore.getState().playing);
    await poke(0.12);
    expect(await emergency()).toBe(false);
    await poke(0.02);
    expect(await emergency()).toBe(true);
    expect(await page.evaluate(() => window.twincell.stores.playStore.getState().playing)).toBe(false);
    await page.screenshot({ path: picture("headset-emergency") });
    // Latched: neither play nor the hand moves it.
    await person.press("right", "play");
    expect(await page.evaluate(() => window.twincell.stores.playStore.getState().playing)).toBe(false);
    const stands = await person.tcp();
    await drag([0.1, 0, 0]);
    expect(distance(await person.tcp(), stands)).toBe(0);
    await person.open("cell");
    await person.press("right", "reset");
    expect(await emergency()).toBe(false);
    await drag([0.02, 0, 0]);
    expect(distance(await person.tcp(), stands)).toBeCloseTo(0.02, 3);
    await page.evaluate(() => {
      window.twincell.stores.playStore.setState({ speed: 1 });
    });
  });

  test("L-07 M-14 the cell is drawn 1:20 … 2:1 without a change to the robot; seated, the floor comes up", async () => {
    await person.open("cell", 2);
    const at = await person.tcp();
    await person.press("right", "scale");
    const scale = (): Promise<number> =>
      page.evaluate(() => 1 / window.twincellScene!.scene.getObjectByName("standing-place")!.scale.x);
    expect(await scale()).toBeCloseTo(0.5, 6);
    expect(await person.tcp()).toEqual(at);
    await page.screenshot({ path: picture("headset-small") });
    for (let i = 0; i < 4; i++) await person.press("right", "scale");
    expect(await scale()).toBeCloseTo(1, 6);
    const floor = (await person.inWorld([0, 0, 0]))[2];
    await person.press("right", "posture");
    expect((await person.inWorld([0, 0, 0]))[2] - floor).toBeCloseTo(0.45, 6);
    await person.press("right", "posture");
    expect((await person.inWorld([0, 0, 0]))[2] - floor).toBeCloseTo(-0.75, 6);
    await person.press("right", "posture");

    // Both grips take the world: hands twice as far apart make it twice as large, and no larger than 2:1.
    await page.evaluate(() => {
      const { left, right } = window.xrDevice.controllers;
      left!.position.set(-0.15, 0.7, -0.2);
      right!.position.set(0.15, 0.7, -0.2);
      left!.updateButtonValue("squeeze", 1);
      right!.updateButtonValue("squeeze", 1);
    });
    await person.frames(3);
    await page.evaluate(() => {
      window.xrDevice.controllers.left!.position.set(-0.225, 0.7, -0.2);
      window.xrDevice.controllers.right!.position.set(0.225, 0.7, -0.2);
    });
    await person.frames(3);
    // The grips lie beside the middles of the controllers: their distance grows by a little less.
    expect(await scale()).toBeGreaterThan(1.45);
    expect(await scale()).toBeLessThan(1.51);
    await page.evaluate(() => {
      window.xrDevice.controllers.left!.position.set(-0.6, 0.7, -0.2);
      window.xrDevice.controllers.right!.position.set(0.6, 0.7, -0.2);
    });
    await person.frames(3);
    expect(await scale()).toBeCloseTo(2, 6);
    await person.letGo();
    expect(await person.tcp()).toEqual(at);
    await page.evaluate(() => {
      window.xrDevice.controllers.left!.position.set(-0.25, 1.2, -0.4);
    });
    await person.open("history");
    await person.press("right", "back-here");
    expect(await scale()).toBeCloseTo(1, 6);
  });

  test("the stick goes about: forward and let go stands on the aimed floor, aside turns by 30° about the eyes", async () => {
    const eye = (): Promise<Vector3> =>
      page.evaluate(() => {
        const { elements: e } = window.twincellScene!.gl.xr.getCamera().matrixWorld;
        return [e[12]!, -e[14]!, e[13]!];
      });
    const yaw = (): Promise<number> =>
      page.evaluate(() => window.twincellScene!.scene.getObjectByName("standing-place")!.rotation.y);
    const [from, turned] = [await eye(), await yaw()];
    await page.evaluate(() => {
      window.xrDevice.controllers.left!.updateAxes("thumbstick", 0, -1);
    });
    await person.frames(3);
    const marker = await page.evaluate(() => {
      const found = window.twincellScene!.scene.getObjectByName("teleport-marker")!;
      return { visible: found.visible, x: found.position.x, y: -found.position.z };
    });
    expect(marker.visible).toBe(true);
    await page.evaluate(() => {
      window.xrDevice.controllers.left!.updateAxes("thumbstick", 0, 0);
    });
    await person.frames(3);
    const there = await eye();
    expect(Math.hypot(there[0] - marker.x, there[1] - marker.y)).toBeLessThan(0.02);
    expect(there[2]).toBeCloseTo(from[2], 6);
    expect(distance(there, from)).toBeGreaterThan(0.5);
    await page.evaluate(() => {
      window.xrDevice.controllers.right!.updateAxes("thumbstick", 1, 0);
    });
    await person.frames(4);
    await page.evaluate(() => {
      window.xrDevice.controllers.right!.updateAxes("thumbstick", 0, 0);
    });
    await person.frames(2);
    const off = (await yaw()) - turned;
    expect(Math.abs(Math.atan2(Math.sin(off), Math.cos(off)))).toBeCloseTo(Math.PI / 6, 5);
    expect(distance(await eye(), there)).toBeLessThan(1e-4);
    await person.open("history");
    await person.press("right", "back-here");
    expect(problems).toEqual([]);
  });

  const emergency = (): Promise<boolean> =>
    page.evaluate(() => window.twincell.stores.headsetStore.getState().emergency);
  /** Takes the tool, carries it by a way in the world, lets go. */
  async function drag(way: Vector3, step_m = 0.05): Promise<void> {
    await person.reach("right", await person.tcp());
    await person.squeeze("right", 1);
    await person.carry("right", way, step_m);
    await person.squeeze("right", 0);
    await person.reach("right", [1.5, 0.5, 1.2]);
  }
  /** Brings the right hand over the button and then so near to its middle. */
  async function poke(near_m: number): Promise<void> {
    const { at, normal } = await person.place("emergency-stop");
    for (const away_m of [0.2, near_m, 0.2]) {
      const holds = await person.holds("right");
      await person.shift("right", [0, 1, 2].map(k => at[k]! + away_m * normal[k]! - holds[k]!) as Vector3);
      await person.frames(2);
    }
  }
});

/** How light the middle of the page is, 0 … 1. */
async function brightness(page: Page): Promise<number> {
  const shot = (await page.screenshot()).toString("base64");
  return page.evaluate(async data => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
    const context = canvas.getContext("2d")!;
    context.drawImage(bitmap, 0, 0);
    const { data: pixels } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    let sum = 0;
    for (let i = 0; i < pixels.length; i += 4) sum += pixels[i]! + pixels[i + 1]! + pixels[i + 2]!;
    return sum / (pixels.length * 0.75 * 255);
  }, shot);
}
