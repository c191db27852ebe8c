import { startedDriver, type DriverKind } from "../driver/index.ts";
import { FANUC_CANNOT } from "./cannot.ts";
import { FTP_PORT } from "./codec/ftp.ts";
import { RMI_PORT, RMI_SESSION_PORT } from "./codec/rmi.ts";
import { createFanucAdapter } from "./adapter/adapter.ts";
import { fanucPendant } from "./virtual/pendant.ts";
import { createVirtualFanuc } from "./virtual/controller.ts";

const PORTS = { connect: RMI_PORT, session: RMI_SESSION_PORT, files: FTP_PORT };

/** FANUC as apps meet it: the Remote Motion Interface of R-30iB controllers and later. */
export const fanuc: DriverKind = {
  id: "fanuc",
  name: "FANUC",
  dialect: "fanuc-ls",
  vendor: "FANUC",
  ports: PORTS,
  cannot: FANUC_CANNOT,
  terminal: ({ kind, address }) =>
    kind === "digital-in" ? `DI[${address}]` : kind === "digital-out" ? `DO[${address}]` : undefined,
  face: ({ robot, scheduler, network, host, ports }) =>
    createFanucAdapter({
      robot,
      scheduler,
      network,
      host,
      port: ports?.["connect"] ?? RMI_PORT,
      ftpPort: ports?.["files"] ?? FTP_PORT,
    }),
  async virtual({ robot, scheduler, network, host, ports, interpret, start_rad, maxSpeed }) {
    const started = await createVirtualFanuc({
      robot,
      scheduler,
      network,
      host,
      port: ports?.["connect"] ?? RMI_PORT,
      sessionPort: ports?.["session"] ?? RMI_SESSION_PORT,
      ftpPort: ports?.["files"] ?? FTP_PORT,
      interpret,
      ...(start_rad ? { start_rad } : {}),
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    if (started.kind === "taken") return started;
    const { virtual } = started;
    return startedDriver({
      robot,
      ports: virtual.ports,
      arm: virtual.arm,
      pendant: fanucPendant(virtual),
      reboot: () => {
        virtual.reboot();
      },
      close: () => {
        virtual.close();
      },
    });
  },
};
