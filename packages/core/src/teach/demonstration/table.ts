import { pose, type Pose } from "../../spatial/pose.ts";
import { fromEulerAngles } from "../../spatial/turns.ts";
import { normalizeQuaternion, type Quaternion } from "../../spatial/quaternion.ts";
import { radians } from "../../spatial/units.ts";
import { LEAST_SAMPLES, MOST_SAMPLES, type Demonstration } from "./demonstration.ts";
import { demonstratedMotion } from "./motion.ts";

export type ReadDemonstration =
  | {
      readonly kind: "demonstration";
      readonly demonstration: Demonstration;
      /** Lines that were left out: not numbers, or not later than the line before. */
      readonly dropped: number;
    }
  | { readonly kind: "unreadable"; readonly line: number; readonly sentence: string };

/** What `writeDemonstration` writes (row M-35): position, orientation, velocity, acceleration, and the hand. */
export const DEMONSTRATION_COLUMNS = [
  ..."t_s x_m y_m z_m qx qy qz qw vx_mps vy_mps vz_mps wx_radps wy_radps wz_radps".split(" "),
  ..."ax_mps2 ay_mps2 az_mps2 closed".split(" "),
] as const;

const unreadable = (line: number, sentence: string): ReadDemonstration => ({ kind: "unreadable", line, sentence });

/**
 * Reads a recorded hand from a table: one line a sample, values between commas, semicolons or tabs, "#" begins a
 * comment, the first other line names the columns in any order.
 *
 * t_s (or t_ms), x_m y_m z_m (or x_mm …), then either qx qy qz qw or rx_deg ry_deg rz_deg (about the fixed axes x, then
 * y, then z); without an orientation every sample has `down`. closed: 0 or 1, the hand holds something. Other columns,
 * velocity and acceleration among them, are not read: they follow from the positions.
 *
 * @param down  orientation of the tool when the table has none.
 */
export function readDemonstration(text: string, down: Quaternion = [1, 0, 0, 0]): ReadDemonstration {
  const lines = text.split(/\r\n|\r|\n/);
  const separated = (line: string): string[] => line.split(/[,;\t]/).map(part => part.trim());
  const head = lines.findIndex(line => line.trim() !== "" && !line.trim().startsWith("#"));
  if (head < 0) return unreadable(1, "The table is empty.");
  const columns = separated(lines[head]!.toLowerCase());
  const columnOf = readersOf(columns);
  if (columnOf.kind === "missing") return unreadable(head + 1, columnOf.sentence);
  const times_s: number[] = [];
  const worldFromTcp: Pose<"world", "tcp">[] = [];
  const closed: boolean[] = [];
  let dropped = 0;
  for (let i = head + 1; i < lines.length; i++) {
    const line = lines[i]!.trim();
    if (line === "" || line.startsWith("#")) continue;
    const values = separated(line).map(part => (part === "" ? NaN : Number(part)));
    const t_s = columnOf.time(values);
    const position = columnOf.position(values);
    const quaternion = columnOf.orientation(values, down);
    const finite = [t_s, ...position, ...quaternion].every(Number.isFinite);
    if (!finite || (times_s.length > 0 && t_s <= times_s.at(-1)!)) {
      dropped++;
      continue;
    }
    if (times_s.length >= MOST_SAMPLES) return unreadable(i + 1, `More than ${MOST_SAMPLES} samples are not read.`);
    times_s.push(t_s);
    worldFromTcp.push(pose(position, quaternion));
    closed.push(columnOf.closed(values));
  }
  if (times_s.length < LEAST_SAMPLES)
    return unreadable(
      lines.length,
      `The table holds ${times_s.length} readable samples (${dropped} left out); at least ${LEAST_SAMPLES} show a motion.`,
    );
  return { kind: "demonstration", demonstration: { times_s, worldFromTcp, closed }, dropped };
}

type Values = readonly number[];
interface Readers {
  readonly kind: "columns";
  readonly time: (values: Values) => number;
  readonly position: (values: Values) => [number, number, number];
  readonly orientation: (values: Values, absent: Quaternion) => Quaternion;
  readonly closed: (values: Values) => boolean;
}

function readersOf(columns: readonly string[]): Readers | { readonly kind: "missing"; readonly sentence: string } {
  const at = (name: string): number => columns.indexOf(name);
  const all = (...names: string[]): boolean => names.every(name => at(name) >= 0);
  const value = (values: Values, name: string): number => values[at(name)] ?? NaN;
  const seconds = all("t_s") ? ({ name: "t_s", unit: 1 } as const) : ({ name: "t_ms", unit: 1e-3 } as const);
  const length = all("x_m", "y_m", "z_m") ? { unit: "m", size: 1 } : { unit: "mm", size: 1e-3 };
  const axes = ["x", "y", "z"].map(axis => `${axis}_${length.unit}`);
  if (!all(seconds.name)) return { kind: "missing", sentence: "The column of times, t_s or t_ms, is missing." };
  if (!all(...axes))
    return { kind: "missing", sentence: "The columns of positions are missing: x_m, y_m, z_m or x_mm, y_mm, z_mm." };
  const byQuaternion = all("qx", "qy", "qz", "qw");
  const byAngles = all("rx_deg", "ry_deg", "rz_deg");
  return {
    kind: "columns",
    time: values => value(values, seconds.name) * seconds.unit,
    position: values => axes.map(axis => value(values, axis) * length.size) as [number, number, number],
    orientation: (values, absent) => {
      if (byQuaternion) {
        const q = ["qx", "qy", "qz", "qw"].map(name => value(values, name)) as unknown as Quaternion;
        return Math.hypot(...q) > 1e-6 ? normalizeQuaternion(q) : ([NaN, NaN, NaN, NaN] as Quaternion);
      }
      if (!byAngles) return absent;
      const [rx_deg, ry_deg, rz_deg] = ["rx_deg", "ry_deg", "rz_deg"].map(name => value(values, name));
      // About fixed x, y, z is the same as about moving z, y, x.
      return fromEulerAngles("zyx", radians(rz_deg!), radians(ry_deg!), radians(rx_deg!));
    },
    closed: values => all("closed") && value(values, "closed") > 0.5,
  };
}

/** The demonstration as a table that `readDemonstration` reads, with its velocities and accelerations (row M-35). */
export function writeDemonstration(demonstration: Demonstration): string {
  const { velocity_mps, angular_radps, acceleration_mps2 } = demonstratedMotion(demonstration);
  const lines = demonstration.times_s.map((t_s, i) => {
    const { position, quaternion } = demonstration.worldFromTcp[i]!;
    return [
      t_s,
      ...position,
      ...quaternion,
      ...velocity_mps[i]!,
      ...angular_radps[i]!,
      ...acceleration_mps2[i]!,
      demonstration.closed[i] ? 1 : 0,
    ]
      .map(value => String(Number(value.toPrecision(12))))
      .join(",");
  });
  return `${[DEMONSTRATION_COLUMNS.join(","), ...lines].join("\n")}\n`;
}
