import type { Gripper } from "@twincell/core";
import { CONTACT, GROUP } from "./contact-bits.ts";
import { element, placed } from "./xml.ts";

/** The rubber of a pad gives way in this time [s]. */
const PAD_S = 0.004;
/** Gain of the servo that closes a finger: at its speed it gives its whole force after 5 % of slip. */
const SERVO_GAIN = 20;
/** Moving parts of the drive, as the finger feels them [kg]: keeps light fingers calm on heavy parts. */
const FINGER_DRIVE_KG = 0.2;

/**
 * A palm and two fingers on slides, each with a servo that closes at its speed and pushes with no more than its force.
 * A coupling keeps them at equal distance from the middle, as the gear of a parallel gripper does, so a part is
 * centred.
 */
export function gripperXml({
  flangeFromGrip,
  open_m,
  closed_m,
  force_N,
  finger_m: [thick, wide, long],
  beyond_m,
  speed_mps,
  friction,
  mass_kg,
}: Gripper): {
  readonly body: string;
  readonly actuators: readonly string[];
  readonly equalities: readonly string[];
} {
  const palm_m = Math.max(0.02, flangeFromGrip.position[2] - long);
  const finger_kg = mass_kg / 4;
  const travel_m = (open_m - closed_m) / 2;
  const pad = {
    solref: [PAD_S, 1],
    friction: [friction, 0.02, 0.001],
    priority: 1,
    condim: 4,
    group: GROUP.robot,
    ...CONTACT.robot,
    mass: 0,
  } as const;
  const finger = (name: string, side: 1 | -1): string =>
    element("body", { name, pos: [(side * open_m) / 2, 0, 0], gravcomp: 0 }, [
      element("joint", {
        name,
        type: "slide",
        axis: [-side, 0, 0],
        range: [0, travel_m],
        limited: "true",
        solreflimit: [0.004, 1],
        armature: FINGER_DRIVE_KG,
      }),
      element("inertial", {
        mass: finger_kg,
        pos: [(side * thick) / 2, 0, (beyond_m - long) / 2],
        diaginertia: [1e-5, 1e-5, 1e-5],
      }),
      element("geom", {
        type: "box",
        size: [thick / 2, wide / 2, (long + beyond_m) / 2],
        pos: [(side * thick) / 2, 0, (beyond_m - long) / 2],
        ...pad,
      }),
    ]);
  return {
    body: element("body", { name: "grip", ...placed(flangeFromGrip) }, [
      element("inertial", { mass: mass_kg / 2, pos: [0, 0, -long - palm_m / 2], diaginertia: [1e-4, 1e-4, 1e-4] }),
      element("geom", {
        type: "box",
        size: [open_m / 2 + thick, Math.max(wide, 0.04) / 2, palm_m / 2],
        pos: [0, 0, -long - palm_m / 2],
        group: GROUP.robot,
        ...CONTACT.robot,
        mass: 0,
      }),
      finger("finger-a", 1),
      finger("finger-b", -1),
    ]),
    actuators: ["finger-a", "finger-b"].map(joint =>
      element("velocity", {
        joint,
        kv: (SERVO_GAIN * force_N) / speed_mps,
        forcerange: [-force_N, force_N],
        forcelimited: "true",
      }),
    ),
    equalities: [
      element("joint", {
        joint1: "finger-a",
        joint2: "finger-b",
        polycoef: [0, 1, 0, 0, 0],
        solref: [0.004, 1],
        solimp: [0.99, 0.999, 0.001],
      }),
    ],
  };
}
