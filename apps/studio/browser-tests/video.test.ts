import type { BrowserContext, Page } from "playwright-core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import { CAMERA_FLAGS, drawn, picture, Studio } from "./support/studio.ts";

/** Before the camera's page starts: its camera films the studio's page. */
const FILMS_THE_STUDIO = `navigator.mediaDevices.getUserMedia = () => navigator.mediaDevices.getDisplayMedia({ video: { frameRate: 30 } });`;

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start(CAMERA_FLAGS);
});
afterAll(async () => {
  await studio.stop();
});

/** A page as a phone opens it, in the same browser. */
async function camera(context: BrowserContext, name: string, script = ""): Promise<Page> {
  const page = await context.newPage();
  if (script) await page.addInitScript({ content: script });
  await page.goto(`${studio.url}camera/?name=${name}`);
  return page;
}
async function start(page: Page): Promise<void> {
  await page.getByRole("button", { name: "Show the picture" }).click();
  await page.getByRole("button", { name: "Stop" }).waitFor();
}
const panel = (page: Page, name: string) => page.getByRole("region", { name: `Picture of ${name}` });
async function show(page: Page, name: string): Promise<void> {
  await page.evaluate(() => window.twincell.run("view.cameras"));
  await page.getByRole("button", { name: `Show: ${name}` }).click();
  await panel(page, name).waitFor();
}
/** How different the pixels of a panel's picture are from one another. */
const contrast = (page: Page, name: string) =>
  panel(page, name)
    .locator("canvas")
    .evaluate((canvas: HTMLCanvasElement) => {
      const { data } = canvas.getContext("2d")!.getImageData(0, 0, canvas.width, canvas.height);
      let least = 255;
      let most = 0;
      for (let i = 1; i < data.length; i += 4) {
        least = Math.min(least, data[i]!);
        most = Math.max(most, data[i]!);
      }
      return most - least;
    });

describe("a camera that films the studio", () => {
  let page: Page;
  let context: BrowserContext;
  let phone: Page;
  let problems: string[];
  beforeAll(async () => {
    ({ page, context, problems } = await studio.open({ width: 1000, height: 640 }));
    await drawn(page);
    await page.evaluate(() => {
      window.twincell.stores.viewStore.setState({ coachDone: true });
    });
    phone = await camera(context, "Phone", FILMS_THE_STUDIO);
    await start(phone);
  });
  afterAll(async () => {
    await context.close();
  });

  test("X-40 its picture appears in the studio, with its age, and says that it is a view", async () => {
    await show(page, "Phone");
    await expect.poll(() => contrast(page, "Phone"), { timeout: 30_000 }).toBeGreaterThan(60);
    await panel(page, "Phone")
      .getByText(/^\d+ ms$/)
      .waitFor();
    await panel(page, "Phone").getByText("A view, no safety device.").waitFor();
    await expect
      .poll(() => phone.getByRole("status").innerText())
      .toMatch(/^One studio looks\. \d+ pictures a second, \d+ × \d+$/);
    await page.screenshot({ path: picture("video-panel") });
    await phone.screenshot({ path: picture("video-camera-page") });
  });

  test("X-40 glass to glass is measured: the code on the screen comes back in the picture", async () => {
    await panel(page, "Phone").getByRole("button", { name: "Measure the latency" }).click();
    const dialog = page.getByRole("dialog", { name: /Measure the latency/ });
    const figure = (name: string) => dialog.locator(`[data-figure=${name}]`).innerText();
    await expect.poll(async () => Number(await figure("n")), { timeout: 60_000 }).toBeGreaterThanOrEqual(20);
    await page.screenshot({ path: picture("video-measure") });
    const [median, p95, spread, n, estimate] = await Promise.all(
      ["median", "p95", "spread", "n", "estimate"].map(figure),
    );
    await dialog.getByRole("button", { name: "Close", exact: true }).click();
    const stages = await panel(page, "Phone").locator(".video-age").getAttribute("title");
    console.log(
      `glass to glass, everything in one machine and drawn by the processor: median ${median}, p95 ${p95}, ${spread}, n ${n}; estimated ${estimate}; ${stages?.split("\n")[1]}`,
    );
    const ms = (text: string | undefined): number => Number(/^(\d+) ms$/.exec(text ?? "")?.[1]);
    expect(ms(median)).toBeGreaterThan(10);
    expect(ms(median)).toBeLessThan(1500);
    expect(ms(p95)).toBeGreaterThanOrEqual(ms(median));
    // The estimate knows nothing of the display and of waiting for the next picture: it is less, and not by an order.
    expect(ms(estimate)).toBeLessThanOrEqual(ms(p95));
  });

  test("X-40 the twin is held back to the picture, and what is commanded is not", async () => {
    await panel(page, "Phone").getByRole("button", { name: "Hold the twin back" }).click();
    await panel(page, "Phone")
      .getByText(/^The twin is drawn \d+ ms late, as the picture is\.$/)
      .waitFor();
    // A robot that turns evenly: what is drawn must be where it was when the picture was taken.
    const apart = await page.evaluate(
      () =>
        new Promise<{ readonly late_s: number; readonly commanded: boolean }[]>(resolve => {
          const seen: { late_s: number; commanded: boolean }[] = [];
          const began = performance.now();
          const speed = 0.2;
          const step = (): void => {
            const now = performance.now();
            const q = [(speed * (now - began)) / 1000, -1.5708, 1.5708, 0, 0, 0];
            window.twincell.live.showJoints(q);
            const shown = window.twincell.live.shown().q_rad[0]!;
            if (now - began > 1500)
              seen.push({ late_s: (q[0]! - shown) / speed, commanded: window.twincell.live.now().q_rad[0] === q[0] });
            if (now - began < 5000) requestAnimationFrame(step);
            else resolve(seen);
          };
          requestAnimationFrame(step);
        }),
    );
    expect(apart.length).toBeGreaterThan(5);
    expect(apart.every(({ commanded }) => commanded)).toBe(true);
    const late = apart.map(({ late_s }) => late_s).sort((a, b) => a - b);
    const median = late[late.length >> 1]!;
    expect(median).toBeGreaterThan(0.01);
    expect(median).toBeLessThan(2);
    await panel(page, "Phone").getByRole("button", { name: "Hold the twin back" }).click();
    await expect
      .poll(() => page.evaluate(() => window.twincell.live.shown().q_rad[0] === window.twincell.live.now().q_rad[0]))
      .toBe(true);
  });

  test("X-40 the camera is pulled: the panel says so and greys; it comes back by itself", async () => {
    await phone.close();
    await panel(page, "Phone")
      .getByText("The camera “Phone” is gone. The last picture stays until it comes back.")
      .waitFor({ timeout: 15_000 });
    await panel(page, "Phone")
      .getByText(/^Picture stands still for \d+\.\d s\.$/)
      .waitFor({ timeout: 15_000 });
    expect(await panel(page, "Phone").locator(".video-picture").getAttribute("data-state")).toBe("still");
    await page.screenshot({ path: picture("video-still") });
    phone = await camera(context, "Phone", FILMS_THE_STUDIO);
    await start(phone);
    await expect
      .poll(() => panel(page, "Phone").locator(".video-picture").getAttribute("data-state"), { timeout: 30_000 })
      .toMatch(/fresh|late/);
    await panel(page, "Phone").getByRole("button", { name: "Close the picture" }).click();
    expect(await panel(page, "Phone").count()).toBe(0);
    expect(problems).toEqual([]);
  });
});

describe("without a camera", () => {
  test("X-40 a permission that is not given, a camera that is not there, each with one sentence", async () => {
    const { page, context } = await studio.open();
    await drawn(page);
    for (const [name, sentence] of [
      ["NotAllowedError", "The camera was not allowed."],
      ["NotFoundError", "No camera was found on this device."],
      ["NotReadableError", "Another program uses the camera."],
    ] as const) {
      const phone = await camera(
        context,
        "Phone",
        `navigator.mediaDevices.getUserMedia = () => Promise.reject(new DOMException("no", "${name}"));`,
      );
      await phone.getByRole("button", { name: "Show the picture" }).click();
      await phone.getByRole("alert").filter({ hasText: sentence }).waitFor();
      await phone.close();
    }
    await context.close();
  });

  test("X-40 this computer's camera, beside a second one through the server; the server is gone and the panel says so", async () => {
    const { page, context } = await studio.open();
    await context.grantPermissions(["camera"]);
    await drawn(page);
    await page.evaluate(() => {
      window.twincell.stores.viewStore.setState({ coachDone: true });
    });
    const phone = await camera(context, "Second");
    await start(phone);
    await show(page, "Second");
    await page.evaluate(() => window.twincell.run("view.cameras"));
    await page.getByRole("region", { name: "This computer's camera" }).getByRole("button").first().click();
    const here = page.locator(".video-panel").nth(1);
    await expect
      .poll(() => here.locator(".video-picture").getAttribute("data-state"), { timeout: 30_000 })
      .toBe("fresh");
    await page.screenshot({ path: picture("video-two") });
    await page.evaluate(() => window.twincell.run("view.cameras"));
    await page.screenshot({ path: picture("video-cameras") });
    await page.getByRole("dialog", { name: "Cameras" }).getByRole("button", { name: "Close", exact: true }).click();
    // The last of this file: no page is served after it.
    studio.stopServer();
    await panel(page, "Second")
      .getByText("The Twincell server does not answer. It is tried again.")
      .waitFor({ timeout: 15_000 });
    await phone
      .getByRole("status")
      .getByText("The Twincell server does not answer. It is tried again.")
      .waitFor({ timeout: 15_000 });
    expect(
      await here.locator(".video-picture").getAttribute("data-state"),
      "a camera of this computer needs no server",
    ).toMatch(/fresh|late/);
    await context.close();
  });
});
