import { createWorld, loadEngine, PhysicsRun, type MujocoWorld } from "@twincell/physics";
import { conveyorPalletCell, physicalScene, saveDocument, type CellDocument, type StepsCell } from "@twincell/project";
import { robotById } from "@twincell/core";
import { afterAll, beforeAll, describe, expect, test } from "vitest";
import type {} from "../src/console.ts";
import { drawn, picture, Studio, type Page } from "./support/studio.ts";

/** Few pixels: time passes with the frames of the page, and a processor that draws them is slow. */
const SMALL = { width: 820, height: 560 };
let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio?.stop();
});

/** The example with one box to fetch. */
function oneBox(): StepsCell {
  const cell = conveyorPalletCell();
  const program = cell.programs[0]!;
  const places = { ...program.pallets.places!, rows: 1, columns: 1 };
  return {
    ...cell,
    objects: cell.objects.filter(({ id }) => !/box-[2-9]/.test(id)),
    programs: [{ ...program, pallets: { places } }],
  };
}

interface Seen {
  readonly t_s: number;
  readonly q_rad: number[];
  readonly parts: number[];
}
/** Opens the cell and plays it with physics; every frame that was on screen is kept in the page. */
async function play(page: Page, cell: CellDocument): Promise<void> {
  await drawn(page);
  await page.evaluate(text => {
    window.twincell.document.open(text, "cell.json");
  }, saveDocument(cell));
  await page.waitForFunction(
    name => {
      const { cellStore, playStore } = window.twincell.stores;
      return cellStore.getState().document?.name === name && (playStore.getState().plan?.duration_s ?? 0) > 0;
    },
    cell.name,
    { timeout: 60_000 },
  );
  await page.evaluate(() => {
    const frames: Seen[] = [];
    let last: unknown = null;
    const keep = (): void => {
      const frame = window.twincell.live.physics();
      if (frame !== null && frame !== last) {
        last = frame;
        frames.push({ t_s: frame.t_s, q_rad: [...frame.q_rad], parts: [...frame.parts] });
      }
      requestAnimationFrame(keep);
    };
    keep();
    Object.assign(window, { physicsFrames: frames });
    window.twincell.run("play.physics");
    window.twincell.run("play.toggle");
  });
  await page.waitForFunction(() => window.twincell.stores.physicsStore.getState().t_s > 0.1, null, { timeout: 60_000 });
}
const until = (page: Page, status: string): Promise<unknown> =>
  page.waitForFunction(wanted => window.twincell.stores.physicsStore.getState().status === wanted, status, {
    timeout: 150_000,
    polling: 200,
  });
const framesOf = (page: Page): Promise<Seen[]> =>
  page.evaluate(() => (window as unknown as { physicsFrames: Seen[] }).physicsFrames);

describe("playing with physics", () => {
  test("loads the engine only when it is switched on; a box is fetched from the belt; the same numbers as in Node", async () => {
    const { page, problems } = await studio.open(SMALL);
    await drawn(page);
    const workers = (): string[] =>
      page
        .workers()
        .map(worker => worker.url())
        .filter(url => url.includes("physics.worker"));
    expect(workers()).toEqual([]);
    await play(page, oneBox());
    expect(workers().length).toBe(1);
    await until(page, "done");
    const said = await page.evaluate(() => window.twincell.stores.physicsStore.getState().said);
    expect(said).toEqual(
      expect.arrayContaining([
        "“Photo-cell” was tripped.",
        "“Box 1” is held.",
        "“Box 1” weighs 0.8 kg.",
        "The program has come to its end.",
      ]),
    );
    expect(await page.locator(".physics-state").textContent()).toBe("Done");
    // A slow page may not see a mark that lasts 30 ms; the log has them all, newest first.
    const marks = [...said].reverse().filter(sentence => sentence.includes("“Box 1”") && !sentence.includes("weighs"));
    expect(marks).toEqual([
      "The fingers touch “Box 1”.",
      "“Box 1” is held.",
      "The fingers touch “Box 1”.",
      "Nothing touches “Box 1”.",
    ]);
    const frames = await framesOf(page);
    const end = frames.at(-1)!;
    [0.47, 0.22, 0.23].forEach((wanted, k) => {
      expect(Math.abs(end.parts[k]! - wanted)).toBeLessThan(0.003);
    });
    await page.screenshot({ path: picture("physics-done") });

    // The same cell in Node, looked at when the page showed it: sines differ in their last bits, the engine does not.
    const document = oneBox();
    const program = document.programs[0]!;
    const answer = createWorld(await loadEngine(), physicalScene(document, robotById("ur10e")!, { program }));
    const world: MujocoWorld = answer.kind === "ready" ? answer.world : expect.fail(answer.why.sentence);
    const run = new PhysicsRun(world, program);
    const off = (frame: Seen): number => {
      while (world.state.time_s < frame.t_s - 1e-9) run.advance();
      return Math.max(
        ...frame.parts.map((value, i) => Math.abs(value - world.state.parts[i]!)),
        ...frame.q_rad.map((value, i) => Math.abs(value - world.state.q_rad[i]!)),
      );
    };
    const begun = frames.find(({ t_s }) => t_s > 0)!;
    expect(off(begun), `${begun.t_s} s`).toBeLessThan(1e-12);
    const drift = off(end);
    process.stderr.write(`Node and Chromium after ${end.t_s.toFixed(2)} s: ${drift.toExponential(1)}.\n`);
    expect(drift).toBeLessThan(1e-6);
    world.close();
    expect(problems).toEqual([]);
    await page.close();
  });

  test("T-57 a person in the zone stops the robot on screen; a click lets it go on; editing puts everything back", async () => {
    const { page, problems } = await studio.open(SMALL);
    const base = oneBox();
    const cell: CellDocument = {
      ...base,
      people: [
        {
          id: "ann",
          name: "Ann",
          path_m: [
            [2.2, -1.6],
            [1.1, 0.2],
            [2.2, 1.9],
          ],
          speed_mps: 1.4,
          starts_s: 0.5,
          height_m: 1.75,
        },
      ],
      zones: [
        {
          id: "zone",
          name: "Robot zone",
          outline_m: [
            [-1.3, -1.2],
            [1.3, -1.2],
            [1.3, 1],
            [-1.3, 1],
          ],
          reaction: { kind: "stop" },
        },
      ],
    };
    await play(page, cell);
    await until(page, "stopped");
    await page.screenshot({ path: picture("physics-stopped") });
    await page.waitForFunction(
      () => window.twincell.stores.physicsStore.getState().said[0]?.includes("left") === true,
      null,
      { timeout: 60_000 },
    );
    await page.getByRole("button", { name: "Let it go on" }).click();
    await until(page, "running");
    await page.evaluate(() => {
      window.twincell.run("play.physics");
    });
    expect(await page.evaluate(() => window.twincell.live.physics())).toBeNull();
    expect(problems).toEqual([]);
    await page.close();
  });

  test("on a phone the switch and what happens are in reach", async () => {
    const { page } = await studio.open({ width: 390, height: 844, touch: true });
    await play(page, oneBox());
    await page.evaluate(() => {
      window.twincell.stores.viewStore.setState({ sheet: "program" });
    });
    await page.screenshot({ path: picture("physics-phone") });
    expect(await page.locator(".physics").isVisible()).toBe(true);
    await page.close();
  });
});
