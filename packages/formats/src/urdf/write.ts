import { toMatrix, type LinkMass, type Pose, type Quaternion, type SerialArm } from "@twincell/core";
import { writeXml, type Written } from "../xml-write.ts";

/** A mesh file of a link, and its colour, `#rrggbb`. */
export interface MeshOfLink {
  readonly filename: string;
  readonly color?: string;
}

export interface UrdfOptions {
  /** Name of the robot; the arm's when absent. */
  readonly name?: string;
  /** Names of the root link and of the flange: `base_link` and `tool0`. */
  readonly base?: string;
  readonly tip?: string;
  /** A side link at the root, such as the world the vendor counts from. */
  readonly side?: { readonly name: string; readonly baseFromSide: Pose };
  /** Masses of links 1 … n. One without centre or inertia is left out: a URDF needs both. */
  readonly masses?: readonly LinkMass[] | undefined;
  /** Files of the meshes of link 0 … n that are seen and that collide, in that link's frame and in metres. */
  readonly meshesOf?: (link: number, use: "visual" | "collision") => readonly (string | MeshOfLink)[];
}

/**
 * The arm as a URDF: a link per joint, every joint with its limits, the flange as a fixed link. Numbers have all their
 * digits: read again, forward kinematics is the same to 1e-12. URDF has no place for accelerations.
 */
export function writeUrdf(arm: SerialArm, options: UrdfOptions = {}): string {
  const { base = "base_link", tip = "tool0", side } = options;
  const used = new Set([base, tip, side?.name]);
  const n = arm.joints.length;
  const linkName = (link: number): string => {
    let name = link === 0 ? base : `link_${link}`;
    while (link > 0 && used.has(name)) name += "_";
    return name;
  };
  const children: Written[] = [];
  for (let link = 0; link <= n; link++)
    children.push({
      name: "link",
      attributes: { name: linkName(link) },
      children: [...massIn(link, options), ...shapesIn(link, options)],
    });
  arm.joints.forEach(({ name, kind = "revolute", parentFromJoint, axis, limits }, i) => {
    children.push(
      element("joint", { name, type: kind }, [
        origin(parentFromJoint as Pose),
        element("parent", { link: linkName(i) }),
        element("child", { link: linkName(i + 1) }),
        element("axis", { xyz: axis.map(digits).join(" ") }),
        element("limit", {
          lower: digits(limits.lower_rad),
          upper: digits(limits.upper_rad),
          velocity: digits(limits.speed_rad_s),
          effort: digits(limits.torque_Nm ?? 0),
        }),
      ]),
    );
  });
  children.push(...fixed(tip, linkName(n), arm.lastJointFromFlange as Pose));
  if (side) children.push(...fixed(side.name, base, side.baseFromSide));
  return writeXml({ name: "robot", attributes: { name: options.name ?? arm.name }, children });
}

const element = (name: string, attributes: Record<string, string>, children: readonly Written[] = []): Written => ({
  name,
  attributes,
  children,
});

function fixed(name: string, parent: string, parentFromLink: Pose): Written[] {
  return [
    element("link", { name }),
    element("joint", { name: `${parent}-${name}`, type: "fixed" }, [
      origin(parentFromLink),
      element("parent", { link: parent }),
      element("child", { link: name }),
    ]),
  ];
}

function massIn(link: number, { masses }: UrdfOptions): Written[] {
  const mass = link > 0 ? masses?.[link - 1] : undefined;
  if (!mass?.linkFromCentre || !mass.inertia_kgm2) return [];
  const [ixx, iyy, izz, ixy, ixz, iyz] = mass.inertia_kgm2;
  const inertia = Object.fromEntries(
    Object.entries({ ixx, ixy, ixz, iyy, iyz, izz }).map(([key, value]) => [key, digits(value)]),
  );
  return [
    element("inertial", {}, [
      origin(mass.linkFromCentre as Pose),
      element("mass", { value: digits(mass.mass_kg) }),
      element("inertia", inertia),
    ]),
  ];
}

function shapesIn(link: number, { meshesOf }: UrdfOptions): Written[] {
  return (["visual", "collision"] as const).flatMap(use =>
    (meshesOf?.(link, use) ?? []).map(mesh => {
      const { filename, color } = typeof mesh === "string" ? { filename: mesh, color: undefined } : mesh;
      const shape = element("geometry", {}, [element("mesh", { filename })]);
      return element(use, {}, use === "visual" && color !== undefined ? [shape, paint(color)] : [shape]);
    }),
  );
}

/** Colours are named by what they are: equal ones are one material. */
const paint = (color: string): Written =>
  element("material", { name: color.slice(1) }, [
    element("color", {
      rgba: [1, 3, 5, 7].map(at => (at < 7 ? digits(parseInt(color.slice(at, at + 2), 16) / 255) : "1")).join(" "),
    }),
  ]);

function origin({ position, quaternion }: Pose): Written {
  return element("origin", {
    xyz: position.map(digits).join(" "),
    rpy: rollPitchYaw(quaternion).map(digits).join(" "),
  });
}

/** The shortest digits that give the number back; no −0. */
const digits = (value: number): string => String(value || 0);

/**
 * R = Rz(yaw) · Ry(pitch) · Rx(roll). Pitch and roll are taken after the yaw has been turned back: near pitch ±90°,
 * where yaw and roll turn about one line, they still make up for each other's rounding.
 */
function rollPitchYaw(quaternion: Quaternion): readonly [roll: number, pitch: number, yaw: number] {
  const [r00, r01, r02, r10, r11, r12, r20] = toMatrix(quaternion);
  const yaw = Math.hypot(r00, r10) < 1e-15 ? 0 : Math.atan2(r10, r00);
  const s = Math.sin(yaw);
  const c = Math.cos(yaw);
  return [Math.atan2(s * r02 - c * r12, c * r11 - s * r01), Math.atan2(-r20, c * r00 + s * r10), yaw];
}
