import { PlainFault, type Scheduler } from "@twincell/core";
import { isSlide } from "@twincell/core";
import type { MqttClient } from "mqtt";
import type { RobotState } from "../robot-states.ts";
import { causeOf, type StandardContext, type StartedStandard } from "../standard.ts";
import { asksForRebirth, encodePayload, type Metric } from "./payload.ts";

export interface SparkplugOptions {
  /** mqtt://, mqtts://, ws:// or wss:// with user and password where the broker asks for them. */
  readonly url: string;
  readonly group: string;
  readonly node: string;
}
/** Data is told at most this often [s], and only what has changed. */
const DATA_S = 0.1;
/** A broker that is gone is asked again this often [s]. */
const AGAIN_S = 5;
/** Data that a broker does not take is left out beyond this [bytes]: a birth comes when it is back. */
const MAX_WAITING = 1 << 20;
const BIRTHS = 256;

interface Device {
  readonly robot: RobotState;
  readonly alias: Map<string, number>;
  /** Values as they were last told. */
  readonly told: Map<string, number | boolean | string>;
  born: boolean;
  names: number;
}

/**
 * This server as an edge node of Sparkplug B and every robot as a device of it: births with all names and types, data
 * by exception under aliases, deaths when a robot loses its controller, and births again when a host asks for them. It
 * only tells: commands of devices are not taken, because nobody holds a lease by MQTT.
 */
export async function startSparkplug(context: StandardContext, options: SparkplugOptions): Promise<StartedStandard> {
  const { states, scheduler, say } = context;
  const mqtt = await import("mqtt");
  for (const [name, value] of Object.entries({ group: options.group, node: options.node }))
    if (!/^[^+#/]{1,100}$/.test(value))
      throw new PlainFault("sparkplug.name", `“${value}” is no ${name} of Sparkplug B.`, "Leave out “+”, “#” and “/”.");
  const shown = new URL(options.url).host;
  const devices = new Map<RobotState, Device>();
  const topic = (type: string, device?: string): string =>
    `spBv1.0/${options.group}/${type}/${options.node}${device === undefined ? "" : `/${device}`}`;
  let client: MqttClient | null = null;
  let online = false;
  let closed = false;
  let births = 0;
  let seq = 0;
  let troubled = false;

  const publish = (type: string, device: string | undefined, metrics: readonly Metric[]): void => {
    if (!client || !online) return;
    const payload = encodePayload({ timestamp_ms: context.now_ms(), metrics, seq });
    seq = (seq + 1) % 256;
    client.publish(topic(type, device), payload, { qos: 0 });
  };
  const birth = (device: Device): void => {
    const { robot, alias, told } = device;
    alias.clear();
    told.clear();
    device.born = true;
    const values = valuesOf(robot);
    device.names = values.size;
    const metrics = [...values].map(([name, value], i): Metric => {
      alias.set(name, i + 1);
      told.set(name, value);
      return { name, alias: i + 1, type: typeOf(value), value };
    });
    publish("DBIRTH", robot.id, metrics);
  };
  const death = (device: Device): void => {
    if (device.born) publish("DDEATH", device.robot.id, []);
    device.born = false;
  };
  const birthAll = (): void => {
    seq = 0;
    publish("NBIRTH", undefined, [
      { name: "bdSeq", type: "Int64", value: births },
      { name: "Node Control/Rebirth", type: "Boolean", value: false },
      { name: "Properties/Software", type: "String", value: `Twincell ${context.version}` },
    ]);
    for (const device of devices.values()) if (isHeard(device.robot)) birth(device);
  };
  const data = (device: Device): void => {
    const { robot, alias, told } = device;
    const values = valuesOf(robot);
    // A line that nobody had told before needs a name: only a birth gives one.
    if (values.size !== device.names) {
      birth(device);
      return;
    }
    const metrics: Metric[] = [];
    for (const [name, value] of values)
      if (told.get(name) !== value) {
        told.set(name, value);
        metrics.push({ alias: alias.get(name)!, type: typeOf(value), value });
      }
    if (metrics.length > 0) publish("DDATA", robot.id, metrics);
  };
  const connect = (): void => {
    births = (births + 1) % BIRTHS;
    const own = mqtt.connect(options.url, {
      clean: true,
      // The will carries the number of the birth that it ends: each connection is a client of its own.
      reconnectPeriod: 0,
      connectTimeout: 10_000,
      will: {
        topic: topic("NDEATH"),
        qos: 1,
        retain: false,
        payload: encodePayload({
          timestamp_ms: context.now_ms(),
          metrics: [{ name: "bdSeq", type: "Int64", value: births }],
        }),
      },
    });
    client = own;
    own.on("connect", () => {
      online = true;
      troubled = false;
      own.subscribe(topic("NCMD"), { qos: 0 });
      birthAll();
    });
    own.on("message", (_topic, payload) => {
      if (asksForRebirth(payload)) birthAll();
    });
    own.on("error", problem => {
      if (!troubled) say(`The MQTT broker at ${shown} cannot be used: ${causeOf(problem)}. It is asked again.`);
      troubled = true;
    });
    own.on("close", () => {
      online = false;
      for (const device of devices.values()) device.born = false;
      if (client === own) client = null;
      own.end(true);
    });
  };
  const forget = states.listen({
    opened(robot) {
      devices.set(robot, { robot, alias: new Map(), told: new Map(), born: false, names: 0 });
    },
    closed(robot) {
      const device = devices.get(robot);
      if (device) death(device);
      devices.delete(robot);
    },
  });
  const stop = every(scheduler, () => {
    if (!online || (client?.stream.writableLength ?? 0) > MAX_WAITING) return;
    for (const device of devices.values()) {
      const heard = isHeard(device.robot);
      if (!heard) death(device);
      else if (device.born) data(device);
      else birth(device);
    }
  });
  connect();
  const again = scheduler.every(AGAIN_S, () => {
    if (client === null && !closed) connect();
  });
  return {
    address: `Sparkplug B: ${shown}, spBv1.0/${options.group}/…/${options.node}`,
    async close() {
      closed = true;
      stop();
      again();
      forget();
      const own = client;
      client = null;
      if (own === null) return;
      // A node that leaves on purpose says so: a broker keeps the will of whoever disconnects to itself.
      if (online)
        await new Promise<void>(resolve => {
          const metrics: Metric[] = [{ name: "bdSeq", type: "Int64", value: births }];
          const payload = encodePayload({ timestamp_ms: context.now_ms(), metrics });
          own.publish(topic("NDEATH"), payload, { qos: 1 }, () => {
            resolve();
          });
          own.once("close", () => {
            resolve();
          });
        });
      await own.endAsync(true);
    },
  };
}
const every = (scheduler: Scheduler, tick: () => void): (() => void) => scheduler.every(DATA_S, tick);
const isHeard = ({ connection, sample }: RobotState): boolean => connection.link?.state === "open" && sample !== null;
const typeOf = (value: number | boolean | string): Metric["type"] =>
  typeof value === "boolean" ? "Boolean" : typeof value === "string" ? "String" : "Double";

/** What is told of a robot: angles [rad] and lengths [m] as they are. */
function valuesOf(robot: RobotState): Map<string, number | boolean | string> {
  const sample = robot.sample!;
  const out = new Map<string, number | boolean | string>([
    ["Properties/Model", robot.model?.name ?? ""],
    ["Properties/Manufacturer", robot.model?.vendor ?? ""],
    ["State/Moving", sample.moving],
    ["State/Mode", sample.mode],
    ["State/Safety", sample.safety],
    ["State/Override", sample.override],
    ["State/Step", sample.step],
    ["State/Message", sample.message],
    ["State/Commanded by", robot.connection.guard.state.holder ?? ""],
  ]);
  robot.joints.forEach((name, i) => {
    const joint = robot.model?.arm.joints[i];
    out.set(`Axes/${name}/Position ${joint && isSlide(joint) ? "m" : "rad"}`, robot.q_rad[i]!);
  });
  for (const [name, value] of robot.signals) out.set(`Signals/${name}`, value);
  return out;
}
