import type {
  Address,
  Bound,
  ByteStream,
  Connected,
  DatagramSocket,
  Ending,
  Listening,
  Network,
} from "@twincell/controllers";
import { createSocket } from "node:dgram";
import { connect, createServer, type AddressInfo, type Socket } from "node:net";

/** A connection that does not come about within this time is refused [ms]. */
const PATIENCE_MS = 5_000;

/** The system's sockets. Nagle is off: states are small and late is worse than many. */
export const nodeNetwork = (): Network => ({
  connect: to =>
    new Promise<Connected>(resolve => {
      const socket = connect({ host: to.host, port: to.port, noDelay: true });
      const refuse = (why: string): void => {
        socket.destroy();
        resolve({ kind: "refused", sentence: `${to.host}:${to.port} does not answer: ${why}.` });
      };
      const tooLong = (): void => {
        refuse(`no connection within ${PATIENCE_MS / 1000} s`);
      };
      const onError = (problem: Error): void => {
        refuse(problem.message);
      };
      socket.setTimeout(PATIENCE_MS, tooLong);
      socket.once("error", onError);
      socket.once("connect", () => {
        socket.setTimeout(0);
        socket.off("timeout", tooLong);
        socket.off("error", onError);
        resolve({ kind: "connected", stream: streamOf(socket) });
      });
    }),
  listen: (at, accept) =>
    new Promise<Listening>(resolve => {
      const open = new Set<Socket>();
      const server = createServer({ noDelay: true }, socket => {
        open.add(socket);
        socket.once("close", () => open.delete(socket));
        accept(streamOf(socket));
      });
      server.once("error", problem => {
        resolve({ kind: "taken", sentence: `${at.host}:${at.port} cannot be listened on: ${problem.message}.` });
      });
      server.listen(at.port, at.host, () => {
        resolve({
          kind: "listening",
          address: placeOf(server.address()),
          close: () => {
            server.close();
            for (const socket of open) socket.destroy();
          },
        });
      });
    }),
  bind: at =>
    new Promise<Bound>(resolve => {
      const socket = createSocket("udp4");
      socket.once("error", problem => {
        resolve({ kind: "taken", sentence: `${at.host}:${at.port} cannot be bound: ${problem.message}.` });
      });
      socket.bind(at.port, at.host, () => {
        const address = placeOf(socket.address());
        // A host that is gone is noticed by silence, as every datagram protocol must.
        socket.on("error", () => {
          socket.close();
        });
        resolve({ kind: "bound", socket: datagramsOf(socket, address) });
      });
    }),
});

const placeOf = (address: AddressInfo | string | null): Address =>
  address !== null && typeof address === "object"
    ? { host: address.address, port: address.port }
    : { host: "", port: 0 };

function streamOf(socket: Socket): ByteStream {
  let heard: ((ending: Ending) => void) | null = null;
  let ending: Ending | null = null;
  const end = (how: Ending): void => {
    if (ending) return;
    ending = how;
    heard?.(how);
  };
  socket.pause();
  socket.on("error", problem => {
    end({ sentence: `The connection broke: ${problem.message}.`, byPeer: true });
  });
  socket.on("close", () => {
    end({ sentence: "The other side closed the connection.", byPeer: true });
  });
  return {
    peer: { host: socket.remoteAddress ?? "", port: socket.remotePort ?? 0 },
    get waiting() {
      return socket.writableLength;
    },
    // The system keeps what it is given until it is sent, and callers may use their bytes again at once.
    send(bytes) {
      if (!ending && bytes.length > 0) socket.write(bytes.slice());
    },
    onBytes(listen) {
      socket.on("data", (bytes: Buffer) => {
        listen(bytes);
      });
      socket.resume();
    },
    onEnd(listen) {
      heard = listen;
      if (ending?.byPeer) listen(ending);
    },
    close() {
      ending ??= { sentence: "The connection was closed here.", byPeer: false };
      socket.end();
      socket.destroySoon();
    },
  };
}

function datagramsOf(socket: ReturnType<typeof createSocket>, address: Address): DatagramSocket {
  let open = true;
  socket.once("close", () => {
    open = false;
  });
  return {
    address,
    // Nobody there, no way there: for a datagram both are silence.
    send(bytes, to) {
      if (open)
        socket.send(bytes.slice(), to.port, to.host, () => {
          /* Silence is the answer. */
        });
    },
    onDatagram(listen) {
      socket.on("message", (bytes, from) => {
        listen(bytes, { host: from.address, port: from.port });
      });
    },
    close() {
      if (open) {
        open = false;
        socket.close();
      }
    },
  };
}
