import type { Command } from "../io/usage.ts";
import { benchCommand } from "./bench.ts";
import { fkCommand } from "./fk.ts";
import { ikCommand } from "./ik.ts";
import { robotsCommand } from "./robots.ts";
import { serveCommand } from "./serve.ts";

export const COMMANDS: readonly Command[] = [robotsCommand, fkCommand, ikCommand, serveCommand, benchCommand];
