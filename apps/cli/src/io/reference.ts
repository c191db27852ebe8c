import type { Command } from "./usage.ts";

/** docs/cli.md: every command with what `--help` says of it, in the order of `twincell --help`. */
export const cliReference = (commands: readonly Command[]): string => `# Command line

Written from \`--help\` by \`node scripts/write-cli.mjs\`; a test holds it to the commands. Start with [five minutes](start.md).

SI units and radians; joints count from 1. Exit 0 fine, 1 the thing checked is not fine, 2 wrong use or unreadable input.

${commands.map(({ name, summary }) => `- [\`${name}\`](#${name}): ${summary}`).join("\n")}

${commands.map(({ name, usage }) => `## ${name}\n\n\`\`\`text\n${usage}\n\`\`\`\n`).join("\n")}`;
