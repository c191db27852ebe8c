import { edgeTraceCell, saveDocument } from "@twincell/project";
import type { Page } from "playwright-core";
import { afterAll, beforeAll, beforeEach, describe, expect, test } from "vitest";
import type {} from "../src/console.ts";
import { Studio, type StudioPage } from "./support/studio.ts";

const GOOD = saveDocument(edgeTraceCell());
const changed = (change: (cell: Record<string, unknown>) => Record<string, unknown>): string =>
  JSON.stringify(change(JSON.parse(GOOD)));
const nested = (depth: number): string => `${"[".repeat(depth)}${"]".repeat(depth)}`;
/** The picture costs most where the processor draws it. */
const SMALL = { width: 920, height: 420 };

let studio: Studio;
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  await studio?.stop();
});

const ready = async (page: Page): Promise<Page> => {
  await page.waitForFunction(
    () => window.twincell !== undefined && window.twincell.stores.cellStore.getState().document !== null,
  );
  return page;
};
const kept = (page: Page): Promise<unknown> =>
  page.waitForFunction(() => window.twincell.stores.cellStore.getState().saving.kind === "saved");
const documentOf = (page: Page): Promise<string> =>
  page.evaluate(() => JSON.stringify(window.twincell.stores.cellStore.getState().document));
const nameOf = (page: Page): Promise<string | undefined> =>
  page.evaluate(() => window.twincell.stores.cellStore.getState().document?.name);
const notices = (
  page: Page,
): Promise<readonly { readonly tone: string; readonly sentence: string; readonly hint?: string }[]> =>
  page.evaluate(() => window.twincell.stores.noticeStore.getState().notices);
const forget = (page: Page): Promise<void> =>
  page.evaluate(() => window.twincell.stores.noticeStore.setState({ notices: [] }));
const waitForNotice = (page: Page, sentence: RegExp): Promise<unknown> =>
  page.waitForFunction(
    ([source, flags]) =>
      // A page that has only begun has nothing to say yet.
      window.twincell !== undefined &&
      window.twincell.stores.noticeStore
        .getState()
        .notices.some(notice => new RegExp(source, flags).test(notice.sentence)),
    [sentence.source, sentence.flags] as const,
  );
const rename = async (page: Page, name: string): Promise<void> => {
  await page.getByLabel("Name of the cell").fill(name);
  await page.keyboard.press("Enter");
};
/** The page does what it did before: the palette opens, and a point can be recorded and taken back. */
async function isAlive(page: Page): Promise<void> {
  await page.keyboard.press("Control+k");
  await page.getByRole("dialog").waitFor();
  await page.keyboard.press("Escape");
  await page.getByRole("dialog").waitFor({ state: "detached" });
  const before = await documentOf(page);
  expect(await page.evaluate(() => window.twincell.run("program.record-ptp"))).toBe(true);
  expect(await documentOf(page)).not.toBe(before);
  await page.evaluate(() => window.twincell.document.undo());
  expect(await documentOf(page)).toBe(before);
}

describe("a file that is not what it says", () => {
  let open: StudioPage;
  beforeAll(async () => {
    open = await studio.open(SMALL);
    await ready(open.page);
  });
  beforeEach(async () => {
    await forget(open.page);
  });

  const files: readonly (readonly [what: string, name: string, content: string | Uint8Array, says: RegExp])[] = [
    ["a cell cut off in the middle", "half.json", GOOD.slice(0, GOOD.length / 2), /not JSON/],
    ["an empty file", "empty.json", "", /not JSON/],
    ["a text", "letter.json", "Dear customer,", /not JSON/],
    [
      "a number that is none",
      "nan.json",
      GOOD.replace('"version": 1', '"version": NaN').replace('"version":1', '"version":NaN'),
      /not JSON/,
    ],
    [
      "a number beyond all numbers",
      "huge.json",
      changed(cell => ({
        ...cell,
        robot: { id: "staubli_rx90l", worldFromBase: { position: [0, 0, "BIG"], quaternion: [0, 0, 0, 1] } },
      })).replace('"BIG"', "1e999"),
      /robot\.worldFromBase\.position\[2\]/,
    ],
    ["another format", "other.json", changed(cell => ({ ...cell, format: "urdf" })), /"urdf"/],
    ["no version", "version.json", changed(cell => ({ ...cell, version: "one" })), /version/],
    ["a version to come", "future.json", changed(cell => ({ ...cell, version: 99 })), /version 99/],
    [
      "a robot nobody has",
      "robot.json",
      changed(cell => ({
        ...cell,
        robot: { id: "hal9000", worldFromBase: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] } },
      })),
      /hal9000/,
    ],
    ["100,000 brackets", "deep.json", nested(100_000), /deep\.json/],
    [
      "100,000 brackets where the format stands",
      "deep-format.json",
      GOOD.replace('"twincell.cell"', nested(100_000)),
      /deep-format\.json/,
    ],
    [
      "a mesh that is no mesh, in a cell",
      "mesh.json",
      changed(cell => ({
        ...cell,
        objects: [
          {
            id: "a",
            name: "a",
            role: "workpiece",
            worldFromObject: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
            color: "#ffffff",
            shape: { kind: "mesh", file: "a.stl", vertices: "!", triangles: "?" },
          },
        ],
      })),
      /objects\[0\]/,
    ],
    ["a mesh that is no mesh", "part.stl", "This is not a mesh.", /part\.stl/],
    [
      "a mesh cut off in the middle",
      "half.stl",
      Uint8Array.from({ length: 120 }, (_, i) => (i === 80 ? 200 : 1)),
      /half\.stl/,
    ],
    ["a kind nobody reads", "film.mp4", "x", /film\.mp4/],
  ];
  test.each(files)("%s is one sentence, and what was open stays open", async (_, name, content, says) => {
    const { page } = open;
    const before = await documentOf(page);
    await page
      .locator("[data-file-input]")
      .setInputFiles({ name, mimeType: "application/octet-stream", buffer: Buffer.from(content) });
    await page.waitForFunction(() => window.twincell.stores.noticeStore.getState().notices.length > 0);
    const told = await notices(page);
    expect(told).toHaveLength(1);
    expect(told[0]).toMatchObject({ tone: "bad" });
    expect(told[0]!.sentence).toMatch(says);
    expect(told[0]!.sentence).toMatch(/\.$/);
    expect(told[0]!.sentence.length).toBeLessThan(400);
    expect(told[0]!.sentence).not.toMatch(/undefined|\[object|NaN is|stack/);
    expect(await documentOf(page)).toBe(before);
    expect(open.problems).toEqual([]);
  });
  test("an empty and a compiled program file are one sentence, and what was open stays open", async () => {
    const { page } = open;
    const before = await documentOf(page);
    for (const [name, content, says] of [
      ["empty.src", "\r\n", /empty\.src is empty/],
      ["main.tp", Uint8Array.from([0, 1, 0, 2]), /main\.tp/],
      ["job.ls", Uint8Array.from([47, 0, 80, 0]), /job\.ls is a binary program/],
    ] as const) {
      await page.evaluate(() => window.twincell.stores.noticeStore.setState({ notices: [] }));
      await page
        .locator("[data-file-input]")
        .setInputFiles({ name, mimeType: "application/octet-stream", buffer: Buffer.from(content) });
      await page.waitForFunction(() => window.twincell.stores.noticeStore.getState().notices.length > 0);
      expect((await notices(page))[0]!.sentence).toMatch(says);
      expect(await documentOf(page)).toBe(before);
    }
  });
  test("V+ with a fault opens as it is, and the fault stands at its line", async () => {
    const { page } = open;
    const content = ".PROGRAM a()\nSPEED 50 ALWAYS\nMOVE #PPOINT(1,2,oops\n.END\n";
    await page
      .locator("[data-file-input]")
      .setInputFiles({ name: "fault.v2", mimeType: "application/octet-stream", buffer: Buffer.from(content) });
    const problem = page.getByRole("region", { name: "Problems" }).getByRole("button").first();
    await problem.waitFor();
    expect(await problem.textContent()).toMatch(/line 3$/);
    await page.evaluate(() => window.twincell.document.undo());
  });
  test("after all of them the page is alive", async () => {
    await isAlive(open.page);
  });

  test("V+ text with faults in the import dialog: line, column and sentence of each, and the text stays", async () => {
    const { page } = open;
    const before = await documentOf(page);
    const text = ".PROGRAM a()\nMOVE #PPOINT(1,2,3\nFLY home\n.END\n";
    await page.evaluate(() => window.twincell.run("export.import"));
    await page.getByRole("textbox", { name: "Program text" }).fill(text);
    const faults = page.getByRole("dialog").getByRole("alert").locator("li");
    await faults.first().waitFor();
    expect((await faults.allTextContents())[0]).toMatch(/^Line 2, column \d+: .+\.$/);
    expect(await page.getByRole("textbox", { name: "Program text" }).inputValue()).toBe(text);
    expect(await documentOf(page)).toBe(before);
    await page.keyboard.press("Escape");
    await page.getByRole("dialog").waitFor({ state: "detached" });
    await isAlive(page);
  });
});

describe("keeping", () => {
  test("a full disk is one sentence; nothing is lost, and when there is room again it is kept", async () => {
    const { page, context } = await studio.open({
      ...SMALL,
      script:
        "{const put=IDBObjectStore.prototype.put;window.diskFull=false;IDBObjectStore.prototype.put=function(...all){if(window.diskFull)throw new DOMException('full','QuotaExceededError');return put.apply(this,all)}}",
    });
    await ready(page);
    await page.evaluate(() => {
      Object.assign(window, { diskFull: true });
    });
    await rename(page, "Kept in mind");
    await waitForNotice(page, /^The browser has no room left to keep this cell\.$/);
    expect(await page.locator(".cellname-saving").textContent()).toContain("not saved");
    await rename(page, "Still kept in mind");
    await page.waitForFunction(() => window.twincell.stores.cellStore.getState().saving.kind === "problem");
    expect((await notices(page)).filter(notice => notice.tone === "bad")).toHaveLength(1);
    expect(await nameOf(page)).toBe("Still kept in mind");
    await isAlive(page);
    await page.evaluate(() => {
      Object.assign(window, { diskFull: false });
    });
    await rename(page, "Kept for good");
    await kept(page);
    await page.reload();
    await ready(page);
    expect(await nameOf(page)).toBe("Kept for good");
    await context.close();
  });

  test("a tab closed in the middle of a save opens again as it was before or after, never between", async () => {
    // The copy is written; the pointer to it never is.
    const { page, context } = await studio.open({
      ...SMALL,
      script:
        "{const put=IDBObjectStore.prototype.put;window.closing=false;window.copied=0;IDBObjectStore.prototype.put=function(value,key){if(window.closing&&key==='twincell.cell.current'){window.copied++;throw new DOMException('closed','AbortError')}return put.call(this,value,key)}}",
    });
    await ready(page);
    await rename(page, "Before");
    await kept(page);
    await page.evaluate(() => {
      Object.assign(window, { closing: true });
    });
    await rename(page, "After");
    await page.waitForFunction(() => Reflect.get(window, "copied") === 1);
    await page.close();
    const again = await context.newPage();
    await again.goto(studio.url);
    await ready(again);
    expect(await nameOf(again)).toBe("Before");
    expect((await notices(again)).filter(notice => notice.tone !== "info")).toEqual([]);
    // And a copy cut off in the middle: the other one opens, and it is said.
    await rename(again, "Whole");
    await kept(again);
    await again.evaluate(
      () =>
        new Promise<void>((done, lost) => {
          const opening = indexedDB.open("keyval-store");
          opening.onerror = () => lost(opening.error);
          opening.onsuccess = () => {
            const change = opening.result.transaction("keyval", "readwrite");
            const store = change.objectStore("keyval");
            change.oncomplete = () => done();
            change.onerror = () => lost(change.error);
            const pointer = store.get("twincell.cell.current");
            pointer.onsuccess = () => {
              const copy = store.get(String(pointer.result));
              copy.onsuccess = () => {
                store.put(String(copy.result).slice(0, 500), String(pointer.result));
              };
            };
          };
        }),
    );
    await again.reload({ waitUntil: "commit" });
    // What is said goes away by itself: it is looked for from the beginning.
    await Promise.all([waitForNotice(again, /earlier copy was opened\.$/), ready(again)]);
    expect(await nameOf(again)).toBe("Before");
    await isAlive(again);
    await context.close();
  });
});

describe("a browser that cannot do everything", () => {
  test("without WebGL the tree, the pendant, the program and the export work, and one sentence says what is missing", async () => {
    const { page, context } = await studio.open({
      ...SMALL,
      script:
        "{const get=HTMLCanvasElement.prototype.getContext;HTMLCanvasElement.prototype.getContext=function(kind,...more){return /webgl/.test(kind)?null:get.call(this,kind,...more)}}",
    });
    await ready(page);
    await page.locator(".scene-note[role=alert]").waitFor();
    expect(await page.locator(".scene-note").textContent()).toMatch(/3D view could not start/);
    await isAlive(page);
    await page.evaluate(() => window.twincell.stores.jogStore.setState({ frame: "joint" }));
    const revision = await page.evaluate(() => window.twincell.live.now().revision);
    await page.keyboard.down("s");
    await page.waitForFunction(before => window.twincell.live.now().revision > before, revision);
    await page.keyboard.up("s");
    await page.evaluate(() => window.twincell.run("program.record-ptp"));
    await page.keyboard.press("Control+e");
    await page.getByRole("region", { name: /edge_trace/ }).waitFor();
    await context.close();
  });

  test("a lost WebGL context leaves the page alive, and the picture comes back with it", async () => {
    const { page, context } = await studio.open(SMALL);
    await ready(page);
    await page.waitForFunction(() => (window.twincellScene?.frames ?? 0) > 0);
    await page.evaluate(() => {
      const canvas = document.querySelector<HTMLCanvasElement>(".viewport canvas");
      const gl = canvas?.getContext("webgl2")?.getExtension("WEBGL_lose_context");
      Object.assign(window, { bringBack: () => gl?.restoreContext() });
      gl?.loseContext();
    });
    await page.waitForFunction(
      () =>
        document.querySelector<HTMLCanvasElement>(".viewport canvas")?.getContext("webgl2")?.isContextLost() === true,
    );
    await isAlive(page);
    const frames = await page.evaluate(() => {
      Reflect.apply(Reflect.get(window, "bringBack"), window, []);
      return window.twincellScene?.frames ?? 0;
    });
    await page.waitForFunction(
      () =>
        document.querySelector<HTMLCanvasElement>(".viewport canvas")?.getContext("webgl2")?.isContextLost() === false,
    );
    await page.evaluate(() => window.twincell.run("jog.zero"));
    await page.waitForFunction(before => (window.twincellScene?.frames ?? 0) > before, frames);
    await context.close();
  });
});

test("STOP: a part that throws is named, and everything else is still brought to rest", async () => {
  const { page, context } = await studio.open(SMALL);
  await ready(page);
  await page.evaluate(() => {
    const { live, run, stores } = window.twincell;
    live.showJoints([0.3, -1.2, 1.9, 0.2, 0.6, 0]);
    run("program.record-ptp");
    live.showJoints([-0.3, -1.0, 1.7, 0.2, 0.8, 0]);
    run("program.record-ptp");
    stores.controlStore.setState({ message: "" });
  });
  await page.waitForFunction(() => (window.twincell.stores.playStore.getState().plan?.segments.length ?? 0) >= 2);
  await page.evaluate(() => {
    window.twincell.run("play.toggle");
    window.twincell.stores.playStore.subscribe((now, before) => {
      if (before.playing && !now.playing) throw new Error("A planted trouble.");
    });
  });
  await page.waitForFunction(() => window.twincell.stores.playStore.getState().t_s > 0);
  await page.locator("button.stop").dispatchEvent("pointerdown", { button: 0 });
  await waitForNotice(page, /did not answer to STOP: A planted trouble\.$/);
  await waitForNotice(page, /^Everything was stopped\.$/);
  // The virtual controller registered after the playhead: it was still asked.
  await page.waitForFunction(() => /stopped/.test(window.twincell.stores.controlStore.getState().message));
  const at = await page.evaluate(() => [...window.twincell.live.now().q_rad]);
  await page.evaluate(
    () =>
      new Promise<void>(done => {
        let left = 6;
        const next = (): void => {
          if (left-- <= 0) done();
          else requestAnimationFrame(next);
        };
        next();
      }),
  );
  expect(await page.evaluate(() => [...window.twincell.live.now().q_rad])).toEqual(at);
  await isAlive(page);
  await context.close();
});
