import { falseIdentity, type Dialect, type Robot } from "@twincell/core";

const HINT = "A robot's conventions are known by its kinematics, not by its name: give the file of the robot itself.";

/**
 * The language with a door before it: a robot that carries the id of one of the library without being it is refused
 * with both sets of numbers, for its joint signs, zeros and configurations would be those of another arm.
 */
export function withIdentity<D extends Dialect>(dialect: D): D {
  const fault = (robot: Robot) => {
    const sentence = falseIdentity(robot);
    return sentence === undefined
      ? undefined
      : { line: 1, column: 1, expected: "the robot the text is for", sentence: `${sentence} ${HINT}` };
  };
  return {
    ...dialect,
    emit(program, robot, worldFromBase) {
      const sentence = falseIdentity(robot);
      return sentence === undefined
        ? dialect.emit(program, robot, worldFromBase)
        : { kind: "cannot", step: "", sentence, hint: HINT };
    },
    parse(text, robot, worldFromBase, options) {
      const wrong = fault(robot);
      return wrong === undefined
        ? dialect.parse(text, robot, worldFromBase, options)
        : { kind: "not-understood", faults: [wrong] };
    },
    interpret(text, robot, worldFromBase, options) {
      const wrong = fault(robot);
      return wrong === undefined
        ? dialect.interpret(text, robot, worldFromBase, options)
        : { kind: "not-understood", faults: [wrong] };
    },
  };
}
