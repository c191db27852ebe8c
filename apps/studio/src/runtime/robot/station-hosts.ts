import { withRobots } from "../hire.ts";
import { createClient, type Client, type ConnectionEvent, type EventOf } from "@twincell/protocol";
import { stationStore, type ServerAddress } from "../../stores/stations.ts";

export type Told = Exclude<ConnectionEvent, EventOf<"answer" | "pong">>;
type Listen = (place: ServerAddress, message: Told) => void;

const now_s = (): number => performance.now() / 1000;
const clients = new Map<ServerAddress, Client>();
let listen: Listen = () => {
  /* Nobody listens yet. */
};

export function onServers(to: Listen): void {
  listen = to;
}

/** The host in a worker of the page; it is hired when the first station is wanted. */
function pageHost(): Client {
  const worker = withRobots(
    new Worker(new URL("../../workers/station.worker.ts", import.meta.url), { type: "module" }),
  );
  const client = createClient(
    {
      send: text => {
        worker.postMessage(text);
      },
      close: () => {
        worker.terminate();
      },
    },
    now_s,
    message => {
      listen("page", message);
    },
  );
  worker.addEventListener("message", ({ data }: MessageEvent<string>) => {
    client.hear(data);
  });
  worker.addEventListener("error", event => {
    clients.delete("page");
    client.gone();
    listen("page", { type: "fault", sentence: event.message || "The virtual controllers of the page have stopped." });
  });
  return client;
}

export function hostAt(place: ServerAddress): Client | undefined {
  const known = clients.get(place);
  if (known || place === "server") return known;
  const client = pageHost();
  clients.set("page", client);
  return client;
}

/** Asks whether the server that served this page hosts stations, and stays connected if it does. */
export function lookForServer(): void {
  if (clients.has("server")) return;
  const address = new URL("/stations", location.href);
  address.protocol = location.protocol === "https:" ? "wss:" : "ws:";
  const socket = new WebSocket(address);
  const waiting: string[] = [];
  const client = createClient(
    {
      send(text) {
        if (socket.readyState === WebSocket.OPEN) socket.send(text);
        else waiting.push(text);
      },
      close() {
        socket.close();
      },
    },
    now_s,
    message => {
      listen("server", message);
    },
  );
  socket.addEventListener("open", () => {
    for (const text of waiting.splice(0)) socket.send(text);
    clients.set("server", client);
    stationStore.setState({ server: true });
  });
  socket.addEventListener("message", ({ data }: MessageEvent<string>) => {
    client.hear(data);
  });
  socket.addEventListener("close", () => {
    const was = clients.delete("server");
    client.gone();
    stationStore.setState({ server: false });
    if (was) listen("server", { type: "fault", sentence: "The connection to the server is gone." });
  });
}
