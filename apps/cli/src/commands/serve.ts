import { existsSync } from "node:fs";
import { join } from "node:path";
import { spawn } from "node:child_process";
import { serve, type Served, type ServeOptions } from "@twincell/server";
import { toString as qrText } from "qrcode";
import { given } from "../io/arguments.ts";
import { checkPort, NATS_OPTIONS, natsOf, STANDARD_OPTIONS, standardsOf } from "../io/standards.ts";
import { studioFolder } from "../io/studio-folder.ts";
import { UseFault, type Command } from "../io/usage.ts";

const DEFAULT_PORT = 7341;
const studio = studioFolder();

export const serveCommand: Command = {
  name: "serve",
  summary: "serve the studio on this machine, or on the local network with --lan",
  usage: `twincell serve [--port P] [--data DIR] [--lan] [--robots HOST,…] [--connections FILE] [--accounts] [--training] [--open]
               [--opcua P] [--rosbridge P] [--foxglove P] [--modbus P [--modbus-lines FILE]] [--sparkplug URL [--sparkplug-node GROUP/NODE]]
               [--webhooks FILE] [--otlp URL] [--nats HOST:PORT,… --site NAME [--nats-replicas N] [--nats-hours H]]

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
  --otlp URL   sends traces to an OpenTelemetry collector (http://host:4318)
  --accounts   people sign in by name (needs --data); the first start prints a link that works once and makes the first admin
  --nats A,B,C --site NAME  tells a NATS cluster (host:port) of its robots under that name and hears of those of others (docs/scale.md);
               --nats-replicas N copies of what is kept (default 1; 3 in a cluster of three), --nats-hours H how long states are kept (default 168)
  --training   virtual controllers only: nobody reaches a real robot from here
  --open       open the address in a browser where there is one`,
  async run(args) {
    const options = given(args, {
      port: { type: "string" },
      data: { type: "string" },
      lan: { type: "boolean" },
      robots: { type: "string" },
      accounts: { type: "boolean" },
      training: { type: "boolean" },
      connections: { type: "string" },
      open: { type: "boolean" },
      ...STANDARD_OPTIONS,
      ...NATS_OPTIONS,
    });
    if (options.positionals.length) throw new UseFault(`serve takes no argument "${options.positionals[0]}".`);
    const port = options.number("port");
    checkPort("port", port);
    if (!existsSync(`${studio}/index.html`))
      throw new UseFault("The studio is not built yet.", "Run npm run build, or npm start.");

    const data = options.text("data");
    const kept = data === undefined ? undefined : join(data, "connections.json");
    const connections = options.text("connections") ?? (kept !== undefined && existsSync(kept) ? kept : undefined);
    const robots = options
      .text("robots")
      ?.split(",")
      .map(each => each.trim())
      .filter(each => each !== "");
    const served = await listen(
      {
        studio,
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
    process.stdout.write(`Twincell is at ${served.url}\n`);
    for (const url of served.lanUrls)
      process.stdout.write(`From another machine: ${url}\n${await qrText(url, { type: "terminal", small: true })}`);
    if (served.code)
      process.stdout.write(
        `Access code: ${served.code}. Browsers will warn about the certificate, which was made here.\n`,
      );
    if (served.setUp !== null) process.stdout.write(`Set up the first admin, once: ${served.setUp}\n`);
    for (const address of served.standards) process.stdout.write(`${address}\n`);
    process.stdout.write("Not a certified safety device. Ctrl-C ends.\n");
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
