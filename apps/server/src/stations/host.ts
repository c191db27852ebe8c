import {
  driverKindById,
  ALL_DRIVER_KINDS,
  createSharedCell,
  openRobotConnection,
  startSynchronized,
  type PrepareJob,
} from "@twincell/controllers";
import { robotById, type Refusal, type Scheduler } from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { readConnectionCell, readDocument } from "@twincell/project";
import {
  createRobotServer,
  PLUG_IN,
  type RequestOf,
  type RobotServer,
  type OpenedConnection,
} from "@twincell/protocol";
import { nodeNetwork } from "../sockets/node-network.ts";
import { plugInFor } from "./plug-in.ts";

const refused = (why: Refusal): OpenedConnection => ({ kind: "refused", why });
const noRobot = (id: string): OpenedConnection =>
  refused({
    code: "station.no-robot",
    sentence: `There is no robot “${id}” in the library.`,
    hint: "Choose one of the library.",
  });
/**
 * Of the one who commands: without a sign of life for this long the robot is stopped (row X-41 with the watch's own
 * period).
 */
const HEARTBEAT_S = 0.08;

/** Which controllers a server opens for whoever is in. */
export interface ConnectionRules {
  /** Virtual ones of its own alone: nobody reaches a real robot from here (row T-58). */
  readonly training?: boolean | undefined;
  /** The only addresses it connects to; every address when left out. */
  readonly robots?: readonly string[] | undefined;
}

/** Why a controller at that address is not opened here, or null. */
function addressRefusal({ training, robots }: ConnectionRules, host: string): Refusal | null {
  if (training === true)
    return {
      code: "station.training",
      sentence: "This server is for training: it opens virtual controllers only.",
      hint: "For a real robot start it without --training.",
    };
  if (robots === undefined || robots.includes(host)) return null;
  return {
    code: "station.address",
    sentence: `${host} is not among the addresses that this server may connect to.`,
    hint: `Start it with --robots ${[...robots, host].join(",")}.`,
  };
}

/**
 * Stations of this machine: drivers on the network, and virtual controllers beside them where no address is given.
 *
 * @param prepareJob  plans, checks and writes programs; where links run on real time, another thread does.
 */
export function stationHost(
  scheduler: Scheduler,
  version: string,
  layOut?: PrepareJob,
  rules: ConnectionRules = {},
): RobotServer {
  const network = nodeNetwork();
  const cell = createSharedCell();
  return createRobotServer({
    scheduler,
    version,
    brands: ALL_DRIVER_KINDS.map(({ id, name, vendor, dialect, ports }) => ({
      id,
      name,
      vendor,
      dialect,
      ports: { ...ports },
    })),
    together: (members, onStarted) => startSynchronized(members, scheduler, onStarted),
    async open(ask: RequestOf<"open">): Promise<OpenedConnection> {
      // A robot that is in no library comes with its cell.
      if (robotById(ask.robot) === undefined && ask.cell !== undefined) readDocument(ask.cell);
      const robot = robotById(ask.robot);
      const brand = ask.brand === PLUG_IN && robot ? plugInFor(robot) : driverKindById(ask.brand);
      const dialect = brand && dialectById(brand.dialect);
      if (ask.brand === PLUG_IN && !robot) return noRobot(ask.robot);
      if (ask.brand === PLUG_IN && !ask.address)
        return refused({
          code: "station.no-address",
          sentence: "A plug-in runs by itself, and where was not said.",
          hint: "Start it and give its address.",
        });
      if (!brand || !dialect)
        return refused({
          code: "station.no-brand",
          sentence: `There is no driver for “${ask.brand}”.`,
          hint: `There are: ${ALL_DRIVER_KINDS.map(({ id }) => id).join(", ")}, ${PLUG_IN}.`,
        });
      if (!robot) return noRobot(ask.robot);
      const why = ask.address ? addressRefusal(rules, ask.address.host) : null;
      if (why) return refused(why);
      return openRobotConnection({
        id: ask.station,
        brand,
        robot,
        scheduler,
        dialect,
        readCell: readConnectionCell,
        ...(ask.cell === undefined ? {} : { cell: ask.cell }),
        heartbeat_s: HEARTBEAT_S,
        ...(layOut ? { layOut } : {}),
        ...(ask.stand ? { shared: { cell, stand: ask.stand } } : {}),
        ...(ask.watch === undefined ? {} : { watching: ask.watch }),
        ...(ask.name === undefined ? {} : { name: ask.name }),
        ...(ask.worldFromBase ? { worldFromBase: ask.worldFromBase } : {}),
        ...(ask.address
          ? {
              at: {
                network,
                host: ask.address.host,
                ...(ask.address.ports ? { ports: ask.address.ports } : {}),
                ...(ask.address.data ? { data: ask.address.data } : {}),
              },
            }
          : {}),
      });
    },
  });
}
