import { readFileSync } from "node:fs";
import { PlainFault } from "@twincell/core";
import { causeOf } from "../standard.ts";

export const HOOK_EVENTS = ["opened", "closed", "link", "safety", "refused", "stopped", "done", "notice"] as const;
export type HookEvent = (typeof HOOK_EVENTS)[number];
export interface Hook {
  readonly url: string;
  /** Left out: all of them. */
  readonly events?: readonly HookEvent[];
  /** Of one robot alone. */
  readonly robot?: string;
  /** Every request carries an HMAC of its body made with it. */
  readonly secret?: string;
}
const KEYS: readonly (keyof Hook)[] = ["url", "events", "robot", "secret"];

/** @throws {PlainFault} with the place of what is wrong. */
export function readHooks(path: string): readonly Hook[] {
  const fault = (sentence: string): PlainFault =>
    new PlainFault("webhooks.file", `${path}: ${sentence}`, "docs/plant.md says how a file of webhooks is written.");
  let value: unknown;
  try {
    value = JSON.parse(readFileSync(path, "utf8"));
  } catch (problem) {
    throw fault(`${causeOf(problem)}.`);
  }
  const { format, version, hooks } = (value ?? {}) as Readonly<Record<string, unknown>>;
  if (format !== "twincell.webhooks" || version !== 1 || !Array.isArray(hooks))
    throw fault("it is no file of webhooks of version 1.");
  return hooks.map((hook: unknown, i) => {
    const place = `hooks[${i}]`;
    if (typeof hook !== "object" || hook === null) throw fault(`${place} is no webhook.`);
    const { url, events, robot, secret } = hook as Readonly<Record<string, unknown>>;
    const strange = Object.keys(hook).find(key => !(KEYS as readonly string[]).includes(key));
    if (strange !== undefined) throw fault(`${place} has a key “${strange}” that nothing reads.`);
    if (typeof url !== "string" || !/^https?:$/.test(URL.parse(url)?.protocol ?? ""))
      throw fault(`${place}.url is no http or https address.`);
    const names: readonly string[] = HOOK_EVENTS;
    if (events !== undefined && !(Array.isArray(events) && events.every(each => names.includes(String(each)))))
      throw fault(`${place}.events wants some of ${names.join(", ")}.`);
    if (robot !== undefined && typeof robot !== "string") throw fault(`${place}.robot is the id of a robot.`);
    if (secret !== undefined && (typeof secret !== "string" || secret.length < 16))
      throw fault(`${place}.secret has at least 16 characters.`);
    return hook as Hook;
  });
}
