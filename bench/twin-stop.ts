import type { ChildProcess } from "node:child_process";
import { connect, createServer, type Server } from "node:net";
import { setTimeout as pause } from "node:timers/promises";
import { ledger, quantile } from "../apps/studio/browser-tests/support/ledger.ts";
import { drawn, Studio } from "../apps/studio/browser-tests/support/studio.ts";
import type { Bench, Figure } from "./figure.ts";
import { clockOf, joined, late, lookAtStations, nodeNow_ms, openAt, virtual } from "./stations.ts";

const SECONDS = Number(process.env["TWINCELL_BENCH_S"] ?? 10);
const HOST = "127.0.0.51";
const RTDE_PORT = 30_004;
/** Controllers whose whole process stands still, again and again: their sockets take nothing and say nothing [ms]. */
const STALLED = [
  ["yaskawa", "127.0.0.52", "yaskawa_gp8"],
  ["kuka", "127.0.0.53", "kuka_kr6r900sixx"],
  ["fanuc", "127.0.0.54", "fanuc_lrmate200id"],
] as const;
const STALL_MS = 2000;
const BREATH_MS = 500;
/** A frame of RTDE with data that is longer than a heartbeat is an order; a stop is one [bytes]. */
const DATA = 85;
const HEARTBEAT = 16;

/**
 * From the stop that somebody asks for to the stop on the controller's wire, on real sockets of loopback: a message at
 * the stations' socket, and STOP in the page. The server, the controllers and this process are processes of their own;
 * the wire is seen by a relay in front of the controller. Beside it the same while three other drivers' controllers
 * stand still for two seconds at a time.
 */
export const stopLate: Bench = async () => {
  const children: ChildProcess[] = [];
  const wire = await relay();
  const line = { lost: 0 };
  let studio: Studio | null = null;
  try {
    children.push(await virtual("ur", HOST));
    for (const [kind, host] of STALLED) children.push(await virtual(kind, host));
    studio = await Studio.start();
    const { client } = await joined(studio.url, text => {
      if (text.startsWith('{"type":"link","station":"cell"') && !text.includes('"state":"open"')) line.lost++;
    });
    await openAt(client, "cell", "ur", "ur10e", HOST, { rtde: wire.port });
    for (const [kind, host, robot] of STALLED) await openAt(client, kind, kind, robot, host);
    await pause(1000);
    const { page, context } = await studio.open({ script: ledger("paced") });
    await drawn(page);
    await lookAtStations(page);
    await page.waitForFunction(() => window.twincell.stores.stationStore.getState().stations.length === 4, null, {
      timeout: 20_000,
      polling: 100,
    });
    const offset_ms = await clockOf(page);
    const figures: Figure[] = [];
    for (const stalls of [false, true]) {
      const over = stalls
        ? standStill(children.slice(1))
        : (): void => {
            /* They go on. */
          };
      const suffix = stalls ? "-stalled" : "";
      const while_ = stalls ? "while three drivers' controllers stand still" : "nothing stalls";
      const message = await stops(wire, line, () => {
        const asked_ms = nodeNow_ms();
        client.stop("cell");
        return Promise.resolve(asked_ms);
      });
      figures.push(
        late(
          `twin/stop-message${suffix}-p99`,
          message.late_ms,
          `message at the stations' socket to the controller's wire, ${while_}; budget 10; ${beside(message)}`,
        ),
      );
      const inPage = await stops(
        wire,
        line,
        async () =>
          offset_ms +
          (await page.evaluate(() => {
            const asked_ms = performance.now();
            window.twincell.run("stop");
            return asked_ms;
          })),
      );
      figures.push(
        late(
          `twin/stop-page${suffix}-p99`,
          inPage.late_ms,
          `STOP in the page to the controller's wire, ${while_}; budget 10; ${beside(inPage)}`,
        ),
      );
      over();
      await pause(2000);
    }
    await context.close();
    return figures;
  } finally {
    for (const child of children) {
      child.kill("SIGCONT");
      child.kill("SIGTERM");
    }
    await studio?.stop();
    wire.close();
  }
};

interface Wire {
  readonly port: number /** Resolves at the next order on the wire [ms]. */;
  next(): Promise<number>;
  close(): void;
}
/** Hands everything on, both ways, and says when an order goes to the controller. */
function relay(): Promise<Wire> {
  let seen: ((at_ms: number) => void) | null = null;
  const server: Server = createServer({ noDelay: true }, from => {
    const to = connect({ host: HOST, port: RTDE_PORT, noDelay: true });
    let rest: Buffer = Buffer.alloc(0);
    from.on("data", bytes => {
      const at_ms = nodeNow_ms();
      to.write(bytes);
      for (
        rest = Buffer.concat([rest, bytes]);
        rest.length >= 3 && rest.length >= rest.readUInt16BE(0);
        rest = rest.subarray(rest.readUInt16BE(0))
      )
        if (rest[2] === DATA && rest.readUInt16BE(0) > HEARTBEAT) seen?.(at_ms);
    });
    to.on("data", bytes => {
      from.write(bytes);
    });
    for (const [one, other] of [
      [from, to],
      [to, from],
    ] as const) {
      one.on("error", () => {
        other.destroy();
      });
      one.on("close", () => {
        other.destroy();
      });
    }
  });
  return new Promise(resolve => {
    server.listen(0, HOST, () => {
      resolve({
        port: (server.address() as { port: number }).port,
        next: () =>
          new Promise(found => {
            seen = found;
          }),
        close() {
          server.close();
        },
      });
    });
  });
}

interface Stops {
  readonly late_ms: readonly number[];
  readonly timers_ms: readonly number[];
  readonly without: number;
}
/**
 * Asks again and again at uneven moments; without a link there is no wire to be seen on, and the robot's own watchdog
 * has stopped it: those are counted. A stop that is not on the wire after a second never comes.
 */
async function stops(wire: Wire, line: { lost: number }, ask: () => Promise<number>): Promise<Stops> {
  const late_ms: number[] = [];
  const timers_ms: number[] = [];
  let without = 0;
  for (const until_ms = performance.now() + SECONDS * 1000; performance.now() < until_ms; ) {
    const next = wire.next();
    const lost = line.lost;
    const asked_ms = await ask();
    const at_ms = await Promise.race([next, pause(1000, Infinity)]);
    if (line.lost === lost) late_ms.push(at_ms - asked_ms);
    else without++;
    const wait_ms = 5 + ((timers_ms.length * 7) % 11);
    const from_ms = performance.now();
    await pause(wait_ms);
    timers_ms.push(performance.now() - from_ms - wait_ms);
  }
  return { late_ms, timers_ms, without };
}
function standStill(children: readonly ChildProcess[]): () => void {
  const stall = (): void => {
    for (const child of children) child.kill("SIGSTOP");
    setTimeout(wake, STALL_MS);
  };
  const wake = (): void => {
    for (const child of children) child.kill("SIGCONT");
  };
  stall();
  const timer = setInterval(stall, STALL_MS + BREATH_MS);
  return () => {
    clearInterval(timer);
    wake();
  };
}
/**
 * How much of it is the machine's: a timer of a process that does nothing else, and links that were lost because a
 * process was kept from running.
 */
const beside = ({ timers_ms, without }: Stops): string =>
  `meanwhile timers of this process came ${quantile(timers_ms, 0.99).toFixed(1)} ms late at the 99th percentile, and ${without} stops met no link`;
