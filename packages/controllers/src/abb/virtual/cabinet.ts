import { EVENT, type CtrlState, type OpMode } from "../codec/index.ts";

export interface LoggedEvent {
  readonly number: number;
  readonly code: number /** 1 information, 2 warning, 3 error. */;
  readonly kind: 1 | 2 | 3;
  readonly at_s: number;
  readonly title: string;
  readonly text: string;
}
export type Key = Extract<OpMode, "AUTO" | "MANR" | "MANF">;

const MOST_EVENTS = 200;

/**
 * Key, motors, stops, speed and the log of a controller. What takes the robot from its program is told to who runs it.
 */
export class VirtualPendant {
  private readonly now_s: () => number;
  private readonly stopped: (because: string) => void;
  private isKey: Key = "AUTO";
  private on = true;
  private pressed = false;
  /** Turned out again, motors not yet on. */
  private released = false;
  private isOpen = false;
  private percent = 100;
  private count = 0;
  readonly events: LoggedEvent[] = [];
  /** Told when it changes. */
  speedChanged: (percent: number) => void = () => {
    /* Nobody asked yet. */
  };

  constructor(now_s: () => number, stopped: (because: string) => void) {
    this.now_s = now_s;
    this.stopped = stopped;
  }

  get key(): Key {
    return this.isKey;
  }
  /** By hand the enabling device has them on. */
  get motorsOn(): boolean {
    return this.on || (this.isKey !== "AUTO" && !this.pressed);
  }
  get speedRatio(): number {
    return this.percent;
  }
  get state(): CtrlState {
    if (this.pressed) return "emergencystop";
    if (this.isOpen && this.isKey === "AUTO") return "guardstop";
    return this.motorsOn ? "motoron" : this.released ? "emergencystopreset" : "motoroff";
  }

  log(code: number, kind: LoggedEvent["kind"], title: string, text: string): void {
    this.events.unshift({ number: ++this.count, code, kind, at_s: this.now_s(), title, text });
    if (this.events.length > MOST_EVENTS) this.events.pop();
  }

  /** The motors go off at once; the robot brakes. */
  motorsOff(because: string): void {
    if (!this.on) return;
    this.on = false;
    this.log(EVENT.motorsOff, 1, "Motors OFF state", because);
    this.stopped(because);
  }
  /** Why they stay off, or null. */
  switchOn(): string | null {
    if (this.pressed) return "The emergency stop is pressed.";
    if (this.state === "guardstop") return "The guard is open.";
    if (this.isKey !== "AUTO") return "In manual mode the enabling device switches the motors on.";
    if (!this.on) this.log(EVENT.motorsOn, 1, "Motors ON state", "The motors were switched on.");
    this.on = true;
    this.released = false;
    return null;
  }
  emergencyStop(pressed: boolean): void {
    if (pressed === this.pressed) return;
    this.pressed = pressed;
    if (!pressed) {
      this.released = true;
      return;
    }
    this.log(EVENT.emergencyStop, 3, "Emergency stop state", "The emergency stop was pressed.");
    this.motorsOff("The emergency stop was pressed.");
  }
  setGuardOpen(open: boolean): void {
    if (open === this.isOpen) return;
    this.isOpen = open;
    if (!open || this.isKey !== "AUTO") return;
    this.log(EVENT.guardStop, 2, "Guard stop state", "The guard was opened.");
    this.motorsOff("The guard was opened.");
  }
  setKey(key: Key): void {
    if (key === this.isKey) return;
    this.isKey = key;
    this.log(
      key === "AUTO" ? EVENT.automatic : EVENT.manual,
      1,
      key === "AUTO" ? "Automatic mode confirmed" : "Manual mode selected",
      `The key was turned to ${key}.`,
    );
    this.motorsOff(key === "AUTO" ? "The key was turned to automatic." : "The key was turned to manual.");
  }
  setSpeedRatio(percent: number): boolean {
    if (!(percent >= 0 && percent <= 100)) return false;
    this.percent = percent;
    this.speedChanged(percent);
    return true;
  }
  /** Switched off and on again. */
  boot(): void {
    this.motorsOff("The controller was switched off.");
    this.released = false;
    this.setSpeedRatio(100);
  }
}
