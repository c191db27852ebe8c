import type { OperatingMode, Scheduler } from "@twincell/core";
import type { Brand, Pendant } from "../real/index.ts";
import { STAUBLI_CANNOT } from "./cannot.ts";
import { FEEDBACK_PORT, MOTION_PORT } from "./codec.ts";
import { createStaubliFace } from "./driver/index.ts";
import { JOINTS, speaksSimpleMessage } from "./robots.ts";
import { createVirtualStaubli, type StaubliMode, type VirtualStaubli } from "./virtual/index.ts";

const PORTS = { motion: MOTION_PORT, feedback: FEEDBACK_PORT };
const MODE: Readonly<Record<OperatingMode, StaubliMode>> = { manual: "manual", automatic: "local", remote: "remote" };
const PRESSES_S = 2, LOOK_S = 0.05;

/** CS8 and CS9 as apps meet them: simple_message with the open VAL 3 program ros_server. */
export const staubli: Brand = {
  id: "staubli", name: "Stäubli (VAL 3)", dialect: "val3", vendor: "Stäubli", ports: PORTS, cannot: STAUBLI_CANNOT, drives: speaksSimpleMessage,
  face: ({ robot, scheduler, network, host, ports }) => createStaubliFace({ robot, scheduler, network, host, ports: { ...PORTS, ...ports } }),
  async virtual({ robot, scheduler, network, host, ports, interpret, start_rad, maxSpeed }) {
    if (robot.arm.joints.length === JOINTS && !speaksSimpleMessage(robot)) return { kind: "taken", sentence: `${robot.name} counts its joints as V+ does: it stands on a CS7.` };
    const started = await createVirtualStaubli({
      robot, scheduler, network, host, interpret, ports: { ...PORTS, ...ports }, ...(start_rad ? { start_rad } : {}), ...(maxSpeed === undefined ? {} : { maxSpeed }),
    });
    if (started.kind === "taken") return started;
    const { virtual } = started;
    return {
      kind: "started",
      virtual: {
        name: `Virtual ${robot.name}`, robot, ports: virtual.ports, brakingTime_s: virtual.arm.brakingTime_s, pendant: pendantOf(virtual, scheduler),
        jointAngles: out => virtual.arm.jointAngles(out), reboot() { virtual.reboot(); }, close() { virtual.close(); },
      },
    };
  },
};

const pendantOf = (virtual: VirtualStaubli, scheduler: Scheduler, { pendant } = virtual): Pendant => ({
  setMode(mode) {
    pendant.setMode(MODE[mode]);
    if (mode === "manual") return;
    // Whoever turns the selector back acknowledges the chain and presses the power button as soon as the robot stands.
    const until_s = scheduler.now_s() + PRESSES_S, stop = scheduler.every(LOOK_S, () => {
      pendant.acknowledge();
      if (virtual.mode !== MODE[mode] || scheduler.now_s() > until_s || pendant.setPower(true) === null) stop();
    });
  },
  // The enabling switch is pressed for as long as the jog lasts.
  async jog(q_rad) {
    pendant.acknowledge();
    pendant.setEnabling(true);
    const outcome = await pendant.jog(q_rad);
    pendant.setEnabling(false);
    return outcome;
  },
  emergencyStop(pressed) { pendant.setEmergencyStop(pressed); },
  setGuardOpen(open) { pendant.setDoorOpen(open); },
  protectiveStop(because) { pendant.fail(because); },
  setInput(signal, value) { pendant.setInput(signal, value); },
});
