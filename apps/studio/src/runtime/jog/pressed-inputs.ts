/** Who may hold a jog command down. */
export type JogSource = "pendant" | "keyboard" | "gamepad" | "headset" | "phone";

/** Six of the tool tip, or the joints of an arm with seven. */
export const MAX_COORDINATES = 7;
const AXES = MAX_COORDINATES;
const held = new Map<JogSource, Float64Array>();
const listeners = new Set<(any: boolean) => void>();
let wasHeld = false;

export const isAnyHeld = (): boolean => {
  for (const command of held.values()) for (let i = 0; i < AXES; i++) if (command[i] !== 0) return true;
  return false;
};
function tell(): void {
  const now = isAnyHeld();
  if (now === wasHeld) return;
  wasHeld = now;
  for (const listen of listeners) listen(now);
}

/**
 * Holds one coordinate down until released. @param axis 0 … 6: joint, or 0 … 5: x y z and the turns about them.
 * @param amount −1 … 1 of the chosen speed; anything that is not a number counts as released.
 */
export function hold(source: JogSource, axis: number, amount: number): void {
  let command = held.get(source);
  if (!command) held.set(source, (command = new Float64Array(AXES)));
  command[axis] = Number.isFinite(amount) ? Math.min(1, Math.max(-1, amount)) : 0;
  tell();
}
export function release(source: JogSource, axis?: number): void {
  const command = held.get(source);
  if (!command) return;
  if (axis === undefined) command.fill(0);
  else command[axis] = 0;
  tell();
}
/** Focus lost, tab hidden, touch cancelled, gamepad gone, STOP. */
export function releaseAll(): void {
  for (const command of held.values()) command.fill(0);
  tell();
}
/** Sum of everything held, each coordinate −1 … 1. Returns whether any is not 0. */
export function heldNow(out: Float64Array): boolean {
  out.fill(0);
  for (const command of held.values()) for (let i = 0; i < AXES; i++) out[i] = out[i]! + command[i]!;
  let any = false;
  for (let i = 0; i < AXES; i++) {
    out[i] = Math.min(1, Math.max(-1, out[i]!));
    if (out[i] !== 0) any = true;
  }
  return any;
}
export function onHeld(listen: (any: boolean) => void): () => void {
  listeners.add(listen);
  return () => listeners.delete(listen);
}
