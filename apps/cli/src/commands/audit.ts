import { auditFile, readAudit } from "@twincell/server";
import { given } from "../io/arguments.ts";
import { readText } from "../io/files.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const auditCommand: Command = {
  name: "audit",
  summary: "who did what at a server, and whether that log was changed",
  usage: `twincell audit --data DIR [--who NAME] [--robot ID]

Writes the lines of the log as JSON: number, time, who, action, robot, detail, outcome. Each carries the hash of the one before: a line that was
changed, put in or taken out is named (exit 1). The last hash goes to stderr; keep it elsewhere to notice when the end of the log is cut off.

  --who NAME   what that one did, alone
  --robot ID   what was done at that robot, alone`,
  async run(args) {
    const options = given(args, {
      data: { type: "string" },
      who: { type: "string" },
      robot: { type: "string" },
      json: { type: "boolean" },
    });
    const data = options.text("data");
    if (data === undefined) throw new UseFault("--data is missing.", "Give the data folder of the server.");
    if (options.positionals.length > 0) throw new UseFault(`audit takes no argument "${options.positionals[0]}".`);
    const { lines, verdict } = readAudit(await readText(auditFile(data)));
    const who = options.text("who");
    const robot = options.text("robot");
    for (const line of lines)
      if ((who === undefined || line.who === who) && (robot === undefined || line.robot === robot))
        process.stdout.write(`${JSON.stringify(line)}\n`);
    if (verdict.kind === "broken") {
      process.stderr.write(`twincell: line ${verdict.line} of the log: ${verdict.sentence}.\n`);
      return 1;
    }
    process.stderr.write(`${verdict.lines} lines, none changed. Last hash: ${verdict.last}\n`);
    return 0;
  },
};
