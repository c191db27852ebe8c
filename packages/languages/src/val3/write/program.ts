import {
  branchOf,
  compose,
  inverse,
  pose,
  rotate,
  isCondition,
  isPassedOver,
  type Predicate,
  type EmittedFile,
  type MoveStep,
  type PalletStep,
  type Pose,
  type SignalLine,
  type Step,
  type VendorSection,
  type Target,
  type Vector3,
  wristAboveZero,
} from "@twincell/core";
import { asciiText } from "../../parser/index.ts";
import {
  BlockStepWriter,
  BlockWriter,
  PENDANT_UNITS,
  UnsupportedStep,
  assignText,
  called,
  expressionText,
  fixed,
  patternOf,
  pitchTerm,
  remark,
  type ExpressionWords,
  type Place,
  shownAxes,
  lineKind,
  checkSetting,
} from "../../emitter/index.ts";
import { GRIPPER, VALVE, configWords } from "../robots.ts";
import { DataList, RESERVED, attributes, jointAttributes, sixOf, trsfAttributes } from "./data.ts";

const HEADER = '<?xml version="1.0" encoding="utf-8"?>';
const XSI = 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"';
const VAL3 = "http://www.staubli.com/robotics/VAL3";
/** No limit of the tool's speed, in mm/s and degrees a second. */
const UNLIMITED = "99999";
const LONGEST_TEXT = 127;
/** A pitch is added many times over: it is written to ten nanometres. */
const fine = (length_m: number): string => fixed(length_m * 1000, 5);

/** Writes the programs, the data and the project of an application. */
export class ApplicationWriter extends BlockStepWriter {
  private readonly data = new DataList();
  private local: string[] = [];
  private inMain = true;
  private points = 0;
  private tool: string | undefined;
  /** Whether motions may be under way that what follows must not overtake. */
  private moving = false;
  private readonly section: VendorSection;

  constructor(place: Place, section: VendorSection) {
    super(place);
    this.section = section;
  }

  write(): readonly EmittedFile[] {
    const { program } = this.place;
    const { names } = this.data;
    const title = names.of("project", program.name);
    const programs: EmittedFile[] = [];
    for (const signal of Object.keys(program.signals)) this.signalName(signal);
    for (const routine of Object.keys(program.routines)) names.of("routine", routine);
    const main = this.program("start", program.steps, true);
    for (const [routine, steps] of Object.entries(program.routines))
      programs.push(this.program(names.of("routine", routine), steps, false));
    const stop = this.program("stop", [], false);
    const all = [main, ...programs, stop];
    return [...all, this.dataFile(title), this.project(title, all)];
  }

  private program(name: string, steps: readonly Step[], isMain: boolean): EmittedFile {
    const body = new BlockWriter();
    const file = new BlockWriter();
    this.out = body;
    this.local = [];
    this.inMain = isMain;
    this.begin();
    this.tool = isMain ? "flange" : undefined;
    this.moving = !isMain;
    body.indented(() => {
      if (isMain) body.add(`//* ${asciiText(this.place.program.name)}`.trimEnd());
      this.steps(steps);
      this.settle("");
    });
    file.add(HEADER);
    file.block(`<Programs ${XSI} xmlns="${VAL3}/Program/2">`, "</Programs>", "", () => {
      file.block(
        `<Program name="${name}" access="${isMain || name === "stop" ? "public" : "private"}">`,
        "</Program>",
        "",
        () => {
          if (this.local.length > 0)
            file.block("<Locals>", "</Locals>", "", () => {
              for (const each of this.local) file.add(`<Local name="${each}" type="num" xsi:type="array" size="1"/>`);
            });
          file.add("<Code><![CDATA[");
          file.add("begin");
          file.append(body);
          file.add("end");
          file.add("]]></Code>");
        },
      );
    });
    return file.file(`${name}.pgx`, "\r\n");
  }

  private dataFile(title: string): EmittedFile {
    const out = new BlockWriter();
    out.add(HEADER);
    out.block(`<Database ${XSI} xmlns="${VAL3}/Data/2">`, "</Database>", "", () => {
      out.block("<Datas>", "</Datas>", "", () => {
        for (const { name, type, value, step } of this.data.all)
          out.block(
            `<Data name="${name}" access="private" xsi:type="array" type="${type}" size="1">`,
            "</Data>",
            step,
            () => {
              out.add(`<Value key="0"${value}/>`, step);
            },
          );
      });
    });
    return out.file(`${title}.dtx`, "\r\n");
  }

  private project(title: string, programs: readonly EmittedFile[]): EmittedFile {
    const out = new BlockWriter();
    out.add(HEADER);
    out.block(`<Project ${XSI} xmlns="${VAL3}/Project/3">`, "</Project>", "", () => {
      out.add('<Parameters version="s7.0" stackSize="5000" millimeterUnit="true"/>');
      out.block("<Programs>", "</Programs>", "", () => {
        for (const { name } of programs) out.add(`<Program file="${name}"/>`);
      });
      out.block("<Database>", "</Database>", "", () => {
        out.add(`<Data file="${title}.dtx"/>`);
      });
      out.add("<Libraries/>");
    });
    return out.file(`${title}.pjx`, "\r\n");
  }

  // --- steps ------------------------------------------------------------------------------------------------------

  protected override begin(): void {
    super.begin();
    this.tool = undefined;
    this.moving = true;
  }

  protected remark(text: string, step: string): void {
    this.out.add(`//${text}`, step);
  }

  /** Motions are put on a list and carried out beside the program: what is no motion waits for their end. */
  private settle(step: string): void {
    if (this.moving) this.out.add("waitEndMove()", step);
    this.moving = false;
  }

  protected override inside(steps: readonly Step[], step: string): void {
    super.inside(steps, step);
    this.settle(step);
  }

  protected step(step: Step, next: Step | undefined): void {
    const add = (line: string): void => {
      this.out.add(line, step.id);
    };
    if (step.type !== "move" && !isPassedOver(step)) this.settle(step.id);
    switch (step.type) {
      case "move":
        return this.move(step, next, add);
      case "wait":
        return add(`delay(${fixed(step.s, 6)})`);
      case "gripper":
        this.data.add(GRIPPER, "tool", `${trsfAttributes(pose())} fatherId="flange[0]" ioLink="${VALVE}"`, "");
        return add(`${step.closed ? "close" : "open"}(${GRIPPER})`);
      case "set":
        return this.set(step, add);
      case "wait-for":
        return this.waitFor(step, add);
      case "message": {
        const text = asciiText(step.text).replace(/"/g, "'");
        if (text.length > LONGEST_TEXT || text.includes("]]>"))
          throw new UnsupportedStep(
            step.id,
            `${called(step)} says ${text.length} characters; VAL 3 takes ${LONGEST_TEXT} without "]]>".`,
            "Say it in other words.",
          );
        return add(`putln("${text}")`);
      }
      default:
        return this.flow(step);
    }
  }

  /** What ends, repeats and decides. */
  private flow(step: Exclude<Step, { type: "move" | "wait" | "gripper" | "set" | "wait-for" | "message" }>): void {
    const add = (line: string): void => {
      this.out.add(line, step.id);
    };
    switch (step.type) {
      case "stop":
        this.onlyInMain(step, "ends the program");
        return add("return");
      case "comment":
        return add(`//- ${asciiText(step.text).replaceAll("]]>", "]] >")}`.trimEnd());
      case "assign":
        return add(assignText(step, "=", this.words, this.place.program));
      case "while":
        return this.loop(`while ${this.condition(step.when, step)}`, "endWhile", step);
      case "call":
        add(`call ${this.data.names.of("routine", step.routine)}()`);
        return this.begin();
      case "repeat":
        return this.repeat(step);
      case "if":
        return this.choice(step, `if ${this.condition(step.when, step)}`, "else", "endIf");
      case "pallet":
        return this.pallet(step, add);
      // Declared under `cannot`.
      case "payload":
        throw new UnsupportedStep(step.id, `${called(step)} says a load.`, "Set the load in the settings of the arm.");
    }
  }

  private onlyInMain(step: Step, what: string): void {
    if (!this.inMain)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} ${what} inside a routine; return of VAL 3 only leaves the routine.`,
        "Put the step into the program itself.",
      );
  }

  private counter(name: string): string {
    const own = this.data.names.fresh(`l_${name}`);
    this.local.push(own);
    return own;
  }

  private repeat(step: Extract<Step, { type: "repeat" }>): void {
    if (step.times === "forever") this.loop("while true", "endWhile", step);
    else this.loop(`for ${this.counter("count")}=1 to ${step.times} step 1`, "endFor", step);
  }

  /** Loops over layers, lines and places; the place is a frame that is put from one to the next. */
  private pallet(step: PalletStep, add: (line: string) => void): void {
    const { program } = this.place;
    const { pallet, lines, inLine, isShifted, isZigzag, ...pitch } = patternOf(step, program);
    const vendorFromFrame = this.place.vendorFromFrame(pallet.frame);
    const first = compose(vendorFromFrame, pallet.origin);
    const frame = this.frame(step.pallet, step.id);
    const [layer, line, along, at] = ["layer", "line", "along", "at"].map(word => this.counter(word)) as [
      string,
      string,
      string,
      string,
    ];
    const last = isShifted ? `${inLine - 1}-(${line}%2)` : `${inLine - 1}`;
    const [along_m, away_m, up_m] = [pitch.along_m, pitch.away_m, pitch.up_m].map(v =>
      rotate(vendorFromFrame.quaternion, v),
    ) as [Vector3, Vector3, Vector3];
    const place = `{${sixOf(first)
      .map((text, i) =>
        i > 2
          ? text
          : `${text}${isShifted ? pitchTerm(along_m[i]! / 2, `(2*${at}+(${line}%2))`, fine) : pitchTerm(along_m[i]!, at, fine)}${pitchTerm(away_m[i]!, line, fine)}${pitchTerm(up_m[i]!, layer, fine)}`,
      )
      .join(",")}}`;
    const loop = (name: string, to: string, inside: () => void): void => {
      this.out.block(`for ${name}=0 to ${to} step 1`, "endFor", step.id, inside);
    };
    loop(layer, `${pallet.layers - 1}`, () => {
      loop(line, `${lines - 1}`, () => {
        loop(along, last, () => {
          add(`${at}=${along}`);
          if (isZigzag)
            this.out.block(`if (${line}%2)==1`, "endIf", step.id, () => {
              add(`${at}=${last}-${along}`);
            });
          this.settle(step.id);
          add(`${frame}.trsf=${place}`);
          this.inside(step.steps, step.id);
        });
      });
    });
    this.begin();
  }

  // --- lines ------------------------------------------------------------------------------------------------------

  /** A line is a variable that is linked to the controller's line: it is written by its name, or not at all. */
  private signalName(signal: string, step?: Step): string {
    if (
      /^[A-Za-z][A-Za-z0-9_]{0,14}$/.test(signal) &&
      !RESERVED.has(signal.toLowerCase()) &&
      this.data.names.of("signal", signal) === signal
    )
      return signal;
    if (step === undefined) return "";
    throw new UnsupportedStep(
      step.id,
      `${called(step)} uses the line "${signal}", which is no name of VAL 3.`,
      "Lines have names of letters, digits and _, at most 15, a letter first.",
    );
  }

  private lineOf(signal: string, step: Step): { readonly name: string; readonly kind: SignalLine["kind"] } {
    const name = this.signalName(signal, step);
    const kind = lineKind(this.place.program, signal, step);
    this.data.add(name, kind.startsWith("digital") ? "dio" : "aio", ' link=""', "");
    return { name, kind };
  }

  private set(step: Extract<Step, { type: "set" }>, add: (line: string) => void): void {
    const { name, kind } = this.lineOf(step.signal, step);
    const { to } = step;
    checkSetting(step, kind);
    add(typeof to === "number" ? `aioSet(${name},${fixed(to, 6)})` : `${name}=${to}`);
  }

  private readonly words: ExpressionWords = {
    truth: ["false", "true"],
    number: value => fixed(value, 9),
    variable: name => {
      const isTruth = this.place.program.variables![name]!.type === "bool";
      const type = isTruth ? "bool" : "num";
      return this.data.add(
        this.data.names.of("variable", name),
        type,
        attributes([["value", isTruth ? "false" : "0"]]),
        "",
      );
    },
    line: (signal, step, isDigital) => {
      const { name } = this.lineOf(signal, step);
      return isDigital ? `${name}==true` : `aioGet(${name})`;
    },
    not: inner => `!${inner}`,
    signs: {
      and: " and ",
      or: " or ",
      "=": "==",
      "<>": "!=",
      "<": "<",
      "<=": "<=",
      ">": ">",
      ">=": ">=",
      "+": "+",
      "-": "-",
      "*": "*",
      "/": "/",
      mod: "%",
    },
    calls: { abs: x => `abs(${x})`, sqrt: x => `sqrt(${x})`, sin: x => `sin(${x})`, cos: x => `cos(${x})` },
    scale: PENDANT_UNITS,
  };

  private condition(when: Predicate, step: Step): string {
    if (!isCondition(when)) return expressionText(when.expression, this.words, this.place.program, step);
    const { name, kind } = this.lineOf(when.signal, step);
    if ("is" in when !== kind.startsWith("digital"))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} asks the line ${when.signal} for what it cannot answer.`,
        "Ask a digital line whether it is on, an analogue one for a limit.",
      );
    if ("is" in when) return `${name}==${when.is}`;
    return "above" in when ? `aioGet(${name})>${fixed(when.above, 6)}` : `aioGet(${name})<${fixed(when.below, 6)}`;
  }

  private waitFor(step: Extract<Step, { type: "wait-for" }>, add: (line: string) => void): void {
    const when = this.condition(step.when, step);
    if (step.timeout_s === undefined) return add(`wait(${when})`);
    this.onlyInMain(step, "may end the program");
    this.out.block(`if !watch(${when},${fixed(step.timeout_s, 6)})`, "endIf", step.id, () => {
      add("return");
    });
  }

  // --- motions ----------------------------------------------------------------------------------------------------

  private move(step: MoveStep, next: Step | undefined, add: (line: string) => void): void {
    const { target, path, id } = step;
    const isAngles = path === "ptp" && "q" in target;
    const tool = target.tool ?? (isAngles ? (this.tool ?? "flange") : "flange");
    const configuration = this.place.posture(step, isAngles ? target : this.place.asPose(target), this.near);
    const frame = "q" in target ? "world" : target.frame;
    this.near = configuration ?? this.near;
    this.tool = tool;
    this.moving = true;
    const rest = `${this.toolName(tool, id)},${this.description(step, next)}`;
    if (isAngles)
      return add(
        `movej(${this.data.add(this.pointName(step, ""), "jointRx", jointAttributes(shownAxes(this.section, target.q)), id)},${rest})`,
      );
    const goal = this.point(step, target, frame, configuration, "");
    const word = path === "ptp" ? "movej" : path === "lin" ? "movel" : "movec";
    if (path !== "circ") return add(`${word}(${goal},${rest})`);
    if (step.via === undefined)
      throw new UnsupportedStep(id, `${called(step)} has no point to pass through.`, "Teach the point on the arc.");
    add(`${word}(${this.point(step, step.via, frame, configuration, "_via")},${goal},${rest})`);
  }

  private point(
    step: MoveStep,
    target: Target,
    frame: string,
    configuration: readonly number[] | undefined,
    ending: string,
  ): string {
    const inFrame =
      "pose" in target && target.frame === frame && frame !== "world"
        ? target.pose
        : compose(
            inverse(
              frame === "world"
                ? pose<"base", "frame">(
                    this.place.robot.baseFromVendorWorld.position,
                    this.place.robot.baseFromVendorWorld.quaternion,
                  )
                : compose(this.place.baseFromWorld, this.place.frame(frame)),
            ),
            this.place.tip(target),
          );
    const [shoulder, elbow, wrist] = configWords(
      configuration === undefined ? undefined : branchOf(this.place.robot, configuration),
      wristAboveZero(this.place.robot),
    );
    const father = frame === "world" ? "world" : this.frame(frame, step.id);
    return this.data.add(
      this.pointName(step, ending),
      "pointRx",
      `${trsfAttributes(inFrame)}${attributes([
        ["shoulder", shoulder],
        ["elbow", elbow],
        ["wrist", wrist],
        ["fatherId", `${father}[0]`],
      ])}`,
      step.id,
    );
  }

  private pointName({ name }: MoveStep, ending: string): string {
    const stem = name === undefined || remark(name) === "" ? `p${10 * ++this.points}` : remark(name);
    return this.data.names.fresh(stem + ending);
  }

  /** A frame stands in the world of the controller; that of a pallet in the frame of the pallet. */
  private frame(frame: string, step: string): string {
    const {
      program: { pallets },
      robot,
      baseFromWorld,
    } = this.place;
    const name = this.data.names.of("frame", frame);
    const pallet = Object.hasOwn(pallets, frame) ? pallets[frame] : undefined;
    if (pallet !== undefined && pallet.frame !== "world") {
      const father = this.frame(pallet.frame, step);
      return this.data.add(name, "frame", `${trsfAttributes(pose())} fatherId="${father}[0]"`, step);
    }
    const at: Pose =
      pallet === undefined
        ? compose(inverse(robot.baseFromVendorWorld), compose(baseFromWorld, this.place.frame(frame)))
        : pose();
    return this.data.add(name, "frame", `${trsfAttributes(at)} fatherId="world[0]"`, step);
  }

  private toolName(tool: string, step: string): string {
    return tool === "flange"
      ? "flange"
      : this.data.add(
          this.data.names.of("tool", tool),
          "tool",
          `${trsfAttributes(this.place.tool(tool))} fatherId="flange[0]" ioLink="${VALVE}"`,
          step,
        );
  }

  /** How a motion is made: speeds, accelerations, and how near its end is passed. */
  private description(step: MoveStep, next: Step | undefined): string {
    const { speed, path } = step;
    const full_mps = this.place.robot.maxTcpSpeed_mps;
    const percent = (ratio: number): string => fixed(100 * ratio, 5);
    const isJoint = path === "ptp";
    const ratio = "ratio" in speed ? speed.ratio : "mps" in speed ? speed.mps / full_mps : 1;
    const mps = "mps" in speed ? speed.mps : ratio * full_mps;
    const acceleration = percent(step.acceleration?.ratio ?? 1);
    const blend_mm = fixed(1000 * this.place.blend_m(step, this.before, next), 4);
    const passes = blend_mm !== "0";
    const value = attributes([
      ["accel", acceleration],
      ["vel", isJoint ? percent(Math.min(1, ratio)) : "100"],
      ["decel", acceleration],
      ["tmax", isJoint ? UNLIMITED : fixed(mps * 1000, 4)],
      ["rmax", UNLIMITED],
      ["blend", passes ? (isJoint ? "joint" : "Cartesian") : "off"],
      ["leave", passes ? blend_mm : "50"],
      ["reach", passes ? blend_mm : "50"],
    ]);
    return this.data.add(this.data.names.of(`mdesc ${value}`, "m"), "mdesc", value, step.id);
  }
}
