import { meshBounds } from "@twincell/core";
import type { CellDocument, ObjectRecord } from "./document.ts";
import { shapeMesh } from "./mesh/shape.ts";

/** A model of a cell as a search sees it (row M-18): geometry, physical properties, behaviour and its source. */
export interface ModelFacts {
  readonly name: string;
  /** Role, shape, part of the library or file, in small letters. */
  readonly words: string;
  /** By the names that a query uses: lengths in mm, masses in kg, speeds in m/s. */
  readonly numbers: Readonly<Partial<Record<ModelNumber, number>>>;
}
export const MODEL_NUMBERS = [
  "length",
  "width",
  "height",
  "mass",
  "friction",
  "speed",
  "carries",
  "triangles",
] as const;
export type ModelNumber = (typeof MODEL_NUMBERS)[number];

const MM = 1000;

/** What can be asked of each object of a cell. */
export const modelsOf = ({ objects }: CellDocument): readonly ModelFacts[] => objects.map(factsOf);

function factsOf(object: ObjectRecord): ModelFacts {
  const { name, role, shape, mass_kg, friction, belt, carries_kg } = object;
  const mesh = shapeMesh(shape);
  const { lower, upper } = meshBounds(mesh);
  const side = (k: 0 | 1 | 2): number => Math.round((upper[k] - lower[k]) * MM * 10) / 10;
  const source = shape.kind === "mesh" ? shape.file : shape.kind === "part" ? shape.part : shape.kind;
  const numbers = {
    length: side(0),
    width: side(1),
    height: side(2),
    triangles: mesh.indices.length / 3,
    ...(mass_kg === undefined ? {} : { mass: mass_kg }),
    ...(friction === undefined ? {} : { friction }),
    ...(belt === undefined ? {} : { speed: Math.abs(belt.speed_mps) }),
    ...(carries_kg === undefined ? {} : { carries: carries_kg }),
  };
  return { name, words: `${name} ${role} ${source}`.toLowerCase(), numbers };
}

/** Words that a model has to have, and numbers it has to be above, below or equal to. */
export interface ModelQuery {
  readonly words: readonly string[];
  readonly conditions: readonly {
    readonly number: ModelNumber;
    readonly is: "<" | ">" | "=";
    readonly value: number;
  }[];
}

const CONDITION = /\b([a-z]+)\s*([<>=])\s*(-?\d+(?:[.,]\d+)?)\s*(?:mm|kg|m\/s)?/g;

/** `conveyor speed > 0.2` as a query; undefined where nothing is compared: then the names are searched as they are. */
export function modelQuery(text: string): ModelQuery | undefined {
  const conditions: ModelQuery["conditions"][number][] = [];
  const rest = text.toLowerCase().replaceAll(CONDITION, (whole: string, name: string, is: string, value: string) => {
    const number = MODEL_NUMBERS.find(each => each === name);
    if (number === undefined) return whole;
    conditions.push({ number, is: is as "<" | ">" | "=", value: Number(value.replace(",", ".")) });
    return " ";
  });
  if (conditions.length === 0) return undefined;
  return { words: rest.split(/\s+/).filter(word => word !== ""), conditions };
}

/** Whether a model has all words and numbers of a query. One that does not say a number does not fit. */
export const fitsQuery = ({ words, numbers }: ModelFacts, query: ModelQuery): boolean =>
  query.words.every(word => words.includes(word)) &&
  query.conditions.every(({ number, is, value }) => {
    const own = numbers[number];
    if (own === undefined) return false;
    return is === "<" ? own < value : is === ">" ? own > value : Math.abs(own - value) <= 1e-9 * Math.abs(value);
  });
