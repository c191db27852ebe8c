import { seededRandom, type Scheduler, type Random } from "@twincell/core";
import { addressText, type Address, type ByteStream, type DatagramSocket, type Ending, type Network } from "./port.ts";
import { spoiled } from "./spoil.ts";
import { calm, type Side, type NetworkConditions } from "./weather.ts";

/** How often the memory network looks for what is due [s]. */
const TICK_S = 0.0005;
/** First port given to who asks for any. */
const FREE_PORT = 49_152;
/** Bytes kept for a listener that is not there yet; more ends the stream. */
const MOST_UNHEARD = 1 << 20;
/**
 * A system waits so long for a stream's packet to be confirmed before it sends it again, and so many times as long at
 * most [s].
 */
const RESEND_S = 0.2;
const MOST_RESENDS = 5;

export interface MemoryNetwork extends Network {
  /** Of everything, both ways. */
  readonly weather: NetworkConditions;
  /** Ends every stream without a word to the others when `halfOpen`, or with the ending a broken line has. */
  cut(halfOpen?: boolean): void;
  /** Bytes under way. */
  readonly underWay: number;
  close(): void;
}

interface Parcel {
  readonly due_s: number;
  readonly order: number;
  readonly line: object;
  readonly deliver: () => void;
  readonly bytes: number;
  readonly datagram: boolean;
  readonly towards: Side | "both";
}

/**
 * A network in memory on a given clock, with weather: for the page, where a virtual controller sits at the other end,
 * and for tests that break it. Streams keep their order under any delay; datagrams overtake each other where they may.
 *
 * @param seed  of everything that happens by chance.
 */
export function memoryNetwork(scheduler: Scheduler, seed = 1): MemoryNetwork {
  return memoryNetworkOf(new MemoryNetworkState(scheduler, seed));
}

class MemoryNetworkState {
  readonly scheduler: Scheduler;
  readonly seed: number;
  readonly conditions = calm();
  readonly random: Random;
  readonly servers = new Map<string, (stream: ByteStream) => void>();
  readonly sockets = new Map<
    string,
    { readonly receive: (bytes: Uint8Array, from: Address) => void; readonly side: Side }
  >();
  readonly cutters = new Set<(halfOpen: boolean) => void>();
  parcels: Parcel[] = [];
  order = 0;
  underWay = 0;
  nextPort = FREE_PORT;
  /** When the last parcel of a line arrives: none goes past it. */
  readonly latest = new WeakMap<object, number>();
  readonly stop: () => void;

  constructor(scheduler: Scheduler, seed = 1) {
    this.scheduler = scheduler;
    this.seed = seed;
    this.random = seededRandom(this.seed);
    this.stop = this.scheduler.every(TICK_S, () => {
      if (this.parcels.length === 0) return;
      if (this.conditions.frozen || this.conditions.deaf !== null) {
        for (const parcel of this.parcels) if (parcel.datagram && this.isHeld(parcel)) this.underWay -= parcel.bytes;
        this.parcels = this.parcels.filter(parcel => !(parcel.datagram && this.isHeld(parcel)));
      }
      const now_s = this.scheduler.now_s() + 1e-12;
      const isDue = (parcel: Parcel): boolean => parcel.due_s <= now_s && !this.isHeld(parcel);
      const due = this.parcels.filter(isDue).sort((a, b) => a.due_s - b.due_s || a.order - b.order);
      if (due.length === 0) return;
      this.parcels = this.parcels.filter(parcel => !isDue(parcel));
      for (const parcel of due) {
        this.underWay -= parcel.bytes;
        parcel.deliver();
      }
    });
  }

  freePort(taken: ReadonlyMap<string, unknown>, { host, port }: Address): Address {
    let at: Address = { host, port };
    while (at.port === 0 || (port === 0 && taken.has(addressText(at)))) at = { host, port: this.nextPort++ };
    return at;
  }

  /** Puts something on its way. `line` keeps its order; without one it may be overtaken. */
  post(bytes: number, deliver: () => void, line: object | null, towards: Side | "both"): void {
    let due_s = this.scheduler.now_s() + this.conditions.delay_s + this.conditions.jitter_s * this.random();
    if (line) {
      for (
        let again = 0;
        this.conditions.loss > 0 && again < MOST_RESENDS && this.random() < this.conditions.loss;
        again++
      )
        due_s += RESEND_S;
      due_s = Math.max(due_s, this.latest.get(line) ?? 0);
      this.latest.set(line, due_s);
    }
    this.parcels.push({
      due_s,
      order: this.order++,
      line: line ?? this.conditions,
      deliver,
      bytes,
      datagram: line === null,
      towards,
    });
    this.underWay += bytes;
  }

  /** Whoever calls needs an answer: a connection that is half open is not made. */
  isHeld({ towards }: Parcel): boolean {
    return (
      this.conditions.frozen ||
      (this.conditions.deaf !== null && (towards === "both" || towards === this.conditions.deaf))
    );
  }

  pair(client: Address, server: Address): readonly [ByteStream, ByteStream] {
    const one = this.half(server, "listener");
    const two = this.half(client, "caller");
    one.join(two);
    two.join(one);
    const cut = (halfOpen: boolean): void => {
      for (const end of [one, two]) end.breakLine(halfOpen);
      this.cutters.delete(cut);
    };
    this.cutters.add(cut);
    const forget = (): void => {
      if (one.ended() && two.ended()) this.cutters.delete(cut);
    };
    one.whenEnded(forget);
    two.whenEnded(forget);
    return [one.stream, two.stream];
  }

  half(peer: Address, towards: Side) {
    const line = {};
    let hear: ((lent: Uint8Array) => void) | null = null;
    let endHeard: ((ending: Ending) => void) | null = null;
    let ending: Ending | null = null;
    let unheard: Uint8Array[] = [];
    let unheardBytes = 0;
    let waiting = 0;
    let broken = false;
    let over: () => void = () => undefined;
    let other: { readonly arrive: (bytes: Uint8Array) => void; readonly end: (ending: Ending) => void } | null = null;
    const arrive = (bytes: Uint8Array): void => {
      if (ending) return;
      if (hear) {
        hear(bytes);
        return;
      }
      unheard.push(bytes);
      unheardBytes += bytes.length;
      if (unheardBytes > MOST_UNHEARD) {
        unheard = [];
        stream.close();
      }
    };
    const end = (how: Ending): void => {
      if (ending) return;
      ending = how;
      endHeard?.(how);
      over();
    };
    const endThere = (): void => {
      other?.end({ sentence: "The other side closed the connection.", byPeer: true });
    };
    const stream: ByteStream = {
      peer,
      get waiting() {
        return waiting;
      },
      send: bytes => {
        if (ending || bytes.length === 0) return;
        // Nobody takes them any more, and nobody says so.
        if (broken) {
          waiting += bytes.length;
          return;
        }
        const whole = spoiled(bytes, this.conditions, this.random);
        const step = this.conditions.pieces > 0 ? this.conditions.pieces : whole.length;
        for (let at = 0; at < whole.length; at += step) {
          const piece = whole.subarray(at, at + step);
          waiting += piece.length;
          this.post(
            piece.length,
            () => {
              waiting -= piece.length;
              other?.arrive(piece);
            },
            line,
            towards,
          );
        }
      },
      onBytes(listen) {
        hear = listen;
        const kept = unheard;
        unheard = [];
        unheardBytes = 0;
        for (const bytes of kept) if (!ending) listen(bytes);
      },
      onEnd(listen) {
        endHeard = listen;
        if (ending?.byPeer) listen(ending);
      },
      close: () => {
        if (ending) return;
        ending = { sentence: "The connection was closed here.", byPeer: false };
        over();
        if (!broken) this.post(0, endThere, line, towards);
      },
    };
    return {
      stream,
      arrive,
      end,
      join(to: typeof other) {
        other = to;
      },
      breakLine(halfOpen: boolean) {
        broken = true;
        other = null;
        if (!halfOpen) end({ sentence: "The connection broke.", byPeer: true });
      },
      ended: () => ending !== null,
      whenEnded(then: () => void) {
        over = then;
      },
    };
  }
}

function memoryNetworkOf(net: MemoryNetworkState): MemoryNetwork {
  return {
    weather: net.conditions,
    get underWay() {
      return net.underWay;
    },
    connect(to) {
      return new Promise(resolve => {
        net.post(
          0,
          () => {
            const accept = net.servers.get(addressText(to));
            if (!accept || net.conditions.refusing) {
              resolve({ kind: "refused", sentence: `Nobody answers at ${addressText(to)}.` });
              return;
            }
            const [client, server] = net.pair({ host: "127.0.0.1", port: net.nextPort++ }, to);
            accept(server);
            resolve({ kind: "connected", stream: client });
          },
          {},
          "both",
        );
      });
    },
    listen(wanted, accept) {
      const at = net.freePort(net.servers, wanted);
      const key = addressText(at);
      if (net.servers.has(key)) return Promise.resolve({ kind: "taken", sentence: `${key} is taken.` });
      net.servers.set(key, accept);
      return Promise.resolve({
        kind: "listening",
        address: at,
        close: () => {
          if (net.servers.get(key) === accept) net.servers.delete(key);
        },
      });
    },
    bind(wanted) {
      const at = net.freePort(net.sockets, wanted);
      const key = addressText(at);
      if (net.sockets.has(key)) return Promise.resolve({ kind: "taken", sentence: `${key} is taken.` });
      let hear: ((lent: Uint8Array, from: Address) => void) | null = null;
      const receive = (bytes: Uint8Array, from: Address): void => {
        hear?.(bytes, from);
      };
      const own = { receive, side: wanted.port === 0 ? "caller" : "listener" } as const;
      net.sockets.set(key, own);
      const socket: DatagramSocket = {
        address: at,
        send(bytes, to) {
          if (net.sockets.get(key) !== own || net.random() < net.conditions.loss) return;
          for (let copies = net.random() < net.conditions.duplicates ? 2 : 1; copies > 0; copies--) {
            const parcel = spoiled(bytes, net.conditions, net.random);
            net.post(
              parcel.length,
              () => {
                net.sockets.get(addressText(to))?.receive(parcel, at);
              },
              null,
              net.sockets.get(addressText(to))?.side ?? "listener",
            );
          }
        },
        onDatagram(listen) {
          hear = listen;
        },
        close() {
          if (net.sockets.get(key) === own) net.sockets.delete(key);
          hear = null;
        },
      };
      return Promise.resolve({ kind: "bound", socket });
    },
    cut(halfOpen = false) {
      for (const cut of [...net.cutters]) cut(halfOpen);
    },
    close() {
      net.stop();
      for (const cut of [...net.cutters]) cut(false);
      net.servers.clear();
      net.sockets.clear();
      net.parcels = [];
    },
  };
}
