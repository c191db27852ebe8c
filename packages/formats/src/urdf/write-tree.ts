import type { Vector3 } from "@twincell/core";
import { writeXml, type Written } from "../xml-write.ts";

/** A link made of boxes, in its own frame [m]; its mass [kg] is spread evenly over them. */
export interface TreeLink {
  readonly name: string;
  readonly mass_kg: number;
  readonly boxes: readonly { readonly centre_m: Vector3; readonly size_m: Vector3 }[];
}

/** A joint that turns, or holds its links together; one that mimics follows `multiplier` times another. */
export interface TreeJoint {
  readonly name: string;
  readonly kind: "revolute" | "fixed";
  readonly parent: string;
  readonly child: string;
  /** Where the child's frame stands in the parent's [m]; both are turned alike at 0. */
  readonly at_m: Vector3;
  readonly axis?: Vector3;
  /** [rad], [rad/s], [N m] */
  readonly limits?: { readonly lower: number; readonly upper: number; readonly speed: number; readonly effort: number };
  readonly mimic?: { readonly joint: string; readonly multiplier: number };
}

export interface LinkTree {
  readonly name: string;
  readonly links: readonly TreeLink[];
  readonly joints: readonly TreeJoint[];
}

/**
 * A tree of links as a URDF, with mimic joints, masses and inertias: what a gripper with a linkage is (row X-05).
 *
 *   I = Σ m_k ( diag(y²+z², x²+z², x²+y²) / 12 + |r_k|² 1 − r_k r_kᵀ ),   m_k by volume, r_k from the common centre
 */
export function writeUrdfTree({ name, links, joints }: LinkTree): string {
  return writeXml({
    name: "robot",
    attributes: { name },
    children: [...links.map(linkElement), ...joints.map(jointElement)],
  });
}

const element = (name: string, attributes: Record<string, string>, children: readonly Written[] = []): Written => ({
  name,
  attributes,
  children,
});
/** The shortest digits that give the number back; no −0. */
const digits = (value: number): string => String(value || 0);
const triple = (values: readonly number[]): string => values.map(digits).join(" ");

function linkElement(link: TreeLink): Written {
  const shapes = ["visual", "collision"].flatMap(use =>
    link.boxes.map(({ centre_m, size_m }) =>
      element(use, {}, [
        element("origin", { xyz: triple(centre_m) }),
        element("geometry", {}, [element("box", { size: triple(size_m) })]),
      ]),
    ),
  );
  return element("link", { name: link.name }, [...inertial(link), ...shapes]);
}

function inertial({ mass_kg, boxes }: TreeLink): Written[] {
  const volumes = boxes.map(({ size_m: [x, y, z] }) => x * y * z);
  const volume = volumes.reduce((sum, each) => sum + each, 0);
  if (!(volume > 0) || !(mass_kg > 0)) return [];
  const masses = volumes.map(each => (mass_kg * each) / volume);
  const centre = [0, 1, 2].map(k => boxes.reduce((sum, box, i) => sum + (masses[i]! * box.centre_m[k]!) / mass_kg, 0));
  const total = { ixx: 0, ixy: 0, ixz: 0, iyy: 0, iyz: 0, izz: 0 };
  boxes.forEach(({ centre_m, size_m: [x, y, z] }, i) => {
    const m = masses[i]!;
    const [rx, ry, rz] = centre_m.map((value, k) => value - centre[k]!) as Vector3;
    total.ixx += m * ((y * y + z * z) / 12 + ry * ry + rz * rz);
    total.iyy += m * ((x * x + z * z) / 12 + rx * rx + rz * rz);
    total.izz += m * ((x * x + y * y) / 12 + rx * rx + ry * ry);
    total.ixy -= m * rx * ry;
    total.ixz -= m * rx * rz;
    total.iyz -= m * ry * rz;
  });
  return [
    element("inertial", {}, [
      element("origin", { xyz: triple(centre) }),
      element("mass", { value: digits(mass_kg) }),
      element("inertia", Object.fromEntries(Object.entries(total).map(([key, value]) => [key, digits(value)]))),
    ]),
  ];
}

function jointElement({ name, kind, parent, child, at_m, axis, limits, mimic }: TreeJoint): Written {
  const children: Written[] = [
    element("origin", { xyz: triple(at_m) }),
    element("parent", { link: parent }),
    element("child", { link: child }),
  ];
  if (axis) children.push(element("axis", { xyz: triple(axis) }));
  if (limits)
    children.push(
      element("limit", {
        lower: digits(limits.lower),
        upper: digits(limits.upper),
        velocity: digits(limits.speed),
        effort: digits(limits.effort),
      }),
    );
  if (mimic) children.push(element("mimic", { joint: mimic.joint, multiplier: digits(mimic.multiplier) }));
  return element("joint", { name, type: kind }, children);
}
