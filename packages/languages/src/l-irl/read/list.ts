import {
  compose,
  identity,
  type Group,
  type Pose,
  type Robot,
  type Step,
  type TextFault,
  type TextPlace,
} from "@twincell/core";
import { TextError, plainText, textFault, textLines } from "../../parser/index.ts";
import { Cursor } from "./cursor.ts";
import { poseOf, readHeader, type Header } from "./header.ts";
import { readMove } from "./move.ts";
import type { NamedPose, PoseList } from "./pose-list.ts";

export type ReadList =
  | { readonly kind: "list"; readonly list: PoseList }
  | { readonly kind: "not-understood"; readonly faults: readonly TextFault[] };

/** More faults than this are not told at once. */
const MOST_FAULTS = 50;
/** Most lines hold nothing that would have to be replaced. */
const PLAIN = /^[ -~]*$/;
const STATEMENTS = "MOVE, WAIT, GRIPPER, POSE, TOOL, FRAME, GROUP, ROBOT, PROGRAM, a comment or six numbers";

/**
 * Reads a list line by line and goes on behind a fault, so that all of them are told at once.
 *
 * @param robot  whose joints the list counts; without one it may hold no joint values.
 */
export function readPoseList(text: string, robot: Robot | undefined, worldFromBase: Pose<"world", "base">): ReadList {
  const reader = new ListReader(robot, worldFromBase);
  const faults: TextFault[] = [];
  for (const [i, raw] of textLines(text).entries()) {
    try {
      reader.line(PLAIN.test(raw) ? raw : plainText(raw), i + 1);
    } catch (cause) {
      if (!(cause instanceof TextError)) throw cause;
      faults.push(cause.fault);
      // Without its first line no number below means anything.
      if (reader.header === undefined || faults.length >= MOST_FAULTS) break;
    }
  }
  if (faults.length === 0 && reader.header === undefined)
    faults.push(
      textFault(
        { line: 1, column: 1 },
        "POSES 1 MM DEG ZYX BASE",
        "The text holds no line that says its units and angles, with which a pose list begins.",
      ),
    );
  return faults.length > 0 ? { kind: "not-understood", faults } : { kind: "list", list: reader };
}

export class ListReader implements PoseList {
  header: Header | undefined;
  program = "Pose list";
  readonly tools = new Map<string, Pose<"flange", "tcp">>();
  readonly frames = new Map<string, Pose<"world", "frame">>();
  readonly groups = new Map<string, Group>();
  readonly poses = new Map<string, NamedPose>();
  readonly steps: { line: number; step: Step }[] = [];
  readonly robot: Robot | undefined;
  private readonly worldFromBase: Pose<"world", "base">;
  private worldFromOrigin: Pose<"world", "origin"> = identity();

  constructor(robot: Robot | undefined, worldFromBase: Pose<"world", "base">) {
    this.robot = robot;
    this.worldFromBase = worldFromBase;
  }

  /** @throws {TextError} where the line is not understood. */
  line(text: string, line: number): void {
    const cursor = new Cursor(text, line);
    if (cursor.done) return;
    if (cursor.atComment) {
      this.comment(cursor, line);
      return;
    }
    if (this.header === undefined) {
      this.header = readHeader(cursor);
      if (this.header.from === "BASE") this.worldFromOrigin = compose(this.worldFromBase, identity<"base", "origin">());
      return;
    }
    if (cursor.atNumber)
      this.addPose({ line, column: 1 }, this.freePoseName(), this.fromOrigin(six(cursor), this.header));
    else this.statement(cursor, line, this.header);
    if (cursor.atComment) cursor.comment();
    cursor.expectEnd();
  }

  fromOrigin<From extends string>(numbers: readonly number[], header: Header): Pose<"world", From> {
    return compose(this.worldFromOrigin, poseOf<"origin", From>(numbers, header));
  }

  private statement(cursor: Cursor, line: number, header: Header): void {
    const id = `s${this.steps.length + 1}`;
    if (cursor.accept("MOVE")) {
      this.add(line, { ...readMove(cursor, this, header, id), ...this.labels(cursor) });
      return;
    }
    if (cursor.accept("WAIT")) {
      this.add(line, { id, type: "wait", s: atLeastZero(cursor, "a time in seconds"), ...this.labels(cursor) });
      return;
    }
    if (cursor.accept("GRIPPER")) {
      this.add(line, {
        id,
        type: "gripper",
        closed: cursor.oneOf(["CLOSE", "OPEN"]) === "CLOSE",
        ...this.labels(cursor),
      });
      return;
    }
    const { here } = cursor;
    if (cursor.accept("POSE")) {
      const at = cursor.here;
      const name = cursor.name("the name of the pose");
      this.addPose(at, name, this.fromOrigin(six(cursor), header));
    } else if (cursor.accept("TOOL")) define(this.tools, cursor, "tool", "flange", () => poseOf(six(cursor), header));
    else if (cursor.accept("FRAME"))
      define(this.frames, cursor, "frame", "world", () => this.fromOrigin(six(cursor), header));
    else if (cursor.accept("GROUP"))
      define(this.groups, cursor, "group", undefined, () => ({ name: cursor.name("the title of the group") }));
    else if (cursor.accept("PROGRAM")) this.program = cursor.name("the name of the program");
    else if (cursor.accept("ROBOT")) this.isFor(here, cursor.name("the name of a robot"));
    else throw cursor.unexpected(STATEMENTS);
  }

  private add(line: number, step: Step): void {
    this.steps.push({ line, step });
  }

  private addPose(at: TextPlace, name: string, worldFromTcp: Pose<"world", "tcp">): void {
    if (this.poses.has(name)) throw new TextError(at, "a name used once", `The pose ${name} is in the list twice.`);
    this.poses.set(name, { worldFromTcp, line: at.line });
  }

  private freePoseName(): string {
    let count = this.poses.size + 1;
    while (this.poses.has(`P${count}`)) count++;
    return `P${count}`;
  }

  private isFor(at: TextPlace, id: string): void {
    if (this.robot !== undefined && this.robot.id !== id)
      throw new TextError(
        at,
        `the robot ${this.robot.id}`,
        `The list is for the robot ${id}, and its joint values are not those of the ${this.robot.name}.`,
      );
  }

  /** A comment is a step, unless the list speaks of itself: then it begins with a star. */
  private comment(cursor: Cursor, line: number): void {
    const text = cursor.comment();
    const labels = this.header === undefined ? {} : this.labels(cursor);
    cursor.expectEnd();
    if (this.header !== undefined && !text.startsWith("*"))
      this.add(line, { id: `s${this.steps.length + 1}`, type: "comment", text, ...labels });
  }

  private labels(cursor: Cursor): { readonly name?: string; readonly group?: string } {
    const name = cursor.accept("NAME") ? { name: cursor.name("the name of the step") } : {};
    if (!cursor.accept("GROUP")) return name;
    const { here } = cursor;
    const group = cursor.name("the name of a group");
    if (!this.groups.has(group))
      throw new TextError(here, "a GROUP of the list", `The list has no line GROUP ${group}.`);
    return { ...name, group };
  }
}

const six = (cursor: Cursor): number[] => cursor.numbers(6, "number");

function define<T>(
  things: Map<string, T>,
  cursor: Cursor,
  sort: string,
  reserved: string | undefined,
  value: () => T,
): void {
  const { here } = cursor;
  const name = cursor.name(`the name of the ${sort}`);
  if (name === reserved)
    throw new TextError(
      here,
      `another name than ${name}`,
      `The ${sort} ${name} is always there and cannot be changed.`,
    );
  if (things.has(name)) throw new TextError(here, "a name used once", `The ${sort} ${name} is in the list twice.`);
  things.set(name, value());
}

function atLeastZero(cursor: Cursor, what: string): number {
  const { here } = cursor;
  const value = cursor.number(what);
  if (!(value >= 0)) throw new TextError(here, `${what}, 0 or more`, `${value} is less than 0.`);
  return value;
}
