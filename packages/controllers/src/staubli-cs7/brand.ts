import { startedDriver, type DriverKind } from "../driver/index.ts";
import { CS7_CANNOT } from "./cannot.ts";
import { LINE_PORT } from "./codec/monitor.ts";
import { createCs7Adapter } from "./adapter/index.ts";
import { cs7Pendant } from "./virtual/pendant.ts";
import { createVirtualCs7 } from "./virtual/index.ts";

const PORTS = { line: LINE_PORT };

/** CS7 and Adept MV as apps meet them: the monitor of V+ on a raw line. */
export const staubliCs7: DriverKind = {
  id: "staubli-cs7",
  name: "Stäubli CS7 (V+)",
  dialect: "v-plus",
  vendor: "Stäubli",
  ports: PORTS,
  cannot: CS7_CANNOT,
  data: [
    {
      id: "baud",
      name: "Speed of the serial line",
      where: "In baud, as at the controller's terminal port and the adapter; 1000000 for AdeptNet.",
      count: 1,
      usual: [9600],
    },
  ],
  face({ robot, scheduler, network, host, ports, data }) {
    const baud = data?.["baud"]?.[0];
    return createCs7Adapter({
      robot,
      scheduler,
      network,
      host,
      port: ports?.["line"] ?? LINE_PORT,
      ...(baud !== undefined && baud > 0 ? { baud } : {}),
    });
  },
  async virtual({ robot, scheduler, network, host, ports, interpret, start_rad, maxSpeed }) {
    const started = await createVirtualCs7({
      robot,
      scheduler,
      network,
      host,
      interpret,
      port: ports?.["line"] ?? LINE_PORT,
      ...(start_rad ? { start_rad } : {}),
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    if (started.kind === "taken") return started;
    const { virtual } = started;
    return startedDriver({
      robot,
      ports: virtual.ports,
      arm: virtual.arm,
      pendant: cs7Pendant(virtual, scheduler),
      reboot: () => {
        virtual.reboot();
      },
      close: () => {
        virtual.close();
      },
    });
  },
};
