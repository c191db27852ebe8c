import {
  identity,
  lowered,
  sectionForLanguage,
  type Capability,
  type Dialect,
  type Emitted,
  type EmittedFile,
  type Program,
  type Robot,
  type VendorSection,
} from "@twincell/core";
import { tellsRobot, undeclared, writtenOr } from "./cannot.ts";
import { Place } from "./place.ts";
import { WalkedPlace } from "./walk.ts";

/** A program in its cell, for a robot whose controller speaks the language. */
interface Spoken {
  readonly place: WalkedPlace;
  readonly section: VendorSection;
}

/** What every door has of its own through which programs go out. */
interface Door {
  /** Id of the language, as vendor sections name it. */
  readonly id: string;
  readonly cannot: Dialect["cannot"];
  /** What is written with other statements, as its programmers do. */
  readonly idioms?: readonly Capability[];
  /** One sentence for a robot whose controller does not speak the language. */
  readonly strange: (robot: Robot) => string;
}

/** A door whose language looks at a program its own way, and writes files of several sorts. */
export interface WholeEmitter extends Door {
  readonly write: (spoken: Spoken) => Emitted;
}

/** The program without what the language writes with other statements, or the sentence that stands in the way. */
export const wholeEmitterOf =
  ({ id, cannot, idioms = [], strange, write }: WholeEmitter): Dialect["emit"] =>
  (taught, robot, worldFromBase = identity()) => {
    const program = lowered(taught, { idioms, cannot });
    const section = sectionForLanguage(robot, id);
    if (section === undefined)
      return {
        kind: "cannot",
        step: "",
        sentence: strange(robot),
        hint: "Export in the language of this robot's own controller.",
      };
    return writtenOr(() => write({ place: new WalkedPlace(program, robot, worldFromBase), section }));
  };

/** A door through which programs go out as one file. */
export interface Emitter extends Omit<Door, "strange"> {
  /** What the language is called. */
  readonly language: string;
  readonly write: (place: Place, section: VendorSection) => EmittedFile;
  /** What the user should know of a text that was written. */
  readonly warnings: (program: Program) => readonly string[];
}

/** One file, or the step that stands in the way: never a part of a program. */
export const emitterOf = ({ id, language, cannot, idioms = [], write, warnings }: Emitter): Dialect["emit"] =>
  wholeEmitterOf({
    id,
    cannot,
    idioms,
    strange: robot => `The controller of the ${robot.name} does not speak ${language}.`,
    write: ({ place: { program, robot, worldFromBase }, section }) =>
      undeclared(program, cannot) ?? {
        kind: "emitted",
        files: [write(new Place(program, robot, worldFromBase), section)],
        warnings: [...tellsRobot(program, robot), ...warnings(program)],
      },
  });
