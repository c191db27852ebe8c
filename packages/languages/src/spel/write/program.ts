import { branchOf, compose, type Branch, type Condition, type EmittedFile, type MoveStep, type Pallet, type Pose, type Step, type Target } from "@twincell/core";
import { asciiText } from "../../text/index.ts";
import { BasicProgram, BlockWriter, CannotSay, Names, called, degText, fixed, inUse, mmText, turnTexts, type Add, type InUse, type Place } from "../../writing/index.ts";
import { GRIPPER, LINES, type Spoken } from "../robots.ts";
import { RESERVED } from "./reserved.ts";

const LONGEST_NAME = 32;
/** Tools and locals that the controller keeps. */
const MOST = 15;
/** The largest speed of a path [mm/s], and what SpeedS and Speed say at least. */
const FASTEST_MMPS = 2000, SLOWEST_MMPS = 0.1, LEAST_PERCENT = 1;
/** A pose in a pattern that is turned more than this is turned. */
const STRAIGHT = 1e-9;

/** The file: `main` and the functions that it calls. */
export class SpelProgram extends BasicProgram {
  private readonly spoken: Spoken;
  private readonly used: InUse;
  private readonly numbers = new Map<string, number>();
  private declared: string[] = [];

  constructor(place: Place, spoken: Spoken) {
    super(place, new Names({ most: LONGEST_NAME, reserved: RESERVED, first: "n_", foldsCase: true }), { endIf: "EndIf", forever: ["Do", "Loop"], mm: mmText });
    this.spoken = spoken;
    this.used = inUse(place.program);
  }

  write(): EmittedFile {
    const { program, robot } = this.place, whole = new BlockWriter();
    const bodies = [["main", program.steps, () => { this.beginning(); }] as const, ...Object.entries(program.routines).map(([routine, steps]) => [this.named("routine", routine), steps, (): void => { /* nothing before the steps */ }] as const)];
    for (const line of this.constants()) whole.add(line);
    for (const [name, steps, before] of bodies) {
      const inside = this.out = new BlockWriter();
      this.declared = [];
      this.begin();
      before();
      this.steps(steps);
      whole.block(`Function ${name}`, "Fend", "", () => {
        if (name === "main") {
          whole.add(`'* ${asciiText(program.name)}`.trimEnd());
          whole.add(`'* ${asciiText(robot.name)}. Lengths in mm, angles in degrees, points in the base of the robot.`);
        }
        if (this.declared.length > 0) whole.add(`Real ${this.declared.join(", ")}`);
        whole.append(inside);
      });
    }
    return whole.file("main.prg", "\r\n");
  }

  private named(sort: string, name: string): string { return this.names.of(sort, name.toLowerCase()); }

  /** Names of numbers, which the text then uses. */
  private constants(): string[] {
    const { tools, frames, pallets, signals } = this.used, lines: string[] = [];
    for (const [sort, names, what] of [["tool", tools, "tools"], ["frame", frames, "locals"]] as const) {
      if (names.size > MOST) throw new CannotSay("", `The program uses ${names.size} ${what}; a controller keeps ${MOST}.`, "Divide the program.");
      for (const [i, name] of [...names].entries()) {
        this.numbers.set(`${sort}\0${name}`, i + 1);
        lines.push(`#define ${this.named(sort, name)} ${i + 1}`);
      }
    }
    for (const [i, name] of [...pallets].entries()) lines.push(`#define ${this.named("pallet", name)} P${i + 1}`);
    for (const [signal, step] of signals) lines.push(`#define ${this.named("signal", signal)} ${this.address(signal, step)}`);
    if (JSON.stringify([this.place.program.steps, this.place.program.routines]).includes('"type":"gripper"')) lines.push(`#define ${GRIPPER.name} ${GRIPPER.output}`);
    return lines;
  }

  private address(signal: string, step: Step): number {
    const { signals } = this.place.program, line = Object.hasOwn(signals, signal) ? signals[signal] : undefined, [first, last] = LINES;
    if (line?.address === undefined) throw new CannotSay(step.id, `${called(step)} uses the line ${signal}, whose number is not known.`, "Give the line its number in the list of signals.");
    if (!Number.isInteger(line.address) || line.address < first || line.address > last) throw new CannotSay(step.id, `${called(step)} uses the line ${signal} with the number ${line.address}; SPEL+ counts lines from ${first} to ${last}.`, "Give the line a number of the controller.");
    if (line.kind === "digital-out" && line.address === GRIPPER.output) throw new CannotSay(step.id, `${called(step)} uses the output ${GRIPPER.output}, which is the gripper's.`, "Give the line another number.");
    return line.address;
  }

  /** What the controller would keep from before. */
  private beginning(): void {
    const { out, place } = this, { baseFromWorld } = place;
    for (const line of ["Motor On", "Power High", "Accel 100, 100"]) out.add(line);
    for (const tool of this.used.tools) out.add(`TLSet ${this.named("tool", tool)}, ${xyText(place.tool(tool))}`);
    for (const frame of this.used.frames) out.add(`Local ${this.named("frame", frame)}, ${xyText(compose(baseFromWorld, place.frame(frame)))}`);
  }

  protected counter(name: string): string {
    const variable = this.names.fresh(name);
    this.declared.push(variable);
    return variable;
  }

  protected wait(s: number, add: Add): void { add(`Wait ${fixed(s, 6)}`); }
  protected grip(closed: boolean, add: Add): void { add(`${closed ? "On" : "Off"} ${GRIPPER.name}`); }
  protected set({ to, pulse_s }: Extract<Step, { type: "set" }>, line: string, add: Add): void { add(`${to === true ? "On" : "Off"} ${line}${pulse_s === undefined ? "" : `, ${fixed(pulse_s, 6)}`}`); }
  protected asked({ signal, is }: Extract<Condition, { readonly is: unknown }>, line: string): string {
    return `${this.place.program.signals[signal]?.kind === "digital-out" ? "Oport" : "Sw"}(${line}) = ${is ? "On" : "Off"}`;
  }
  protected waitFor(condition: string, _step: Step, add: Add): void { add(`Wait ${condition}`); }
  protected payload(): void { /* declared under cannot */ }
  protected message(text: string, add: Add): void { add(`Print "${text}"`); }
  protected stop(add: Add): void { add("Quit All"); }
  protected call(routine: string, add: Add): void { add(`Call ${this.named("routine", routine)}`); }
  protected line(signal: string): string { return this.named("signal", signal); }

  protected palletPlace({ pallet: name }: Extract<Step, { type: "pallet" }>, pallet: Pallet, coordinates: readonly string[], turn: Pose["quaternion"], add: Add): void {
    add(`${this.named("pallet", name)} = XY(${coordinates.join(", ")}, ${[...turnTexts(turn)].reverse().join(", ")})${this.local(pallet.frame)}`);
  }

  protected move(step: MoveStep, next: Step | undefined, add: Add): void {
    const { target, speed, path } = step, isJoint = path === "ptp", tool = target.tool ?? (isJoint && "q" in target ? undefined : "flange"), most_mps = this.place.robot.maxTcpSpeed_mps;
    if (tool !== undefined) this.say("tool", tool === "flange" ? "Tool 0" : `Tool ${this.named("tool", tool)}`, add);
    if ("time_s" in speed) return;
    const ratio = "mps" in speed ? speed.mps / most_mps : speed.ratio, mmps = ("mps" in speed ? speed.mps : speed.ratio * most_mps) * 1000;
    if (isJoint) this.say("speed", `Speed ${Math.min(100, Math.max(LEAST_PERCENT, Math.round(ratio * 100)))}`, add);
    else this.say("path speed", `SpeedS ${fixed(Math.min(FASTEST_MMPS, Math.max(SLOWEST_MMPS, mmps)), 4)}`, add);
    const posture = this.place.posture(step, target, this.near), passes = this.place.blend_m(step, this.before, next) > 0 ? " CP" : "";
    const words = isJoint && !("q" in target) ? this.postureWords(target.branch, posture) : "";
    if (path === "circ") {
      if (step.via === undefined) throw new CannotSay(step.id, `${called(step)} has no point to pass through.`, "Teach the point on the arc.");
      add(`Arc3 ${this.goal(step, step.via)}, ${this.goal(step, target)}${passes}`);
    } else add(`${isJoint ? "Go" : "Move"} ${this.goal(step, target)}${words}${passes}`);
    this.near = posture ?? this.near;
  }

  private goal(step: MoveStep, target: Target): string {
    if ("q" in target) return `JA(${target.q.map(degText).join(", ")})`;
    return Object.hasOwn(this.place.program.pallets, target.frame) ? this.inPattern(step, target.frame, target.pose) : `${xyText(this.inBase(target))}${this.local(target.frame)}`;
  }

  /** A step from the place of a pattern along its own axes. */
  private inPattern(step: MoveStep, pallet: string, { position, quaternion }: Pose): string {
    if (Math.hypot(quaternion[0], quaternion[1], quaternion[2]) > STRAIGHT) throw new CannotSay(step.id, `${called(step)} turns the hand at the places of ${pallet}, which SPEL+ cannot count from a place.`, "Turn the places of the pallet instead.");
    const steps = position.flatMap((by, i) => mmText(by) === "0" ? [] : [` +TL${"XYZ"[i]!}(${mmText(by)})`]);
    return `${this.named("pallet", pallet)}${steps.length === 0 ? " +TLZ(0)" : steps.join("")}`;
  }

  private local(frame: string): string { return frame === "world" ? "" : ` /${this.numbers.get(`frame\0${frame}`) ?? 0}`; }

  /** A place alone is reached in the posture that the arm is in; one that was taught is asked for. */
  private postureWords(branch: Branch | undefined, posture: readonly number[] | undefined): string {
    const named = branch === undefined || posture === undefined ? undefined : branchOf(this.place.robot, posture);
    if (named === undefined) return "";
    return ` /${named.shoulder === "front" ? "R" : "L"} /${named.elbow === "up" ? "A" : "B"} /${named.wrist === this.spoken.noFlip ? "NF" : "F"}`;
  }
}

/** XY(x, y, z, u, v, w): mm and degrees, turns about z, y, x. */
const xyText = ({ position, quaternion }: Pose): string => `XY(${[...position.map(mmText), ...[...turnTexts(quaternion)].reverse()].join(", ")})`;
