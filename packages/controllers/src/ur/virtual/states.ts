import { EMERGENCY_STOPS, ROBOT_MODE, SAFEGUARD_STOPS, SAFETY_MODE, UNLOCK_AFTER_S } from "../codec/modes.ts";

export interface StatesOptions {
  /** How long the drives take to come on, and the brakes to open [s]. */
  readonly powerOn_s: number;
  readonly brakes_s: number;
  /** The arm must come to rest: programs end, or only hold where they go on by themselves. */
  readonly onStop: (how: "end" | "hold", because: string) => void;
  /** Whether the reason to hold is gone. */
  readonly onResume: () => void;
  readonly onSafety: (mode: number) => void;
}

/**
 * Power, brakes and safety of the controller: POWER_OFF → POWER_ON → IDLE → RUNNING, and the stops beside it. A
 * protective stop keeps the power and is unlocked by a person after five seconds; a safeguard stop ends with its cause;
 * an emergency stop takes the power; a fault wants the safety system restarted.
 */
export class States {
  private readonly options: StatesOptions;
  private mode: number = ROBOT_MODE.POWER_OFF;
  private safety: number = SAFETY_MODE.NORMAL;
  private due_s = Infinity;
  /** Where powering on leads. */
  private goal: number = ROBOT_MODE.IDLE;
  private stoppedAt_s = -Infinity;
  /** Why the robot stopped, for whoever asks. */
  message = "";

  constructor(options: StatesOptions) {
    this.options = options;
  }

  get robotMode(): number {
    return this.mode;
  }
  get safetyMode(): number {
    return this.safety;
  }
  get isRunning(): boolean {
    return this.mode === ROBOT_MODE.RUNNING;
  }
  get mayMove(): boolean {
    return this.isRunning && (this.safety === SAFETY_MODE.NORMAL || this.safety === SAFETY_MODE.REDUCED);
  }
  /** Drives that are off stay off while the safety system wants it. */
  private get mayPower(): boolean {
    return (
      !EMERGENCY_STOPS.has(this.safety) && this.safety !== SAFETY_MODE.FAULT && this.safety !== SAFETY_MODE.VIOLATION
    );
  }

  private become(safety: number, message: string): void {
    this.safety = safety;
    this.message = message;
    this.options.onSafety(safety);
  }

  /** Straight to a state, when the controller begins. */
  begin(mode: number): void {
    this.mode = mode;
    this.due_s = Infinity;
    this.become(SAFETY_MODE.NORMAL, "");
  }

  powerOn(now_s: number, goal: number = ROBOT_MODE.IDLE): boolean {
    if (!this.mayPower) return false;
    this.goal = Math.max(this.goal, goal);
    if (this.mode === ROBOT_MODE.POWER_OFF) {
      this.mode = ROBOT_MODE.POWER_ON;
      this.goal = goal;
      this.due_s = now_s + this.options.powerOn_s;
    } else if (this.mode === ROBOT_MODE.IDLE && goal === ROBOT_MODE.RUNNING) this.due_s = now_s + this.options.brakes_s;
    return true;
  }
  releaseBrakes(now_s: number): boolean {
    return this.powerOn(now_s, ROBOT_MODE.RUNNING);
  }
  powerOff(): void {
    if (this.mode === ROBOT_MODE.POWER_OFF) return;
    this.mode = ROBOT_MODE.POWER_OFF;
    this.due_s = Infinity;
    this.options.onStop("end", "The robot was powered off.");
  }

  /** What takes time goes on. */
  cycle(now_s: number): void {
    if (now_s < this.due_s) return;
    this.due_s = Infinity;
    if (this.mode === ROBOT_MODE.POWER_ON) {
      this.mode = ROBOT_MODE.IDLE;
      if (this.goal === ROBOT_MODE.RUNNING) this.due_s = now_s + this.options.brakes_s;
    } else if (this.mode === ROBOT_MODE.IDLE) this.mode = ROBOT_MODE.RUNNING;
  }

  protectiveStop(because: string, now_s: number): void {
    if (!this.mayMove && !SAFEGUARD_STOPS.has(this.safety)) return;
    this.stoppedAt_s = now_s;
    this.become(SAFETY_MODE.PROTECTIVE_STOP, because);
    this.options.onStop("end", because);
  }
  /** Refused before five seconds have passed. */
  unlock(now_s: number): "unlocked" | "too-soon" | "nothing" {
    if (this.safety !== SAFETY_MODE.PROTECTIVE_STOP) return "nothing";
    if (now_s - this.stoppedAt_s < UNLOCK_AFTER_S) return "too-soon";
    this.become(SAFETY_MODE.NORMAL, "");
    return "unlocked";
  }

  /** A gate or somebody near the robot. What was under way goes on when the cause is gone. */
  safeguard(isOpen: boolean): void {
    if (isOpen && (this.safety === SAFETY_MODE.NORMAL || this.safety === SAFETY_MODE.REDUCED)) {
      this.become(SAFETY_MODE.SAFEGUARD_STOP, "The safeguard is open.");
      this.options.onStop("hold", "The safeguard is open.");
    }
    if (!isOpen && this.safety === SAFETY_MODE.SAFEGUARD_STOP) {
      this.become(SAFETY_MODE.NORMAL, "");
      this.options.onResume();
    }
  }

  emergencyStop(isPressed: boolean): void {
    if (isPressed && !EMERGENCY_STOPS.has(this.safety)) {
      this.become(SAFETY_MODE.ROBOT_EMERGENCY_STOP, "The emergency stop is pressed.");
      this.mode = ROBOT_MODE.POWER_OFF;
      this.due_s = Infinity;
      this.options.onStop("end", "The emergency stop is pressed.");
    }
    if (!isPressed && EMERGENCY_STOPS.has(this.safety)) this.become(SAFETY_MODE.NORMAL, "");
  }

  fault(because: string): void {
    this.become(SAFETY_MODE.FAULT, because);
    this.mode = ROBOT_MODE.POWER_OFF;
    this.due_s = Infinity;
    this.options.onStop("end", because);
  }
  restartSafety(): void {
    this.powerOff();
    this.become(SAFETY_MODE.NORMAL, "");
  }
}
