import type { Robot } from "../model/robot.ts";
import { catalogueRobots } from "./catalogue/index.ts";
import { LIBRARY, publishedRobot } from "./library/index.ts";
import { jointText } from "../model/slide.ts";
import { angleBetween } from "../spatial/quaternion.ts";
import { degrees, millimetres } from "../spatial/units.ts";
import { distance, type Vector3 } from "../spatial/vector.ts";
import { seededRandom } from "../random.ts";
import { flangePose } from "../kinematics/forward.ts";
import { jointsOfAxes } from "../model/vendor.ts";
import { compose, inverse } from "../spatial/pose.ts";

/**
 * Two arms are the same robot when their flanges meet this closely at the same joint values, and the one allows no
 * value further outside the other's limits than this. Files of one robot differ by rounding; a neighbour model by
 * centimetres.
 */
export const IDENTITY_TOLERANCE = { position_m: 1e-3, angle_rad: 2e-3, limit: 0.02 } as const;

export type Identity =
  | { readonly kind: "same"; readonly worst_m: number; readonly worst_rad: number }
  /** What differs, with both numbers: one clause without an end. */
  | { readonly kind: "other"; readonly difference: string };

const SAMPLES = 24;
const SEED = 1;

/**
 * Whether `robot` is the arm of the library that `known` is: flange poses at its home, at zero and at 24 configurations
 * drawn within the limits of `known` (always the same ones), then the limits. Names and ids are not looked at.
 */
export function compareWithLibrary(robot: Robot, known: Robot): Identity {
  if (robot.arm === known.arm) return { kind: "same", worst_m: 0, worst_rad: 0 };
  const { joints } = known.arm;
  if (robot.arm.joints.length !== joints.length)
    return {
      kind: "other",
      difference: `it has ${robot.arm.joints.length} joints, the ${known.name} has ${joints.length}`,
    };
  let worst_m = 0;
  let worst_rad = 0;
  for (const q of configurations(known)) {
    const own = flangePose(robot.arm, q);
    const wanted = flangePose(known.arm, q);
    const off_m = distance(own.position, wanted.position);
    const off_rad = angleBetween(own.quaternion, wanted.quaternion);
    if (!(off_m <= IDENTITY_TOLERANCE.position_m && off_rad <= IDENTITY_TOLERANCE.angle_rad))
      return {
        kind: "other",
        difference: `at joints ${q.map((value, j) => jointText(joints[j]!, value)).join(", ")} its flange is at ${point(own.position)} mm, that of the ${known.name} at ${point(wanted.position)} mm: ${millimetres(off_m).toFixed(1)} mm and ${degrees(off_rad).toFixed(1)}° apart (${millimetres(IDENTITY_TOLERANCE.position_m)} mm and ${degrees(IDENTITY_TOLERANCE.angle_rad).toFixed(1)}° are allowed)`,
      };
    worst_m = Math.max(worst_m, off_m);
    worst_rad = Math.max(worst_rad, off_rad);
  }
  for (const [j, { limits, kind }] of robot.arm.joints.entries()) {
    const of = joints[j]!;
    const wider =
      limits.lower_rad < of.limits.lower_rad - IDENTITY_TOLERANCE.limit ||
      limits.upper_rad > of.limits.upper_rad + IDENTITY_TOLERANCE.limit;
    if (wider || (kind ?? "revolute") !== (of.kind ?? "revolute"))
      return {
        kind: "other",
        difference: `its joint ${j + 1} goes from ${jointText(robot.arm.joints[j]!, limits.lower_rad)} to ${jointText(robot.arm.joints[j]!, limits.upper_rad)}, that of the ${known.name} from ${jointText(of, of.limits.lower_rad)} to ${jointText(of, of.limits.upper_rad)}`,
      };
  }
  return { kind: "same", worst_m, worst_rad };
}

/**
 * The robot of the library, or of a catalogue that was added, that an arm is: by its kinematics and limits alone.
 * Undefined when it is none of them.
 */
export const libraryRobotOf = (robot: Robot): Robot | undefined =>
  [...LIBRARY, ...catalogueRobots()].find(known => compareWithLibrary(robot, known).kind === "same");

/** The flange must be where a posture of the vendor section says it is [mm]: pendants show hundredths. */
const POSTURE_TOLERANCE_MM = 1;

/**
 * Why a vendor section is not that of the arm it stands with: where the flange is said to be and where it is, for the
 * first posture that disagrees. Undefined when all agree, or where there is no section.
 */
export function falseSection({ name, arm, baseFromVendorWorld, vendorSection }: Robot): string | undefined {
  if (vendorSection === undefined) return undefined;
  const { axes, postures = [] } = vendorSection;
  if (axes.length !== arm.joints.length)
    return `the vendor section counts ${axes.length} axes, the ${name} has ${arm.joints.length} joints.`;
  for (const { axes_deg, flange_mm } of postures) {
    const q = jointsOfAxes(vendorSection, axes_deg, new Float64Array(axes.length));
    const flange = compose(inverse(baseFromVendorWorld), flangePose(arm, q)).position;
    const off_mm = Math.hypot(...flange.map((value, i) => millimetres(value) - flange_mm[i]!));
    if (!(off_mm <= POSTURE_TOLERANCE_MM))
      return `at ${axes.map(({ name: axis }, i) => `${axis} ${axes_deg[i]!}°`).join(", ")} the vendor section has the flange at (${flange_mm.map(value => value.toFixed(1)).join(", ")}) mm, that of the ${name} is at ${point(flange)} mm: ${off_mm.toFixed(1)} mm apart (${POSTURE_TOLERANCE_MM} mm is allowed).`;
  }
  return undefined;
}

const judged = new WeakMap<Robot, string>();

/**
 * Why a robot is not the one of the library whose id it carries, or its vendor section not that of its arm: both sets
 * of numbers in one sentence. Undefined where nothing contradicts.
 */
export function falseIdentity(robot: Robot): string | undefined {
  const known = publishedRobot(robot.id);
  if (known === robot) return undefined;
  let said = judged.get(robot);
  if (said === undefined) {
    const answer = known === undefined ? undefined : compareWithLibrary(robot, known);
    const wrong = falseSection(robot);
    said =
      answer?.kind === "other"
        ? `The robot is called ${robot.id}, but is not the ${known!.name}: ${answer.difference}.`
        : wrong === undefined
          ? ""
          : `The vendor section is not that of the ${robot.name}: ${wrong}`;
    judged.set(robot, said);
  }
  return said === "" ? undefined : said;
}

function configurations({ arm, home_rad }: Robot): readonly (readonly number[])[] {
  const random = seededRandom(SEED);
  return [
    home_rad,
    arm.joints.map(() => 0),
    ...Array.from({ length: SAMPLES }, () =>
      arm.joints.map(({ limits: { lower_rad, upper_rad } }) => lower_rad + random() * (upper_rad - lower_rad)),
    ),
  ];
}

const point = (position: Vector3): string => `(${position.map(value => millimetres(value).toFixed(1)).join(", ")})`;
