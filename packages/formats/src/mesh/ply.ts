import { answering, Refusal, type NotUnderstood } from "../refusal.ts";
import { shorten } from "../xml.ts";
import { plyHeader, sizeOf, type PlyElement, type PlyHeader, type PlyNumber } from "./ply-header.ts";
import { addPolygon, MAX_CORNERS } from "./polygon.ts";
import { finishMesh, type MeshRead } from "./report.ts";
import { latin1 } from "./text.ts";

/** Gives the numbers of the file one after the other; refuses when there are no more. */
interface Numbers {
  next(type: PlyNumber): number;
  where(): number | undefined;
}

/**
 * Reads the surface of a PLY, as scanners write it: ASCII and binary of both byte orders (row N-65). Elements and
 * properties that are no surface (colour, normals, confidence) are passed over; faces with more than three corners are
 * cut into triangles. A cloud of points without faces is refused: nothing could be touched or traced on it.
 *
 * @see G. Turk, The PLY Polygon File Format, Stanford University 1994.
 */
export function readPly(bytes: Uint8Array): MeshRead | NotUnderstood {
  return answering(() => {
    const { positions, indices, isBinary } = plyContent(bytes);
    if (indices.length === 0) {
      throw new Refusal(
        `The file is a cloud of ${positions.length / 3} points without faces: make a surface of it first (for example screened Poisson reconstruction in the scanner's software or MeshLab) and export that as PLY.`,
      );
    }
    return finishMesh(isBinary ? "PLY (binary)" : "PLY (ASCII)", { positions, indices }, []);
  });
}

/** What stands in a PLY: corners, faces where it has any, the mean colour of its corners where they have one. */
export interface PlyContent {
  readonly positions: Float64Array;
  readonly indices: Uint32Array;
  readonly isBinary: boolean;
  /** Red, green, blue from 0 to 1. */
  readonly meanColor: readonly [number, number, number] | undefined;
}

/** @throws {Refusal} for what is no PLY, or ends too early. */
export function plyContent(bytes: Uint8Array): PlyContent {
  const header = plyHeader(bytes);
  const isBinary = header.encoding !== "ascii";
  const numbers = isBinary
    ? binaryNumbers(bytes, header)
    : textNumbers(latin1(bytes.subarray(header.end)), header.lines);
  let vertex: Pick<PlyContent, "positions" | "meanColor"> = { positions: new Float64Array(0), meanColor: undefined };
  const indices: number[] = [];
  for (const element of header.elements) {
    if (
      (!isBinary && element.count > bytes.length) ||
      (isBinary && element.count * leastSize(element) > bytes.length)
    ) {
      throw new Refusal(
        `The header promises ${element.count} elements “${shorten(element.name)}”, but the file has ${bytes.length} bytes.`,
      );
    }
    if (element.name === "vertex") vertex = vertices(element, numbers);
    else readFaces(element, numbers, vertex.positions, indices);
  }
  return { ...vertex, indices: Uint32Array.from(indices), isBinary };
}

const leastSize = ({ properties }: PlyElement): number =>
  Math.max(
    1,
    properties.reduce((sum, { type, count }) => sum + sizeOf(count ?? type), 0),
  );

function vertices({ count, properties }: PlyElement, numbers: Numbers): Pick<PlyContent, "positions" | "meanColor"> {
  const channels = properties.map(({ name }) => ["red", "green", "blue"].indexOf(name));
  const sums = [0, 0, 0];
  const axes = properties.map(({ name }) => ["x", "y", "z"].indexOf(name));
  const positions = new Float64Array(3 * count);
  for (const [axis, name] of ["x", "y", "z"].entries())
    if (!axes.includes(axis)) throw new Refusal(`The vertices have no property “${name}”.`);
  for (let v = 0; v < count; v++)
    for (const [p, property] of properties.entries()) {
      const values = property.count === undefined ? 1 : length(numbers.next(property.count), numbers);
      for (let i = 0; i < values; i++) {
        const value = numbers.next(property.type);
        const axis = axes[p]!;
        if (axis >= 0) positions[3 * v + axis] = value;
        const channel = channels[p]!;
        if (channel >= 0) sums[channel]! += /^u?int/.test(property.type) ? value / 255 : value;
      }
    }
  const [red, green, blue] = sums.map(sum => sum / count);
  const isColored = count > 0 && [0, 1, 2].every(channel => channels.includes(channel));
  return { positions, meanColor: isColored ? [red!, green!, blue!] : undefined };
}

/** Any element but the vertices; its list `vertex_indices`, if it has one, is a face. */
function readFaces(
  { name, count, properties }: PlyElement,
  numbers: Numbers,
  positions: Float64Array,
  indices: number[],
): void {
  const known = positions.length / 3;
  const corners: number[] = [];
  for (let f = 0; f < count; f++)
    for (const property of properties) {
      const isFace = name === "face" && property.count !== undefined && /^vertex_ind(ex|ices)$/.test(property.name);
      const values = property.count === undefined ? 1 : length(numbers.next(property.count), numbers);
      if (isFace && (values < 3 || values > MAX_CORNERS))
        throw new Refusal(`Face ${f + 1} has ${values} corners; 3 to ${MAX_CORNERS} are read.`, numbers.where());
      corners.length = 0;
      for (let i = 0; i < values; i++) {
        const value = numbers.next(property.type);
        if (!isFace) continue;
        if (!Number.isInteger(value) || value < 0 || value >= known)
          throw new Refusal(
            `Face ${f + 1} names vertex ${value}; the file has ${known}, counted from 0.`,
            numbers.where(),
          );
        corners.push(value);
      }
      if (isFace) addPolygon(corners, positions, indices);
    }
}

function length(value: number, numbers: Numbers): number {
  if (!Number.isInteger(value) || value < 0) throw new Refusal(`A list cannot have ${value} entries.`, numbers.where());
  return value;
}

function binaryNumbers(bytes: Uint8Array, { end, encoding }: PlyHeader): Numbers {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const little = encoding === "binary_little_endian";
  let at = end;
  return {
    where: () => undefined,
    next(type) {
      const here = at;
      at += sizeOf(type);
      if (at > bytes.length) throw new Refusal(`The file ends after ${bytes.length} bytes, inside its data.`);
      switch (type) {
        case "int8":
          return view.getInt8(here);
        case "uint8":
          return view.getUint8(here);
        case "int16":
          return view.getInt16(here, little);
        case "uint16":
          return view.getUint16(here, little);
        case "int32":
          return view.getInt32(here, little);
        case "uint32":
          return view.getUint32(here, little);
        case "float32":
          return view.getFloat32(here, little);
        case "float64":
          return view.getFloat64(here, little);
      }
    },
  };
}

/** NaN and infinity are numbers here: their triangles are counted and left out later. */
function textNumbers(text: string, linesBefore: number): Numbers {
  const words = /\S+/g;
  let last = 0;
  const where = (): number => linesBefore + text.slice(0, last).split("\n").length;
  return {
    where,
    next() {
      const match = words.exec(text);
      if (!match) {
        last = text.length;
        throw new Refusal("The file ends inside its data.", where());
      }
      last = match.index;
      const value = Number(match[0]);
      if (Number.isNaN(value) && !/^[+-]?(nan|inf)/i.test(match[0]))
        throw new Refusal(`“${shorten(match[0])}” stands where a number is expected.`, where());
      return value;
    },
  };
}
