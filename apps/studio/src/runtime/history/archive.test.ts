import { manualScheduler, robotById, type JointSample } from "@twincell/core";
import { createRunRecorder } from "@twincell/recording";
import { expect, test } from "vitest";
import { historyStore, windowAt, zoomTo } from "../../stores/history.ts";
import { noticeStore } from "../../stores/notices.ts";
import { viewStore } from "../../stores/view.ts";
import { listRuns, openRunFile, removeRun, tidyRuns, type RunStorage } from "./archive.ts";
import { theLive } from "../live.ts";
import { openHere } from "./recordings.ts";
import { travelBack } from "./travel-back.ts";

const robot = robotById("staubli_rx90l")!;
const record = {
  id: "r1",
  name: "Trace",
  startedAt: "2026-01-02T03:04:05Z",
  duration_s: 2,
  bytes: 0,
  ending: "running" as const,
};

function memoryRunStorage(room = Infinity): RunStorage {
  const kept = new Map<string, unknown>();
  return {
    async set(key, value) {
      if (kept.size >= room) {
        const full = new Error("full");
        full.name = "QuotaExceededError";
        throw full;
      }
      kept.set(key, structuredClone(value));
    },
    async get(key) {
      return kept.get(key);
    },
    async keys() {
      return [...kept.keys()];
    },
    async remove(keys) {
      for (const key of keys) kept.delete(key);
    },
  };
}
const sample = (i: number): JointSample => ({
  sequence: i,
  time_s: i * 0.01,
  q_rad: Float64Array.from(robot.home_rad, q => q + i * 0.001),
  moving: true,
  mode: "automatic",
  safety: "normal",
  override: 1,
  gripperClosed: false,
  step: `s${Math.floor(i / 100)}`,
  message: "",
});
function recordInto(runStorage: RunStorage, samples: number, finish: boolean) {
  const file = openRunFile(runStorage, "r1");
  file.note(record);
  const recorder = createRunRecorder(file.sink, {
    robot,
    startedAt_ns: 0n,
    program: "Trace",
    cell: "Cell",
    chunk_s: 0.5,
  });
  for (let i = 0; i < samples; i++) recorder.record(sample(i));
  if (finish) {
    recorder.finish();
    file.note({ ...record, ending: "done" });
  }
  return file;
}

test("T-54 travel back: the pose at any moment is the recorded one", async () => {
  const runStorage = memoryRunStorage();
  await recordInto(runStorage, 201, true).settled();
  viewStore.setState({ mode: "history" });
  const back = travelBack(runStorage, manualScheduler(), openHere, () => Date.parse(record.startedAt));
  await back.refresh();
  expect(historyStore.getState().runs).toMatchObject([{ id: "r1", ending: "done" }]);
  await back.open("r1");
  expect(historyStore.getState().duration_s).toBeCloseTo(2, 9);
  for (const at of [0, 0.5, 1.234, 2]) {
    back.seek(at);
    expect(theLive().q_rad[1]).toBeCloseTo(robot.home_rad[1]! + Math.floor(at / 0.01 + 1e-6) * 0.001, 12);
  }
  expect(historyStore.getState()).toMatchObject({ moment: { step: "s2", recorded: true }, t_s: 2 });
});

test("a closed tab loses at most the piece under way, and says that the run was cut off", async () => {
  const runStorage = memoryRunStorage();
  await recordInto(runStorage, 175, false).settled();
  expect(await listRuns(runStorage)).toMatchObject([{ ending: "cut-off" }]);
  const back = travelBack(runStorage, manualScheduler(), openHere, () => Date.parse(record.startedAt));
  await back.open("r1");
  expect(historyStore.getState().duration_s).toBeGreaterThanOrEqual(1.75 - 0.5 - 0.02);
});

test("a full disk is one sentence; what was kept can be opened", async () => {
  const runStorage = memoryRunStorage(4);
  const file = recordInto(runStorage, 500, true);
  expect(await file.settled()).toBe("The browser has no room left for this recording.");
  const back = travelBack(runStorage, manualScheduler(), openHere, () => Date.parse(record.startedAt));
  await back.open("r1");
  expect(historyStore.getState().duration_s).toBeGreaterThan(0);
});

test("bytes that are no recording are told, and nothing stays open", async () => {
  const runStorage = memoryRunStorage();
  await runStorage.set("meta:bad", { ...record, id: "bad" });
  await runStorage.set("piece:bad:00000000", new Uint8Array([1, 2, 3]));
  const back = travelBack(runStorage, manualScheduler(), openHere, () => Date.parse(record.startedAt));
  await back.open("bad");
  expect(historyStore.getState().open).toBeNull();
  expect(noticeStore.getState().notices.at(-1)?.tone).toBe("bad");
  await removeRun(runStorage, "bad");
  expect(await runStorage.keys()).toEqual([]);
});

test("runs are kept for 90 days and up to 1 GB; the oldest go, the newest stays", async () => {
  const runStorage = memoryRunStorage();
  const now_ms = Date.parse("2026-06-01T00:00:00Z");
  const keep = async (id: string, startedAt: string, bytes: number): Promise<void> => {
    await runStorage.set(`meta:${id}`, { ...record, id, startedAt, bytes, ending: "done" });
    await runStorage.set(`piece:${id}:00000000`, new Uint8Array(3));
  };
  await keep("old", "2026-01-01T00:00:00Z", 10);
  await keep("large", "2026-05-01T00:00:00Z", 600_000_000);
  await keep("mid", "2026-05-20T00:00:00Z", 600_000_000);
  await keep("new", "2026-05-30T00:00:00Z", 10);
  expect(await tidyRuns(runStorage, now_ms)).toBe(2);
  expect((await runStorage.keys()).filter(key => key.startsWith("meta:")).sort()).toEqual(["meta:mid", "meta:new"]);
  await keep("new", "2020-01-01T00:00:00Z", 2e9);
  await removeRun(runStorage, "mid");
  expect(await tidyRuns(runStorage, now_ms)).toBe(0);
});
test("the time shown follows the moment that is looked at", () => {
  historyStore.setState({ duration_s: 1000, t_s: 990, window: { from_s: 0, to_s: 1000 } });
  zoomTo(60);
  expect(historyStore.getState().window).toEqual({ from_s: 940, to_s: 1000 });
  expect(windowAt(950, historyStore.getState())).toEqual({ from_s: 940, to_s: 1000 });
  expect(windowAt(500, historyStore.getState())).toEqual({ from_s: 470, to_s: 530 });
  zoomTo(null);
  expect(historyStore.getState().window).toEqual({ from_s: 0, to_s: 1000 });
});
