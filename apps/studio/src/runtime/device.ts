import { stationOf, stationStore } from "../stores/stations.ts";
import { connectionStore } from "../stores/connection.ts";
import { headsetStore } from "../stores/headset.ts";
import { offlineStore } from "../stores/offline.ts";
import { lookForServer } from "./robot/station-hosts.ts";

/** What this device and page can do; "missing" has a sentence of what to do about it. */
export type DeviceFinding = "ok" | "missing" | "unknown";
export interface DeviceReport {
  readonly secure: DeviceFinding;
  readonly certificate: DeviceFinding;
  readonly headset: DeviceFinding;
  /** Why there is no headset; "" where there is one. */
  readonly headsetWhy: string;
  readonly camera: DeviceFinding;
  readonly graphics: DeviceFinding;
  readonly socket: DeviceFinding;
}

/** Looks at this device and page now. Asks for no permission and opens nothing; `lookForCamera` comes before it. */
export function lookAtDevice(): DeviceReport {
  const { ready, reason } = headsetStore.getState();
  const { state } = offlineStore.getState();
  const { server } = stationStore.getState();
  const local = ["localhost", "127.0.0.1", "[::1]"].includes(location.hostname);
  return {
    secure: found(window.isSecureContext),
    // A browser keeps no page whose certificate it does not trust; on this machine itself none is needed.
    certificate: local || state === "kept" ? "ok" : state === "unsupported" ? "missing" : "unknown",
    headset: ready === null ? "unknown" : found(ready),
    headsetWhy: ready === false ? reason : "",
    camera,
    graphics: found(hasWebGl2()),
    socket: server === null ? "unknown" : found(server),
  };
}
const found = (there: boolean): DeviceFinding => (there ? "ok" : "missing");

let camera: DeviceFinding = "unknown";
/** Looks whether this device has a camera that the page may ask for. That it is there is told without permission. */
export async function lookForCamera(): Promise<void> {
  if (!window.isSecureContext || !("mediaDevices" in navigator)) {
    camera = "missing";
    return;
  }
  try {
    camera = found((await navigator.mediaDevices.enumerateDevices()).some(({ kind }) => kind === "videoinput"));
  } catch {
    camera = "missing"; // The page's own rules, or its browser's, keep it from asking.
  }
}

let webGl2: boolean | null = null;
function hasWebGl2(): boolean {
  if (webGl2 !== null) return webGl2;
  const view = document.createElement("canvas").getContext("webgl2");
  webGl2 = view !== null;
  // Browsers count contexts: this one is given back.
  view?.getExtension("WEBGL_lose_context")?.loseContext();
  return webGl2;
}

/** How late things are, each by itself [ms]; NaN where nothing was measured yet. */
export interface Latency {
  /** From the finger, mouse or key to our script: median of the last events. */
  readonly input_ms: number;
  /** A frame's script and drawing: median of the last frames. */
  readonly render_ms: number;
  /** The age of a sample of the connected controller when it comes; without one, the way to the server and back. */
  readonly link_ms: number;
  /** One cycle of the connected controller, as its samples come. */
  readonly controller_ms: number;
}

const KEPT = 64;
const ASK_EVERY_MS = 1000;
const EVENTS = ["pointermove", "pointerdown", "keydown"] as const;

/**
 * Measures as long as it runs.
 *
 * @param tell called four times a second
 */
export function measureLatency(tell: (latency: Latency) => void): () => void {
  const inputs_ms: number[] = [];
  let server_ms = NaN;
  let over = false;
  const hear = (event: Event): void => {
    inputs_ms.push(Math.max(0, performance.now() - event.timeStamp));
    if (inputs_ms.length > KEPT) inputs_ms.shift();
  };
  const ask = async (): Promise<void> => {
    const began = performance.now();
    try {
      if (stationStore.getState().server === true) {
        await fetch("/api/v1/session", { cache: "no-store" });
        server_ms = performance.now() - began;
      } else server_ms = NaN;
    } catch {
      server_ms = NaN;
    }
    if (!over) timer = setTimeout(() => void ask(), ASK_EVERY_MS);
  };
  let timer: ReturnType<typeof setTimeout> | undefined;
  for (const name of EVENTS) window.addEventListener(name, hear, { capture: true, passive: true });
  // Nothing asks for the server before a robot is wanted: here it is what is looked at.
  lookForServer();
  void ask();
  const telling = setInterval(() => {
    const { station } = connectionStore.getState();
    const link = station === null ? undefined : stationOf(station)?.link;
    const frames = window.twincellScene?.meter.summary();
    tell({
      input_ms: median(inputs_ms),
      render_ms: frames && frames.frames > 0 ? frames.script.median + frames.draw.median : NaN,
      link_ms: link ? 1000 * link.late_s : server_ms,
      controller_ms: link && link.rate_Hz > 0 ? 1000 / link.rate_Hz : NaN,
    });
  }, 250);
  return () => {
    over = true;
    clearTimeout(timer);
    clearInterval(telling);
    for (const name of EVENTS) window.removeEventListener(name, hear, { capture: true });
  };
}
const median = (values: readonly number[]): number =>
  values.length === 0 ? NaN : values.toSorted((a, b) => a - b)[values.length >> 1]!;
