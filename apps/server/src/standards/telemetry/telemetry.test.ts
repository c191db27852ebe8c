/** Traces read with the types that OpenTelemetry publishes for Python: `npm run clients` installs them. */
import { afterEach, expect, test } from "vitest";
import { foreignScript, isMissing, plant, YASKAWA, type Plant, type Script } from "../testing/foreign.ts";

let open: Plant | undefined;
let script: Script | undefined;
afterEach(async () => {
  await open?.close();
  script?.process.kill("SIGKILL");
  open = undefined;
});

test.skipIf(isMissing("opentelemetry.proto.collector.trace.v1.trace_service_pb2"))(
  "a collector is told a span for each request and for each act with its outcome and its time, and those that waited when the server closes",
  async () => {
    script = foreignScript("otlp_collector.py");
    const { port } = await script.next();
    open = await plant({ otlp: `http://127.0.0.1:${String(port)}` }, YASKAWA);
    const lease = await open.lease();
    await open.ask("POST", "/robots/arm/move", { q_rad: [99, 0, 0, 0, 0, 0] }, lease);
    await open.close();
    open = undefined;
    const spans: Record<string, unknown>[] = [];
    const has = (fits: (span: Record<string, unknown>) => boolean): boolean => spans.some(fits);
    while (
      !has(({ name, error }) => name === "moves the joints" && error === true) ||
      !has(({ name }) => name === "POST move")
    )
      spans.push(await script.next());
    const moves = spans.filter(({ name }) => name === "moves the joints");
    expect(moves).toMatchObject([{ "twincell.robot": "arm", "twincell.outcome": "refused", error: true }]);
    const connects = spans.find(({ name }) => name === "connects the controller")!;
    expect(connects).toMatchObject({
      service: "twincell",
      path: "/v1/traces",
      "twincell.outcome": "done",
      error: false,
    });
    expect(connects["ms"] as number).toBeGreaterThan(0);
    expect(spans.find(({ name }) => name === "POST openRobot")).toMatchObject({ "http.response.status_code": 200 });
  },
  60_000,
);
