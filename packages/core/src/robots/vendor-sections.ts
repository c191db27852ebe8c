import { plainAxes, type AxisCoupling, type VendorSection } from "../model/vendor.ts";

/** How the controllers of one maker count the axes of robots whose files count them as the maker's descriptions do. */
export type SectionKind = keyof typeof KINDS;

/** A vendor section as data files of robots write it: what the maker's sections share, and what is this robot's own. */
export interface SectionData {
  readonly kind: SectionKind;
  readonly model?: string;
  readonly couplings?: readonly AxisCoupling[];
  /** Where model and couplings come from. */
  readonly sources?: Readonly<Record<string, string>>;
}

const J = ["J1", "J2", "J3", "J4", "J5", "J6"] as const;
/** The forearm is shown against the horizon: joint 3 less what joint 2 leans forwards. */
const FOREARM_AGAINST_HORIZON: readonly AxisCoupling[] = [{ axis: 3, with: 2, factor: -1 }];

const KINDS = {
  "universal-robots": {
    languages: ["urscript"],
    drivers: ["ur"],
    axes: plainAxes(["Base", "Shoulder", "Elbow", "Wrist 1", "Wrist 2", "Wrist 3"]),
    sources: {
      axes: "URScript manual: joints in radians, the arm stretched out at 0, all right-handed; as in UniversalRobots/Universal_Robots_ROS2_Description.",
      model: 'Dashboard server, "get robot model": the e-Series answers without its letter.',
    },
  },
  kuka: {
    languages: ["krl"],
    drivers: ["kuka", "kuka-rsi"],
    axes: plainAxes(["A1", "A2", "A3", "A4", "A5", "A6"]),
    sources: {
      axes: "KSS system variables, $AXIS_ACT: all 0 with upper arm and forearm level in front, A1, A4 and A6 left-handed; as in kroshu/kuka_robot_descriptions.",
    },
  },
  yaskawa: {
    languages: ["inform"],
    drivers: ["yaskawa"],
    axes: plainAxes(["S", "L", "U", "R", "B", "T"]),
    sources: {
      axes: "Controller manual: all 0 with the upper arm upright and the forearm level; as in ros-industrial/motoman, whose joint angles are the controller's own.",
    },
  },
  abb: {
    languages: ["rapid"],
    drivers: ["abb", "abb-egm"],
    axes: plainAxes(["1", "2", "3", "4", "5", "6"]),
    sources: {
      axes: "RAPID reference, robjoint: degrees from the calibration position; as in ros-industrial/abb, whose driver sends them as they are.",
    },
  },
  fanuc: {
    languages: ["fanuc-ls"],
    drivers: ["fanuc"],
    axes: plainAxes(J),
    couplings: FOREARM_AGAINST_HORIZON,
    sources: {
      "axes, couplings":
        "ros-industrial/fanuc, J23_factor = 1 of every six-axis arm: J3 of the controller is joint 3 less joint 2.",
    },
  },
  "staubli-val3": {
    languages: ["val3"],
    drivers: ["staubli"],
    axes: plainAxes(["j1", "j2", "j3", "j4", "j5", "j6"]),
    sources: {
      axes: "VAL 3 reference manual, joint type: all 0 straight up; as in ros-industrial/staubli, whose driver sends them as they are.",
    },
  },
  "staubli-v-plus": {
    languages: ["v-plus"],
    drivers: ["staubli-cs7"],
    axes: plainAxes(["J1", "J2", "J3", "J4", "J5", "J6"]),
    sources: { axes: "V+ of the RX family: DO READY stands straight up at 0, −90, 90, 0, 0, 0." },
  },
  kawasaki: {
    languages: ["kawasaki-as"],
    drivers: [],
    axes: plainAxes(["JT1", "JT2", "JT3", "JT4", "JT5", "JT6"]),
    sources: { axes: "Kawasaki-Robotics/khi_robot: the maker's driver sends the values of its URDF as they are." },
  },
  epson: {
    languages: ["spel"],
    drivers: [],
    axes: plainAxes(J),
    sources: { axes: "Robot manual of the C4 series: the robot file counts from the maker's zeros." },
  },
  mitsubishi: {
    languages: ["melfa-basic"],
    drivers: [],
    axes: plainAxes(J),
    sources: {
      axes: "Robot manual of the RV-F series: all 0 straight up; as in Mitsubishi-Electric-Asia/melfa_ros2_driver, whose driver sends them as they are.",
    },
  },
  denso: {
    languages: ["pacscript"],
    drivers: [],
    axes: plainAxes(J),
    sources: { axes: "DENSORobot/denso_robot_ros2: the maker's driver sends the values of its URDF as they are." },
  },
} as const satisfies Readonly<Record<string, VendorSection>>;

/** The whole section of what a data file says. */
export function sectionOfData({ kind, model, couplings, sources }: SectionData): VendorSection {
  const shared: VendorSection = KINDS[kind];
  return {
    ...shared,
    ...(model === undefined ? {} : { model }),
    ...(couplings === undefined ? {} : { couplings }),
    sources: { ...shared.sources, ...sources },
  };
}
