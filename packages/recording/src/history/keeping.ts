import type { StoredFile } from "./port.ts";

/** How long recordings are kept, and how they are cut into files. */
export interface Keeping {
  /** A file is closed and the next one begun after this much time … */
  readonly file_s: number;
  /** … or this much of it. */
  readonly file_bytes: number;
  /** Files that began longer ago than this are deleted. */
  readonly keep_s: number;
  /** The oldest are deleted until all of them together weigh no more than this. */
  readonly keep_bytes: number;
}
export const KEEPING: Keeping = {
  file_s: 3600,
  file_bytes: 64_000_000,
  keep_s: 30 * 86_400,
  keep_bytes: 20_000_000_000,
};

const NAME = /^(\d{4})-(\d{2})-(\d{2})T(\d{2})-(\d{2})-(\d{2})-(\d{3})Z_[\w-]+\.mcap$/;

/** Names sort by time, and say when (UTC) and which robot. */
export function fileName(startedAt_ms: number, robot: string): string {
  const { year, month, day } = civil(Math.floor(startedAt_ms / DAY_MS));
  const ms = ((startedAt_ms % DAY_MS) + DAY_MS) % DAY_MS;
  const two = (value: number): string => String(Math.floor(value)).padStart(2, "0");
  return `${String(year).padStart(4, "0")}-${two(month)}-${two(day)}T${two(ms / 3_600_000)}-${two((ms / 60_000) % 60)}-${two((ms / 1000) % 60)}-${String(Math.floor(ms % 1000)).padStart(3, "0")}Z_${robot.replace(/[^\w-]/g, "-")}.mcap`;
}

/** When a file of ours began, in milliseconds since 1970; NaN for any other file. */
export function fileTime_ms(name: string): number {
  const [year, month, day, hours, minutes, seconds, ms] = (NAME.exec(name) ?? []).slice(1).map(Number);
  return ms === undefined
    ? NaN
    : days(year!, month!, day!) * DAY_MS + ((hours! * 60 + minutes!) * 60 + seconds!) * 1000 + ms;
}

const DAY_MS = 86_400_000;
/**
 * Days since 1970-01-01 of a date of the Gregorian calendar, and back. Years begin in March, so that the leap day is
 * the last.
 *
 * @see Richards, Mapping Time, Oxford 1998, ch. 25.
 */
function days(year: number, month: number, day: number): number {
  const y = month > 2 ? year : year - 1;
  const m = (month + 9) % 12;
  return (
    365 * y +
    Math.floor(y / 4) -
    Math.floor(y / 100) +
    Math.floor(y / 400) +
    Math.floor((153 * m + 2) / 5) +
    day -
    1 -
    719_468
  );
}
function civil(since1970: number): { readonly year: number; readonly month: number; readonly day: number } {
  const z = since1970 + 719_468;
  const era = Math.floor(z / 146_097);
  const doe = z - era * 146_097;
  const yoe = Math.floor((doe - Math.floor(doe / 1460) + Math.floor(doe / 36_524) - Math.floor(doe / 146_096)) / 365);
  const doy = doe - (365 * yoe + Math.floor(yoe / 4) - Math.floor(yoe / 100));
  const m = Math.floor((5 * doy + 2) / 153);
  const month = m < 10 ? m + 3 : m - 9;
  return { year: yoe + era * 400 + (month <= 2 ? 1 : 0), month, day: doy - Math.floor((153 * m + 2) / 5) + 1 };
}

/**
 * Files that are kept no longer, oldest first. Files that are not named like ours are nobody's to delete.
 *
 * @param open  the file being written; it stays.
 */
export function expired(
  files: readonly StoredFile[],
  keeping: Pick<Keeping, "keep_s" | "keep_bytes">,
  now_ms: number,
  open = "",
): string[] {
  const ours = files
    .filter(({ name }) => !Number.isNaN(fileTime_ms(name)))
    .sort((a, b) => fileTime_ms(a.name) - fileTime_ms(b.name));
  let left = ours.reduce((sum, { bytes }) => sum + bytes, 0);
  const gone: string[] = [];
  for (const { name, bytes } of ours) {
    if (name === open || (now_ms - fileTime_ms(name) <= keeping.keep_s * 1000 && left <= keeping.keep_bytes)) continue;
    left -= bytes;
    gone.push(name);
  }
  return gone;
}
