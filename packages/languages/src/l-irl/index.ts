import { identity, type Dialect } from "@twincell/core";
import { skippingDialect } from "../parser/index.ts";
import { emitPoseList } from "./emit.ts";
import { interpretPoseList } from "./interpret.ts";
import { isListOfPlaces, parsePoseList } from "./parse.ts";
import { CANNOT } from "./words.ts";
import { LINES } from "./lines.ts";

export { loadPoses, savePoses, type LoadedPoses, type SavedPose } from "./poses.ts";

/**
 * The neutral pose list, in words after the Industrial Robot Language (DIN 66312). The grammar is ours
 * (docs/languages/l-irl.md): that of L-IRL is not public, and no controller has been shown this text.
 */
export const poseList: Dialect = skippingDialect(
  {
    id: "l-irl",
    brand: "Any robot",
    name: "Pose list (after L-IRL)",
    extensions: [".poses.txt"],
    maturity: "experimental",
    cannot: CANNOT,
    emit: (program, robot, worldFromBase = identity()) => emitPoseList(program, robot, worldFromBase),
    parse: (text, robot, worldFromBase = identity()) => parsePoseList(text, robot, worldFromBase),
    interpret: (text, robot, worldFromBase = identity()) => interpretPoseList(text, robot, worldFromBase),
    lines: LINES,
  },
  isListOfPlaces,
);
