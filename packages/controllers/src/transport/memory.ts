import { seededRandom, type Scheduler } from "@twincell/core";
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
  const conditions = calm();
  const random = seededRandom(seed);
  const servers = new Map<string, (stream: ByteStream) => void>();
  const sockets = new Map<
    string,
    { readonly receive: (bytes: Uint8Array, from: Address) => void; readonly side: Side }
  >();
  const cutters = new Set<(halfOpen: boolean) => void>();
  let parcels: Parcel[] = [];
  let order = 0;
  let underWay = 0;
  let nextPort = FREE_PORT;
  /** When the last parcel of a line arrives: none goes past it. */
  const latest = new WeakMap<object, number>();

  const freePort = (taken: ReadonlyMap<string, unknown>, { host, port }: Address): Address => {
    let at: Address = { host, port };
    while (at.port === 0 || (port === 0 && taken.has(addressText(at)))) at = { host, port: nextPort++ };
    return at;
  };

  /** Puts something on its way. `line` keeps its order; without one it may be overtaken. */
  const post = (bytes: number, deliver: () => void, line: object | null, towards: Side | "both"): void => {
    let due_s = scheduler.now_s() + conditions.delay_s + conditions.jitter_s * random();
    if (line) {
      for (let again = 0; conditions.loss > 0 && again < MOST_RESENDS && random() < conditions.loss; again++)
        due_s += RESEND_S;
      due_s = Math.max(due_s, latest.get(line) ?? 0);
      latest.set(line, due_s);
    }
    parcels.push({ due_s, order: order++, line: line ?? conditions, deliver, bytes, datagram: line === null, towards });
    underWay += bytes;
  };

  const stop = scheduler.every(TICK_S, () => {
    if (parcels.length === 0) return;
    if (conditions.frozen || conditions.deaf !== null) {
      for (const parcel of parcels) if (parcel.datagram && isHeld(parcel)) underWay -= parcel.bytes;
      parcels = parcels.filter(parcel => !(parcel.datagram && isHeld(parcel)));
    }
    const now_s = scheduler.now_s() + 1e-12;
    const isDue = (parcel: Parcel): boolean => parcel.due_s <= now_s && !isHeld(parcel);
    const due = parcels.filter(isDue).sort((a, b) => a.due_s - b.due_s || a.order - b.order);
    if (due.length === 0) return;
    parcels = parcels.filter(parcel => !isDue(parcel));
    for (const parcel of due) {
      underWay -= parcel.bytes;
      parcel.deliver();
    }
  });

  /** Whoever calls needs an answer: a connection that is half open is not made. */
  const isHeld = ({ towards }: Parcel): boolean =>
    conditions.frozen || (conditions.deaf !== null && (towards === "both" || towards === conditions.deaf));

  function pair(client: Address, server: Address): readonly [ByteStream, ByteStream] {
    const one = half(server, "listener");
    const two = half(client, "caller");
    one.join(two);
    two.join(one);
    const cut = (halfOpen: boolean): void => {
      for (const end of [one, two]) end.breakLine(halfOpen);
      cutters.delete(cut);
    };
    cutters.add(cut);
    const forget = (): void => {
      if (one.ended() && two.ended()) cutters.delete(cut);
    };
    one.whenEnded(forget);
    two.whenEnded(forget);
    return [one.stream, two.stream];
  }

  function half(peer: Address, towards: Side) {
    const line = {};
    let hear: ((lent: Uint8Array) => void) | null = null;
    let endHeard: ((ending: Ending) => void) | null = null;
    let ending: Ending | null = null;
    let unheard: Uint8Array[] = [];
    let unheardBytes = 0;
    let waiting = 0;
    let broken = false;
    let over: () => void = () => {
      /* Nobody asked yet. */
    };
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
    const stream: ByteStream = {
      peer,
      get waiting() {
        return waiting;
      },
      send(bytes) {
        if (ending || bytes.length === 0) return;
        // Nobody takes them any more, and nobody says so.
        if (broken) {
          waiting += bytes.length;
          return;
        }
        const whole = spoiled(bytes, conditions, random);
        const step = conditions.pieces > 0 ? conditions.pieces : whole.length;
        for (let at = 0; at < whole.length; at += step) {
          const piece = whole.subarray(at, at + step);
          waiting += piece.length;
          post(
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
      close() {
        if (ending) return;
        ending = { sentence: "The connection was closed here.", byPeer: false };
        over();
        if (!broken)
          post(
            0,
            () => {
              other?.end({ sentence: "The other side closed the connection.", byPeer: true });
            },
            line,
            towards,
          );
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

  return {
    weather: conditions,
    get underWay() {
      return underWay;
    },
    connect(to) {
      return new Promise(resolve => {
        post(
          0,
          () => {
            const accept = servers.get(addressText(to));
            if (!accept || conditions.refusing) {
              resolve({ kind: "refused", sentence: `Nobody answers at ${addressText(to)}.` });
              return;
            }
            const [client, server] = pair({ host: "127.0.0.1", port: nextPort++ }, to);
            accept(server);
            resolve({ kind: "connected", stream: client });
          },
          {},
          "both",
        );
      });
    },
    listen(wanted, accept) {
      const at = freePort(servers, wanted);
      const key = addressText(at);
      if (servers.has(key)) return Promise.resolve({ kind: "taken", sentence: `${key} is taken.` });
      servers.set(key, accept);
      return Promise.resolve({
        kind: "listening",
        address: at,
        close: () => {
          if (servers.get(key) === accept) servers.delete(key);
        },
      });
    },
    bind(wanted) {
      const at = freePort(sockets, wanted);
      const key = addressText(at);
      if (sockets.has(key)) return Promise.resolve({ kind: "taken", sentence: `${key} is taken.` });
      let hear: ((lent: Uint8Array, from: Address) => void) | null = null;
      const receive = (bytes: Uint8Array, from: Address): void => {
        hear?.(bytes, from);
      };
      const own = { receive, side: wanted.port === 0 ? "caller" : "listener" } as const;
      sockets.set(key, own);
      const socket: DatagramSocket = {
        address: at,
        send(bytes, to) {
          if (sockets.get(key) !== own || random() < conditions.loss) return;
          for (let copies = random() < conditions.duplicates ? 2 : 1; copies > 0; copies--) {
            const parcel = spoiled(bytes, conditions, random);
            post(
              parcel.length,
              () => {
                sockets.get(addressText(to))?.receive(parcel, at);
              },
              null,
              sockets.get(addressText(to))?.side ?? "listener",
            );
          }
        },
        onDatagram(listen) {
          hear = listen;
        },
        close() {
          if (sockets.get(key) === own) sockets.delete(key);
          hear = null;
        },
      };
      return Promise.resolve({ kind: "bound", socket });
    },
    cut(halfOpen = false) {
      for (const cut of [...cutters]) cut(halfOpen);
    },
    close() {
      stop();
      for (const cut of [...cutters]) cut(false);
      servers.clear();
      sockets.clear();
      parcels = [];
    },
  };
}
