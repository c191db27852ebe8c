import type { CommandOutcome, Contact } from "@twincell/core";

/** How many postures of a way are free from its beginning, so much room kept, and what is met behind them. */
export type FreeWay = (
  way: readonly (readonly number[])[],
  room_m: number,
) => { readonly free: number; readonly met: Contact | null };

export interface HeldJog {
  /** The postures from where the robot stands to where the key leads, this one apart; empty where it leads nowhere. */
  readonly wayFromHere: () => readonly (readonly number[])[];
  readonly freeWay: FreeWay;
  /**
   * Where the robot stands nearer to something than the room: how many postures of the way lead out of that, up to the
   * first that is free. 0 where it stands free, or the way leads deeper.
   */
  readonly wayOut: (way: readonly (readonly number[])[], room_m: number) => number;
  /**
   * A motion to a posture of the way, at a share of the jog speed; `despite` names the findings that it is sent in
   * spite of, because it leads out of them.
   */
  readonly go: (q_rad: readonly number[], speed: number, despite: readonly string[]) => Promise<CommandOutcome>;
  /** Whether the key is still held. */
  readonly isHeld: () => boolean;
  readonly nowhere: () => CommandOutcome;
  readonly blocked: (met: Contact) => CommandOutcome;
}

/**
 * The room that is kept to what is in the way [m], and the share of the jog speed with which it is gone up to there:
 * the guard looks ahead by delay and braking, which take less room the slower the robot is.
 */
const APPROACH: readonly (readonly [room_m: number, speed: number])[] = [
  [0.06, 1],
  [0.025, 0.35],
  [0.008, 0.1],
];

/** What is nearest to it is left with the room and the speed of the last part. */
const [NEAREST_M, SLOWEST] = APPROACH.at(-1)!;
/** What the check finds at the beginning of a way out of there; the guard still stops it before it meets more. */
const TOO_NEAR: readonly string[] = ["collision.contact"];

/**
 * A jog for as long as its key is held: as far as the way is free, slower the nearer something is, and to a stand
 * before it. Every part is planned, checked and guarded by the connection like any motion; the free way that is known
 * here only spares the robot to be stopped. Where it stands too near to something already, it goes the way out of that
 * first, and nowhere else.
 *
 * @returns "done" where the way ends; refused, with what is in the way, where that was met; or how a part ended.
 */
export async function heldJog({
  wayFromHere,
  freeWay,
  wayOut,
  go,
  isHeld,
  nowhere,
  blocked,
}: HeldJog): Promise<CommandOutcome> {
  let way = wayFromHere();
  if (way.length === 0) return nowhere();
  const out = wayOut(way, NEAREST_M);
  if (out > 0) {
    const outcome = await go(way[out - 1]!, SLOWEST, TOO_NEAR);
    if (outcome.kind !== "done" || out === way.length || !isHeld()) return outcome;
    way = wayFromHere();
  }
  let last: Contact | null = null;
  for (const [room_m, speed] of APPROACH) {
    if (way.length === 0) break;
    const { free, met } = freeWay(way, room_m);
    last = met;
    if (free === 0) continue;
    const outcome = await go(way[free - 1]!, speed, []);
    if (outcome.kind !== "done" || !met || !isHeld()) return outcome;
    way = wayFromHere();
  }
  return last ? blocked(last) : { kind: "done" };
}
