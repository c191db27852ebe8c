import type { CommandOutcome, Refusal } from "@twincell/core";
import { expect, test } from "vitest";
import type { AdapterEvents } from "./adapter.ts";
import { DriverStates, type Underway } from "./states.ts";

const closedHere: Refusal = { code: "link.closed", sentence: "It was closed.", hint: "Connect it." };
class Plain extends DriverStates<Underway> {
  released = 0;
  protected readonly closedBecause = closedHere;
  protected release(): void {
    this.released++;
  }
}
function bench() {
  const told: string[] = [];
  const events: AdapterEvents = {
    sample: () => undefined,
    roundTrip: () => undefined,
    lost: sentence => told.push(sentence),
  };
  const wire = new Plain();
  const begin = (): Promise<CommandOutcome> =>
    wire.execute(
      resolve => ({ resolve }),
      () => undefined,
    );
  return { told, events, wire, begin };
}

test("a driver goes from closed over connecting to ready, executes, stops, and is ready again", async () => {
  const { events, wire, begin } = bench();
  expect(wire.phase).toBe("closed");
  const isMine = wire.connecting();
  expect([wire.phase, isMine()]).toEqual(["connecting", true]);
  expect(wire.ready(events)).toEqual({ kind: "open" });
  expect(wire.phase).toBe("ready");
  const first = begin();
  expect(wire.phase).toBe("executing");
  wire.ending = { kind: "stopped", why: closedHere };
  expect(wire.phase).toBe("stopping");
  wire.settle(wire.ending);
  expect([wire.phase, await first]).toEqual(["ready", { kind: "stopped", why: closedHere }]);
  const second = begin();
  expect(wire.phase).toBe("executing");
  wire.settle({ kind: "done" });
  expect([wire.phase, await second]).toEqual(["ready", { kind: "done" }]);
});

test("a lost connection ends what is under way, is told once, and what it still says is not its successor's", async () => {
  const { told, events, wire, begin } = bench();
  const isFirst = wire.connecting();
  wire.ready(events);
  const moving = begin();
  wire.lose("The line broke.");
  expect([wire.phase, isFirst(), await moving]).toEqual(["closed", false, { kind: "stopped", why: closedHere }]);
  wire.lose("It broke once more.");
  expect(told).toEqual(["The line broke."]);
  const isSecond = wire.connecting();
  // The older attempt gives up late: the newer one goes on.
  expect(wire.failed(isFirst, closedHere, true)).toEqual({ kind: "failed", why: closedHere, again: true });
  expect([wire.phase, isSecond()]).toEqual(["connecting", true]);
  wire.failed(isSecond, closedHere, false);
  expect([wire.phase, isSecond()]).toEqual(["closed", false]);
});
