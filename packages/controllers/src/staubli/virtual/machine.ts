import type { VirtualController } from "../../virtual/index.ts";

/** Manual with the enabling switch, automatic from the pendant, automatic from outside. */
export type StaubliMode = "manual" | "local" | "remote";
/** In manual mode no point of the flange moves faster than this. */
export const MANUAL_MPS = 0.25;
/** What `workingMode()` of VAL 3 says. */
const WORKING: Readonly<Record<StaubliMode, number>> = { manual: 1, local: 3, remote: 4 };
export const ES = { ok: 0, waiting: 1, stop: 2 } as const;

/**
 * Working mode, emergency-stop chain, arm power and Move/Hold of a CS8 or CS9, in front of an arm that moves. Power
 * goes off with every change of mode and every opening of the chain, and comes back by a hand, once the chain is closed
 * and acknowledged.
 */
export class Machine {
  private readonly arm: VirtualController;
  private isMode: StaubliMode;
  private power = false;
  private acknowledged = true;
  private emergency = false;
  private doorOpen = false;
  private enabling = false;
  private held = false;
  private percent = 100;
  /** Of the error the arm switched itself off for; "" without one. */
  error = "";

  constructor(arm: VirtualController, mode: StaubliMode) {
    this.arm = arm;
    this.isMode = mode;
  }

  get mode(): StaubliMode {
    return this.isMode;
  }
  get workingMode(): number {
    return WORKING[this.isMode];
  }
  get isPowered(): boolean {
    return this.power;
  }
  /** `esStatus()`: the door counts in automatic modes, where the enabling switch does not stand for it. */
  get esStatus(): number {
    if (this.emergency || (this.doorOpen && this.isMode !== "manual")) return ES.stop;
    return this.acknowledged ? ES.ok : ES.waiting;
  }
  /** Whether motions of the stack are carried out. */
  get moves(): boolean {
    return this.power && !this.held && (this.isMode !== "manual" || this.enabling);
  }
  get isHeld(): boolean {
    return this.held;
  }
  get monitorSpeed(): number {
    return this.percent;
  }
  get isPressed(): boolean {
    return this.emergency;
  }
  get isDoorOpen(): boolean {
    return this.doorOpen && this.isMode !== "manual";
  }

  private off(): void {
    if (!this.power) return;
    this.power = false;
    this.arm.stop(true);
  }
  setMode(mode: StaubliMode): void {
    if (mode === this.isMode) return;
    this.off();
    this.isMode = mode;
    this.acknowledged = false;
  }
  setEmergency(pressed: boolean): void {
    this.emergency = pressed;
    if (pressed) {
      this.acknowledged = false;
      this.off();
    }
  }
  setDoor(open: boolean): void {
    this.doorOpen = open;
    if (open && this.isMode !== "manual") {
      this.acknowledged = false;
      this.off();
    }
  }
  setEnabling(pressed: boolean): void {
    this.enabling = pressed;
    if (this.isMode !== "manual") return;
    if (pressed) this.enablePower();
    else this.off();
  }
  /** The arm switches itself off: an amplifier, a brake, a position that ran away. */
  fail(because: string): void {
    this.error = because;
    this.off();
  }
  /** The button of the mode selector: the chain is closed and somebody has seen it. */
  acknowledge(): void {
    if (!this.emergency && !(this.doorOpen && this.isMode !== "manual")) this.acknowledged = true;
  }
  /** Why the arm has no power then, or null. */
  enablePower(): string | null {
    if (this.esStatus !== ES.ok)
      return this.esStatus === ES.stop
        ? "The emergency-stop chain is open."
        : "The emergency-stop chain is not acknowledged.";
    if (this.isMode === "manual" && !this.enabling) return "The enabling switch is not pressed.";
    if (this.arm.isMoving()) return "The robot has not come to rest.";
    if (this.arm.atTheRobot.reset().kind !== "done") return "The amplifiers do not come on.";
    this.error = "";
    this.power = true;
    return null;
  }
  disablePower(): void {
    this.off();
  }
  /** Move/Hold: held motions stay where they are and go on. */
  setHold(on: boolean): void {
    this.held = on;
    this.pace();
  }
  setMonitorSpeed(percent: number): boolean {
    if (!(percent >= 0 && percent <= 100)) return false;
    this.percent = percent;
    this.pace();
    return true;
  }
  private pace(): void {
    this.arm.setSpeed(this.held ? 0 : this.percent);
  }
}
