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
const open = (page: Page, dialog: "fleet" | "station"): Promise<void> =>
  page.evaluate(name => window.twincell.stores.dialogStore.setState({ open: name }), dialog);

/** Resolves when a dialog has come up, however slowly frames are drawn. */
const shown = (dialog: Locator): Promise<unknown> =>
  dialog.evaluate(element => Promise.all(element.getAnimations({ subtree: true }).map(each => each.finished)));

test("T-56 T-58 the fleet shows the robots of the server with their states, finds one, and leads to its twin, on a desk and a phone; a server for training says so, and offers no real controller", async () => {
  await api("POST", "robots", { id: "tend2", name: "Tend 2", driver: "yaskawa", model: "yaskawa_gp8" });
  await api("POST", "robots", { id: "lab", name: "Lab 1", driver: "kuka", model: "kuka_kr6r900sixx" });
  const lease = String((await api("POST", "robots/tend2/lease"))["lease"]);
  expect(await api("POST", "robots/tend2/connect", {}, lease)).toEqual({ kind: "done" });
  await api("POST", "robots/tend2/stop", { emergency: true });
  const { page, problems } = await studio.open({ width: 1440, height: 900 });
  await drawn(page);
  await page.getByText("Training", { exact: true }).waitFor();
  await open(page, "fleet");
  const dialog = page.getByRole("dialog", { name: "Fleet" });
  const cards = dialog.getByRole("list", { name: "Fleet" }).getByRole("listitem");
  await cards.and(page.locator('[data-state="stopped"]')).filter({ hasText: "Tend 2" }).waitFor();
  await cards.and(page.locator('[data-state="no-link"]')).filter({ hasText: "Lab 1" }).waitFor();
  expect(await dialog.getByLabel("Figures").innerText()).toMatch(/Robots\s*2\s*\d linked/);
  await shown(dialog);
  await page.screenshot({ path: picture("fleet") });
  await dialog.getByLabel("Robot, model, site").fill("nowhere");
  await dialog.getByText("No robot is called “nowhere”.").waitFor();
  await dialog.getByRole("button", { name: "Clear search" }).click();
  await cards.filter({ hasText: "Tend 2" }).getByRole("button", { name: "Twin of Tend 2" }).click();
  await dialog.waitFor({ state: "detached" });
  await page.locator(".station").filter({ hasText: "Tend 2" }).waitFor();

  // The lock: no way to a real controller is offered, and the server refuses one that is asked for all the same.
  await open(page, "station");
  await page.getByText("This server is for training: no real robot can be reached.").waitFor();
  expect(
    await api("POST", "robots", { id: "real", driver: "ur", model: "ur10e", address: { host: "192.0.2.5" } }),
  ).toMatchObject({ kind: "refused", why: { code: "station.training" } });
  expect(problems).toEqual([]);
  await page.context().close();

  const phone = await studio.open({ width: 390, height: 844, touch: true });
  await drawn(phone.page);
  await open(phone.page, "fleet");
  const small = phone.page.getByRole("dialog", { name: "Fleet" });
  await small.getByRole("button", { name: "Twin of Tend 2" }).first().waitFor();
  await shown(small);
  expect(await small.evaluate(element => element.scrollWidth - element.clientWidth)).toBeLessThanOrEqual(0);
  await phone.page.screenshot({ path: picture("fleet-phone") });
  expect(phone.problems).toEqual([]);
});
