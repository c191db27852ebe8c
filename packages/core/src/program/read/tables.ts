import type { Pose } from "../../spatial/pose.ts";
import type { Group } from "../program.ts";
import { isFields, type Reader } from "../../json/reader.ts";

/** Named poses. Frame "world" and tool "flange" always exist; an entry of that name must not move them. */
export function readPoses<Into extends string, From extends string>(
  reader: Reader,
  value: unknown,
  path: string,
  noun: string,
  builtIn: string,
): Readonly<Record<string, Pose<Into, From>>> {
  if (value === undefined) return {};
  const fields = reader.object(value, path, `the table of ${noun}s`);
  if (fields === undefined) return {};
  const entries: [string, Pose<Into, From>][] = [];
  for (const [name, entry] of Object.entries(fields)) {
    const place = `${path}.${name}`;
    if (name === "") reader.fault(path, `A ${noun} has a name that is not empty.`);
    const pose = reader.pose<Into, From>(entry, place, `the pose of ${noun} “${name}”`);
    if (pose === undefined) continue;
    if (name === builtIn && (pose.position.some(x => x !== 0) || Math.abs(pose.quaternion[3]) !== 1)) {
      reader.fault(place, `The ${noun} “${builtIn}” always exists and cannot be moved; give yours another name.`);
    }
    entries.push([name, pose]);
  }
  return Object.fromEntries(entries);
}

/** Deeper recipes than this are refused: they would overflow the stack of whoever writes them out. */
const DEEPEST = 32;

export function readGroups(reader: Reader, value: unknown): Readonly<Record<string, Group>> {
  if (value === undefined) return {};
  const fields = reader.object(value, "groups", "the table of groups");
  if (fields === undefined) return {};
  const entries: [string, Group][] = [];
  for (const [id, entry] of Object.entries(fields)) {
    const path = `groups.${id}`;
    const what = `the group “${id}”`;
    const group = reader.object(entry, path, what);
    if (group === undefined) continue;
    reader.onlyKeys(group, path, what, ["name", "recipe"]);
    const name = reader.text(group.name, `${path}.name`, `the name of group “${id}”`) ?? "";
    if (group.recipe === undefined) {
      entries.push([id, { name }]);
      continue;
    }
    const recipe = reader.object(group.recipe, `${path}.recipe`, `the recipe of group “${id}”`);
    if (recipe === undefined) continue;
    const copy = plain(recipe, 0);
    if (isFields(copy)) entries.push([id, { name, recipe: copy }]);
    else
      reader.fault(
        `${path}.recipe`,
        `the recipe of group “${id}” holds only JSON with finite numbers, nested ${DEEPEST} deep at most.`,
      );
  }
  return Object.fromEntries(entries);
}

/** A deep copy of a JSON value, or undefined when some part of it is none. */
function plain(value: unknown, depth: number): unknown {
  if (value === null || typeof value === "string" || typeof value === "boolean") return value;
  if (typeof value === "number") return Number.isFinite(value) ? value : undefined;
  if (depth >= DEEPEST) return undefined;
  if (Array.isArray(value)) {
    const copies = value.map(part => plain(part, depth + 1));
    return copies.includes(undefined) ? undefined : copies;
  }
  if (!isFields(value)) return undefined;
  const copies = Object.entries(value).map(([key, part]): [string, unknown] => [key, plain(part, depth + 1)]);
  return copies.some(([, part]) => part === undefined) ? undefined : Object.fromEntries(copies);
}
