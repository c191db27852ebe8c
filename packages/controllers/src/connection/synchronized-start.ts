import type { CommandOutcome, JointSample, Refusal, Scheduler, PreparedRun } from "@twincell/core";
import { DONE } from "../outcomes.ts";

import { didNotBegin, stoppedWith } from "./words.ts";

/** Between the first and the last of a group to be seen moving [s]; measured for every pair of brands by a test. */
export const START_WITHIN_S = 0.05;
/** Who is not seen to move for this long after the start keeps the others from going on [s]. */
export const START_WINDOW_S = 2;
const LOOK_S = 0.01;

export interface Startable {
  readonly words: { readonly id: string; readonly name: string };
  stop(emergency: boolean): void;
  onSample(listen: (lent: JointSample) => void): () => void;
}
export interface GroupMember {
  readonly station: Startable;
  /** Makes it ready; see `VendorConnection.prepare`. */
  readonly prepare: () => Promise<PreparedRun>;
}
export interface GroupEnd {
  /** "done" when all are; else what ended it first. */
  readonly outcome: CommandOutcome;
  /** How each of them ended, by the ids of the stations. Empty where nobody began. */
  readonly each: ReadonlyMap<string, CommandOutcome>;
}
export interface StartedWords {
  /** From the first to the last that was seen moving, on one clock [s]. */ readonly spread_s: number;
}

/**
 * Starts several robots at once. First each is made ready: leased, at rest, its program handed over. If one refuses
 * nobody starts, and the refusal is told before anything has moved. Then all are told to start in the same turn of one
 * clock.
 *
 * From then on they are one: whoever fails, is stopped by anyone, or does not begin within `START_WINDOW_S`, stops all
 * of them. What is common is this clock, not those of the controllers: how far apart they begin is measured and told.
 */
export async function startSynchronized(
  members: readonly GroupMember[],
  scheduler: Scheduler,
  onStarted: (words: StartedWords) => void = () => undefined,
): Promise<GroupEnd> {
  const ready = await Promise.all(members.map(member => member.prepare()));
  const refusal =
    ready.find(armed => armed.kind === "refused")?.why ??
    ready.map(armed => (armed.kind === "armed" ? armed.readiness() : null)).find(why => why !== null);
  if (refusal) {
    for (const armed of ready) if (armed.kind === "armed") armed.drop();
    return { outcome: { kind: "refused", why: refusal }, each: new Map() };
  }

  const each = new Map<string, CommandOutcome>();
  const began_s = new Map<string, number>();
  const from_s = scheduler.now_s();
  let first: { readonly name: string; readonly outcome: Exclude<CommandOutcome, { kind: "done" }> } | null = null;
  let told = false;
  function halt(name: string, outcome: Exclude<CommandOutcome, { kind: "done" }>): void {
    if (first) return;
    first = { name, outcome };
    for (const { station } of members) if (!each.has(station.words.id)) station.stop(false);
  }
  const offs = members.map(({ station }) =>
    station.onSample(({ moving }) => {
      if (!moving || began_s.has(station.words.id)) return;
      began_s.set(station.words.id, scheduler.now_s());
      if (told || began_s.size < members.length) return;
      told = true;
      onStarted({ spread_s: Math.max(...began_s.values()) - Math.min(...began_s.values()) });
    }),
  );
  offs.push(
    scheduler.every(LOOK_S, () => {
      if (scheduler.now_s() - from_s < START_WINDOW_S) return;
      members.forEach(
        (
          {
            station: {
              words: { id, name },
            },
          },
          i,
        ) => {
          const armed = ready[i]!;
          if (armed.kind === "armed" && armed.movesAtOnce && !began_s.has(id) && !each.has(id))
            halt(name, { kind: "stopped", why: didNotBegin(name, START_WINDOW_S) });
        },
      );
    }),
  );
  await Promise.all(
    members.map(
      async (
        {
          station: {
            words: { id, name },
          },
        },
        i,
      ) => {
        const armed = ready[i] as Extract<PreparedRun, { kind: "armed" }>;
        const outcome = await armed.start();
        each.set(id, outcome);
        if (outcome.kind !== "done") halt(name, outcome);
      },
    ),
  );
  for (const off of offs) off();
  const cause = first as { readonly name: string; readonly outcome: { readonly why: Refusal } } | null;
  if (!cause) return { outcome: DONE, each };
  // Who was stopped for another's sake says so.
  for (const {
    station: {
      words: { id, name },
    },
  } of members)
    if (name !== cause.name && each.get(id)?.kind === "stopped")
      each.set(id, { kind: "stopped", why: stoppedWith(name, cause.name, cause.outcome.why) });
  return { outcome: { kind: "stopped", why: cause.outcome.why }, each };
}
