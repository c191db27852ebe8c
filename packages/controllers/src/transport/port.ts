/** Where a controller listens. Several virtual ones live on one machine by address: 127.0.0.1, 127.0.0.2, … */
export interface Address {
  readonly host: string;
  readonly port: number;
}

/** Why a connection ended: a sentence for a log, and whether the other side did it. */
export interface Ending {
  readonly sentence: string;
  readonly byPeer: boolean;
}

/**
 * Bytes in order, both ways: a TCP connection, or a pipe in memory. Where one `send` ends says nothing about where a
 * chunk begins on the other side.
 */
export interface ByteStream {
  readonly peer: Address;
  /** Copies what it keeps. After the end it does nothing. */
  send(bytes: Uint8Array): void;
  /**
   * Bytes handed to `send` and not yet taken by the other side or the system: who sends states drops them above a
   * bound.
   */
  readonly waiting: number;
  /** `lent` is only valid during the call. One listener; bytes that came before it are kept for it, up to a bound. */
  onBytes(listen: (lent: Uint8Array) => void): void;
  /** Called once, when either side ends it or the line breaks; never again after `close`. */
  onEnd(listen: (ending: Ending) => void): void;
  close(): void;
}

/** Datagrams: each arrives whole or not at all, maybe twice, maybe late. */
export interface DatagramSocket {
  readonly address: Address;
  send(bytes: Uint8Array, to: Address): void;
  /** `lent` is only valid during the call. One listener. */
  onDatagram(listen: (lent: Uint8Array, from: Address) => void): void;
  close(): void;
}

export type Connected =
  | { readonly kind: "connected"; readonly stream: ByteStream }
  | { readonly kind: "refused"; readonly sentence: string };
export type Listening =
  | { readonly kind: "listening"; readonly address: Address; readonly close: () => void }
  | { readonly kind: "taken"; readonly sentence: string };
export type Bound =
  | { readonly kind: "bound"; readonly socket: DatagramSocket }
  | { readonly kind: "taken"; readonly sentence: string };

/**
 * The network a driver or a virtual controller is given: the system's sockets in Node, memory in the page and in tests.
 * Nothing throws; port 0 takes a free one.
 */
export interface Network {
  connect(to: Address): Promise<Connected>;
  listen(at: Address, accept: (stream: ByteStream) => void): Promise<Listening>;
  bind(at: Address): Promise<Bound>;
}

export const addressText = ({ host, port }: Address): string => `${host}:${port}`;
