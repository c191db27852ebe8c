import type { SignalLine } from "@twincell/core";
import {
  startedDriver,
  type DriverKind,
  type StartedDriver,
  type VendorVirtualOptions,
  type ControllerAdapter,
  type AdapterOptions,
} from "../driver/index.ts";
import { kukaAxes } from "./codec/axes.ts";
import { KUKA_CANNOT, KUKA_RSI_CANNOT } from "./cannot.ts";
import { C3_PORT } from "./codec/c3.ts";
import { axisConfig } from "./codec/rsi.ts";
import { createKukaAdapter } from "./adapter/adapter.ts";
import { createKukaRsiAdapter } from "./adapter/rsi-adapter.ts";
import { RSI_NAME } from "./codec/loop.ts";
import { kukaPendant } from "./virtual/pendant.ts";
import { createVirtualKuka, startLoop } from "./virtual/controller.ts";

const TERMINALS: Readonly<Record<SignalLine["kind"], string>> = {
  "digital-in": "$IN",
  "digital-out": "$OUT",
  "analogue-in": "$ANIN",
  "analogue-out": "$ANOUT",
};

/** Where the sensor file of a controller sends its telegrams when nothing else is set up. */
const RSI_PORT = 49_152;
/** Where a virtual controller on this machine sends them: its own address has the variables. */
const NEAR = "127.0.0.2";
/** A controller elsewhere sends to whichever address of this computer its sensor file names. */
const rsiConfig = (host: string, ports: AdapterOptions["ports"]) =>
  axisConfig(host.startsWith("127.") ? NEAR : "0.0.0.0", ports?.["rsi"] ?? RSI_PORT);
const overRsi = ({ robot, scheduler, network, host, ports }: AdapterOptions): ControllerAdapter =>
  createKukaRsiAdapter({
    robot,
    scheduler,
    network,
    host,
    port: ports?.["variables"] ?? C3_PORT,
    config: rsiConfig(host, ports),
  });

/** KUKA as apps meet it. The virtual controller begins in EXT with its drives on and the program TWINCELL running. */
export const kuka: DriverKind = {
  id: "kuka",
  name: "KUKA",
  dialect: "krl",
  ports: { variables: C3_PORT },
  vendor: "KUKA",
  cannot: KUKA_CANNOT,
  otherWays: [
    {
      name: "KUKA (RSI)",
      cannot: KUKA_RSI_CANNOT,
      shows: ["T-21", "T-23", "T-27"],
      tests: "rsi.test.ts",
      face: overRsi,
    },
  ],
  terminal: ({ kind, address }) => `${TERMINALS[kind]}[${address}]`,
  face: ({ robot, scheduler, network, host, ports }) =>
    createKukaAdapter({ robot, scheduler, network, host, port: ports?.["variables"] ?? C3_PORT }),
  virtual: options => start(options, false),
};
/**
 * The same controllers, moved by increments of RSI where its sensor file names this computer; a virtual one sends to
 * 127.0.0.2.
 */
export const kukaOverRsi: DriverKind = {
  ...kuka,
  id: "kuka-rsi",
  name: "KUKA over RSI",
  ports: { variables: C3_PORT, rsi: RSI_PORT },
  cannot: KUKA_RSI_CANNOT,
  face: overRsi,
  virtual: options => start(options, true),
};

async function start(
  { robot, scheduler, network, host, ports, interpret, start_rad, maxSpeed }: VendorVirtualOptions,
  overRsi: boolean,
): Promise<StartedDriver> {
  if (!kukaAxes(robot))
    return { kind: "taken", sentence: `How a KUKA controller counts the axes of ${robot.name} is not known.` };
  const virtual = await createVirtualKuka({
    robot,
    scheduler,
    network,
    host,
    interpret,
    port: ports?.["variables"] ?? C3_PORT,
    ...(start_rad ? { start_rad } : {}),
    ...(maxSpeed === undefined ? {} : { maxSpeed }),
    ...(overRsi ? { rsi: { config: axisConfig(NEAR, ports?.["rsi"] ?? RSI_PORT) } } : {}),
  });
  const { listening, arm } = virtual;
  if (listening.kind === "taken") {
    virtual.close();
    return { kind: "taken", sentence: listening.sentence };
  }
  startLoop(virtual, overRsi ? RSI_NAME : undefined);
  return startedDriver({
    robot,
    ports: { variables: listening.address.port, ...(overRsi ? { rsi: ports?.["rsi"] ?? RSI_PORT } : {}) },
    arm,
    pendant: kukaPendant(virtual, scheduler),
    reboot: () => {
      virtual.reboot();
    },
    close: () => {
      virtual.close();
    },
  });
}
