import type { VirtualController } from "../../virtual/index.ts";

/**
 * The mode key: slow and fast by hand with the enabling switch, automatic by the pendant, automatic by a remote
 * control.
 */
export type KukaMode = "T1" | "T2" | "AUT" | "EX";
export interface Message {
  readonly text: string /** The robot stopped for it; it stays until its cause is gone and a person has confirmed it. */;
  readonly stops: boolean;
}
/** In T1 no point of the flange moves faster than this. */
export const T1_MPS = 0.25;
const MOST_MESSAGES = 100;

/**
 * Mode key, enabling switch, drives, emergency stop, operator safety and messages of a KUKA controller, in front of an
 * arm that moves. STOP 0 takes the drives off at once, STOP 1 brakes first, STOP 2 brakes and leaves them on.
 */
export class Machine {
  private readonly arm: VirtualController;
  private readonly changed: (stopped: string) => void;
  private key: KukaMode;
  private drives = false;
  /** Drives go off as soon as the arm stands. */
  private offAtRest = false;
  private held = false;
  private percent = 100;
  private share = 1;
  enabling = false;
  emergency = false;
  safetyClosed = true;
  readonly messages: Message[] = [];

  /** @param changed  called when a motion was ended by the machine itself, with the reason. */
  constructor(arm: VirtualController, mode: KukaMode, changed: (stopped: string) => void) {
    this.arm = arm;
    this.key = mode;
    this.changed = changed;
  }

  get mode(): KukaMode {
    return this.key;
  }
  get isManual(): boolean {
    return this.key === "T1" || this.key === "T2";
  }
  get drivesOn(): boolean {
    return this.drives;
  }
  /** $PERI_RDY: drives under power and nothing that keeps them from it. */
  get ready(): boolean {
    return this.drives && !this.offAtRest && !this.emergency;
  }
  /** $STOPMESS */
  get stopMessage(): boolean {
    return this.messages.some(({ stops }) => stops);
  }
  /** $USER_SAF: in T1 and T2 the enabling switch stands for it. */
  get userSafe(): boolean {
    return this.isManual ? this.enabling : this.safetyClosed;
  }
  get override(): number {
    return this.percent;
  }
  /** Whether the program is held on its path. */
  get isHeld(): boolean {
    return this.held;
  }

  /** Why nothing may move, or null. */
  get hindrance(): string | null {
    if (this.emergency) return "The emergency stop is pressed.";
    if (this.isManual && !this.enabling) return "The enabling switch is not pressed.";
    if (!this.isManual && !this.safetyClosed) return "The operator safety is open.";
    if (this.stopMessage) return `A message is not confirmed: ${this.messages.find(({ stops }) => stops)!.text}`;
    return this.ready ? null : "The drives are not ready.";
  }

  say(text: string, stops = false): void {
    if (this.messages.some(message => message.text === text && message.stops === stops)) return;
    if (this.messages.length >= MOST_MESSAGES) this.messages.shift();
    this.messages.push({ text, stops });
  }

  setOverride(percent: number): boolean {
    if (!(percent >= 0 && percent <= 100)) return false;
    this.percent = percent;
    this.pace();
    return true;
  }
  /** A reduced speed that comes on top of the override: the run to the path. */
  setShare(share: number): void {
    this.share = share;
    this.pace();
  }
  hold(on: boolean): void {
    this.held = on;
    this.pace();
  }
  private pace(): void {
    this.arm.setSpeed(this.held ? 0 : this.percent * this.share);
  }

  /** STOP 0, 1 or 2. `text` becomes a message to be confirmed unless it is "". */
  stop(kind: 0 | 1 | 2, text: string): void {
    if (text !== "") this.say(text, true);
    this.arm.stop(kind !== 2);
    if (kind === 0) this.drives = false;
    if (kind === 1) this.offAtRest = true;
    this.changed(text);
  }

  setMode(mode: KukaMode): void {
    if (mode === this.key) return;
    this.stop(1, "");
    this.key = mode;
    this.say(`The mode is ${mode}.`);
  }
  setEnabling(pressed: boolean): void {
    if (pressed === this.enabling) return;
    this.enabling = pressed;
    if (!this.isManual) return;
    if (!pressed) this.stop(0, "");
    else this.setDrives(true);
  }
  setEmergency(pressed: boolean): void {
    this.emergency = pressed;
    if (pressed) this.stop(1, "Emergency stop");
  }
  /** The gate, or a sensor that stands for it. Closing it moves nothing: the message waits for a person. */
  setSafety(closed: boolean): void {
    if (closed === this.safetyClosed) return;
    this.safetyClosed = closed;
    if (!closed && !this.isManual) this.stop(2, "Operator safety open");
  }
  /** Why not, or null. */
  setDrives(on: boolean): string | null {
    if (!on) {
      if (this.drives) this.stop(1, "");
      return null;
    }
    if (this.emergency) return "The emergency stop is pressed.";
    if (this.isManual && !this.enabling) return "The enabling switch is not pressed.";
    if (this.arm.isMoving()) return "The robot has not come to rest.";
    this.offAtRest = false;
    this.drives = this.arm.atTheRobot.reset().kind === "done";
    return this.drives ? null : "The drives do not come on.";
  }
  /** Takes away every message whose cause is gone. */
  confirm(): void {
    const left = this.messages.filter(
      ({ text }) =>
        (text === "Emergency stop" && this.emergency) || (text === "Operator safety open" && !this.safetyClosed),
    );
    this.messages.splice(0, this.messages.length, ...left);
  }

  /** Once a cycle. */
  cycle(): void {
    if (this.offAtRest && !this.arm.isMoving()) {
      this.offAtRest = false;
      this.drives = false;
    }
  }
}
