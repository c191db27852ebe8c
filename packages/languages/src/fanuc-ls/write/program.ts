import {
  compose,
  cornerShare,
  everyStep,
  inverse,
  pose,
  rotate,
  isCondition,
  type Predicate,
  type EmittedFile,
  type MoveStep,
  type PalletStep,
  type Pose,
  type SignalLine,
  type Step,
  type Target,
  type Vector3,
  type VendorSection,
} from "@twincell/core";
import { asciiText } from "../../parser/index.ts";
import {
  PENDANT_UNITS,
  UnsupportedStep,
  FANUC_LINES,
  Names,
  StepWriter,
  called,
  expressionText,
  fixed,
  outOfRange,
  patternOf,
  pitchTerm,
  type ExpressionWords,
  type Place,
  BASIC_SIGNS,
  lineKind,
  checkSetting,
} from "../../emitter/index.ts";
import { GRIPPER_OUTPUT } from "../robots.ts";
import { Listing } from "./listing.ts";
import { configOf, pendantJoints, xyzwpr, type Position } from "./positions.ts";
import { Registers } from "./registers.ts";
import { RESERVED, labelled } from "./words.ts";

const NAME_LENGTH = 36;
const REMARK_LENGTH = 32;
const MESSAGE_LENGTH = 23;
const LONGEST_WAIT_S = 327.67;
/** A pitch is added many times over: it is written to ten nanometres. */
const fine = (length_m: number): string => fixed(length_m * 1000, 5);
const SHORT: Readonly<Record<SignalLine["kind"], string>> = {
  "digital-in": "DI",
  "digital-out": "DO",
  "analogue-in": "AI",
  "analogue-out": "AO",
};

/**
 * A pallet being visited: its first place in the frame in use, and the register that holds how far off the present one
 * is.
 */
interface VisitedPallet {
  readonly first: Pose<"frame", "place">;
  readonly frame: string;
  readonly offset: string;
}

/**
 * Writes the programs; each says what changes from one step to the next, and everything anew where it may be entered
 * another way.
 */
export class ProgramWriter extends StepWriter {
  readonly warnings = new Set<string>();
  private readonly convention: VendorSection;
  private readonly fastest_mmps: number;
  private readonly names = new Names({ most: NAME_LENGTH, reserved: RESERVED, first: "P_", foldsCase: true });
  private readonly registers: Registers;
  private readonly visits = new Map<string, VisitedPallet>();
  private out = new Listing("", "");
  private tool: number | undefined;
  private frame: number | undefined;

  constructor(place: Place, convention: VendorSection, fastest_mmps: number) {
    super(place);
    this.convention = convention;
    this.fastest_mmps = fastest_mmps;
    this.registers = new Registers(place);
  }

  write(): readonly EmittedFile[] {
    const { program } = this.place;
    const name = this.names.of("program", program.name).toUpperCase();
    const main = new Listing(name, program.name);
    const files: Listing[] = [];
    for (const routine of Object.keys(program.routines)) this.names.of("routine", routine);
    for (const step of everyStep(program)) if (step.type === "move") this.registers.note(step);
    for (const [routine, steps] of Object.entries(program.routines))
      files.push(this.program(new Listing(this.routineName(routine), routine), steps));
    main.add(`!* ${asciiText(program.name)}`.slice(0, REMARK_LENGTH + 1).trimEnd());
    this.registers.declare(main);
    this.program(main, program.steps);
    return [main, ...files].map(listing => listing.file());
  }

  private routineName(routine: string): string {
    return this.names.of("routine", routine).toUpperCase();
  }

  private program(listing: Listing, steps: readonly Step[]): Listing {
    this.out = listing;
    this.begin();
    this.steps(steps);
    return listing;
  }

  protected override begin(): void {
    super.begin();
    this.tool = undefined;
    this.frame = undefined;
  }

  protected remark(text: string, step: string): void {
    this.out.add(`!${text.trimStart()}`.slice(0, REMARK_LENGTH + 1).trimEnd(), step);
  }

  protected step(step: Step, next: Step | undefined): void {
    const add = (line: string): void => {
      this.out.add(line, step.id);
    };
    switch (step.type) {
      case "move":
        return this.move(step, next);
      case "wait":
        return add(`WAIT ${this.seconds(step, step.s)}(sec)`);
      case "gripper":
        return add(`${GRIPPER_OUTPUT}=${step.closed ? "ON" : "OFF"}`);
      case "set":
        return this.set(step, add);
      case "wait-for":
        return this.waitFor(step, add);
      case "message": {
        const text = asciiText(step.text).replace(/[[\]]/g, "'");
        if (text.length > MESSAGE_LENGTH)
          throw new UnsupportedStep(
            step.id,
            `${called(step)} says ${text.length} characters; MESSAGE shows ${MESSAGE_LENGTH}.`,
            "Say it in fewer words.",
          );
        return add(`MESSAGE[${text}]`);
      }
      case "stop":
        return add("ABORT");
      case "comment":
        for (const line of inLines(asciiText(step.text), REMARK_LENGTH - 2)) add(`!- ${line}`.trimEnd());
        return;
      case "assign":
        return this.assign(step, add);
      case "while":
        return this.whileLoop(step, add);
      case "call":
        add(`CALL ${this.routineName(step.routine)}`);
        return this.begin();
      case "repeat":
        return this.repeat(step, add);
      case "if":
        return this.decision(step, add);
      case "pallet":
        return this.pallet(step, add);
      // Declared under `cannot`.
      case "payload":
        throw new UnsupportedStep(
          step.id,
          `${called(step)} says a load.`,
          "Choose a payload schedule at the controller.",
        );
    }
  }

  // --- blocks -----------------------------------------------------------------------------------------------------

  private block(steps: readonly Step[]): void {
    this.begin();
    this.steps(steps);
  }

  private repeat(step: Extract<Step, { type: "repeat" }>, add: (line: string) => void): void {
    const label = step.times === "forever" ? this.out.label() : 0;
    add(step.times === "forever" ? `LBL[${label}]` : `FOR ${this.registers.number("count")}=1 TO ${step.times}`);
    this.block(step.steps);
    add(step.times === "forever" ? `JMP LBL[${label}]` : "ENDFOR");
    this.begin();
  }

  /** TP has no WHILE: a label, a decision and a jump back, as its programmers write it. */
  private whileLoop(step: Extract<Step, { type: "while" }>, add: (line: string) => void): void {
    const label = this.out.label();
    add(`LBL[${label}]`);
    add(`IF (${this.condition(step.when, step)}) THEN`);
    this.block(step.steps);
    add(`JMP LBL[${label}]`);
    add("ENDIF");
    this.begin();
  }

  private assign(step: Extract<Step, { type: "assign" }>, add: (line: string) => void): void {
    const text = expressionText(step.to, this.words, this.place.program, step);
    const isPlain = typeof step.to === "boolean" || (typeof step.to === "number" && step.to >= 0);
    add(`${this.words.variable(step.variable)}=${isPlain ? text : `(${text})`}`);
  }

  private readonly words: ExpressionWords = {
    // Yes is kept as 1 and no as 0.
    truth: ["0", "1"],
    number: value => fixed(value, 6),
    variable: name => this.registers.variable(name),
    truthVariable: name => `${this.registers.variable(name)}=1`,
    line: (signal, step, isDigital) => `${this.lineOf(signal, step).text}${isDigital ? "=ON" : ""}`,
    not: inner => `!${inner}`,
    signs: BASIC_SIGNS,
    calls: {},
    scale: PENDANT_UNITS,
  };

  private decision(step: Extract<Step, { type: "if" }>, add: (line: string) => void): void {
    add(`IF (${this.condition(step.when, step)}) THEN`);
    this.block(step.then);
    if (step.else !== undefined) {
      add("ELSE");
      this.block(step.else);
    }
    add("ENDIF");
    this.begin();
  }

  /**
   * Loops over layers, lines and places: the present place is worked out, and its distance from the first shifts the
   * taught points.
   */
  private pallet(step: PalletStep, add: (line: string) => void): void {
    const { program } = this.place;
    const { registers } = this;
    const { pallet, lines, inLine, isShifted, isZigzag, ...pitch } = patternOf(step, program);
    const vendorFromFrame = this.place.vendorFromFrame(pallet.frame);
    const first = compose(vendorFromFrame, pallet.origin);
    const [along_m, away_m, up_m] = [pitch.along_m, pitch.away_m, pitch.up_m].map(v =>
      rotate(vendorFromFrame.quaternion, v),
    ) as [Vector3, Vector3, Vector3];
    const origin = registers.position(`${step.pallet} 1`);
    const present = registers.position(`${step.pallet} now`);
    const offset = registers.position(step.pallet);
    const [layer, line, along, at, last] = ["layer", "line", "along", "at", "last"].map(word =>
      registers.number(word),
    ) as [string, string, string, string, string];
    this.useFrame(registers.frameNumber(pallet.frame, step), step.id);
    for (const own of [origin, present]) for (const each of registers.values(own, xyzwpr(first))) add(each);
    add(`FOR ${layer}=0 TO ${pallet.layers - 1}`);
    add(`FOR ${line}=0 TO ${lines - 1}`);
    add(isShifted ? `${last}=(${inLine - 1}-${line} MOD 2)` : `${last}=${inLine - 1}`);
    add(`FOR ${along}=0 TO ${last}`);
    add(`${at}=${along}`);
    if (isZigzag) for (const each of [`IF (${line} MOD 2=1) THEN`, `${at}=(${last}-${along})`, "ENDIF"]) add(each);
    for (const [i, text] of xyzwpr(first).slice(0, 3).entries()) {
      // Packed rows count in half pitches, so that both are the same number.
      const inLine = isShifted
        ? pitchTerm(along_m[i]! / 2, `(2*${at}+${line} MOD 2)`, fine)
        : pitchTerm(along_m[i]!, at, fine);
      add(
        `${element(present, i + 1)}=(${text}${inLine}${pitchTerm(away_m[i]!, line, fine)}${pitchTerm(up_m[i]!, layer, fine)})`,
      );
    }
    add(`${offset}=${present}-${origin}`);
    this.visits.set(step.pallet, { first, frame: pallet.frame, offset });
    this.block(step.steps);
    this.visits.delete(step.pallet);
    for (let i = 0; i < 3; i++) add("ENDFOR");
    this.begin();
  }

  // --- lines ------------------------------------------------------------------------------------------------------

  private lineOf(signal: string, step: Step): { readonly text: string; readonly kind: SignalLine["kind"] } {
    const { program } = this.place;
    const kind = lineKind(program, signal, step);
    const { address } = program.signals[signal]!;
    if (address === undefined && /^(RI|RO|UI|UO|SI|SO)\[[0-9]+\]$/.test(signal)) return { text: signal, kind };
    if (address === undefined)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the line ${signal}, whose number on the controller is not given.`,
        "Give it its number: lines of FANUC count from 1.",
      );
    const wrong = outOfRange("FANUC", FANUC_LINES, step, signal, { kind, address });
    if (wrong !== undefined) throw new UnsupportedStep(step.id, wrong.sentence, wrong.hint);
    return { text: labelled(SHORT[kind], address, signal), kind };
  }

  private set(step: Extract<Step, { type: "set" }>, add: (line: string) => void): void {
    const { text, kind } = this.lineOf(step.signal, step);
    const { to } = step;
    checkSetting(step, kind);
    if (typeof to === "number") return add(`${text}=${fixed(to, 6)}`);
    if (step.pulse_s === undefined) return add(`${text}=${to ? "ON" : "OFF"}`);
    if (!to)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} is a pulse that goes off; PULSE goes on.`,
        "Turn the sense of the line in the controller.",
      );
    add(`${text}=PULSE,${fixed(step.pulse_s, 2)}sec`);
  }

  private waitFor(step: Extract<Step, { type: "wait-for" }>, add: (line: string) => void): void {
    const when = this.condition(step.when, step);
    if (step.timeout_s === undefined) return add(`WAIT ${when}`);
    // Hundredths of a second.
    add(`$WAITTMOUT=${Math.round(step.timeout_s * 100)}`);
    add(`WAIT ${when} TIMEOUT,LBL[${this.out.abortLabel()}]`);
  }

  private condition(when: Predicate, step: Step): string {
    if (!isCondition(when)) return expressionText(when.expression, this.words, this.place.program, step);
    const { text, kind } = this.lineOf(when.signal, step);
    if ("is" in when !== kind.startsWith("digital"))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} asks the line ${when.signal} for what it cannot answer.`,
        "Ask a digital line whether it is on, an analogue one for a limit.",
      );
    if ("is" in when) return `${text}=${when.is ? "ON" : "OFF"}`;
    return "above" in when ? `${text}>${fixed(when.above, 6)}` : `${text}<${fixed(when.below, 6)}`;
  }

  private seconds(step: Step, s: number): string {
    if (s > LONGEST_WAIT_S)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} waits ${s} s; WAIT goes up to ${LONGEST_WAIT_S} s.`,
        "Wait twice, or for a signal.",
      );
    return s.toFixed(2).padStart(6);
  }

  // --- moves ------------------------------------------------------------------------------------------------------

  private useFrame(number: number, step: string): void {
    if (number !== this.frame) this.out.add(`UFRAME_NUM=${number}`, step);
    this.frame = number;
  }
  private useTool(number: number, step: string): void {
    if (number !== this.tool) this.out.add(`UTOOL_NUM=${number}`, step);
    this.tool = number;
  }

  private move(step: MoveStep, next: Step | undefined): void {
    const { target, path, id } = step;
    const isAngles = path === "ptp" && "q" in target;
    const { registers } = this;
    const configuration = this.place.posture(step, isAngles ? target : this.place.asPose(target), this.near);
    this.near = configuration ?? this.near;
    const frame = "q" in target ? "world" : target.frame;
    const visit = this.visits.get(frame);
    this.useFrame(registers.frameNumber(visit?.frame ?? frame, step), id);
    this.useTool(
      isAngles && target.tool === undefined && this.tool !== undefined
        ? this.tool
        : registers.toolNumber(target.tool ?? "flange", step),
      id,
    );
    const record = (values: readonly string[], config?: string): string =>
      `P[${this.out.position({ uf: this.frame!, ut: this.tool!, step: id, values, ...(config === undefined ? {} : { config }) } satisfies Position)}]`;
    const options = `${this.term(step, next)}${this.acceleration(step)}${visit === undefined ? "" : ` Offset,${visit.offset}`}`;
    if (isAngles)
      return this.out.motion(
        `J ${record(pendantJoints(target.q, this.convention))} ${this.percent(step)} ${options}`,
        id,
      );
    const config = configOf(this.place.robot, this.convention, configuration ?? this.place.robot.home_rad);
    const goal = record(xyzwpr(this.inFrame(target, frame)), config);
    const search = this.search(step);
    if (path === "ptp") this.out.motion(`J ${goal} ${this.percent(step)} ${options}${search}`, id);
    else if (path === "lin") this.out.motion(`L ${goal} ${this.path(step)} ${options}${search}`, id);
    else {
      if (step.via === undefined)
        throw new UnsupportedStep(id, `${called(step)} has no point to pass through.`, "Teach the point on the arc.");
      const via = record(xyzwpr(this.inFrame(step.via, frame)), config);
      this.out.motion(
        `C ${via}${visit === undefined ? "" : ` Offset,${visit.offset}`}\n${goal} ${this.path(step)} ${options}${search}`,
        id,
      );
    }
    if (search !== "" && step.until!.missing === "continue") this.out.add(`LBL[${/LBL\[(\d+)/.exec(search)![1]!}]`, id);
  }

  /** A target as it is seen from the frame whose digits are written. */
  private inFrame(target: Target, frame: string): Pose<"frame", "tcp"> {
    const visit = this.visits.get(frame);
    const { registers, place } = this;
    if (visit !== undefined && "pose" in target && target.frame === frame)
      return compose(visit.first, compose(pose<"place", "frame">(), target.pose));
    return compose(inverse(registers.baseFromFrame(visit?.frame ?? frame)), place.tip(target));
  }

  private percent({ speed }: MoveStep): string {
    const ratio = "ratio" in speed ? speed.ratio : "mps" in speed ? speed.mps / this.place.robot.maxTcpSpeed_mps : 1;
    return `${Math.min(100, Math.max(1, Math.round(100 * ratio)))}%`;
  }

  private path({ speed }: MoveStep): string {
    const v_mmps =
      1000 * ("mps" in speed ? speed.mps : "ratio" in speed ? speed.ratio * this.place.robot.maxTcpSpeed_mps : 0);
    if (v_mmps > this.fastest_mmps) this.warnings.add(`Speeds of paths end at ${this.fastest_mmps} mm/s.`);
    return `${Math.min(this.fastest_mmps, Math.max(1, Math.round(v_mmps)))}mm/sec`;
  }

  private acceleration(step: MoveStep): string {
    const ratio = step.acceleration?.ratio ?? 1;
    return ratio === 1 ? "" : ` ACC${Math.max(1, Math.round(100 * ratio))}`;
  }

  /** CNT as a share of the shorter neighbouring half path. Before anything that is not a motion the robot stands. */
  private term(step: MoveStep, next: Step | undefined): string {
    const { blend_m, blend_ratio = 0 } = step;
    if (step.until !== undefined || next?.type !== "move" || !(blend_m > 0 || blend_ratio > 0)) return "FINE";
    const half_m = this.place.blend_m({ ...step, blend_m: 0, blend_ratio: 1 }, this.before, next);
    return `CNT${Math.round(100 * cornerShare(step, 2 * half_m))}`;
  }

  private search(step: MoveStep): string {
    if (step.until === undefined) return "";
    this.out.add(`SKIP CONDITION ${this.condition(step.until.when, step)}`, step.id);
    return ` Skip,LBL[${step.until.missing === "fault" ? this.out.abortLabel() : this.out.label()}]`;
  }
}

const element = (register: string, i: number): string => register.replace(/(?=[:\]])/, `,${i}`).replace(/:[^\]]*/, "");
/** A text in lines of at most so many characters, broken between words where that goes. */
function inLines(text: string, most: number): string[] {
  const lines: string[] = [];
  for (let rest = text; rest !== "" || lines.length === 0; ) {
    const cut =
      rest.length <= most ? rest.length : rest.lastIndexOf(" ", most) > 0 ? rest.lastIndexOf(" ", most) : most;
    lines.push(rest.slice(0, cut).trim());
    rest = rest.slice(cut).trim();
  }
  return lines;
}
