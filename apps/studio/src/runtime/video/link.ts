import {
  createClockMap,
  readVideoEvent,
  VIDEO_PATH,
  VIDEO_PROTOCOL,
  writeVideo,
  type ClockMap,
  type VideoRequest,
  type VideoEvent,
} from "@twincell/protocol";

const PING_EVERY_MS = 500;
const SILENT_MS = 5000;
const FIRST_PAUSE_MS = 500;
const LONGEST_PAUSE_MS = 8000;

export interface VideoLinkListener {
  /** `sentence`: why it is gone, or "". */
  state(state: "connecting" | "open" | "gone", sentence: string): void;
  tell(message: Exclude<VideoEvent, { type: "pong" | "hello" | "fault" }>): void;
  links?(links: readonly string[]): void;
  /** A picture that came at `at_s` of the page's clock. */
  picture?(bytes: Uint8Array, at_s: number): void;
}
export interface VideoLink {
  say(message: VideoRequest): void;
  picture(bytes: Uint8Array): void;
  /** How the relay's clock stands to the page's. */
  readonly clock: ClockMap;
  /** Bytes that the line has not taken yet. */
  readonly waiting: number;
  close(): void;
}
const now_s = (): number => performance.now() / 1000;

/** The line to the relay of the server that served this page; it comes back by itself, with growing pauses. */
export function openVideoLink(listener: VideoLinkListener): VideoLink {
  const address = new URL(VIDEO_PATH, location.origin);
  address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
  let socket: WebSocket | null = null;
  let clock = createClockMap();
  let closed = false;
  let pause_ms = FIRST_PAUSE_MS;
  let timer = 0;
  let heard_ms = 0;
  let why = "";
  const say = (message: VideoRequest): void => {
    if (socket?.readyState === WebSocket.OPEN) socket.send(writeVideo(message));
  };

  function hear(text: string): void {
    const heard = readVideoEvent(text);
    if (heard.kind === "fault") {
      why = heard.sentence;
      socket?.close();
      return;
    }
    const { message } = heard;
    switch (message.type) {
      case "pong":
        clock.heard(message.sent_s, message.relay_s, now_s());
        return;
      case "fault":
        why = message.sentence;
        return;
      case "hello":
        if (message.protocol !== VIDEO_PROTOCOL) {
          why = "The server is of another release than this page. Load the page again.";
          socket?.close();
          return;
        }
        pause_ms = FIRST_PAUSE_MS;
        listener.links?.(message.links);
        listener.state("open", "");
        return;
      default:
        listener.tell(message);
    }
  }
  function connect(): void {
    listener.state("connecting", why);
    why = "";
    clock = createClockMap();
    const mine = (socket = new WebSocket(address));
    mine.binaryType = "arraybuffer";
    heard_ms = performance.now();
    mine.addEventListener("open", () => {
      for (let i = 0; i < 4; i++) say({ type: "ping", sent_s: now_s() });
    });
    mine.addEventListener("message", ({ data }: MessageEvent<string | ArrayBuffer>) => {
      heard_ms = performance.now();
      if (typeof data === "string") hear(data);
      else listener.picture?.(new Uint8Array(data), heard_ms / 1000);
    });
    mine.addEventListener("close", () => {
      if (closed || socket !== mine) return;
      listener.state("gone", why || "The Twincell server does not answer. It is tried again.");
      timer = window.setTimeout(connect, pause_ms);
      pause_ms = Math.min(LONGEST_PAUSE_MS, 2 * pause_ms);
    });
  }
  const beat = window.setInterval(() => {
    if (socket?.readyState !== WebSocket.OPEN) return;
    // Half open: the other end is gone and nobody said so.
    if (performance.now() - heard_ms > SILENT_MS) {
      why = `Nothing was heard of the server for ${SILENT_MS / 1000} s. It is tried again.`;
      socket.close();
      return;
    }
    say({ type: "ping", sent_s: now_s() });
  }, PING_EVERY_MS);
  connect();
  return {
    say,
    picture(bytes) {
      if (socket?.readyState === WebSocket.OPEN) socket.send(bytes as Uint8Array<ArrayBuffer>);
    },
    get clock() {
      return clock;
    },
    get waiting() {
      return socket?.bufferedAmount ?? 0;
    },
    close() {
      closed = true;
      clearInterval(beat);
      clearTimeout(timer);
      socket?.close();
    },
  };
}
