import { startedDriver, type DriverKind } from "../driver/index.ts";
import { YASKAWA_CANNOT } from "./cannot.ts";
import { FILE_PORT, ROBOT_PORT, scaleWith } from "./codec/index.ts";
import { yaskawaAdapter } from "./adapter/index.ts";
import { yaskawaPendant } from "./virtual/pendant.ts";
import { createVirtualYaskawa } from "./virtual/index.ts";

const PORTS = { robot: ROBOT_PORT, files: FILE_PORT };
/** How long a virtual controller is away when it is switched off and on [s]. */
const REBOOT_S = 2;

/** Controllers with the high-speed Ethernet server: FS100, DX200, YRC1000. */
export const yaskawa: DriverKind = {
  id: "yaskawa",
  name: "Yaskawa",
  dialect: "inform",
  vendor: "Yaskawa",
  ports: PORTS,
  cannot: YASKAWA_CANNOT,
  data: [
    {
      id: "pulses_per_degree",
      name: "Pulses per degree",
      where: "In the controller's parameter file ALL.PRM, group RC; S axis first.",
    },
  ],
  terminal: ({ kind, address }) =>
    kind === "digital-in" ? `IN#(${address})` : kind === "digital-out" ? `OT#(${address})` : undefined,
  face: ({ ports, data, ...options }) => {
    const pulsesPerDegree = data?.["pulses_per_degree"];
    return yaskawaAdapter({
      ...options,
      ports: { ...PORTS, ...ports },
      ...(pulsesPerDegree ? { scale: scaleWith(options.robot, pulsesPerDegree, "said by a person") } : {}),
    });
  },
  async virtual({ ports, ...options }) {
    const started = await createVirtualYaskawa({ ...options, ports: { ...PORTS, ...ports } });
    if (started.kind === "taken") return started;
    const { controller } = started;
    const { neutral, robot } = controller;
    return startedDriver({
      name: `Virtual Yaskawa ${robot.name.replace(/^Yaskawa /, "")}`,
      robot,
      ports: controller.ports,
      arm: { brakingTime_s: controller.brakingTime_s, jointAngles: out => neutral.jointAngles(out) },
      pendant: yaskawaPendant(controller),
      reboot: () => {
        controller.reboot(REBOOT_S);
      },
      close: () => {
        controller.close();
      },
    });
  },
};
