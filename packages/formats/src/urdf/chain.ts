import {
  compose,
  copyPose,
  identity,
  inverse,
  type Joint,
  type LinkMass,
  type Pose,
  type SerialArm,
} from "@twincell/core";
import { limitsWith } from "../limits.ts";
import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { shorten } from "../xml.ts";
import { massesOf } from "./masses.ts";
import type { UrdfJoint, UrdfRobot, UrdfShape } from "./model.ts";

/** A shape of the robot, seen from the moving link it is bolted to. Link 0 is the base, link i moves with joint i. */
export interface PlacedShape {
  readonly link: number;
  /** Name of the URDF link it came from. */
  readonly name: string;
  readonly use: "visual" | "collision";
  readonly armLinkFromShape: Pose<"arm-link", "shape">;
  readonly shape: UrdfShape;
}

/** The chain from one link to another as an arm, with all shapes that hang on it. */
export interface UrdfChain {
  readonly kind: "chain";
  readonly arm: SerialArm;
  readonly base: string;
  readonly tip: string;
  readonly shapes: readonly PlacedShape[];
  /** Masses of the moving links with all that is bolted to them, when the file has them for every one. */
  readonly masses?: readonly LinkMass[];
  /** What had to be assumed, one sentence each. */
  readonly assumptions: readonly string[];
}

/**
 * The serial arm between two links. Fixed joints melt into their neighbours; links beside the chain ride along on the
 * link they hang on, with their own joints at 0.
 *
 * @param base  root of the file when absent; may also be a side link fixed to the chain's beginning (`base`).
 * @param tip   `tool0` when absent, else `flange`, else the end of the longest chain.
 */
export function armFromUrdf(robot: UrdfRobot, base = robot.root, tip = defaultTip(robot)): UrdfChain | NotUnderstood {
  return answering(() => {
    const upTo = new Map(robot.joints.map(joint => [joint.child, joint]));
    for (const name of [base, tip]) {
      if (!robot.links.some(link => link.name === name))
        throw new Refusal(`${robot.name} has no link ${shorten(name)}.`);
    }
    const fromRoot = pathTo(upTo, tip);
    const side = pathTo(upTo, base);
    let shared = 0;
    while (shared < side.length && side[shared] === fromRoot[shared]) shared++;
    const assumptions: string[] = [];
    const joints: Joint[] = [];
    const linkOf = new Map<string, { link: number; armLinkFromLink: Pose }>();
    const running: Pose = identity();
    for (const joint of side.slice(shared).reverse()) {
      if (joint.type !== "fixed")
        throw new Refusal(
          `Joint ${shorten(joint.name)} moves between ${shorten(base)} and the chain to ${shorten(tip)}.`,
          joint.line,
        );
      compose(running, inverse(joint.parentFromJoint as Pose), running);
    }
    linkOf.set(shared > 0 ? fromRoot[shared - 1]!.child : robot.root, { link: 0, armLinkFromLink: copyPose(running) });
    for (const joint of fromRoot.slice(shared)) {
      compose(running, joint.parentFromJoint as Pose, running);
      if (joint.type !== "fixed") {
        joints.push(armJoint(joint, copyPose(running), assumptions));
        copyPose(identity(), running);
      }
      linkOf.set(joint.child, { link: joints.length, armLinkFromLink: copyPose(running) });
    }
    if (joints.length === 0) throw new Refusal(`No joint moves between ${shorten(base)} and ${shorten(tip)}.`);
    placeSideLinks(robot, upTo, linkOf, assumptions);
    const masses = massesOf(robot, linkOf, joints.length);
    return {
      kind: "chain",
      base,
      tip,
      assumptions,
      shapes: shapesOf(robot, linkOf),
      ...(masses ? { masses } : {}),
      arm: { name: robot.name, joints, lastJointFromFlange: copyPose(running as Pose<"joint", "flange">) },
    };
  });
}

/** `tool0`, else `flange`, else the link with the most joints above it (the first such in the file). */
export function defaultTip(robot: UrdfRobot): string {
  for (const name of ["tool0", "flange"]) if (robot.links.some(link => link.name === name)) return name;
  const upTo = new Map(robot.joints.map(joint => [joint.child, joint]));
  let best = robot.root;
  let longest = 0;
  for (const { name } of robot.links) {
    const length = pathTo(upTo, name).length;
    if (length > longest) {
      longest = length;
      best = name;
    }
  }
  return best;
}

/** Links at which the file ends: what may be a tip. */
export function endsOf(robot: UrdfRobot): readonly string[] {
  const parents = new Set(robot.joints.map(joint => joint.parent));
  return robot.links.map(({ name }) => name).filter(name => !parents.has(name));
}

/** Joints from the root down to a link. */
function pathTo(upTo: ReadonlyMap<string, UrdfJoint>, link: string): UrdfJoint[] {
  const path: UrdfJoint[] = [];
  for (let joint = upTo.get(link); joint; joint = upTo.get(joint.parent)) path.push(joint);
  return path.reverse();
}

function armJoint(joint: UrdfJoint, parentFromJoint: Pose, assumptions: string[]): Joint {
  const { name, type, axis, limit } = joint;
  if (type !== "revolute" && type !== "continuous" && type !== "prismatic")
    throw new Refusal(`Joint ${shorten(name)} is ${type}; an arm here has joints that turn or slide.`, joint.line);
  if (joint.mimic)
    throw new Refusal(
      `Joint ${shorten(name)} follows joint ${shorten(joint.mimic.joint)}; it has no motion of its own.`,
      joint.line,
    );
  const isBounded = type !== "continuous" && limit !== undefined;
  const kind = type === "prismatic" ? type : undefined;
  return {
    name,
    axis,
    ...(kind === undefined ? {} : { kind }),
    parentFromJoint: parentFromJoint as Pose<"parent", "joint">,
    limits: limitsWith(
      name,
      {
        ...(isBounded ? { lower_rad: limit.lower, upper_rad: limit.upper } : {}),
        speed_rad_s: limit?.velocity,
        torque_Nm: limit && limit.effort > 0 ? limit.effort : undefined,
      },
      assumptions,
      kind,
    ),
  };
}

type Places = Map<string, { link: number; armLinkFromLink: Pose }>;

function placeSideLinks(
  robot: UrdfRobot,
  upTo: ReadonlyMap<string, UrdfJoint>,
  places: Places,
  assumptions: string[],
): void {
  const still = new Set<string>();
  for (const { name } of robot.links) {
    const path = pathTo(upTo, name);
    const first = path.findLastIndex(joint => places.has(joint.parent) && !places.has(joint.child));
    if (first < 0) continue;
    for (const joint of path.slice(first)) {
      const parent = places.get(joint.parent)!;
      places.set(joint.child, {
        link: parent.link,
        armLinkFromLink: compose(parent.armLinkFromLink, joint.parentFromJoint as Pose),
      });
      if (joint.type !== "fixed") still.add(joint.name);
    }
  }
  for (const name of still) assumptions.push(`Joint ${name} is beside the chain and drawn at 0.`);
}

function shapesOf(robot: UrdfRobot, places: Places): PlacedShape[] {
  const shapes: PlacedShape[] = [];
  for (const link of robot.links) {
    const place = places.get(link.name);
    if (!place) continue;
    const put = (shape: UrdfShape, use: PlacedShape["use"]): void => {
      const armLinkFromShape = compose(place.armLinkFromLink, shape.linkFromShape as Pose) as Pose<"arm-link", "shape">;
      shapes.push({ link: place.link, name: link.name, use, armLinkFromShape, shape });
    };
    for (const shape of link.visuals) put(shape, "visual");
    for (const shape of link.collisions) put(shape, "collision");
  }
  return shapes;
}
