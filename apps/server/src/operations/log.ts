export type Level = "info" | "warning" | "error";
/** What a server says to whoever started it. */
export interface Log {
  say(level: Level, event: string, sentence: string, more?: Readonly<Record<string, string | number | boolean>>): void;
}
/** Tokens of `twincell token add`, and codes, links and passwords as they stand in addresses and headers. */
const SECRETS: readonly (readonly [RegExp, string])[] = [
  [/twincell_[\w-]{8,}/g, "twincell_***"],
  [/([?&](?:code|token|invitation|lease|secret|password)=)[^&\s"]+/gi, "$1***"],
  [/(\b(?:bearer|basic)\s+)[\w.~+/=-]+/gi, "$1***"],
  [/(:\/\/[^/\s:@]+:)[^@\s/]+@/g, "$1***@"],
  [/("(?:password|secret|token|code|lease|invitation|link)"\s*:\s*")[^"]*"/gi, '$1***"'],
];
/** A sentence without what lets somebody in. */
export const withoutSecrets = (text: string): string =>
  SECRETS.reduce((cleaned, [pattern, instead]) => cleaned.replace(pattern, instead), text);

/** One JSON object a line: time, level, event, sentence; nothing that lets somebody in. */
export const jsonLog = (write: (line: string) => void, now_ms: () => number): Log => ({
  say(level, event, sentence, more = {}) {
    const cleaned = Object.entries(more).map(([key, value]) => [
      key,
      typeof value === "string" ? withoutSecrets(value) : value,
    ]);
    write(
      `${JSON.stringify({
        time: new Date(now_ms()).toISOString(),
        level,
        event,
        sentence: withoutSecrets(sentence),
        ...(Object.fromEntries(cleaned) as object),
      })}\n`,
    );
  },
});
/** Sentences as they are, for a person at a terminal. */
export const textLog = (write: (line: string) => void): Log => ({
  say(level, _event, sentence) {
    if (level !== "info") write(`${sentence}\n`);
  },
});
