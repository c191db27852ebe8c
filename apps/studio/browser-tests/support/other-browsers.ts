import { spawn, spawnSync, type ChildProcess } from "node:child_process";
import { existsSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import type { Readable } from "node:stream";

/** A browser that is not Chromium, driven by its own standard protocol. */
export interface OtherBrowser {
  readonly version: string;
  goto(url: string): Promise<void>;
  /** What an expression of the page is, as JSON. */
  evaluate<T>(expression: string): Promise<T>;
  /** Presses the middle of the first element that an expression of the page gives. */
  press(element: string): Promise<void>;
  screenshot(path: string): Promise<void>;
  close(): Promise<void>;
}
const FIREFOX = ["/usr/bin/firefox-esr", "/usr/bin/firefox"];
const START_MS = 60_000;

const has = (command: string): boolean => spawnSync("which", [command], { stdio: "ignore" }).status === 0;
const firefoxPath = (): string | undefined => FIREFOX.find(path => existsSync(path));
/** MiniBrowser lies beside the library, in the folder of the machine's architecture. */
function miniBrowserPath(): string | undefined {
  if (!existsSync("/usr/lib")) return undefined;
  return readdirSync("/usr/lib")
    .flatMap(folder => ["4.1", "4.0"].map(version => `/usr/lib/${folder}/webkit2gtk-${version}/MiniBrowser`))
    .find(path => existsSync(path));
}

/** What `npm run clients` installs is there. In CI it has to be: there a test that misses it fails. */
export const isMissing = (name: "firefox" | "webkit"): boolean =>
  process.env["CI"] === undefined &&
  (!has("Xvfb") || (name === "firefox" ? firefoxPath() : has("WebKitWebDriver") && miniBrowserPath()) === undefined);

/** A display that nobody looks at: without one these browsers have no WebGL. */
export class Display {
  readonly name: string;
  readonly #process: ChildProcess;
  private constructor(name: string, process: ChildProcess) {
    this.name = name;
    this.#process = process;
  }
  static async start(): Promise<Display> {
    const server = spawn("Xvfb", ["-displayfd", "3", "-screen", "0", "1400x1000x24", "-nolisten", "tcp"], {
      stdio: ["ignore", "ignore", "ignore", "pipe"],
    });
    return new Display(`:${await said(server, server.stdio[3] as Readable, /^(\d+)\s/, "Xvfb")}`, server);
  }
  stop(): void {
    this.#process.kill("SIGTERM");
  }
}

/** The first match of what a program writes. */
function said(program: ChildProcess, stream: Readable, pattern: RegExp, name: string): Promise<string> {
  return new Promise((resolve, reject) => {
    let text = "";
    const timer = setTimeout(() => {
      reject(new Error(`${name} did not start within ${START_MS / 1000} s: ${text.slice(-400)}`));
    }, START_MS);
    const end = (): void => {
      clearTimeout(timer);
    };
    stream.on("data", (part: Buffer) => {
      text += part.toString();
      const found = pattern.exec(text);
      if (!found) return;
      end();
      resolve(found[1]!);
    });
    program.once("error", problem => {
      end();
      reject(problem);
    });
    program.once("exit", code => {
      end();
      reject(new Error(`${name} ended with ${code ?? "a signal"}: ${text.slice(-400)}`));
    });
  });
}

/** Everything but this machine goes to a port that nobody listens on. */
const PREFERENCES = {
  "network.proxy.type": 1,
  "network.proxy.http": "127.0.0.1",
  "network.proxy.http_port": 9,
  "network.proxy.ssl": "127.0.0.1",
  "network.proxy.ssl_port": 9,
  "app.update.disabledForTesting": true,
  "browser.startup.page": 0,
  "browser.startup.homepage_override.mstone": "ignore",
  "browser.shell.checkDefaultBrowser": false,
  "datareporting.policy.dataSubmissionEnabled": false,
  "toolkit.telemetry.reportingpolicy.firstRun": false,
  "trailhead.firstrun.didSeeAboutWelcome": true,
  "termsofuse.bypassNotification": true,
  "browser.aboutwelcome.enabled": false,
  "network.captive-portal-service.enabled": false,
  "network.connectivity-service.enabled": false,
  "services.settings.server": "data:,#remote-settings-dummy/v1",
  "webgl.force-enabled": true,
};

interface BidiAnswer {
  readonly id?: number;
  readonly type: string;
  readonly result?: unknown;
  readonly message?: string;
}

/** Firefox over WebDriver BiDi. */
export async function startFirefox(display: Display): Promise<OtherBrowser> {
  const path = firefoxPath();
  if (path === undefined) throw new Error("Firefox is not there: `npm run clients` installs it.");
  const profile = mkdtempSync(join(tmpdir(), "twincell-firefox-"));
  const lines = Object.entries(PREFERENCES).map(
    ([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});`,
  );
  writeFileSync(join(profile, "user.js"), lines.join("\n"));
  const firefox = spawn(path, ["--no-remote", "--profile", profile, "--remote-debugging-port", "0", "about:blank"], {
    env: { ...process.env, DISPLAY: display.name, HOME: profile, MOZ_CRASHREPORTER_DISABLE: "1" },
    stdio: ["ignore", "ignore", "pipe"],
  });
  const address = await said(firefox, firefox.stderr, /WebDriver BiDi listening on (ws:\S+)/, "Firefox");
  const socket = new WebSocket(`${address}/session`);
  await new Promise<void>((resolve, reject) => {
    socket.addEventListener("open", () => {
      resolve();
    });
    socket.addEventListener("error", () => {
      reject(new Error("Firefox does not answer over WebDriver BiDi."));
    });
  });
  const waiting = new Map<number, (answer: BidiAnswer) => void>();
  socket.addEventListener("message", ({ data }) => {
    const answer = JSON.parse(String(data)) as BidiAnswer;
    if (answer.id === undefined) return;
    waiting.get(answer.id)?.(answer);
    waiting.delete(answer.id);
  });
  let last = 0;
  const call = <T>(method: string, params: object): Promise<T> =>
    new Promise((resolve, reject) => {
      const id = ++last;
      waiting.set(id, answer => {
        if (answer.type === "success") resolve(answer.result as T);
        else reject(new Error(`${method}: ${answer.message ?? "refused"}`));
      });
      socket.send(JSON.stringify({ id, method, params }));
    });
  const { capabilities } = await call<{ capabilities: { browserVersion: string } }>("session.new", {
    capabilities: {},
  });
  const { contexts } = await call<{ contexts: { context: string }[] }>("browsingContext.getTree", {});
  const { context } = contexts[0]!;
  await call("browsingContext.setViewport", { context, viewport: { width: 1280, height: 800 } });
  const evaluate = async <T>(expression: string): Promise<T> => {
    const answer = await call<{ type: string; result?: { value?: string }; exceptionDetails?: { text: string } }>(
      "script.evaluate",
      { expression: `JSON.stringify(${expression})`, target: { context }, awaitPromise: true },
    );
    if (answer.type !== "success") throw new Error(answer.exceptionDetails?.text ?? "The page threw.");
    return (answer.result?.value === undefined ? undefined : JSON.parse(answer.result.value)) as T;
  };
  return {
    version: `Firefox ${capabilities.browserVersion}`,
    goto: async url => {
      await call("browsingContext.navigate", { context, url, wait: "complete" });
    },
    evaluate,
    press: async element => {
      await call("input.performActions", { context, actions: [pressAt(await evaluate(middleOf(element)))] });
    },
    screenshot: async file => {
      const { data } = await call<{ data: string }>("browsingContext.captureScreenshot", { context });
      writeFileSync(file, Buffer.from(data, "base64"));
    },
    close: async () => {
      const gone = new Promise(resolve => firefox.once("exit", resolve));
      firefox.kill("SIGTERM");
      await gone;
      rmSync(profile, { recursive: true, force: true });
    },
  };
}

/** WebKitGTK over W3C WebDriver. */
export async function startWebKit(display: Display): Promise<OtherBrowser> {
  const browser = miniBrowserPath();
  if (browser === undefined) throw new Error("WebKitGTK is not there: `npm run clients` installs it.");
  const home = mkdtempSync(join(tmpdir(), "twincell-webkit-"));
  const port = 20_000 + (process.pid % 20_000);
  const driver = spawn("WebKitWebDriver", [`--port=${port}`], {
    env: {
      ...process.env,
      DISPLAY: display.name,
      HOME: home,
      XDG_DATA_HOME: join(home, "data"),
      XDG_CACHE_HOME: join(home, "cache"),
      GIO_USE_PROXY_RESOLVER: "dummy",
    },
    stdio: "ignore",
  });
  const call = async <T>(method: string, path: string, body?: object): Promise<T> => {
    const response = await fetch(
      `http://127.0.0.1:${port}${path}`,
      body ? { method, body: JSON.stringify(body) } : { method },
    );
    const { value } = (await response.json()) as { value: T };
    if (!response.ok) throw new Error(`${path}: ${JSON.stringify(value).slice(0, 400)}`);
    return value;
  };
  await until(() => call("GET", "/status"), "WebKitWebDriver");
  const made = await call<{ sessionId: string; capabilities: { browserVersion: string } }>("POST", "/session", {
    capabilities: {
      alwaysMatch: {
        browserName: "MiniBrowser",
        "webkitgtk:browserOptions": { binary: browser, args: ["--automation"] },
      },
    },
  });
  const session = `/session/${made.sessionId}`;
  await call("POST", `${session}/timeouts`, { script: START_MS, pageLoad: START_MS });
  await call("POST", `${session}/window/rect`, { width: 1300, height: 900 });
  const evaluate = async <T>(expression: string): Promise<T> => {
    const text = await call<string | null>("POST", `${session}/execute/sync`, {
      script: `return JSON.stringify(${expression})`,
      args: [],
    });
    return (text === null ? undefined : JSON.parse(text)) as T;
  };
  return {
    version: `WebKitGTK ${made.capabilities.browserVersion}`,
    goto: url => call("POST", `${session}/url`, { url }),
    evaluate,
    press: async element => {
      await call("POST", `${session}/actions`, { actions: [pressAt(await evaluate(middleOf(element)))] });
    },
    screenshot: async file => {
      writeFileSync(file, Buffer.from(await call<string>("GET", `${session}/screenshot`), "base64"));
    },
    close: async () => {
      await call("DELETE", session);
      const gone = new Promise(resolve => driver.once("exit", resolve));
      driver.kill("SIGTERM");
      await gone;
      rmSync(home, { recursive: true, force: true });
    },
  };
}

async function until(works: () => Promise<unknown>, name: string): Promise<void> {
  const began = Date.now();
  for (;;) {
    try {
      await works();
      return;
    } catch (problem) {
      if (Date.now() - began > START_MS) throw new Error(`${name} does not answer.`, { cause: problem });
      await new Promise(resolve => setTimeout(resolve, 50));
    }
  }
}

interface Place {
  readonly x: number;
  readonly y: number;
}
const middleOf = (element: string): string =>
  `(() => { const found = ${element}; if (!found) throw new Error("There is no such element."); found.scrollIntoView({ block: "nearest" }); const box = found.getBoundingClientRect(); return { x: Math.round(box.x + box.width / 2), y: Math.round(box.y + box.height / 2) }; })()`;
const pressAt = ({ x, y }: Place) => ({
  type: "pointer",
  id: "mouse",
  parameters: { pointerType: "mouse" },
  actions: [
    { type: "pointerMove", x, y, duration: 0, origin: "viewport" },
    { type: "pointerDown", button: 0 },
    { type: "pointerUp", button: 0 },
  ],
});
