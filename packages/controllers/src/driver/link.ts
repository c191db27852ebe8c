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
  const meter = new Meter();
  const changes = listeners<LinkReport>();
  let state: LinkState = "closed";
  let sentence = notOpen(name).sentence;
  let attempts = 0;
  let roundTrip_s = NaN;
  let heard_s = 0;
  let life = 0;
  let wasThere = false;
  let stopWaiting: () => void = () => {
    /* Nothing waits yet. */
  };
  let giveUp: () => void = stopWaiting;

  const report: LinkReport = {
    get state() {
      return state;
    },
    get sentence() {
      return sentence;
    },
    get attempts() {
      return attempts;
    },
    get rate_Hz() {
      return meter.now.rate_Hz;
    },
    get late_s() {
      return meter.now.late_s;
    },
    get missing() {
      return meter.now.missing;
    },
    get roundTrip_s() {
      return roundTrip_s;
    },
  };
  const become = (to: LinkState, says: string): void => {
    state = to;
    sentence = says;
    changes.call(report);
  };
  const after = (seconds: number, then: () => void): void => {
    stopWaiting();
    const stop = scheduler.every(seconds, () => {
      stop();
      then();
    });
    stopWaiting = stop;
  };

  function lose(why: Refusal): void {
    life++;
    adapter.close();
    become("lost", why.sentence);
    listener.lost(why);
    again();
  }
  const again = (): void => {
    after(Math.min(LONGEST_PAUSE_S, FIRST_PAUSE_S * 2 ** Math.max(0, attempts - 1)), () => {
      void attempt();
    });
  };

  function watch(): void {
    stopWaiting();
    const every_s = adapter.stale_s / LOOKS;
    let looked_s = scheduler.now_s();
    stopWaiting = scheduler.every(every_s, () => {
      const now_s = scheduler.now_s();
      const silent_s = now_s - heard_s;
      const wasAway = now_s - looked_s > 2 * every_s;
      looked_s = now_s;
      // After a stall of our own what came meanwhile is still to be read: it is looked again before anybody is blamed.
      if (wasAway) return;
      if (silent_s > adapter.stale_s) {
        listener.losing();
        lose(cameLate(name, silent_s));
      }
    });
  }

  async function attempt(): Promise<CommandOutcome> {
    const mine = ++life;
    attempts++;
    become("connecting", `${name} is being connected, attempt ${attempts}.`);
    meter.begin();
    const isMine = (): boolean => mine === life;
    const opening = adapter.open({
      sample(lent) {
        if (!isMine()) return;
        // What is no pose, or is older than what is known, is not heard: a controller that says nothing else is as good
        // as silent.
        const now_s = scheduler.now_s();
        if (!isPose(lent.q_rad, adapter.robot) || !meter.take(lent.sequence, lent.time_s, now_s)) return;
        heard_s = now_s;
        listener.sample(lent);
      },
      roundTrip(seconds) {
        if (isMine()) roundTrip_s = seconds;
      },
      lost(says) {
        if (isMine() && state === "open")
          lose({ code: "link.lost", sentence: says, hint: "It is tried again by itself; motion is not." });
      },
    });
    const tooLong = new Promise<null>(resolve => {
      giveUp = () => {
        resolve(null);
      };
      after(ATTEMPT_S, giveUp);
    });
    const opened = await Promise.race([opening, tooLong]);
    if (!isMine()) return { kind: "refused", why: notOpen(name) };
    if (opened?.kind === "open") {
      attempts = 0;
      wasThere = true;
      heard_s = scheduler.now_s();
      become("open", "");
      watch();
      return { kind: "done" };
    }
    life++;
    adapter.close();
    const why = opened?.why ?? noAnswer(name, ATTEMPT_S);
    if (opened?.again === false && (!wasThere || attempts > HEARD_TWICE)) {
      stopWaiting();
      become("closed", why.sentence);
    } else {
      become("lost", why.sentence);
      again();
    }
    return { kind: "refused", why };
  }

  return {
    report,
    get isOpen() {
      return state === "open";
    },
    async open() {
      if (state === "open") return { kind: "done" };
      attempts = 0;
      wasThere = false;
      meter.reset();
      return attempt();
    },
    close() {
      if (state === "closed") return;
      const wasOpen = state === "open";
      life++;
      stopWaiting();
      giveUp();
      adapter.close();
      become("closed", notOpen(name).sentence);
      if (wasOpen) listener.lost(notOpen(name));
    },
    onChange: listen => changes.add(listen),
  };
}
