import { DRIVER_KINDS, openRobotConnection, robotsOf, startSynchronized } from "@twincell/controllers";
import { manualScheduler, robotById } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { createClient, createRobotServer, type ConnectionEvent } from "@twincell/protocol";
import { createArchive, memoryFiles, openHistory, type Note } from "@twincell/recording";
import { zstd } from "@twincell/recording/zstd";
import { expect, test } from "vitest";
import { recordStations, type StationRecorder } from "./recorder.ts";

const packing = await zstd();

/** A host with virtual controllers, a recorder that listens, and one who commands; in virtual time. */
function bench() {
  const scheduler = manualScheduler();
  const port = memoryFiles();
  const problems: string[] = [];
  const told: ConnectionEvent[] = [];
  const host = createRobotServer({
    scheduler,
    version: "test",
    brands: [],
    together: (members, onStarted) => startSynchronized(members, scheduler, onStarted),
    open: async ask => {
      const brand = DRIVER_KINDS.find(({ id }) => id === ask.brand)!;
      const robot = robotById(ask.robot)!;
      return openRobotConnection({ id: ask.station, brand, robot, scheduler, dialect: dialectById(brand.dialect)! });
    },
  });
  const early: string[] = [];
  let recorder: StationRecorder | null = null;
  const listening = host.join("recorder", {
    send: text => {
      if (recorder) recorder.hear(text);
      else early.push(text);
    },
    close: () => undefined,
  });
  recorder = recordStations(
    { send: listening.hear, close: () => undefined },
    {
      now_s: scheduler.now_s,
      onTrouble: sentence => {
        problems.push(sentence);
      },
      archive: (station, robot) =>
        createArchive(port, {
          robot,
          cell: station.name,
          program: "",
          compact: { packing },
          clock_ns: () => 1_795_000_000_000_000_000n + BigInt(Math.round(scheduler.now_s() * 1e9)),
        }),
    },
  );
  for (const text of early) recorder.hear(text);
  const client = createClient(
    {
      send: text => {
        me.hear(text);
      },
      close: () => undefined,
    },
    scheduler.now_s,
    message => {
      told.push(message);
    },
  );
  const waiting: string[] = [];
  let joined = false;
  const me = host.join("Anna", {
    send: text => {
      if (joined) client.hear(text);
      else waiting.push(text);
    },
    close: () => undefined,
  });
  joined = true;
  for (const text of waiting) client.hear(text);
  const stop = scheduler.every(0.1, () => {
    void recorder.tick();
  });
  return { scheduler, host, recorder, client, port, troubles: problems, told, stop };
}

test.each(DRIVER_KINDS.map(brand => [brand.id, brand] as const))(
  "T-54 T-61 X-43 X-48 two-way telemetry of a virtual %s: every sample with its times, every command with who gave it, and how late both are",
  async (_, brand) => {
    const robot = robotsOf(brand)[0]!;
    const { scheduler, host, recorder, client, port, troubles: problems, told, stop } = bench();
    const ask = async (request: Parameters<typeof client.ask>[0]) => {
      const asked = client.ask(request);
      // ros_server of a Stäubli says nothing for its first second.
      await scheduler.elapse(1.5);
      return asked;
    };
    const beat = scheduler.every(0.02, () => {
      client.alive("cell");
    });
    expect(await ask({ type: "open", station: "cell", brand: brand.id, robot: robot.id })).toEqual({ kind: "done" });
    expect(await ask({ type: "connect", station: "cell" })).toEqual({ kind: "done" });
    await ask({ type: "pendant", station: "cell", act: { do: "mode", mode: "remote" } });
    expect(await ask({ type: "take", station: "cell" })).toEqual({ kind: "done" });
    const boris = createClient(
      {
        send: text => {
          commander.hear(text);
        },
        close: () => undefined,
      },
      scheduler.now_s,
      () => undefined,
    );
    const commander = host.join("Boris", { send: () => undefined, close: () => undefined });
    const there = Array.from(robot.home_rad, (q, j) => q + (j === 0 ? 0.2 : 0));
    const before = told.length;
    const asked_s = scheduler.now_s();
    const moving = client.ask({ type: "move", station: "cell", q_rad: there });
    await scheduler.elapse(6);
    const outcome = await Promise.race([moving, Promise.resolve({ kind: "still moving" as const })]);
    const first = told.slice(before).find(message => message.type === "sample" && message.moving);
    // Everything that operators do belongs to the history: also what another one is refused, does at the cabinet, and
    // stops.
    void boris.ask({ type: "zero", station: "cell" });
    void boris.ask({ type: "pendant", station: "cell", act: { do: "guard", open: true } });
    boris.stop("cell", true);
    await scheduler.elapse(0.2);
    await ask({ type: "close", station: "cell" });
    beat();
    stop();
    recorder.close();
    host.close();
    expect(problems).toEqual([]);

    const opened = await openHistory(port, { packing });
    if (opened.kind !== "history") throw new Error(opened.sentence);
    const { history } = opened;
    const notes: Note[] = [];
    for await (const part of history.samples(0, Infinity)) notes.push(...part.notes);
    expect(history.robot).toBe(robot.id);
    expect(notes.filter(note => note.kind === "operator")).toContainEqual(
      expect.objectContaining({ who: "Anna", action: "takes the lease" }),
    );
    const commands = notes
      .filter(note => note.kind === "command")
      .map(({ name, by, outcome: became }) => `${by} ${name}: ${became}`);
    expect(commands).toEqual(
      expect.arrayContaining([
        "Anna moves the joints: sent",
        "Anna moves the joints: done",
        "Boris moves all joints to zero: sent",
        "Boris moves all joints to zero: refused",
        "Boris presses the emergency stop: done",
      ]),
    );
    expect(notes.find(note => note.kind === "command" && note.by === "Anna" && note.outcome === "sent")).toMatchObject({
      target: there,
    });
    expect(notes.find(note => note.kind === "command" && note.outcome === "refused")).toMatchObject({
      sentence: expect.stringContaining("commanded by Anna"),
    });
    expect(notes.filter(note => note.kind === "operator")).toEqual(
      expect.arrayContaining([
        expect.objectContaining({ who: "Boris", action: "at the pendant", detail: "guard opened" }),
        expect.objectContaining({ who: "Anna", action: "at the pendant", detail: "mode remote" }),
      ]),
    );
    const latencies = notes.filter(note => note.kind === "latency");
    expect(latencies.map(({ stage }) => stage)).toContain("host and back");
    expect(latencies.some(({ stage, direction }) => stage === "controller to host" && direction === "from-robot")).toBe(
      true,
    );
    expect(latencies.every(({ worst_ms, p99_ms, median_ms }) => median_ms <= p99_ms && p99_ms <= worst_ms + 1e-9)).toBe(
      true,
    );
    // What the recorder has is what the one who commands was told: the same joints at the end.
    const last = told.findLast(message => message.type === "sample")!;
    if (last.type !== "sample") throw new Error("No sample came.");
    const end = await history.at(history.duration_s);
    last.q_rad.forEach((q, j) => {
      expect(Math.abs(end.q_rad[j]! - q)).toBeLessThan(1e-6);
    });
    expect(outcome).toEqual({ kind: "done" });
    // Commanded and seen to move: what the wire, the cycle of the controller and the sampling cost together.
    if (first?.type !== "sample") throw new Error("The robot was never seen to move.");
    expect(first.sent_s - asked_s).toBeLessThan(0.1);
  },
  60_000,
);
