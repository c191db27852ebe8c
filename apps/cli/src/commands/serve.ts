import { existsSync, writeFileSync } from "node:fs";
import { flushCompileCache } from "node:module";
import { join } from "node:path";
import { spawn } from "node:child_process";
import { jsonLog, serve, textLog, type Log, type Served, type ServeOptions } from "@twincell/server";
import { toString as qrText } from "qrcode";
import { given } from "../io/arguments.ts";
import cli from "../../package.json" with { type: "json" };
import { checkPort, natsOf, standardsOf } from "../io/standards.ts";
import { SERVE_OPTIONS, serveArguments } from "../io/serve-options.ts";
import { docsFolder, studioFolder } from "../io/studio-folder.ts";
import { UseFault, type Command } from "../io/usage.ts";

const DEFAULT_PORT = 7341;
const SETTINGS = Object.fromEntries(
  SERVE_OPTIONS.map(({ name, kind }) => [name, { type: kind === "flag" ? "boolean" : "string" } as const]),
);

export const serveCommand: Command = {
  name: "serve",
  summary: "serve the studio on this machine, or on the local network with --lan",
  usage: `twincell serve [--port P] [--data DIR] [--lan] [--robots HOST,…] [--connections FILE] [--accounts] [--training] [--open]
               [--opcua P] [--rosbridge P] [--foxglove P] [--modbus P [--modbus-lines FILE]] [--sparkplug URL [--sparkplug-node GROUP/NODE]]
               [--webhooks FILE] [--plc FILE] [--otlp URL] [--nats HOST:PORT,… --site NAME [--nats-replicas N] [--nats-hours H]]
               [--host ADDRESS] [--config FILE] [--log text|json] [--studio DIR]

  --port P     port to listen on (default ${DEFAULT_PORT}, or the next free one)
  --data DIR   where the server keeps what must survive it: its certificate, and the recordings of its stations
  --lan        also serve other machines: HTTPS, a QR code and an access code
  --robots A,B the only addresses of real controllers; without it every address, with --lan none but this machine
  --connections FILE  robots to open and connect when it starts; without it connections.json of --data, where there is one. Written by
               twincell connect --save: {"format":"twincell.connections","version":1,"robots":[{"id","driver","model","address":{"host","ports"},"cell","watch"}]}
  --opcua P, --rosbridge P, --foxglove P, --modbus P
               also speaks OPC UA (robotics companion model), rosbridge v2, Foxglove WebSocket, Modbus TCP on that port (docs/plant.md); 0 takes a free one
  --modbus-lines FILE  which lines are at which Modbus address: {"format":"twincell.modbus","version":1,"robots":{"arm":["in_1",…]}}
  --sparkplug URL  tells an MQTT broker (mqtt://host:1883) of every robot as Sparkplug B; --sparkplug-node GROUP/NODE (default plant/twincell)
  --webhooks FILE  addresses that are told what happens: {"format":"twincell.webhooks","version":1,"hooks":[{"url","events","robot","secret"}]}
  --plc FILE   follows nodes of a PLC's OPC UA server: {"format":"twincell.plc","version":1,"url","signals":[{"node","robot","line","from":"plc"|"robot"}]}
  --otlp URL   sends traces to an OpenTelemetry collector (http://host:4318)
  --accounts   people sign in by name (needs --data); the first start prints a link that works once and makes the first admin
  --nats A,B,C --site NAME  tells a NATS cluster (host:port) of its robots under that name and hears of those of others (docs/scale.md);
               --nats-replicas N copies of what is kept (default 1; 3 in a cluster of three), --nats-hours H how long states are kept (default 168)
  --training   virtual controllers only: nobody reaches a real robot from here
  --open       open the address in a browser where there is one
  --host A     address to listen on; without it loopback, with --lan every address
  --config FILE  settings as JSON, {"port":7341,"data":"/var/lib/twincell","lan":true}; each also as TWINCELL_SERVE_PORT=7341 in the environment.
               The command line wins over the environment, the environment over the file (docs/operations.md has the table)
  --studio DIR  another built studio to serve
  --log json   one JSON object a line on stdout, without secrets: the access code and the link of the first admin are then in
               access-code.txt and set-up-link.txt of --data, which only their owner may read

SIGINT and SIGTERM stop every robot, wait until it stands, finish recordings and logs, and end; exit 0. A second one ends at once.`,
  async run(args) {
    const options = given(serveArguments(args, process.env), SETTINGS);
    if (options.positionals.length) throw new UseFault(`serve takes no argument "${options.positionals[0]}".`);
    const port = options.number("port");
    checkPort("port", port);
    const other = options.text("studio");
    const studio = other ?? studioFolder();
    if (!existsSync(`${studio}/index.html`))
      throw other === undefined
        ? new UseFault("The studio is not built yet.", "Run npm run build, or npm start.")
        : new UseFault(`There is no built studio in ${other}.`, "Name the folder that has its index.html.");

    const docs = docsFolder();
    const data = options.text("data");
    const kept = data === undefined ? undefined : join(data, "connections.json");
    const connections = options.text("connections") ?? (kept !== undefined && existsSync(kept) ? kept : undefined);
    const robots = options
      .text("robots")
      ?.split(",")
      .map(each => each.trim())
      .filter(each => each !== "");
    const host = options.text("host");
    const kind = options.text("log") ?? "text";
    if (kind !== "text" && kind !== "json") throw new UseFault(`--log wants text or json, not ${kind}.`);
    const log = kind === "json" ? jsonLog(line => process.stdout.write(line), Date.now) : textLog(toStderr);
    const served = await listen(
      {
        studio,
        ...(docs === undefined ? {} : { docs }),
        log,
        version: cli.version,
        ...(host === undefined ? {} : { host }),
        port: port ?? DEFAULT_PORT,
        lan: options.flag("lan"),
        accounts: options.flag("accounts"),
        training: options.flag("training"),
        ...(robots === undefined ? {} : { robots }),
        ...(connections === undefined ? {} : { connections }),
        ...(data === undefined ? {} : { data }),
        standards: standardsOf(options),
        ...natsOf(options),
      },
      port === undefined,
    );
    if (kind === "json") announce(log, served, data);
    else await greet(served);
    // Kept now: a server that is killed later is back as quickly.
    flushCompileCache();
    if (options.flag("open")) openBrowser(served.url);

    await new Promise<void>(resolve => {
      for (const signal of ["SIGINT", "SIGTERM"] as const)
        process.once(signal, () => {
          resolve();
        });
    });
    await served.close();
    return 0;
  },
};

const toStderr = (line: string): void => {
  process.stderr.write(line);
};

async function greet(served: Served): Promise<void> {
  process.stdout.write(`Twincell is at ${served.url}\n`);
  for (const url of served.lanUrls)
    process.stdout.write(`From another machine: ${url}\n${await qrText(url, { type: "terminal", small: true })}`);
  if (served.code)
    process.stdout.write(
      `Access code: ${served.code}. Browsers will warn about the certificate, which was made here, until they trust its authority.\n`,
    );
  if (served.fingerprint !== null && served.lanUrls[0] !== undefined)
    process.stdout.write(
      `To trust it, open ${new URL("/trust/", served.lanUrls[0]).href} there; its authority is SHA-256 ${served.fingerprint}\n`,
    );
  if (served.setUp !== null) process.stdout.write(`Set up the first admin, once: ${served.setUp}\n`);
  for (const address of served.standards) process.stdout.write(`${address}\n`);
  process.stdout.write("Not a certified safety device. Ctrl-C ends.\n");
}

/** The same as lines of a log that others may read: what lets somebody in goes into files of the owner instead. */
function announce(log: Log, { url, code, setUp, standards }: Served, data: string | undefined): void {
  log.say("info", "listening", `Twincell is at ${url}`, { url: url.split("?")[0]! });
  for (const address of standards) log.say("info", "standard", address);
  for (const [file, text] of [
    ["access-code.txt", code],
    ["set-up-link.txt", setUp],
  ] as const) {
    if (text === null) continue;
    if (data === undefined) {
      log.say("warning", "secret", "There is an access code, and no --data to keep it in: it is not shown in a log.");
      continue;
    }
    const path = join(data, file);
    writeFileSync(path, `${text}\n`, { mode: 0o600 });
    log.say("info", "secret", `What lets people in is in ${path}.`);
  }
}

/** A port nobody asked for may be the next free one; a port that was asked for is that one or a sentence. */
async function listen(options: ServeOptions, mayMove: boolean): Promise<Served> {
  for (let port = options.port; ; port++) {
    try {
      return await serve({ ...options, port });
    } catch (problem) {
      const code = (problem as NodeJS.ErrnoException).code;
      if (code === "EADDRINUSE" && mayMove && port < options.port + 50) continue;
      if (code === "EADDRINUSE") throw new UseFault(`Port ${port} is already in use.`, "Choose another with --port.");
      if (code === "EACCES")
        throw new UseFault(`Port ${port} may not be used by this user.`, "Choose one above 1023 with --port.");
      throw problem;
    }
  }
}

function openBrowser(url: string): void {
  const [command, ...args] =
    process.platform === "darwin"
      ? ["open", url]
      : process.platform === "win32"
        ? ["cmd", "/c", "start", "", url]
        : ["xdg-open", url];
  if (process.platform === "linux" && !process.env["DISPLAY"] && !process.env["WAYLAND_DISPLAY"]) return;
  const child = spawn(command!, args, { stdio: "ignore", detached: true });
  child.on("error", () => {
    process.stdout.write("No browser could be opened; open the address by hand.\n");
  });
  child.unref();
}
