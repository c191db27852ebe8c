import { jointsOfAxes, type AxisCounting, type OperatingMode, type Robot, type SafetyState } from "@twincell/core";
import { readJoints, type RwsState } from "../codec/index.ts";
import { abbAxes } from "../codec/axes.ts";

/** What a controller said of itself over Robot Web Services, resource by resource. */
export class PanelState {
  ctrl = "";
  opmode = "";
  execution = "";
  speedRatio = 100;
  readonly lines = new Map<string, boolean | number>();
  /** Where each line is written: `network/unit/name`, or its name alone. */
  readonly places = new Map<string, string>();
  readonly q_rad: Float64Array;
  private readonly joints_deg: Float64Array;

  private readonly counting: AxisCounting;

  constructor(robot: Robot) {
    const joints = robot.arm.joints.length;
    this.counting = abbAxes(robot);
    this.q_rad = new Float64Array(joints);
    this.joints_deg = new Float64Array(joints);
  }

  get mode(): OperatingMode {
    return this.opmode === "AUTO" ? "automatic" : "manual";
  }
  get isRunning(): boolean {
    return this.execution === "running";
  }
  get safety(): SafetyState {
    switch (this.ctrl) {
      case "motoron":
        return "normal";
      case "guardstop":
        return "guard-stop";
      case "sysfail":
        return "protective-stop";
      // By hand the enabling device has the motors.
      case "motoroff":
        return this.mode === "manual" ? "normal" : "emergency-stop";
      default:
        return "emergency-stop";
    }
  }
  get words(): string {
    return this.ctrl === "motoroff" && this.mode === "manual"
      ? ""
      : (WORDS[this.ctrl] ?? `The controller is in the state "${this.ctrl}".`);
  }

  /** Whether what came could be read. */
  takePanel(name: "ctrlstate" | "opmode" | "speedratio" | "ctrlexecstate", [state]: readonly RwsState[]): boolean {
    const value = state?.fields[name];
    if (value === undefined) return false;
    if (name === "ctrlstate") this.ctrl = value;
    else if (name === "opmode") this.opmode = value;
    else if (name === "ctrlexecstate") this.execution = value;
    else if (Number.isFinite(Number(value))) this.speedRatio = Number(value);
    return true;
  }
  /** Null when they are no angles; otherwise how many the robot has. */
  takeJoints([state]: readonly RwsState[]): number | null {
    const count = state ? readJoints(state.fields, this.joints_deg) : 0;
    if (count === 0) return null;
    if (count === this.q_rad.length) jointsOfAxes(this.counting, this.joints_deg, this.q_rad);
    return count;
  }
  takeLines(states: readonly RwsState[]): void {
    for (const { title, fields } of states) {
      const name = fields["name"] ?? title.split("/").at(-1)!;
      const value = Number(fields["lvalue"]);
      if (name === "" || !Number.isFinite(value) || (this.lines.size >= MOST_LINES && !this.lines.has(name))) continue;
      this.places.set(name, title === "" ? name : title);
      this.lines.set(name, /^D/i.test(fields["type"] ?? "") ? value !== 0 : value);
    }
  }
}
const MOST_LINES = 4_000;
const WORDS: Readonly<Record<string, string>> = {
  motoron: "",
  motoroff: "Its motors are off.",
  guardstop: "Its guard is open.",
  emergencystop: "Its emergency stop is pressed.",
  emergencystopreset: "Its emergency stop was turned out again; the motors are off.",
  sysfail: "The controller has failed: look at its log.",
  init: "The controller is starting.",
};
