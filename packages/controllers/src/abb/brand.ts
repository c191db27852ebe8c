import { startedDriver, type DriverKind, type StartedDriver, type VendorVirtualOptions } from "../driver/index.ts";
import { ABB_CANNOT, ABB_EGM_CANNOT } from "./cannot.ts";
import { EGM_PORT, RWS_PORT } from "./codec/index.ts";
import { abbEgmAdapter, abbAdapter } from "./adapter/index.ts";
import { abbPendant } from "./virtual/pendant.ts";
import { createVirtualAbb } from "./virtual/index.ts";

const PORTS = { egm: EGM_PORT, rws: RWS_PORT };
const REBOOT_S = 2;

/**
 * IRC5 controllers with RobotWare 6: externally guided motion, to a port of this machine, and Robot Web Services, on
 * one of theirs.
 */
export const abb: DriverKind = {
  id: "abb",
  name: "ABB",
  dialect: "rapid",
  vendor: "ABB",
  ports: PORTS,
  cannot: ABB_CANNOT,
  otherWays: [
    {
      name: "ABB (EGM alone)",
      cannot: ABB_EGM_CANNOT,
      shows: ["T-19", "T-20", "T-21", "T-23", "T-24", "T-25", "T-26", "T-27"],
      tests: "egm-adapter.test.ts",
      face: abbEgmAdapter,
    },
  ],
  face: ({ ports, ...options }) => abbAdapter({ ...options, ports: { ...PORTS, ...ports } }),
  virtual: options => start(options, true),
};
/**
 * The same controllers where Robot Web Services are not those of RobotWare 6: EGM alone, which a person starts there.
 */
export const abbOverEgm: DriverKind = {
  ...abb,
  id: "abb-egm",
  name: "ABB over EGM alone",
  ports: { egm: EGM_PORT },
  cannot: ABB_EGM_CANNOT,
  face: abbEgmAdapter,
  virtual: options => start(options, false),
};

async function start(
  { ports, robot, scheduler, network, host, start_rad, maxSpeed, interpret }: VendorVirtualOptions,
  withRws: boolean,
): Promise<StartedDriver> {
  const egm = ports?.["egm"] ?? EGM_PORT;
  const started = await createVirtualAbb({
    robot,
    scheduler,
    network,
    host,
    interpret,
    sensor: { host, port: egm },
    ...(withRws ? { rws: ports?.["rws"] ?? RWS_PORT } : {}),
    ...(start_rad ? { start_rad } : {}),
    ...(maxSpeed === undefined ? {} : { maxSpeed }),
  });
  if (started.kind === "taken") return started;
  const { controller } = started;
  return startedDriver({
    name: `Virtual ABB ${robot.name.replace(/^ABB /, "")}`,
    robot,
    ports: { egm, ...(controller.rws ? { rws: controller.rws.port } : {}) },
    arm: { brakingTime_s: controller.brakingTime_s, jointAngles: out => controller.neutral.jointAngles(out) },
    pendant: abbPendant(controller),
    reboot: () => {
      controller.reboot(REBOOT_S);
    },
    close: () => {
      controller.close();
    },
  });
}
