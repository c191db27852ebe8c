import { ALL_DRIVER_KINDS, driverKindById, type DriverKind } from "@twincell/controllers";
import { addOwnRobot, falseIdentity, robotById, type CommandOutcome, type Robot } from "@twincell/core";
import type { Client, ConnectionInfo, EventOf, Request } from "@twincell/protocol";
import {
  joinHost,
  joinServer,
  nodeScheduler,
  prepareJobInWorker,
  schedulerWith,
  stationHost,
  type Joined,
  type Told,
} from "@twincell/server";
import type { Given } from "./arguments.ts";
import { readCell } from "./program.ts";
import { robotOf, ROBOT_OPTIONS } from "./robot.ts";
import { UseFault } from "./usage.ts";

/** Where `serve` listens when nobody says otherwise. */
const SERVER_PORT = 7341;
/** A commander says that it is there this often [ms]; a server stops the robot after 80 ms of silence. */
const ALIVE_MS = 20;
/** A robot that is only begun to be heard of says something within this [s]. */
const FIRST_S = 5;
/** What a robot is called at the host of this process. */
const HERE = "robot";

/** `realTime` is asked for as `--port-real-time`. */
export const portOption = (name: string): string =>
  `port-${name.replace(/[A-Z]/g, letter => `-${letter.toLowerCase()}`)}`;

export const AT_OPTIONS = {
  at: { type: "string" },
  station: { type: "string" },
  token: { type: "string" },
  driver: { type: "string" },
  cell: { type: "string" },
  ...ROBOT_OPTIONS,
  ...Object.fromEntries(
    ALL_DRIVER_KINDS.flatMap(({ ports }) =>
      Object.keys(ports).map(name => [portOption(name), { type: "string" as const }]),
    ),
  ),
} as const;
/** For commands that move. */
export const COMMANDER_OPTIONS = {
  ...AT_OPTIONS,
  speed: { type: "string" },
  confirm: { type: "boolean" },
} as const;

export const AT_HELP = `  --at HOST[:PORT]  a running server (twincell serve; port ${SERVER_PORT} when left out, or its http:// address), or with --driver a controller
  --station ID      which robot of the server; left out where it has one
  --token T         of twincell token add, where the server asks for one (or TWINCELL_TOKEN)
  --driver D        goes to a controller directly, without a server: ${ALL_DRIVER_KINDS.map(({ id }) => id).join(", ")}
  --robot R         with --driver: the model, an id of twincell robots or a robot file with a vendor section; --port-NAME N for ports that are not the vendor's own
  --cell CELL       with --driver: the saved cell it stands in, which its guard keeps it from`;
export const COMMANDER_HELP = `${AT_HELP}
  --speed PERCENT   override while this command runs
  --confirm         you have looked at the robot: it may go on after its link was lost, or go back to its last safe pose
This holds lease and enabling switch for as long as it runs; Ctrl-C stops the robot, and so does silence. Writes the outcome as JSON:
{"kind":"done"}, or "refused" or "stopped" with {"code","sentence","hint"}; exit 0 done, 1 otherwise. Not a certified safety device.`;

/** A robot that somebody looks at or commands, at a server or at its controller. */
export interface RobotAt {
  readonly info: ConnectionInfo;
  readonly robot: Robot;
  readonly client: Client;
  /** What was told last. */
  readonly sample: EventOf<"sample"> | null;
  onTold(listen: (message: Told) => void): () => void;
  /** Resolves with the first sample that fits. */
  until(fits: (sample: EventOf<"sample">) => boolean, most_s?: number): Promise<boolean>;
  /** Resolves with a sentence when the connection ends by itself. */
  readonly ended: Promise<string | null>;
  close(): Promise<void>;
}

/**
 * The robot of `--at`.
 *
 * @param watching  only to be looked at: a controller is opened so that whoever commands it is left alone.
 */
export async function robotAt(options: Given, watching: boolean): Promise<RobotAt> {
  const at = options.text("at");
  if (at === undefined)
    throw new UseFault("--at is missing.", "Give a running server, HOST[:PORT], or with --driver a controller.");
  const id = options.text("driver");
  return id === undefined ? atServer(options, at) : atController(options, at, driverOf(id), watching);
}

export function driverOf(id: string): DriverKind {
  const driver = driverKindById(id);
  if (driver) return driver;
  throw new UseFault(`There is no driver "${id}".`, `Drivers: ${ALL_DRIVER_KINDS.map(each => each.id).join(", ")}.`);
}

/** The address of a server as people write it. */
export function serverUrl(at: string): URL {
  const whole = /^https?:\/\//.test(at) ? at : `http://${at}`;
  if (!URL.canParse(whole)) throw new UseFault(`--at wants HOST or HOST:PORT, not "${at}".`);
  const url = new URL(whole);
  if (url.port === "" && url.protocol === "http:" && !/:80(\/|$)/.test(at)) url.port = String(SERVER_PORT);
  return url;
}

/** Hears what a host tells, and knows what it told last. */
function hearing() {
  const listeners = new Set<(message: Told) => void>();
  const stations = new Map<string, ConnectionInfo>();
  let sample: EventOf<"sample"> | null = null;
  let station = "";
  let greeted: () => void = () => undefined;
  const hello = new Promise<void>(resolve => {
    greeted = resolve;
  });
  return {
    stations,
    hello,
    get sample() {
      return sample;
    },
    choose(id: string) {
      station = id;
    },
    hear(message: Told) {
      if (message.type === "hello") {
        for (const info of message.stations) stations.set(info.id, info);
        greeted();
      }
      if (message.type === "opened") {
        const { id, name, brand, robot, virtual, watchdog } = message;
        stations.set(id, { id, name, brand, robot, virtual, watchdog });
      }
      if (message.type === "closed") stations.delete(message.station);
      if (message.type === "sample" && message.station === station) sample = message;
      for (const listen of listeners) listen(message);
    },
    onTold(listen: (message: Told) => void) {
      listeners.add(listen);
      return () => {
        listeners.delete(listen);
      };
    },
  };
}
type Hearing = ReturnType<typeof hearing>;

/** Goes in at a server and waits until it says who is there. */
export async function greetServer(options: Given, at: string): Promise<{ joined: Joined; heard: Hearing; url: URL }> {
  const url = serverUrl(at);
  const heard = hearing();
  const joined = joinServer(
    url,
    message => heard.hear(message),
    options.text("token") ?? process.env["TWINCELL_TOKEN"],
  );
  const why = await Promise.race([heard.hello.then(() => null), joined.ended.then(sentence => sentence ?? "")]);
  if (why !== null)
    throw new UseFault(why, "Start it with twincell serve, or name a controller's driver with --driver.");
  return { joined, heard, url };
}

async function atServer(options: Given, at: string): Promise<RobotAt> {
  const { joined, heard, url } = await greetServer(options, at);
  const all = [...heard.stations.values()];
  const asked = options.text("station");
  const info = asked === undefined ? (all.length === 1 ? all[0] : undefined) : heard.stations.get(asked);
  if (!info) {
    joined.close();
    const there = all.map(({ id, name }) => `${id} (${name})`).join(", ");
    throw new UseFault(
      asked !== undefined
        ? `The server at ${url.host} has no robot "${asked}".`
        : all.length === 0
          ? `No robot is open at ${url.host}.`
          : `${all.length} robots are open at ${url.host}: say which.`,
      all.length === 0 ? "Open one with twincell connect." : `--station takes one of ${there}.`,
    );
  }
  heard.choose(info.id);
  return robotOver(joined, heard, info, () => {
    joined.close();
    return Promise.resolve();
  });
}

async function atController(options: Given, at: string, driver: DriverKind, watching: boolean): Promise<RobotAt> {
  const { robot } = await robotOf(options);
  const wrong = falseIdentity(robot);
  if (wrong !== undefined) throw new UseFault(wrong, "Give the file of the robot itself, with its own vendor section.");
  if (robotById(robot.id) !== robot) addOwnRobot(robot);
  const cellPath = options.text("cell");
  const cell = cellPath === undefined ? undefined : await readCell(cellPath);
  const { host: address, ports } = addressOf(options, at, driver);
  const programs = prepareJobInWorker();
  const parts: { joined?: Joined } = {};
  // Commander and guard share this process: however late a tick comes, the one was there before the other looks.
  const host = stationHost(
    schedulerWith(nodeScheduler, () => parts.joined?.client.alive(HERE)),
    "",
    programs.layOut,
  );
  const heard = hearing();
  heard.choose(HERE);
  const joined = (parts.joined = joinHost(host, "command line", message => heard.hear(message)));
  const close = async (): Promise<void> => {
    const { stations } = heard;
    // Whoever closes a robot that moves stops it first: that takes its time.
    if (stations.has(HERE)) await joined.client.ask({ type: "close", station: HERE });
    joined.close();
    host.close();
    programs.close();
  };
  const refusedBy = async (outcome: CommandOutcome): Promise<void> => {
    if (outcome.kind === "done") return;
    await close();
    throw new UseFault(outcome.why.sentence, outcome.why.hint);
  };
  await refusedBy(
    await joined.client.ask({
      type: "open",
      station: HERE,
      brand: driver.id,
      robot: robot.id,
      address: { host: address, ports },
      ...(cell === undefined ? {} : { cell, worldFromBase: cell.robot.worldFromBase }),
      ...(watching && !driver.cannot.some(({ row }) => row === "watch") ? { watch: true } : {}),
    }),
  );
  await refusedBy(await joined.client.ask({ type: "connect", station: HERE }));
  return robotOver(joined, heard, heard.stations.get(HERE)!, close);
}

/** HOST[:PORT] and `--port-NAME`: a port without a name is the driver's first. */
export function addressOf(
  options: Given,
  at: string,
  driver: DriverKind,
): { readonly host: string; readonly ports: Readonly<Record<string, number>> } {
  const [, host, port] = /^(?:https?:\/\/)?\[?([^\s/[\]]+?)\]?(?::(\d+))?$/.exec(at) ?? [];
  if (host === undefined) throw new UseFault(`An address is HOST or HOST:PORT, not "${at}".`);
  const ports: Record<string, number> = {};
  const names = Object.keys(driver.ports);
  const put = (name: string, value: number, option: string): void => {
    if (!Number.isInteger(value) || value < 1 || value > 65_535)
      throw new UseFault(`${option} wants a whole number from 1 to 65535, not ${value}.`);
    ports[name] = value;
  };
  if (port !== undefined && names[0] !== undefined) put(names[0], Number(port), "The port of an address");
  for (const name of names) {
    const value = options.number(portOption(name));
    if (value !== undefined) put(name, value, `--${portOption(name)}`);
  }
  return { host, ports };
}

async function robotOver(
  joined: Joined,
  heard: Hearing,
  info: ConnectionInfo,
  close: () => Promise<void>,
): Promise<RobotAt> {
  const robot = robotById(info.robot);
  if (!robot) {
    await close();
    throw new UseFault(`${info.name} is a "${info.robot}", which this release does not know.`);
  }
  const until = (fits: (sample: EventOf<"sample">) => boolean, most_s = FIRST_S): Promise<boolean> =>
    new Promise(resolve => {
      const end = (came: boolean): void => {
        off();
        clearTimeout(timer);
        resolve(came);
      };
      const timer = setTimeout(() => {
        end(false);
      }, most_s * 1000);
      const off = heard.onTold(message => {
        if (message.type === "sample" && message.station === info.id && fits(message)) end(true);
      });
      if (heard.sample && fits(heard.sample)) end(true);
    });
  return {
    info,
    robot,
    client: joined.client,
    get sample() {
      return heard.sample;
    },
    onTold: heard.onTold,
    until,
    ended: joined.ended,
    close,
  };
}

/**
 * Commands a robot as long as `act` lasts: lease, enabling switch and signs of life are this process's, Ctrl-C stops
 * the robot. Says the outcome on standard output.
 */
export async function commandAt(
  options: Given,
  act: (at: RobotAt, ask: (request: Request) => Promise<CommandOutcome>) => Promise<CommandOutcome>,
): Promise<number> {
  const at = await robotAt(options, false);
  const station = at.info.id;
  const { client } = at;
  const ask = (request: Request): Promise<CommandOutcome> => client.ask(request);
  const alive = setInterval(() => {
    client.alive(station);
  }, ALIVE_MS);
  const stop = (): void => {
    client.stop(station);
  };
  for (const signal of ["SIGINT", "SIGTERM"] as const) process.on(signal, stop);
  const offNotices = at.onTold(message => {
    if (message.type === "notice" && message.station === station)
      process.stderr.write(`twincell: ${message.why.sentence} ${message.why.hint}\n`);
  });
  try {
    const outcome = await inOrder([
      () => ask({ type: "take", station }),
      ...(options.flag("confirm") ? [() => ask({ type: "confirm", station })] : []),
      () => ask({ type: "hold", station, pressed: true }),
      ...(options.number("speed") === undefined
        ? []
        : [() => ask({ type: "speed", station, percent: options.number("speed")! })]),
      async () =>
        (await at.until(() => true))
          ? act(at, ask)
          : {
              kind: "refused",
              why: {
                code: "cli.silent",
                sentence: `${at.info.name} said nothing for ${FIRST_S} s.`,
                hint: "Connect it: twincell connect.",
              },
            },
    ]);
    await ask({ type: "hold", station, pressed: false });
    await ask({ type: "release", station });
    process.stdout.write(`${JSON.stringify(outcome)}\n`);
    if (outcome.kind === "done") return 0;
    process.stderr.write(`twincell: ${outcome.why.sentence} ${outcome.why.hint}\n`);
    return 1;
  } finally {
    for (const signal of ["SIGINT", "SIGTERM"] as const) process.removeListener(signal, stop);
    offNotices();
    clearInterval(alive);
    await at.close();
  }
}

/** One after the other, up to the first that is not done. */
async function inOrder(acts: readonly (() => Promise<CommandOutcome>)[]): Promise<CommandOutcome> {
  for (const act of acts) {
    const outcome = await act();
    if (outcome.kind !== "done") return outcome;
  }
  return { kind: "done" };
}
