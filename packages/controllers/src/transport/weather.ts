/** Which way: to the side that listens at a port of its own choice, or to the one that called it from any. */
export type Side = "listener" | "caller";

/**
 * What the line does to what is sent over it. All at rest by default; changed at any time, in force for what is sent
 * from then on.
 */
export interface NetworkConditions {
  /** Least time under way [s], and how much more it may be by chance. */
  delay_s: number;
  jitter_s: number;
  /**
   * Of packets, 0 … 1. A datagram is gone; a stream sends it again, which takes time, and all that follows waits for
   * it.
   */
  loss: number;
  /** Of datagrams, sent twice. */
  duplicates: number;
  /** Of chunks, one byte of which is changed. */
  garbage: number;
  /** Of chunks, one number of which becomes none, or one that cannot be meant. */
  absurd: number;
  /** Streams arrive in pieces of this many bytes; 0 leaves them as they were sent. */
  pieces: number;
  /**
   * Nothing arrives, nobody is told: a cable that was pulled, a machine that hangs. Streams deliver it all when it
   * ends.
   */
  frozen: boolean;
  /** The same for what goes to that side only: the line is half open. */
  deaf: Side | null;
  /** New connections are refused. */
  refusing: boolean;
}

export const calm = (): NetworkConditions => ({
  delay_s: 0,
  jitter_s: 0,
  loss: 0,
  duplicates: 0,
  garbage: 0,
  absurd: 0,
  pieces: 0,
  frozen: false,
  deaf: null,
  refusing: false,
});
