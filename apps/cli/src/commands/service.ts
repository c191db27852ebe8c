import { realpathSync } from "node:fs";
import { isAbsolute } from "node:path";
import { given } from "../io/arguments.ts";
import { serveArguments } from "../io/serve-options.ts";
import { UseFault, type Command } from "../io/usage.ts";

const PLAIN = /^[\w./@:+,-]+$/;
/** A word of a unit file: systemd knows `%` and `$` besides quotes and blanks. */
function word(name: string, text: string): string {
  if (!PLAIN.test(text))
    throw new UseFault(
      `${name} “${text}” has characters that a unit file reads otherwise.`,
      "Use letters, digits and . _ - / : @ + ,",
    );
  return text;
}

export const serviceCommand: Command = {
  name: "service",
  summary: "a systemd unit that starts the server with the machine",
  usage: `twincell service --data DIR [--config FILE] [--user NAME] > /etc/systemd/system/twincell.service

Prints a systemd unit for twincell serve --log json: started again after a crash, stopped by SIGTERM (every robot is stopped and waited for
until it stands), without rights beyond its data folder. Then: systemctl daemon-reload && systemctl enable --now twincell

  --data DIR     absolute path of the data folder; it must belong to the user
  --config FILE  absolute path of a file of settings (docs/operations.md); checked now
  --user NAME    who it runs as (default twincell)`,
  run(args) {
    const options = given(args, { data: { type: "string" }, config: { type: "string" }, user: { type: "string" } });
    if (options.positionals.length) throw new UseFault(`service takes no argument "${options.positionals[0]}".`);
    const data = options.text("data");
    const config = options.text("config");
    if (data === undefined) throw new UseFault("--data is missing.", "Name the folder: --data /var/lib/twincell.");
    for (const [name, path] of [
      ["--data", data],
      ["--config", config],
    ] as const)
      if (path !== undefined && !isAbsolute(path)) throw new UseFault(`${name} wants an absolute path, not ${path}.`);
    if (config !== undefined) serveArguments([`--config=${config}`], {});
    const command = [
      word("The path of Node", process.execPath),
      word("The path of Twincell", realpathSync(process.argv[1]!)),
      "serve",
      "--log=json",
      `--data=${word("--data", data)}`,
      ...(config === undefined ? [] : [`--config=${word("--config", config)}`]),
    ];
    process.stdout.write(`[Unit]
Description=Twincell
After=network-online.target
Wants=network-online.target

[Service]
Type=exec
User=${word("--user", options.text("user") ?? "twincell")}
ExecStart=${command.join(" ")}
Restart=on-failure
RestartSec=2
KillSignal=SIGTERM
KillMode=mixed
TimeoutStopSec=20
NoNewPrivileges=yes
ProtectSystem=strict
ProtectHome=read-only
ReadWritePaths=${data}
PrivateTmp=yes
PrivateDevices=yes
ProtectKernelTunables=yes
ProtectControlGroups=yes
RestrictSUIDSGID=yes
LimitNOFILE=65536

[Install]
WantedBy=multi-user.target
`);
    return Promise.resolve(0);
  },
};
