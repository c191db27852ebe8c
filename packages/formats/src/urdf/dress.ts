import { identity, inverse, linkPoses, rotate, type Pose } from "@twincell/core";
import type { FittedSurface } from "../mesh/gltf-surfaces.ts";
import type { UrdfChain } from "./chain.ts";

/** A surface on a moving link of the arm: its positions are in that link's frame. */
export interface LinkSurface extends FittedSurface {
  readonly link: number;
  readonly name: string;
}

/** One robot: the arm of the URDF in the surfaces of the glTF. */
export interface FittedArm {
  readonly surfaces: readonly LinkSurface[];
  /** Links of the URDF that have a shape and got nothing to wear: their own shape stays. */
  readonly bare: readonly string[];
  /** Nodes of the glTF that are no link of this robot; they are left out. */
  readonly spare: readonly string[];
}

/**
 * Puts the textured surfaces of a glTF on the links of a URDF robot (row L-09, Table A1 steps 5–7): both are laid over
 * each other with all joints at zero, each surface goes to the link its node is named after, and what is left of the
 * second robot is dropped. Spelling with or without capitals, blanks and exporters' suffixes (“.001”) is the same name.
 */
export function fitArm(chain: UrdfChain, surfaces: readonly FittedSurface[]): FittedArm {
  const n = chain.arm.joints.length;
  const atZero = Array.from({ length: n + 1 }, () => identity<"base", "link">());
  linkPoses(chain.arm, new Float64Array(n), atZero);
  const linkOf = new Map<string, { readonly link: number; readonly name: string }>();
  for (const { link, name } of chain.shapes) linkOf.set(plain(name), { link, name });
  const dressed: LinkSurface[] = [];
  const worn = new Set<string>();
  const spare = new Set<string>();
  for (const surface of surfaces) {
    const found = surface.nodes.map(node => linkOf.get(plain(node))).find(each => each !== undefined);
    if (!found) {
      spare.add(surface.nodes[0] ?? "");
      continue;
    }
    worn.add(found.name);
    dressed.push({ ...surface, ...found, positions: movedBy(inverse(atZero[found.link]!), surface.positions) });
  }
  return {
    surfaces: dressed,
    bare: [...linkOf.values()].map(({ name }) => name).filter(name => !worn.has(name)),
    spare: [...spare],
  };
}

const plain = (name: string): string =>
  name
    .toLowerCase()
    .replace(/\.\d+$/, "")
    .replace(/[\s_-]+/g, "_");

function movedBy(pose: Pose, positions: Float64Array): Float64Array {
  const out = new Float64Array(positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    const turned = rotate(pose.quaternion, [positions[i]!, positions[i + 1]!, positions[i + 2]!]);
    for (let k = 0; k < 3; k++) out[i + k] = turned[k]! + pose.position[k]!;
  }
  return out;
}
