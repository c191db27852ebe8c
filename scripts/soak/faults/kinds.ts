import { calm, type NetworkConditions } from "@twincell/controllers";
import type { Cell } from "./cell.ts";
import { pending, type Pending } from "./cell.ts";

/**
 * What a fault must lead to.
 * "line": the controller and we do not hear each other any more; "here": we stop; "cabinet": the robot is stopped where
 * it stands; "page": who commands is silent; "any": the motion may end or go on, the laws that always hold are enough.
 */
export type Leads = "line" | "here" | "cabinet" | "page" | "any";
type Undo = () => void | Promise<void>;
export interface Fault {
  readonly leads: Leads;
  /** Does it, and says how to undo it where `mend` does not. What it promised to somebody else is waited for. */
  act(cell: Cell): Undo | undefined;
}
const weather = (change: (random: () => number) => Partial<NetworkConditions>): Fault => ({
  leads: "any",
  act({ watched, random }) {
    Object.assign(watched.network.weather, change(random));
  },
});
const line = (change: Partial<NetworkConditions>): Fault => ({
  leads: "line",
  act({ watched }) {
    Object.assign(watched.network.weather, change);
  },
});

/** All faults by name. None of them knows a brand. */
export const FAULTS: Readonly<Record<string, Fault>> = {
  delay: weather(random => ({ delay_s: random() < 0.7 ? 0.01 + 0.03 * random() : random() })),
  loss: weather(random => ({ loss: 0.02 + 0.3 * random() })),
  duplicates: weather(random => ({ duplicates: 0.1 + 0.4 * random() })),
  reorder: weather(random => ({ jitter_s: 0.005 + 0.03 * random(), duplicates: 0.1 })),
  "single bytes": weather(() => ({ pieces: 1 })),
  garbage: weather(random => ({ garbage: 0.02 + 0.1 * random() })),
  "absurd numbers on the line": weather(random => ({ absurd: 0.02 + 0.1 * random() })),
  "NaN in states": {
    leads: "any",
    act({ watched, random }) {
      watched.lies.nan = 0.05 + 0.5 * random();
    },
  },
  "every state NaN": {
    leads: "line",
    act({ watched }) {
      watched.lies.nan = 1;
    },
  },
  "clock forward": {
    leads: "any",
    act({ watched, random }) {
      watched.lies.clock_s = random() < 0.5 ? random() : 3600 * random();
    },
  },
  "clock back": {
    leads: "any",
    act({ watched, random }) {
      watched.lies.clock_s = random() < 0.5 ? -0.9 * random() : -3600 * random();
    },
  },
  freeze: line({ frozen: true }),
  "half open: the port hears nothing": line({ deaf: "listener" }),
  "half open: the caller hears nothing": line({ deaf: "caller" }),
  "half open: nobody hears": {
    leads: "line",
    act({ watched }) {
      watched.network.cut(true);
      watched.network.weather.frozen = true;
    },
  },
  reset: {
    leads: "line",
    act({ watched }) {
      watched.network.cut();
      watched.network.weather.refusing = true;
    },
  },
  plug: {
    leads: "line",
    act({ station, watched }) {
      if (!station.plug) {
        watched.network.weather.frozen = true;
        return;
      }
      station.plug(true);
      return () => {
        station.plug?.(false);
      };
    },
  },
  reboot: {
    leads: "cabinet",
    act({ watched }) {
      watched.virtual.reboot();
    },
  },
  "a second master": {
    leads: "any",
    act(cell) {
      const other = cell.watched.second();
      let moving: Pending | null = null;
      void other.connect().then(outcome => {
        if (outcome.kind === "done") moving = pending(other.moveJoints(cell.target()));
      });
      return async () => {
        other.stop();
        await cell.scheduler.elapse(0.1);
        other.close();
        if ((await cell.until(() => moving === null || moving.outcome !== undefined, 5, 0.05)) === Infinity)
          throw new Error("A command of the second master never ended.");
      };
    },
  },
  "a second seat": {
    leads: "any",
    act(cell) {
      const other = cell.station.commander("another");
      const taken = other.acquireLease();
      const moved = pending(other.robot.moveJoints(cell.target()));
      return async () => {
        await cell.scheduler.elapse(0.01);
        if (taken.kind === "done" || moved.outcome?.kind !== "refused") throw new Error("A second seat was let in.");
      };
    },
  },
  "tab asleep": {
    leads: "page",
    act({ page }) {
      page.asleep = true;
    },
  },
  "tab closed": {
    leads: "here",
    act({ seat }) {
      seat.releaseLease();
    },
  },
  "enabling switch let go": {
    leads: "here",
    act(cell) {
      if (cell.isFar) cell.seat.setEnabled(false);
      else cell.seat.releaseLease();
    },
  },
  stop: {
    leads: "here",
    act({ station }) {
      station.stop(false);
    },
  },
  "emergency stop from here": {
    leads: "here",
    act({ station }) {
      station.stop(true);
    },
  },
  "stop over a bad line": {
    leads: "any",
    act({ station, watched, random }) {
      Object.assign(watched.network.weather, { delay_s: 0.01 * random(), jitter_s: 0.02, loss: 0.2, duplicates: 0.2 });
      station.stop(false);
    },
  },
  "emergency stop at the robot": {
    leads: "cabinet",
    act({ watched }) {
      watched.virtual.pendant.emergencyStop(true);
    },
  },
  "gate opened": {
    leads: "cabinet",
    act({ watched }) {
      watched.virtual.pendant.setGuardOpen(true);
    },
  },
  "protective stop": {
    leads: "cabinet",
    act({ watched }) {
      watched.virtual.pendant.protectiveStop("it met something");
    },
  },
  "key to manual": {
    leads: "cabinet",
    act({ watched }) {
      watched.virtual.pendant.setMode("manual");
    },
  },
  "speed changed": {
    leads: "any",
    act({ seat, random }) {
      seat.robot.setSpeed(10 + 90 * random());
    },
  },
};

/** Everything is as it was, but for what a person must do. */
export function mend({ watched, page }: Cell): void {
  Object.assign(watched.network.weather, calm());
  Object.assign(watched.lies, { clock_s: 0, nan: 0 });
  page.asleep = false;
  const { pendant } = watched.virtual;
  pendant.emergencyStop(false);
  pendant.setGuardOpen(false);
}
