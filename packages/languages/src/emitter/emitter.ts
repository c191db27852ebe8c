import {
  identity,
  lowered,
  sectionForLanguage,
  type Capability,
  type Dialect,
  type EmittedFile,
  type Program,
  type VendorSection,
} from "@twincell/core";
import { tellsRobot, undeclared, writtenOr } from "./cannot.ts";
import { Place } from "./place.ts";

/** What a door through which programs go out has of its own. */
export interface Emitter {
  /** Id of the language, as vendor sections name it. */
  readonly id: string;
  /** What the language is called. */
  readonly language: string;
  readonly cannot: Dialect["cannot"];
  /** What is written with other statements, as its programmers do. */
  readonly idioms?: readonly Capability[];
  readonly write: (place: Place, section: VendorSection) => EmittedFile;
  /** What the user should know of a text that was written. */
  readonly warnings: (program: Program) => readonly string[];
}

/** One file, or the step that stands in the way: never a part of a program. */
export const emitterOf =
  ({ id, language, cannot, idioms = [], write, warnings }: Emitter): Dialect["emit"] =>
  (taught, robot, worldFromBase = identity()) => {
    const program = lowered(taught, { idioms, cannot });
    const section = sectionForLanguage(robot, id);
    if (section === undefined)
      return {
        kind: "cannot",
        step: "",
        sentence: `The controller of the ${robot.name} does not speak ${language}.`,
        hint: "Export in the language of this robot's own controller.",
      };
    return (
      undeclared(program, cannot) ??
      writtenOr(() => ({
        kind: "emitted",
        files: [write(new Place(program, robot, worldFromBase), section)],
        warnings: [...tellsRobot(program, robot), ...warnings(program)],
      }))
    );
  };
