import type { CommandOutcome, Refusal } from "@twincell/core";
import { stopped } from "../outcomes.ts";
import type { AdapterEvents, Opened } from "./adapter.ts";

export type DriverPhase = "closed" | "connecting" | "ready" | "executing" | "stopping";

/** What a controller carries out for a driver: one at a time. */
export interface Underway {
  readonly resolve: (outcome: CommandOutcome) => void;
}

/** What is carried out: executing, stopping, and over. One thing at a time; the next begins when it is over. */
export class Execution<M extends Underway> {
  /** What is being carried out. */
  moving: M | null = null;
  /** It was told to stop, and ends so when the robot stands. */
  ending: CommandOutcome | null = null;

  /** Begins something; what it ends with comes by `settle`. */
  execute(make: (resolve: Underway["resolve"]) => M, begin: (moving: M) => void): Promise<CommandOutcome> {
    return new Promise(resolve => {
      const moving = make(resolve);
      this.moving = moving;
      this.ending = null;
      begin(moving);
    });
  }
  settle(outcome: CommandOutcome): void {
    const ended = this.moving;
    this.moving = this.ending = null;
    ended?.resolve(outcome);
  }
}

/**
 * The states of a driver, the same for every vendor: closed → connecting → ready ⇄ executing → stopping → ready, and
 * closed from everywhere. What a vendor adds says and reads bytes. A connection that was closed is never listened to
 * again: who asks whether it is still the one holds the answer of `connecting`.
 */
export abstract class DriverStates<M extends Underway> extends Execution<M> {
  /** Who is told of states; null until the connection is ready. */
  events: AdapterEvents | null = null;
  private life = 0;
  private isConnecting = false;

  /** Why what is under way ends when the connection is closed. */
  protected abstract readonly closedBecause: Refusal;
  /** Gives up the lines and forgets what was heard over them. */
  protected abstract release(): void;

  get phase(): DriverPhase {
    if (this.moving) return this.ending ? "stopping" : "executing";
    return this.events ? "ready" : this.isConnecting ? "connecting" : "closed";
  }
  /** Whether what was asked now is answered over the same connection. */
  current(): () => boolean {
    const mine = this.life;
    return () => mine === this.life;
  }
  /** A connection is opened anew. */
  connecting(): () => boolean {
    this.close();
    this.isConnecting = true;
    return this.current();
  }
  /** The attempt goes on over another line: what the first one still says is not listened to. */
  renewed(): () => boolean {
    this.life++;
    return this.current();
  }
  /** The attempt is over; it is closed where nobody has done so meanwhile. */
  failed(isMine: () => boolean, why: Refusal, again: boolean): Opened {
    if (isMine()) this.close();
    return { kind: "failed", why, again };
  }
  ready(events: AdapterEvents): Opened {
    this.isConnecting = false;
    this.events = events;
    return { kind: "open" };
  }
  close(): void {
    this.life++;
    this.isConnecting = false;
    this.events = null;
    this.release();
    this.settle(stopped(this.closedBecause));
  }
  /** The connection broke: closed, and told. */
  lose(sentence: string): void {
    const told = this.events;
    this.close();
    told?.lost(sentence);
  }
}
