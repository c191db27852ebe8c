import type { MoveStep, Speed, Target } from "@twincell/core";
import { TextError, nameIn } from "../../parser/index.ts";
import type { Expression } from "../../parser/structured/index.ts";
import { Arguments } from "./arguments.ts";
import type { Confdata } from "./configuration.ts";
import { inverted, times, toPose } from "./frame.ts";
import { jointsOf, toolFrameOf, zoneOf } from "./records.ts";
import { WORLD, type WorkObject } from "./work-objects.ts";
import { asFrame, asNumbers, asRecord } from "./values.ts";
import { Routines } from "./routines.ts";

interface Motion {
  readonly goal: Expression;
  readonly via?: Expression;
  readonly speed: Expression;
  readonly zone?: Expression;
  readonly tool: Expression;
}

/** Motions of RAPID with their tools, work objects and speeds. */
export abstract class Motions extends Routines {
  protected move(name: "moveabsj" | "movej" | "movel" | "movec", args: Arguments, id: string): MoveStep {
    const shift = name === "movec" ? 1 : 0;
    const motion: Motion = {
      goal: args.given(shift, "a target"),
      speed: args.given(shift + 1, "a speed"),
      zone: args.given(shift + 2, "a zone"),
      tool: args.given(shift + 3, "a tool"),
      ...(shift === 0 ? {} : { via: args.given(0, "a point on the arc") }),
    };
    return this.motion(name, motion, args, id);
  }

  protected search(name: "searchl" | "searchc", args: Arguments, id: string): MoveStep {
    const signal = this.lines.line(args.nameOf(0, "a line"), "digital-in");
    const shift = name === "searchc" ? 1 : 0;
    if (args.has("flanks"))
      throw new TextError(args.at, "\\PosFlank or \\NegFlank", "A search for either edge is not executed here.");
    const motion: Motion = {
      goal: args.given(2 + shift, "a target"),
      speed: args.given(3 + shift, "a speed"),
      tool: args.given(4 + shift, "a tool"),
      ...(shift === 0 ? {} : { via: args.given(2, "a point on the arc") }),
    };
    const routine = this.scopes.at(-1)?.routine ?? "";
    const is = !args.has("negflank") && !args.has("lowlevel");
    return {
      ...this.motion(name === "searchl" ? "movel" : "movec", motion, args, id),
      until: { when: { signal, is }, missing: this.source.forgiving.has(routine) ? "continue" : "fault" },
    };
  }

  private motion(
    name: "moveabsj" | "movej" | "movel" | "movec",
    motion: Motion,
    args: Arguments,
    id: string,
  ): MoveStep {
    const { goal, via } = motion;
    const tool = this.useTool(motion.tool);
    const object = args.optionGiven("wobj");
    const speed = this.speed(motion.speed, args);
    const blend_m = motion.zone === undefined ? 0 : zoneOf(this.evaluate(motion.zone), args.option("z"), motion.zone);
    const acceleration = this.acceleration < 1 ? { acceleration: { ratio: this.acceleration } } : {};
    const common = { id, type: "move", speed, ...acceleration, blend_m } as const;
    if (name === "moveabsj") {
      const joints = jointsOf(this.evaluate(goal), goal);
      this.arm.atJoints(joints);
      return { ...common, path: "ptp", target: { q: this.arm.axes.radians(joints), tool } };
    }
    const frame = object === undefined ? WORLD : this.workObject(object);
    const target = this.target(goal, frame, tool, name === "movej", true);
    const passing = via === undefined ? {} : { via: this.target(via, frame, tool, false, false) };
    return { ...common, path: name === "movej" ? "ptp" : name === "movel" ? "lin" : "circ", target, ...passing };
  }

  private useTool(tool: Expression): string {
    if (tool.kind === "variable" && this.isHeldElsewhere(tool.name)) {
      this.remark(
        `tool ${tool.name}`,
        tool,
        "the module that declares the tool",
        `The tool ${this.spelt(tool.name)} is declared in no file that is open: the flange is taken for it.`,
      );
      this.tool = { mm: [0, 0, 0], wxyz: [1, 0, 0, 0] };
      this.arm.tool = this.tool;
      return nameIn(this.declared.tools, toPose<"flange", "tcp">(this.tool), this.spelt(tool.name), "_");
    }
    this.tool = toolFrameOf(this.evaluate(tool), tool);
    this.arm.tool = this.tool;
    if (tool.kind === "variable" && tool.name === "tool0") return "flange";
    return nameIn(
      this.declared.tools,
      toPose<"flange", "tcp">(this.tool),
      tool.kind === "variable" ? this.spelt(tool.name) : "tool",
      "_",
    );
  }

  private workObject(object: Expression): WorkObject {
    if (object.kind !== "variable" || !this.isHeldElsewhere(object.name))
      return this.objects.of(object, of => this.evaluate(of));
    this.remark(
      `object ${object.name}`,
      object,
      "the module that declares the work object",
      `The work object ${this.spelt(object.name)} is declared in no file that is open: the base of the robot is taken for it.`,
    );
    return WORLD;
  }

  /** A point that no file declares: nobody can go there. */
  protected leaveOut(goal: Expression): boolean {
    let of = goal;
    while (of.kind === "call" && of.args[0]?.value !== undefined && SHIFTS.has(of.name)) of = of.args[0].value;
    if (of.kind !== "variable" || !this.isHeldElsewhere(of.name)) return false;
    this.remark(
      `point ${of.name}`,
      goal,
      "the module that declares the point",
      `The motion to ${this.spelt(of.name)} is left out: no file that is open declares the point. The robot goes on to the next point from where it is.`,
    );
    this.lost = "The robot was to be at a point that no open file declares.";
    return true;
  }

  private target(
    expression: Expression,
    frame: WorkObject,
    tool: string,
    choosesPosture: boolean,
    isEnd: boolean,
  ): Target {
    const [trans, rot, conf] = asRecord(this.evaluate(expression), expression, 4, "a robtarget [[…],[…],[…],[…]]");
    const inFrame = asFrame([trans!, rot!], expression);
    const tip = times(frame.base, inFrame);
    const [cf1, cf4, cf6, cfx] = asNumbers(conf, expression, 4, "a configuration [cf1,cf4,cf6,cfx]");
    const isNamed = frame.name !== "world";
    const pose = isNamed ? toPose<"frame", "tcp">(inFrame) : this.arm.world<"frame", "tcp">(tip);
    if (!isEnd) return { pose, frame: frame.name, tool };
    const asked: Confdata | undefined = this.asksConfiguration ? [cf1!, cf4!, cf6!, cfx!] : undefined;
    const branch = this.arm.atFlange(
      times(tip, inverted(this.tool)),
      choosesPosture || this.asksConfiguration ? asked : undefined,
    );
    return { pose, frame: frame.name, tool, ...(branch === undefined || !this.asksConfiguration ? {} : { branch }) };
  }

  private speed(expression: Expression, args: Arguments): Speed {
    const time = args.option("t");
    if (time !== undefined && time > 0) return { time_s: time };
    const [tcp] = asNumbers(this.evaluate(expression), expression, 4, "a speed [v_tcp,v_ori,v_leax,v_reax]");
    const v_mmps = Math.min((args.option("v") ?? tcp!) * this.override, this.fastest_mmps);
    if (!(v_mmps > 0)) throw new TextError(expression, "a speed above 0", `The speed is ${v_mmps} mm/s.`);
    return { mps: v_mmps / 1000 };
  }
}

/** Functions that shift a point. */
const SHIFTS = new Set(["offs", "reltool"]);
