/** Sparkplug B to a host of paho through a real mosquitto: `npm run clients` brings both. */
import type { ChildProcess } from "node:child_process";
import { afterEach, expect, test } from "vitest";
import { freePort } from "../../testing/free-port.ts";
import { mosquitto, programOf } from "../testing/broker.ts";
import { foreignScript, isMissing, plant, YASKAWA, type Plant, type Script } from "../testing/foreign.ts";

const missing = (process.env["CI"] === undefined && programOf("mosquitto") === undefined) || isMissing("paho.mqtt");
let open: Plant | undefined;
let script: Script | undefined;
let broker: ChildProcess | undefined;
afterEach(async () => {
  script?.process.kill("SIGKILL");
  await open?.close();
  broker?.kill("SIGKILL");
  open = broker = undefined;
});
interface Metric {
  readonly name: string | null;
  readonly alias: number | null;
  readonly type: number;
  readonly value: number | string;
}
interface Told {
  readonly kind: string;
  readonly topic: string;
  readonly seq?: number;
  readonly metrics: readonly Metric[];
}

/** What is told of the arm itself, and the lines of the virtual controller. */
const ARM_METRICS = 15;
const LINES = 64;

test.skipIf(missing)(
  "a host of paho is told births with all names, types and aliases, data by exception, an unbroken sequence, births again when it asks and when the broker comes back, and the death of the node",
  async () => {
    const port = await freePort("127.0.0.1");
    broker = await mosquitto(port);
    script = foreignScript("sparkplug_host.py", String(port));
    await script.next();
    open = await plant({ sparkplug: { url: `mqtt://127.0.0.1:${port}`, group: "plant", node: "line1" } }, YASKAWA);
    const all: Told[] = [];
    const next = async (kind: string): Promise<Told> => {
      for (;;) {
        const told = (await script!.next()) as unknown as Told;
        all.push(told);
        if (told.kind === kind) return told;
      }
    };
    const node = await next("NBIRTH");
    expect(node).toMatchObject({ topic: "spBv1.0/plant/NBIRTH/line1", seq: 0 });
    const births = node.metrics.find(({ name }) => name === "bdSeq")!.value;
    // Lines that are heard of later need a birth of their own: the last one names all.
    let device = await next("DBIRTH");
    while (device.metrics.length < ARM_METRICS + LINES) device = await next("DBIRTH");
    expect(device.topic).toBe("spBv1.0/plant/DBIRTH/line1/arm");
    expect(device.metrics.filter(({ name, type }) => name!.endsWith("/Position rad") && type === 10)).toHaveLength(6);
    expect(new Set(device.metrics.map(({ alias }) => alias)).size).toBe(device.metrics.length);

    const holder = device.metrics.find(({ name }) => name === "State/Commanded by")!;
    expect(holder).toMatchObject({ type: 12, value: "" });
    await open.ask("POST", "/robots/arm/lease", { who: "a person" });
    for (;;) {
      const data = await next("DDATA");
      expect(data.metrics.every(({ name }) => name === null)).toBe(true);
      expect(data.metrics.length).toBeLessThan(device.metrics.length);
      if (String(data.metrics.find(({ alias }) => alias === holder.alias)?.value).startsWith("a person")) break;
    }
    script.say("line1");
    await next("NBIRTH");
    await next("DBIRTH");
    let before: number | undefined;
    for (const { kind, seq } of all.filter(each => each.seq !== undefined)) {
      expect(seq, kind).toBe(kind === "NBIRTH" ? 0 : (before! + 1) % 256);
      before = seq;
    }
    broker.kill("SIGKILL");
    script.process.kill("SIGKILL");
    broker = await mosquitto(port);
    script = foreignScript("sparkplug_host.py", String(port));
    await next("subscribed");
    // The node may have been back before its host was: then it is asked for its birth.
    script.say("line1");
    const again = await next("NBIRTH");
    const number = ({ metrics }: Told): number => Number(metrics.find(({ name }) => name === "bdSeq")!.value);
    expect(number(again)).toBe((Number(births) + 1) % 256);
    const closing = open.close();
    open = undefined;
    const death = await next("NDEATH");
    expect(death.metrics).toMatchObject([{ name: "bdSeq", value: number(again) }]);
    expect(death.seq).toBeUndefined();
    await closing;
  },
  120_000,
);
