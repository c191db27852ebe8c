import {
  branchOf,
  compose,
  type Branch,
  type Condition,
  type MoveStep,
  type Pallet,
  type Pose,
  type Step,
  type Target,
  type VendorSection,
  wristAboveZero,
} from "@twincell/core";
import {
  BasicModules,
  UnsupportedStep,
  called,
  fixed,
  mmText,
  turnTexts,
  type Add,
  type Place,
  shownAxes,
  degreesText,
} from "../../emitter/index.ts";
import { GRIPPER, LINES } from "../robots.ts";
import { RESERVED } from "./reserved.ts";

const LONGEST_NAME = 32;
/** Tools and locals that the controller keeps. */
const MOST = 15;
/** The largest speed of a path [mm/s], and what SpeedS and Speed say at least. */
const FASTEST_MMPS = 2000;
const SLOWEST_MMPS = 0.1;
const LEAST_PERCENT = 1;
/** A pose in a pattern that is turned more than this is turned. */
const STRAIGHT = 1e-9;

/** The file: `main` and the functions that it calls. */
export class SpelProgram extends BasicModules {
  protected readonly sharesNumbers = false;
  private readonly section: VendorSection;

  constructor(place: Place, section: VendorSection) {
    super(
      place,
      { most: LONGEST_NAME, reserved: RESERVED, first: "n_", foldsCase: true },
      {
        language: "SPEL+",
        file: "main.prg",
        define: "#define",
        main: "main",
        open: name => `Function ${name}`,
        close: "Fend",
        endIf: "EndIf",
        forever: ["Do", "Loop"],
        whileTrue: ["Do While", "Loop"],
        global: (name, type) => `Global ${type === "num" ? "Real" : "Integer"} ${name}`,
        mm: mmText,
        most: { tools: MOST, frames: MOST, called: "locals" },
        lines: LINES,
        gripper: GRIPPER,
      },
    );
    this.section = section;
  }

  protected head(): readonly string[] {
    return [];
  }
  protected ending(): readonly string[] {
    return [];
  }
  protected declaration(names: readonly string[]): readonly string[] {
    return [`Real ${names.join(", ")}`];
  }
  protected patterns(): readonly string[] {
    return [...this.used.pallets].map((name, i) => `#define ${this.named("pallet", name)} P${i + 1}`);
  }

  protected beginning(): readonly string[] {
    const {
      place,
      used: { tools, frames },
    } = this;
    return [
      "Motor On",
      "Power High",
      "Accel 100, 100",
      ...[...tools].map(tool => `TLSet ${this.named("tool", tool)}, ${xyText(place.tool(tool))}`),
      ...[...frames].map(
        frame => `Local ${this.named("frame", frame)}, ${xyText(compose(place.baseFromWorld, place.frame(frame)))}`,
      ),
    ];
  }

  protected wait(s: number, add: Add): void {
    add(`Wait ${fixed(s, 6)}`);
  }
  protected grip(closed: boolean, add: Add): void {
    add(`${closed ? "On" : "Off"} ${GRIPPER.name}`);
  }
  protected set({ to, pulse_s }: Extract<Step, { type: "set" }>, line: string, add: Add): void {
    add(`${to === true ? "On" : "Off"} ${line}${pulse_s === undefined ? "" : `, ${fixed(pulse_s, 6)}`}`);
  }
  protected asked({ signal, is }: Extract<Condition, { readonly is: unknown }>, line: string): string {
    return `${this.place.program.signals[signal]?.kind === "digital-out" ? "Oport" : "Sw"}(${line}) = ${is ? "On" : "Off"}`;
  }
  protected waitFor(condition: string, _step: Step, add: Add): void {
    add(`Wait ${condition}`);
  }
  protected payload(): void {
    /* declared under cannot */
  }
  protected message(text: string, add: Add): void {
    add(`Print "${text}"`);
  }
  protected stop(add: Add): void {
    add("Quit All");
  }

  protected palletPlace(
    { pallet: name }: Extract<Step, { type: "pallet" }>,
    pallet: Pallet,
    coordinates: readonly string[],
    turn: Pose["quaternion"],
    add: Add,
  ): void {
    add(
      `${this.named("pallet", name)} = XY(${coordinates.join(", ")}, ${[...turnTexts(turn)].reverse().join(", ")})${this.local(pallet.frame)}`,
    );
  }

  protected move(step: MoveStep, next: Step | undefined, add: Add): void {
    const { target, speed, path } = step;
    const isJoint = path === "ptp";
    const tool = target.tool ?? (isJoint && "q" in target ? undefined : "flange");
    const most_mps = this.place.robot.maxTcpSpeed_mps;
    if (tool !== undefined) this.say("tool", tool === "flange" ? "Tool 0" : `Tool ${this.named("tool", tool)}`, add);
    if ("time_s" in speed) return;
    const ratio = "mps" in speed ? speed.mps / most_mps : speed.ratio;
    const mmps = ("mps" in speed ? speed.mps : speed.ratio * most_mps) * 1000;
    if (isJoint) this.say("speed", `Speed ${Math.min(100, Math.max(LEAST_PERCENT, Math.round(ratio * 100)))}`, add);
    else this.say("path speed", `SpeedS ${fixed(Math.min(FASTEST_MMPS, Math.max(SLOWEST_MMPS, mmps)), 4)}`, add);
    const configuration = this.place.posture(step, target, this.near);
    const passes = this.place.blend_m(step, this.before, next) > 0 ? " CP" : "";
    const words = isJoint && !("q" in target) ? this.postureWords(target.branch, configuration) : "";
    if (path === "circ") {
      if (step.via === undefined)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} has no point to pass through.`,
          "Teach the point on the arc.",
        );
      add(`Arc3 ${this.goal(step, step.via)}, ${this.goal(step, target)}${passes}`);
    } else add(`${isJoint ? "Go" : "Move"} ${this.goal(step, target)}${words}${passes}`);
    this.near = configuration ?? this.near;
  }

  private goal(step: MoveStep, target: Target): string {
    if ("q" in target) return `JA(${shownAxes(this.section, target.q).map(degreesText).join(", ")})`;
    return Object.hasOwn(this.place.program.pallets, target.frame)
      ? this.inPattern(step, target.frame, target.pose)
      : `${xyText(this.inBase(target))}${this.local(target.frame)}`;
  }

  /** A step from the place of a pattern along its own axes. */
  private inPattern(step: MoveStep, pallet: string, { position, quaternion }: Pose): string {
    if (Math.hypot(quaternion[0], quaternion[1], quaternion[2]) > STRAIGHT)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} turns the hand at the places of ${pallet}, which SPEL+ cannot count from a place.`,
        "Turn the places of the pallet instead.",
      );
    const steps = position.flatMap((by, i) => (mmText(by) === "0" ? [] : [` +TL${"XYZ"[i]!}(${mmText(by)})`]));
    return `${this.named("pallet", pallet)}${steps.length === 0 ? " +TLZ(0)" : steps.join("")}`;
  }

  private local(frame: string): string {
    return frame === "world" ? "" : ` /${this.numberOf(frame)}`;
  }

  /** A place alone is reached in the posture that the arm is in; one that was taught is asked for. */
  private postureWords(branch: Branch | undefined, configuration: readonly number[] | undefined): string {
    const named =
      branch === undefined || configuration === undefined ? undefined : branchOf(this.place.robot, configuration);
    if (named === undefined) return "";
    return ` /${named.shoulder === "front" ? "R" : "L"} /${named.elbow === "up" ? "A" : "B"} /${named.wrist !== wristAboveZero(this.place.robot) ? "NF" : "F"}`;
  }
}

/** XY(x, y, z, u, v, w): mm and degrees, turns about z, y, x. */
const xyText = ({ position, quaternion }: Pose): string =>
  `XY(${[...position.map(mmText), ...[...turnTexts(quaternion)].reverse()].join(", ")})`;
