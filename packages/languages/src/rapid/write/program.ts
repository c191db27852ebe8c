import {
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
  type Step,
} from "@twincell/core";
import { asciiText } from "../../parser/index.ts";
import {
  BlockWriter,
  UnsupportedStep,
  assignText,
  expressionText,
  called,
  fixed,
  patternOf,
  pitchTerm,
  type Pattern,
  checkSetting,
} from "../../emitter/index.ts";
import { GRIPPER_SIGNAL } from "../robots.ts";
import { objectText, orientText, part, posText } from "./data.ts";
import { MotionWriter } from "./motions.ts";

const LONGEST_TEXT = 80;

/** The module: data first, then the routines; says only what changes from one step to the next. */
export class ProgramWriter extends MotionWriter {
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

  protected variableName(variable: string): string {
    return this.data.names.of("variable", variable);
  }

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
}
