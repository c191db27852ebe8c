/** Who takes a switched input: the controller of the cell, once it is there. */
let take: ((signal: string, value: boolean | number) => void) | null = null;
export const setInput = (signal: string, value: boolean | number): void => take?.(signal, value);
export function onInput(listen: (signal: string, value: boolean | number) => void): void {
  take = listen;
}
