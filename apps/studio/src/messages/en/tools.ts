/** Tools of the robot. */
export const tools = {
  "mounted(name)": "{name} is on the flange.",
  "mountedHint(old)": "What was taught keeps {old}: exchange it in the inspector to carry it out with the new one.",
  "takesOver(old)": "Take over what was taught with {old}",
  takesOverSays: "The tip of this tool goes where the other one went; path and collisions are checked anew.",
  "exchanged(from, to, points: number)":
    "{to} takes over from {from}: {points, plural, one {# point} other {# points}}.",
  undoExchange: "Exchange the tool",
  "makeTool(name)": "Make {name} a tool",
  makeToolSays: "Its frame comes to the flange, z away from it; the tip is set where it ends.",
  gripperUrdfSays: "One driven joint and five that mimic it, with masses and inertias.",
  remove: "Remove this tool",
  "stillUsed(name, points: number)":
    "{name} stays: {points, plural, one {# point was} other {# points were}} taught with it. Exchange it first.",
  bare: "bare flange",
};
