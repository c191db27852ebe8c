import {
  branchOf,
  compose,
  inverse,
  solveAll,
  type MoveStep,
  type Pose,
  type Robot,
  type Target,
  type VendorSection,
} from "@twincell/core";
import type { PulseData } from "../pulses.ts";
import type { Controller } from "./controller.ts";
import { pulseText, rconfText, rectanPose, rectanText } from "./location.ts";
import { BlockWriter, shownAxes, type WalkedPlace } from "../../emitter/index.ts";

/** Where the robot is after a motion, as the text says it: what arcs and curves begin with once more. */
export interface Arrival {
  readonly q_rad: ArrayLike<number>;
  /** Undefined in jobs that hold pulses. */
  readonly written: { readonly frame: string; readonly tool: string; readonly text: string } | undefined;
}

/** The positions of a job. Settings are written where they change. */
export class Points {
  readonly out = new BlockWriter();
  count = 0;
  private readonly place: WalkedPlace;
  private readonly controller: Controller;
  private readonly convention: VendorSection;
  private readonly pulses: PulseData | undefined;
  private readonly robot: Robot;
  private user = "";
  private tool = "";
  private type = "";
  private rconf = "";

  constructor(place: WalkedPlace, controller: Controller, convention: VendorSection, pulses: PulseData | undefined) {
    this.place = place;
    this.robot = place.robot;
    this.controller = controller;
    this.convention = convention;
    this.pulses = pulses;
  }

  /** Adds a point and returns its name and where the robot is then. */
  add(
    { id }: MoveStep,
    target: Target,
    frame: string,
    tool: string,
    q_rad: ArrayLike<number>,
  ): { readonly name: string; readonly arrival: Arrival } {
    if (this.pulses !== undefined)
      return { name: this.pulsePoint(id, tool, q_rad), arrival: { q_rad, written: undefined } };
    const text = rectanText(this.inFrame(target, frame, tool));
    return { name: this.rectanPoint(id, frame, tool, text, q_rad), arrival: { q_rad, written: { frame, tool, text } } };
  }

  /** The place where the robot is, once more, as a point of an arc or a curve. */
  repeat({ id }: MoveStep, arrival: Arrival, frame: string, tool: string): string {
    const { q_rad, written } = arrival;
    if (this.pulses !== undefined) return this.pulsePoint(id, tool, q_rad);
    if (written?.frame === frame && written.tool === tool)
      return this.rectanPoint(id, frame, tool, written.text, q_rad);
    const { frame: before, tool: by, text } = written!;
    const worldFromFlange = this.worldFromFlange(before, by, text);
    const tip = compose(
      inverse(this.worldFrom(frame)),
      compose(worldFromFlange, rectanPose<"flange", "tcp">(rectanText(this.place.tool(tool)))),
    );
    return this.rectanPoint(id, frame, tool, rectanText(tip), q_rad);
  }

  /** A variable for shifts, at 0. */
  variable(name: string): void {
    this.settings("world", "flange", "BASE");
    this.out.add(`P${name.slice(1).padStart(4, "0")}=0.000,0.000,0.000,0.0000,0.0000,0.0000`);
  }

  private inFrame(target: Target, frame: string, tool: string): Pose {
    if ("pose" in target && target.frame === frame && frame !== "world") return target.pose;
    const worldFromTcp = this.place.worldFromTarget(target, tool);
    return frame === "world"
      ? compose(this.place.vendorFromWorld, worldFromTcp)
      : compose(inverse(this.place.worldFromFrame(frame)), worldFromTcp);
  }

  /** A frame as the text has it. */
  private worldFrom(frame: string): Pose<"world", "frame"> {
    const worldFromVendor = inverse(this.place.vendorFromWorld);
    return frame === "world"
      ? (worldFromVendor as Pose as Pose<"world", "frame">)
      : compose(
          worldFromVendor,
          rectanPose<"vendor-world", "frame">(rectanText(this.controller.vendorFromFrame(frame))),
        );
  }

  /** Where the flange is when the text is taken at its word: frames, tools and points are rounded each for itself. */
  private worldFromFlange(frame: string, tool: string, text: string): Pose<"world", "flange"> {
    return compose(
      compose(this.worldFrom(frame), rectanPose<"frame", "tcp">(text)),
      inverse(rectanPose<"flange", "tcp">(rectanText(this.place.tool(tool)))),
    );
  }

  /**
   * The joint angles in which the rounded text is reached in the posture of `q_rad`. With the wrist centre close to
   * axis S the last digit turns S and R by whole degrees: flags of the angles that were meant could name another
   * posture.
   */
  private reachedByText(frame: string, tool: string, text: string, q_rad: ArrayLike<number>): ArrayLike<number> {
    const branch = branchOf(this.robot, q_rad);
    const baseFromFlange = compose(inverse(this.place.worldFromBase), this.worldFromFlange(frame, tool, text));
    const reach = solveAll(
      this.robot,
      baseFromFlange,
      branch === undefined ? { near: q_rad } : { near: q_rad, branch },
    );
    // At the very end of the reach the last digit can lie outside: then the angles that were meant are the best there
    // is.
    return reach.kind === "reached" ? reach.solutions[0]!.q_rad : q_rad;
  }

  private pulsePoint(id: string, tool: string, q_rad: ArrayLike<number>): string {
    this.settings("", tool, "PULSE");
    return this.point(id, pulseText(shownAxes(this.convention, q_rad), this.pulses!.pulsesPerDegree));
  }

  private rectanPoint(id: string, frame: string, tool: string, text: string, q_rad: ArrayLike<number>): string {
    this.settings(frame === "world" ? "" : frame, tool, frame === "world" ? "BASE" : "USER");
    const rounded_rad = this.reachedByText(frame, tool, text, q_rad);
    const rconf = rconfText(this.robot, rounded_rad, shownAxes(this.convention, rounded_rad));
    if (rconf !== this.rconf) this.out.add(`///RCONF ${rconf}`);
    this.rconf = rconf;
    return this.point(id, text);
  }

  private settings(frame: string, tool: string, type: string): void {
    const user = frame === "" || frame === "world" ? this.user : `///USER ${this.controller.user(frame)}`;
    const toolLine = `///TOOL ${this.controller.tool(tool)}`;
    if (user !== this.user) this.out.add(user);
    if (toolLine !== this.tool) this.out.add(toolLine);
    if (type !== this.type) {
      this.out.add(`///POSTYPE ${type}`);
      this.out.add(type === "PULSE" ? "///PULSE" : "///RECTAN");
    }
    this.user = user;
    this.tool = toolLine;
    this.type = type;
  }

  private point(id: string, text: string): string {
    const name = `C${String(this.count++).padStart(5, "0")}`;
    this.out.add(`${name}=${text}`, id);
    return name;
  }
}
