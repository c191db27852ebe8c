import type { LinkSolid } from "../../mesh/link-solid.ts";
import { linkPoses } from "../../kinematics/forward.ts";
import { identity } from "../../spatial/pose.ts";
import type { OwnLink } from "../../model/form.ts";
import type { Robot } from "../../model/robot.ts";
import { articulatedArm } from "./articulated-arm.ts";
import { intoLink, merge } from "./loft.ts";
import type { LinkDesign, LinkShape } from "./link-shape.ts";
import { loftedLink } from "./lofted.ts";
import { plainArm } from "./plain-arm.ts";

/** "link 0" (the base), "link 1", … "link 6": how contacts, labels and allowed pairs call the links. */
export const linkName = (link: number): string => `link ${link}`;

/** Links as designed, each already in its own frame. */
export function linkDesigns(robot: Robot): LinkDesign[] {
  if (robot.links !== undefined) return robot.links.map(ownDesign);
  if (robot.form !== undefined) return robot.form.links.map(({ material, lofts }) => loftedLink(material, lofts));
  const { arm, family } = robot;
  const n = arm.joints.length;
  const parallel = family.kind === "ortho-parallel" && n === 6;
  const q_rad = parallel ? family.offsets_rad.map((offset, i) => offset * family.signs[i]!) : new Float64Array(n);
  const designs = parallel ? articulatedArm(family) : plainArm(robot);
  const baseFromLink = Array.from({ length: n + 1 }, () => identity<"base", "link">());
  linkPoses(arm, q_rad, baseFromLink);
  return designs.map((design, link) => ({
    parts: design.parts.map(part => ({ ...part, mesh: intoLink(part.mesh, baseFromLink[link]!) })),
    shells: design.shells.map(mesh => intoLink(mesh, baseFromLink[link]!)),
  }));
}

const ownDesign = ({ parts, solids }: OwnLink, link: number): LinkDesign => ({
  parts: parts.map(({ color, mesh }, i) => ({
    name: `${linkName(link)} ${i + 1}`,
    material: "casting",
    ...(color === undefined ? {} : { color }),
    mesh,
  })),
  shells: solids ?? parts.map(({ mesh }) => mesh),
});

/** What is drawn of a robot, link by link, in the frame of each link. */
export const linkShapes = (robot: Robot): LinkShape[] =>
  linkDesigns(robot).map((design, link) => ({ link, name: linkName(link), parts: design.parts }));

/** Made once for each robot: their trees of boxes are kept by the meshes. */
const solidsOf = new WeakMap<Robot, readonly LinkSolid[]>();

/** The coarse solids of a robot: closed, few triangles, and enclosing everything that is drawn. */
export function linkSolids(robot: Robot): readonly LinkSolid[] {
  const known = solidsOf.get(robot);
  if (known) return known;
  const made = linkDesigns(robot)
    .map((design, link) => ({ link, name: linkName(link), mesh: merge(design.shells) }))
    .filter(({ mesh }) => mesh.indices.length > 0);
  solidsOf.set(robot, made);
  return made;
}
