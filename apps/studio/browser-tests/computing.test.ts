import type { Program } from "@twincell/core";
import { saveDocument, tracedCartonCell, type CellDocument } from "@twincell/project";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { drawn, picture, Studio } from "./support/studio.ts";

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio.stop();
});

const cell = tracedCartonCell();
const program = cell.programs[0] as Program;
const short: CellDocument = {
  ...cell,
  programs: [
    {
      ...program,
      groups: {},
      signals: { part: { kind: "digital-in", address: 1001 } },
      steps: program.steps.slice(0, 1),
    },
  ],
};
const theProgram = (page: Page): Promise<Program> =>
  page.evaluate(() => window.twincell.stores.cellStore.getState().document!.programs[0] as Program);
async function add(page: Page, item: string): Promise<void> {
  await page.getByRole("button", { name: "Add a step" }).click();
  await page.getByRole("menuitem", { name: item }).click();
}

test("assignments, loops and waits with a limit are added and typed; a mistake is shown at its place and changes nothing", async () => {
  const { page, problems } = await studio.open();
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    return window.twincell.document.open(text, "cell.json");
  }, saveDocument(short));

  await add(page, "Add: assign a variable");
  const value = page.getByRole("textbox", { name: "Value", exact: true });
  await expect.poll(() => value.inputValue()).toBe("count + 1");
  await value.fill("count + 40 mm");
  const alert = page.getByRole("alert").filter({ hasText: "one unit" });
  await alert.waitFor();
  await page.screenshot({ path: picture("computing") });
  await value.press("Enter");
  expect((await theProgram(page)).steps.at(-1)).toMatchObject({ to: { op: "+", of: [{ variable: "count" }, 1] } });
  await value.fill("count + 2");
  await value.press("Enter");
  await expect
    .poll(async () => (await theProgram(page)).steps.at(-1))
    .toMatchObject({ type: "assign", variable: "count", to: { op: "+", of: [{ variable: "count" }, 2] } });

  await add(page, "Add: while …");
  const condition = page.getByRole("textbox", { name: "Condition", exact: true });
  await expect.poll(() => condition.inputValue()).toBe("part");
  await condition.fill("count < 9 and not part");
  await condition.press("Enter");
  await page.getByText("While count < 9 and not part").first().waitFor();

  // Into the loop, which is selected.
  await add(page, "Add: wait for a signal");
  await page
    .getByRole("radio", { name: "limited" })
    .or(page.getByRole("button", { name: "limited" }))
    .first()
    .click();
  await page
    .getByRole("radio", { name: "do steps" })
    .or(page.getByRole("button", { name: "do steps" }))
    .first()
    .click();
  await add(page, "Add: comment");
  expect(await theProgram(page)).toMatchObject({
    variables: { count: { type: "int" } },
    steps: [
      {},
      { type: "assign" },
      {
        type: "while",
        when: {
          expression: {
            op: "and",
            of: [
              { op: "<", of: [{ variable: "count" }, 9] },
              { op: "not", of: [{ signal: "part" }] },
            ],
          },
        },
        steps: [{ type: "wait-for", when: { signal: "part", is: true }, timeout_s: 5, late: [{ type: "comment" }] }],
      },
    ],
  });
  // Comment, late steps, limit, wait, condition, loop, value: one undo each, down to the first assignment.
  for (let i = 0; i < 7; i++) await page.keyboard.press("Control+z");
  await expect.poll(async () => (await theProgram(page)).steps.map(({ type }) => type)).toEqual(["move", "assign"]);
  expect(problems).toEqual([]);
});
