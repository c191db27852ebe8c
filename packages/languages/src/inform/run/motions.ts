import type { Pose, TextPlace } from "@twincell/core";
import { TextError } from "../../parser/index.ts";
import type { Move, Operand, Position, Statement } from "../read/syntax.ts";
import { positionKey } from "../read/statement.ts";
import { ExecutedSteps, type Frame } from "./executed.ts";

/** Motions of INFORM: positions of jobs and of the controller, increments and arcs. */
export abstract class Motions extends ExecutedSteps {
  /** A motion with the speed that its variable says. */
  private withSpeed(move: Extract<Statement, { kind: "move" }>): Extract<Statement, { kind: "move" }> {
    const { speedIn } = move;
    if (speedIn === undefined) return move;
    const read = (of: Operand | undefined, per: number, planned: number, unit: string): number | undefined => {
      if (of === undefined) return undefined;
      const value = this.memory.value(of) / per;
      if (value > 0 || this.notices === undefined) return value;
      this.memory.notGiven(
        `The speed of line ${move.line} is in none of the files: it is planned at ${planned} ${unit}.`,
      );
      return planned;
    };
    return { ...move, v: read(speedIn.v, 10, 100, "mm/s") ?? move.v, vj: read(speedIn.vj, 100, 10, "%") ?? move.vj };
  }

  protected move(given: Extract<Statement, { kind: "move" }>, frame: Frame): void {
    const move = this.withSpeed(given);
    const taken = this.taken.get(move.position);
    if (taken !== undefined && (this.notices === undefined || move.motion === "MOVC" || move.motion === "MOVS"))
      return this.begin(move, taken);
    const missing = this.missing(move, frame);
    if (missing !== undefined) {
      this.endArc(move);
      this.memory.notGiven(`${missing}: the motion is not executed.`);
      this.state.isLost = true;
      return this.note(move);
    }
    this.further(move, frame);
    const position = move.by === undefined ? this.positionOf(move, frame) : this.incremented(move, move.by, frame);
    if (move.motion !== "MOVC") this.endArc(move);
    if (move.motion !== "MOVS") this.inCurve = false;
    switch (move.motion) {
      case "MOVJ":
      case "MOVL":
        return this.go(move, position, undefined, frame);
      case "MOVS": {
        // A curve begins where it is: with the point before it once more, or with a straight way to its first point.
        const first = !this.inCurve;
        this.inCurve = true;
        if (!first) return this.go(move, position, undefined, frame);
        return this.state.isAt(position, move)
          ? this.note(move)
          : this.go({ ...move, motion: "MOVL" }, position, undefined, frame);
      }
      case "MOVC":
        return this.arcPoint(move, position, frame);
    }
  }

  /** An arc or a curve that begins where the robot was when it was asked. */
  private begin(move: Extract<Statement, { kind: "move" }>, taken: Pose<"base", "flange">): void {
    if ((move.motion !== "MOVC" && move.motion !== "MOVS") || !this.state.isAt(taken, move))
      throw new TextError(
        move,
        "a position of this job",
        "A motion back to a position that was taken from the robot is not understood here.",
      );
    this.endArc(move);
    this.inCurve = move.motion === "MOVS";
    if (move.motion === "MOVC") this.arc = { points: 1, via: undefined };
    this.note(move);
  }

  /** Three points are an arc: where it begins, one on the way, and its end. */
  private arcPoint(move: Extract<Statement, { kind: "move" }>, position: Position, frame: Frame): void {
    const { points, via } = this.arc;
    if (points === 0) {
      this.arc = { points: 1, via: undefined };
      return this.state.isAt(position, move)
        ? this.note(move)
        : this.go({ ...move, motion: "MOVL" }, position, undefined, frame);
    }
    if (via === undefined) {
      this.arc = { points: 2, via: { position, line: move.line } };
      return this.note(move);
    }
    this.arc = move.isLastOfArc ? { points: 0, via: undefined } : { points: 1, via: undefined };
    this.go(move, position, via.position, frame);
  }

  /** What of a motion only the controller knows; undefined where all of it is known. */
  private missing(move: Move & TextPlace, frame: Frame): string | undefined {
    if (this.notices === undefined) return undefined;
    const { position } = move;
    if (position.startsWith("C")) {
      // A position that was never taught stays empty.
      if (!frame.job.positions.has(position)) return undefined;
    } else {
      const given = this.memory.given(position);
      const taught = frame.job.positions.get(position) ?? this.globalPosition(position);
      if (given === undefined && taught === undefined) return `${position} is in none of the files`;
      if (given?.values.some(Number.isNaN) === true) return `${position} is in none of the files`;
    }
    const startsHere = move.by !== undefined || move.motion === "MOVC" || move.motion === "MOVS";
    return this.state.isLost && startsHere ? "Where the robot stands before it is not known" : undefined;
  }

  /** Further axes are named and not moved; a motion that follows what they carry is refused when they go on. */
  private further(move: Move & TextPlace, { job }: Frame): void {
    const others = (move.others ?? [])
      .join(" ")
      .replace(/\b(?:BC|EC)[0-9]+/g, name => job.others.get(positionKey(name)) ?? name);
    if (others !== "")
      this.notices?.add(
        move,
        "the axes of one arm",
        `Further axes go with the motion of line ${move.line} and are not moved: ${move.others!.join(", ")}.`,
      );
    if (others !== "" && this.notices === undefined)
      throw new TextError(
        move,
        "positions of the robot alone",
        "Positions of a track or a station are not understood here.",
      );
    if (move.follows === true && this.others !== undefined && others !== this.others)
      throw new TextError(
        move,
        "a motion along a station that stands still",
        `With SMOV the robot follows the station, which goes from ${standing(this.others)} to ${standing(others)}: stations are not moved here.`,
      );
    this.others = others;
  }

  /** IMOV: from where the robot stands, along the axes of a frame or of the tool. */
  private incremented(move: Move & TextPlace, by: NonNullable<Move["by"]>, frame: Frame): Position {
    const amount = this.positionOf(move, frame);
    if (amount.type === "PULSE" || amount.type === "ANGLE")
      throw new TextError(move, "an amount in X, Y, Z", "IMOV by the axes is not executed here.");
    if (this.notices === undefined)
      throw new TextError(move, "a position", "IMOV moves by an amount: write the position.");
    const type = by.frame === "TOOL" ? "BASE" : by.frame;
    const from = this.state.standing(type, by.user, amount.tool, move);
    return this.state.movedBy(from, amount.values, by.frame === "TOOL", move);
  }

  private positionOf({ position, ...at }: Move & TextPlace, { job }: Frame): Position {
    const given = position.startsWith("C") ? undefined : this.memory.given(position);
    if (given !== undefined) return given;
    const own = job.positions.get(position);
    const isVariable = !position.startsWith("C");
    const anywhere = own ?? (isVariable ? this.globalPosition(position) : undefined);
    if (anywhere === undefined)
      throw new TextError(at, "a position of this job", `Position ${position} is not in job ${job.name}.`);
    return anywhere;
  }

  protected globalPosition(key: string): Position | undefined {
    for (const { positions } of this.source.jobs.values()) {
      const found = positions.get(key);
      if (found !== undefined) return found;
    }
    return undefined;
  }
}

/** Where a station stands, or that it is not said. */
export const standing = (others: string): string => (others === "" ? "where it was" : others);
