import { compose, fromFanucWpr, inverse, pose, type MoveStep, type Pose, type Robot, type Step } from "@twincell/core";
import { UnsupportedStep, called, type Place } from "../../emitter/index.ts";
import type { Listing } from "./listing.ts";
import { xyzwpr } from "./positions.ts";
import { labelled } from "./words.ts";

const MOST_TOOLS = 10;
const MOST_FRAMES = 9;
const FIRST_FREE = 21;
const MOST_POSITIONS = 100;
const MOST_NUMBERS = 200;

/** Numbers of tools, frames and registers. Tools are set up in PR[1] …, frames in PR[11] …, the rest is for pallets. */
export class Registers {
  private readonly place: Place;
  private readonly robot: Robot;
  private readonly tools: string[] = [];
  private readonly frames: string[] = [];
  private readonly positions = new Map<string, string>();
  private readonly variables = new Map<string, string>();
  private numbers = 0;

  constructor(place: Place) {
    this.place = place;
    this.robot = place.robot;
  }

  /** Every tool and frame gets its number before the first line is written. */
  note(step: MoveStep): void {
    for (const target of step.via === undefined ? [step.target] : [step.via, step.target]) {
      this.toolNumber(target.tool ?? "flange", step);
      const { pallets } = this.place.program;
      const frame =
        "q" in target ? "world" : Object.hasOwn(pallets, target.frame) ? pallets[target.frame]!.frame : target.frame;
      this.frameNumber(frame, step);
    }
  }

  toolNumber(tool: string, step: Step): number {
    return this.numberIn(this.tools, tool, MOST_TOOLS, "tools", step);
  }
  /** UFRAME 0 is the world of the controller. */
  frameNumber(frame: string, step: Step): number {
    return frame === "world" ? 0 : this.numberIn(this.frames, frame, MOST_FRAMES, "user frames", step);
  }

  private numberIn(list: string[], name: string, most: number, what: string, step: Step): number {
    const known = list.indexOf(name);
    if (known >= 0) return known + 1;
    if (list.length >= most)
      throw new UnsupportedStep(
        step.id,
        `${called(step)} needs one more than the ${most} ${what} of the controller.`,
        "Use fewer of them in one program.",
      );
    return list.push(name);
  }

  /** Where a frame is, by the digits that are written of it. */
  baseFromFrame(frame: string): Pose<"base", "frame"> {
    const {
      robot: { baseFromVendorWorld },
      place,
    } = this;
    if (frame === "world") return compose(baseFromVendorWorld, pose<"vendor-world", "frame">());
    const values = xyzwpr(compose(inverse(baseFromVendorWorld), compose(place.baseFromWorld, place.frame(frame)))).map(
      Number,
    );
    const written: Pose<"vendor-world", "frame"> = {
      position: [values[0]! / 1000, values[1]! / 1000, values[2]! / 1000],
      quaternion: fromFanucWpr(values[3]!, values[4]!, values[5]!),
    };
    return compose(baseFromVendorWorld, written);
  }

  /** A number register of its own. */
  number(name: string): string {
    if (++this.numbers > MOST_NUMBERS)
      throw new UnsupportedStep(
        "",
        `The loops of the program need more than the ${MOST_NUMBERS} number registers of the controller.`,
        "Put parts of it into another program.",
      );
    return labelled("R", this.numbers, name);
  }

  /** The number register of a variable. */
  variable(name: string): string {
    const known = this.variables.get(name);
    if (known !== undefined) return known;
    const text = this.number(name);
    this.variables.set(name, text);
    return text;
  }

  /** The position register of that name. */
  position(name: string): string {
    const known = this.positions.get(name);
    if (known !== undefined) return known;
    const number = FIRST_FREE + this.positions.size;
    const text = labelled("PR", number, name);
    if (number > MOST_POSITIONS)
      throw new UnsupportedStep(
        "",
        `The pallets of the program need more than the ${MOST_POSITIONS} position registers of the controller.`,
        "Put some of them into another program.",
      );
    this.positions.set(name, text);
    return text;
  }

  /** Lines that give a position register its six numbers. LPOS makes it one of positions and not of joints. */
  values(register: string, values: readonly string[]): string[] {
    const number = /[0-9]+/.exec(register)![0];
    return [
      `${register}=LPOS`,
      ...values.map((value, i) => `PR[${number},${i + 1}]=${value.startsWith("-") ? `(${value})` : value}`),
    ];
  }

  declare(out: Listing): void {
    const { place, robot, tools, frames } = this;
    const set = (word: string, i: number, register: string, at: Pose): void => {
      for (const line of [...this.values(register, xyzwpr(at)), `${word}[${i}]=${register}`]) out.add(line);
    };
    for (const [i, name] of tools.entries()) set("UTOOL", i + 1, labelled("PR", i + 1, name), place.tool(name));
    for (const [i, name] of frames.entries())
      set(
        "UFRAME",
        i + 1,
        labelled("PR", i + 11, name),
        compose(inverse(robot.baseFromVendorWorld), compose(place.baseFromWorld, place.frame(name))),
      );
  }
}
