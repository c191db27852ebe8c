import type { MoveStep, Pose, Speed, Target, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Do, Expression } from "../../parser/structured/index.ts";
import { inverted, times, toPose, type Trsf } from "./trsf.ts";
import { isList, kindOf, type Description, type Point } from "./values.ts";
import { NO_LIMIT } from "./kept-data.ts";
import { Evaluation } from "./evaluation.ts";

/** Motions of VAL 3 with their tools, frames and speeds. */
export abstract class Motions extends Evaluation {
  /** A point that no open file has: nobody can go there. */
  protected leaveOut(goal: Expression): boolean {
    let of = goal;
    while (of.kind === "call" && (of.name === "appro" || of.name === "compose") && of.args[0]?.value !== undefined)
      of = of.args[0].value;
    const name = of.kind === "variable" || of.kind === "index" ? this.nameOf(of) : undefined;
    if (name === undefined || this.variable(name) !== undefined) return false;
    this.remark(
      `point ${name}`,
      goal,
      "the data of the application",
      `The motion to ${name} is left out: no file that is open has the point. The robot goes on to the next point from where it is.`,
    );
    this.lost = "The robot was to be at a point that no open file has.";
    return true;
  }

  protected motion(word: "movej" | "movel" | "movec", { args, line, column }: Do, id: string): MoveStep {
    const at = { line, column };
    const shift = word === "movec" ? 1 : 0;
    const goal = this.given(args, shift, word, at);
    const toolAt = this.given(args, shift + 1, word, at);
    const tool = this.of("tool", toolAt);
    const how = this.of("mdesc", this.given(args, shift + 2, word, at));
    const name = this.toolName(tool.trsf, this.nameOf(toolAt) ?? "tool");
    const value = this.evaluate(goal);
    const ratio = Math.min(1, how.accel / 100);
    const blend_m = how.blend === "off" ? 0 : Math.min(how.leave, how.reach) / 1000;
    if (!(ratio > 0)) throw new TextError(goal, "an acceleration above 0", `The acceleration is ${how.accel} %.`);
    const common = {
      id,
      type: "move",
      speed: this.speed(how, word === "movej", goal),
      ...(ratio < 1 ? { acceleration: { ratio } } : {}),
      blend_m,
    } as const;
    this.moving = true;
    this.lost = undefined;
    const via =
      word === "movec"
        ? { via: this.target(this.of("point", this.given(args, 0, word, at)), name, tool.trsf, "on-the-way", at) }
        : {};
    if (typeof value === "object" && !isList(value) && value.kind === "joint") {
      if (word !== "movej") throw new TextError(goal, "a point", `${word} goes to a point.`);
      const q = this.arm.axes.radians(value.deg);
      this.arm.joints_rad = q;
      return { ...common, path: "ptp", target: { q, tool: name } };
    }
    return {
      ...common,
      path: word === "movej" ? "ptp" : word === "movel" ? "lin" : "circ",
      target: this.target(this.of("point", goal), name, tool.trsf, word === "movej" ? "by-joints" : "by-path", at),
      ...via,
    };
  }

  private speed({ vel, tmax }: Description, isJoint: boolean, at: TextPlace): Speed {
    if (!(vel > 0) || !(tmax > 0))
      throw new TextError(at, "speeds above 0", `The speeds are ${vel} % and ${tmax} mm/s.`);
    return isJoint || tmax >= NO_LIMIT ? { ratio: Math.min(1, vel / 100) } : { mps: tmax / 1000 };
  }

  private target(
    point: Point,
    tool: string,
    toolTrsf: Trsf,
    how: "by-joints" | "by-path" | "on-the-way",
    at: TextPlace,
  ): Target {
    const father = this.father(point.father, at);
    const tip = times(father, point.trsf);
    const frame = this.frameName(point.father, at);
    const pose: Pose<"frame", "tcp"> = frame === "world" ? this.arm.cell(tip) : toPose(point.trsf);
    if (how === "on-the-way") return { pose, frame, tool };
    const { branch, fits } = this.arm.atFlange(times(tip, inverted(toolTrsf)), point.config);
    if (how === "by-joints" && !fits)
      throw new TextError(
        at,
        "a configuration that reaches the point",
        `The point is not reached ${Object.values(point.config).join(", ")}.`,
      );
    return { pose, frame, tool, ...(branch === undefined ? {} : { branch }) };
  }

  /** A frame that the program changes is none to count from, except the place of a pallet. */
  private frameName(name: string, at: TextPlace): string {
    if (name === "world" || this.places.has(name)) return name;
    if (this.changing.has(name)) return "world";
    this.declared.frames[name] ??= this.arm.cell(this.father(name, at));
    return name;
  }

  private toolName(trsf: Trsf, name: string): string {
    if (name === "flange") return name;
    const tool = toPose<"flange", "tcp">(trsf);
    const known = this.declared.tools[name];
    if (known === undefined || JSON.stringify(known) === JSON.stringify(tool)) {
      this.declared.tools[name] = tool;
      return name;
    }
    return this.toolName(trsf, `${name}_2`);
  }

  placeIn(variable: string): { readonly frame: string; readonly pose: Pose<"frame", "place"> } | undefined {
    if (kindOf(this.globals.get(variable)) !== "frame" || !this.changing.has(variable)) return undefined;
    const at = { line: 1, column: 1 };
    const { trsf, father } = this.of("frame", { kind: "variable", name: variable, ...at });
    if (father === "world" || this.changing.has(father))
      return { frame: "world", pose: this.arm.cell(times(this.father(father, at), trsf)) };
    return { frame: this.frameName(father, at), pose: toPose(trsf) };
  }
}
