import {
  branchOf,
  compose,
  flangeOfTcp,
  listsOf,
  nearestSolution,
  pose,
  rotate,
  isCondition,
  type Predicate,
  type EmittedFile,
  type MoveStep,
  type Pose,
  type Robot,
  type SignalLine,
  type Step,
  type Target,
} from "@twincell/core";
import { asciiText } from "../../parser/index.ts";
import {
  BlockStepWriter,
  UnsupportedStep,
  Names,
  Place,
  assignText,
  expressionText,
  linesLookedAt,
  called,
  patternOf,
  pitchTerm,
  type ExpressionWords,
  type Pattern,
} from "../../emitter/index.ts";
import { DIGITAL_LINES, fullJointSpeed } from "../robots.ts";
import { RESERVED, TAKEN } from "./reserved.ts";
import { controllerFromBase, listText, num, poseText } from "./pose.ts";

/** Names longer than this are cut. */
const LONGEST_NAME = 40;

/** The script: one program, its routines inside it; says only what changes from one step to the next. */
export class ProgramWriter extends BlockStepWriter {
  readonly warnings = new Set<string>();
  private readonly robot: Robot;
  private readonly names = new Names({
    most: LONGEST_NAME,
    reserved: new Set([...RESERVED, ...TAKEN]),
    first: "p_",
    foldsCase: false,
  });
  private readonly loops = new Names({ most: LONGEST_NAME, reserved: new Set(), first: "i_", foldsCase: false });
  private tool = "";

  constructor(place: Place) {
    super(place);
    this.robot = place.robot;
  }

  write(): EmittedFile {
    const { program } = this.place;
    const { out } = this;
    const name = this.names.of("program", program.name);
    out.block(`def ${name}():`, "end", "", () => {
      out.add(`#* ${asciiText(program.name)}`.trimEnd());
      out.add(`#* ${asciiText(this.robot.name)}. Lengths in m, angles in rad, poses in the base of the controller.`);
      this.declarations();
      for (const [routine, steps] of Object.entries(program.routines)) {
        this.begin();
        out.block(`def ${this.names.of("routine", routine)}():`, "end", "", () => {
          this.steps(steps);
        });
      }
      this.begin();
      this.steps(program.steps);
    });
    return out.file(`${name}.script`, "\n");
  }

  /** Tools, frames and lines under the names that they have in the program. */
  private declarations(): void {
    const { place, out } = this;
    const { program } = place;
    const used = usedNames([program.steps, ...Object.values(program.routines)]);
    for (const tool of used.tools) out.add(`global ${this.names.of("tool", tool)} = ${poseText(place.tool(tool))}`);
    for (const pallet of used.pallets)
      if (Object.hasOwn(program.pallets, pallet) && program.pallets[pallet]!.frame !== "world")
        used.frames.add(program.pallets[pallet]!.frame);
    for (const frame of used.frames)
      if (!Object.hasOwn(program.pallets, frame))
        out.add(`global ${this.names.of("frame", frame)} = ${this.inController(place.frame(frame))}`);
    for (const [variable, { type }] of Object.entries(program.variables ?? {}))
      out.add(`global ${this.words.variable(variable)} = ${type === "bool" ? "False" : "0"}`);
    for (const [signal, step] of used.signals) {
      const line = Object.hasOwn(program.signals, signal) ? program.signals[signal] : undefined;
      if (line?.address === undefined)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} uses the line ${signal}, whose number is not known.`,
          "Give the line its number in the list of signals.",
        );
      out.add(`global ${this.names.of("signal", signal)} = ${routeOf(line, line.address, step, signal).number}`);
    }
  }

  private inController<From extends string>(pose: Pose<"world", From>): string {
    const { place } = this;
    return poseText(compose(compose(controllerFromBase(this.robot), place.baseFromWorld), pose));
  }

  protected override begin(): void {
    super.begin();
    this.tool = "";
  }

  protected remark(text: string, step: string): void {
    this.out.add(`#${text}`, step);
  }

  protected step(step: Step, next: Step | undefined): void {
    const { out } = this;
    const add = (line: string): void => {
      out.add(line, step.id);
    };
    switch (step.type) {
      case "move":
        return this.move(step, next, add);
      case "wait":
        return add(`sleep(${num(step.s)})`);
      case "gripper":
        return add(`set_tool_digital_out(0, ${truth(step.closed)})`);
      case "set":
        return this.set(step, add);
      case "wait-for":
        return out.block(`while ${this.until(step.when, step)}:`, "end", step.id, () => {
          add("sync()");
        });
      case "payload": {
        const center = listText(step.center_m);
        return add(
          step.inertia_kgm2 === undefined
            ? `set_payload(${num(step.mass_kg)}, ${center})`
            : `set_target_payload(${num(step.mass_kg)}, ${center}, ${listText(step.inertia_kgm2)})`,
        );
      }
      case "message":
        return add(`textmsg("${asciiText(step.text).replace(/"/g, "'")}")`);
      case "stop":
        return add("halt");
      case "comment":
        return add(`#- ${asciiText(step.text)}`.trimEnd());
      case "assign":
        return add(assignText(step, " = ", this.words, this.place.program));
      case "while":
        return this.loop(`while ${this.condition(step.when, step)}:`, "end", step);
      case "call":
        add(`${this.names.of("routine", step.routine)}()`);
        return this.begin();
      case "repeat":
        return this.repeat(step);
      case "if":
        return this.choice(step, `if ${this.condition(step.when, step)}:`, "else:", "end");
      case "pallet":
        return this.pallet(step);
    }
  }

  private repeat(step: Extract<Step, { type: "repeat" }>): void {
    if (step.times === "forever") return this.loop("while True:", "end", step);
    this.counted(this.names.fresh(this.loops.fresh("count")), `${step.times}`, step.id, () => {
      this.inside(step.steps, step.id);
    });
    this.begin();
  }

  private counted(variable: string, times: string, id: string, inside: () => void): void {
    this.out.add(`${variable} = 0`, id);
    this.out.block(`while ${variable} < ${times}:`, "end", id, () => {
      inside();
      this.out.add(`${variable} = ${variable} + 1`, id);
    });
  }

  /** A loop over layers, lines and places; the place is a frame that changes with them. */
  private pallet(step: Extract<Step, { type: "pallet" }>): void {
    const { program, baseFromWorld } = this.place;
    const controllerFromWorld = compose(controllerFromBase(this.robot), baseFromWorld);
    const pattern = patternOf(step, program, (v, { frame }) =>
      frame === "world" ? rotate(controllerFromWorld.quaternion, v) : v,
    );
    const { pallet, lines, inLine, isShifted } = pattern;
    const variable = this.names.of("frame", step.pallet);
    const { out } = this;
    const line = this.names.fresh(`${variable}_line`);
    const along = this.names.fresh(`${variable}_along`);
    const layer = this.names.fresh(`${variable}_layer`);
    const at = this.names.fresh(`${variable}_at`);
    const count = isShifted ? `${inLine} - ${line} % 2` : `${inLine}`;
    const visit = (): void => {
      out.add(`${at} = ${along}`, step.id);
      if (pattern.isZigzag) {
        out.block(`if ${line} % 2 == 1:`, "end", step.id, () => {
          out.add(`${at} = ${isShifted ? inLine - 2 : inLine - 1} - ${along}`, step.id);
        });
      }
      out.add(`global ${variable} = ${this.placeText(pattern, controllerFromWorld, layer, line, at)}`, step.id);
      this.begin();
      this.steps(step.steps);
    };
    this.counted(layer, `${pallet.layers}`, step.id, () => {
      this.counted(line, `${lines}`, step.id, () => {
        this.counted(along, count, step.id, visit);
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
    controllerFromWorld: Pose<"controller", "world">,
    layer: string,
    line: string,
    at: string,
  ): string {
    const isFree = pallet.frame === "world";
    const origin = isFree
      ? compose(controllerFromWorld, compose(pose<"world", "frame">(), pallet.origin))
      : pallet.origin;
    const term = (pitch_m: number, factor: string): string => pitchTerm(pitch_m, factor, fine, " ");
    const along = isShifted ? `(${at} + 0.5 * (${line} % 2))` : at;
    const place = ([0, 1, 2] as const).map(
      i => `${fine(origin.position[i])}${term(along_m[i], along)}${term(away_m[i], line)}${term(up_m[i], layer)}`,
    );
    const turn = poseText(pose([0, 0, 0], origin.quaternion)).slice("p[0, 0, 0, ".length, -1);
    const text = `p[${place.join(", ")}, ${turn}]`;
    return isFree ? text : `pose_trans(${this.names.of("frame", pallet.frame)}, ${text})`;
  }

  private set(step: Extract<Step, { type: "set" }>, add: (line: string) => void): void {
    const route = this.door(step.signal, step);
    const { to } = step;
    if (route.isInput)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} writes the line ${step.signal}, which is an input.`,
        "Choose an output.",
      );
    if (route.isDigital !== (typeof to === "boolean"))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} writes ${String(to)} to the ${route.isDigital ? "digital" : "analogue"} line ${step.signal}.`,
        "Choose a value of that line.",
      );
    if (typeof to === "number" && !(to >= 0 && to <= 1))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} writes ${to} to an analogue output; the controller takes 0 to 1.`,
        "Give it as a share of the full output.",
      );
    add(
      `set_${route.name}_out(${this.names.of("signal", step.signal)}, ${typeof to === "boolean" ? truth(to) : num(to)})`,
    );
  }

  private read(signal: string, step: Step): string {
    const route = this.door(signal, step);
    return `get_${route.name}_${route.isInput ? "in" : "out"}(${this.names.of("signal", signal)})`;
  }

  private readonly words: ExpressionWords = {
    truth: ["False", "True"],
    number: num,
    variable: name => this.names.of("variable", name),
    line: (signal, step) => this.read(signal, step),
    not: inner => `not ${inner}`,
    signs: {
      and: " and ",
      or: " or ",
      "=": " == ",
      "<>": " != ",
      "<": " < ",
      "<=": " <= ",
      ">": " > ",
      ">=": " >= ",
      "+": " + ",
      "-": " - ",
      "*": " * ",
      "/": " / ",
    },
    calls: {
      sqrt: x => `sqrt(${x})`,
      sin: x => `sin(${x})`,
      cos: x => `cos(${x})`,
    },
    scale: {},
    real: text => `1.0 * ${text}`,
  };

  private condition(when: Predicate, step: Step): string {
    if (!isCondition(when)) return expressionText(when.expression, this.words, this.place.program, step);
    const read = this.read(when.signal, step);
    if ("is" in when) return when.is ? read : `not ${read}`;
    return "above" in when ? `${read} > ${num(when.above)}` : `${read} < ${num(when.below)}`;
  }

  /** As long as this is true, the condition is not. */
  private until(when: Predicate, step: Step): string {
    return "is" in when ? this.condition({ ...when, is: !when.is }, step) : `not (${this.condition(when, step)})`;
  }

  private door(signal: string, step: Step): Route {
    const { signals } = this.place.program;
    const line = Object.hasOwn(signals, signal) ? signals[signal] : undefined;
    if (line?.address === undefined)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the line ${signal}, whose number is not known.`,
        "Give the line its number in the list of signals.",
      );
    return routeOf(line, line.address, step, signal);
  }

  private move(step: MoveStep, next: Step | undefined, add: (line: string) => void): void {
    const { target, path } = step;
    const tool = target.tool ?? (path === "ptp" && "q" in target ? undefined : "flange");
    if (tool !== undefined && tool !== this.tool) {
      add(tool === "flange" ? "set_tcp(p[0, 0, 0, 0, 0, 0])" : `set_tcp(${this.names.of("tool", tool)})`);
      this.tool = tool;
    }
    const configuration = this.place.posture(step, path === "ptp" ? target : this.reached(target), this.near);
    const blend = this.place.blend_m(step, this.before, next);
    const pace = this.pace(step);
    const radius = num(blend) === "0" ? "" : `, r=${num(blend)}`;
    if (path === "ptp") add(`movej(${this.jointGoal(target, configuration)}, ${pace}${radius})`);
    else if (path === "lin") add(`movel(${this.goal(target)}, ${pace}${radius})`);
    else {
      if (step.via === undefined)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} has no point to pass through.`,
          "Teach the point on the arc.",
        );
      add(`movec(${this.goal(step.via)}, ${this.goal(target)}, ${pace}${radius})`);
    }
    this.near = configuration ?? this.near;
  }

  /** Off a joint move the tool is led, and the arm arrives in the posture nearest to the one before. */
  private reached(target: Target): Target {
    const { place } = this;
    return {
      pose: compose(compose(pose<"frame", "world">(), place.worldFromBase), place.tip(target)),
      frame: "world",
      tool: target.tool ?? "flange",
    };
  }

  /** The posture in as few decimals as still lead to it. */
  private nearest(target: Target, configuration: readonly number[]): string {
    const { place, robot } = this;
    const baseFromFlange = flangeOfTcp(
      place.worldFromBase,
      compose(place.worldFromBase, place.tip(target)),
      place.tool(target.tool),
    );
    const found = new Float64Array(configuration.length);
    for (const decimals of [1, 2, 3, 4, 5]) {
      const near = configuration.map(angle => Number(angle.toFixed(decimals)));
      if (
        nearestSolution(robot, baseFromFlange, near, found) &&
        found.every((angle, i) => Math.abs(angle - configuration[i]!) < 1e-3)
      )
        return listText(near);
    }
    return listText(configuration);
  }

  private goal(target: Target): string {
    if ("q" in target) return listText(target.q);
    if (target.frame === "world") return poseText(compose(controllerFromBase(this.robot), this.place.tip(target)));
    return `pose_trans(${this.names.of("frame", target.frame)}, ${poseText(target.pose)})`;
  }

  /**
   * A pose alone is reached in the posture nearest to where the arm is; a branch that was taught is asked for by its
   * angles.
   */
  private jointGoal(target: Target, configuration: readonly number[] | undefined): string {
    if (
      "q" in target ||
      target.branch === undefined ||
      configuration === undefined ||
      branchOf(this.robot, configuration) === undefined
    )
      return this.goal(target);
    return `get_inverse_kin(${this.goal(target)}, ${this.nearest(target, configuration)})`;
  }

  private pace({ id, name, path, speed }: MoveStep): string {
    const full_rad_s = fullJointSpeed(this.robot)!;
    const full_mps = this.robot.maxTcpSpeed_mps;
    if ("time_s" in speed) {
      if (path === "circ")
        throw new UnsupportedStep(
          id,
          `${called({ id, ...(name === undefined ? {} : { name }) })} is an arc of given duration; movec takes a speed.`,
          "Give the arc a speed.",
        );
      return `t=${num(speed.time_s)}`;
    }
    if (path !== "ptp") return `v=${num("mps" in speed ? speed.mps : speed.ratio * full_mps)}`;
    if ("ratio" in speed) return `v=${num(speed.ratio * full_rad_s)}`;
    this.warnings.add(
      "movej takes a speed of the joints: a joint move of given tool speed gets its share of the full speed.",
    );
    return `v=${num(Math.min(1, speed.mps / full_mps) * full_rad_s)}`;
  }
}

const truth = (value: boolean): string => (value ? "True" : "False");
/** A pitch is added many times over: it is written to a tenth of a micrometre. */
const fine = (value: number): string => {
  const text = value.toFixed(7).replace(/\.?0+$/, "");
  return text === "-0" ? "0" : text;
};

interface Route {
  readonly name: string;
  readonly number: number;
  readonly isInput: boolean;
  readonly isDigital: boolean;
}

/** Which function reads or writes a line, and under which number. */
function routeOf({ kind }: SignalLine, address: number, step: Step, signal: string): Route {
  const isInput = kind.endsWith("in");
  const isDigital = kind.startsWith("digital");
  const { standard, configurable, tool } = DIGITAL_LINES;
  const whole = Number.isInteger(address) && address >= 0;
  if (!whole) throw noLine(address, step, signal);
  if (!isDigital) {
    if (address < 2) return { name: "standard_analog", number: address, isInput, isDigital };
    if (isInput && address < 4) return { name: "tool_analog", number: address - 2, isInput, isDigital };
  } else if (address < standard) return { name: "standard_digital", number: address, isInput, isDigital };
  else if (address < standard + configurable)
    return { name: "configurable_digital", number: address - standard, isInput, isDigital };
  else if (address < standard + configurable + tool)
    return { name: "tool_digital", number: address - standard - configurable, isInput, isDigital };
  throw noLine(address, step, signal);
}

const noLine = (address: number, step: Step, signal: string): UnsupportedStep =>
  new UnsupportedStep(
    step.id,
    `${called(step)} uses the line ${signal} with the number ${address}; the controller has digital lines 0 to 17, analogue outputs 0 to 1 and analogue inputs 0 to 3.`,
    "Give the line a number of the controller; 16 and 17 are digital lines at the tool, 2 and 3 analogue inputs there.",
  );

/** Tools, frames and lines in the order in which steps first use them. */
function usedNames(lists: readonly (readonly Step[])[]): {
  tools: Set<string>;
  frames: Set<string>;
  pallets: Set<string>;
  signals: Map<string, Step>;
} {
  const tools = new Set<string>();
  const frames = new Set<string>();
  const pallets = new Set<string>();
  const signals = new Map<string, Step>();
  const note = (signal: string, step: Step): void => {
    if (!signals.has(signal)) signals.set(signal, step);
  };
  const look = (steps: readonly Step[]): void => {
    for (const step of steps) {
      switch (step.type) {
        case "move":
          for (const target of step.via === undefined ? [step.target] : [step.via, step.target]) {
            if (target.tool !== undefined && target.tool !== "flange") tools.add(target.tool);
            if ("pose" in target && target.frame !== "world") frames.add(target.frame);
          }
          break;
        case "set":
          note(step.signal, step);
          break;
        case "pallet":
          pallets.add(step.pallet);
          break;
        default:
          for (const signal of linesLookedAt(step)) note(signal, step);
      }
      for (const inner of listsOf(step)) look(inner);
    }
  };
  for (const steps of lists) look(steps);
  return { tools, frames, pallets, signals };
}
