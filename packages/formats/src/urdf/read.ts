import { fromAxisAngle, multiply, normalize, pose, type Pose, type Quaternion, type Vector3 } from "@twincell/core";
import { answering, locating, Refusal, type NotUnderstood } from "../refusal.ts";
import { attributeOf, childOf, childrenOf, numbersIn, parseXml, shorten, type Element } from "../xml.ts";
import type { UrdfGeometry, UrdfJoint, UrdfLink, UrdfRead, UrdfRobot, UrdfShape } from "./model.ts";

/**
 * Reads a URDF. Nothing outside the text is opened: meshes stay references.
 *
 * @returns the robot with warnings for what was passed over, or one sentence that says what stands in the way.
 */
export function readUrdf(text: string): UrdfRead | NotUnderstood {
  return answering(() => {
    const root = parseXml(text);
    refuseXacro(root);
    return { kind: "read", ...robotOf(root) };
  });
}

/** The robot of a parsed description in which nothing is left to expand. @throws {Refusal} */
export function robotOf(root: Element): { readonly robot: UrdfRobot; readonly warnings: readonly string[] } {
  const warnings: string[] = [];
  if (root.name !== "robot")
    throw new Refusal(
      `The file begins with <${shorten(root.name)}>; a robot description begins with <robot>.`,
      root.line,
      root.file,
    );
  const colours = new Map<string, readonly number[]>();
  for (const material of childrenOf(root, "material")) {
    const rgba = colourOf(material);
    if (rgba && material.attributes["name"]) colours.set(material.attributes["name"], rgba);
  }
  const links = childrenOf(root, "link").map(element => locating(element, () => linkOf(element, colours)));
  const joints = childrenOf(root, "joint").map(element => locating(element, () => jointOf(element, warnings)));
  const robot = { name: root.attributes["name"] ?? "robot", root: rootOf(links, joints, root.line), links, joints };
  checkTree(robot);
  return { robot, warnings };
}

function refuseXacro(element: Element): void {
  for (const child of element.children) {
    if (child.name.startsWith("xacro:"))
      throw new Refusal(
        `The file is a xacro (it holds <${shorten(child.name)}>); expand it to a URDF first.`,
        child.line,
      );
  }
}

function linkOf(element: Element, colours: ReadonlyMap<string, readonly number[]>): UrdfLink {
  const name = attributeOf(element, "name", "A link");
  const inertial = childOf(element, "inertial");
  const shapes = (kind: string): UrdfShape[] =>
    childrenOf(element, kind).map(shape => shapeOf(shape, `Link ${shorten(name)}`, colours));
  return {
    name,
    visuals: shapes("visual"),
    collisions: shapes("collision"),
    ...(inertial ? { inertial: inertialOf(inertial, `Link ${shorten(name)}`) } : {}),
  };
}

function inertialOf(element: Element, of: string): NonNullable<UrdfLink["inertial"]> {
  const mass = childOf(element, "mass");
  const inertia = childOf(element, "inertia");
  const mass_kg = mass ? numberOf(mass, "value", `The mass of ${of}`, 0) : 0;
  if (mass_kg < 0) throw new Refusal(`${of} has a mass of ${mass_kg} kg.`, element.line);
  return {
    linkFromInertial: originOf(element, of),
    mass_kg,
    inertia_kg_m2: ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].map(key =>
      inertia ? numberOf(inertia, key, `The inertia ${key} of ${of}`, 0) : 0,
    ),
  };
}

function shapeOf(element: Element, of: string, colours: ReadonlyMap<string, readonly number[]>): UrdfShape {
  const geometry = childOf(element, "geometry")?.children[0];
  if (!geometry) throw new Refusal(`${of} has a ${element.name} without geometry.`, element.line);
  const material = childOf(element, "material");
  const rgba = material && (colourOf(material) ?? colours.get(material.attributes["name"] ?? ""));
  return { linkFromShape: originOf(element, of), geometry: geometryOf(geometry, of), ...(rgba ? { rgba } : {}) };
}

function geometryOf(element: Element, of: string): UrdfGeometry {
  const positive = (name: string): number => {
    const value = numberOf(element, name, `The ${element.name} of ${of}`);
    if (value <= 0) throw new Refusal(`The ${element.name} of ${of} has a ${name} of ${value} m.`, element.line);
    return value;
  };
  switch (element.name) {
    case "mesh":
      return {
        kind: "mesh",
        reference: attributeOf(element, "filename", `The mesh of ${of}`),
        scale: vectorOf(element, "scale", of, [1, 1, 1]),
      };
    case "box": {
      const size_m = vectorOf(element, "size", `The box of ${of}`);
      if (size_m.some(edge => edge <= 0))
        throw new Refusal(`The box of ${of} has an edge of ${Math.min(...size_m)} m.`, element.line);
      return { kind: "box", size_m };
    }
    case "cylinder":
      return { kind: "cylinder", radius_m: positive("radius"), length_m: positive("length") };
    case "sphere":
      return { kind: "sphere", radius_m: positive("radius") };
    default:
      throw new Refusal(
        `${of} has a geometry <${shorten(element.name)}>; mesh, box, cylinder and sphere are read.`,
        element.line,
      );
  }
}

function colourOf(material: Element): readonly number[] | undefined {
  const colour = childOf(material, "color");
  return (
    colour &&
    numbersIn(colour.attributes["rgba"] ?? "", 4, "A colour", colour.line).map(value => Math.min(1, Math.max(0, value)))
  );
}

const TYPES: readonly UrdfJoint["type"][] = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar"];

function jointOf(element: Element, warnings: string[]): UrdfJoint {
  const name = attributeOf(element, "name", "A joint");
  const of = `Joint ${shorten(name)}`;
  const written = attributeOf(element, "type", of);
  const type = TYPES.find(known => known === written);
  if (!type) throw new Refusal(`${of} has the type “${shorten(written)}”; ${TYPES.join(", ")} are read.`, element.line);
  const end = (which: "parent" | "child"): string => {
    const node = childOf(element, which);
    if (!node) throw new Refusal(`${of} has no ${which}.`, element.line);
    return attributeOf(node, "link", `The ${which} of ${of}`);
  };
  const axisElement = childOf(element, "axis");
  const axis = axisElement ? vectorOf(axisElement, "xyz", `The axis of ${of}`, [1, 0, 0]) : ([1, 0, 0] as Vector3);
  const unit = normalize(axis);
  if (Math.hypot(...axis) < 1e-9 && type !== "fixed" && type !== "floating")
    throw new Refusal(`The axis of ${of} is (0, 0, 0) and has no direction.`, element.line);
  const limit = limitOf(childOf(element, "limit"), of);
  const mimic = mimicOf(childOf(element, "mimic"), of);
  if (type === "revolute" && !limit) warnings.push(`${of} turns but has no limits.`);
  return {
    name,
    type,
    parent: end("parent"),
    child: end("child"),
    parentFromJoint: originOf(element, of),
    axis: unit,
    line: element.line,
    ...(limit ? { limit } : {}),
    ...(mimic ? { mimic } : {}),
  };
}

function limitOf(element: Element | undefined, of: string): UrdfJoint["limit"] {
  if (!element) return undefined;
  const value = (name: string): number => numberOf(element, name, `The ${name} limit of ${of}`, 0);
  const limit = { lower: value("lower"), upper: value("upper"), velocity: value("velocity"), effort: value("effort") };
  if (limit.lower > limit.upper)
    throw new Refusal(
      `The lower limit of ${of}, ${limit.lower}, is above its upper limit, ${limit.upper}.`,
      element.line,
    );
  if (limit.velocity < 0) throw new Refusal(`The speed limit of ${of} is ${limit.velocity}, below 0.`, element.line);
  return limit;
}

function mimicOf(element: Element | undefined, of: string): UrdfJoint["mimic"] {
  if (!element) return undefined;
  return {
    joint: attributeOf(element, "joint", `The mimic of ${of}`),
    multiplier: numberOf(element, "multiplier", `The mimic of ${of}`, 1),
    offset: numberOf(element, "offset", `The mimic of ${of}`, 0),
  };
}

function originOf<Into extends string, From extends string>(element: Element, of: string): Pose<Into, From> {
  const origin = childOf(element, "origin");
  if (!origin) return pose();
  return pose(
    vectorOf(origin, "xyz", `An origin of ${of}`, [0, 0, 0]),
    fromRollPitchYaw(...vectorOf(origin, "rpy", `An origin of ${of}`, [0, 0, 0])),
  );
}

/** R = Rz(yaw) · Ry(pitch) · Rx(roll), the convention of URDF. */
function fromRollPitchYaw(roll_rad: number, pitch_rad: number, yaw_rad: number): Quaternion {
  const yaw = fromAxisAngle([0, 0, 1], yaw_rad);
  return multiply(multiply(yaw, fromAxisAngle([0, 1, 0], pitch_rad)), fromAxisAngle([1, 0, 0], roll_rad));
}

function vectorOf(element: Element, name: string, of: string, otherwise?: Vector3): Vector3 {
  const text = element.attributes[name];
  if (text === undefined && otherwise) return [...otherwise];
  const [x, y, z] = numbersIn(text ?? "", 3, of, element.line);
  return [x!, y!, z!];
}

function numberOf(element: Element, name: string, of: string, otherwise?: number): number {
  const text = element.attributes[name];
  return text === undefined && otherwise !== undefined ? otherwise : numbersIn(text ?? "", 1, of, element.line)[0]!;
}

function rootOf(links: readonly UrdfLink[], joints: readonly UrdfJoint[], line: number): string {
  if (links.length === 0) throw new Refusal("The robot has no links.", line);
  const children = new Set(joints.map(joint => joint.child));
  const roots = links.filter(link => !children.has(link.name));
  if (roots.length === 0) throw new Refusal("Every link is the child of another: the joints run in a loop.", line);
  if (roots.length > 1)
    throw new Refusal(
      `Links ${shorten(roots[0]!.name)} and ${shorten(roots[1]!.name)} both hang on nothing; a robot has one root.`,
      line,
    );
  return roots[0]!.name;
}

function checkTree({ links, joints, root }: UrdfRobot): void {
  const known = new Set<string>();
  const names = new Set<string>();
  const parents = new Map<string, UrdfJoint>();
  for (const { name } of links) {
    if (known.has(name)) throw new Refusal(`Two links are called ${shorten(name)}.`);
    known.add(name);
  }
  for (const joint of joints) {
    if (names.has(joint.name)) throw new Refusal(`Two joints are called ${shorten(joint.name)}.`, joint.line);
    names.add(joint.name);
    for (const end of [joint.parent, joint.child]) {
      if (!known.has(end))
        throw new Refusal(
          `Joint ${shorten(joint.name)} names the link ${shorten(end)}, which is not in the file.`,
          joint.line,
        );
    }
    if (parents.has(joint.child))
      throw new Refusal(
        `Link ${shorten(joint.child)} is the child of two joints: chains that close on themselves are not read.`,
        joint.line,
      );
    parents.set(joint.child, joint);
  }
  // From every link the way to the root is shorter than the number of links, or it runs in a loop.
  for (const link of links) {
    let at = link.name;
    for (let steps = 0; at !== root; steps++) {
      const up = parents.get(at);
      if (!up || steps > links.length)
        throw new Refusal(
          `Link ${shorten(link.name)} is not connected to the root ${shorten(root)}: the joints run in a loop.`,
        );
      at = up.parent;
    }
  }
}
