import {
  branchOf,
  compose,
  type Branch,
  type Condition,
  type MoveStep,
  type Pallet,
  type PalletStep,
  type PayloadStep,
  type Pose,
  type Step,
  type Target,
  type VendorSection,
  wristAboveZero,
} from "@twincell/core";
import { asciiText } from "../../parser/index.ts";
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
const LEFTY = 1;
const BELOW = 2;
const NONFLIP = 4;
const AUTOMATIC = -1;
const MS = 1000;
const GRAMS = 1000;
const KG_CM2 = 10_000;
/** A mass that is this near to whole grams is [g]. */
const WHOLE_G = 1e-6;

/** The file: `Main` and the subs that it calls. */
export class PacProgram extends BasicModules {
  protected readonly sharesNumbers = true;
  private readonly section: VendorSection;
  /** The figure at the places of the pattern that is written. */
  private figure = AUTOMATIC;
  private places: string[] = [];

  constructor(place: Place, section: VendorSection) {
    super(
      place,
      { most: LONGEST_NAME, reserved: RESERVED, first: "n_", foldsCase: true },
      {
        language: "PacScript",
        file: "main.pcs",
        define: "#Define",
        main: "Main",
        open: name => `Sub ${name}`,
        close: "End Sub",
        endIf: "End If",
        forever: ["Do", "Loop"],
        whileTrue: ["Do While", "Loop"],
        global: (name, type) => `Dim ${name} As ${type === "num" ? "Single" : "Integer"}`,
        mm: mmText,
        most: { tools: 63, frames: 7, called: "works" },
        lines: LINES,
        gripper: GRIPPER,
      },
    );
    this.section = section;
  }

  protected head(): readonly string[] {
    return [`'!TITLE "${asciiText(this.place.program.name).replace(/"/g, "'")}"`];
  }
  protected ending(): readonly string[] {
    return ["GiveArm"];
  }
  protected patterns(): readonly string[] {
    return [];
  }
  protected declaration(names: readonly string[]): readonly string[] {
    return names.map(name => `Dim ${name} As ${this.places.includes(name) ? "Position" : "Single"}`);
  }

  protected beginning(): readonly string[] {
    const {
      place,
      used: { tools, frames },
    } = this;
    return [
      "TakeArm Keep = 0",
      "Accel 100, 100",
      ...[...tools].map(tool => `Tool ${this.named("tool", tool)}, ${placeText(place.tool(tool))}`),
      ...[...frames].map(
        frame => `Work ${this.named("frame", frame)}, ${placeText(compose(place.baseFromWorld, place.frame(frame)))}`,
      ),
    ];
  }

  protected wait(s: number, add: Add): void {
    add(`Delay ${fixed(s * MS, 0)}`);
  }
  protected grip(closed: boolean, add: Add): void {
    add(`${closed ? "Set" : "Reset"} IO[${GRIPPER.name}]`);
  }
  protected set({ to, pulse_s }: Extract<Step, { type: "set" }>, line: string, add: Add): void {
    add(`${to === true ? "Set" : "Reset"} IO[${line}]${pulse_s === undefined ? "" : `, ${fixed(pulse_s * MS, 0)}`}`);
  }
  protected asked({ is }: Extract<Condition, { readonly is: unknown }>, line: string): string {
    return `IO[${line}] = ${is ? "On" : "Off"}`;
  }
  protected waitFor(condition: string, _step: Step, add: Add): void {
    add(`Wait ${condition}`);
  }
  protected message(text: string, add: Add): void {
    add(`PrintDbg "${text}"`);
  }
  protected stop(add: Add): void {
    add("Halt");
  }

  /** Grams, millimetres, kg·cm². */
  protected payload(step: PayloadStep, add: Add): void {
    const { mass_kg, center_m, inertia_kgm2: [ixx, iyy, izz, ...products] = [0, 0, 0, 0, 0, 0] } = step;
    const grams = mass_kg * GRAMS;
    if (Math.abs(grams - Math.round(grams)) > WHOLE_G)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} gives a mass of ${mass_kg} kg; Payload takes whole grams.`,
        "Round the mass.",
      );
    if (products.some(product => product !== 0))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} gives products of inertia; Payload takes three moments.`,
        "Give the load in its main axes.",
      );
    const moments =
      step.inertia_kgm2 === undefined
        ? ""
        : `, V(${[ixx, iyy, izz].map(moment => fixed(moment * KG_CM2, 6)).join(", ")})`;
    add(`Payload ${Math.round(grams)}, V(${center_m.map(mmText).join(", ")})${moments}`);
  }

  protected override beforePattern(step: PalletStep): void {
    const { pallets } = this.place.program;
    const frame = Object.hasOwn(pallets, step.pallet) ? pallets[step.pallet]!.frame : "world";
    this.useWork(frame, line => {
      this.out.add(line, step.id);
    });
  }

  /** The figure at a pattern is that of the first move inside it. */
  protected palletPlace(
    step: PalletStep,
    _pallet: Pallet,
    coordinates: readonly string[],
    turn: Pose["quaternion"],
    add: Add,
  ): void {
    const first = step.steps.find(each => each.type === "move" && each.path === "ptp") as MoveStep | undefined;
    this.figure =
      first === undefined
        ? AUTOMATIC
        : this.figureOf(
            "q" in first.target ? undefined : first.target.branch,
            this.place.posture(first, first.target, this.near),
          );
    add(`${this.variable(step.pallet)} = P(${coordinates.join(", ")}, ${turnTexts(turn).join(", ")}, ${this.figure})`);
  }

  private variable(pallet: string): string {
    const name = this.named("pallet", pallet);
    if (!this.places.includes(name)) this.places.push(name);
    this.introduce(name);
    return name;
  }

  private useWork(frame: string, add: Add): void {
    this.say("work", frame === "world" ? "ChangeWork 0" : `ChangeWork ${this.named("frame", frame)}`, add);
  }

  protected move(step: MoveStep, next: Step | undefined, add: Add): void {
    const { target, path } = step;
    const isJoint = path === "ptp";
    const tool = target.tool ?? (isJoint && "q" in target ? undefined : "flange");
    const { pallets } = this.place.program;
    if (tool !== undefined)
      this.say("tool", tool === "flange" ? "ChangeTool 0" : `ChangeTool ${this.named("tool", tool)}`, add);
    const configuration = this.place.posture(step, target, this.near);
    const blend_m = this.place.blend_m(step, this.before, next);
    const frames = [step.via, target].flatMap(each => (each === undefined || "q" in each ? [] : [each.frame]));
    const works = new Set(frames.map(frame => (Object.hasOwn(pallets, frame) ? pallets[frame]!.frame : frame)));
    // Both places of an arc count in one work.
    const [work] = works.size === 1 ? works : ["world"];
    if (frames.length > 0) this.useWork(work!, add);
    const pass = blend_m > 0 ? `@${Math.max(1, Math.round(blend_m * 1000))}` : "@0";
    const goal = this.goal(step, target, configuration, work!);
    const options = this.options(step);
    if (path === "circ") {
      if (step.via === undefined)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} has no point to pass through.`,
          "Teach the point on the arc.",
        );
      add(`Move C, ${this.goal(step, step.via, undefined, work!)}, ${pass} ${goal}${options}`);
    } else add(`Move ${isJoint ? "P" : "L"}, ${pass} ${goal}${options}`);
    this.near = configuration ?? this.near;
  }

  private options({ speed, path, acceleration }: MoveStep): string {
    const percent = (ratio: number): string => fixed(ratio * 100, 5);
    const { maxTcpSpeed_mps } = this.place.robot;
    const said =
      "time_s" in speed
        ? ""
        : "ratio" in speed
          ? percent(speed.ratio)
          : path === "ptp"
            ? percent(Math.min(1, speed.mps / maxTcpSpeed_mps))
            : `Mps(${fixed(speed.mps, 7)})`;
    const share =
      acceleration === undefined || acceleration.ratio >= 1
        ? ""
        : `, Accel = ${percent(acceleration.ratio)}, Decel = ${percent(acceleration.ratio)}`;
    return `, Speed = ${said}${share}`;
  }

  private goal(step: MoveStep, target: Target, configuration: readonly number[] | undefined, work: string): string {
    if ("q" in target) return `J(${shownAxes(this.section, target.q).map(degreesText).join(", ")})`;
    const { pallets } = this.place.program;
    const { frame, pose } = target;
    const isAsked = step.path === "ptp" && target.branch !== undefined;
    const figure = isAsked ? this.figureOf(target.branch, configuration) : AUTOMATIC;
    if (Object.hasOwn(pallets, frame)) {
      if (isAsked && figure !== this.figure)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} reaches the places of ${frame} in another posture than the first move there.`,
          "Reach the places of a pallet in one posture.",
        );
      return `DevH(${this.variable(frame)}, ${placeText(pose)})`;
    }
    return placeText(frame === work ? this.inBase(target) : this.seenFrom(work, target), figure);
  }

  /** Where a target is in a work that is not its own. */
  private seenFrom(work: string, target: Extract<Target, { readonly pose: unknown }>): Pose {
    return this.inBase({ ...target, frame: work, pose: this.place.seenIn(work, target) });
  }

  /**
   * 1 for a wrist in front of axis 1, 2 for an elbow below, 4 for a wrist that is not flipped. Joints 4 and 6 are
   * within half a turn.
   */
  private figureOf(branch: Branch | undefined, configuration: readonly number[] | undefined): number {
    const named =
      branch === undefined || configuration === undefined ? undefined : branchOf(this.place.robot, configuration);
    if (named === undefined) return AUTOMATIC;
    return (
      (named.shoulder === "front" ? LEFTY : 0) +
      (named.elbow === "up" ? 0 : BELOW) +
      (named.wrist === wristAboveZero(this.place.robot) ? NONFLIP : 0)
    );
  }
}

/** P(x, y, z, rx, ry, rz, figure): mm and degrees. */
const placeText = ({ position, quaternion }: Pose, figure?: number): string =>
  `P(${[...position.map(mmText), ...turnTexts(quaternion), ...(figure === undefined ? [] : [figure])].join(", ")})`;
