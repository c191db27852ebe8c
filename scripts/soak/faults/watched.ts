import {
  createRealController,
  type DriverKind,
  type VendorVirtual,
  type ControllerAdapter,
  type MemoryNetwork,
  type Network,
} from "@twincell/controllers";
import type { JointSample, ManualScheduler, RealController } from "@twincell/core";

/** What a driver was told and what it heard, seen between it and all that stands in front of it. */
export interface Watched {
  readonly brand: DriverKind;
  readonly virtual: VendorVirtual;
  readonly network: MemoryNetwork;
  /** When it last heard of its controller, and when it was last told to stop while its line was open [s]. */
  readonly heard_s: number;
  readonly stopped_s: number;
  readonly isOpen: boolean;
  /** Motions and texts that were handed to it and began. */
  readonly motions: number;
  /** What its states are made to say: their clock set to another time [s], their angles no numbers. */
  readonly lies: { clock_s: number; nan: number };
  /** Another driver of the same controller, as another computer has one. */
  second(): RealController;
}
type Sample = Omit<JointSample, "step">;
const inMemory = (network: Network): network is MemoryNetwork => "weather" in network;

/** The same brand, seen from between: what is opened with it shows what goes through. */
export function watched(brand: DriverKind, scheduler: ManualScheduler, random: () => number): Watched {
  const lies = { clock_s: 0, nan: 0 };
  let virtual: VendorVirtual | null = null;
  let line: MemoryNetwork | null = null;
  let again: (() => ControllerAdapter) | null = null;
  let heard_s = NaN;
  let stopped_s = NaN;
  let isOpen = false;
  let motions = 0;
  const got = <T>(what: T | null): T => {
    if (what === null) throw new Error("Nothing was opened yet.");
    return what;
  };
  const lied = (lent: Sample): Sample => {
    const isNan = lies.nan > 0 && random() < lies.nan;
    if (lies.clock_s === 0 && !isNan) return lent;
    return {
      ...lent,
      time_s: lent.time_s + lies.clock_s,
      q_rad: isNan
        ? lent.q_rad.map((q, i) => (i === lent.sequence % 3 ? [NaN, Infinity, 1e12][lent.sequence % 3]! : q))
        : lent.q_rad,
    };
  };

  return {
    lies,
    get virtual() {
      return got(virtual);
    },
    get network() {
      return got(line);
    },
    get heard_s() {
      return heard_s;
    },
    get stopped_s() {
      return stopped_s;
    },
    get isOpen() {
      return isOpen;
    },
    get motions() {
      return motions;
    },
    second: () => createRealController({ face: got(again)(), scheduler, name: "Another computer" }),
    brand: {
      ...brand,
      async virtual(options) {
        const started = await brand.virtual(options);
        if (started.kind === "started") virtual = started.virtual;
        return started;
      },
      face(options) {
        if (!inMemory(options.network)) throw new Error("This soak runs in memory.");
        line = options.network;
        again = () => brand.face(options);
        const adapter = brand.face(options);
        const { runText } = adapter;
        return {
          ...adapter,
          // It may change with how the controller speaks just now.
          get stale_s() {
            return adapter.stale_s;
          },
          async open(events) {
            const opened = await adapter.open({
              sample(lent) {
                heard_s = scheduler.now_s();
                events.sample(lied(lent));
              },
              roundTrip(seconds) {
                events.roundTrip(seconds);
              },
              lost(sentence) {
                isOpen = false;
                events.lost(sentence);
              },
            });
            isOpen = opened.kind === "open";
            return opened;
          },
          close() {
            isOpen = false;
            adapter.close();
          },
          move(motion) {
            motions++;
            return adapter.move(motion);
          },
          stop(emergency) {
            if (isOpen) stopped_s = scheduler.now_s();
            adapter.stop(emergency);
          },
          ...(runText
            ? {
                runText(files: Parameters<typeof runText>[0]) {
                  motions++;
                  return runText.call(adapter, files);
                },
              }
            : {}),
        };
      },
    },
  };
}
