import { identity } from "@twincell/core";
import { tellsRobot, undeclared, writtenOr } from "./cannot.ts";
import { Place } from "./place.ts";
/** One file, or the step that stands in the way: never a part of a program. */
export const emitterOf = ({ language, spokenBy, cannot, write, warnings }) => (program, robot, worldFromBase = identity()) => {
    const spoken = spokenBy(robot);
    if (spoken === undefined)
        return { kind: "cannot", step: "", sentence: `The controller of the ${robot.name} does not speak ${language}.`, hint: "Export in the language of this robot's own controller." };
    return undeclared(program, cannot) ?? writtenOr(() => ({ kind: "emitted", files: [write(new Place(program, robot, worldFromBase), spoken)], warnings: [...tellsRobot(program, robot), ...warnings(program)] }));
};
