import type { Checking } from "../runtime/planning/checking.ts";
import { registerCommands } from "../stores/commands.ts";
import { buildCommands } from "./build.ts";
import { checkCommands } from "./check.ts";
import { editCommands } from "./edit.ts";
import { jogCommands } from "./jog.ts";
import { languageCommands } from "./language.ts";
import { playCommands } from "./play.ts";
import { programCommands } from "./program.ts";
import { viewCommands } from "./view.ts";

/** Commands that need no part of the page. Features add theirs while they are on screen. */
export const startCommands = (checking: Checking): (() => void) =>
  registerCommands([
    // First: in Cell mode their keys are theirs.
    ...buildCommands(),
    ...checkCommands(checking),
    ...programCommands(),
    ...jogCommands(),
    ...playCommands(),
    ...viewCommands(),
    ...languageCommands(),
    ...editCommands(),
  ]);
