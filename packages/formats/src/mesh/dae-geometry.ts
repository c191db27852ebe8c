import { Refusal } from "../refusal.ts";
import { childOf, childrenOf, shorten, type Element } from "../xml.ts";
import { triangleRun } from "./placed.ts";
import { addPolygon, MAX_CORNERS } from "./polygon.ts";

/** Corners and triangles of a <geometry>. */
export interface DaeGeometry {
  readonly points: ArrayLike<number>;
  readonly triangles: number[];
  /** Which of the triangles' corners wear which material: its symbol, the first corner, the corner after the last. */
  readonly ranges: readonly { readonly symbol: string; readonly first: number; readonly end: number }[];
}

/** The surface of a COLLADA <geometry>; lines are counted in `skipped`. */
export function daeGeometry(element: Element, skipped: Map<string, number>): DaeGeometry {
  const mesh = childOf(element, "mesh");
  const ranges: { symbol: string; first: number; end: number }[] = [];
  const parts = { points: [] as number[], triangles: [] as number[], ranges };
  if (!mesh) {
    count(skipped, "curved geometry", 1);
    return parts;
  }
  const firsts = new Map<string, number>();
  for (const primitive of mesh.children) {
    if (["lines", "linestrips"].includes(primitive.name)) {
      count(skipped, "line set", 1);
      continue;
    }
    if (!["triangles", "polylist", "polygons", "tristrips", "trifans"].includes(primitive.name)) continue;
    const { source, offset, stride } = vertexInput(primitive, mesh);
    let first = firsts.get(source.attributes["id"] ?? "");
    if (first === undefined) {
      first = parts.points.length / 3;
      firsts.set(source.attributes["id"] ?? "", first);
      for (const value of pointsOf(source)) parts.points.push(value);
    }
    const total = parts.points.length / 3 - first;
    const start = first;
    const cornersOf = (p: Element): number[] => {
      const all = integersIn(p.text, p);
      const corners: number[] = [];
      for (let at = offset; at < all.length; at += stride) {
        const index = all[at]!;
        if (index < 0 || index >= total) throw new Refusal(`A face names vertex ${index}; there are ${total}.`, p.line);
        corners.push(start + index);
      }
      return corners;
    };
    const before = parts.triangles.length;
    faces(primitive, cornersOf, parts);
    ranges.push({ symbol: primitive.attributes["material"] ?? "", first: before, end: parts.triangles.length });
  }
  return parts;
}

function faces(
  primitive: Element,
  cornersOf: (p: Element) => number[],
  { points, triangles }: { readonly points: number[]; readonly triangles: number[] },
): void {
  const add = (corners: readonly number[]): void => {
    if (corners.length > MAX_CORNERS)
      throw new Refusal(`A face has ${corners.length} corners; at most ${MAX_CORNERS} are read.`, primitive.line);
    if (corners.length > 2) addPolygon(corners, points, triangles);
  };
  for (const p of childrenOf(primitive, "p")) {
    const corners = cornersOf(p);
    if (primitive.name === "triangles")
      for (let at = 0; at + 2 < corners.length; at += 3)
        triangles.push(corners[at]!, corners[at + 1]!, corners[at + 2]!);
    else if (primitive.name === "polylist") {
      let at = 0;
      for (const corner of integersIn(childOf(primitive, "vcount")?.text ?? "", primitive)) {
        add(corners.slice(at, at + corner));
        at += corner;
      }
      if (at > corners.length)
        throw new Refusal(`The polygons want ${at} corners, but ${corners.length} are given.`, primitive.line);
    } else if (primitive.name === "polygons") add(corners);
    else
      for (const corner of triangleRun(primitive.name === "trifans" ? "fan" : "strip", corners)) triangles.push(corner);
  }
  for (const ph of childrenOf(primitive, "ph")) {
    const p = childOf(ph, "p");
    if (p) add(cornersOf(p));
  }
}

interface VertexInput {
  readonly source: Element;
  readonly offset: number;
  readonly stride: number;
}

function vertexInput(primitive: Element, mesh: Element): VertexInput {
  const inputs = childrenOf(primitive, "input");
  const offsetOf = (input: Element): number =>
    Math.min(64, Math.max(0, Math.trunc(Number(input.attributes["offset"] ?? 0)) || 0));
  const vertex = inputs.find(input => input.attributes["semantic"] === "VERTEX");
  const vertices = vertex && byId(childrenOf(mesh, "vertices"), vertex.attributes["source"]);
  const position = vertices && childrenOf(vertices, "input").find(input => input.attributes["semantic"] === "POSITION");
  const source = position && byId(childrenOf(mesh, "source"), position.attributes["source"]);
  if (!vertex || !source) throw new Refusal("A set of faces names no corners.", primitive.line);
  return { source, offset: offsetOf(vertex), stride: 1 + Math.max(...inputs.map(offsetOf)) };
}

function pointsOf(source: Element): number[] {
  const array = childOf(source, "float_array");
  const common = childOf(source, "technique_common");
  const accessor = common && childOf(common, "accessor");
  const whole = (name: string, otherwise: number): number =>
    Math.max(0, Math.trunc(Number(accessor?.attributes[name] ?? otherwise)) || 0);
  const numbers = numbersOf(array?.text ?? "", source);
  const stride = Math.max(3, whole("stride", 3));
  const points: number[] = [];
  for (let at = whole("offset", 0); at + 2 < numbers.length; at += stride)
    points.push(numbers[at]!, numbers[at + 1]!, numbers[at + 2]!);
  return points;
}

/** The element an address like `#name` means. */
export function byId(elements: readonly Element[], address: string | undefined): Element | undefined {
  return address?.startsWith("#") ? elements.find(element => element.attributes["id"] === address.slice(1)) : undefined;
}

/** Numbers with spaces between; NaN and infinity stay and are counted later. */
export function numbersOf(text: string, at: Element): number[] {
  const words = text.trim() === "" ? [] : text.trim().split(/\s+/);
  return words.map(word => {
    const value = Number(word);
    if (Number.isNaN(value) && !/^[+-]?(nan|inf)/i.test(word))
      throw new Refusal(`“${shorten(word)}” stands where a number is expected.`, at.line);
    return value;
  });
}
function integersIn(text: string, at: Element): number[] {
  const numbers = numbersOf(text, at);
  const wrong = numbers.find(value => !Number.isInteger(value) || value < 0);
  if (wrong !== undefined) throw new Refusal(`${wrong} stands where a vertex is named.`, at.line);
  return numbers;
}
export const count = (skipped: Map<string, number>, what: string, by: number): void => {
  skipped.set(what, (skipped.get(what) ?? 0) + by);
};
