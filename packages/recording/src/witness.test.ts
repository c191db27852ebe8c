import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { robotById } from "@twincell/core";
import { expect, test } from "vitest";
import { createRunRecorder, memorySink } from "./index.ts";

/** `pip install mcap mcap-ros2-support` makes this test run; TWINCELL_PYTHON names another interpreter. */
const python = process.env["TWINCELL_PYTHON"] ?? "python3";
const absent = spawnSync(python, ["-c", "import mcap_ros2.reader"]).status !== 0;

const READ = `
import json, sys
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
with open(sys.argv[1], "rb") as file:
    reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
    summary = reader.get_summary()
    joints = [[m.log_time_ns, d.header.stamp.sec, d.header.stamp.nanosec, list(d.name), list(d.position)]
              for _, _, m, d in ((s, c, type("M", (), {"log_time_ns": m.log_time}), d) for s, c, m, d in reader.iter_decoded_messages(topics=["/joint_states"]))]
    states = [json.loads(m.data) for _, _, m in reader.iter_messages(topics=["/robot_state"])]
    events = [json.loads(m.data) for _, _, m in reader.iter_messages(topics=["/events"])]
    meta = [[m.name, m.metadata] for m in reader.iter_metadata()]
    print(json.dumps({"count": summary.statistics.message_count, "joints": joints, "states": states, "events": events, "meta": meta}))
`;

test.skipIf(absent)(
  `the mcap and mcap-ros2-support Python packages read the same run${absent ? " (skipped: they are not installed)" : ""}`,
  () => {
    const robot = robotById("staubli_rx90l")!;
    const sink = memorySink();
    const startedAt_ns = 1_795_237_199_999_999_123n;
    const recorder = createRunRecorder(sink, {
      robot,
      startedAt_ns,
      program: "Kante",
      cell: "Zelle α",
      chunkBytes: 4096,
    });
    const angles = (k: number): Float64Array => Float64Array.from({ length: 6 }, (_, j) => Math.sin(0.01 * k + j));
    for (let k = 0; k < 500; k++) {
      recorder.record({
        sequence: k,
        time_s: 0.004 * k,
        q_rad: angles(k),
        moving: true,
        mode: "automatic",
        safety: "normal",
        override: 1,
        gripperClosed: false,
        step: `s${k >> 8}`,
        message: "",
      });
    }
    recorder.event("stop", "Angehalten – „jetzt“.", "warning");
    recorder.finish();
    const folder = mkdtempSync(join(tmpdir(), "twincell-"));
    try {
      writeFileSync(join(folder, "run.mcap"), sink.bytes());
      const read = JSON.parse(
        execFileSync(python, ["-c", READ, join(folder, "run.mcap")], { encoding: "utf8", maxBuffer: 1 << 26 }),
      ) as {
        count: number;
        joints: [number, number, number, string[], number[]][];
        states: { step: string }[];
        events: { message: string; level: number }[];
        meta: [string, Record<string, string>][];
      };
      expect(read.joints.length).toBe(500);
      expect(read.count).toBe(read.joints.length + read.states.length + read.events.length);
      read.joints.forEach(([, sec, nanosec, names, position], k) => {
        expect(BigInt(sec) * 1_000_000_000n + BigInt(nanosec)).toBe(startedAt_ns + BigInt(k) * 4_000_000n);
        expect(names).toEqual(robot.arm.joints.map(joint => joint.name));
        expect(position).toEqual([...angles(k)]);
      });
      expect([...new Set(read.states.map(state => state.step))]).toEqual(["s0", "s1"]);
      expect(read.events).toMatchObject([{ message: "Angehalten – „jetzt“.", level: 3 }]);
      expect(read.meta).toMatchObject([
        ["twincell.run", { robot: robot.id, cell: "Zelle α" }],
        ["twincell.digest", { json: expect.stringContaining("Angehalten – „jetzt“.") as string }],
      ]);
    } finally {
      rmSync(folder, { recursive: true });
    }
  },
);
