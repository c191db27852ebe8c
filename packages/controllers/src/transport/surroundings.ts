import { seededRandom, type Scheduler, type Random } from "@twincell/core";
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

const isStill = ({ hangs, unplugged }: FaultInjection): boolean => hangs || unplugged;
/** Parcels of one direction of one connection, in order. */
class Line {
  waiting = 0;
  private readonly clock: Scheduler;
  private readonly random: Random;
  private readonly faults: FaultInjection;
  private readonly parcels: Parcel[] = [];
  constructor(clock: Scheduler, random: Random, faults: FaultInjection) {
    this.clock = clock;
    this.random = random;
    this.faults = faults;
  }
  /** False when too much waits: the connection is to be cut. */
  post(bytes: Uint8Array, deliver: (bytes: Uint8Array) => void, lossy: boolean): boolean {
    if (lossy && (isStill(this.faults) || this.random() < this.faults.loss)) return true;
    const late_s =
      this.faults.delay_s + (!lossy && this.faults.loss > 0 && this.random() < this.faults.loss ? AGAIN_S : 0);
    if (this.parcels.length === 0 && late_s === 0 && !isStill(this.faults)) {
      deliver(bytes);
      return true;
    }
    const copy = bytes.slice();
    const last = this.parcels.at(-1);
    this.waiting += copy.length;
    this.parcels.push({
      due_s: Math.max(this.clock.now_s() + late_s, last?.due_s ?? 0),
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

/**
 * Puts a network and a clock between a controller and the world, on which things go wrong by switch: whatever the
 * brand, and whatever the network is. A controller made on `network` and `scheduler` need not know of it.
 */
export function emulateNetwork(inner: Network, clock: Scheduler, seed = 1): NetworkEmulator {
  return emulateNetworkOf(new EmulatedNetwork(inner, clock, seed));
}

class EmulatedNetwork {
  readonly inner: Network;
  readonly clock: Scheduler;
  readonly seed: number;
  readonly faultInjection: FaultInjection = { delay_s: 0, loss: 0, hangs: false, unplugged: false };
  readonly random: Random;
  readonly streams = new Map<ByteStream, string>();
  readonly heard = new Map<string, number>();
  readonly lines = new Set<Line>();
  hung_s = 0;
  since_s = 0;
  wasHung = false;
  readonly stop: () => void;
  readonly scheduler: Scheduler;

  constructor(inner: Network, clock: Scheduler, seed = 1) {
    this.inner = inner;
    this.clock = clock;
    this.seed = seed;
    this.random = seededRandom(this.seed);
    this.stop = this.clock.every(TICK_S, () => {
      if (this.faultInjection.hangs !== this.wasHung) {
        this.wasHung = this.faultInjection.hangs;
        if (this.wasHung) this.since_s = this.clock.now_s();
        else this.hung_s += this.clock.now_s() - this.since_s;
      }
      if (this.still()) return;
      for (const line of this.lines) if (line.waiting > 0) line.flush(this.clock.now_s());
    });
    this.scheduler = {
      now_s: () => (this.wasHung ? this.since_s : this.clock.now_s()) - this.hung_s,
      every: (period_s, tick) =>
        this.clock.every(period_s, () => {
          if (!this.wasHung) tick();
        }),
    };
  }

  still(): boolean {
    return isStill(this.faultInjection);
  }

  newLine(): Line {
    return new Line(this.clock, this.random, this.faultInjection);
  }

  around(stream: ByteStream, where: string): ByteStream {
    const out = this.newLine();
    const into = this.newLine();
    const end = (): void => {
      this.lines.delete(out);
      this.lines.delete(into);
      this.streams.delete(mine);
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
    this.lines.add(out);
    this.lines.add(into);
    this.streams.set(mine, `${addressText(stream.peer)} at ${where}`);
    return mine;
  }

  aroundSocket(socket: DatagramSocket): DatagramSocket {
    const out = this.newLine();
    const into = this.newLine();
    this.lines.add(out);
    this.lines.add(into);
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
      onDatagram: listen => {
        socket.onDatagram((lent, from: Address) => {
          const who = `${addressText(from)} at ${socket.address.port}`;
          if (!this.still() && (this.heard.has(who) || this.heard.size < MOST_PEERS))
            this.heard.set(who, this.clock.now_s());
          into.post(
            lent,
            late => {
              listen(late, from);
            },
            true,
          );
        });
      },
      close: () => {
        this.lines.delete(out);
        this.lines.delete(into);
        socket.close();
      },
    };
  }
}

function emulateNetworkOf(own: EmulatedNetwork): NetworkEmulator {
  return {
    trouble: own.faultInjection,
    scheduler: own.scheduler,
    network: {
      connect: async to => {
        const connected = await own.inner.connect(to);
        return connected.kind === "refused"
          ? connected
          : { kind: "connected", stream: own.around(connected.stream, addressText(to)) };
      },
      listen: (at, accept) =>
        own.inner.listen(at, stream => {
          accept(own.around(stream, String(at.port)));
        }),
      bind: async at => {
        const bound = await own.inner.bind(at);
        return bound.kind === "taken" ? bound : { kind: "bound", socket: own.aroundSocket(bound.socket) };
      },
    },
    peers() {
      const now_s = own.clock.now_s();
      for (const [who, at_s] of own.heard) if (now_s - at_s > LATELY_S) own.heard.delete(who);
      return [...own.streams.values(), ...own.heard.keys()];
    },
    close() {
      own.stop();
      for (const line of own.lines) line.clear();
      own.lines.clear();
      own.streams.clear();
      own.heard.clear();
    },
  };
}
