import { parseProgram, type CommandOutcome, type RobotCommander } from "@twincell/core";
import type { RequestOf } from "./ask.ts";
import { refused } from "./outcome.ts";
import type { ServedConnection } from "./served.ts";
import {
  createProduction,
  productionRefusal,
  type Production,
  type ProductionOrder,
  type ProductionState,
} from "./production.ts";
import type { EventOf } from "./tell.ts";

export type ProductionRequest = RequestOf<
  "produce" | "replace" | "intervene" | "resume" | "single-step" | "breakpoints"
>;
const NONE = refused("production.none", "No production runs on this robot.", "Begin one.");

/** The productions of a host, one a station. */
export function createProductions(all: (message: EventOf<"production">) => void) {
  const running = new Map<ServedConnection, Production>();
  const words = (station: ServedConnection, state: ProductionState): EventOf<"production"> => ({
    type: "production",
    station: station.words.id,
    ...state,
  });
  function orderOf(ask: {
    readonly program: unknown;
    readonly asText: boolean;
    readonly despite?: readonly string[];
  }): ProductionOrder | CommandOutcome {
    const parsed = parseProgram(ask.program);
    if (parsed.kind !== "program")
      return refused(
        "station.program",
        `The program cannot be read: ${parsed.faults[0]?.sentence ?? "it is empty"}`,
        "Export it again.",
      );
    return { program: parsed.program, asText: ask.asText, despite: ask.despite ?? [] };
  }
  async function begin(
    station: ServedConnection,
    seat: RobotCommander,
    ask: RequestOf<"produce">,
  ): Promise<CommandOutcome> {
    if (running.has(station))
      return refused(
        "production.exists",
        `${station.words.name} is in production already.`,
        "Give it another program with replace, or stop it first.",
      );
    const order = orderOf(ask);
    if (!("program" in order)) return order;
    const why = productionRefusal(order, ask);
    if (why) return { kind: "refused", why };
    const production = createProduction(station, seat, order, ask, state => {
      all(words(station, state));
    });
    running.set(station, production);
    try {
      return await production.run();
    } finally {
      running.delete(station);
    }
  }

  return {
    async carryOut(
      who: string,
      station: ServedConnection,
      seat: RobotCommander,
      ask: ProductionRequest,
    ): Promise<CommandOutcome> {
      if (ask.type === "produce") return begin(station, seat, ask);
      const production = running.get(station);
      if (!production) return NONE;
      if (ask.type === "intervene") return production.hold();
      const { holder } = station.guard.state;
      if (holder !== who)
        return refused(
          "guard.no-lease",
          holder === null ? "Nobody has the lease." : `${station.words.name} is commanded by ${holder}.`,
          holder === null ? "Take the lease first." : "Wait until the lease is given back. Anyone may stop the robot.",
        );
      switch (ask.type) {
        case "replace": {
          const order = orderOf(ask);
          return "program" in order ? production.replace(order) : order;
        }
        case "resume":
          return production.resume(seat, ask.from);
        case "single-step":
          return production.step(seat);
        case "breakpoints":
          return production.setBreakpoints(ask.steps);
      }
    },
    stateOf(station: ServedConnection): EventOf<"production"> | null {
      const production = running.get(station);
      return production ? words(station, production.state) : null;
    },
    stopped(station: ServedConnection): void {
      running.get(station)?.stopped();
    },
  };
}
