import { spawn, type ChildProcess } from "node:child_process";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { setTimeout as pause } from "node:timers/promises";
import { identity, type MoveStep, type Pose } from "@twincell/core";
import { readConnectionEvent, type EventOf } from "@twincell/protocol";
import { saveDocument, tracedCartonCell } from "@twincell/project";
import type { BrowserContext, Page } from "playwright-core";
import { afterAll, beforeAll, expect, test } from "vitest";
import { picture, Studio } from "./support/studio.ts";

const root = fileURLToPath(new URL("../../../", import.meta.url));
const HOST = "127.0.0.61";
/** In front of the arm, the flange looking down. */
const to = (id: string, x: number, y: number, z: number): MoveStep => ({
  id,
  type: "move",
  path: "ptp",
  speed: { ratio: 0.2 },
  blend_m: 0,
  target: {
    pose: { position: [x, y, z], quaternion: [0, 1, 0, 0] } as unknown as Pose<"frame", "tcp">,
    frame: "world",
    tool: "flange",
  },
});
declare global {
  interface Window {
    notices: string[];
  }
}
interface Said {
  readonly pendant: string;
  readonly ports: Readonly<Record<string, number>>;
}

/**
 * The studio's own 3D view is drawn by the processor here, which the signs of life of two pages and three processes
 * need.
 */
const NO_PICTURE =
  "{const get=HTMLCanvasElement.prototype.getContext;HTMLCanvasElement.prototype.getContext=function(kind,...more){return /webgl/.test(kind)?null:get.call(this,kind,...more)}}";
const EXPECTED = /WebGL/;

let studio: Studio;
const children: ChildProcess[] = [];
beforeAll(async () => {
  studio = await Studio.start();
});
afterAll(async () => {
  for (const child of children) child.kill("SIGTERM");
  await studio.stop();
});

/** `twincell virtual BRAND` as a process of its own. */
async function virtual(brand: string, host: string): Promise<Said> {
  const child = spawn(process.execPath, ["apps/cli/src/main.ts", "virtual", brand, "--host", host, "--json"], {
    cwd: root,
    stdio: ["pipe", "pipe", "inherit"],
  });
  children.push(child);
  const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
  return JSON.parse((await lines.next()).value as string) as Said;
}
async function pendantPage(
  context: BrowserContext,
  url: string,
): Promise<{ readonly page: Page; readonly problems: string[] }> {
  const page = await context.newPage();
  const problems: string[] = [];
  page.on("pageerror", problem => problems.push(problem.message));
  page.on("console", message => {
    if (message.type() === "error") problems.push(message.text());
  });
  await page.goto(url);
  await page.getByRole("button", { name: "Enabling switch" }).waitFor();
  return { page, problems };
}
/** Presses and holds with the mouse until `let go`. */
async function press(page: Page, name: string): Promise<void> {
  const box = (await page.getByRole("button", { name, exact: true }).boundingBox())!;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
}
/**
 * Jogs with the enabling switch held until that is so, as a person does: where the page is kept from its signs of life
 * for 80 ms, the jog is over, and the keys are pressed again.
 */
async function jogUntil(page: Page, name: string, so: () => boolean | Promise<boolean>): Promise<void> {
  for (let tries = 0; tries < 40; tries++) {
    await page.keyboard.down("e");
    await press(page, name);
    const says = page.locator(".desk-says");
    await pause(200);
    for (let looks = 0; looks < 200; looks++) {
      if (await so()) return;
      if (!(await says.innerText()).includes("is jogged")) break;
    }
    await letGo(page);
  }
  throw new Error(`${name} was pressed forty times: ${await page.locator(".desk-complaint").innerText()}`);
}
async function letGo(page: Page): Promise<void> {
  await page.mouse.up();
  await page.keyboard.up("e");
}
/**
 * Runs the program there with the enabling switch held, until that is so. A machine that kept the link from being heard
 * has it confirmed first, as a person would.
 */
async function runFromStudio(page: Page, so: () => boolean | Promise<boolean>): Promise<void> {
  await page.bringToFront();
  const run = page.getByRole("button", { name: "Run here" });
  const goOn = page.getByRole("button", { name: "Resume" });
  const holding = page.getByRole("button", { name: "Hold to move" });
  const said: string[] = [];
  for (let tries = 0; tries < 40; tries++) {
    said.push((await page.locator(".station").innerText()).replaceAll("\n", " "));
    if ((await goOn.count()) > 0) await goOn.dispatchEvent("click");
    if ((await run.count()) > 0 && (await run.isEnabled()) && (await holding.count()) > 0) {
      await holding.hover();
      await page.mouse.down();
      await run.dispatchEvent("click");
      for (let looks = 0; looks < 40; looks++) {
        if (await so()) return;
        await pause(50);
      }
      await page.mouse.up();
    }
    await pause(300);
  }
  throw new Error(`The program was started forty times: ${said.join(" | ")}`);
}
const degreesOn = async (page: Page, joint: number): Promise<number> =>
  parseFloat(
    await page
      .locator(".desk-jog .axis-value")
      .nth(joint - 1)
      .innerText(),
  );
/** What the page shows of the joints, when it does not change any more. */
async function atRest(page: Page): Promise<number[]> {
  const read = (): Promise<number[]> =>
    page
      .locator(".desk-jog .axis-value")
      .allInnerTexts()
      .then(texts => texts.map(parseFloat));
  let before = await read();
  for (;;) {
    // Longer than from one read-out to the next: two that are alike are not the same one looked at twice.
    await page.waitForTimeout(150);
    const now = await read();
    if (now.every((value, i) => value === before[i])) return now;
    before = now;
  }
}
/** What the server's station tells everybody: the twin, as any page has it. */
class Listener {
  private readonly socket: WebSocket;
  private last: EventOf<"sample"> | null = null;
  constructor(url: string) {
    this.socket = new WebSocket(new URL("/stations", url.replace(/^http/, "ws")));
    this.socket.addEventListener("message", ({ data }: MessageEvent<string>) => {
      const heard = readConnectionEvent(data);
      if (heard.kind === "read" && heard.message.type === "sample") this.last = heard.message;
    });
  }
  get now() {
    return { ...this.last!, q_deg: this.last!.q_rad.map(q => (q * 180) / Math.PI) };
  }
  async until(so: (sample: EventOf<"sample">) => boolean, what: string): Promise<void> {
    for (const end_ms = performance.now() + 15_000; !this.last || !so(this.last); ) {
      if (performance.now() > end_ms) throw new Error(`The twin is never ${what}: ${JSON.stringify(this.last)}`);
      await pause(5);
    }
  }
  close(): void {
    this.socket.close();
  }
}
const farthest = (a: readonly number[], b: readonly number[]): number =>
  Math.max(...a.map((q, i) => Math.abs(q - b[i]!)));

test("T-26 T-27 X-41 a virtual UR as a process, a station at its address, its pendant in a second tab: by hand, somebody near, red button, lost tab", async () => {
  const said = await virtual("ur", HOST);
  const { page, context, problems } = await studio.open({ width: 1280, height: 720, script: NO_PICTURE });
  context.setDefaultTimeout(90_000);
  await page.waitForFunction(() => window.twincell.stores.cellStore.getState().document !== null, null, {
    timeout: 60_000,
  });
  const carton = tracedCartonCell();
  const cell = {
    ...carton,
    name: "Pendant",
    robot: { ...carton.robot, worldFromBase: identity() },
    objects: [],
    frames: [],
    program: "To and fro",
    programs: [
      {
        ...carton.programs[0]!,
        name: "To and fro",
        tools: {},
        frames: {},
        groups: {},
        steps: [to("a", 0.55, -0.4, 0.4), to("b", 0.55, 0.4, 0.4), to("c", 0.55, -0.4, 0.4)],
      },
    ],
  } as typeof carton;
  await page.evaluate(text => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
    return window.twincell.document.open(text, "cell.json");
  }, saveDocument(cell));
  await page.getByRole("radio", { name: "Run" }).click();
  await page.getByRole("button", { name: "Add a controller" }).first().click();
  const dialog = page.getByRole("dialog", { name: "Add a controller to the cell" });
  await dialog.getByRole("combobox", { name: "Manufacturer" }).click();
  await page.getByRole("option", { name: "Universal Robots" }).click();
  await dialog.getByRole("radio", { name: "On the network" }).click();
  await dialog.getByLabel("Address").fill(HOST);
  await dialog.getByRole("button", { name: "Add and connect" }).click();
  await dialog.waitFor({ state: "detached", timeout: 30_000 });
  await page.waitForFunction(
    () => window.twincell.stores.stationStore.getState().stations[0]?.link.state === "open",
    null,
    { timeout: 20_000 },
  );
  // A machine that stalls has other things to say in between: what was refused is looked for among all of them.
  await page.evaluate(() => {
    window.notices = [];
    window.twincell.stores.stationStore.subscribe(({ stations: [station] }) => {
      if (station && station.notice !== "") window.notices.push(station.notice);
    });
  });
  const twin = new Listener(studio.url);

  const desk = await pendantPage(context, said.pendant);
  const hand = desk.page;
  await hand
    .getByText(/\d connections?/)
    .first()
    .waitFor();
  // The key is in REMOTE: the jog keys do nothing, and the page says so.
  expect(await hand.getByRole("radio", { name: "Remote" }).getAttribute("data-state")).toBe("on");
  await hand.getByRole("radio", { name: "Local, manual" }).click();
  await hand.getByText("Hold the enabling switch, then a jog key.").waitFor();
  await press(hand, "Jog J1 up");
  await hand.getByText("The enabling switch is not pressed.").waitFor();
  await hand.mouse.up();

  // T-26: by hand; the twin follows; what the studio commands is refused.
  const before = await degreesOn(hand, 1);
  let wasMoving = false;
  await jogUntil(hand, "Jog J1 up", async () => {
    wasMoving ||= twin.now.moving && twin.now.mode === "manual";
    return wasMoving && (await degreesOn(hand, 1)) > before + 5;
  });
  await hand.screenshot({ path: picture("pendant-jogging") });
  await letGo(hand);
  const jogged = await atRest(hand);
  expect(jogged[0]).toBeGreaterThan(before + 5);
  expect(twin.now).toMatchObject({ mode: "manual", moving: false });
  expect(farthest(twin.now.q_deg, jogged)).toBeLessThanOrEqual(0.0051);
  await runFromStudio(page, async () => /manual|remote control/.test(await page.evaluate(() => window.notices.join())));
  await page.mouse.up();
  expect(farthest(twin.now.q_deg, jogged)).toBeLessThanOrEqual(0.0051);
  await page.screenshot({ path: picture("pendant-twin-follows") });

  // the tab is lost while a key is held.
  await hand.bringToFront();
  await jogUntil(hand, "Jog J1 down", () => twin.now.moving);
  const closed_ms = performance.now();
  const held = twin.now.q_deg;
  await hand.close();
  await twin.until(({ moving }) => !moving, "at rest after the tab was lost");
  const took_ms = performance.now() - closed_ms;
  console.info(
    `The tab was closed while jogging: the twin stands ${took_ms.toFixed(0)} ms after the order to close it.`,
  );
  expect(farthest(twin.now.q_deg, held)).toBeLessThan(15);
  const stood = twin.now.q_deg;
  await pause(500);
  expect(twin.now.q_deg).toEqual(stood);

  // T-27: somebody near the robot in the middle of a move from the studio.
  const again = await pendantPage(context, said.pendant);
  const { page: second } = again;
  await second.getByRole("radio", { name: "Remote" }).click();
  await twin.until(({ mode }) => mode !== "manual", "in remote control");
  await runFromStudio(page, () => twin.now.moving);
  await second.getByRole("button", { name: "Somebody near the robot" }).click();
  await twin.until(({ safety, moving }) => safety === "guard-stop" && !moving, "stopped by the sensor");
  const halted = await atRest(second);
  expect(farthest(twin.now.q_deg, halted)).toBeLessThanOrEqual(0.0051);
  await page.mouse.up();
  await second.getByText("The safeguard is open.").waitFor();
  await second.screenshot({ path: picture("pendant-somebody-near") });

  // The red button, and the way out.
  await second.bringToFront();
  await second.getByRole("button", { name: "Somebody near the robot" }).click();
  await second.getByRole("button", { name: "Press the red button" }).click();
  await twin.until(({ safety }) => safety === "emergency-stop", "in emergency stop");
  await second.screenshot({ path: picture("pendant-red-button") });
  await second.getByRole("button", { name: "Turn the red button out" }).click();
  await second.getByRole("button", { name: /Power and brakes/ }).click();
  await second.waitForFunction(() => document.querySelector(".servo-state")?.textContent === "on", null, {
    timeout: 10_000,
  });
  await second.getByRole("button", { name: "digital_in_2", exact: true }).click();
  await second.waitForFunction(() => document.querySelectorAll('.line[aria-pressed="true"]').length === 1, null, {
    timeout: 5_000,
  });
  twin.close();
  expect([...problems, ...desk.problems, ...again.problems].filter(problem => !EXPECTED.test(problem))).toEqual([]);
}, 300_000);

test("the pendant's page on a desk and on a phone, in both themes: everything within the width, keys as large as thumbs", async () => {
  for (const [brand, host] of [
    ["kuka", "127.0.0.62"],
    ["yaskawa", "127.0.0.63"],
    ["fanuc", "127.0.0.64"],
    ["abb", "127.0.0.65"],
  ] as const) {
    const said = await virtual(brand, host);
    for (const [theme, width, height] of [
      ["dark", 1280, 720],
      ["light", 390, 844],
    ] as const) {
      const { page, context } = await studio.open({ width, height, theme, touch: width < 800 });
      const { page: hand } = await pendantPage(context, said.pendant);
      await page.close();
      await hand.locator('.desk[data-connected="true"] .arm-paint').first().waitFor();
      await hand.evaluate(() => document.fonts.ready.then(() => null));
      await hand.screenshot({ path: picture(`pendant-${brand}-${theme}-${width}`) });
      expect(await hand.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${brand} ${width}`).toBe(
        true,
      );
      // No part is squeezed below what it holds, so that it lies on the next; the enabling switch alone floats, where a
      // thumb finds it.
      const laps = await hand.evaluate(() =>
        [...document.querySelectorAll<HTMLElement>(".desk, .desk > *")]
          .filter(part => getComputedStyle(part).overflowY === "visible" && part.scrollHeight > part.clientHeight + 2)
          .map(part => `${part.className}: ${part.scrollHeight} in ${part.clientHeight}`),
      );
      expect(laps, `${brand} ${width}`).toEqual([]);
      const small = await hand.evaluate(
        touch =>
          [...document.querySelectorAll<HTMLElement>(".desk button")]
            .filter(button => {
              const { height: h } = button.getBoundingClientRect();
              return h > 0 && h < touch;
            })
            .map(button => `${button.textContent || button.ariaLabel} ${button.getBoundingClientRect().height}`),
        width < 800 ? 44 : 24,
      );
      expect(small).toEqual([]);
      await context.close();
    }
    children.pop()!.kill("SIGTERM");
  }
}, 120_000);
