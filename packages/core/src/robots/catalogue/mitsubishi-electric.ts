// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const MITSUBISHI_ELECTRIC: CatalogueMaker = {
  vendor: "Mitsubishi Electric",
  robots: [
    {
      id: "mitsubishi_rv2fr",
      name: "Mitsubishi RV-2FR",
      payload: { kg: 2, from: "designation" },
      frames: ["rv2fr_base", "rv2fr_default_tcp"],
      repository: "Mitsubishi-Electric-Asia/melfa_ros2_driver",
      path: "melfa_description/urdf/rv2fr/rv2fr.urdf",
      section: { kind: "mitsubishi" },
      table: `
rv2fr_joint_1 0 0 0 z -240 240 300
rv2fr_joint_2 0 0 0.295 y -120 120 150
rv2fr_joint_3 0 0 0.23 y 0 160 300
rv2fr_joint_4 -0.05 0 0 z -200 200 450
rv2fr_joint_5 0 0 0.27 y -120 120 450
rv2fr_joint_6 0 0 0.07 z -360 360 720
flange 0 0 0 0 0 0`,
    },
    {
      id: "mitsubishi_rv4fr",
      name: "Mitsubishi RV-4FR",
      payload: { kg: 4, from: "designation" },
      frames: ["rv4fr_base", "rv4fr_default_tcp"],
      repository: "Mitsubishi-Electric-Asia/melfa_ros2_driver",
      path: "melfa_description/urdf/rv4fr/rv4fr.urdf",
      section: { kind: "mitsubishi" },
      table: `
rv4fr_joint_1 0 0 0 z -240 240 450
rv4fr_joint_2 0 0 0.35 y -120 120 450
rv4fr_joint_3 0 0 0.235 y 0 161 300
rv4fr_joint_4 -0.05 0 0 z -200 200 540
rv4fr_joint_5 0 0 0.275 y -120 120 623
rv4fr_joint_6 0 0 0.085 z -360 360 720
flange 0 0 0 0 0 0`,
    },
    {
      id: "mitsubishi_rv4frl",
      name: "Mitsubishi RV-4FRL",
      payload: { kg: 4, from: "designation" },
      frames: ["rv4frl_base", "rv4frl_default_tcp"],
      repository: "Mitsubishi-Electric-Asia/melfa_ros2_driver",
      path: "melfa_description/urdf/rv4frl/rv4frl.urdf",
      section: { kind: "mitsubishi" },
      table: `
rv4frl_joint_1 0 0 0 z -240 240 420
rv4frl_joint_2 0 0 0.35 y -120 120 336
rv4frl_joint_3 0 0 0.31 y 0 164 250
rv4frl_joint_4 -0.05 0 0 z -200 200 540
rv4frl_joint_5 0 0 0.335 y -120 120 623
rv4frl_joint_6 0 0 0.085 z -360 360 720
flange 0 0 0 0 0 0`,
    },
    {
      id: "mitsubishi_rv7frl",
      name: "Mitsubishi RV-7FRL",
      payload: { kg: 7, from: "designation" },
      frames: ["rv7frl_base", "rv7frl_default_tcp"],
      repository: "Mitsubishi-Electric-Asia/melfa_ros2_driver",
      path: "melfa_description/urdf/rv7frl/rv7frl.urdf",
      section: { kind: "mitsubishi" },
      table: `
rv7frl_joint_1 0 0 0 z -240 240 288
rv7frl_joint_2 0 0 0.4 y -110 130 321
rv7frl_joint_3 0 0 0.435 y 0 162 360
rv7frl_joint_4 -0.05 0 0 z -200 200 337
rv7frl_joint_5 0 0 0.47 y -120 120 450
rv7frl_joint_6 0 0 0.085 z -360 360 720
flange 0 0 0 0 0 0`,
    },
    {
      id: "mitsubishi_rv13frl",
      name: "Mitsubishi RV-13FRL",
      payload: { kg: 13, from: "designation" },
      frames: ["rv13frl_base", "rv13frl_default_tcp"],
      repository: "Mitsubishi-Electric-Asia/melfa_ros2_driver",
      path: "melfa_description/urdf/rv13frl/rv13frl.urdf",
      section: { kind: "mitsubishi" },
      table: `
rv13frl_joint_1 0 0 0 z -190 190 234
rv13frl_joint_2 0.13 0 0.45 y -90 150 164
rv13frl_joint_3 0 0 0.565 y -10 157.5 219
rv13frl_joint_4 -0.065 0 0 z -200 200 375
rv13frl_joint_5 0 0 0.69 y -120 120 375
rv13frl_joint_6 0 0 0.097 z -360 360 720
flange 0 0 0 0 0 0`,
    },
    {
      id: "mitsubishi_rv8crl",
      name: "Mitsubishi RV-8CRL",
      payload: { kg: 8, from: "designation" },
      frames: ["rv8crl_base", "rv8crl_default_tcp"],
      repository: "Mitsubishi-Electric-Asia/melfa_ros2_driver",
      path: "melfa_description/urdf/rv8crl/rv8crl.urdf",
      section: { kind: "mitsubishi" },
      table: `
rv8crl_joint_1 0 0 0 z -170 170 288
rv8crl_joint_2 0 0 0.39 y -110 110 321
rv8crl_joint_3 0 0 0.45 y 0 165 360
rv8crl_joint_4 -0.1 0 0 z -200 200 337
rv8crl_joint_5 0 0 0.47 y -120 120 450
rv8crl_joint_6 0 0 0.085 z -360 360 720
flange 0 0 0 0 0 0`,
    },
    {
      id: "mitsubishi_rv5as",
      name: "Mitsubishi RV-5AS",
      payload: { kg: 5, from: "designation" },
      frames: ["rv5as_base", "rv5as_default_tcp"],
      repository: "Mitsubishi-Electric-Asia/melfa_ros2_driver",
      path: "melfa_description/urdf/rv5as/rv5as.urdf",
      section: { kind: "mitsubishi" },
      table: `
rv5as_joint_1 0 0 0 z -240 240 124
rv5as_joint_2 0 0 0.254 y -148 148 124
rv5as_joint_3 0 0 0.41 y -150 150 124
rv5as_joint_4 0 0 0 z -200 200 197
rv5as_joint_5 0 0 0.5 y -120 120 356
rv5as_joint_6 0 0 0.125 z -200 200 360
flange 0 0 0 0 0 0`,
    },
  ],
};
