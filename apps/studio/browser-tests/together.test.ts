import { mkdtempSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Page, WebSocketRoute } from "playwright-core";
import { afterEach, beforeEach, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeEach(async () => {
  studio = await Studio.start([], ["--data", mkdtempSync(join(tmpdir(), "twincell-together-"))]);
});
afterEach(async () => {
  await studio.stop();
});

/** Stands between a page and the server, so that the connection of the cell can be cut and let through again. */
function cable() {
  let open: WebSocketRoute | null = null;
  let whole = true;
  return {
    plug(page: Page): void {
      patient(page);
      void page.routeWebSocket(/\/api\/v1\/editing/, async socket => {
        if (!whole) {
          await socket.close({ code: 3000 });
          return;
        }
        open = socket;
        socket.connectToServer();
      });
    },
    async cut(): Promise<void> {
      whole = false;
      await open?.close({ code: 3000 });
    },
    mend(): void {
      whole = true;
    },
  };
}
/** Three pages draw at once, in software: each is given its time. */
const patient = (page: Page): void => {
  page.setDefaultNavigationTimeout(120_000);
  page.setDefaultTimeout(60_000);
};
const SIZE = { width: 1200, height: 760 };
const online = (page: Page, state: "online" | "offline"): Promise<unknown> =>
  page.waitForFunction(wanted => window.twincell.stores.togetherStore.getState().state === wanted, state, {
    polling: 100,
  });
/** Names of the steps of the program, in their order. */
const steps = (page: Page): Promise<readonly string[]> =>
  page.evaluate(() => {
    const { document } = window.twincell.stores.cellStore.getState();
    const program = document?.programs.find(each => each.name === document.program);
    return program && "steps" in program ? program.steps.map(each => each.name ?? each.type) : [];
  });
const stepRow = (page: Page, name: string) => page.locator(".program-row .row").filter({ hasText: name });
const add = (page: Page, name: string): Promise<void> =>
  page.evaluate(wanted => {
    window.twincell.document.commit(`Add ${wanted}`, document => ({
      ...document,
      programs: document.programs.map(each =>
        each.name === document.program && "steps" in each
          ? { ...each, steps: [...each.steps, { type: "wait", id: wanted, s: 1, name: wanted }] }
          : each,
      ),
    }));
  }, name);

test("two pages edit one cell of the server at the same time: each sees the other's edits, name, selection and pointer, undo takes back one's own, what was done without a connection is merged, a step is commented, and a read-only link shows it all and changes nothing", async () => {
  const a = await studio.open({ ...SIZE, before: patient });
  await drawn(a.page);
  await a.page.evaluate(() => window.twincell.stores.dialogStore.setState({ open: "together" }));
  const dialog = a.page.getByRole("dialog", { name: "Edit together" });
  await dialog.getByRole("button", { name: "Share this cell" }).click();
  await dialog.getByText("Nobody else is here now.").waitFor();
  await a.page.screenshot({ path: picture("together-dialog") });
  const address = new URL(a.page.url());
  expect(address.searchParams.get("cell")).not.toBeNull();

  const line = cable();
  const b = await studio.open({ ...SIZE, query: address.search, before: page => line.plug(page) });
  await drawn(b.page);
  await online(b.page, "online");
  await dialog.getByText("studio 2 ·").waitFor();

  // Both at once, then each undoes once.
  await Promise.all([add(a.page, "from a"), add(b.page, "from b")]);
  for (const { page } of [a, b]) {
    await stepRow(page, "from a").waitFor();
    await stepRow(page, "from b").waitFor();
  }
  expect(await steps(a.page)).toEqual(await steps(b.page));
  await dialog.getByRole("button", { name: "Close" }).click();
  await a.page.keyboard.press("Control+z");
  await expect.poll(() => steps(b.page)).toEqual(["from b"]);
  await a.page.keyboard.press("Control+Shift+z");
  await expect.poll(async () => (await steps(b.page)).toSorted()).toEqual(["from a", "from b"]);

  // Where the other is: the step that is selected, and the place that is pointed at.
  await stepRow(b.page, "from b").click();
  await a.page.locator('.row-editor[aria-label="Selected by studio 2"]').waitFor();
  const canvas = (await b.page.locator(".viewport canvas").first().boundingBox())!;
  // Over the carton, the table and the robot: what is drawn where depends on the size of the page.
  const places = [0.75, 0.8, 0.7, 0.6, 0.85].flatMap(y => [0.5, 0.55, 0.45].map(x => [x, y] as const));
  let next = 0;
  await expect
    .poll(
      async () => {
        const [x, y] = places[next++ % places.length]!;
        await b.page.mouse.move(canvas.x + canvas.width * x, canvas.y + canvas.height * y, { steps: 3 });
        return a.page.locator(".editor-pointer").filter({ hasText: "studio 2" }).count();
      },
      { timeout: 60_000, interval: 1500 },
    )
    .toBe(1);

  // A comment on the step is seen, answered and counted.
  const said = b.page.getByRole("region", { name: "Comments" });
  await said.getByLabel("Comment on this step").fill("Long enough for the glue?");
  await said.getByRole("button", { name: "Comment", exact: true }).click();
  await stepRow(a.page, "from b").getByText("1 comment").waitFor({ state: "attached" });
  await stepRow(a.page, "from b").click();
  await a.page.getByRole("article", { name: "Comment by studio 2" }).getByText("Long enough").waitFor();
  await a.page.screenshot({ path: picture("together") });

  // Without a connection both go on.
  await line.cut();
  await online(b.page, "offline");
  await add(b.page, "offline b");
  await add(a.page, "meanwhile a");
  await b.page.screenshot({ path: picture("together-offline") });
  line.mend();
  for (const { page } of [a, b]) {
    await stepRow(page, "offline b").waitFor();
    await stepRow(page, "meanwhile a").waitFor();
  }
  expect(await steps(a.page)).toEqual(await steps(b.page));

  // A page that is loaded again is in the same cell.
  await b.page.reload();
  await drawn(b.page);
  await stepRow(b.page, "meanwhile a").waitFor();
  await online(b.page, "online");

  // Whoever has the link looks.
  await a.page.evaluate(() => window.twincell.stores.dialogStore.setState({ open: "together" }));
  await dialog.getByRole("button", { name: "Copy the link" }).click();
  const link = await dialog.locator("code").innerText();
  await b.context.close();
  const c = await studio.open({ ...SIZE, query: new URL(link).search, before: patient });
  await drawn(c.page);
  await stepRow(c.page, "offline b").waitFor();
  await add(c.page, "from c");
  await c.page.getByText("You may look at this cell, and not change it.").first().waitFor();
  await c.page.screenshot({ path: picture("together-link") });
  await add(a.page, "last");
  await stepRow(c.page, "last").waitFor();
  expect(await steps(c.page)).not.toContain("from c");
  expect([a.problems, b.problems.filter(problem => !problem.includes("WebSocket")), c.problems]).toEqual([[], [], []]);
});
