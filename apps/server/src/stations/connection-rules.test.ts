import { manualScheduler, type CommandOutcome } from "@twincell/core";
import { createClient, type Client } from "@twincell/protocol";
import { afterEach, expect, test } from "vitest";
import { stationHost, type ConnectionRules } from "./host.ts";

const open: (() => void)[] = [];
afterEach(() => {
  for (const close of open.splice(0)) close();
});

/**
 * Opens a UR at that address, or a virtual one without any, on a server with those rules; a real one is never connected
 * to.
 */
async function opened(rules: ConnectionRules, host?: string): Promise<CommandOutcome> {
  const scheduler = manualScheduler();
  const server = stationHost(scheduler, "test", undefined, rules);
  open.push(() => server.close());
  const to: { hear: (text: string) => void } = { hear: () => undefined };
  const client: Client = createClient(
    { send: text => to.hear(text), close: () => undefined },
    () => scheduler.now_s(),
    () => undefined,
  );
  to.hear = server.join("you", { send: text => client.hear(text), close: () => undefined }).hear;
  return client.ask({
    type: "open",
    station: "s",
    brand: "ur",
    robot: "ur10e",
    ...(host === undefined ? {} : { address: { host } }),
  });
}

test("T-58 a server for training opens virtual controllers and no real one, whatever its address", async () => {
  expect(await opened({ training: true })).toEqual({ kind: "done" });
  for (const host of ["127.0.0.1", "localhost", "robot.example"])
    expect(await opened({ training: true, robots: [host] }, host)).toMatchObject({
      kind: "refused",
      why: { code: "station.training", sentence: "This server is for training: it opens virtual controllers only." },
    });
});

test("a server connects only to the addresses it was started with, and names the one that is missing", async () => {
  expect(await opened({ robots: ["127.0.0.9"] }, "127.0.0.9")).toEqual({ kind: "done" });
  expect(await opened({ robots: ["127.0.0.9"] }, "127.0.0.10")).toMatchObject({
    kind: "refused",
    why: {
      code: "station.address",
      sentence: expect.stringContaining("127.0.0.10") as string,
      hint: "Start it with --robots 127.0.0.9,127.0.0.10.",
    },
  });
  expect(await opened({}, "127.0.0.10")).toEqual({ kind: "done" });
  expect(await opened({ robots: [] })).toEqual({ kind: "done" });
});
