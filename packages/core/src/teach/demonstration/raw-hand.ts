import { pose, type Pose } from "../../spatial/pose.ts";
import { conjugate, multiply, normalizeQuaternion, rotate, type Quaternion } from "../../spatial/quaternion.ts";
import { add, type Vector3 } from "../../spatial/vector.ts";
import { LEAST_SAMPLES, MOST_SAMPLES } from "./demonstration.ts";
import { FINGERS, handBend, handClosed, type HandProfile } from "./hand-profile.ts";
import type { ReadDemonstration } from "./table.ts";
import { accelerationOf, HIGHEST_V, integrateTracker, TRACKER_DEFAULTS, type TrackerOptions } from "./tracker.ts";

/** What a glove with a tracker sends, one line a sample: time, three voltages, the orientation, five finger sensors. */
export const RAW_HAND_COLUMNS = ["t_s", "ax_V", "ay_V", "az_V", "qx", "qy", "qz", "qw", "f1", "f2", "f3", "f4", "f5"];

/**
 * A demonstration from what glove and tracker measured (rows M-24 to M-37): voltages become accelerations by the
 * profile's line, these positions by integrating twice, fingers the grip. The tracker's accelerations are along its own
 * axes and free of gravity; its orientation turns them into the world.
 *
 * @param text   lines of `RAW_HAND_COLUMNS`, values between commas, "#" begins a comment; the first line may name the
 *   columns.
 * @param start  where the tool is at the first sample.
 */
export function readRawHand(
  text: string,
  profile: HandProfile,
  start: Pose<"world", "tcp">,
  options: TrackerOptions = TRACKER_DEFAULTS,
): ReadDemonstration {
  const times_s: number[] = [];
  const accelerations: Vector3[] = [];
  const turns: Quaternion[] = [];
  const closed: boolean[] = [];
  let dropped = 0;
  let holds = false;
  const lines = text.split(/\r\n|\r|\n/);
  for (const [i, line] of lines.entries()) {
    if (line.trim() === "" || line.trim().startsWith("#") || /^\s*t_s\b/i.test(line)) continue;
    const values = line.split(",").map(part => (part.trim() === "" ? NaN : Number(part)));
    const [t_s, ...rest] = values as [number, ...number[]];
    const volts = rest.slice(0, 3);
    const turn = rest.slice(3, 7);
    const usable =
      values.length === RAW_HAND_COLUMNS.length &&
      values.every(Number.isFinite) &&
      volts.every(V => V >= 0 && V <= HIGHEST_V) &&
      Math.hypot(...turn) > 1e-6 &&
      (times_s.length === 0 || t_s > times_s.at(-1)!);
    if (!usable) {
      dropped++;
      continue;
    }
    if (times_s.length >= MOST_SAMPLES)
      return { kind: "unreadable", line: i + 1, sentence: `More than ${MOST_SAMPLES} samples are not read.` };
    const quaternion = normalizeQuaternion(turn as Quaternion);
    times_s.push(t_s);
    turns.push(quaternion);
    accelerations.push(rotate(quaternion, volts.map(V => accelerationOf(V, profile.accelerometer)) as Vector3));
    holds = handClosed(handBend(rest.slice(7, 7 + FINGERS), profile), holds);
    closed.push(holds);
  }
  if (times_s.length < LEAST_SAMPLES)
    return {
      kind: "unreadable",
      line: lines.length,
      sentence: `${times_s.length} readable samples (${dropped} left out); at least ${LEAST_SAMPLES} show a motion. A line is ${RAW_HAND_COLUMNS.join(",")}.`,
    };
  const { position_m } = integrateTracker(times_s, accelerations, options);
  // The tool turns as the hand turned since the first sample.
  const [first] = turns;
  const handFromWorld = conjugate(first!);
  const worldFromTcp = position_m.map((moved, i) => {
    const turned = multiply(multiply(turns[i]!, handFromWorld), start.quaternion);
    return pose<"world", "tcp">(add(start.position, moved), turned);
  });
  return { kind: "demonstration", demonstration: { times_s, worldFromTcp, closed }, dropped };
}
