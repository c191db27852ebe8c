/**
 * What a person types while a handle is dragged: a number takes the place of the drag; with a plus before it, it counts
 * from the start.
 */
export interface TypedNumber {
  readonly value: number;
  readonly fromStart: boolean;
}

/** The text after one more key; null when the key is none of a number. */
export function typedOn(text: string, key: string): string | null {
  if (key === "Backspace") return text.slice(0, -1);
  if (/^\d$/.test(key)) return text + key;
  if ((key === "." || key === ",") && !text.includes(".")) return `${text}.`;
  if ((key === "-" || key === "+") && text === "") return key;
  return null;
}

export function readTyped(text: string): TypedNumber | null {
  const value = Number(text.replace("+", ""));
  return text.replace(/[+.-]/g, "") === "" || !Number.isFinite(value) ? null : { value, fromStart: text[0] === "+" };
}
