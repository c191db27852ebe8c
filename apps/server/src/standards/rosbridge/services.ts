import type { StandardContext } from "../standard.ts";
import { topicOf } from "../ros-names.ts";
import type { RosClient } from "./client.ts";

/** Answers a call; throws with the sentence that the client is told. */
export type RosService = (
  client: RosClient,
  name: string,
  args: Readonly<Record<string, unknown>>,
) => object | Promise<object>;

/** `/rosapi` as far as clients ask for it, and stops: `/stop` of all robots, `/ROBOT/stop` of one. */
export function rosServices(
  { states, robots, now_ms }: StandardContext,
  known: { readonly topics: () => readonly (readonly [string, string])[] },
): ReadonlyMap<string, RosService> {
  const names: readonly string[] = [
    ...["topics", "topic_type", "topics_for_type", "nodes", "services", "service_type", "get_time"].map(
      each => `/rosapi/${each}`,
    ),
    "/stop",
  ];
  const time = (): object => {
    const secs = Math.floor(now_ms() / 1000);
    const nsecs = Math.floor((now_ms() % 1000) * 1e6);
    return { time: { sec: secs, nanosec: nsecs, secs, nsecs } };
  };
  return new Map<string, RosService>([
    [
      "/rosapi/topics",
      () => ({ topics: known.topics().map(([name]) => name), types: known.topics().map(([, type]) => type) }),
    ],
    ["/rosapi/topic_type", (_client, _name, { topic }) => ({ type: new Map(known.topics()).get(String(topic)) ?? "" })],
    [
      "/rosapi/topics_for_type",
      (_client, _name, { type }) => ({
        topics: known.topics().flatMap(([name, each]) => (each === type ? [name] : [])),
      }),
    ],
    ["/rosapi/nodes", () => ({ nodes: ["/twincell"] })],
    ["/rosapi/services", () => ({ services: names })],
    [
      "/rosapi/service_type",
      (_client, _name, { service }) => ({ type: String(service).endsWith("/stop") ? "std_srvs/srv/Trigger" : "" }),
    ],
    ["/rosapi/get_time", time],
    [
      "/stop",
      (client, name) => {
        if (name === "/stop") robots.stop(client.who, undefined, false);
        else {
          const robot = [...states.all.values()].find(each => topicOf(each, "stop") === name);
          if (!robot) throw new Error(`There is no robot of ${name}.`);
          robots.stop(client.who, robot.id, false);
        }
        return { success: true, message: "" };
      },
    ],
  ]);
}
