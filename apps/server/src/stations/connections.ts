import { existsSync, mkdirSync, readFileSync, renameSync, writeFileSync } from "node:fs";
import { dirname, isAbsolute, join } from "node:path";
import { PlainFault, type CommandOutcome, type Scheduler } from "@twincell/core";
import { readConnectionRequest, type RequestOf, type RobotServer } from "@twincell/protocol";
import { joinHost } from "./join.ts";

/** A robot as a file of connections keeps it; `cell` is the path of its saved cell, from the file's own folder. */
export interface SavedConnection {
  readonly id: string;
  readonly driver: string;
  readonly model: string;
  readonly name?: string;
  /** Left out: a virtual controller is started beside the server. */
  readonly address?: { readonly host: string; readonly ports?: Readonly<Record<string, number>> };
  readonly cell?: string;
  /** Opened to watch: nothing is commanded. */
  readonly watch?: boolean;
}
const FORMAT = "twincell.connections";
const VERSION = 1;
const KEYS: readonly (keyof SavedConnection)[] = ["id", "driver", "model", "name", "address", "cell", "watch"];
/** A controller that does not answer when the server starts is asked again this often [s]. */
const AGAIN_S = 10;

const fault = (path: string, sentence: string): PlainFault =>
  new PlainFault("connections.file", `${path}: ${sentence}`, "docs/cli.md says how a file of connections is written.");
const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

/** @throws {PlainFault} with the place of what is wrong. */
export function readConnections(path: string): readonly SavedConnection[] {
  let value: unknown;
  try {
    value = JSON.parse(readFileSync(path, "utf8"));
  } catch (problem) {
    throw fault(path, problem instanceof Error ? `${problem.message}.` : String(problem));
  }
  if (!isRecord(value) || value["format"] !== FORMAT || !Array.isArray(value["robots"]))
    throw fault(path, `it is no file of connections: {"format":"${FORMAT}","version":${VERSION},"robots":[…]} is.`);
  if (value["version"] !== VERSION)
    throw fault(path, `it is of version ${String(value["version"])}; this release reads version ${VERSION}.`);
  const seen = new Set<unknown>();
  return value["robots"].map((robot: unknown, i) => {
    const place = `robots[${i}]`;
    if (!isRecord(robot)) throw fault(path, `${place} is no robot.`);
    const strange = Object.keys(robot).find(key => !(KEYS as readonly string[]).includes(key));
    if (strange !== undefined) throw fault(path, `${place} has a key “${strange}” that nothing reads.`);
    for (const key of ["id", "driver", "model"])
      if (typeof robot[key] !== "string" || robot[key] === "") throw fault(path, `${place} has no ${key}.`);
    if (robot["cell"] !== undefined && typeof robot["cell"] !== "string")
      throw fault(path, `${place}: cell wants the path of a saved cell.`);
    if (seen.has(robot["id"])) throw fault(path, `${place}: “${String(robot["id"])}” is there twice.`);
    seen.add(robot["id"]);
    const saved = robot as unknown as SavedConnection;
    const read = readConnectionRequest(JSON.stringify({ ...openRequest(saved), id: 0 }));
    if (read.kind === "fault") throw fault(path, `${place}: ${read.sentence}`);
    return saved;
  });
}

/** Puts a connection into the file, in the place of the one with its id; the file is made where there is none. */
export function saveConnection(path: string, connection: SavedConnection): void {
  const others = existsSync(path) ? readConnections(path).filter(({ id }) => id !== connection.id) : [];
  const text = JSON.stringify({ format: FORMAT, version: VERSION, robots: [...others, connection] }, null, 2);
  mkdirSync(dirname(path), { recursive: true });
  // Written beside and put in its place: a crash leaves the old one or the new one.
  writeFileSync(`${path}.new`, `${text}\n`);
  renameSync(`${path}.new`, path);
}

function openRequest(
  { id, driver, model, name, address, watch }: SavedConnection,
  cell?: unknown,
): Omit<RequestOf<"open">, "id"> {
  return {
    type: "open",
    station: id,
    brand: driver,
    robot: model,
    ...(name === undefined ? {} : { name }),
    ...(address ? { address: { host: address.host, ...(address.ports ? { ports: { ...address.ports } } : {}) } } : {}),
    ...(watch === undefined ? {} : { watch }),
    ...(cell === undefined ? {} : { cell }),
  };
}

/**
 * Opens and connects the robots of a file. One that is refused or does not answer is said with its name and keeps no
 * other from being opened; a controller that does not answer is asked again until it does or its robot is closed.
 */
export function restoreConnections(
  host: RobotServer,
  path: string,
  scheduler: Scheduler,
  say: (sentence: string) => void,
): { readonly restored: Promise<void>; close(): void } {
  const robots = readConnections(path);
  const open = new Set<string>();
  const { client, close } = joinHost(host, "server start", message => {
    if (message.type === "closed") open.delete(message.station);
  });
  const stops: (() => void)[] = [];
  const refusal = (id: string, outcome: CommandOutcome): boolean => {
    if (outcome.kind === "done") return false;
    say(`${id}: ${outcome.why.sentence} ${outcome.why.hint}`);
    return true;
  };
  const cellOf = ({ cell }: SavedConnection): unknown => {
    if (cell === undefined) return undefined;
    const at = isAbsolute(cell) ? cell : join(dirname(path), cell);
    return JSON.parse(readFileSync(at, "utf8")) as unknown;
  };
  async function restore(robot: SavedConnection): Promise<void> {
    const { id } = robot;
    let cell: unknown;
    try {
      cell = cellOf(robot);
    } catch (problem) {
      say(
        `${id}: its cell ${robot.cell} cannot be read: ${problem instanceof Error ? problem.message : String(problem)}.`,
      );
      return;
    }
    if (refusal(id, await client.ask(openRequest(robot, cell)))) return;
    open.add(id);
    const connect = (): Promise<CommandOutcome> => client.ask({ type: "connect", station: id });
    if (!refusal(id, await connect())) return;
    let asking = false;
    const stop = scheduler.every(AGAIN_S, () => {
      if (!open.has(id)) stop();
      if (asking || !open.has(id)) return;
      asking = true;
      void connect().then(outcome => {
        asking = false;
        if (outcome.kind !== "done") return;
        stop();
        say(`${id} is connected.`);
      });
    });
    stops.push(stop);
  }
  return {
    restored: Promise.all(robots.map(restore)).then(() => undefined),
    close() {
      for (const stop of stops) stop();
      close();
    },
  };
}
