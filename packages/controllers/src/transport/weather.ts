/** What the line does to what is sent over it. All at rest by default; changed at any time, in force for what is sent from then on. */
export interface Weather {
  /** Least time under way [s], and how much more it may be by chance. */
  delay_s: number;
  jitter_s: number;
  /** Of datagrams, 0 … 1. Streams lose nothing: what a stream loses, its connection loses. */
  loss: number;
  /** Of datagrams, sent twice. */
  duplicates: number;
  /** Of chunks, one byte of which is changed. */
  garbage: number;
  /** Streams arrive in pieces of this many bytes; 0 leaves them as they were sent. */
  pieces: number;
  /** Nothing arrives, nobody is told: a cable that was pulled, a machine that hangs. Streams deliver it all when it ends. */
  frozen: boolean;
  /** New connections are refused. */
  refusing: boolean;
}

export const calm = (): Weather => ({ delay_s: 0, jitter_s: 0, loss: 0, duplicates: 0, garbage: 0, pieces: 0, frozen: false, refusing: false });
