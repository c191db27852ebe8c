import type { Command } from "../io/usage.ts";
import { benchCommand } from "./bench.ts";
import { serveCommand } from "./serve.ts";

export const COMMANDS: readonly Command[] = [serveCommand, benchCommand];
