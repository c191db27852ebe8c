import type { ClientMonitoredItem, DataType, DataValue } from "node-opcua";
import { causeOf, type StandardContext, type StartedStandard } from "../standard.ts";
import { readPlcFile, type PlcSignal } from "./plc-file.ts";

/** Asked for at the controller; it may be slower [ms]. */
const SAMPLED_MS = 20;
const NAME = "PLC (OPC UA)";

/**
 * Lines of robots and nodes of a controller's OPC UA server follow each other: an input of a virtual controller follows
 * a node, a node follows a line. A controller that is gone is looked for until it is back; it moves no robot by itself.
 */
export async function startPlc(context: StandardContext, path: string): Promise<StartedStandard> {
  const { url, user, password, signals } = readPlcFile(path);
  const opcua = await import("node-opcua");
  const { states, robots, say } = context;
  const said = new Set<string>();
  const once = (sentence: string): void => {
    if (said.has(sentence) || said.size > 1000) return;
    said.add(sentence);
    say(sentence);
  };
  const client = opcua.OPCUAClient.create({
    applicationName: "Twincell",
    endpointMustExist: false,
    connectionStrategy: { initialDelay: 500, maxDelay: 10_000, maxRetry: -1 },
  });
  client.on("connection_lost", () => say(`The PLC at ${url} is not heard any more; it is looked for.`));
  client.on("connection_reestablished", () => say(`The PLC at ${url} is heard again.`));
  client.on("backoff", (count: number) => {
    if (count === 0) once(`The PLC at ${url} does not answer; it is asked again.`);
  });
  let closed = false;
  const types = new Map<string, DataType>();
  const told = new Map<PlcSignal, boolean | number>();
  let write: (signal: PlcSignal, value: boolean | number) => void = () => undefined;

  async function setInput({ node, robot, line }: PlcSignal, value: boolean | number): Promise<void> {
    if (!states.all.has(robot)) return;
    const outcome = await robots.ask(NAME, {
      type: "pendant",
      station: robot,
      act: { do: "input", signal: line, value },
    });
    if (outcome.kind !== "done") once(`${node} does not reach ${line} of ${robot}: ${outcome.why.sentence}`);
  }
  const lastOf = new Map<PlcSignal, boolean | number>();
  async function follow(): Promise<void> {
    await client.connect(url);
    const session = await client.createSession(
      user === undefined ? undefined : { type: opcua.UserTokenType.UserName, userName: user, password: password ?? "" },
    );
    const subscription = await session.createSubscription2({
      requestedPublishingInterval: SAMPLED_MS,
      requestedLifetimeCount: 1000,
      requestedMaxKeepAliveCount: 20,
      maxNotificationsPerPublish: 1000,
      publishingEnabled: true,
      priority: 1,
    });
    for (const signal of signals) {
      const attributeId = opcua.AttributeIds.Value;
      const { statusCode, value } = await session.read({ nodeId: signal.node, attributeId });
      if (!statusCode.isGood()) {
        say(`${signal.node} cannot be read at the PLC: ${statusCode.name}.`);
        continue;
      }
      types.set(signal.node, value.dataType);
      if (signal.from !== "plc") continue;
      const item: ClientMonitoredItem = (await subscription.monitor(
        { nodeId: signal.node, attributeId },
        { samplingInterval: SAMPLED_MS, discardOldest: true, queueSize: 1 },
        opcua.TimestampsToReturn.Both,
      )) as ClientMonitoredItem;
      item.on("changed", (changed: DataValue) => {
        const now: unknown = changed.value.value;
        if (!changed.statusCode.isGood() || (typeof now !== "boolean" && typeof now !== "number")) return;
        lastOf.set(signal, now);
        void setInput(signal, now);
      });
    }
    write = (signal, value) => {
      const dataType = types.get(signal.node);
      if (dataType === undefined) return;
      const sent = dataType === opcua.DataType.Boolean ? value === true || value === 1 : Number(value);
      void session
        .write({
          nodeId: signal.node,
          attributeId: opcua.AttributeIds.Value,
          value: { value: { dataType, value: sent } },
        })
        .then(status => {
          if (!status.isGood()) once(`${signal.node} does not take ${signal.line} of ${signal.robot}: ${status.name}.`);
        })
        .catch((problem: unknown) => once(`${signal.node} was not written: ${causeOf(problem)}.`));
    };
    for (const [signal, value] of told) write(signal, value);
  }
  const following = follow().catch((problem: unknown) => {
    if (!closed) say(`The PLC at ${url} is not followed: ${causeOf(problem)}.`);
  });
  const forget = states.listen({
    opened(robot) {
      for (const [signal, value] of lastOf) if (signal.robot === robot.id) void setInput(signal, value);
    },
    signals(robot) {
      for (const signal of signals) {
        if (signal.from !== "robot" || signal.robot !== robot.id) continue;
        const value = robot.signals.get(signal.line);
        if (value === undefined || told.get(signal) === value) continue;
        told.set(signal, value);
        write(signal, value);
      }
    },
  });
  return {
    address: `${NAME}: ${url}, ${signals.length} signals`,
    async close() {
      closed = true;
      forget();
      await client.disconnect();
      await following;
    },
  };
}
