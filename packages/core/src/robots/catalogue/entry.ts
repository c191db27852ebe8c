import { pose, type Pose } from "../../spatial/pose.ts";
import { radians } from "../../spatial/units.ts";
import type { Vector3 } from "../../spatial/vector.ts";
import type { Joint, SerialArm } from "../../model/arm.ts";
import { robotFromArm } from "../foreign.ts";
import { ACCELERATIONS_ASSUMED, SHAPES_ESTIMATED, inDegrees, joint, turned } from "../library/write.ts";
import type { Robot } from "../../model/robot.ts";
import { sectionOfData, type SectionData } from "../vendor-sections.ts";
import { homeOf } from "./home.ts";
import { REPOSITORIES } from "./repositories.ts";

/** Robots of one maker. */
export interface CatalogueMaker {
  readonly vendor: string;
  readonly robots: readonly CatalogueEntry[];
}

/** A robot of the catalogue as the data files write it: enough for a list; `robotOfEntry` makes the robot of it. */
export interface CatalogueEntry {
  readonly id: string;
  readonly name: string;
  readonly home_deg?: readonly number[];
  /** What it may carry at the flange, tool included; left out where neither source states it. */
  readonly payload?: Payload;
  /** Names of root link and tip frame in the description. */
  readonly frames: readonly [base: string, tip: string];
  /** True where no program that is not this project's was held against the arm's forward kinematics. */
  readonly unverified?: true;
  /** Public description that axes, limits and speeds were read from: repository, then path with its arguments. */
  readonly repository: string;
  readonly path: string;
  /** What the maker's controllers need; left out where it is not published or not sure. */
  readonly section?: SectionData;
  /**
   * A joint a line, base first; with all angles 0 every link is turned as the base:
   *
   *   name  x y z [m, from the joint before]  axis  lower upper [°]  speed [°/s]
   *   flange  x y z [m]  roll pitch yaw [°]
   *   world   x y z [m]  roll pitch yaw [°]      the maker's world seen from the base, where it is another frame
   */
  readonly table: string;
}

/** Payload [kg] and where it stands: in the name that the maker gave the model, or in the maker's data sheet. */
export interface Payload {
  readonly kg: number;
  readonly from: "designation" | "data sheet";
}

const PAYLOAD_SOURCES: Readonly<Record<Payload["from"], string>> = {
  designation: "Part of the name that the maker gives the model.",
  "data sheet": "The maker's data sheet of the model.",
};
/** How far the shapes drawn from dimensions alone may be off, as a share of the reach: an estimate, not measured. */
const SHAPE_ERROR_SHARE = 0.08;
const LEAST_SHAPE_ERROR_M = 0.03;
const AXES: Readonly<Record<string, Vector3>> = {
  x: [1, 0, 0],
  y: [0, 1, 0],
  z: [0, 0, 1],
  "-x": [-1, 0, 0],
  "-y": [0, -1, 0],
  "-z": [0, 0, -1],
};

/**
 * The robot of an entry: its arm from the table, its closed form read off the axes, what is not published assumed and
 * said.
 */
export function robotOfEntry(entry: CatalogueEntry, vendor: string): Robot {
  const { id, name, home_deg, frames, unverified, section, payload } = entry;
  const { arm, baseFromVendorWorld } = armOfTable(name, entry.table);
  const robot = robotFromArm(arm, {
    id,
    name,
    vendor,
    frames: { base: frames[0], tip: frames[1] },
    baseFromVendorWorld,
    ...(section === undefined ? {} : { vendorSection: sectionOfData(section) }),
    ...(unverified === undefined ? {} : { unverified }),
    ...(payload === undefined ? {} : { payload_kg: payload.kg }),
    sources: {
      ...(payload === undefined ? {} : { payload: PAYLOAD_SOURCES[payload.from] }),
      "lengths, limits, speeds": `${entry.repository} (${REPOSITORIES[entry.repository]!}), ${entry.path}.`,
      reach: "Computed from these lengths.",
    },
    assumptions: [ACCELERATIONS_ASSUMED, SHAPES_ESTIMATED],
  });
  const shapeError_m = Math.max(LEAST_SHAPE_ERROR_M, SHAPE_ERROR_SHARE * robot.reach_m);
  return { ...robot, shapeError_m, home_rad: home_deg?.map(radians) ?? homeOf(arm, robot.family) };
}

/**
 * Reads a table of an entry. Throws where a line has no number: the tables are data of this repository, held by a test.
 */
function armOfTable(
  name: string,
  table: string,
): { readonly arm: SerialArm; readonly baseFromVendorWorld: Pose<"base", "vendor-world"> } {
  const joints: Joint[] = [];
  let lastJointFromFlange = pose<"joint", "flange">();
  let baseFromVendorWorld = pose<"base", "vendor-world">();
  for (const line of table.trim().split("\n")) {
    const [word = "", ...cells] = line.split(" ");
    if (word === "flange") lastJointFromFlange = placed<"joint", "flange">(line, cells);
    else if (word === "world") baseFromVendorWorld = placed<"base", "vendor-world">(line, cells);
    else {
      const [x, y, z, lower, upper, speed] = numbers(line, [...cells.slice(0, 3), ...cells.slice(4)], 6);
      const axis = AXES[cells[3]!] ?? (numbers(line, cells[3]!.split(","), 3) as Vector3);
      joints.push(joint(word, [x!, y!, z!], axis, inDegrees(lower!, upper!, speed!)));
    }
  }
  return { arm: { name, joints, lastJointFromFlange }, baseFromVendorWorld };
}

function placed<Into extends string, From extends string>(line: string, cells: readonly string[]): Pose<Into, From> {
  const [x, y, z, roll, pitch, yaw] = numbers(line, cells, 6);
  return turned<Into, From>([x!, y!, z!], [radians(roll!), radians(pitch!), radians(yaw!)]);
}

function numbers(line: string, cells: readonly string[], count: number): readonly number[] {
  const values = cells.map(Number);
  if (values.length !== count || !values.every(Number.isFinite))
    throw new Error(`A line of the catalogue has other than ${count} numbers: ${line}`);
  return values;
}
