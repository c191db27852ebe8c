import { registerCommands } from "../stores/commands.ts";
import { editCommands } from "./edit.ts";
import { jogCommands } from "./jog.ts";
import { playCommands } from "./play.ts";
import { programCommands } from "./program.ts";
import { viewCommands } from "./view.ts";

/** Commands that need no part of the page. Features add theirs while they are on screen. */
export const startCommands = (): (() => void) => registerCommands([...programCommands(), ...jogCommands(), ...playCommands(), ...viewCommands(), ...editCommands()]);
