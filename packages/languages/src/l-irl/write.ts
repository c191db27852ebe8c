import {
  compose,
  degrees,
  inverse,
  isSlide,
  millimetres,
  toKukaAbc,
  type Branch,
  type CommentStep,
  type EmittedFile,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Step,
  type Target,
} from "@twincell/core";
import { asciiText } from "../parser/index.ts";
import { BlockWriter, UnsupportedStep, Names, called, fixed } from "../emitter/index.ts";

/** First line of every list: version, unit of length and of angle, order of the turns, what poses count from. */
export const headerLine = (from: "BASE" | "WORLD"): string => `POSES 1 MM DEG ZYX ${from}`;

/** A text in quotes; quotes inside are doubled. */
export const quoted = (text: string): string => `"${text.replaceAll('"', '""')}"`;

/** x y z [mm] a b c [deg],  R = Rz(a) · Ry(b) · Rx(c). */
export function poseNumbers({ position, quaternion }: Pose): string {
  const angles = toKukaAbc([...quaternion]);
  return [
    ...position.map(v => fixed(millimetres(v), MM_DECIMALS)),
    ...angles.map(angle => fixed(angle, DEG_DECIMALS)),
  ].join(" ");
}
const MM_DECIMALS = 4;
const DEG_DECIMALS = 5;
const PACE_DECIMALS = 6;

const PATH_WORDS: Readonly<Record<MoveStep["path"], string>> = {
  ptp: "PTP",
  lin: "LIN",
  circ: "CIRCLE",
  spline: "SPLINE",
};

/** Writes a program without blocks as a pose list, line by line. */
export class ListWriter {
  private readonly program: Program;
  private readonly robot: Robot;
  private readonly baseFromWorld: Pose<"base", "world">;
  private readonly out = new BlockWriter();
  private readonly names = new Names({
    most: 60,
    reserved: new Set(["flange", "world"]),
    first: "n",
    foldsCase: false,
  });

  constructor(program: Program, robot: Robot, worldFromBase: Pose<"world", "base">) {
    this.program = program;
    this.robot = robot;
    this.baseFromWorld = inverse(worldFromBase);
  }

  /** @throws {UnsupportedStep} at the first step that has no line. */
  write(): EmittedFile {
    const { program, out, names } = this;
    out.add(headerLine("BASE"));
    out.add(
      "{* Lengths in mm, angles in degrees. A pose is X Y Z A B C with R = Rz(A) Ry(B) Rx(C), from the base of the robot or in a FRAME.}",
    );
    out.add(`ROBOT ${quoted(asciiText(this.robot.id))}`);
    out.add(`PROGRAM ${quoted(asciiText(program.name))}`);
    for (const [name, flangeFromTcp] of Object.entries(program.tools))
      out.add(`TOOL ${names.of("tool", name)} ${poseNumbers(flangeFromTcp)}`);
    for (const [name, worldFromFrame] of Object.entries(program.frames))
      out.add(`FRAME ${names.of("frame", name)} ${poseNumbers(compose(this.baseFromWorld, worldFromFrame))}`);
    for (const [id, group] of Object.entries(program.groups))
      out.add(`GROUP ${names.of("group", id)} ${quoted(asciiText(group.name))}`);
    for (const step of program.steps) out.add(this.line(step), step.id);
    return out.file(`${fileStem(program.name)}.poses.txt`, "\r\n");
  }

  private line(step: Step): string {
    switch (step.type) {
      case "move":
        return `${this.move(step)}${this.labels(step)}`;
      case "wait":
        return `WAIT ${fixed(step.s, PACE_DECIMALS)}${this.labels(step)}`;
      case "gripper":
        return `GRIPPER ${step.closed ? "CLOSE" : "OPEN"}${this.labels(step)}`;
      // Labels of a comment stand behind it.
      case "comment":
        return `${commentText(step)}${this.labels(step)}`;
      default:
        throw new UnsupportedStep(
          step.id,
          `${called(step)} is a ${step.type} step, for which the pose list has no line.`,
          "Say it in another way, or take the step out.",
        );
    }
  }

  private labels({ name, group }: Step): string {
    const named = name === undefined ? "" : ` NAME ${quoted(asciiText(name))}`;
    return group === undefined || !Object.hasOwn(this.program.groups, group)
      ? named
      : `${named} GROUP ${this.names.of("group", group)}`;
  }

  private move(step: MoveStep): string {
    const way = step.path !== "circ" ? this.target(step.target, step) : this.arc(step);
    return `MOVE ${PATH_WORDS[step.path]} ${way}${pace(step)}${softness(step)}${blend(step)}`;
  }

  private arc(step: MoveStep): string {
    if (step.via === undefined)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} has no point to pass through.`,
        "Teach the point on the arc.",
      );
    return `VIA ${this.target(step.via, step)} TO ${this.target(step.target, step)}`;
  }

  private target(target: Target, step: Step): string {
    if ("q" in target) {
      const count = this.robot.arm.joints.length;
      if (target.q.length !== count)
        throw new UnsupportedStep(
          step.id,
          `${called(step)} holds ${target.q.length} joint values; the ${this.robot.name} has ${count} joints.`,
          "Teach the step again on this robot.",
        );
      const values = target.q.map((value, i) =>
        isSlide(this.robot.arm.joints[i]!)
          ? fixed(millimetres(value), DEG_DECIMALS)
          : fixed(degrees(value), DEG_DECIMALS),
      );
      return `JOINTS ${values.join(" ")}${target.tool === undefined ? "" : ` TOOL ${this.tool(target.tool, step)}`}`;
    }
    const { frame, tool, branch } = target;
    const isFree = frame === "world";
    if (!isFree && !Object.hasOwn(this.program.frames, frame))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the frame ${frame}, which the program does not have.`,
        "Choose another frame.",
      );
    const place = isFree
      ? poseNumbers(
          compose(compose(this.baseFromWorld, { position: [0, 0, 0], quaternion: [0, 0, 0, 1] }), target.pose),
        )
      : `${poseNumbers(target.pose)} IN ${this.names.of("frame", frame)}`;
    return `POSE ${place}${tool === "flange" ? "" : ` TOOL ${this.tool(tool, step)}`}${branch === undefined ? "" : posture(branch)}`;
  }

  private tool(name: string, step: Step): string {
    if (name === "flange") return name;
    if (!Object.hasOwn(this.program.tools, name))
      throw new UnsupportedStep(
        step.id,
        `${called(step)} uses the tool ${name}, which the program does not have.`,
        "Choose another tool.",
      );
    return this.names.of("tool", name);
  }
}

const posture = ({ shoulder, elbow, wrist, determinant, elbow_rad }: Branch): string =>
  ` BRANCH ${[shoulder, elbow, wrist].join(" ").toUpperCase()}${determinant === undefined ? "" : ` DET ${determinant.toUpperCase()}`}${elbow_rad === undefined ? "" : ` ELBOW ${fixed(degrees(elbow_rad), DEG_DECIMALS)}`}`;

function pace(step: MoveStep): string {
  const { speed } = step;
  const value = fixed(
    "ratio" in speed ? speed.ratio * 100 : "mps" in speed ? millimetres(speed.mps) : speed.time_s,
    PACE_DECIMALS,
  );
  if (!(Number(value) > 0))
    throw new UnsupportedStep(
      step.id,
      `${called(step)} has a speed of ${value}, with which it never arrives.`,
      "Give the step a speed.",
    );
  return "ratio" in speed ? ` SPEED ${value} %` : "mps" in speed ? ` SPEED ${value} MMPS` : ` TIME ${value}`;
}

const softness = ({ acceleration }: MoveStep): string =>
  acceleration === undefined ? "" : ` ACC ${fixed(acceleration.ratio * 100, PACE_DECIMALS)} %`;

function blend({ blend_m, blend_ratio = 0 }: MoveStep): string {
  if (blend_ratio > 0) return ` BLEND ${fixed(blend_ratio * 100, PACE_DECIMALS)} %`;
  return blend_m > 0 ? ` BLEND ${fixed(millimetres(blend_m), MM_DECIMALS)} MM` : "";
}

/** A star at the front marks what the list says of itself. */
const commentText = ({ text }: CommentStep): string =>
  `{${asciiText(text)
    .replaceAll("}", ")")
    .replace(/^[*\s]+/, "")}}`;

const fileStem = (name: string): string =>
  asciiText(name)
    .replace(/[^A-Za-z0-9_-]+/g, "_")
    .replace(/^_+|_+$/g, "")
    .slice(0, 60) || "program";
