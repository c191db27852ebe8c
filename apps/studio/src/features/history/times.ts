import { fixed } from "../../messages/numbers.ts";

/** 12.34 s below a minute, 1:02:03.4 above it. */
export function clockOf(t_s: number): string {
  if (t_s < 60) return `${fixed(t_s, 2)} s`;
  const tenths = Math.floor(t_s * 10);
  const hours = Math.floor(tenths / 36_000);
  const minutes = Math.floor(tenths / 600) % 60;
  const rest = tenths % 600;
  const two = (value: number): string => String(value).padStart(2, "0");
  return `${hours > 0 ? `${hours}:${two(minutes)}` : minutes}:${two(Math.floor(rest / 10))}.${rest % 10}`;
}
const wall = new Intl.DateTimeFormat("en-GB", {
  day: "numeric",
  month: "short",
  hour: "2-digit",
  minute: "2-digit",
  second: "2-digit",
});
/** What the clock on the wall showed. */
export const wallOf = (startedAt_ms: number, t_s: number): string => wall.format(new Date(startedAt_ms + t_s * 1000));
/** Marks of a list for which there is no room are counted, not shown. */
export const MOST_SHOWN = 200;
