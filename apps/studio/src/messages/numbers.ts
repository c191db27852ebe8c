let locale = "en";
let point = ".";

/** Numbers and dates are shown from now on as the language shows them. */
export function setNumbersOf(language: string): void {
  locale = language;
  point = new Intl.NumberFormat(language).formatToParts(0.5).find(({ type }) => type === "decimal")?.value ?? ".";
}

/** The sign before decimals. */
export const decimalPoint = (): string => point;

/** A number with so many decimals, for a person: 12.50, or 12,50 in German. Never for a file or a controller. */
export function fixed(value: number, decimals: number): string {
  const text = value.toFixed(decimals);
  return point === "." ? text : text.replace(".", point);
}

/** A number with all its digits, for a person. */
export const digits = (value: number): string => String(value).replace(".", point);

/** A whole number with what the language puts between thousands. */
export const whole = (value: number): string => Math.round(value).toLocaleString(locale);

/** A day, for a person: Nov 26, 2026. */
export const day = (time_ms: number): string =>
  new Date(time_ms).toLocaleDateString(locale, { day: "numeric", month: "short", year: "numeric" });

/** A time of day, for a person: 14:05. */
export const timeOfDay = (time_ms: number): string =>
  new Date(time_ms).toLocaleTimeString(locale, { hour: "2-digit", minute: "2-digit" });

/** A day and a time of day, for a person. */
export const moment = (time_ms: number): string => new Date(time_ms).toLocaleString(locale);
