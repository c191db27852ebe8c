import type { Span } from "@opentelemetry/api";
import { causeOf, type StandardContext, type StartedStandard } from "../standard.ts";

/** One answered request of the HTTP API. */
export interface ObservedRequest {
  /** Its name in the OpenAPI document. */
  readonly route: string;
  readonly method: string;
  readonly status: number;
  readonly began_ms: number;
}
export interface Telemetry extends StartedStandard {
  request(observed: ObservedRequest): void;
}
/** Acts that have begun and not ended are remembered up to this many. */
const MOST_OPEN = 1000;
/** Requests that only look are told up to this many a second; those that command always are. */
const MOST_LOOKS = 20;

/**
 * Traces by OTLP over HTTP: one span for each request of the API and for each act at a robot, from when it was asked
 * for to what became of it. Never one a sample.
 */
export async function startTelemetry(context: StandardContext, url: string): Promise<Telemetry> {
  const [
    { SpanKind, SpanStatusCode },
    { BatchSpanProcessor, TracerProvider },
    { OTLPTraceExporter },
    { resourceFromAttributes },
  ] = await Promise.all([
    import("@opentelemetry/api"),
    import("@opentelemetry/sdk-trace"),
    import("@opentelemetry/exporter-trace-otlp-http"),
    import("@opentelemetry/resources"),
  ]);
  const exporter = new OTLPTraceExporter({ url: new URL("/v1/traces", url).href });
  const provider = new TracerProvider({
    resource: resourceFromAttributes({ "service.name": "twincell", "service.version": context.version }),
    spanProcessors: [new BatchSpanProcessor({ exporter })],
  });
  const tracer = provider.getTracer("twincell");
  const acts = new Map<number, Span>();
  let second = 0;
  let looks = 0;
  const forget = context.states.listen({
    event(event) {
      if (event.type !== "act") return;
      const begun = acts.get(event.number);
      if (event.outcome === null) {
        if (acts.size >= MOST_OPEN) return;
        const { station, who, action, detail } = event;
        const attributes = { "twincell.robot": station, "twincell.who": who, "twincell.detail": detail.slice(0, 200) };
        acts.set(event.number, tracer.startSpan(action, { kind: SpanKind.INTERNAL, attributes }));
        return;
      }
      if (!begun) return;
      acts.delete(event.number);
      begun.setAttribute("twincell.outcome", event.outcome.kind);
      if (event.outcome.kind !== "done") {
        const { code, sentence } = event.outcome.why;
        begun.setAttribute("twincell.why", code);
        begun.setStatus({ code: SpanStatusCode.ERROR, message: sentence });
      }
      begun.end();
    },
  });
  return {
    address: `OpenTelemetry: ${new URL(url).host}`,
    request({ route, method, status, began_ms }) {
      const now = Math.floor(context.now_ms() / 1000);
      if (now !== second) {
        second = now;
        looks = 0;
      }
      if (method === "GET" && ++looks > MOST_LOOKS) return;
      const attributes = { "http.request.method": method, "http.response.status_code": status, "http.route": route };
      const span = tracer.startSpan(`${method} ${route}`, { kind: SpanKind.SERVER, startTime: began_ms, attributes });
      if (status >= 500) span.setStatus({ code: SpanStatusCode.ERROR });
      span.end(context.now_ms());
    },
    async close() {
      forget();
      for (const span of acts.values()) span.end();
      try {
        await provider.shutdown();
      } catch (problem) {
        context.say(`The last traces were not taken: ${causeOf(problem)}.`);
      }
    },
  };
}
