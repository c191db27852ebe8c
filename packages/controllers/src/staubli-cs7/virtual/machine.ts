import type { VirtualController } from "../../virtual/index.ts";
import { STATE } from "../codec/monitor.ts";

/** High power, its button, calibration, pendant and emergency stop of a CS7, in front of an arm that moves. */
export class Machine {
  private readonly arm: VirtualController;
  private power = true;
  private isManual = false;
  private emergency = false;
  private guardOpen = false;
  private percent = 100;
  /** High power was asked for: the button blinks. */
  blinking = false;
  calibrated = true;

  constructor(arm: VirtualController) {
    this.arm = arm;
  }

  get isPowered(): boolean {
    return this.power;
  }
  get manual(): boolean {
    return this.isManual;
  }
  get speed(): number {
    return this.percent;
  }
  get isPressed(): boolean {
    return this.emergency;
  }
  get isGuardOpen(): boolean {
    return this.guardOpen && !this.isManual;
  }
  get state(): number {
    if (!this.power) return STATE.powerOff;
    if (!this.calibrated) return STATE.notCalibrated;
    return this.isManual ? STATE.manual : STATE.program;
  }
  /** Why no program may move the robot, as the monitor says it; null when one may. */
  get hindrance(): string | null {
    if (!this.power) return "*Robot power off*";
    if (!this.calibrated) return "*Robot not calibrated*";
    return this.isManual ? "*COMP mode disabled*" : null;
  }
  off(): void {
    this.blinking = false;
    if (!this.power) return;
    this.power = false;
    this.arm.stop(true);
  }
  setManual(on: boolean): void {
    if (on === this.isManual) return;
    this.isManual = on;
    this.arm.stop();
  }
  setEmergency(pressed: boolean): void {
    this.emergency = pressed;
    if (pressed) this.off();
  }
  setGuard(open: boolean): void {
    this.guardOpen = open;
    if (open && !this.isManual) this.off();
  }
  /** ENABLE POWER; what stands in the way, or null. */
  ask(): string | null {
    if (this.power) return null;
    if (this.emergency || (this.guardOpen && !this.isManual)) return "*E-STOP circuit is open*";
    this.blinking = true;
    return null;
  }
  /** A hand on the blinking button. */
  press(): void {
    if (!this.blinking || this.arm.isMoving() || this.arm.atTheRobot.reset().kind !== "done") return;
    this.blinking = false;
    this.power = true;
  }
  setSpeed(percent: number): boolean {
    if (!(percent > 0 && percent <= 100)) return false;
    this.percent = percent;
    this.arm.setSpeed(percent);
    return true;
  }
}
