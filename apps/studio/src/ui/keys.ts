import { words } from "../messages/index.ts";

const onMac = typeof navigator !== "undefined" && /mac|iphone|ipad/i.test(navigator.userAgent);
const WRITTEN: Readonly<Record<string, string>> = {
  ...words.keys,
  Mod: onMac ? "⌘" : words.keys.Control,
  Shift: onMac ? "⇧" : words.keys.Shift,
  Alt: onMac ? "⌥" : words.keys.Alt,
  ArrowLeft: "←",
  ArrowRight: "→",
  ArrowUp: "↑",
  ArrowDown: "↓",
  "?": "?",
};

/** "Mod+Shift+Z" as this keyboard writes it. */
export const showKeys = (keys: string): string =>
  keys
    .split("+")
    .map(key => WRITTEN[key] ?? key)
    .join(onMac ? "" : " ");

/** Whether the key event is that combination. Letters by what is printed on the key, so any layout works. */
export function isKeys(event: KeyboardEvent, keys: string): boolean {
  const parts = keys.split("+");
  const key = parts.at(-1)!;
  const wants = (name: string): boolean => parts.includes(name);
  if (wants("Mod") !== (onMac ? event.metaKey : event.ctrlKey) || wants("Alt") !== event.altKey) return false;
  if (onMac ? event.ctrlKey : event.metaKey) return false;
  if (key !== "?" && wants("Shift") !== event.shiftKey) return false;
  return key === "Space" ? event.code === "Space" : event.key.toLowerCase() === key.toLowerCase();
}

/** Typing belongs to the field that has the focus. */
export const isTyping = (target: EventTarget | null): boolean =>
  target instanceof HTMLElement &&
  (target.isContentEditable ||
    target instanceof HTMLTextAreaElement ||
    target instanceof HTMLSelectElement ||
    (target instanceof HTMLInputElement && !["checkbox", "radio", "range", "button"].includes(target.type)));
