/** Who moves the robot on screen. One at a time: whoever takes it ends what the one before was doing. */
export type Mover = "jog" | "glide" | "drag" | "play" | "physics" | "run" | "history";
let owner: Mover | null = null;
let lost: (() => void) | null = null;

export const moverNow = (): Mover | null => owner;
/** @param onLost  called once when somebody else takes the robot. */
export function takeRobot(mover: Mover, onLost: () => void = () => undefined): void {
  if (owner === mover) {
    lost = onLost;
    return;
  }
  const tell = lost;
  owner = mover;
  lost = onLost;
  tell?.();
}
export function leaveRobot(mover: Mover): void {
  if (owner === mover) {
    owner = null;
    lost = null;
  }
}
