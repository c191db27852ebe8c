import { checkBackup, makeBackup, restoreBackup } from "@twincell/server";
import { given } from "../io/arguments.ts";
import { UseFault, type Command } from "../io/usage.ts";

export const backupCommand: Command = {
  name: "backup",
  summary: "a copy of a server's data folder, made while it runs",
  usage: `twincell backup make --data DIR --to FOLDER
twincell backup check FOLDER
twincell backup restore FOLDER --data DIR

Copies programs, cells, recordings, connections, accounts, tokens and the audit log with their SHA-256. A backup that was cut off or changed is
refused with the first file that is wrong; restoring writes into a folder that is empty or not there. Keep backups as you keep the folder: passwords
are kept as argon2id and tokens as hashes, secrets of webhooks as they are.`,
  async run(args) {
    const options = given(args, { data: { type: "string" }, to: { type: "string" } });
    const [verb, folder, ...more] = options.positionals;
    const data = options.text("data");
    const to = options.text("to");
    if (more.length > 0) throw new UseFault(`backup takes no argument "${more[0]}".`);
    const need = (value: string | undefined, name: string): string => {
      if (value === undefined) throw new UseFault(`${name} is missing.`);
      return value;
    };
    const done = ({ files, made }: Awaited<ReturnType<typeof checkBackup>>): number => {
      const bytes = files.reduce((sum, file) => sum + file.bytes, 0);
      process.stdout.write(`${JSON.stringify({ made, files: files.length, bytes })}\n`);
      return 0;
    };
    switch (verb) {
      case "make":
        return done(await makeBackup(need(data, "--data"), need(to, "--to"), new Date()));
      case "check":
        return done(await checkBackup(need(folder, "FOLDER")));
      case "restore":
        return done(await restoreBackup(need(folder, "FOLDER"), need(data, "--data")));
      default:
        throw new UseFault(`backup knows make, check and restore, not "${verb ?? ""}".`);
    }
  },
};
