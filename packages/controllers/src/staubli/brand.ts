import { startedDriver, type DriverKind } from "../driver/index.ts";
import { STAUBLI_CANNOT } from "./cannot.ts";
import { FEEDBACK_PORT, MOTION_PORT } from "./codec/simple-message.ts";
import { createStaubliAdapter } from "./adapter/index.ts";
import { staubliPendant } from "./virtual/pendant.ts";
import { JOINTS, speaksSimpleMessage } from "./codec/robots.ts";
import { createVirtualStaubli } from "./virtual/index.ts";

const PORTS = { motion: MOTION_PORT, feedback: FEEDBACK_PORT };

/** CS8 and CS9 as apps meet them: simple_message with the open VAL 3 program ros_server. */
export const staubli: DriverKind = {
  id: "staubli",
  name: "Stäubli (VAL 3)",
  dialect: "val3",
  vendor: "Stäubli",
  ports: PORTS,
  cannot: STAUBLI_CANNOT,
  drives: speaksSimpleMessage,
  face: ({ robot, scheduler, network, host, ports }) =>
    createStaubliAdapter({ robot, scheduler, network, host, ports: { ...PORTS, ...ports } }),
  async virtual({ robot, scheduler, network, host, ports, interpret, start_rad, maxSpeed }) {
    if (robot.arm.joints.length === JOINTS && !speaksSimpleMessage(robot))
      return { kind: "taken", sentence: `${robot.name} counts its joints as V+ does: it stands on a CS7.` };
    const started = await createVirtualStaubli({
      robot,
      scheduler,
      network,
      host,
      interpret,
      ports: { ...PORTS, ...ports },
      ...(start_rad ? { start_rad } : {}),
      ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    if (started.kind === "taken") return started;
    const { virtual } = started;
    return startedDriver({
      robot,
      ports: virtual.ports,
      arm: virtual.arm,
      pendant: staubliPendant(virtual, scheduler),
      reboot: () => {
        virtual.reboot();
      },
      close: () => {
        virtual.close();
      },
    });
  },
};
