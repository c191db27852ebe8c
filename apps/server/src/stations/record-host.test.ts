import { mkdirSync, mkdtempSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { manualScheduler } from "@twincell/core";
import { createClient, type Client, type ConnectionEvent, type EventOf, type RobotServer } from "@twincell/protocol";
import { fileName, type ArchivePort } from "@twincell/recording";
import { afterAll, expect, test } from "vitest";
import { recordingFolderOf, recordingsFolder, tidyRecordings } from "../files/recordings-folder.ts";
import { stationHost } from "./host.ts";
import { recordServer } from "./record-host.ts";

const root = mkdtempSync(join(tmpdir(), "twincell-recordings-"));
afterAll(() => {
  rmSync(root, { recursive: true, force: true });
});

function joined(host: RobotServer, now_s: () => number): { readonly client: Client; readonly told: ConnectionEvent[] } {
  const told: ConnectionEvent[] = [];
  const early: string[] = [];
  let ready: Client | null = null;
  const me = host.join("you", {
    send: text => {
      if (ready) ready.hear(text);
      else early.push(text);
    },
    close: () => undefined,
  });
  const client = createClient({ send: me.hear, close: () => undefined }, now_s, message => {
    told.push(message);
  });
  ready = client;
  for (const text of early) client.hear(text);
  return { client, told };
}

test("a full disk ends recording with one notice to everybody, it is tried again, and that it goes on is said once", async () => {
  const scheduler = manualScheduler();
  const host = stationHost(scheduler, "test");
  const folder = join(root, "full");
  let full = false;
  let begun = 0;
  const files = (place: string): ArchivePort => {
    const kept = recordingsFolder(place);
    return {
      ...kept,
      create(name) {
        begun++;
        const sink = kept.create(name);
        return {
          get position() {
            return sink.position;
          },
          close() {
            sink.close();
          },
          write(bytes) {
            if (full) throw new Error("the disk is full");
            sink.write(bytes);
          },
        };
      },
    };
  };
  const troubles: string[] = [];
  const recorder = await recordServer(
    host,
    folder,
    scheduler,
    sentence => {
      troubles.push(sentence);
    },
    { files, clock_ns: () => 1_795_000_000_000_000_000n + BigInt(Math.round(scheduler.now_s() * 1e9)) },
  );
  const { client, told } = joined(host, scheduler.now_s);
  const pass = async (seconds: number): Promise<void> => {
    for (let i = 0; i < seconds * 50; i++) {
      client.alive("one");
      await scheduler.elapse(0.02);
    }
  };
  const opened = client.ask({ type: "open", station: "one", brand: "ur", robot: "ur10e" });
  await pass(0.1);
  expect(await opened).toEqual({ kind: "done" });
  const connected = client.ask({ type: "connect", station: "one" });
  await pass(2);
  expect(await connected).toEqual({ kind: "done" });
  const said = () =>
    told
      .filter((message): message is EventOf<"notice"> => message.type === "notice")
      .filter(({ why }) => why.code.startsWith("recording."))
      .map(({ station, why }) => `${station} ${why.code}: ${why.sentence}`);
  full = true;
  await pass(20);
  expect(said()).toEqual([expect.stringMatching(/^one recording\.no-room: .*UR10e.*the disk is full/)]);
  // 500 samples a second came in these 20 s.
  expect(begun).toBeLessThanOrEqual(12);
  full = false;
  await pass(5);
  expect(said()).toEqual([
    expect.stringContaining("recording.no-room"),
    expect.stringMatching(/^one recording\.goes-on: .*UR10e is recorded again/),
  ]);
  expect(troubles.length).toBe(2);
  // What was begun in vain is taken away by the disk in its own time.
  const [place] = readdirSync(folder);
  const list = () => recordingsFolder(join(folder, place!)).list();
  for (let i = 0; i < 200 && (await list()).length > 2; i++) await pass(0.1);
  const closing = client.ask({ type: "close", station: "one" });
  await pass(0.2);
  expect(await closing).toEqual({ kind: "done" });
  recorder.close();
  host.close();
  const left = await list();
  expect(left.length).toBe(2);
  expect(left.every(({ bytes }) => bytes > 0)).toBe(true);
}, 120_000);

test("the folder of a robot is one of its own inside the recordings, whatever its id is", () => {
  const ids = [
    "cell",
    "Cell",
    "a b",
    "a_b",
    "../../etc",
    "..",
    ".",
    "con",
    "x".repeat(200),
    "机器人",
    "机器",
    "a/b",
    "a\\b",
  ];
  const places = ids.map(recordingFolderOf);
  expect(places[0]).toBe("cell");
  expect(new Set(places.map(place => place.toLowerCase())).size).toBe(ids.length);
  for (const place of places) expect(place).toMatch(/^[a-z0-9_][a-z0-9_-]{0,79}$/i);
  expect(places.some(place => /^(con|nul|aux|prn|com\d|lpt\d)$/i.test(place))).toBe(false);
});

test("recordings of robots that are gone are deleted when they are too old, and their folders with them; others stay", async () => {
  const folder = join(root, "old");
  const now_ms = Date.UTC(2026, 10, 23);
  const file = (place: string, days: number): string => {
    mkdirSync(join(folder, place), { recursive: true });
    const name = fileName(now_ms - days * 86_400_000, "ur10e");
    writeFileSync(join(folder, place, name), "x");
    return name;
  };
  file("gone", 31);
  file("gone", 40);
  writeFileSync(join(folder, "gone", fileName(now_ms - 60_000, "ur10e")), "");
  const young = file("resting", 29);
  file("resting", 31);
  const recorded = file("recorded", 31);
  mkdirSync(join(folder, "never-recorded"));
  writeFileSync(join(folder, "notes.txt"), "mine");
  mkdirSync(join(folder, "mine"));
  writeFileSync(join(folder, "mine", "notes.txt"), "mine");
  await tidyRecordings(folder, new Set(["recorded"]), now_ms);
  expect(readdirSync(folder).sort()).toEqual(["mine", "notes.txt", "recorded", "resting"]);
  expect(readdirSync(join(folder, "resting"))).toEqual([young]);
  expect(readdirSync(join(folder, "recorded"))).toEqual([recorded]);
  await tidyRecordings(join(root, "nowhere"), new Set(), now_ms);
});
