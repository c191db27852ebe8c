import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page } from "playwright-core";
import { afterEach, beforeEach, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeEach(async () => {
  const data = mkdtempSync(join(tmpdir(), "twincell-people-"));
  studio = await Studio.start([], ["--accounts", "--data", data]);
});
afterEach(async () => {
  await studio.stop();
});
const PASSWORD = "correct horse";

/** The page of a link, as the one who got it opens it: a fresh browser. */
async function openLink(link: string): Promise<Page> {
  const { page } = await studio.open({ query: "?nothing" });
  await page.goto(link);
  return page;
}
async function choose(page: Page, name: string | null): Promise<void> {
  const form = page.getByRole("dialog", { name: "Sign in" });
  if (name !== null) await form.getByLabel("Name").fill(name);
  await form.getByLabel("New password, at least 10 characters").fill(PASSWORD);
  await form.getByRole("button", { name: "Go on" }).click();
  await form.waitFor({ state: "detached" });
  await drawn(page);
}
async function people(page: Page): Promise<void> {
  await page.keyboard.press("Control+k");
  await page.keyboard.type("People and roles");
  await page.keyboard.press("Enter");
  await page.getByRole("dialog", { name: "People" }).waitFor();
}

test("the first admin is made by the link that the server prints, invites a viewer, adds a passkey in Chromium's authenticator, and is asked to sign in again after signing out", async () => {
  await expect.poll(() => /once: (\S+)/.exec(studio.said)?.[1]).toBeDefined();
  const link = /once: (\S+)/.exec(studio.said)![1]!;
  const page = await openLink(link);
  await page.getByRole("heading", { name: "Choose your password" }).waitFor();
  await page.screenshot({ path: picture("sign-in") });
  expect(page.url()).not.toContain("invitation");
  await choose(page, "Ada");

  await people(page);
  const dialog = page.getByRole("dialog", { name: "People" });
  await dialog.getByText("You are Ada, Admin.").waitFor();
  await dialog.getByPlaceholder("Name of somebody new").fill("Vera");
  await dialog.getByLabel("Role of Vera").selectOption("viewer");
  await dialog.getByRole("button", { name: "Invite" }).click();
  expect(await dialog.locator("code").textContent()).toContain("invitation=");
  await dialog.getByText("has not chosen a password yet").waitFor();
  await page.screenshot({ path: picture("people") });

  const session = await page.context().newCDPSession(page);
  await session.send("WebAuthn.enable");
  await session.send("WebAuthn.addVirtualAuthenticator", {
    options: {
      protocol: "ctap2",
      transport: "internal",
      hasResidentKey: true,
      hasUserVerification: true,
      isUserVerified: true,
      automaticPresenceSimulation: true,
    },
  });
  await dialog.getByRole("button", { name: "Add a passkey" }).click();
  await page.getByText("The passkey was added.").waitFor();
  await dialog.getByRole("button", { name: "Sign out" }).click();
  await page.getByRole("heading", { name: "Sign in" }).waitFor();
});
