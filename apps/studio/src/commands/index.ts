import type { Checking } from "../live/checking.ts";
import type { RunSession } from "../live/run-session.ts";
import type { TravelBack } from "../live/travel-back.ts";
import { registerCommands } from "../stores/commands.ts";
import { checkCommands } from "./check.ts";
import { editCommands } from "./edit.ts";
import { jogCommands } from "./jog.ts";
import { playCommands } from "./play.ts";
import { programCommands } from "./program.ts";
import { runCommands } from "./run.ts";
import { viewCommands } from "./view.ts";

/** Commands that need no part of the page. Features add theirs while they are on screen. */
export const startCommands = (checking: Checking, session: RunSession, back: TravelBack): (() => void) => registerCommands([...runCommands(session, back), ...checkCommands(checking), ...programCommands(), ...jogCommands(), ...playCommands(), ...viewCommands(), ...editCommands()]);
