/** What stands on the keys of the keypad. */
export const KEYPAD = ["7", "8", "9", "4", "5", "6", "1", "2", "3", "±", "0", "."] as const;
export type KeypadKey = (typeof KEYPAD)[number] | "⌫" | "C";
/** No number of a cell needs more digits than this. */
const MOST_DIGITS = 7;

/** What is typed so far: "" is nothing, "-" a sign without a digit. */
export function typed(text: string, key: KeypadKey): string {
  if (key === "C") return "";
  if (key === "⌫") return text.slice(0, -1);
  if (key === "±") return text.startsWith("-") ? text.slice(1) : `-${text}`;
  if (key === ".") return text.includes(".") ? text : /\d/.test(text) ? `${text}.` : `${text}0.`;
  if (text.replace(/\D/g, "").length >= MOST_DIGITS) return text;
  // A leading zero is replaced, so that 0 and then 5 is 5.
  return text === "0" || text === "-0" ? text.slice(0, -1) + key : text + key;
}

export type Entered =
  | { readonly kind: "number"; readonly value: number }
  | { readonly kind: "nothing" }
  | { readonly kind: "outside"; readonly least: number; readonly most: number };

/** The number that was typed, if it is one and lies in the range. */
export function entered(text: string, least: number, most: number): Entered {
  if (!/\d/.test(text)) return { kind: "nothing" };
  const value = Number(text);
  if (!Number.isFinite(value)) return { kind: "nothing" };
  return value < least || value > most ? { kind: "outside", least, most } : { kind: "number", value };
}
