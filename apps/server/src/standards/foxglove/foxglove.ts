import { FoxgloveServer, type IWebSocket } from "@foxglove/ws-protocol";
import type { WebSocket } from "ws";
import type { RobotState } from "../robot-states.ts";
import { framePrefix, robotDescription, topicOf, transforms } from "../ros-names.ts";
import { openSocketPort } from "../socket-port.ts";
import type { StandardContext, StartedStandard } from "../standard.ts";
import { ADVERTISED, type ChannelKind } from "./schemas.ts";

/** Both names of the protocol; the messages are the same. */
const PROTOCOLS = ["foxglove.sdk.v1", FoxgloveServer.SUPPORTED_SUBPROTOCOL];
const LONGEST = 1 << 20;
/** A reader that has this much waiting misses messages until it has caught up [bytes]. */
const MAX_WAITING = 1 << 20;
/** Shortest time between two messages of one robot [s]; a controller may tell more often. */
const JOINTS_S = 0.01;
const TRANSFORMS_S = 0.02;
/** What does not change is told again this often, for those who subscribe late [s]. */
const AGAIN_S = 1;

interface Channels {
  readonly ids: Readonly<Record<ChannelKind, number>>;
  joints_s: number;
  transforms_s: number;
}

const stampOf = (ms: number): { readonly sec: number; readonly nsec: number } => ({
  sec: Math.floor(ms / 1000),
  nsec: Math.floor((ms % 1000) * 1e6),
});

/** Live states for Foxglove: joints, transforms, description and state of every robot, and what happens. Read only. */
export async function startFoxglove(context: StandardContext, port: number): Promise<StartedStandard> {
  const { states, scheduler, now_ms, version } = context;
  const server = new FoxgloveServer({
    name: `twincell ${version}`,
    capabilities: ["time"],
    supportedEncodings: ["json"],
  });
  const robots = new Map<RobotState, Channels>();
  const subscribed = new Set<number>();
  const text = new TextEncoder();
  server.on("subscribe", id => {
    subscribed.add(id);
  });
  server.on("unsubscribe", id => {
    subscribed.delete(id);
  });
  server.on("error", () => {
    // What a client says wrongly concerns that client alone: it is answered by nothing.
  });
  const send = (id: number, message: () => unknown): void => {
    if (subscribed.has(id))
      server.sendMessage(id, BigInt(now_ms()) * 1_000_000n, text.encode(JSON.stringify(message())));
  };
  const advertise = (topic: string, kind: ChannelKind | "log"): number =>
    server.addChannel({ topic, encoding: "json", schemaEncoding: "jsonschema", ...ADVERTISED[kind] });
  const log = advertise("/log", "log");
  const say = (level: number, name: string, sentence: string): void => {
    send(log, () => ({ timestamp: stampOf(now_ms()), level, message: sentence, name, file: "", line: 0 }));
  };
  const state = (robot: RobotState) => {
    const { sample, connection } = robot;
    return {
      timestamp: stampOf(robot.heard_ms),
      connected: connection.link?.state === "open",
      mode: sample?.mode ?? "",
      safety: sample?.safety ?? "",
      moving: sample?.moving ?? false,
      override: sample?.override ?? 0,
      step: sample?.step ?? "",
      message: sample?.message ?? "",
      holder: connection.guard.state.holder ?? "",
      signals: Object.fromEntries(robot.signals),
    };
  };
  const describe = (robot: RobotState, { ids }: Channels): void => {
    const { model } = robot;
    if (model !== null) send(ids.description, () => ({ data: robotDescription(model) }));
    send(ids.state, () => state(robot));
  };
  const forget = states.listen({
    opened(robot) {
      const ids = {
        joints: advertise(topicOf(robot, "joint_states"), "joints"),
        transforms: advertise(topicOf(robot, "tf"), "transforms"),
        description: advertise(topicOf(robot, "robot_description"), "description"),
        state: advertise(topicOf(robot, "state"), "state"),
      };
      robots.set(robot, { ids, joints_s: -Infinity, transforms_s: -Infinity });
    },
    closed(robot) {
      for (const id of Object.values(robots.get(robot)?.ids ?? {})) {
        subscribed.delete(id);
        server.removeChannel(id);
      }
      robots.delete(robot);
    },
    sample(robot) {
      const channels = robots.get(robot);
      if (!channels) return;
      const now_s = scheduler.now_s();
      const { ids } = channels;
      if (now_s - channels.joints_s >= JOINTS_S - 0.001) {
        channels.joints_s = now_s;
        send(ids.joints, () => ({
          timestamp: stampOf(robot.heard_ms),
          joints: robot.joints.map((name, i) => ({ name, position: robot.q_rad[i], velocity: robot.speed_rad_s[i] })),
        }));
      }
      if (now_s - channels.transforms_s < TRANSFORMS_S - 0.001) return;
      channels.transforms_s = now_s;
      send(ids.transforms, () => ({
        transforms: transforms(robot, framePrefix(states, robot)).map(
          ({ parent, child, pose: { position, quaternion } }) => ({
            timestamp: stampOf(robot.heard_ms),
            parent_frame_id: parent,
            child_frame_id: child,
            translation: { x: position[0], y: position[1], z: position[2] },
            rotation: { x: quaternion[0], y: quaternion[1], z: quaternion[2], w: quaternion[3] },
          }),
        ),
      }));
    },
    signals(robot) {
      const channels = robots.get(robot);
      if (channels) send(channels.ids.state, () => state(robot));
    },
    event(event) {
      if (event.type === "notice") say(3, event.station, event.why.sentence);
      if (event.type !== "act" || event.outcome === null) return;
      const { station, who, action, detail, outcome } = event;
      const ended = outcome.kind === "done" ? "" : ` ${outcome.kind}: ${outcome.why.sentence}`;
      say(outcome.kind === "done" ? 2 : 3, station, `${who} ${action} ${detail}${ended}`.trim());
    },
  });
  const stop = scheduler.every(AGAIN_S, () => {
    server.broadcastTime(BigInt(now_ms()) * 1_000_000n);
    for (const [robot, channels] of robots) describe(robot, channels);
  });
  const opened = await openSocketPort(context, port, LONGEST, PROTOCOLS, (socket, request) => {
    server.handleConnection(patient(socket), request.socket.remoteAddress ?? "");
  });
  return {
    address: `Foxglove: ${opened.address}`,
    close() {
      stop();
      forget();
      opened.close();
    },
  };
}

/** That socket, with messages left out for whoever reads too slowly: the next one tells more anyway. */
function patient(socket: WebSocket): IWebSocket {
  socket.binaryType = "arraybuffer";
  const own: IWebSocket = {
    binaryType: "arraybuffer",
    protocol: socket.protocol,
    onerror: null,
    onopen: null,
    onclose: null,
    onmessage: null,
    close() {
      socket.close();
    },
    send(data, options) {
      if (typeof data !== "string" && socket.bufferedAmount > MAX_WAITING) return;
      socket.send(data, options ?? {});
    },
  };
  socket.on("message", (data, isBinary) => {
    own.onmessage?.({ data: isBinary ? data : String(data as unknown as Buffer) });
  });
  socket.on("close", (code, reason) => own.onclose?.({ code, reason: String(reason), wasClean: true }));
  return own;
}
