/** A line longer than this is no state and no answer of a plug-in [bytes]. */
const LONGEST_LINE = 1 << 20;

/**
 * Cuts bytes into lines of UTF-8, wherever the chunks begin and end. Empty lines are left out.
 *
 * @param broken  told once, with a sentence, when bytes are no text or a line does not end; nothing is read after it.
 */
export function lines(line: (text: string) => void, broken: (sentence: string) => void): (lent: Uint8Array) => void {
  const decoder = new TextDecoder("utf-8", { fatal: true });
  let rest = "";
  let over = false;
  return lent => {
    if (over) return;
    try {
      rest += decoder.decode(lent, { stream: true });
    } catch {
      over = true;
      broken("What came is no text in UTF-8.");
      return;
    }
    const parts = rest.split("\n");
    rest = parts.pop()!;
    for (const text of parts) if (text.trim() !== "") line(text);
    if (rest.length <= LONGEST_LINE) return;
    over = true;
    broken(`A line of more than ${LONGEST_LINE} characters does not end.`);
  };
}
