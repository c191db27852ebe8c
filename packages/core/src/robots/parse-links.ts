import type { Fields, Reader } from "../json/reader.ts";
import { decodeMesh } from "../mesh/codec.ts";
import type { TriangleMesh } from "../mesh/mesh.ts";
import type { LinkMass } from "../model/arm.ts";
import type { OwnLink, OwnPart } from "../model/form.ts";
import { placed } from "./parse-fields.ts";

const COLOR = /^#[0-9a-f]{6}$/i;

/**
 * `links` of a robot file: what is drawn of links 0 … n and what counts in collisions, meshes as saved cells hold them
 * (little-endian float32 positions [m] and uint32 indices in base64), each in the frame of its link.
 */
export function linksOf(reader: Reader, value: unknown, joints: number): readonly OwnLink[] | undefined {
  const list = reader.list(value, "links", "links");
  if (list === undefined) return undefined;
  if (list.length !== joints + 1)
    return reader.fault(
      "links",
      `a robot of ${joints} joints has ${joints + 1} links, the base first; here it has ${list.length}.`,
    );
  return list.map((each, i) => linkOf(reader, each, i));
}

function linkOf(reader: Reader, value: unknown, link: number): OwnLink {
  const path = `links[${link}]`;
  const what = `link ${link}`;
  const file = reader.object(value, path, what);
  if (file === undefined) return { parts: [] };
  reader.onlyKeys(file, path, what, ["parts", "solids"]);
  const meshes = (key: "parts" | "solids", known: readonly string[]): (OwnPart | undefined)[] =>
    (reader.list(file[key], `${path}.${key}`, `the ${key} of ${what}`) ?? []).map((each, i) => {
      const at = `${path}.${key}[${i}]`;
      const fields = reader.object(each, at, `a mesh of ${what}`);
      if (fields === undefined) return undefined;
      reader.onlyKeys(fields, at, `a mesh of ${what}`, known);
      return partOf(reader, fields, at, what);
    });
  const parts = meshes("parts", ["color", "positions", "indices"]).filter(part => part !== undefined);
  if (file.solids === undefined) return { parts };
  return { parts, solids: meshes("solids", ["positions", "indices"]).flatMap(part => part?.mesh ?? []) };
}

function partOf(reader: Reader, fields: Fields, path: string, what: string): OwnPart | undefined {
  const positions = reader.text(fields.positions, `${path}.positions`, `the positions of a mesh of ${what}`);
  const indices = reader.text(fields.indices, `${path}.indices`, `the indices of a mesh of ${what}`);
  const { color } = fields;
  if (color !== undefined && !(typeof color === "string" && COLOR.test(color)))
    reader.fault(`${path}.color`, `a colour is written #rrggbb; here it is ${reader.shown(color)}.`);
  if (positions === undefined || indices === undefined) return undefined;
  const decoded = decodeMesh({ positions, indices });
  if (decoded.kind === "not-a-mesh") return reader.fault(path, decoded.sentence);
  const mesh: TriangleMesh = decoded.mesh;
  return typeof color === "string" ? { color, mesh } : { mesh };
}

/** `masses` of a robot file: those of links 1 … n, with centre and inertia where they are known. */
export function massesIn(reader: Reader, value: unknown, joints: number): readonly LinkMass[] | undefined {
  const list = reader.list(value, "masses", "masses");
  if (list === undefined) return undefined;
  if (list.length !== joints)
    return reader.fault("masses", `a robot of ${joints} joints has ${joints} masses; here it has ${list.length}.`);
  return list.map((each, i) => massOf(reader, each, i));
}

function massOf(reader: Reader, value: unknown, index: number): LinkMass {
  const path = `masses[${index}]`;
  const what = `the mass of link ${index + 1}`;
  const file = reader.object(value, path, what);
  if (file === undefined) return { mass_kg: 0 };
  reader.onlyKeys(file, path, what, ["mass_kg", "centre", "inertia_kgm2"]);
  const mass_kg = reader.number(file.mass_kg, `${path}.mass_kg`, what, "kg") ?? 0;
  if (mass_kg < 0) reader.fault(`${path}.mass_kg`, `${what} is not below 0; here it is ${mass_kg}.`);
  const linkFromCentre =
    file.centre === undefined
      ? undefined
      : placed<"link", "centre">(reader, file.centre, `${path}.centre`, `the centre of link ${index + 1}`);
  const inertia =
    file.inertia_kgm2 === undefined
      ? undefined
      : reader.numbers(file.inertia_kgm2, `${path}.inertia_kgm2`, `the inertia of link ${index + 1}`, "kg m²", 6);
  return {
    mass_kg,
    ...(linkFromCentre === undefined ? {} : { linkFromCentre }),
    ...(inertia === undefined ? {} : { inertia_kgm2: inertia as [number, number, number, number, number, number] }),
  };
}
