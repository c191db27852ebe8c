import type { Scheduler } from "@twincell/core";
import {
  faultyLine,
  type ByteStream,
  type FaultyLine,
  type LineFaults,
  type Listening,
  type Network,
} from "../../transport/index.ts";
import { MessageReader, type Message } from "../codec/simple-message.ts";

/** States that a client does not fetch are not piled up for it [bytes]. */
const MOST_WAITING = 65_536;

export interface SocketOptions {
  readonly network: Network;
  readonly host: string;
  readonly port: number;
  readonly scheduler: Scheduler;
  readonly faults: LineFaults;
  readonly log: (sentence: string) => void;
  readonly onMessage: (message: Message) => void;
  readonly onChange: (connected: boolean) => void;
}
export interface ServerSocket {
  readonly listening: Listening;
  readonly isConnected: boolean;
  send(bytes: Uint8Array): void;
  cut(): void;
  close(): void;
}

/**
 * One of the two sockets of ros_server: a TCP server that has one client at a time. A client that comes while another
 * is there takes its place: the one before may be gone without a word. Whoever sends what is no message is logged once
 * and cut off.
 */
export async function serveSocket(options: SocketOptions): Promise<ServerSocket> {
  const { network, host, port, scheduler, faults, log } = options;
  let client: ByteStream | null = null;
  let line: FaultyLine = faultyLine(faults, scheduler, port);
  let seed = port;

  function cut(): void {
    if (!client) return;
    client.close();
    client = null;
    options.onChange(false);
  }
  const listening = await network.listen({ host, port }, stream => {
    if (faults.refusing) {
      stream.close();
      return;
    }
    cut();
    client = stream;
    line = faultyLine(faults, scheduler, ++seed);
    const reader = new MessageReader();
    const mine = (): boolean => client === stream;
    stream.onEnd(() => {
      if (mine()) cut();
    });
    options.onChange(true);
    stream.onBytes(lent => {
      if (!mine()) return;
      const why = reader.push(lent, message => {
        options.onMessage(message);
        return mine();
      });
      if (why && mine()) {
        log(`${stream.peer.host}:${stream.peer.port}: ${why} The connection is reset.`);
        cut();
      }
    });
  });
  return {
    listening,
    cut,
    get isConnected() {
      return client !== null;
    },
    send(bytes) {
      const to = client;
      if (!to || to.waiting > MOST_WAITING) return;
      line.send(bytes, said => {
        to.send(said);
      });
      if (--faults.dropAfter <= 0) {
        faults.dropAfter = Infinity;
        cut();
      }
    },
    close() {
      if (listening.kind === "listening") listening.close();
      cut();
    },
  };
}
