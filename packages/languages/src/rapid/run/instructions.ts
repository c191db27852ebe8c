/** The output that closes the gripper. */
export const GRIPPER = "dogripper";
/** Instructions that change nothing of where the robot goes. */
export const SILENT = new Set([
  "singarea",
  "tperase",
  "confl",
  "pathaccset",
  "worldaccset",
  "motionsup",
  "actunit",
  "deactunit",
  "clkreset",
  "clkstart",
  "clkstop",
  "cirpathmode",
  "pathresol",
  "tunereset",
  "softdeact",
  "pdispoff",
  "eoffsoff",
  "waitrob",
]);
/** Instructions at which the robot stays until somebody starts it again. */
export const HALTS = new Set(["stop", "break", "systemstopaction"]);
/** Instructions that are not executed, with the reason. */
export const REFUSED: Readonly<Record<string, string>> = {
  triggl: "Events on the way of a move are not executed here.",
  triggj: "Events on the way of a move are not executed here.",
  pdispset: "Program displacement is not executed here: put it into the work object.",
  pdispon: "Program displacement is not executed here: put it into the work object.",
  eoffsset: "Offsets of external axes are not executed here.",
};
