import {
  compose,
  inverse,
  isPassedOver,
  type Predicate,
  type EmittedFile,
  type MoveStep,
  type PalletStep,
  type PayloadStep,
  type Pose,
  type Program,
  type SetStep,
  type Step,
  type Target,
  type VendorSection,
} from "@twincell/core";
import { asciiText, singleText } from "../../parser/index.ts";
import { DataList } from "./data.ts";
import { principal } from "./inertia.ts";
import { axisText, frameText, lengthText } from "./location.ts";
import { commentText, krlName } from "./names.ts";
import { PalletLoop } from "./pallet.ts";
import {
  BlockWriter,
  corner_m,
  goesOn,
  PENDANT_UNITS,
  expressionText,
  type ExpressionWords,
  type WalkedPlace,
} from "../../emitter/index.ts";
import type { ConfigurationMap } from "./postures.ts";
import { Settings } from "./settings.ts";

/** Interrupts of searches begin here; smaller numbers are the controller's and the cell's. */
const FIRST_INTERRUPT = 21;

/** Standard beginning of every module: stop messages are dealt with, speeds and frames as delivered. */
const INI = [
  ";FOLD INI",
  "GLOBAL INTERRUPT DECL 3 WHEN $STOPMESS==TRUE DO IR_STOPM( )",
  "INTERRUPT ON 3",
  "BAS(#INITMOV,0)",
  ";ENDFOLD (INI)",
];

/** The module: a .src that says only what changes from one step to the next, and the .dat with its points. */
export class ModuleWriter {
  readonly data = new DataList();
  private readonly program: Program;
  private readonly place: WalkedPlace;
  private readonly convention: VendorSection;
  private readonly postures: ConfigurationMap;
  private readonly name: string;
  private readonly gripper: number;
  private readonly routineNames = new Map<string, string>();
  private readonly palletBases = new Map<string, string>();
  /** Routines of searches, behind the program. */
  private readonly behind = new BlockWriter();
  private readonly settings: Settings;
  private out = new BlockWriter();
  private group = "";
  private points = 0;
  private searches = 0;
  private isMain = true;

  constructor(place: WalkedPlace, convention: VendorSection, configurations: ConfigurationMap, gripper: number) {
    this.program = place.program;
    this.place = place;
    this.convention = convention;
    this.postures = configurations;
    this.gripper = gripper;
    this.settings = new Settings(place.robot.maxTcpSpeed_mps);
    this.name = krlName(place.program.name, this.data.taken);
    for (const name of Object.keys(place.program.routines)) this.routineNames.set(name, krlName(name, this.data.taken));
  }

  write(): EmittedFile[] {
    const { out, program } = this;
    out.add("&ACCESS RVP");
    out.add("&REL 1");
    out.add(`&COMMENT ${asciiText(program.name)}`);
    out.add(`DEF ${this.name}( )`);
    out.depth = 1;
    for (const line of INI) out.add(line);
    this.steps(program.steps, undefined);
    this.fold("");
    out.depth = 0;
    out.add("END");
    this.isMain = false;
    for (const [name, steps] of Object.entries(program.routines)) this.routine(this.routineNames.get(name)!, steps);
    out.append(this.behind);
    return [out.file(`${this.name}.src`), this.data.file(this.name)];
  }

  private routine(name: string, steps: readonly Step[]): void {
    const { out } = this;
    out.add("");
    out.add(`DEF ${name}( )`);
    out.depth = 1;
    this.settings.forget();
    this.steps(steps, undefined);
    this.fold("");
    out.depth = 0;
    out.add("END");
  }

  /** @param after  what follows the list, where that is known. */
  private steps(steps: readonly Step[], after: Step | undefined): void {
    for (let i = 0; i < steps.length; i++) {
      const step = steps[i]!;
      const next = steps.slice(i + 1).find(each => !isPassedOver(each)) ?? after;
      if (step.type !== "move" || step.path !== "spline") {
        this.step(
          step,
          next,
          steps.slice(0, i).findLast(each => !isPassedOver(each)),
        );
        continue;
      }
      const block = [step];
      for (
        let following = steps[i + 1];
        following?.type === "move" && following.path === "spline" && toolName(following) === toolName(step);
        following = steps[i + 1]
      ) {
        block.push(following);
        i++;
      }
      this.spline(block, steps.slice(i + 1).find(each => !isPassedOver(each)) ?? after);
    }
  }

  private step(step: Step, next: Step | undefined, before: Step | undefined): void {
    const add = (line: string): void => {
      this.out.add(line, step.id);
    };
    this.title(step);
    switch (step.type) {
      case "move":
        return this.move(step, next, before);
      case "wait":
        return add(`WAIT SEC ${singleText(step.s)}`);
      case "gripper":
        return add(`${this.data.gripper(this.gripper)}=${step.closed ? "TRUE" : "FALSE"}`);
      case "set":
        return add(this.set(step));
      case "wait-for":
        return add(`WAIT FOR ${this.condition(step.when, step)}`);
      case "payload":
        return add(payloadText(step));
      case "message":
        return add(`MsgNotify("${asciiText(step.text).replace(/"/g, "'")}")`);
      case "stop":
        return this.block(
          step.id,
          "LOOP",
          () => {
            add("HALT");
          },
          "ENDLOOP",
        );
      case "comment":
        return add(`;* ${commentText(step.text)}`);
      case "assign":
        return add(`${this.words.variable(step.variable)}=${expressionText(step.to, this.words, this.program, step)}`);
      default:
        return this.flow(step, next);
    }
  }

  /** What calls, repeats and decides. */
  private flow(
    step: Exclude<
      Step,
      { type: "move" | "wait" | "gripper" | "set" | "wait-for" | "payload" | "message" | "stop" | "comment" | "assign" }
    >,
    next: Step | undefined,
  ): void {
    const add = (line: string): void => {
      this.out.add(line, step.id);
    };
    switch (step.type) {
      case "call":
        add(`${this.routineNames.get(step.routine)!}( )`);
        return this.settings.forget();
      case "repeat": {
        const head =
          step.times === "forever"
            ? "LOOP"
            : `FOR ${this.data.counter(`ROUND_${step.name ?? this.out.count}`)}=1 TO ${step.times}`;
        return this.block(
          step.id,
          head,
          () => {
            this.steps(step.steps, undefined);
          },
          step.times === "forever" ? "ENDLOOP" : "ENDFOR",
        );
      }
      case "while":
        return this.block(
          step.id,
          `WHILE ${this.condition(step.when, step)}`,
          () => {
            this.steps(step.steps, undefined);
          },
          "ENDWHILE",
        );
      case "if":
        this.block(
          step.id,
          `IF ${this.condition(step.when, step)} THEN`,
          () => {
            this.steps(step.then, next);
          },
          step.else === undefined ? "ENDIF" : "",
        );
        if (step.else !== undefined)
          this.block(
            step.id,
            "ELSE",
            () => {
              this.steps(step.else!, next);
            },
            "ENDIF",
          );
        return;
      case "pallet":
        return this.pallet(step);
    }
  }

  /** A block is entered and left from several sides: what the controller keeps is said again inside and behind. */
  private block(id: string, head: string, body: () => void, end: string): void {
    this.out.add(head, id);
    this.out.depth++;
    this.settings.forget();
    const { group } = this;
    this.group = "";
    body();
    this.fold("");
    this.group = group;
    this.settings.forget();
    this.out.depth--;
    if (end !== "") this.out.add(end, id);
  }

  private pallet(step: PalletStep): void {
    const loop = new PalletLoop(step, this.program.pallets[step.pallet]!, this.out, this.data, this.place);
    loop.begin();
    this.palletBases.set(step.pallet, loop.base);
    this.settings.forget();
    const { group } = this;
    this.group = "";
    this.steps(step.steps, undefined);
    this.fold("");
    this.group = group;
    this.settings.forget();
    this.palletBases.delete(step.pallet);
    loop.end();
  }

  /** Name and group of a step. */
  private title(step: Step): void {
    this.fold(step.group === undefined ? "" : commentText(this.program.groups[step.group]?.name ?? step.group));
    const name = commentText(step.name ?? "");
    if (name !== "") this.out.add(`;${name}`, step.id);
  }

  private fold(group: string): void {
    if (group === this.group) return;
    if (this.group !== "") this.out.add(`;ENDFOLD (${this.group})`);
    if (group !== "") this.out.add(`;FOLD ${group}`);
    this.group = group;
  }

  private readonly words: ExpressionWords = {
    truth: ["FALSE", "TRUE"],
    number: singleText,
    variable: name => this.data.variable(name, this.program.variables![name]!),
    line: signal => this.signal(signal),
    not: inner => `NOT ${inner}`,
    signs: {
      and: " AND ",
      or: " OR ",
      "=": "==",
      "<>": "<>",
      "<": "<",
      "<=": "<=",
      ">": ">",
      ">=": ">=",
      "+": "+",
      "-": "-",
      "*": "*",
      "/": "/",
      // Whole numbers divide to whole numbers.
      div: "/",
      mod: (a, b) => `${a}-${a}/${b}*${b}`,
    },
    calls: {
      sqrt: x => `SQRT(${x})`,
      sin: x => `SIN(${x})`,
      cos: x => `COS(${x})`,
    },
    scale: PENDANT_UNITS,
    real: text => `1.0*${text}`,
    comparesTruth: true,
  };

  private set({ signal, to, pulse_s }: SetStep): string {
    const variable = this.signal(signal);
    const value = typeof to === "number" ? singleText(to) : to ? "TRUE" : "FALSE";
    return pulse_s === undefined ? `${variable}=${value}` : `PULSE(${variable},${value},${singleText(pulse_s)})`;
  }

  private signal(name: string): string {
    return this.data.signal(name, this.program.signals[name]!);
  }

  private condition(when: Predicate, step: Step): string {
    if ("expression" in when) return expressionText(when.expression, this.words, this.program, step);
    const variable = this.signal(when.signal);
    if ("is" in when) return when.is ? variable : `NOT ${variable}`;
    return "above" in when ? `${variable}>${singleText(when.above)}` : `${variable}<${singleText(when.below)}`;
  }

  // Motion
  // --------------------------------------------------------------------------------------------------------------

  private move(step: MoveStep, next: Step | undefined, before: Step | undefined): void {
    const add = (line: string): void => {
      this.out.add(line, step.id);
    };
    const base = this.baseOf(step);
    const tool = toolName(step) ?? "flange";
    // Joint angles are what they are with any tool and in any base.
    if (!("q" in step.target && step.path === "ptp")) this.frames(step.id, tool, base);
    else if (toolName(step) !== undefined) this.frames(step.id, tool, this.settings.base);
    for (const line of this.settings.pace(step)) add(line);
    const isPassed = step.until === undefined && goesOn(this.place, next, this.isMain);
    const passing = this.settings.passing(
      isPassed ? step : { ...step, blend_ratio: 0 },
      isPassed ? corner_m(this.place, step, before, next) : 0,
    );
    for (const line of passing.lines) add(line);
    const word = step.path === "ptp" ? "PTP" : step.path === "circ" ? "CIRC" : "LIN";
    const point = this.point(step, step.target, base, tool, "");
    const via =
      step.path === "circ" && step.via !== undefined ? `${this.point(step, step.via, base, tool, "_VIA")},` : "";
    const line = `${word} ${via}${point}${passing.word}`;
    if (step.until === undefined) add(line);
    else this.search(step, line);
  }

  private spline(block: readonly MoveStep[], next: Step | undefined): void {
    const [first] = block;
    const last = block.at(-1)!;
    const bases = new Set(block.map(step => this.baseOf(step)));
    // One block has one base.
    const base = bases.size === 1 ? this.baseOf(first!) : "world";
    const tool = toolName(first!) ?? "flange";
    this.frames(first!.id, tool, base);
    const passing = this.settings.passing(
      { ...last, blend_ratio: 0 },
      goesOn(this.place, next, this.isMain) ? corner_m(this.place, last, block.at(-2), next) : 0,
    );
    for (const line of passing.lines) this.out.add(line, last.id);
    this.title(first!);
    this.out.add("SPLINE", first!.id);
    this.out.depth++;
    for (const [i, step] of block.entries()) {
      if (i > 0) this.title(step);
      const settings = this.settings.once(step);
      this.out.add(
        `SPL ${this.point(step, step.target, base, tool, "")}${settings.length === 0 ? "" : ` WITH ${settings.join(",")}`}`,
        step.id,
      );
    }
    this.out.depth--;
    this.out.add(`ENDSPLINE${passing.word === "" ? "" : " C_SPL"}`, last.id);
  }

  private frames(id: string, tool: string, base: string | undefined): void {
    const { settings, data, place } = this;
    if (tool !== settings.tool)
      this.out.add(
        tool === "flange" ? "$TOOL=$NULLFRAME" : `$TOOL=${data.frame("TOOL_", tool, () => place.tool(tool))}`,
        id,
      );
    settings.tool = tool;
    if (base === undefined || base === settings.base) return;
    const pallet = this.palletBases.get(base);
    this.out.add(
      base === "world"
        ? "$BASE=$NULLFRAME"
        : `$BASE=${pallet ?? data.frame("BASE_", base, () => compose(place.vendorFromWorld, place.worldFromFrame(base)))}`,
      id,
    );
    settings.base = base;
  }

  /** The frame that the points of a step are written in. Joint angles and points of the world count from the robot. */
  private baseOf({ target }: MoveStep): string {
    if ("q" in target) return "world";
    return target.frame === "world" ||
      (!this.palletBases.has(target.frame) && !Object.hasOwn(this.program.frames, target.frame))
      ? "world"
      : target.frame;
  }

  /** Declares a point and returns its name. */
  private point(step: MoveStep, target: Target, base: string, tool: string, suffix: string): string {
    if (suffix === "") this.points++;
    const variable = krlName(
      `${step.name === undefined ? `P${this.points}` : commentText(step.name)}${suffix}`,
      this.data.taken,
      "X",
    );
    if ("q" in target && step.path === "ptp") {
      this.data.add(`DECL E6AXIS ${variable}={${axisText(target.q, this.convention)}}`, step.id);
      return variable;
    }
    const pose = frameText(this.inBase(target, base, tool));
    const configuration = suffix === "" ? this.postures.get(step.id) : undefined;
    const status = configuration?.status === undefined ? "" : `,S ${configuration.status}`;
    const turn = configuration?.turn === undefined || step.path !== "ptp" ? "" : `,T ${configuration.turn}`;
    this.data.add(`DECL E6POS ${variable}={${pose}${status}${turn}}`, step.id);
    return variable;
  }

  private inBase(target: Target, base: string, tool: string): Pose {
    if ("pose" in target && target.frame === base && base !== "world") return target.pose;
    const { place } = this;
    const rootFromTcp: Pose = compose(place.vendorFromWorld, place.worldFromTarget(target, tool));
    if (base === "world") return rootFromTcp;
    return compose(inverse(place.worldFromFrame(base)) as Pose, place.worldFromTarget(target, tool) as Pose);
  }

  /** A motion in a routine of its own, which an interrupt leaves as soon as the signal is met. */
  private search(step: MoveStep, line: string): void {
    const { taken } = this.data;
    const n = FIRST_INTERRUPT + this.searches++;
    const name = krlName(`SEARCH_${this.searches}`, taken);
    const met = krlName(`MET_${this.searches}`, taken);
    const add = (text: string): void => {
      this.out.add(text, step.id);
    };
    add(`INTERRUPT DECL ${n} WHEN ${this.condition(step.until!.when, step)} DO ${met}( )`);
    add(`INTERRUPT ON ${n}`);
    add(`${name}( )`);
    add(`INTERRUPT OFF ${n}`);
    const { behind } = this;
    const body = [
      `DEF ${name}( )`,
      `  ${line}`,
      "  WAIT SEC 0",
      ...(step.until!.missing === "fault" ? ["  LOOP", "    HALT", "  ENDLOOP"] : []),
      "END",
      "",
      `DEF ${met}( )`,
      `  INTERRUPT OFF ${n}`,
      "  BRAKE",
      "  RESUME",
      "END",
    ];
    behind.add("");
    for (const text of body) behind.add(text, step.id);
    // Wherever the search ended, what follows starts from there.
  }
}

/** The tool that a step needs: on a path the tip, on a joint motion to joint angles any. */
function toolName({ path, target }: MoveStep): string | undefined {
  return target.tool ?? (path === "ptp" ? undefined : "flange");
}

function payloadText({ mass_kg, center_m, inertia_kgm2 }: PayloadStep): string {
  const [x, y, z] = center_m.map(lengthText);
  const main = principal(inertia_kgm2 ?? [0, 0, 0, 0, 0, 0]);
  const [a, b, c] = main.abc_deg.map(singleText);
  const [jx, jy, jz] = main.moments.map(singleText);
  return `$LOAD={M ${singleText(mass_kg)},CM {X ${x},Y ${y},Z ${z},A ${a},B ${b},C ${c}},J {X ${jx},Y ${jy},Z ${jz}}}`;
}
