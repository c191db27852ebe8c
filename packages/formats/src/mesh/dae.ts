import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { utf8 } from "../utf8.ts";
import { childOf, childrenOf, parseXml, shorten, type Element } from "../xml.ts";
import { daeColors } from "./dae-colors.ts";
import { byId, count, daeGeometry, numbersOf, type DaeGeometry } from "./dae-geometry.ts";
import { moved, passedOver, scaled, Soup, times, UNMOVED, type Matrix4 } from "./placed.ts";
import { finishMesh, type MeshRead } from "./report.ts";

const BOUNDS = { characters: 256_000_000, elements: 500_000 };
const DEEPEST = 64;
const LARGEST_FILE = 256_000_000;
/** What turns x-up and y-up files upright. */
const UPRIGHT: Readonly<Record<string, Matrix4>> = {
  X_UP: [0, -1, 0, 0, 0, 0, -1, 0, 1, 0, 0, 0, 0, 0, 0, 1],
  Y_UP: [1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1],
  Z_UP: UNMOVED,
};
const TRANSFORMS = new Set(["translate", "rotate", "scale", "matrix"]);
const PASSED = new Map([
  ["instance_controller", "moving skin"],
  ["instance_camera", "camera"],
  ["instance_light", "light"],
  ["lookat", "lookat"],
  ["skew", "skew"],
]);

/**
 * `file` turns the surface upright as the file says; `z` takes its z for up whatever it says, as ROS does for robots.
 */
export type DaeUp = "file" | "z";

/** A part of a COLLADA file where its nodes put it: metres, z up. */
export interface DaePart {
  /** Names of the nodes it hangs on, the outermost first. */
  readonly path: readonly string[];
  /** Red, green, blue from 0 to 1 as shown; undefined where its material names no colour. */
  readonly color: readonly [number, number, number] | undefined;
  readonly positions: Float64Array;
  readonly indices: Uint32Array;
}
export interface DaeParts {
  readonly parts: readonly DaePart[];
  /** Metres per unit of the file, undefined where it says none and 1 is taken. */
  readonly statedUnit_m: number | undefined;
  readonly up: string;
  readonly notes: readonly string[];
}

/**
 * Reads the surfaces of a COLLADA file, every node where its matrices put it, in metres and z up whatever the file
 * counts in. Materials, cameras, lights and animations are passed over, and the report says so.
 */
export function readDae(bytes: Uint8Array, up: DaeUp = "file"): MeshRead | NotUnderstood {
  return answering(() => {
    const soup = new Soup();
    const { notes } = visitDae(bytes, up, ({ points, triangles }, matrix) => soup.add(points, triangles, matrix));
    return finishMesh("COLLADA", soup.mesh(), [...notes]);
  });
}

/** The same part by part, with the diffuse colour of each material. @throws {Refusal} as `readDae` answers it. */
export function daeParts(bytes: Uint8Array, up: DaeUp): DaeParts {
  const parts: DaePart[] = [];
  let corners = 0;
  const said = visitDae(bytes, up, ({ points, triangles, ranges }, matrix, path, colorOf) => {
    corners += triangles.length + points.length / 3;
    if (corners > MOST_CORNERS_OF_ALL)
      throw new Refusal(`The parts of the file make more than ${MOST_CORNERS_OF_ALL} corners.`);
    for (const { symbol, first, end } of ranges) {
      if (end === first) continue;
      const soup = new Soup();
      soup.add(points, triangles.slice(first, end), matrix);
      parts.push({ path, color: colorOf(symbol), ...soup.mesh() });
    }
  });
  if (parts.length === 0) throw new Refusal("The file holds no faces.");
  return { parts, ...said };
}
const MOST_CORNERS_OF_ALL = 60_000_000;

type ColorOf = (symbol: string) => readonly [number, number, number] | undefined;
type GeometryVisitor = (geometry: DaeGeometry, matrix: Matrix4, path: readonly string[], colorOf: ColorOf) => void;

function visitDae(bytes: Uint8Array, wanted: DaeUp, visit: GeometryVisitor): Omit<DaeParts, "parts"> {
  if (bytes.length > LARGEST_FILE)
    throw new Refusal(`The file has ${bytes.length} bytes; at most ${LARGEST_FILE} are read.`);
  const root = parseXml(utf8(bytes), undefined, BOUNDS);
  if (root.name !== "COLLADA")
    throw new Refusal(`The file begins with <${shorten(root.name)}>; a COLLADA file begins with <COLLADA>.`, root.line);
  const scene = new Scene(root, visit);
  const asset = childOf(root, "asset");
  const stated = asset && childOf(asset, "unit")?.attributes["meter"];
  const unit = Number(stated || 1);
  const up = (asset && childOf(asset, "up_axis")?.text.trim()) || "Y_UP";
  const upright = UPRIGHT[up];
  if (!(unit > 0 && unit <= 1e6)) throw new Refusal(`The unit of the file is ${unit} m.`, asset?.line);
  if (!upright) throw new Refusal(`The file is “${shorten(up)}”; X_UP, Y_UP and Z_UP are known.`, asset?.line);
  scene.whole(times(wanted === "z" ? UNMOVED : upright, scaled(unit, unit, unit)));
  return { statedUnit_m: stated ? unit : undefined, up, notes: passedOver(scene.skipped) };
}

class Scene {
  readonly skipped = new Map<string, number>();
  private readonly root: Element;
  private readonly visit: GeometryVisitor;
  private readonly colors: ReturnType<typeof daeColors>;
  private readonly geometries: readonly Element[];
  private readonly nodes: readonly Element[];
  private readonly read = new Map<Element, DaeGeometry>();
  private visits = 0;
  constructor(root: Element, visit: GeometryVisitor) {
    this.root = root;
    this.visit = visit;
    this.colors = daeColors(root);
    this.geometries = this.library("library_geometries", "geometry");
    this.nodes = this.library("library_nodes", "node");
  }
  private library(name: string, of: string): Element[] {
    return childrenOf(this.root, name).flatMap(library => childrenOf(library, of));
  }

  whole(start: Matrix4): void {
    const scenes = this.library("library_visual_scenes", "visual_scene");
    const instance = childOf(this.root, "scene");
    const chosen = instance && childOf(instance, "instance_visual_scene");
    const scene = byId(scenes, chosen?.attributes["url"]) ?? scenes[0];
    if (scene) for (const node of childrenOf(scene, "node")) this.node(node, start, []);
    else for (const geometry of this.geometries) this.geometry(geometry, start, [nameOf(geometry)], undefined);
  }

  private node(element: Element, outer: Matrix4, above: readonly string[]): void {
    const depth = above.length;
    if (depth > DEEPEST || ++this.visits > 200_000)
      throw new Refusal(
        `The nodes of the file hold each other ${depth > DEEPEST ? `more than ${DEEPEST} deep` : "more than 200000 times"}.`,
        element.line,
      );
    const path = [...above, nameOf(element)];
    let matrix = outer;
    for (const child of element.children) if (TRANSFORMS.has(child.name)) matrix = times(matrix, transformOf(child));
    for (const child of element.children) {
      if (child.name === "node") this.node(child, matrix, path);
      else if (child.name === "instance_node") this.node(this.found(this.nodes, child), matrix, path);
      else if (child.name === "instance_geometry")
        this.geometry(this.found(this.geometries, child), matrix, path, child);
      else if (PASSED.has(child.name)) count(this.skipped, PASSED.get(child.name) ?? "", 1);
    }
  }
  private found(among: readonly Element[], instance: Element): Element {
    const element = byId(among, instance.attributes["url"]);
    if (!element)
      throw new Refusal(`“${shorten(instance.attributes["url"] ?? "")}” is not in the file.`, instance.line);
    return element;
  }
  private geometry(element: Element, matrix: Matrix4, path: readonly string[], instance: Element | undefined): void {
    const geometry = this.read.get(element) ?? daeGeometry(element, this.skipped);
    this.read.set(element, geometry);
    this.visit(geometry, matrix, path, symbol => this.colors(symbol, instance));
  }
}

const nameOf = (element: Element): string => element.attributes["name"] ?? element.attributes["id"] ?? "";

function transformOf(element: Element): Matrix4 {
  const n = numbersOf(element.text, element);
  const wanted = { translate: 3, scale: 3, rotate: 4, matrix: 16 }[element.name] ?? 0;
  if (n.length !== wanted || !n.every(Number.isFinite))
    throw new Refusal(`A <${element.name}> has ${n.length} numbers instead of ${wanted} finite ones.`, element.line);
  const [x, y, z, angle] = n;
  switch (element.name) {
    case "translate":
      return moved(x!, y!, z!);
    case "scale":
      return scaled(x!, y!, z!);
    case "matrix":
      return n;
    default:
      return rotation(x!, y!, z!, (angle! * Math.PI) / 180);
  }
}

/** Rodrigues' rotation about any axis; one of length 0 turns nothing. */
function rotation(ax: number, ay: number, az: number, angle_rad: number): Matrix4 {
  const length = Math.hypot(ax, ay, az);
  if (length === 0) return UNMOVED;
  const x = ax / length;
  const y = ay / length;
  const z = az / length;
  const c = Math.cos(angle_rad);
  const s = Math.sin(angle_rad);
  const v = 1 - c;
  return [
    x * x * v + c,
    x * y * v - z * s,
    x * z * v + y * s,
    0,
    x * y * v + z * s,
    y * y * v + c,
    y * z * v - x * s,
    0,
    x * z * v - y * s,
    y * z * v + x * s,
    z * z * v + c,
    0,
    0,
    0,
    0,
    1,
  ];
}
