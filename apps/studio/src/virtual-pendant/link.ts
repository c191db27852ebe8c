import type { CommandOutcome } from "@twincell/core";
import type { PendantAct, PendantShown, PendantWords, EventOf } from "@twincell/protocol";
import { createStore, type StoreApi } from "zustand/vanilla";

/** What changes with every sample is not in it: the read-out is written past React. */
export type Lamps = Omit<PendantShown, "q_rad" | "flange" | "points">;
export interface VirtualPendantView {
  readonly words: PendantWords | null;
  readonly lamps: Lamps | null;
  readonly connected: boolean;
  /** The last refusal, until the next act that is not refused. */
  readonly complaint: { readonly sentence: string; readonly hint: string } | null;
}
/** A pendant as a page has it: over a socket from a process of its own, or from a worker of the same page. */
export interface VirtualPendantLink {
  readonly station: string;
  readonly view: StoreApi<VirtualPendantView>;
  readonly shown: PendantShown | null;
  act(act: PendantAct): void;
  /** The enabling switch: while it is held, signs of life go out. */
  enable(pressed: boolean): void;
  /** Everything that is held is let go. */
  letGo(): void;
  watch(on: boolean): void;
  onShown(listen: (shown: PendantShown) => void): () => void;
  take(message: EventOf<"pendant">): void;
  gone(): void;
}
/** What a link needs of the connection. */
export interface VirtualPendantWire {
  ask(
    request:
      | { readonly type: "pendant"; readonly station: string; readonly act: PendantAct }
      | { readonly type: "visit"; readonly station: string; readonly on: boolean },
  ): Promise<CommandOutcome>;
  alive(station: string): void;
}

const ALIVE_EVERY_MS = 20;
const lampsOf = ({
  key,
  servo,
  safety,
  override,
  program,
  running,
  alarms,
  moving,
  enabled,
  jog,
  pressed,
  gateOpen,
  near,
  on,
  trouble: problem,
  peers,
  says,
}: PendantShown): Lamps => ({
  key,
  servo,
  safety,
  override,
  program,
  running,
  alarms,
  moving,
  enabled,
  jog,
  pressed,
  gateOpen,
  near,
  on,
  trouble: problem,
  peers,
  says,
});

export function createVirtualPendantLink(station: string, wire: VirtualPendantWire): VirtualPendantLink {
  const view = createStore<VirtualPendantView>(() => ({ words: null, lamps: null, connected: false, complaint: null }));
  const listeners = new Set<(shown: PendantShown) => void>();
  let shown: PendantShown | null = null;
  let said = "";
  let beat: ReturnType<typeof setInterval> | undefined;
  let jogging = false;
  const act = (what: PendantAct): void => {
    if (what.do === "jog") jogging = what.direction !== 0;
    void wire.ask({ type: "pendant", station, act: what }).then(outcome => {
      const complaint = outcome.kind === "done" ? null : { sentence: outcome.why.sentence, hint: outcome.why.hint };
      // Letting go of something says nothing about why it did not move.
      const lettingGo = (what.do === "jog" && what.direction === 0) || (what.do === "enable" && !what.pressed);
      if (complaint || !lettingGo) view.setState({ complaint });
    });
  };
  const enable = (pressed: boolean): void => {
    clearInterval(beat);
    beat = pressed
      ? setInterval(() => {
          wire.alive(station);
        }, ALIVE_EVERY_MS)
      : undefined;
    act({ do: "enable", pressed });
  };
  return {
    station,
    view,
    act,
    enable,
    get shown() {
      return shown;
    },
    letGo() {
      if (jogging) act({ do: "jog", joint: 1, direction: 0 });
      if (beat !== undefined) enable(false);
    },
    watch(on) {
      void wire.ask({ type: "visit", station, on }).then(outcome => {
        if (outcome.kind !== "done")
          view.setState({ complaint: { sentence: outcome.why.sentence, hint: outcome.why.hint } });
      });
    },
    onShown(listen) {
      listeners.add(listen);
      if (shown) listen(shown);
      return () => {
        listeners.delete(listen);
      };
    },
    take(message) {
      shown = message.shown;
      const lamps = lampsOf(shown);
      const says = JSON.stringify(lamps);
      if (message.words || says !== said || !view.getState().connected)
        view.setState({ ...(message.words ? { words: message.words } : {}), lamps, connected: true });
      said = says;
      for (const listen of listeners) listen(shown);
    },
    gone() {
      clearInterval(beat);
      beat = undefined;
      view.setState({ connected: false });
    },
  };
}
