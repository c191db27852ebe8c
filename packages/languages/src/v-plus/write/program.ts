import { branchOf, compose, inverse, millimetres, type Branch, type EmittedFile, type MoveStep, type Program, type Speed, type Step, type Target } from "@twincell/core";
import { asciiText, singleText } from "../../text/index.ts";
import type { JointConvention } from "../robots.ts";
import { ppointText, transText } from "./location.ts";
import { commentText, vPlusName } from "./names.ts";
import { toolOf, worldFromTarget, type Place, type PostureMap } from "./postures.ts";
import { TextWriter } from "./text-writer.ts";

/** The words of the controller for a branch: shoulder, elbow, wrist. */
const words = ({ shoulder, elbow, wrist }: Branch): string[] =>
  [shoulder === "front" ? "RIGHTY" : "LEFTY", elbow === "up" ? "ABOVE" : "BELOW", wrist === "positive" ? "NOFLIP" : "FLIP"];

/** The runnable program (E-08): says only what changes from one step to the next. */
export class ProgramWriter {
  private readonly program: Program;
  private readonly place: Place;
  private readonly convention: JointConvention;
  private readonly q_rad: PostureMap;
  private readonly out = new TextWriter();
  private readonly toolNames = new Map<string, string>();
  private tool = "flange";
  private speed = "";
  private branch = "";
  private group = "";

  constructor(program: Program, place: Place, convention: JointConvention, q_rad: PostureMap) {
    this.q_rad = q_rad;
    this.program = program;
    this.place = place;
    this.convention = convention;
  }

  write(): EmittedFile {
    const { program, out, place } = this;
    const name = vPlusName(program.name);
    out.add(`.PROGRAM ${name}() ;${asciiText(program.name)}`);
    out.add(`  ;* ${asciiText(place.robot.name)}. Lengths in mm, angles in degrees, the world at the shoulder.`);
    for (const tool of this.toolsUsed()) {
      const variable = vPlusName(tool, new Set(this.toolNames.values()));
      this.toolNames.set(tool, variable);
      out.add(`  SET ${variable} = ${transText(toolOf(place, tool))}`);
    }
    for (const [i, step] of program.steps.entries()) this.step(step, program.steps[i + 1]);
    out.add(".END");
    return out.file(`${name}.v2`);
  }

  private toolsUsed(): Set<string> {
    const names = this.program.steps.flatMap(step => step.type === "move" ? [toolName(step) ?? "flange"] : []);
    return new Set(names.filter(name => name !== "flange"));
  }

  private step(step: Step, next: Step | undefined): void {
    const add = (line: string): void => { this.out.add(`  ${line}`, step.id); };
    const group = step.group === undefined ? "" : commentText(this.program.groups[step.group]?.name ?? step.group);
    if (group !== this.group) add(`;== ${group}`.trimEnd());
    this.group = group;
    const name = commentText(step.name ?? "");
    if (name !== "") add(`;${name}`);
    switch (step.type) {
      case "wait": return add(`DELAY ${singleText(step.s)}`);
      case "gripper": return add(step.closed ? "CLOSEI" : "OPENI");
      case "move": return this.move(step, next, add);
    }
  }

  private move(step: MoveStep, next: Step | undefined, add: (line: string) => void): void {
    const tool = toolName(step) ?? this.tool;
    if (tool !== this.tool) add(tool === "flange" ? "TOOL NULL" : `TOOL ${this.toolNames.get(tool)!}`);
    this.tool = tool;
    const speed = speedLine(step.speed);
    if (speed !== this.speed) add(speed);
    this.speed = speed;
    if ("time_s" in step.speed) add(`DURATION ${singleText(step.speed.time_s)}`);
    this.configure(step, add);
    add(`${step.path === "lin" ? "MOVES" : "MOVE"} ${this.location(step.target)}`);
    if (this.stops(step, next)) add("BREAK");
  }

  /**
   * A controller keeps its posture until it is told another, so every transformation is told the one it is reached in.
   * A precision point says its posture itself.
   */
  private configure({ id, target }: MoveStep, add: (line: string) => void): void {
    const branch = "q" in target ? undefined : branchOf(this.place.robot, this.q_rad.get(id)!);
    const said = branch === undefined ? [] : words(branch);
    if (said.join() !== this.branch) for (const word of said) add(word);
    this.branch = said.join();
  }

  private location(target: Target): string {
    if ("q" in target) return ppointText(target.q, this.convention);
    const { place } = this;
    const baseFromTcp = compose(inverse(place.worldFromBase), worldFromTarget(place, target));
    return transText(compose(inverse(place.robot.baseFromVendorWorld), baseFromTcp));
  }

  /** The path goes on without a stop only into another motion with the same tool. */
  private stops(step: MoveStep, next: Step | undefined): boolean {
    return !(step.blend_m > 0) || next?.type !== "move" || (toolName(next) ?? this.tool) !== this.tool;
  }
}

/** The tool that a step needs: on a straight line the tip, on a joint motion to joint angles any. */
function toolName({ path, target }: MoveStep): string | undefined {
  return target.tool ?? (path === "lin" ? "flange" : undefined);
}

function speedLine(speed: Speed): string {
  if ("ratio" in speed) return `SPEED ${singleText(speed.ratio * 100)} ALWAYS`;
  if ("mps" in speed) return `SPEED ${singleText(millimetres(speed.mps))} MMPS ALWAYS`;
  return "SPEED 100 ALWAYS";
}
