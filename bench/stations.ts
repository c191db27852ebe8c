import { spawn, type ChildProcess } from "node:child_process";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import { createClient, type Client } from "@twincell/protocol";
import { WebSocket } from "ws";
import { quantile } from "../apps/studio/browser-tests/support/ledger.ts";
import type { Page } from "../apps/studio/browser-tests/support/studio.ts";
import { figure, type Figure } from "./figure.ts";

/**
 * What benchmarks of stations share: controllers in processes of their own, a seat at the server, a page that looks at
 * it, one clock.
 */
export const nodeNow_ms = (): number => performance.timeOrigin + performance.now();

/** A virtual controller of that brand in a process of its own, on the vendor's ports. */
export function virtual(brand: string, host: string): Promise<ChildProcess> {
  const child = spawn(
    process.execPath,
    [fileURLToPath(new URL("../apps/cli/src/main.ts", import.meta.url)), "virtual", brand, "--host", host, "--json"],
    { stdio: ["pipe", "pipe", "inherit"] },
  );
  return new Promise((resolve, reject) => {
    createInterface({ input: child.stdout }).once("line", () => {
      resolve(child);
    });
    child.once("exit", code => {
      reject(new Error(`The virtual ${brand} ended with ${code ?? "a signal"}.`));
    });
  });
}

/** A seat at the stations of that server. `onText` hears everything as it comes. */
export async function joined(
  url: string,
  onText: (text: string) => void = () => undefined,
): Promise<{ readonly client: Client; readonly socket: WebSocket }> {
  const socket = new WebSocket(new URL("/stations", url.replace(/^http/, "ws")), { perMessageDeflate: false });
  const client = createClient(
    {
      send: text => {
        socket.send(text);
      },
      close: () => {
        socket.close();
      },
    },
    () => performance.now() / 1000,
    () => {
      /* Who wants more hears the texts. */
    },
  );
  socket.on("message", data => {
    const text = String(data as Buffer);
    onText(text);
    client.hear(text);
  });
  await new Promise((resolve, reject) => {
    socket.once("open", resolve);
    socket.once("error", reject);
  });
  return { client, socket };
}
/** Opens and connects a station there. */
export async function openAt(
  client: Client,
  station: string,
  brand: string,
  robot: string,
  host: string,
  ports?: Record<string, number>,
): Promise<void> {
  for (const outcome of [
    await client.ask({ type: "open", station, brand, robot, address: { host, ...(ports ? { ports } : {}) } }),
    await client.ask({ type: "connect", station }),
  ]) {
    if (outcome.kind !== "done") throw new Error(`${station}: ${outcome.why.sentence}`);
  }
}

/** The page asks for the server's stations when somebody first adds one. */
export async function lookAtStations(page: Page): Promise<void> {
  await page.evaluate(() => {
    window.twincell.stores.viewStore.setState({ coachDone: true });
  });
  await page.getByRole("radio", { name: "Run" }).click();
  await page.getByRole("button", { name: "Add a controller" }).first().click();
  await page.getByRole("dialog", { name: "Add a controller to the cell" }).waitFor();
  await page.keyboard.press("Escape");
}

/**
 * How far a clock is behind ours, by the quickest of many questions [ms]; off by at most half of that question's way.
 */
export async function clockBehind_ms(ask: () => Promise<number>): Promise<number> {
  let least_ms = Infinity;
  let offset_ms = 0;
  for (let i = 0; i < 100; i++) {
    const sent_ms = nodeNow_ms();
    const there_ms = await ask();
    const way_ms = nodeNow_ms() - sent_ms;
    if (way_ms < least_ms) {
      least_ms = way_ms;
      offset_ms = sent_ms + way_ms / 2 - there_ms;
    }
  }
  return offset_ms;
}
export const clockOf = (page: Page): Promise<number> => clockBehind_ms(() => page.evaluate(() => performance.now()));

export const late = (name: string, values: readonly number[], note: string): Figure => ({
  ...figure(name, "ms", values),
  median: quantile(values, 0.99),
  min: quantile(values, 0.5),
  max: quantile(values, 1),
  note: `99th percentile; min is the median, max the slowest; ${note}`,
});
