import { seededRandom, type Scheduler } from "@twincell/core";
import { addressText, type Address, type ByteStream, type DatagramSocket, type Network } from "./port.ts";

/** What befalls a controller that stands on a network, by switch. All at rest by default. */
export interface FaultInjection {
  /** Everything it says and hears comes so much later [s]. */
  delay_s: number;
  /** Part of the datagrams that are lost, and of the chunks of a connection that have to be sent again, 0 … 1. */
  loss: number;
  /** The controller hangs: its clock, its motion and its answers stand still, its connections stay. */
  hangs: boolean;
  /** The network plug is out: nothing comes or goes, nobody is told. */
  unplugged: boolean;
}
export interface NetworkEmulator {
  readonly network: Network;
  readonly scheduler: Scheduler;
  readonly trouble: FaultInjection;
  /** Who is connected, and who has sent datagrams lately. */
  peers(): readonly string[];
  close(): void;
}

/** What TCP waits before it sends a chunk again [s]. */
const AGAIN_S = 0.2;
/** Who has sent a datagram within this time counts as connected [s]. */
const LATELY_S = 2;
const TICK_S = 0.002;
const MOST_WAITING = 1 << 20;
const MOST_PEERS = 64;

interface Parcel {
  due_s: number;
  readonly bytes: number;
  readonly deliver: () => void;
}

/**
 * Puts a network and a clock between a controller and the world, on which things go wrong by switch: whatever the
 * brand, and whatever the network is. A controller made on `network` and `scheduler` need not know of it.
 */
export function emulateNetwork(inner: Network, clock: Scheduler, seed = 1): NetworkEmulator {
  const faultInjection: FaultInjection = { delay_s: 0, loss: 0, hangs: false, unplugged: false };
  const random = seededRandom(seed);
  const streams = new Map<ByteStream, string>();
  const heard = new Map<string, number>();
  const lines = new Set<Line>();
  let hung_s = 0;
  let since_s = 0;
  let wasHung = false;
  const still = (): boolean => faultInjection.hangs || faultInjection.unplugged;

  /** Parcels of one direction of one connection, in order. */
  class Line {
    waiting = 0;
    private readonly parcels: Parcel[] = [];
    /** False when too much waits: the connection is to be cut. */
    post(bytes: Uint8Array, deliver: (bytes: Uint8Array) => void, lossy: boolean): boolean {
      if (lossy && (still() || random() < faultInjection.loss)) return true;
      const late_s =
        faultInjection.delay_s + (!lossy && faultInjection.loss > 0 && random() < faultInjection.loss ? AGAIN_S : 0);
      if (this.parcels.length === 0 && late_s === 0 && !still()) {
        deliver(bytes);
        return true;
      }
      const copy = bytes.slice();
      const last = this.parcels.at(-1);
      this.waiting += copy.length;
      this.parcels.push({
        due_s: Math.max(clock.now_s() + late_s, last?.due_s ?? 0),
        bytes: copy.length,
        deliver: () => {
          deliver(copy);
        },
      });
      return this.waiting <= MOST_WAITING;
    }
    flush(now_s: number): void {
      while (this.parcels.length > 0 && this.parcels[0]!.due_s <= now_s + 1e-9) {
        const parcel = this.parcels.shift()!;
        this.waiting -= parcel.bytes;
        parcel.deliver();
      }
    }
    clear(): void {
      this.parcels.length = 0;
      this.waiting = 0;
    }
  }

  const stop = clock.every(TICK_S, () => {
    if (faultInjection.hangs !== wasHung) {
      wasHung = faultInjection.hangs;
      if (wasHung) since_s = clock.now_s();
      else hung_s += clock.now_s() - since_s;
    }
    if (still()) return;
    for (const line of lines) if (line.waiting > 0) line.flush(clock.now_s());
  });
  const scheduler: Scheduler = {
    now_s: () => (wasHung ? since_s : clock.now_s()) - hung_s,
    every: (period_s, tick) =>
      clock.every(period_s, () => {
        if (!wasHung) tick();
      }),
  };

  function around(stream: ByteStream, where: string): ByteStream {
    const out = new Line();
    const into = new Line();
    const end = (): void => {
      lines.delete(out);
      lines.delete(into);
      streams.delete(mine);
      out.clear();
      into.clear();
    };
    const tooMuch = (fits: boolean): void => {
      if (!fits) {
        end();
        stream.close();
      }
    };
    const mine: ByteStream = {
      peer: stream.peer,
      get waiting() {
        return stream.waiting + out.waiting;
      },
      send(bytes) {
        tooMuch(
          out.post(
            bytes,
            late => {
              stream.send(late);
            },
            false,
          ),
        );
      },
      onBytes(listen) {
        stream.onBytes(lent => {
          tooMuch(into.post(lent, listen, false));
        });
      },
      onEnd(listen) {
        stream.onEnd(ending => {
          end();
          listen(ending);
        });
      },
      close() {
        end();
        stream.close();
      },
    };
    lines.add(out);
    lines.add(into);
    streams.set(mine, `${addressText(stream.peer)} at ${where}`);
    return mine;
  }
  function aroundSocket(socket: DatagramSocket): DatagramSocket {
    const out = new Line();
    const into = new Line();
    lines.add(out);
    lines.add(into);
    return {
      address: socket.address,
      send(bytes, to) {
        out.post(
          bytes,
          late => {
            socket.send(late, to);
          },
          true,
        );
      },
      onDatagram(listen) {
        socket.onDatagram((lent, from: Address) => {
          const who = `${addressText(from)} at ${socket.address.port}`;
          if (!still() && (heard.has(who) || heard.size < MOST_PEERS)) heard.set(who, clock.now_s());
          into.post(
            lent,
            late => {
              listen(late, from);
            },
            true,
          );
        });
      },
      close() {
        lines.delete(out);
        lines.delete(into);
        socket.close();
      },
    };
  }

  return {
    trouble: faultInjection,
    scheduler,
    network: {
      connect: async to => {
        const connected = await inner.connect(to);
        return connected.kind === "refused"
          ? connected
          : { kind: "connected", stream: around(connected.stream, addressText(to)) };
      },
      listen: (at, accept) =>
        inner.listen(at, stream => {
          accept(around(stream, String(at.port)));
        }),
      bind: async at => {
        const bound = await inner.bind(at);
        return bound.kind === "taken" ? bound : { kind: "bound", socket: aroundSocket(bound.socket) };
      },
    },
    peers() {
      const now_s = clock.now_s();
      for (const [who, at_s] of heard) if (now_s - at_s > LATELY_S) heard.delete(who);
      return [...streams.values(), ...heard.keys()];
    },
    close() {
      stop();
      for (const line of lines) line.clear();
      lines.clear();
      streams.clear();
      heard.clear();
    },
  };
}
