/** Parts that an installed package leaves out until somebody wants them, with the versions that are tested. */
export const OPTIONAL_PARTS = [
  { name: "@mujoco/mujoco", version: "3.14.0", what: "Physics" },
  { name: "occt-import-js", version: "0.0.23", what: "Reading STEP files" },
  { name: "node-opcua", version: "2.186.4", what: "OPC UA" },
  { name: "mqtt", version: "5.16.0", what: "Sparkplug B" },
  { name: "@opentelemetry/api", version: "1.10.0", what: "OpenTelemetry" },
  { name: "@opentelemetry/sdk-trace", version: "3.1.0", what: "OpenTelemetry" },
  { name: "@opentelemetry/resources", version: "3.1.0", what: "OpenTelemetry" },
  { name: "@opentelemetry/exporter-trace-otlp-http", version: "0.301.0", what: "OpenTelemetry" },
  { name: "@nats-io/transport-node", version: "3.4.0", what: "A cluster of servers" },
  { name: "@nats-io/jetstream", version: "3.4.0", what: "A cluster of servers" },
  { name: "@nats-io/kv", version: "3.4.0", what: "A cluster of servers" },
  { name: "@simplewebauthn/server", version: "14.0.3", what: "Signing in by passkey" },
] as const;

/** The sentence about an optional part that is not installed, or undefined for every other problem. */
export function missingPart(problem: unknown): string | undefined {
  if (!(problem instanceof Error) || !("code" in problem) || problem.code !== "ERR_MODULE_NOT_FOUND") return undefined;
  const part = OPTIONAL_PARTS.find(({ name }) => problem.message.includes(`'${name}'`));
  return part && `${part.what} needs a part that is not installed. Run npm install ${part.name}@${part.version}`;
}
