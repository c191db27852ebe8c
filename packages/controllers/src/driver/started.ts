import type { Robot } from "@twincell/core";
import type { Pendant, PortNumbers, StartedDriver } from "./brand.ts";

/** What a virtual controller of a vendor is made of, as far as apps see it. */
export interface VirtualParts {
  /** "Virtual" and the robot, when left out. */
  readonly name?: string;
  readonly robot: Robot;
  readonly ports: PortNumbers;
  /** Its arm: where it stands, and how long it takes to stop [s]. */
  readonly arm: { readonly brakingTime_s: number; jointAngles(out?: Float64Array): Float64Array };
  readonly pendant: Pendant;
  readonly reboot: () => void;
  readonly close: () => void;
}

/** A virtual controller that listens, as apps meet it. */
export const startedDriver = ({ name, robot, ports, arm, pendant, reboot, close }: VirtualParts): StartedDriver => ({
  kind: "started",
  virtual: {
    name: name ?? `Virtual ${robot.name}`,
    robot,
    ports,
    brakingTime_s: arm.brakingTime_s,
    jointAngles: out => arm.jointAngles(out),
    pendant,
    reboot,
    close,
  },
});
