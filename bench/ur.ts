import { createRealController, createUrAdapter } from "@twincell/controllers";
import { robotById } from "@twincell/core";
import { nodeNetwork, nodeScheduler } from "@twincell/server";
import { spawn, spawnSync } from "node:child_process";
import { setTimeout as pause } from "node:timers/promises";
import { quantile } from "../apps/studio/browser-tests/support/ledger.ts";
import { figure, type Bench, type Figure } from "./figure.ts";
import { virtual } from "./stations.ts";

/** As long as the budget is asked over: TWINCELL_BENCH_S=600. */
const SECONDS = Number(process.env["TWINCELL_BENCH_S"] ?? 20);
const HOST = "127.0.0.46";
const python = process.env["TWINCELL_PYTHON"] ?? "python3";

/**
 * How steadily a controller of Universal Robots is heard at 500 Hz: a virtual one in a process of its own, our driver
 * in this one, and ur_rtde in a third where it is installed. The rate counts what came per second of this machine's
 * clock; a gap is the time from one arrival to the next.
 */
export const run: Bench = async () => {
  const controller = await virtual("ur", HOST);
  try {
    return [...(await ours()), ...(await peer())];
  } finally {
    controller.kill("SIGTERM");
  }
};

async function ours(): Promise<Figure[]> {
  const robot = robotById("ur10e");
  if (!robot) throw new Error("The library has no ur10e.");
  const real = createRealController({
    face: createUrAdapter({ robot, scheduler: nodeScheduler, network: nodeNetwork(), host: HOST }),
    scheduler: nodeScheduler,
  });
  const arrived_s: number[] = [];
  const connected = await real.connect();
  if (connected.kind !== "done") throw new Error(connected.why.sentence);
  await pause(1000);
  let losses = 0;
  real.onLink(({ state }) => {
    if (state === "lost") losses++;
  });
  const before = real.link.missing;
  real.onSample(() => {
    arrived_s.push(nodeScheduler.now_s());
  });
  const rates: number[] = [];
  for (let second = 0; second < SECONDS; second++) {
    const from = arrived_s.length;
    const begun_s = nodeScheduler.now_s();
    await pause(1000);
    rates.push((arrived_s.length - from) / (nodeScheduler.now_s() - begun_s));
  }
  const missing = real.link.missing - before;
  real.close();
  const gaps_ms = arrived_s.slice(1).map((at_s, i) => (at_s - arrived_s[i]!) * 1000);
  const whole = (arrived_s.length - 1) / (arrived_s.at(-1)! - arrived_s[0]!);
  return [
    {
      ...figure(
        "twin/ur-rate",
        "Hz",
        rates,
        `over ${SECONDS} s at once: ${whole.toFixed(2)}; min and max are of single seconds; budget 500 ± 1 %`,
      ),
      median: whole,
    },
    {
      name: "twin/ur-gap",
      unit: "ms",
      median: quantile(gaps_ms, 0.5),
      min: quantile(gaps_ms, 0.99),
      max: quantile(gaps_ms, 1),
      n: gaps_ms.length,
      note: "median; min is the 99th percentile, max the largest gap",
    },
    figure("twin/ur-lost", "samples", [missing], `${losses} times the link was lost; budget 0`),
  ];
}

const CLIENT = `
import json, sys, time
from rtde_receive import RTDEReceiveInterface
r = RTDEReceiveInterface(sys.argv[1], 500.0)
time.sleep(0.5)
stamps, arrived, end, last = [], [], time.perf_counter() + ${SECONDS}, None
while time.perf_counter() < end:
    stamp = r.getTimestamp()
    if stamp != last:
        stamps.append(stamp); arrived.append(time.perf_counter()); last = stamp
    time.sleep(0.0002)
gaps = [b - a for a, b in zip(arrived, arrived[1:])]
print(json.dumps({"seen": (len(stamps) - 1) / (arrived[-1] - arrived[0]), "sent": round((stamps[-1] - stamps[0]) / 0.002) / (arrived[-1] - arrived[0]), "gap_ms": max(gaps) * 1000, "n": len(stamps)}))
sys.stdout.flush()
import os; os._exit(0)
`;
function peer(): Promise<Figure[]> {
  if (spawnSync(python, ["-c", "import rtde_receive"]).status !== 0) {
    process.stderr.write("ur_rtde is not installed: left out. TWINCELL_PYTHON names a Python that has it.\n");
    return Promise.resolve([]);
  }
  const child = spawn(python, ["-c", CLIENT, HOST], { stdio: ["ignore", "pipe", "inherit"] });
  let out = "";
  child.stdout.on("data", (chunk: Buffer) => {
    out += chunk.toString();
  });
  return new Promise((resolve, reject) => {
    child.once("close", () => {
      try {
        const told = JSON.parse(out) as { seen: number; sent: number; gap_ms: number; n: number };
        resolve([
          figure(
            "twin/ur-rate-ur_rtde",
            "Hz",
            [told.sent],
            `by the controller's clock between the first and the last state that was polled; ${told.seen.toFixed(1)} different ones a second were seen by polling`,
          ),
          figure(
            "twin/ur-gap-ur_rtde",
            "ms",
            [told.gap_ms],
            `largest time between two different states seen by polling, ${told.n} states`,
          ),
        ]);
      } catch (cause) {
        reject(new Error("ur_rtde said nothing.", { cause }));
      }
    });
  });
}
