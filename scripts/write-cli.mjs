/** Writes docs/cli.md from the help of the commands: node scripts/write-cli.mjs. A test holds the file to it. */
import { writeFileSync } from "node:fs";
import { COMMANDS } from "../apps/cli/src/commands/index.ts";
import { cliReference } from "../apps/cli/src/io/reference.ts";

writeFileSync(new URL("../docs/cli.md", import.meta.url), cliReference(COMMANDS));
