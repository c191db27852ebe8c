/** From an empty cell to a robot that runs. */
export const process = {
  title: "Six steps to a cell",
  "done(n: number, of: number)": "{n} of {of}",
  isDone: "done",
  steps: {
    objects: { title: "Objects", says: "Drag parts from the library below into the cell, or bring your CAD." },
    kinematics: {
      title: "Kinematics",
      says: "Choose the robot or make one of imported parts, and put a tool on its flange.",
    },
    interactions: {
      title: "Interactions",
      says: "Give work pieces that role, let conveyors run, and say which pairs may touch.",
    },
    scenario: { title: "Scenario", says: "Teach what the robot does: record points, or trace edges." },
    run: { title: "Run", says: "Play it here: every move is judged for reach, speed and collisions." },
    execute: { title: "Execute and correct", says: "Run it on a controller, look at what was found, and correct it." },
  },
  bringCad: "Bring your CAD",
  chooseRobot: "Choose the robot",
  makeRobot: "Make a robot of parts",
  pairs: "Pairs that may touch",
  teach: "Go to Teach",
  play: "Play",
  execute: "Go to Run",
  correct: "Go to Check",
};
