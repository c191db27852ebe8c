import {
  dynamicsModel,
  isSlide,
  linkDesigns,
  rotate,
  type DynamicsModel,
  type PhysicalScene,
  type Pose,
  type Robot,
} from "@twincell/core";
import { CONTACT, GROUP } from "./contact-bits.ts";
import { gripperXml } from "./gripper.ts";
import { element, placed, type Attributes } from "./xml.ts";

/** A joint that is moved and not driven answers no force: this much inertia is added to it [kg m²; kg of a slide]. */
export const MOVED_INERTIA = 1e4;

/** What the masses of an arm are, as far as they are published. */
export const armMasses = ({ robot, worldFromBase }: PhysicalScene): ReturnType<typeof dynamicsModel> =>
  dynamicsModel(robot, { worldFromBase });

/**
 * The arm as bodies in bodies, one each link (row L-71): masses, centres and inertias as published, rotor inertia by
 * gear² as armature, convex shells for contact. The base stands still.
 *
 * @param masses  undefined when the arm is moved and its masses do not matter.
 */
export function armXml(
  scene: PhysicalScene,
  masses: DynamicsModel | undefined,
): {
  readonly body: string;
  readonly meshes: readonly string[];
  readonly actuators: readonly string[];
  readonly equalities: readonly string[];
} {
  const { robot, worldFromBase, gripper } = scene;
  const { joints, lastJointFromFlange } = robot.arm;
  const designs = linkDesigns(robot);
  const meshes: string[] = [];
  const shells = (link: number): string[] =>
    (designs[link]?.shells ?? []).map((mesh, i) => {
      meshes.push(
        element("mesh", {
          name: `l${link}s${i}`,
          vertex: Array.from(mesh.positions),
          maxhullvert: 40,
          inertia: "convex",
        }),
      );
      return element("geom", { type: "mesh", mesh: `l${link}s${i}`, group: GROUP.robot, ...CONTACT.robot, mass: 0 });
    });
  const hand = gripper === undefined ? undefined : gripperXml(gripper);
  const { payload } = scene;
  const load =
    payload === undefined
      ? []
      : [
          element("inertial", {
            mass: payload.mass_kg,
            pos: payload.center_m,
            fullinertia: payload.inertia_kgm2 ?? [0, 0, 0, 0, 0, 0],
          }),
        ];
  let inner: string[] = [
    element("body", { name: "flange", ...placed(lastJointFromFlange) }, [
      ...load,
      element("site", { name: "flange" }),
      ...(hand === undefined ? [] : [hand.body]),
    ]),
  ];
  for (let i = joints.length - 1; i >= 0; i--) {
    const joint = joints[i]!;
    const { limits } = joint;
    const slide = isSlide(joint);
    inner = [
      element(
        "body",
        { name: `link${i + 1}`, ...placed(joint.parentFromJoint), gravcomp: masses === undefined ? 1 : undefined },
        [
          element("joint", {
            name: `j${i + 1}`,
            type: slide ? "slide" : "hinge",
            axis: joint.axis,
            armature: masses === undefined ? MOVED_INERTIA : masses.rotors_kgm2[i]!,
            ...(masses === undefined ? {} : { range: [limits.lower_rad, limits.upper_rad], limited: "true" }),
          }),
          masses === undefined
            ? element("inertial", {
                mass: robot.masses?.[i]?.mass_kg ?? 1,
                pos: [0, 0, 0],
                diaginertia: [0.1, 0.1, 0.1],
              })
            : inertialXml(robot, i),
          ...shells(i + 1),
          ...inner,
        ],
      ),
    ];
  }
  return {
    body: element("body", { name: "base", ...placed(worldFromBase) }, [...shells(0), ...inner]),
    meshes,
    actuators: hand?.actuators ?? [],
    equalities: hand?.equalities ?? [],
  };
}

/** The inertia turned into the link's own axes: MJCF takes either a full matrix or a turn, not both. */
function inertialXml(robot: Robot, link: number): string {
  const { mass_kg, linkFromCentre, inertia_kgm2 } = robot.masses![link]!;
  return element("inertial", { mass: mass_kg, ...turnedInertia(linkFromCentre!, inertia_kgm2!) });
}

/** I' = R I Rᵀ, with the centre as it is. */
function turnedInertia(
  { position, quaternion }: Pose,
  [xx, yy, zz, xy, xz, yz]: readonly [number, number, number, number, number, number],
): Attributes {
  const e = [rotate(quaternion, [1, 0, 0]), rotate(quaternion, [0, 1, 0]), rotate(quaternion, [0, 0, 1])] as const;
  const I = [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
  const at = (a: 0 | 1 | 2, b: 0 | 1 | 2): number => {
    let sum = 0;
    for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) sum += e[i]![a] * I[i]![j]! * e[j]![b];
    return sum;
  };
  return { pos: position, fullinertia: [at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(0, 2), at(1, 2)] };
}
