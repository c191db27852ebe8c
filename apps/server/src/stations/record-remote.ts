import { WebSocket } from "ws";
import { STATIONS_PATH } from "./socket.ts";
import { recordStations, type StationRecorderOptions } from "./recorder.ts";

export interface RemoteRecorder {
  /** Resolves when the connection ends: with a sentence when nobody here ended it. */
  readonly ended: Promise<string | null>;
  close(): void;
}

const TICK_MS = 100;

/** Records the stations of another server, over the same channel by which a studio looks at them. */
export function recordRemote(url: URL, options: Omit<StationRecorderOptions, "now_s">): RemoteRecorder {
  const address = new URL(STATIONS_PATH, url);
  address.protocol = url.protocol === "https:" ? "wss:" : "ws:";
  const socket = new WebSocket(address, { perMessageDeflate: false });
  let asked = false;
  let why: string | null = `The server at ${url.host} ended the connection.`;
  const recorder = recordStations(
    {
      send: text => {
        if (socket.readyState === WebSocket.OPEN) socket.send(text);
      },
      close: () => {
        socket.close();
      },
    },
    { ...options, now_s: () => performance.now() / 1000 },
  );
  const timer = setInterval(() => {
    recorder.tick().catch((problem: unknown) => {
      options.onTrouble?.(
        `Recordings could not be tidied: ${problem instanceof Error ? problem.message : String(problem)}.`,
      );
    });
  }, TICK_MS);
  socket.on("message", (data, binary) => {
    if (!binary) recorder.hear(String(data as Buffer));
  });
  socket.on("error", problem => {
    why = `The server at ${url.host} cannot be reached: ${problem.message || "it does not answer"}.`;
  });
  return {
    ended: new Promise(resolve => {
      socket.on("close", () => {
        clearInterval(timer);
        recorder.close();
        resolve(asked ? null : why);
      });
    }),
    close() {
      asked = true;
      socket.close();
    },
  };
}
