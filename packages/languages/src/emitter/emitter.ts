import {
  identity,
  lowered,
  type Capability,
  type Dialect,
  type EmittedFile,
  type Program,
  type Robot,
} from "@twincell/core";
import { tellsRobot, undeclared, writtenOr } from "./cannot.ts";
import { Place } from "./place.ts";

/** What a door through which programs go out has of its own. */
export interface Emitter<Spoken> {
  /** What the language is called. */
  readonly language: string;
  /** What is known of a robot's controller, or undefined where it does not speak the language. */
  readonly spokenBy: (robot: Robot) => Spoken | undefined;
  readonly cannot: Dialect["cannot"];
  /** What is written with other statements, as its programmers do. */
  readonly idioms?: readonly Capability[];
  readonly write: (place: Place, spoken: Spoken) => EmittedFile;
  /** What the user should know of a text that was written. */
  readonly warnings: (program: Program) => readonly string[];
}

/** One file, or the step that stands in the way: never a part of a program. */
export const emitterOf =
  <Spoken>({ language, spokenBy, cannot, idioms = [], write, warnings }: Emitter<Spoken>): Dialect["emit"] =>
  (taught, robot, worldFromBase = identity()) => {
    const program = lowered(taught, { idioms, cannot });
    const spoken = spokenBy(robot);
    if (spoken === undefined)
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
        files: [write(new Place(program, robot, worldFromBase), spoken)],
        warnings: [...tellsRobot(program, robot), ...warnings(program)],
      }))
    );
  };
