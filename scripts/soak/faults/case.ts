import type { Cell, Pending } from "./cell.ts";
import { HEARTBEAT_S, pending, RESTED_S, STILL_S } from "./cell.ts";
import { FAULTS, mend } from "./kinds.ts";

export const DOINGS = ["moving", "text", "idle"] as const;
export type Doing = (typeof DOINGS)[number];
/** At worst, over all cases [s]. */
export interface Worst {
  /** Without a state while the guard let a motion go on. */
  silentWhileMoving_s: number;
  /**
   * From the fault to the stop on the driver's wire: stops from here, and a page that fell silent, its heartbeat taken
   * off.
   */
  stopCommanded_s: number;
  /** From a stop here, or at the robot, until standstill. */
  standsAfterStop_s: number;
  standsAfterCabinet_s: number;
  /**
   * From a line that broke to standstill, where the robot has a watchdog; moves and texts apart: no controller watches
   * over a text.
   */
  standsAfterLine_s: number;
  standsAfterLineUnwatched_s: number;
  standsAfterLineText_s: number;
  underWay_bytes: number;
  timersMore: number;
}
export const noWorst = (): Worst => ({
  silentWhileMoving_s: 0,
  stopCommanded_s: 0,
  standsAfterStop_s: 0,
  standsAfterCabinet_s: 0,
  standsAfterLine_s: 0,
  standsAfterLineUnwatched_s: 0,
  standsAfterLineText_s: 0,
  underWay_bytes: 0,
  timersMore: 0,
});

export interface Case {
  readonly outcome: string /** Laws that did not hold, with the number. */;
  readonly broken: readonly string[];
}

/** From the loss of the line, or the word to stop, to the stop on the wire (row X-41); a look at the clock more [s]. */
const COMMANDED_S = 0.1;
const LOOK_S = 0.002;
/** A word's way over the wire and through the controller's cycles, beside its braking [s]. */
const WIRE_S = 0.06;
/** A motion or a text ends by itself within this time, and a link is back [s]. */
const ENDS_S = 60;
const BACK_S = 40;
const REST_S = 1.5;
const MOST_BYTES = 1 << 20;
const MOST_TIMERS = 12;
const TRIES = 8;
const SHORT = 0.25;
/** A robot that stood and turned less than this did not move (row T-23: 0.001°). */
const SAME_RAD = (0.001 * Math.PI) / 180;

/** One thing goes wrong; then everything is put right, a person says that motion is wanted, and it must move again. */
export async function oneCase(cell: Cell, name: string, doing: Doing, worst: Worst): Promise<Case> {
  const { scheduler, station, seat: commander, watched, random } = cell;
  const { virtual } = watched;
  const fault = FAULTS[name]!;
  const broken: string[] = [];
  const timers = cell.timers;
  const now = (): number => scheduler.now_s();
  const law = (holds: boolean, says: string): void => {
    if (!holds) broken.push(says);
  };
  const atMost = (key: keyof Worst, value: number, most: number, says: string): void => {
    worst[key] = Math.max(worst[key], value);
    law(value <= most + 1e-9, `${says}: ${value.toFixed(3)} > ${most.toFixed(3)}`);
  };

  const first: Pending =
    doing === "moving"
      ? pending(commander.robot.moveJoints(cell.target()))
      : doing === "text"
        ? pending(station.run(commander, cell.program(), true))
        : { outcome: { kind: "done" } };
  if (doing !== "idle") await cell.until(() => !cell.stands() || first.outcome !== undefined, 6);
  await scheduler.elapse(0.7 * random());
  const underWay = first.outcome === undefined && !cell.stands();
  const act_s = now();
  const asked = watched.motions;
  const wasFast = cell.tooFast;
  let silent_s = 0;
  let gap_s = 0;
  const look = scheduler.every(LOOK_S, () => {
    if (watched.isOpen) gap_s = Math.max(gap_s, now() - Math.max(watched.heard_s, act_s));
    if (station.guard.state.motion === "moving" && station.guard.state.link === "up")
      silent_s = Math.max(silent_s, now() - Math.max(watched.heard_s, act_s));
  });

  const undo = fault.act(cell);
  const still_s = doing === "text" ? RESTED_S : STILL_S;
  const isShort = fault.leads === "line" && random() < SHORT;
  const watchdog = station.words.watchdog;
  const stood = async (most_s: number): Promise<number> =>
    Math.max(0, (await cell.until(() => cell.stands(still_s), most_s)) - still_s);
  const wasSaid = async (from_s: number): Promise<number> => {
    await cell.until(() => watched.stopped_s >= act_s, 1, LOOK_S);
    return watched.stopped_s >= act_s ? watched.stopped_s - from_s : Infinity;
  };
  if (underWay && fault.leads === "here") {
    atMost("stopCommanded_s", await wasSaid(act_s), COMMANDED_S, "a stop was commanded late");
    atMost("standsAfterStop_s", await stood(8), virtual.brakingTime_s + WIRE_S, "it stood late after a stop");
  } else if (underWay && fault.leads === "page") {
    const { alive_s } = cell.page;
    atMost(
      "stopCommanded_s",
      (await wasSaid(alive_s)) - HEARTBEAT_S,
      COMMANDED_S,
      "a silent page was not stopped in time",
    );
    await stood(8);
  } else if (underWay && fault.leads === "cabinet") {
    atMost(
      "standsAfterCabinet_s",
      await stood(8),
      virtual.brakingTime_s + WIRE_S,
      "it stood late after a stop at the robot",
    );
  } else if (isShort) {
    await scheduler.elapse(0.01 + 0.1 * random());
  } else if (underWay && fault.leads === "line") {
    const within_s = Number(/within (\d+) ms/.exec(watchdog)?.[1] ?? NaN) / 1000;
    const after_s = await stood(ENDS_S);
    if (doing === "text") atMost("standsAfterLineText_s", after_s, ENDS_S, "a text never ended");
    else if (Number.isNaN(within_s)) atMost("standsAfterLineUnwatched_s", after_s, ENDS_S, "it never stood");
    else
      atMost(
        "standsAfterLine_s",
        after_s,
        within_s + virtual.brakingTime_s + WIRE_S,
        "its own watchdog stopped it late",
      );
    // A controller that says itself that it stopped needs no word; a line that both know is broken takes none.
    if (name !== "reset" && gap_s > COMMANDED_S) law(watched.stopped_s >= act_s, "no stop was put on the line");
  } else {
    await scheduler.elapse(0.1 + 2 * random());
  }
  atMost("silentWhileMoving_s", silent_s, COMMANDED_S + LOOK_S, "it was let move without a state");
  look();

  const isBarred = (): boolean =>
    station.guard.state.link !== "up" || (station.link !== null && station.link.state !== "open");
  const early = async (): Promise<void> => {
    if (!isBarred()) return;
    const moved = pending(commander.robot.moveJoints(cell.target()));
    await scheduler.elapse(0.004);
    law(moved.outcome?.kind === "refused", "a motion was accepted before a person's act");
  };
  await early();
  mend(cell);
  await undo?.();
  law((await cell.until(() => first.outcome !== undefined, ENDS_S, 0.05)) < Infinity, "a command never ended");
  await early();
  law((await cell.until(() => cell.stands(RESTED_S), ENDS_S)) < Infinity, "it never stood afterwards");
  await cell.until(() => station.link?.state === "open", BACK_S, 0.1);
  await early();
  const rest = virtual.jointAngles().slice();
  await scheduler.elapse(REST_S);
  law(
    rest.every((q, i) => Math.abs(q - virtual.jointAngles()[i]!) < SAME_RAD),
    "it moved though nobody commanded it",
  );
  law(doing !== "idle" || watched.motions === asked || name === "a second seat", "a motion was handed to the driver");
  law(cell.tooFast === wasFast, "a joint was too fast");

  let last = "nothing was tried";
  for (let i = 0; i < TRIES && last !== "done"; i++) {
    // A person at the cabinet, where the wire cannot switch drives on, acknowledge a message or start a program.
    if (i > 0) {
      virtual.pendant.setMode("manual");
      await scheduler.elapse(0.1);
      virtual.pendant.reset();
      virtual.pendant.setMode("remote");
      await scheduler.elapse(0.5);
    }
    // A controller that twice named itself another robot is looked for again only at a person's word.
    // So is one whose set-up was spoilt on its way when the line was opened: after three tries in vain a person opens
    // it anew.
    if (i === 3) {
      station.disconnect();
      await scheduler.elapse(0.5);
    }
    if (station.link?.state === "closed") {
      void station.connect();
      await scheduler.elapse(2);
    }
    commander.acquireLease();
    commander.setEnabled(true);
    commander.acknowledge();
    commander.robot.reset();
    await scheduler.elapse(1);
    commander.robot.setSpeed(100);
    const again = pending(commander.robot.moveJoints(cell.target()));
    await cell.until(() => again.outcome !== undefined, 20, 0.02);
    last = inWords(again);
  }
  law(last === "done", `it could not be driven afterwards (${last}; ${station.link?.sentence ?? ""})`);
  atMost("underWay_bytes", watched.network.underWay, MOST_BYTES, "bytes piled up");
  atMost("timersMore", cell.timers - timers, MOST_TIMERS, "timers piled up");
  return { outcome: inWords(first), broken };
}
const inWords = ({ outcome }: Pending): string =>
  outcome === undefined ? "no end" : outcome.kind === "done" ? "done" : `${outcome.kind}, ${outcome.why.code}`;
