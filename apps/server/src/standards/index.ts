import type { StandardContext, StartedStandard } from "./standard.ts";
import type { SparkplugOptions } from "./sparkplug/sparkplug.ts";
import { startTelemetry, type ObservedRequest } from "./telemetry/telemetry.ts";

/** Which standards a server speaks besides its API; none that is not named. */
export interface StandardsOptions {
  /** Ports to listen on; 0 takes any free one. */
  readonly opcua?: number | undefined;
  readonly rosbridge?: number | undefined;
  readonly foxglove?: number | undefined;
  readonly modbus?: number | undefined;
  /** File that says which lines are at which Modbus address. */
  readonly modbusLines?: string | undefined;
  readonly sparkplug?: SparkplugOptions | undefined;
  /** File of addresses that are told what happens. */
  readonly webhooks?: string | undefined;
  /** File that says which nodes of a PLC's OPC UA server belong to which lines. */
  readonly plc?: string | undefined;
  /** Address of a collector that takes OTLP over HTTP. */
  readonly otlp?: string | undefined;
}
export interface StartedStandards {
  /** One line each for whoever started the server. */
  readonly addresses: readonly string[];
  request(observed: ObservedRequest): void;
  close(): Promise<void>;
}

/** Starts those that are asked for; each is loaded only then. When one cannot start, none is left running. */
export async function startStandards(context: StandardContext, options: StandardsOptions): Promise<StartedStandards> {
  const { opcua, rosbridge, foxglove, modbus, modbusLines, sparkplug, webhooks, otlp, plc } = options;
  const started: StartedStandard[] = [];
  let telemetry: Awaited<ReturnType<typeof startTelemetry>> | undefined;
  const close = async (): Promise<void> => {
    for (const standard of started.splice(0).reverse()) await standard.close();
  };
  try {
    if (otlp !== undefined) started.push((telemetry = await startTelemetry(context, otlp)));
    if (webhooks !== undefined) started.push((await import("./webhooks/webhooks.ts")).startWebhooks(context, webhooks));
    if (modbus !== undefined)
      started.push(await (await import("./modbus/modbus.ts")).startModbus(context, modbus, modbusLines));
    if (foxglove !== undefined)
      started.push(await (await import("./foxglove/foxglove.ts")).startFoxglove(context, foxglove));
    if (rosbridge !== undefined)
      started.push(await (await import("./rosbridge/rosbridge.ts")).startRosbridge(context, rosbridge));
    if (sparkplug !== undefined)
      started.push(await (await import("./sparkplug/sparkplug.ts")).startSparkplug(context, sparkplug));
    if (plc !== undefined) started.push(await (await import("./plc/plc.ts")).startPlc(context, plc));
    if (opcua !== undefined) started.push(await (await import("./opcua/opcua.ts")).startOpcua(context, opcua));
  } catch (problem) {
    await close();
    throw problem;
  }
  return {
    addresses: started.map(({ address }) => address),
    request(observed) {
      telemetry?.request(observed);
    },
    close,
  };
}
