import type { TextPlace } from "@twincell/core";
import { TextError, textFault } from "../../parser/index.ts";
import type { Expression, Statement } from "../../parser/structured/index.ts";
import type { Motion, Point } from "./actions.ts";
import { OperandReader } from "./operands.ts";

/** Options of a motion that change nothing of where the robot goes. */
const IDLE_OPTIONS = ["pth", "wjnt", "rtcp", "break", ","];
/** What may stand behind a motion. */
type Option = "acceleration" | "offset" | "toolOffset" | "coordinated" | "skip" | "jumpsWhenMet" | "incremental";
type Options = { -readonly [K in keyof Pick<Motion, Option>]: Motion[K] };

/** Lines of TP programs that move the robot. */
export abstract class MotionReader extends OperandReader {
  protected abstract statement(): Statement;

  private point(): Point {
    const { cursor } = this;
    const register = cursor.next;
    if (register !== "p" && register !== "pr") throw cursor.unexpected("P[n] or PR[n]");
    cursor.advance();
    return { register, number: this.indexed() };
  }

  protected motion(word: "j" | "l" | "c"): Motion {
    const { cursor } = this;
    const path = word.toUpperCase() as "J" | "L" | "C";
    const first = this.point();
    let via: Point | undefined;
    let goal = first;
    if (word === "c") {
      via = first;
      // A point on the way may be shifted as its end is.
      if (cursor.accept("offset")) this.offset();
      while (cursor.isAt("line-end")) cursor.advance();
      // The second line may begin with a colon that has no number before it.
      cursor.accept(":");
      goal = this.point();
    }
    const held = cursor.next;
    const isHeld = held === "max_speed" || held === "weld_speed";
    const speed = isHeld ? undefined : this.value();
    if (isHeld) cursor.advance();
    const unit = isHeld ? held : this.unit(path);
    const at = cursor.here;
    const cnt = this.term(at);
    const options: Options = { coordinated: false };
    while (!cursor.isAt("line-end") && !cursor.done) if (this.option(options, at) === "last") break;
    return {
      kind: "motion",
      path,
      goal,
      speed,
      unit,
      ...(via === undefined ? {} : { via }),
      ...(cnt === undefined ? {} : { cnt }),
      ...options,
    };
  }

  /** How the point is reached: undefined for FINE. */
  private term(at: TextPlace): Expression | undefined {
    const { cursor } = this;
    const term = cursor.next;
    if (cursor.accept("fine")) return undefined;
    const cnt = this.suffixed("cnt") ?? this.corner();
    if (cnt === undefined)
      throw new TextError(at, "FINE or CNT", `"${term.toUpperCase()}" says not how the point is reached.`);
    return cnt;
  }

  /** @returns "last" behind what takes the rest of the line. */
  private option(options: Options, at: TextPlace): "last" | "more" {
    const { cursor } = this;
    const acceleration = this.suffixed("acc");
    if (acceleration !== undefined) options.acceleration = acceleration;
    else if (cursor.accept("offset")) options.offset = this.offset();
    else if (cursor.accept("tool_offset")) options.toolOffset = this.offset();
    else if (cursor.accept("coord")) options.coordinated = true;
    else if (cursor.next === "skip" || cursor.next === "skipjump") this.skipping(options);
    else if (cursor.next === "tb" || cursor.next === "ta" || cursor.next === "db") {
      this.atPoint(at);
      return "last";
    } else if (cursor.accept("inc")) options.incremental = true;
    else if (!this.passes() && !IDLE_OPTIONS.some(word => cursor.accept(word)))
      throw cursor.unexpected("an option of the motion that is executed here");
    return "more";
  }

  private skipping(options: Options): void {
    const { cursor } = this;
    if (cursor.take() === "skipjump") options.jumpsWhenMet = true;
    else delete options.jumpsWhenMet;
    cursor.expect(",");
    options.skip = this.label();
  }

  /**
   * TB, TA or DB: what is done at the point, so long or so far before it or after. It is executed when the point is
   * reached, and said where that is not the same.
   */
  private atPoint(at: TextPlace): void {
    const { cursor } = this;
    const word = cursor.take();
    const many = this.value();
    const unit = cursor.isAt("word") ? cursor.take() : "";
    cursor.accept(",");
    if (many.kind !== "number" || many.value !== 0)
      this.kept.push(
        textFault(
          at,
          "an action at the point itself",
          `${word.toUpperCase()}${many.kind === "number" ? ` ${many.value}${unit}` : ""}: what is done about the point is done when it is reached.`,
        ),
      );
    // P-SPS: the statements below, up to the line of dashes.
    if (cursor.next === "p" && cursor.second === "-") {
      while (!cursor.isAt("line-end") && !cursor.done) cursor.advance();
      return;
    }
    if (cursor.accept("point_logic")) return;
    this.behind = this.statement();
  }

  /** Options of which the tool's path and place know nothing. */
  private passes(): boolean {
    const { cursor } = this;
    const word = cursor.next;
    if (/^(?:ev|ind\.ev|fd|sv)[0-9]*$/.test(word) || word === "increase" || word === "process_speed") {
      cursor.advance();
      if (cursor.accept("r")) this.indexed();
      else if (cursor.isAt("number")) cursor.advance();
      cursor.accept("%");
      return true;
    }
    return false;
  }

  /** CR10, a corner by its radius in mm, is read as CNT: the share of the slowing down that is passed is not known. */
  private corner(): Expression | undefined {
    const at = this.cursor.here;
    const radius = this.suffixed("cr") ?? this.suffixed("cd");
    if (radius === undefined) return undefined;
    throw new TextError(at, "FINE or CNT", "Corners by radius (CR, CD) are not executed here.");
  }

  private offset(): { readonly register: Expression | undefined } {
    const { cursor } = this;
    if (!cursor.accept(",")) return { register: undefined };
    cursor.expect("pr");
    return { register: this.indexed() };
  }
}
