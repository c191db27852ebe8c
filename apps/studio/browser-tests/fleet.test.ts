import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Locator, Page } from "playwright-core";
import { afterEach, beforeEach, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeEach(async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-fleet-"));
  studio = await Studio.start([], ["--training", "--data", data]);
});
afterEach(async () => {
  await studio.stop();
});

async function api(method: string, path: string, body: unknown = {}, lease = ""): Promise<Record<string, unknown>> {
  const response = await fetch(new URL(`/api/v1/${path}`, studio.url), {
    method,
    headers: { "content-type": "application/json", "twincell-lease": lease },
    ...(method === "GET" ? {} : { body: JSON.stringify(body) }),
  });
  return (await response.json()) as Record<string, unknown>;
}
async function connected(id: string, name: string, driver: string, model: string): Promise<void> {
  await api("POST", "robots", { id, name, driver, model });
  const lease = String((await api("POST", `robots/${id}/lease`))["lease"]);
  expect(await api("POST", `robots/${id}/connect`, {}, lease)).toEqual({ kind: "done" });
  await api("DELETE", `robots/${id}/lease`, {}, lease);
}
async function fleet(page: Page): Promise<void> {
  await page.keyboard.press("Control+k");
  await page.keyboard.type("Fleet");
  await page.keyboard.press("Enter");
  await page.getByRole("dialog", { name: "Fleet" }).waitFor();
}

/** Resolves when a dialog has come up, however slowly frames are drawn. */
const shown = (dialog: Locator): Promise<unknown> =>
  dialog.evaluate(element => Promise.all(element.getAnimations({ subtree: true }).map(each => each.finished)));

test("T-56 T-58 the fleet shows every robot of the server with its state, finds one, and leads to its twin and its history, on a desk and a phone; a server for training says so, and offers no real controller", async () => {
  await connected("weld1", "Weld 1", "ur", "ur10e");
  await connected("tend2", "Tend 2", "yaskawa", "yaskawa_gp8");
  await api("POST", "robots", { id: "lab", name: "Lab 1", driver: "kuka", model: "kuka_kr6r900sixx" });
  await api("POST", "robots/tend2/stop", { emergency: true });
  const { page, problems } = await studio.open({ width: 1440, height: 900 });
  await drawn(page);
  await page.getByText("Training", { exact: true }).waitFor();
  await fleet(page);
  const dialog = page.getByRole("dialog", { name: "Fleet" });
  const card = (name: string) =>
    dialog.getByRole("list", { name: "Fleet" }).getByRole("listitem").filter({ hasText: name });
  await card("Tend 2").and(page.locator('[data-state="stopped"]')).waitFor();
  await card("Lab 1").and(page.locator('[data-state="no-link"]')).waitFor();
  expect(await dialog.getByLabel("Figures").innerText()).toMatch(/Robots\s*3\s*\d linked/);
  const needs = dialog.getByRole("region", { name: "Needs you" });
  await needs.getByText("Tend 2").waitFor();
  await shown(dialog);
  await page.screenshot({ path: picture("fleet") });

  await dialog.getByRole("button", { name: /^Stopped/ }).click();
  expect(await card("").count()).toBe(1);
  await dialog.getByRole("button", { name: /^All 3/ }).click();
  await dialog.getByLabel("Robot, model, site").fill("nowhere");
  await dialog.getByText("No robot is called “nowhere”.").waitFor();
  await dialog.getByRole("button", { name: "Clear search" }).click();

  // Its history is the recording that the server has made of it; its twin is in the Run mode.
  await dialog.getByRole("button", { name: "History of Weld 1" }).click();
  await dialog.waitFor({ state: "detached" });
  await page.waitForFunction(() => window.twincell.stores.viewStore.getState().mode === "history");
  await fleet(page);
  await card("Weld 1").hover();
  await card("Weld 1").getByRole("button", { name: "Twin of Weld 1" }).click();
  await dialog.waitFor({ state: "detached" });
  await page.locator(".station").filter({ hasText: "Weld 1" }).waitFor();

  // The lock: no way to a real controller is offered, and the server refuses one that is asked for all the same.
  await page.evaluate(() => window.twincell.stores.dialogStore.setState({ open: "station" }));
  await page.getByText("This server is for training: no real robot can be reached.").waitFor();
  expect(
    await api("POST", "robots", { id: "real", driver: "ur", model: "ur10e", address: { host: "192.0.2.5" } }),
  ).toMatchObject({ kind: "refused", why: { code: "station.training" } });
  expect(problems).toEqual([]);

  const phone = await studio.open({ width: 390, height: 844, touch: true });
  await drawn(phone.page);
  await phone.page.evaluate(() => window.twincell.stores.dialogStore.setState({ open: "fleet" }));
  const small = phone.page.getByRole("dialog", { name: "Fleet" });
  await small.getByRole("button", { name: "Twin of Tend 2" }).first().waitFor();
  const wide = await small.evaluate(element => element.scrollWidth - element.clientWidth);
  expect(wide).toBeLessThanOrEqual(0);
  await shown(small);
  await phone.page.screenshot({ path: picture("fleet-phone") });
  expect(phone.problems).toEqual([]);
});
