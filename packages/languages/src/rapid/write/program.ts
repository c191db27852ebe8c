import {
  branchOf,
  compose,
  inverse,
  listsOf,
  pose,
  rotate,
  isCondition,
  type Condition,
  type Predicate,
  type EmittedFile,
  type MoveStep,
  type PayloadStep,
  type Pose,
  type Robot,
  type SignalLine,
  type Speed,
  type Step,
  type Target,
  type VendorSection,
} from "@twincell/core";
import { asciiText } from "../../parser/index.ts";
import {
  BlockStepWriter,
  BlockWriter,
  PENDANT_UNITS,
  UnsupportedStep,
  Place,
  assignText,
  expressionText,
  called,
  fixed,
  patternOf,
  pitchTerm,
  remark,
  type ExpressionWords,
  type Pattern,
  shownAxes,
  BASIC_SIGNS,
  lineKind,
  checkSetting,
} from "../../emitter/index.ts";
import { GRIPPER_SIGNAL } from "../robots.ts";
import { confText, jointsText, mm, objectText, orientText, part, posText, targetText, toolText } from "./data.ts";
import { Declarations } from "./declarations.ts";
import { WORDS } from "./words.ts";

const LONGEST_TEXT = 80;
const LEAST_ACCELERATION = 0.2;

/** The module: data first, then the routines; says only what changes from one step to the next. */
export class ProgramWriter extends BlockStepWriter {
  readonly warnings = new Set<string>();
  private readonly robot: Robot;
  private readonly section: VendorSection;
  private readonly data = new Declarations();
  private readonly code = this.out;
  private readonly local = new Set<string>();
  /** Whether postures are known: without one there is no configuration to ask for. */
  private readonly solves: boolean;
  private points = 0;
  /** The tool of the last move; undefined where another routine or another round may have used another. */
  private tool: string | undefined;
  private acceleration = 1;

  constructor(place: Place, section: VendorSection) {
    super(place);
    this.robot = place.robot;
    this.section = section;
    // cfx is defined for a spherical wrist; of another nobody has said what it means.
    this.solves = place.robot.family.kind === "ortho-parallel";
  }

  write(): readonly EmittedFile[] {
    const {
      place: { program },
      data,
      code,
    } = this;
    const name = data.names.of("module", program.name);
    for (const signal of Object.keys(program.signals)) this.signalName(signal);
    for (const [variable, { type }] of Object.entries(program.variables ?? {}))
      data.add(
        `variable ${variable}`,
        `VAR ${type === "bool" ? "bool" : "num"} ${this.variableName(variable)}:=${type === "bool" ? "FALSE" : "0"};`,
      );
    for (const [routine, steps] of Object.entries(program.routines))
      this.routine(data.names.of("routine", routine), steps, false);
    this.routine("main", program.steps, true);
    const out = new BlockWriter();
    out.block(`MODULE ${name}`, "ENDMODULE", "", () => {
      out.add(`!* ${asciiText(program.name)}`.trimEnd());
      out.add(`!* ${asciiText(this.robot.name)}. Lengths in mm, angles in degrees.`);
      for (const { line, step } of data.all) out.add(line, step);
      out.append(code);
    });
    const pgf = new BlockWriter();
    pgf.block("<Program>", "</Program>", "", () => {
      pgf.add(`<Module>${name}.mod</Module>`);
    });
    const list = pgf.file(`${name}.pgf`, "\r\n");
    const header = '<?xml version="1.0" encoding="ISO-8859-1" ?>\r\n';
    return [out.file(`${name}.mod`, "\r\n"), { ...list, text: header + list.text, lines: ["", ...list.lines] }];
  }

  private routine(name: string, steps: readonly Step[], isMain: boolean): void {
    const { code } = this;
    const body = new BlockWriter();
    this.begin();
    if (isMain) this.tool = "flange";
    this.local.clear();
    const forgives = this.searches(steps);
    code.add(`PROC ${name}()`);
    code.indented(() => {
      const outer = this.swap(body);
      if (isMain)
        for (const setting of this.solves ? ["ConfJ\\On;", "ConfL\\On;"] : ["ConfJ\\Off;", "ConfL\\Off;"])
          body.add(setting);
      this.steps(steps);
      this.swap(outer);
      for (const variable of this.local) code.add(`VAR num ${variable}:=0;`);
      code.append(body);
    });
    if (forgives) {
      code.add("ERROR");
      code.indented(() => {
        code.block("IF ERRNO=ERR_WHLSEARCH THEN", "ENDIF", "", () => {
          code.add("TRYNEXT;");
        });
      });
    }
    code.add("ENDPROC");
  }

  private swap(to: BlockWriter): BlockWriter {
    const { out } = this;
    this.out = to;
    return out;
  }

  /** Whether the searches of a routine go on when they find nothing. One handler serves them all. */
  private searches(steps: readonly Step[]): boolean {
    const found: MoveStep[] = [];
    const look = (list: readonly Step[]): void => {
      for (const step of list) {
        if (step.type === "move" && step.until !== undefined) found.push(step);
        for (const inner of listsOf(step)) look(inner);
      }
    };
    look(steps);
    const other = found.find(step => step.until!.missing !== found[0]!.until!.missing);
    if (other !== undefined)
      throw new UnsupportedStep(
        other.id,
        `${called(other)} does something else than the search before it when nothing is found.`,
        "One routine of RAPID has one answer to that: put one of the searches into a routine of its own.",
      );
    return found[0]?.until?.missing === "continue";
  }

  protected override begin(): void {
    super.begin();
    this.acceleration = Number.NaN;
    this.tool = undefined;
  }

  protected remark(text: string, step: string): void {
    this.out.add(`!${text}`, step);
  }

  protected step(step: Step, next: Step | undefined): void {
    const add = (line: string): void => {
      this.out.add(line, step.id);
    };
    switch (step.type) {
      case "move":
        return this.move(step, next, add);
      case "wait":
        return add(`WaitTime ${part(step.s)};`);
      case "gripper":
        return add(`SetDO ${GRIPPER_SIGNAL},${step.closed ? 1 : 0};`);
      case "set":
        return this.set(step, add);
      case "wait-for":
        return this.waitFor(step, add);
      case "payload":
        return add(`GripLoad ${this.load(step)};`);
      case "message": {
        const text = asciiText(step.text).replace(/"/g, '""');
        if (text.length > LONGEST_TEXT)
          throw new UnsupportedStep(
            step.id,
            `${called(step)} says ${text.length} characters; RAPID takes ${LONGEST_TEXT}.`,
            "Say it in fewer words.",
          );
        return add(`TPWrite "${text}";`);
      }
      case "stop":
        return add("EXIT;");
      case "comment":
        return add(`!- ${asciiText(step.text)}`.trimEnd());
      case "assign":
        return add(`${assignText(step, ":=", this.words, this.place.program)};`);
      case "while":
        return this.loop(`WHILE ${this.condition(step.when, step)} DO`, "ENDWHILE", step);
      case "call":
        add(`${this.data.names.of("routine", step.routine)};`);
        return this.begin();
      case "repeat":
        return this.repeat(step);
      case "if":
        return this.choice(step, `IF ${this.condition(step.when, step)} THEN`, "ELSE", "ENDIF");
      case "pallet":
        return this.pallet(step);
    }
  }

  // --- blocks -----------------------------------------------------------------------------------------------------

  private repeat(step: Extract<Step, { type: "repeat" }>): void {
    if (step.times === "forever") this.loop("WHILE TRUE DO", "ENDWHILE", step);
    else this.loop(`FOR ${this.data.names.fresh("count")} FROM 1 TO ${step.times} DO`, "ENDFOR", step);
  }

  /** A loop over layers, lines and places; the place is the object frame of a work object that changes with them. */
  private pallet(step: Extract<Step, { type: "pallet" }>): void {
    const { program, baseFromWorld } = this.place;
    const { names } = this.data;
    const pattern = patternOf(step, program, (v, { frame }) =>
      frame === "world" ? rotate(baseFromWorld.quaternion, v) : v,
    );
    const { pallet, lines, inLine, isShifted } = pattern;
    const object = names.of("frame", step.pallet);
    const { out } = this;
    const add = (line: string): void => {
      out.add(line, step.id);
    };
    if (pallet.frame !== "world") this.frame(pallet.frame, step.id);
    this.data.add(
      `frame ${step.pallet}`,
      `PERS wobjdata ${object}:=${objectText(pallet.frame === "world" ? pose() : this.inBase(this.place.frame(pallet.frame)))};`,
      step.id,
    );
    const layer = names.fresh(`${object}_layer`);
    const line = names.fresh(`${object}_line`);
    const along = names.fresh(`${object}_along`);
    const at = names.fresh(`${object}_at`);
    this.local.add(at);
    const loop = (name: string, last: string, inside: () => void): void => {
      out.block(`FOR ${name} FROM 0 TO ${last} STEP 1 DO`, "ENDFOR", step.id, inside);
    };
    const last = isShifted ? `${inLine - 1}-${line} MOD 2` : `${inLine - 1}`;
    loop(layer, `${pallet.layers - 1}`, () => {
      loop(line, `${lines - 1}`, () => {
        loop(along, last, () => {
          add(`${at}:=${along};`);
          if (pattern.isZigzag)
            out.block(`IF ${line} MOD 2=1 THEN`, "ENDIF", step.id, () => {
              add(`${at}:=${isShifted ? inLine - 2 : inLine - 1}-${along};`);
            });
          add(`${object}.oframe:=${this.placeText(pattern, layer, line, at)};`);
          this.begin();
          this.steps(step.steps);
        });
      });
    });
    this.begin();
  }

  /**
   * Where a place is: so far along its line, so many lines and layers away, and every second line half a step further
   * where they are packed.
   */
  private placeText(
    { pallet, along_m, away_m, up_m, isShifted }: Pattern,
    layer: string,
    line: string,
    at: string,
  ): string {
    const origin =
      pallet.frame === "world"
        ? compose(this.place.baseFromWorld, compose(pose<"world", "frame">(), pallet.origin))
        : pallet.origin;
    const fine = (value_m: number): string => fixed(value_m * 1000, 5);
    const along = isShifted ? `(${at}+0.5*(${line} MOD 2))` : at;
    const parts = ([0, 1, 2] as const).map(
      i =>
        `${fine(origin.position[i])}${pitchTerm(along_m[i], along, fine)}${pitchTerm(away_m[i], line, fine)}${pitchTerm(up_m[i], layer, fine)}`,
    );
    return `[[${parts.join(",")}],${orientText(origin.quaternion)}]`;
  }

  // --- lines ------------------------------------------------------------------------------------------------------

  /** The name of a line is that of the controller's configuration: it is written as it is, or not at all. */
  private signalName(signal: string, step?: Step): string {
    if (/^[A-Za-z][A-Za-z0-9_]{0,31}$/.test(signal) && !WORDS.has(signal.toLowerCase())) {
      if (this.data.names.of("signal", signal) === signal) return signal;
    }
    if (step === undefined) return "";
    throw new UnsupportedStep(
      step.id,
      `${called(step)} uses the line "${signal}", which is no name of RAPID.`,
      "Lines have the names of the controller's configuration: letters, digits and _, at most 32, a letter first.",
    );
  }

  private lineOf(signal: string, step: Step): { readonly name: string; readonly kind: SignalLine["kind"] } {
    const name = this.signalName(signal, step);
    return { name, kind: lineKind(this.place.program, signal, step) };
  }

  private set(step: Extract<Step, { type: "set" }>, add: (line: string) => void): void {
    const { name, kind } = this.lineOf(step.signal, step);
    const { to } = step;
    checkSetting(step, kind);
    if (typeof to === "number") return add(`SetAO ${name},${part(to)};`);
    if (step.pulse_s === undefined) return add(`SetDO ${name},${to ? 1 : 0};`);
    if (!to)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} is a pulse that goes off; PulseDO goes on.`,
        "Turn the sense of the line in the controller's configuration.",
      );
    add(`PulseDO\\High\\PLength:=${part(step.pulse_s)},${name};`);
  }

  private waitFor(step: Extract<Step, { type: "wait-for" }>, add: (line: string) => void): void {
    const { when } = step;
    if (!isCondition(when)) return add(`WaitUntil ${this.condition(when, step)};`);
    const { name, kind } = this.lineOf(when.signal, step);
    const limit = step.timeout_s === undefined ? "" : `\\MaxTime:=${part(step.timeout_s)}`;
    const word = { "digital-in": "WaitDI", "digital-out": "WaitDO", "analogue-in": "WaitAI", "analogue-out": "WaitAO" }[
      kind
    ];
    if ("is" in when)
      return add(
        kind.startsWith("digital") ? `${word} ${name},${when.is ? 1 : 0}${limit};` : this.mismatch(when, step),
      );
    add(
      kind.startsWith("analogue")
        ? `${word} ${name}${"above" in when ? "\\GT" : "\\LT"},${part("above" in when ? when.above : when.below)}${limit};`
        : this.mismatch(when, step),
    );
  }

  private variableName(variable: string): string {
    return this.data.names.of("variable", variable);
  }

  private readonly words: ExpressionWords = {
    truth: ["FALSE", "TRUE"],
    number: part,
    variable: name => this.variableName(name),
    line: (signal, step, isDigital) => {
      const { name, kind } = this.lineOf(signal, step);
      const word = kind.endsWith("-in") ? "Input" : "Output";
      return isDigital ? `D${word}(${name})=1` : `A${word}(${name})`;
    },
    not: inner => `NOT ${inner}`,
    signs: BASIC_SIGNS,
    calls: {
      abs: x => `Abs(${x})`,
      sqrt: x => `Sqrt(${x})`,
      sin: x => `Sin(${x})`,
      cos: x => `Cos(${x})`,
      trunc: x => `Trunc(${x})`,
    },
    scale: PENDANT_UNITS,
  };

  private condition(when: Predicate, step: Step): string {
    if (!isCondition(when)) return expressionText(when.expression, this.words, this.place.program, step);
    const { name, kind } = this.lineOf(when.signal, step);
    const word = {
      "digital-in": "DInput",
      "digital-out": "DOutput",
      "analogue-in": "AInput",
      "analogue-out": "AOutput",
    }[kind];
    if ("is" in when)
      return kind.startsWith("digital") ? `${word}(${name})=${when.is ? 1 : 0}` : this.mismatch(when, step);
    if (!kind.startsWith("analogue")) return this.mismatch(when, step);
    return "above" in when ? `${word}(${name})>${part(when.above)}` : `${word}(${name})<${part(when.below)}`;
  }

  private mismatch(when: Condition, step: Step): never {
    throw new UnsupportedStep(
      step.id,
      `${called(step)} asks the line ${when.signal} for what it cannot answer.`,
      "Ask a digital line whether it is on, an analogue one for a limit.",
    );
  }

  // --- loads ------------------------------------------------------------------------------------------------------

  /** What the flange carries, as the controller wants it: seen from the tool in use. */
  private load(step: PayloadStep): string {
    const { mass_kg, center_m, inertia_kgm2 = [0, 0, 0, 0, 0, 0] } = step;
    if (!(mass_kg > 0)) return "load0";
    if (this.tool === undefined)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} says what is carried where the tool in use is not known; RAPID counts a load from it.`,
        "Put a move with the tool before it.",
      );
    const tcpFromFlange = inverse(this.place.tool(this.tool));
    if (inertia_kgm2.slice(3).some(each => each !== 0))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} has moments of deviation; RAPID takes moments about three axes of the load.`,
        "Give the inertia about the load's own axes.",
      );
    const center = compose(tcpFromFlange, pose<"flange", "load">(center_m));
    const [ix, iy, iz] = inertia_kgm2;
    const text = `[${part(mass_kg)},${posText(center.position)},${orientText(center.quaternion)},${part(ix)},${part(iy)},${part(iz)}]`;
    const own = this.data.names.of(`load ${text}`, "load");
    this.data.add(`load ${text}`, `CONST loaddata ${own}:=${text};`, step.id);
    return own;
  }

  // --- moves ------------------------------------------------------------------------------------------------------

  private move(step: MoveStep, next: Step | undefined, add: (line: string) => void): void {
    const { target, path } = step;
    const tool = target.tool ?? (path === "ptp" && "q" in target ? (this.tool ?? "flange") : "flange");
    this.tool = tool;
    const ratio = step.acceleration?.ratio ?? 1;
    if (ratio < LEAST_ACCELERATION)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} accelerates by ${part(100 * ratio)} %; RAPID goes down to ${100 * LEAST_ACCELERATION} %.`,
        "Let it accelerate more, or move more slowly.",
      );
    if (ratio !== this.acceleration) add(`AccSet ${part(100 * ratio)},100;`);
    this.acceleration = ratio;
    const posture = this.place.posture(step, path === "ptp" ? target : this.reached(target), this.near);
    const at = `${this.speed(step)},${this.data.zone(this.zone_mm(step, next))},${this.toolName(tool, step.id)}`;
    this.near = posture ?? this.near;
    if (path === "ptp" && !this.solves && "pose" in target && target.branch !== undefined) {
      throw new UnsupportedStep(
        step.id,
        `${called(step)} asks for a posture; what the configuration numbers of the ${this.robot.name} mean is not known here.`,
        "Teach the point as joint angles, or leave the posture to the robot.",
      );
    }
    if (path === "ptp" && "q" in target) return add(`MoveAbsJ ${this.joints(step, target.q)},${at};`);
    const frame = "q" in target ? "world" : target.frame;
    const object = frame === "world" ? "" : `\\WObj:=${this.frame(frame, step.id)}`;
    const goal = this.point(step, this.inFrame(target, frame), posture, "");
    if (step.until !== undefined) return this.search(step, goal, object, tool, add);
    if (path === "ptp") return add(`MoveJ ${goal},${at}${object};`);
    if (path === "lin") return add(`MoveL ${goal},${at}${object};`);
    add(`MoveC ${this.via(step, frame)},${goal},${at}${object};`);
  }

  /**
   * Off a joint move only the tool's pose is written: of taught angles the posture is kept, not the turns of an axis.
   */
  private reached(target: Target): Target {
    const branch = "q" in target ? branchOf(this.robot, target.q) : undefined;
    if (!("q" in target) || branch === undefined) return target;
    const { place } = this;
    return {
      pose: compose(compose(pose<"frame", "world">(), place.worldFromBase), place.tip(target)),
      frame: "world",
      tool: target.tool ?? "flange",
      branch,
    };
  }

  private via(step: MoveStep, frame: string): string {
    if (step.via === undefined)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} has no point to pass through.`,
        "Teach the point on the arc.",
      );
    return this.point(step, this.inFrame(step.via, frame), this.near, "_via");
  }

  /** A target as it is seen from a work object; both points of an arc count from one. */
  private inFrame(target: Target, frame: string): Pose<"frame", "tcp"> {
    if ("pose" in target && target.frame === frame && frame !== "world") return target.pose;
    return compose(
      inverse(frame === "world" ? pose<"base", "frame">() : this.inBase(this.place.frame(frame))),
      this.place.tip(target),
    );
  }

  private search(step: MoveStep, goal: string, object: string, tool: string, add: (line: string) => void): void {
    const { when } = step.until!;
    if (step.path !== "lin" && step.path !== "circ")
      throw new UnsupportedStep(
        step.id,
        `${called(step)} is a search along a joint move; RAPID searches on straight lines and arcs.`,
        "Make it a straight move.",
      );
    const { name, kind } = this.lineOf(when.signal, step);
    if (!("is" in when) || !kind.startsWith("digital"))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} searches for a level; RAPID searches for a digital line.`,
        "Search for a digital line.",
      );
    this.data.add("found", `VAR robtarget ${this.data.names.of("found", "found")};`);
    const found = this.data.names.of("found", "found");
    const via = step.path === "circ" ? `${this.via(step, "q" in step.target ? "world" : step.target.frame)},` : "";
    add(
      `Search${step.path === "lin" ? "L" : "C"}\\Stop,${name}\\${when.is ? "HighLevel" : "LowLevel"},${found},${via}${goal},${this.speed(step)},${this.toolName(tool, step.id)}${object};`,
    );
  }

  private zone_mm(step: MoveStep, next: Step | undefined): string {
    return step.until === undefined ? mm(this.place.blend_m(step, this.before, next)) : "0";
  }

  private joints(step: MoveStep, q: readonly number[]): string {
    const text = jointsText(shownAxes(this.section, q));
    const name = this.pointName(step, "");
    this.data.add(`point ${name}`, `CONST jointtarget ${name}:=${text};`, step.id);
    return name;
  }

  private point(
    step: MoveStep,
    inFrame: Pose<"frame", "tcp">,
    posture: readonly number[] | undefined,
    ending: string,
  ): string {
    if (!this.solves)
      this.warnings.add(
        "What the configuration numbers mean for this arm is not known here: they are written as 0 and not asked for. Try the first motion slowly.",
      );
    const text = targetText(
      inFrame,
      confText(this.robot, this.section, this.solves ? posture : undefined, this.solves),
    );
    const name = this.pointName(step, ending);
    this.data.add(`point ${name}`, `CONST robtarget ${name}:=${text};`, step.id);
    return name;
  }

  /** What a person called it, or p10, p20 and so on. */
  private pointName({ name }: MoveStep, ending: string): string {
    const stem = name === undefined || remark(name) === "" ? `p${10 * ++this.points}` : remark(name);
    return this.data.names.fresh(stem + ending);
  }

  private toolName(tool: string, step: string): string {
    if (tool === "flange") return "tool0";
    const name = this.data.names.of("tool", tool);
    this.data.add(`tool ${tool}`, `PERS tooldata ${name}:=${toolText(this.place.tool(tool))};`, step);
    return name;
  }

  private frame(frame: string, step: string): string {
    const name = this.data.names.of("frame", frame);
    if (!Object.hasOwn(this.place.program.pallets, frame))
      this.data.add(
        `frame ${frame}`,
        `PERS wobjdata ${name}:=${objectText(this.inBase(this.place.frame(frame)))};`,
        step,
      );
    return name;
  }

  private inBase<From extends string>(worldFromOther: Pose<"world", From>): Pose<"base", From> {
    return compose(this.place.baseFromWorld, worldFromOther);
  }

  private speed({ speed, path }: MoveStep): string {
    const full_mps = this.robot.maxTcpSpeed_mps;
    if ("time_s" in speed) return `v1000\\T:=${part(speed.time_s)}`;
    if ("ratio" in speed && path === "ptp")
      this.warnings.add(
        "RAPID holds speeds of the tool: a joint move at a share of the full joint speed gets that share of the tool's full speed.",
      );
    return this.data.speed(fixed(1000 * pace(speed, full_mps), 4));
  }
}

const pace = (speed: Exclude<Speed, { readonly time_s: number }>, full_mps: number): number =>
  "mps" in speed ? speed.mps : speed.ratio * full_mps;
