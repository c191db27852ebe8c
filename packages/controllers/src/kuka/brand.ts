import type { Brand } from "../real/index.ts";
import { kukaAxes } from "./axes.ts";
import { KUKA_CANNOT } from "./cannot.ts";
import { C3_PORT } from "./codec-c3.ts";
import { createKukaFace } from "./driver/face.ts";
import { kukaPendant } from "./pendant.ts";
import { createVirtualKuka, startLoop } from "./virtual/controller.ts";

/** KUKA as apps meet it. The virtual controller begins in EXT with its drives on and the program TWINCELL running. */
export const kuka: Brand = {
  id: "kuka", name: "KUKA", dialect: "krl", ports: { variables: C3_PORT }, vendor: "KUKA", cannot: KUKA_CANNOT,
  face: ({ robot, scheduler, network, host, ports }) => createKukaFace({ robot, scheduler, network, host, port: ports?.["variables"] ?? C3_PORT }),
  async virtual({ robot, scheduler, network, host, ports, interpret, start_rad, maxSpeed }) {
    if (!kukaAxes(robot)) return { kind: "taken", sentence: `How a KUKA controller counts the axes of ${robot.name} is not known.` };
    const virtual = await createVirtualKuka({
      robot, scheduler, network, host, interpret, port: ports?.["variables"] ?? C3_PORT, ...(start_rad ? { start_rad } : {}), ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    const { listening, arm } = virtual;
    if (listening.kind === "taken") { virtual.close(); return { kind: "taken", sentence: listening.sentence }; }
    startLoop(virtual);
    return {
      kind: "started",
      virtual: {
        name: `Virtual ${robot.name}`, robot, ports: { variables: listening.address.port }, brakingTime_s: arm.brakingTime_s,
        jointAngles: out => arm.jointAngles(out), reboot() { virtual.reboot(); }, close() { virtual.close(); },
        pendant: kukaPendant(virtual, scheduler),
      },
    };
  },
};
