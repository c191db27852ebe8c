import { expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

test("the page says what this device lacks and what to do, and input, render, link and controller each have a number", async () => {
  const studio = await Studio.start();
  try {
    const { page, problems } = await studio.open({ width: 390, height: 844, touch: true });
    await drawn(page);
    await page.evaluate(() => {
      window.twincell.stores.viewStore.setState({ coachDone: true });
      window.twincell.run("help.device");
    });
    const dialog = page.getByRole("dialog", { name: "This device" });
    const finding = (check: string) => dialog.locator(`[data-check=${check}]`).getAttribute("data-finding");
    await expect.poll(() => finding("socket"), { timeout: 30_000 }).toBe("ok");
    for (const check of ["secure", "certificate", "graphics"]) expect(await finding(check)).toBe("ok");
    // A camera is there when the browser has one to offer, whether or not it may be asked for.
    const cameras = await page.evaluate(async () =>
      (await navigator.mediaDevices.enumerateDevices()).filter(({ kind }) => kind === "videoinput"),
    );
    await expect.poll(() => finding("camera")).toBe(cameras.length > 0 ? "ok" : "missing");
    await expect.poll(() => finding("headset")).toBe("missing");
    expect((await dialog.locator("[data-check=headset]").textContent())!.length).toBeGreaterThan(30);
    const value = async (stage: string): Promise<string> =>
      (await dialog.locator(`[data-stage=${stage}] dd`).textContent()) ?? "";
    expect(await value("controller")).toBe("No robot connected");
    await page.evaluate(() => window.dispatchEvent(new PointerEvent("pointermove")));
    for (const stage of ["input", "render", "link"])
      await expect.poll(() => value(stage), { timeout: 30_000 }).toMatch(/^\d+\.\d ms$/);
    await page.evaluate(() => window.twincell.run("connection.connect"));
    for (const stage of ["link", "controller"])
      await expect.poll(() => value(stage), { timeout: 60_000 }).toMatch(/^\d+\.\d ms$/);
    await page.screenshot({ path: picture("device-check") });
    // The server goes: what is missing is said, with the way out.
    studio.stopServer();
    await expect.poll(() => finding("socket"), { timeout: 30_000 }).toBe("missing");
    await dialog.getByText("Start npx twincell serve.").waitFor();
    expect(problems.filter(problem => !/ERR_|WebSocket|Failed to load/.test(problem))).toEqual([]);
  } finally {
    await studio.stop();
  }
});
