import { openSocketPort } from "../socket-port.ts";
import { causeOf, type StandardContext, type StartedStandard } from "../standard.ts";
import { createActions } from "./actions.ts";
import { clientOf, type RosClient } from "./client.ts";
import { rosbridgeRequest, type RosbridgeRequest, type RosbridgeRequestOf } from "./messages.ts";
import { rosServices, type RosService } from "./services.ts";
import { generationOf, rosTopics, type RosGeneration, type RosTopic } from "./topics.ts";

const LONGEST = 4 << 20;
const MOST_SUBSCRIPTIONS = 256;
const MOST_TOPICS = 1000;
/** What does not change is told again this often, for those who subscribe late [s]. */
const AGAIN_S = 1;
/** A rate that is asked for as it comes is not halved by a tick that comes early [s]. */
const SLACK_S = 0.001;

interface Subscription {
  readonly topic: string;
  readonly id: string | undefined;
  readonly generation: RosGeneration;
  readonly period_s: number;
  last_s: number;
}
/** Names come with and without the slash in front. */
const rooted = (name: string): string => (name.startsWith("/") ? name : `/${name}`);

/**
 * A socket for ROS programs that speak rosbridge v2 (JSON): states of all robots as topics, FollowJointTrajectory as an
 * action, and whatever clients publish handed on to those who subscribe to it.
 */
export async function startRosbridge(context: StandardContext, port: number): Promise<StartedStandard> {
  const { states, scheduler } = context;
  const clients = new Map<RosClient, Set<Subscription>>();
  const foreign = new Map<string, string>();
  let topics = rosTopics(states);
  const refreshed = (): void => {
    topics = rosTopics(states);
  };
  const typeOf = (topic: string): string | undefined => topics.get(topic)?.type ?? foreign.get(topic);
  const services: ReadonlyMap<string, RosService> = rosServices(context, {
    topics: () => [...[...topics].map(([name, { type }]) => [name, type] as const), ...foreign],
  });
  const actions = createActions(context);

  const due = (subscription: Subscription, period_s: number): boolean => {
    const now_s = scheduler.now_s();
    if (now_s - subscription.last_s < Math.max(period_s, subscription.period_s) - SLACK_S) return false;
    subscription.last_s = now_s;
    return true;
  };
  const tell = (client: RosClient, subscription: Subscription, topic: RosTopic): void => {
    const msg = topic.message(subscription.generation);
    if (msg !== null) client.send({ op: "publish", topic: subscription.topic, msg });
  };
  const forget = states.listen({
    opened: refreshed,
    closed: refreshed,
    sample(robot) {
      for (const [client, subscriptions] of clients)
        for (const subscription of subscriptions) {
          const topic = topics.get(subscription.topic);
          if (topic?.told !== "sample" || (topic.robot !== null && topic.robot !== robot)) continue;
          if (due(subscription, topic.period_s)) tell(client, subscription, topic);
        }
    },
  });
  const stop = scheduler.every(AGAIN_S, () => {
    for (const [client, subscriptions] of clients)
      for (const subscription of subscriptions) {
        const topic = topics.get(subscription.topic);
        if (topic?.told === "kept") tell(client, subscription, topic);
      }
  });
  const heard = (client: RosClient, text: string): void => {
    let value: unknown;
    try {
      value = JSON.parse(text);
    } catch (problem) {
      client.send({ op: "status", level: "error", msg: `A message is JSON; this one is not: ${causeOf(problem)}.` });
      return;
    }
    const parsed = rosbridgeRequest.safeParse(value);
    if (parsed.success) {
      take(client, parsed.data);
      return;
    }
    const { op, id } = (value ?? {}) as { readonly op?: unknown; readonly id?: unknown };
    const [issue] = parsed.error.issues;
    client.send({
      op: "status",
      level: "error",
      msg: `“${String(op)}” could not be understood at “${issue?.path.join(".") ?? ""}”: ${issue?.message ?? "unknown"}.`,
      ...(typeof id === "string" ? { id } : {}),
    });
  };
  const take = (client: RosClient, ask: RosbridgeRequest): void => {
    switch (ask.op) {
      case "subscribe":
        subscribe(client, ask);
        break;
      case "unsubscribe":
        for (const each of clients.get(client)!)
          if (each.topic === rooted(ask.topic) && (ask.id === undefined || each.id === ask.id))
            clients.get(client)!.delete(each);
        break;
      case "advertise":
        advertise(client, ask);
        break;
      case "publish":
        publish(client, ask);
        break;
      case "call_service":
        void call(client, ask);
        break;
      case "send_action_goal":
      case "cancel_action_goal":
        actions.take(client, { ...ask, action: rooted(ask.action) });
        break;
      case "unadvertise":
      case "set_level":
      case "status":
        break;
    }
  };
  const fault = (client: RosClient, id: string | undefined, msg: string): void => {
    client.send({ op: "status", level: "error", msg, ...(id === undefined ? {} : { id }) });
  };
  function subscribe(client: RosClient, ask: RosbridgeRequestOf<"subscribe">): void {
    const mine = clients.get(client)!;
    if (ask.compression !== undefined && ask.compression !== null && ask.compression !== "none") {
      fault(client, ask.id, `Compression “${ask.compression}” is not spoken here: ask for none.`);
      return;
    }
    if (mine.size >= MOST_SUBSCRIPTIONS) {
      fault(client, ask.id, `${MOST_SUBSCRIPTIONS} subscriptions are the most.`);
      return;
    }
    const name = rooted(ask.topic);
    const subscription: Subscription = {
      topic: name,
      id: ask.id,
      generation: generationOf(ask.type),
      period_s: (ask.throttle_rate ?? 0) / 1000,
      last_s: -Infinity,
    };
    mine.add(subscription);
    const topic = topics.get(name);
    if (topic?.told === "kept") tell(client, subscription, topic);
  }
  function advertise(client: RosClient, ask: RosbridgeRequestOf<"advertise">): void {
    const name = rooted(ask.topic);
    const known = typeOf(name);
    const plain = (type: string): string => type.replace("/msg/", "/");
    if (known !== undefined && plain(known) !== plain(ask.type))
      fault(client, ask.id, `${name} has the type ${known}, not ${ask.type}.`);
    else if (known === undefined && foreign.size >= MOST_TOPICS)
      fault(client, ask.id, `${MOST_TOPICS} topics are the most.`);
    else if (known === undefined) foreign.set(name, ask.type);
  }
  function publish(client: RosClient, ask: RosbridgeRequestOf<"publish">): void {
    const name = rooted(ask.topic);
    if (topics.has(name)) {
      fault(client, ask.id, `${name} is told by Twincell: nobody else publishes there.`);
      return;
    }
    for (const [reader, subscriptions] of clients)
      for (const subscription of subscriptions)
        if (subscription.topic === name && due(subscription, 0))
          reader.send({ op: "publish", topic: name, msg: ask.msg });
  }
  async function call(client: RosClient, ask: RosbridgeRequestOf<"call_service">): Promise<void> {
    const name = rooted(ask.service);
    const service = services.get(name) ?? services.get(name.replace(/^\/[^/]+(?=\/stop$)/, ""));
    let result = true;
    let values: unknown;
    try {
      if (!service) throw new Error(`There is no service ${name}.`);
      values = await service(client, name, (ask.args ?? {}) as Readonly<Record<string, unknown>>);
    } catch (problem) {
      result = false;
      values = causeOf(problem);
    }
    client.send({
      op: "service_response",
      service: ask.service,
      values,
      result,
      ...(ask.id === undefined ? {} : { id: ask.id }),
    });
  }
  let count = 0;
  const opened = await openSocketPort(context, port, LONGEST, [], (socket, request) => {
    const client = clientOf(context, socket, request, ++count);
    clients.set(client, new Set());
    socket.on("message", (data, isBinary) => {
      if (isBinary) fault(client, undefined, "Binary messages are not spoken here: send JSON.");
      else heard(client, String(data as Buffer));
    });
    client.onGone(() => clients.delete(client));
  });
  return {
    address: `rosbridge: ${opened.address}`,
    close() {
      stop();
      forget();
      opened.close();
    },
  };
}
