import type { Finding, Plan, Robot, Scheduler } from "@twincell/core";
import type { CellMember } from "../cell/index.ts";
import { listeners } from "../listeners.ts";
import { MIN_AHEAD_S, LookAhead, MAX_AHEAD_S, type Foreseen } from "../twin/index.ts";

/** Where a robot will be, as it is told many times a second. Lent: the angles are only valid during the call. */
export interface AheadWords {
  readonly q_rad: Float64Array;
  /** So many seconds from now; less where the plan ends before. */
  readonly in_s: number;
  readonly problem: Foreseen | null;
}
/** How far a robot is on its plan, and how fast it goes on it. */
export interface Progress {
  readonly at_s: number;
  readonly rate: number;
}

export interface Ahead {
  /** How far ahead is looked [s], between half a second and ten. */
  horizon_s: number;
  /** Looks ahead of a robot that carries out a plan until the returned function is called. */
  follow(plan: Plan, findings: readonly Finding[], progress: () => Progress): () => void;
  /**
   * Shows where the plan would take it, at full override, without a word to the robot; the answer is what is found on
   * the way.
   */
  preview(plan: Plan, findings: readonly Finding[], bad: readonly Finding[]): ReturnType<LookAhead["preview"]>;
  /** null: nothing is looked ahead any more. */
  onChange(listen: (words: AheadWords | null) => void): () => void;
  close(): void;
}

/** Told this often [s], and so many instants of the way looked at each time. */
const TELL_S = 0.05;
const LOOKS = 12;
/** Two seconds are what a person follows with the eyes. */
const AT_FIRST_S = 2;

export function createAhead({
  robot,
  name,
  scheduler,
  place,
}: {
  readonly robot: Robot;
  readonly name: string;
  readonly scheduler: Scheduler;
  readonly place: CellMember | null;
}): Ahead {
  const changes = listeners<AheadWords | null>();
  const q_rad = new Float64Array(robot.arm.joints.length);
  const words = { q_rad, in_s: 0, problem: null as Foreseen | null };
  let horizon_s = AT_FIRST_S;
  let stop: (() => void) | null = null;

  const end = (): void => {
    if (!stop) return;
    stop();
    stop = null;
    changes.call(null);
  };
  function begin(look: LookAhead, tick: () => Progress | null): () => void {
    end();
    const mine = (stop = scheduler.every(TELL_S, () => {
      const progress = tick();
      if (!progress) {
        end();
        return;
      }
      look.look(progress.at_s, progress.rate, horizon_s, LOOKS);
      words.in_s = look.ghost(progress.at_s, progress.rate, horizon_s, q_rad);
      words.problem = look.problem;
      changes.call(words);
    }));
    return () => {
      if (stop === mine) end();
    };
  }

  return {
    get horizon_s() {
      return horizon_s;
    },
    set horizon_s(to) {
      horizon_s = Math.min(MAX_AHEAD_S, Math.max(MIN_AHEAD_S, to));
    },
    follow: (plan, findings, progress) =>
      begin(new LookAhead({ name, plan, findings, place, joints: q_rad.length }), progress),
    preview(plan, findings, bad) {
      const look = new LookAhead({ name, plan, findings, bad, place, joints: q_rad.length });
      const from_s = scheduler.now_s();
      // The ghost runs ahead of where the robot would be.
      begin(look, () => {
        const at_s = scheduler.now_s() - from_s;
        return at_s > plan.duration_s ? null : { at_s, rate: 1 };
      });
      return look.preview();
    },
    onChange: listen => changes.add(listen),
    close() {
      end();
      changes.clear();
    },
  };
}
