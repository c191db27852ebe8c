import type { CommandOutcome, JointSample, LinkReport, LinkState, Refusal, Robot, Scheduler } from "@twincell/core";
import { listeners } from "../listeners.ts";
import type { ControllerAdapter } from "./adapter.ts";
import { Meter } from "./meter.ts";
import { cameLate, noAnswer, notOpen } from "./words.ts";

/** First pause before a lost link is tried again [s]; each failure doubles it up to the longest. */
const FIRST_PAUSE_S = 0.25;
const LONGEST_PAUSE_S = 8;
/** An attempt that says nothing for this long has failed [s]. */
const ATTEMPT_S = 10;
/** A robot may stand beyond a limit; a joint that says so of more than a turn, or a metre, says no angle [rad, m]. */
const BEYOND = 2 * Math.PI;
const isPose = (q_rad: ArrayLike<number>, { arm }: Robot): boolean =>
  arm.joints.every(({ limits }, i) => q_rad[i]! >= limits.lower_rad - BEYOND && q_rad[i]! <= limits.upper_rad + BEYOND);
/**
 * A robot that was there does not become another one by itself: what says so was spoilt on its way, unless it says so
 * again.
 */
const HEARD_TWICE = 1;
/** How often the watch looks, as a part of the time after which samples are stale. */
const LOOKS = 4;

export interface Link {
  readonly report: LinkReport;
  readonly isOpen: boolean;
  open(): Promise<CommandOutcome>;
  close(): void;
  onChange(listen: (report: LinkReport) => void): () => void;
}
export interface LinkListener {
  /** A sample that is whole and newer than the one before. */
  sample(lent: Omit<JointSample, "step">): void;
  /**
   * Nothing was heard for too long, and the link is given up next: the last word, should the line still be good in that
   * direction.
   */
  losing(): void;
  /** The link was open and is not any more. */
  lost(why: Refusal): void;
}

/**
 * Keeps one connection: opens it, watches that samples keep coming, and when they do not, closes it and tries again
 * with growing pauses until somebody closes the link. What an old connection still says is not listened to.
 */

export function keepLink(adapter: ControllerAdapter, scheduler: Scheduler, name: string, listener: LinkListener): Link {
  return keptLinkOf(new KeptLink(adapter, scheduler, name, listener));
}

class KeptLink {
  readonly report: LinkReport = reportOf(this);
  readonly adapter: ControllerAdapter;
  readonly scheduler: Scheduler;
  readonly name: string;
  readonly listener: LinkListener;
  readonly meter = new Meter();
  readonly changes = listeners<LinkReport>();
  state: LinkState = "closed";
  sentence: string;
  attempts = 0;
  roundTrip_s = NaN;
  heard_s = 0;
  life = 0;
  wasThere = false;

  constructor(adapter: ControllerAdapter, scheduler: Scheduler, name: string, listener: LinkListener) {
    this.adapter = adapter;
    this.scheduler = scheduler;
    this.name = name;
    this.listener = listener;
    this.sentence = notOpen(this.name).sentence;
  }

  stopWaiting: () => void = () => undefined;

  giveUp: () => void = () => undefined;

  become(to: LinkState, says: string): void {
    this.state = to;
    this.sentence = says;
    this.changes.call(this.report);
  }

  after(seconds: number, then: () => void): void {
    this.stopWaiting();
    const stop = this.scheduler.every(seconds, () => {
      stop();
      then();
    });
    this.stopWaiting = stop;
  }

  lose(why: Refusal): void {
    this.life++;
    this.adapter.close();
    this.become("lost", why.sentence);
    this.listener.lost(why);
    this.again();
  }

  again(): void {
    this.after(Math.min(LONGEST_PAUSE_S, FIRST_PAUSE_S * 2 ** Math.max(0, this.attempts - 1)), () => {
      void this.attempt();
    });
  }

  watch(): void {
    this.stopWaiting();
    const every_s = this.adapter.stale_s / LOOKS;
    let looked_s = this.scheduler.now_s();
    this.stopWaiting = this.scheduler.every(every_s, () => {
      const now_s = this.scheduler.now_s();
      const silent_s = now_s - this.heard_s;
      const wasAway = now_s - looked_s > 2 * every_s;
      looked_s = now_s;
      // After a stall of our own what came meanwhile is still to be read: it is looked again before anybody is blamed.
      if (wasAway) return;
      if (silent_s > this.adapter.stale_s) {
        this.listener.losing();
        this.lose(cameLate(this.name, silent_s));
      }
    });
  }

  async attempt(): Promise<CommandOutcome> {
    const mine = ++this.life;
    this.attempts++;
    this.become("connecting", `${this.name} is being connected, attempt ${this.attempts}.`);
    this.meter.begin();
    const isMine = (): boolean => mine === this.life;
    const opening = this.adapter.open({
      sample: lent => {
        if (!isMine()) return;
        // What is no pose, or is older than what is known, is not heard: a controller that says nothing else is as good
        // as silent.
        const now_s = this.scheduler.now_s();
        if (!isPose(lent.q_rad, this.adapter.robot) || !this.meter.take(lent.sequence, lent.time_s, now_s)) return;
        this.heard_s = now_s;
        this.listener.sample(lent);
      },
      roundTrip: seconds => {
        if (isMine()) this.roundTrip_s = seconds;
      },
      lost: says => {
        if (isMine() && this.state === "open")
          this.lose({ code: "link.lost", sentence: says, hint: "It is tried again by itself; motion is not." });
      },
    });
    const tooLong = new Promise<null>(resolve => {
      this.giveUp = () => {
        resolve(null);
      };
      this.after(ATTEMPT_S, this.giveUp);
    });
    const opened = await Promise.race([opening, tooLong]);
    if (!isMine()) return { kind: "refused", why: notOpen(this.name) };
    if (opened?.kind === "open") {
      this.attempts = 0;
      this.wasThere = true;
      this.heard_s = this.scheduler.now_s();
      this.become("open", "");
      this.watch();
      return { kind: "done" };
    }
    this.life++;
    this.adapter.close();
    const why = opened?.why ?? noAnswer(this.name, ATTEMPT_S);
    if (opened?.again === false && (!this.wasThere || this.attempts > HEARD_TWICE)) {
      this.stopWaiting();
      this.become("closed", why.sentence);
    } else {
      this.become("lost", why.sentence);
      this.again();
    }
    return { kind: "refused", why };
  }
}

function keptLinkOf(own: KeptLink): Link {
  return {
    report: own.report,
    get isOpen() {
      return own.state === "open";
    },
    async open() {
      if (own.state === "open") return { kind: "done" };
      own.attempts = 0;
      own.wasThere = false;
      own.meter.reset();
      return own.attempt();
    },
    close() {
      if (own.state === "closed") return;
      const wasOpen = own.state === "open";
      own.life++;
      own.stopWaiting();
      own.giveUp();
      own.adapter.close();
      own.become("closed", notOpen(own.name).sentence);
      if (wasOpen) own.listener.lost(notOpen(own.name));
    },
    onChange: listen => own.changes.add(listen),
  };
}

/** The figures of a link as they are when they are asked for. */
const reportOf = (own: KeptLink): LinkReport => ({
  get state() {
    return own.state;
  },
  get sentence() {
    return own.sentence;
  },
  get attempts() {
    return own.attempts;
  },
  get rate_Hz() {
    return own.meter.now.rate_Hz;
  },
  get late_s() {
    return own.meter.now.late_s;
  },
  get missing() {
    return own.meter.now.missing;
  },
  get roundTrip_s() {
    return own.roundTrip_s;
  },
});
