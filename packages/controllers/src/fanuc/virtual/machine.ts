import type { VirtualController } from "../../virtual/index.ts";

/** AUTO, or T1 (250 mm/s) and T2 by hand. */
export type FanucKey = "AUTO" | "T1" | "T2";
/** How far a pendant's own moves may be from the flange's greatest speed in T1. */
export const T1_MPS = 0.25;

/** Key, pendant switch, servos, fence and faults of a FANUC controller, in front of an arm that moves. */
export class FanucMachine {
  private readonly arm: VirtualController;
  private readonly changed: (fault: string) => void;
  private percent = 100;
  private held = false;
  private isKey: FanucKey = "AUTO";
  /** Of the servos. */
  on = true;
  emergency = false;
  fenceOpen = false;
  pendant = false;
  faults: string[] = [];

  /** @param changed  called when something took the robot from its client. */
  constructor(arm: VirtualController, changed: (fault: string) => void) {
    this.arm = arm;
    this.changed = changed;
  }
  get key(): FanucKey {
    return this.isKey;
  }
  get ready(): boolean {
    return this.on && this.faults.length === 0;
  }
  get override(): number {
    return this.percent;
  }
  get isHeld(): boolean {
    return this.held;
  }

  setOverride(percent: number): boolean {
    if (!Number.isInteger(percent) || percent < 1 || percent > 100) return false;
    this.percent = percent;
    this.pace();
    return true;
  }
  hold(on: boolean): void {
    this.held = on;
    this.pace();
  }
  private pace(): void {
    this.arm.setSpeed(this.held ? 0 : this.percent);
  }

  /** The servos go off; the fault stays until it is reset. */
  fault(text: string): void {
    this.faults.push(text);
    this.on = false;
    this.arm.stop(true);
    this.changed(text);
  }
  setEmergency(pressed: boolean): void {
    this.emergency = pressed;
    if (pressed) this.fault("SRVO-001 Operator panel E-stop");
  }
  setFence(open: boolean): void {
    this.fenceOpen = open;
    if (open && !this.pendant) this.fault("SRVO-004 Fence open");
  }
  /** The switch of the pendant and the key are one hand's. */
  setKey(key: FanucKey): void {
    if (key === this.isKey) return;
    this.isKey = key;
    this.pendant = key !== "AUTO";
    this.arm.stop();
    this.hold(false);
    this.changed("The mode was switched");
  }
  /** Why it stays as it is, or null. */
  reset(): string | null {
    if (this.emergency) return "The emergency stop is pressed.";
    if (this.fenceOpen && !this.pendant) return "The fence is open.";
    if (this.arm.isMoving()) return "The robot has not come to rest.";
    if (this.arm.atTheRobot.reset().kind !== "done") return "The servos do not come on.";
    this.faults = [];
    this.on = true;
    return null;
  }
}
