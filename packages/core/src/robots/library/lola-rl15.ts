import { pose } from "../../spatial/pose.ts";
import type { Robot } from "../../model/robot.ts";
import {
  ACCELERATIONS_ASSUMED,
  TCP_SPEED_ASSUMED,
  TCP_SPEED_MPS,
  drivenJoint,
  orthoParallel,
  turned,
} from "./write.ts";

/**
 * Limits, motors, gears and masses are published (rows L-18 … L-20); lengths are not, by anybody: they are made up
 * here. Table 1 of the paper prints a damping of 5734.75 for joint 3 where its own formula gives 5743.76 (E-09); gains
 * are computed from these numbers, never copied.
 */
export const lolaRl15: Robot = {
  id: "lola_rl15_placeholder",
  name: "Lola RL15 (stand-in geometry)",
  vendor: "Lola Institute",
  arm: {
    name: "Lola RL15 (stand-in geometry)",
    joints: [
      drivenJoint("joint_1", [0, 0, 0.85], [0, 0, 1], [-150, 150], {
        motorTorque_Nm: 17.8,
        motorSpeed_rpm: 3500,
        gear: 120,
        rotorInertia_kgm2: 4.2e-3,
      }),
      drivenJoint("joint_2", [0.2, 0, 0], [0, 1, 0], [-120, 80], {
        motorTorque_Nm: 38.6,
        motorSpeed_rpm: 2800,
        gear: 119,
        rotorInertia_kgm2: 9.0e-3,
      }),
      drivenJoint("joint_3", [0, 0, 0.7], [0, 1, 0], [-73, 73], {
        motorTorque_Nm: 17.8,
        motorSpeed_rpm: 3500,
        gear: 119,
        rotorInertia_kgm2: 9.0e-3,
      }),
      drivenJoint("joint_4", [0, 0, 0.15], [1, 0, 0], [-250, 250], {
        motorTorque_Nm: 3.47,
        motorSpeed_rpm: 3400,
        gear: 133.4,
        rotorInertia_kgm2: 0.8e-3,
      }),
      drivenJoint("joint_5", [0.8, 0, 0], [0, 1, 0], [-110, 110], {
        motorTorque_Nm: 3.47,
        motorSpeed_rpm: 3400,
        gear: 219.4,
        rotorInertia_kgm2: 1e-3,
      }),
      drivenJoint("joint_6", [0, 0, 0], [1, 0, 0], [-200, 200], {
        motorTorque_Nm: 3.47,
        motorSpeed_rpm: 3400,
        gear: 53.3,
        rotorInertia_kgm2: 0.7e-3,
      }),
    ],
    lastJointFromFlange: turned([0.12, 0, 0], [0, Math.PI / 2, 0]),
  },
  family: orthoParallel([0.2, -0.15, 0, 0.85, 0.7, 0.8, 0.12], [0, 0, -1, 0, 0, 0], [1, 1, 1, 1, 1, 1]),
  frames: { base: "base_link", tip: "tool0" },
  baseFromVendorWorld: pose(),
  home_rad: [0, 0, 0, 0, Math.PI / 2, 0],
  reach_m: 1.714,
  reachMeasuredFrom: "axis-1",
  reachMeasuredTo: "wrist",
  maxTcpSpeed_mps: TCP_SPEED_MPS,
  masses: [
    { mass_kg: 347.95 },
    { mass_kg: 75.17 },
    { mass_kg: 82.34 },
    { mass_kg: 46.3 },
    { mass_kg: 2.37 },
    { mass_kg: 0.9 },
  ],
  madeUpGeometry: true,
  paint: { casting: "#9aa3a8", dark: "#4a5257", cover: "#6b747a" },
  sources: {
    "joint limits, motor speeds": "Machines 2024, 12(7) 480, Table A3.",
    "masses, motor torques, gears, inertias":
      "The same, Table A2; motor torque times gear is the printed joint torque.",
    "lengths, reach, zeros, senses": "Made up for an arm of this class.",
  },
  assumptions: [
    "The geometry of the RL15 is not published: all lengths, zeros and senses of the joints are made up, and no result that rests on them says anything about the real robot.",
    "The paper's speed limits [r/min] are read as speeds of the motors; the table does not say so. Joint speed is motor speed over gear.",
    "Payload and repeatability are not published: 0 is shown.",
    "Centres of mass and inertias of the links are not published.",
    ACCELERATIONS_ASSUMED,
    TCP_SPEED_ASSUMED,
    "Link shapes are drawn from the made-up lengths.",
  ],
  shapeError_m: 0.1,
};
