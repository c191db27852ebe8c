/** Live states for the client that Foxglove publishes: @foxglove/ws-protocol. */
import { FoxgloveClient, type Channel, type MessageData } from "@foxglove/ws-protocol";
import { readUrdf } from "@twincell/formats";
import { flangePose, robotById } from "@twincell/core";
import { afterEach, expect, test } from "vitest";
import { WebSocket } from "ws";
import { plant, type Plant } from "../testing/foreign.ts";

let open: Plant | undefined;
const clients: FoxgloveClient[] = [];
afterEach(async () => {
  for (const client of clients.splice(0)) client.close();
  await open?.close();
  open = undefined;
});
const robot = robotById("ur10e")!;

/** A client with the channels that it was told of and the next message of one of them. */
function connected(protocol: string) {
  const client = new FoxgloveClient({
    ws: new WebSocket(`ws://127.0.0.1:${open!.port("Foxglove")}`, [protocol]) as never,
  });
  clients.push(client);
  const channels = new Map<string, Channel>();
  const subscribed = new Map<number, string>();
  const waits = new Map<string, (message: Record<string, unknown>) => void>();
  const advertised: (() => void)[] = [];
  client.on("advertise", list => {
    for (const channel of list) channels.set(channel.topic, channel);
    for (const listen of advertised.splice(0)) listen();
  });
  client.on("message", ({ subscriptionId, data }: MessageData) => {
    const topic = subscribed.get(subscriptionId)!;
    waits.get(topic)?.(JSON.parse(new TextDecoder().decode(data)) as Record<string, unknown>);
    waits.delete(topic);
  });
  return {
    client,
    channels,
    told: () =>
      new Promise<void>(resolve => {
        if (channels.size > 0) resolve();
        else advertised.push(resolve);
      }),
    next(topic: string): Promise<Record<string, unknown>> {
      if (![...subscribed.values()].includes(topic)) subscribed.set(client.subscribe(channels.get(topic)!.id), topic);
      return new Promise(resolve => waits.set(topic, resolve));
    },
  };
}

test.each(["foxglove.websocket.v1", "foxglove.sdk.v1"])(
  "a client of @foxglove/ws-protocol (%s) is told joints, transforms that end where the flange is, a URDF and what happens",
  async protocol => {
    open = await plant({ foxglove: 0 });
    const { channels, told, next } = connected(protocol);
    await told();
    expect([...channels.keys()].sort()).toEqual([
      "/arm/joint_states",
      "/arm/robot_description",
      "/arm/state",
      "/arm/tf",
      "/log",
    ]);
    expect(channels.get("/arm/joint_states")!.schemaName).toBe("foxglove.JointStates");
    const { joints } = (await next("/arm/joint_states")) as { joints: { name: string; position: number }[] };
    expect(joints.map(joint => joint.name)).toEqual(robot.arm.joints.map(joint => joint.name));
    const q = joints.map(joint => joint.position);
    const { transforms } = (await next("/arm/tf")) as {
      transforms: { child_frame_id: string; translation: { x: number; y: number; z: number } }[];
    };
    const flange = transforms.find(each => each.child_frame_id === robot.frames.tip)!;
    const { position } = flangePose(robot.arm, q);
    expect(flange.translation.x).toBeCloseTo(position[0], 6);
    expect(flange.translation.z).toBeCloseTo(position[2], 6);
    const { data } = (await next("/arm/robot_description")) as { data: string };
    const read = readUrdf(data);
    expect(read).toMatchObject({ kind: "read", robot: { name: robot.name } });
    expect(await next("/arm/state")).toMatchObject({ connected: true, safety: "normal" });
    const log = next("/log");
    await open.ask("POST", "/robots/arm/stop", {});
    expect(await log).toMatchObject({ name: "arm", message: expect.stringContaining("stops the robot") as string });
  },
  30_000,
);

test("a page of another server and a client without a protocol that is spoken are turned away", async () => {
  open = await plant({ foxglove: 0 });
  const url = `ws://127.0.0.1:${open.port("Foxglove")}`;
  const opens = (protocols: readonly string[], headers: Record<string, string>): Promise<boolean> =>
    new Promise(resolve => {
      const socket = new WebSocket(url, [...protocols], { headers });
      socket.on("open", () => {
        socket.terminate();
        resolve(true);
      });
      socket.on("error", () => {
        resolve(false);
      });
    });
  expect(await opens(["foxglove.sdk.v1"], {})).toBe(true);
  expect(await opens(["foxglove.sdk.v1"], { origin: "http://elsewhere.example" })).toBe(false);
  expect(await opens(["foxglove.sdk.v1"], { host: "elsewhere.example" })).toBe(false);
  expect(await opens(["something.else"], {})).toBe(false);
});
