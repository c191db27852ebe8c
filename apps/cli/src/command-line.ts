import { addCatalogue, Fault } from "@twincell/core";
import { CATALOGUE } from "@twincell/core/catalogue";
import { COMMANDS } from "./commands/index.ts";
import { missingPart } from "./io/optional-parts.ts";
import { UseFault } from "./io/usage.ts";

const WIDEST = Math.max(...COMMANDS.map(({ name }) => name.length));
const help = (): string => `twincell COMMAND [options]

${COMMANDS.map(command => `  ${command.name.padEnd(WIDEST)} ${command.summary}`).join("\n")}

Every command takes --help. SI units and radians; joints count from 1.
Exit 0 fine, 1 the thing checked is not fine, 2 wrong use or unreadable input.
Twincell is not a certified safety device.
`;

async function main(argv: readonly string[]): Promise<number> {
  const [name, ...rest] = argv;
  if (name === undefined || name === "--help" || name === "-h" || name === "help") {
    process.stdout.write(help());
    return name === undefined ? 2 : 0;
  }
  const command = COMMANDS.find(each => each.name === name);
  if (!command)
    throw new UseFault(`There is no command "${name}".`, `Commands: ${COMMANDS.map(each => each.name).join(", ")}.`);
  if (rest.includes("--help") || rest.includes("-h")) {
    process.stdout.write(`${command.usage}\n`);
    return 0;
  }
  return command.run(rest);
}

/** Carries out one line of the command line; the exit code is set, a fault is one sentence on stderr. */
export async function runCommandLine(argv: readonly string[]): Promise<void> {
  addCatalogue(CATALOGUE);
  try {
    process.exitCode = await main(argv);
  } catch (problem) {
    const part = missingPart(problem);
    if (part !== undefined) {
      process.stderr.write(`twincell: ${part}\n`);
      process.exit(2);
    }
    if (!(problem instanceof Fault)) throw problem;
    process.stderr.write(`twincell: ${problem.message}${problem.hint ? ` ${problem.hint}` : ""}\n`);
    process.exitCode = 2;
  }
}
