import { saveDocument, tracedCartonCell } from "@twincell/project";
import { afterAll, beforeAll, expect, test } from "vitest";
import { cpuDuring } from "./support/cpu.ts";
import { VIVE } from "./support/headset-devices.ts";
import { Person } from "./support/headset.ts";
import { ledger, quantile } from "./support/ledger.ts";
import { drawn, picture, Studio, type Page } from "./support/studio.ts";

/** Emulated: the controllers from the W3C registry of input profiles, the display as published. */
const OVER_CARTON_DEG = [0, -50, 190, 0, 40, 0];

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const stand = (page: Page): Promise<void> =>
  page.evaluate(
    q => {
      window.twincell.live.showJoints(q);
    },
    OVER_CARTON_DEG.map(value => (value * Math.PI) / 180),
  );
/** 1080 × 1200 for each eye; 110° across, as the Vive has it. */
const EYE = { width: 1080, height: 1200 } as const;
const ACROSS_RAD = (110 * Math.PI) / 180;
/** Vertical angle of view of a picture that is 110° wide. */
const FOVY_RAD = 2 * Math.atan((Math.tan(ACROSS_RAD / 2) * EYE.height) / EYE.width);
const BUDGET_MS = 1000 / 90;
/** A budget is held at the first try or not at all. */
const ONCE = { retry: 0 } as const;

test(
  "M-12 X-37 X-38 an emulated Vive, 1080 × 1200 for each eye, 90 Hz, 110°: of 20 frames 19 have no more than 11.1 ms of script while the program plays and collisions are looked at",
  ONCE,
  async () => {
    const { page, problems } = await studio.open({
      headset: VIVE,
      bothEyes: true,
      width: 960,
      height: 540,
      script: ledger("paced"),
    });
    await drawn(page);
    await page.evaluate(text => {
      window.twincell.document.open(text, "example");
    }, saveDocument(tracedCartonCell()));
    await page.waitForFunction(() => window.twincell.stores.playStore.getState().verdict !== null, null, {
      timeout: 60_000,
      polling: 100,
    });
    await page.evaluate(fovy => {
      window.xrDevice.fovy = fovy;
    }, FOVY_RAD);
    const person = new Person(page);
    await person.enter(2 * EYE.width, EYE.height);
    const seen = await page.evaluate(() => {
      const { gl } = window.twincellScene!;
      const session = gl.xr.getSession()!;
      return {
        eyes: gl.xr.getCamera().cameras.map(({ viewport, projectionMatrix: { elements: e } }) => ({
          width: viewport!.z,
          height: viewport!.w,
          across_rad: 2 * Math.atan(1 / e[0]!),
        })),
        rate_Hz: session.frameRate,
      };
    });
    expect(seen.rate_Hz).toBe(90);
    expect(seen.eyes).toHaveLength(2);
    for (const { width, height, across_rad } of seen.eyes) {
      expect([width, height]).toEqual([EYE.width, EYE.height]);
      expect(across_rad).toBeCloseTo(ACROSS_RAD, 6);
    }
    await page.evaluate(() => {
      window.twincell.stores.playStore.setState({ speed: 0.2 });
      window.twincell.run("play.toggle");
    });
    await person.frames(60);
    const rounds: (readonly number[])[] = [];
    for (let i = 0; i < 4; i++) rounds.push((await cpuDuring(page, () => person.frames(60))).script_ms);
    expect(await page.evaluate(() => window.twincell.stores.playStore.getState().playing)).toBe(true);
    expect(await page.evaluate(() => window.twincell.stores.watchStore.getState().took_ms)).toBeGreaterThan(0);
    const least = (part: number): number => Math.min(...rounds.map(script_ms => quantile(script_ms, part)));
    expect(rounds.flat().length).toBeGreaterThan(150);
    expect(least(0.5)).toBeLessThanOrEqual(BUDGET_MS / 2);
    expect(least(0.95)).toBeLessThanOrEqual(BUDGET_MS);
    expect(problems).toEqual([]);
  },
);

test("M-11 M-13 both eyes see their own picture of one moment: 63 mm apart in every frame, near things shifted as far as their distance asks", async () => {
  const [width, height] = [1120, 640];
  const { page, problems } = await studio.open({ headset: VIVE, bothEyes: true, width, height });
  await drawn(page);
  await stand(page);
  const person = new Person(page);
  await page.evaluate(fovy => {
    window.xrDevice.fovy = fovy;
  }, FOVY_RAD);
  await person.enter(width, height);
  // While the head moves, both eyes are those of one pose of the head, in every frame.
  const worst_m = await page.evaluate(
    () =>
      new Promise<number>(resolve => {
        const { gl } = window.twincellScene!;
        const { position, quaternion } = window.xrDevice;
        let [frame, worst] = [0, 0];
        const next = (): void => {
          const [a, b] = gl.xr.getCamera().cameras.map(({ matrixWorld: { elements: e } }) => [e[12]!, e[13]!, e[14]!]);
          worst = Math.max(worst, Math.abs(Math.hypot(a![0]! - b![0]!, a![1]! - b![1]!, a![2]! - b![2]!) - 0.063));
          position.set(0.02 * Math.sin(frame), 1.6, 0.02 * Math.cos(frame));
          if (++frame > 6) {
            // Looks 20° down, as one does at a table.
            position.set(0, 1.6, 0);
            quaternion.set(-Math.sin(Math.PI / 18), 0, 0, Math.cos(Math.PI / 18));
            resolve(worst);
          } else gl.xr.getSession()!.requestAnimationFrame(next);
        };
        gl.xr.getSession()!.requestAnimationFrame(next);
      }),
  );
  expect(worst_m).toBeLessThan(1e-6);
  await person.frames(4);
  const shot = await page.screenshot({ path: picture("headset-both-eyes") });
  const expected = await page.evaluate(
    ([wide, high]) =>
      ["emergency-stop", "carton"].map(name => {
        const { gl, scene } = window.twincellScene!;
        const thing = scene.getObjectByName(name)!;
        thing.updateWorldMatrix(true, false);
        const [left, right] = gl.xr.getCamera().cameras.map(camera => {
          const at = scene.position.clone().setFromMatrixPosition(thing.matrixWorld).project(camera);
          return { x: ((at.x + 1) / 4) * wide, y: ((1 - at.y) / 2) * high };
        });
        return { x: left!.x, y: left!.y, shift: right!.x - left!.x };
      }),
    [width, height] as const,
  );
  const seen = await page.evaluate(
    async ([data, points]) => {
      const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext("2d")!;
      context.drawImage(bitmap, 0, 0);
      const { data: p, width: wide, height: high } = context.getImageData(0, 0, bitmap.width, bitmap.height);
      const half = wide / 2;
      const off = (a: number, b: number): number =>
        Math.abs(p[a]! - p[b]!) + Math.abs(p[a + 1]! - p[b + 1]!) + Math.abs(p[a + 2]! - p[b + 2]!);
      let other = 0;
      for (let row = 0; row < high; row++)
        for (let col = 0; col < half; col++) {
          const at = 4 * (row * wide + col);
          if (off(at, at + 4 * half) > 24) other++;
        }
      // Where in the right picture the surroundings of each point are found again.
      const shifts = points.map(({ x, y }) => {
        let [least, found] = [Infinity, 0];
        for (let by = -60; by <= 10; by++) {
          let sum = 0;
          for (let row = Math.round(y) - 18; row <= y + 18; row += 2)
            for (let col = Math.round(x) - 24; col <= x + 24; col += 2)
              sum += off(4 * (row * wide + col), 4 * (row * wide + col + by + half));
          if (sum < least) [least, found] = [sum, by];
        }
        return found;
      });
      return { other: other / (half * high), shifts };
    },
    [shot.toString("base64"), expected] as const,
  );
  await page.evaluate(() => {
    const { roomStore, headsetStore } = window.twincell.stores;
    roomStore.setState({ keypad: true });
    headsetStore.setState({ hintDone: true });
    window.xrDevice.controllers.left!.position.set(-0.1, 1.1, -0.45);
    window.xrDevice.quaternion.set(-0.1736, 0.2, 0, 0.96);
  });
  await person.frames(4);
  await page.screenshot({ path: picture("headset-keypad") });
  expect(seen.other, "part of the picture that differs").toBeGreaterThan(0.02);
  for (const [i, { shift }] of expected.entries())
    expect(Math.abs(seen.shifts[i]! - shift), `pixels between seen and expected, ${shift}`).toBeLessThanOrEqual(3);
  expect(expected[0]!.shift, "the nearer one is shifted more").toBeLessThan(2 * expected[1]!.shift);
  expect(problems).toEqual([]);
});
