/** Who moves the robot on screen. One at a time: whoever takes it ends what the one before was doing. */
export type Mover = "jog" | "glide" | "drag" | "play" | "physics" | "run" | "history";
let owner: Mover | null = null;
let lost: (() => void) | null = null;

let warn: (mover: Mover) => void = () => undefined;
/** Told before anybody takes the robot on screen. */
export function beforeTaking(tell: (mover: Mover) => void): void {
  warn = tell;
}

export const moverNow = (): Mover | null => owner;
/** @param onLost  called once when somebody else takes the robot. */
export function takeRobot(mover: Mover, onLost: () => void = () => undefined): void {
  warn(mover);
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
