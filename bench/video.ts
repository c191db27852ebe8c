import { CAMERA_FLAGS, drawn, type Page, Studio } from "../apps/studio/browser-tests/support/studio.ts";
import { figure, type Bench, type Figure } from "./figure.ts";

const ROUNDS = 3;
const COUNTED = 25;
const FILMS_THE_STUDIO =
  "navigator.mediaDevices.getUserMedia = () => navigator.mediaDevices.getDisplayMedia({ video: { frameRate: 30 } });";

/**
 * Glass to glass through a real server: the studio shows its time code, a page as a phone opens it films the studio's
 * page, and the picture that comes back is read, on one clock. Display, compositor, capture, packing and unpacking all
 * share this machine's processor here.
 */
export const run: Bench = async () => {
  const studio = await Studio.start(CAMERA_FLAGS);
  try {
    const { page, context } = await studio.open({ width: 1000, height: 640 });
    await drawn(page);
    await page.evaluate(() => {
      window.twincell.stores.viewStore.setState({ coachDone: true });
    });
    const phone = await context.newPage();
    await phone.addInitScript({ content: FILMS_THE_STUDIO });
    await phone.goto(`${studio.url}camera/?name=Phone`);
    await phone.getByRole("button", { name: "Show the picture" }).click();
    await page.evaluate(() => window.twincell.run("view.cameras"));
    await page.getByRole("button", { name: "Show: Phone" }).click();
    const rounds: Record<string, number>[] = [];
    for (let round = 0; round < ROUNDS; round++) rounds.push(await measured(page));
    const of = (name: string, what: string, note: string): Figure =>
      figure(
        `video/${name}`,
        "ms",
        rounds.map(each => each[what]!),
        note,
      );
    return [
      of(
        "glass-median",
        "median",
        `a change on the screen to the first picture that shows it; ${COUNTED} codes a round, everything drawn by the processor`,
      ),
      of("glass-p95", "p95", "95 % of the codes are within"),
      of("estimate", "estimate", "from the time stamps of every picture, without display and half a picture's period"),
      of("to-server", "to the server", "of it: camera's page to relay, the last picture of the round"),
      of("to-viewer", "to here", "of it: relay to studio, the last picture of the round"),
      of("unpack", "unpacked", "of it: JPEG to the panel, the last picture of the round"),
    ];
  } finally {
    await studio.stop();
  }
};

async function measured(page: Page): Promise<Record<string, number>> {
  await page.getByRole("button", { name: "Measure the latency" }).click();
  const dialog = page.getByRole("dialog", { name: /Measure the latency/ });
  await page.waitForFunction(
    least => Number(document.querySelector("[data-figure=n]")?.textContent) >= least,
    COUNTED,
    { timeout: 120_000, polling: 200 },
  );
  const figures = await dialog
    .locator("[data-figure]")
    .evaluateAll(all =>
      all.map(each => [(each as HTMLElement).dataset["figure"]!, Number.parseFloat(each.textContent ?? "")] as const),
    );
  await dialog.getByRole("button", { name: "Close", exact: true }).click();
  const stages = (await page.locator(".video-age").getAttribute("title")) ?? "";
  return Object.fromEntries([
    ...figures,
    ...[...stages.matchAll(/(to the server|to here|unpacked) (\d+) ms/g)].map(
      ([, name, ms]) => [name!, Number(ms)] as const,
    ),
  ]);
}
