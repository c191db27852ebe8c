import { spawn, type ChildProcess } from "node:child_process";
import { existsSync, mkdirSync } from "node:fs";
import { fileURLToPath } from "node:url";
import type {} from "../../src/console.ts";
import type {} from "../../src/scene/scene-probe.tsx";
import { chromium, type Browser, type BrowserContext, type Page } from "playwright-core";
import { onTestFinished, TestRunner } from "vitest";
import { deviceScript, type EmulatedDevice } from "./headset-devices.ts";
export type { Page };

const root = fileURLToPath(new URL("../../../../", import.meta.url));
const PLACES = [process.env["TWINCELL_CHROMIUM"], "/usr/bin/chromium", "/usr/bin/google-chrome"];
const FLAGS = [
  "--headless=new",
  "--no-sandbox",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--disable-quic",
  "--ignore-gpu-blocklist",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--autoplay-policy=no-user-gesture-required",
];

/**
 * A camera that films the studio itself: the browser captures the page of that title, as a phone before the screen
 * would, so that what the studio shows comes back in the picture. `getUserMedia` takes the browser's made-up camera.
 */
export const CAMERA_FLAGS = [
  "--auto-select-tab-capture-source-by-title=Twincell",
  "--use-fake-device-for-media-stream",
];

export interface OpenOptions {
  readonly width?: number;
  readonly height?: number;
  readonly theme?: "dark" | "light";
  /** The language that the browser prefers: "de-AT". */
  readonly locale?: string;
  readonly touch?: boolean;
  /** Installs an emulated headset before the page starts: a Quest 3, or the one that is named. */
  readonly headset?: boolean | "oculusQuest1" | "metaQuest2" | "metaQuestPro" | EmulatedDevice;
  /** Each eye has its own half of the display; otherwise, as the emulator does, the left eye has all of it. */
  readonly bothEyes?: boolean;
  /** The page may keep itself for use without a network; every other test asks the server for everything. */
  readonly offline?: boolean;
  /** Added to the page before it starts. */
  readonly script?: string;
  readonly query?: string;
  /** Called with the page while it is still empty. */
  readonly before?: (page: Page) => void;
}

/** The studio as users get it: served by the command line, shown by a real Chromium. */
export class Studio {
  readonly url: string;
  private readonly server: ChildProcess;
  private readonly browser: Browser;

  private constructor(url: string, server: ChildProcess, browser: Browser) {
    this.url = url;
    this.server = server;
    this.browser = browser;
  }

  /** What the server has written so far. */
  said = "";

  static async start(flags: readonly string[] = [], serve: readonly string[] = []): Promise<Studio> {
    const executablePath = PLACES.find(path => path !== undefined && existsSync(path));
    if (executablePath === undefined) throw new Error("No Chromium was found; set TWINCELL_CHROMIUM to its path.");
    const server = spawn(process.execPath, ["apps/cli/src/main.ts", "serve", "--port", "0", ...serve], {
      cwd: root,
      stdio: ["ignore", "pipe", "inherit"],
    });
    let text = "";
    const url = await new Promise<string>((resolve, reject) => {
      server.stdout.on("data", (part: Buffer) => {
        text += part.toString();
        const found = /https?:\/\/\S+/.exec(text);
        if (found) resolve(found[0]);
      });
      server.once("exit", code => {
        reject(new Error(`twincell serve ended with ${code ?? "a signal"}.`));
      });
    });
    const browser = await chromium.launch({ executablePath, headless: true, args: [...FLAGS, ...flags] });
    const studio = new Studio(url, server, browser);
    studio.said = text;
    server.stdout.on("data", (part: Buffer) => (studio.said += part.toString()));
    return studio;
  }

  /**
   * A fresh person: nothing stored, no permission given. What a test opens closes with it, since a page that nobody
   * looks at goes on drawing and takes the time of the next test; what `beforeAll` opens stays for all of them.
   */
  async open(options: OpenOptions = {}): Promise<StudioPage> {
    const context = await this.browser.newContext({
      viewport: { width: options.width ?? 1280, height: options.height ?? 800 },
      hasTouch: options.touch ?? false,
      isMobile: options.touch ?? false,
      acceptDownloads: true,
      serviceWorkers: options.offline === true ? "allow" : "block",
      colorScheme: options.theme ?? "dark",
      locale: options.locale ?? "en-US",
    });
    if (TestRunner.getCurrentTest() !== undefined) onTestFinished(() => context.close());
    const page = await context.newPage();
    const problems: string[] = [];
    page.on("pageerror", problem => problems.push(problem.message));
    page.on("console", message => {
      if (message.type() === "error") problems.push(message.text());
    });
    page.on("request", request => {
      if (!request.url().startsWith(this.url) && !/^(data|blob):/.test(request.url()))
        problems.push(`The page asked for ${request.url()}.`);
    });
    if (options.headset) {
      await page.addInitScript({ path: `${root}node_modules/iwer/build/iwer.min.js` });
      const { headset } = options;
      const own = typeof headset === "object";
      const made = own ? "window.makeDevice()" : `new IWER.XRDevice(IWER.${headset === true ? "metaQuest3" : headset})`;
      if (own) await page.addInitScript({ content: deviceScript(headset) });
      await page.addInitScript({
        content: `{const d=${made};d.stereoEnabled=${options.bothEyes === true};d.installRuntime({forceInstall:true});d.position.set(0,1.6,0);window.xrDevice=d;
        // The emulator shows the page's own canvas in its own frame: let the picture fill it.
        addEventListener("DOMContentLoaded",()=>document.head.append(Object.assign(document.createElement("style"),{textContent:"[data-webxr_runtime]{background:#000}[data-webxr_runtime] canvas{position:absolute!important;inset:0!important;width:100%!important;height:100%!important}"})))}`,
      });
    }
    if (options.script) await page.addInitScript({ content: options.script });
    options.before?.(page);
    await page.goto(this.url + (options.query ?? ""));
    return { page, context, problems };
  }

  /** The server goes, the browser stays. */
  stopServer(): void {
    this.server.kill("SIGTERM");
  }

  async stop(): Promise<void> {
    await this.browser.close();
    this.server.kill("SIGTERM");
  }
}

/** Resolves when the cell is on screen: document open, geometry drawn. */
export async function drawn(page: Page): Promise<void> {
  await page.waitForFunction(
    () => window.twincell.stores.cellStore.getState().document !== null && (window.twincellScene?.frames ?? 0) > 1,
    null,
    { timeout: 60_000, polling: 100 },
  );
}

export interface StudioPage {
  readonly page: Page;
  readonly context: BrowserContext;
  readonly problems: string[];
}

/** Where a picture of the test goes, to be looked at. */
export function picture(name: string): string {
  mkdirSync(`${root}out/screenshots`, { recursive: true });
  return `${root}out/screenshots/${name}.png`;
}
