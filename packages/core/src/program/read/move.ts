import type { Branch } from "../../kinematics/branch.ts";
import type { MoveStep, Search, Speed, Target } from "../program.ts";
import { readCondition } from "./condition.ts";
import { keys, type Fields, type Reader } from "../../json/reader.ts";
import type { ProgramScope } from "./scope.ts";

const PATHS = ["ptp", "lin", "circ", "spline"] as const;

/** The fields of a move step, apart from those that every step has. */
export function readMove(
  reader: Reader,
  fields: Fields,
  path: string,
  what: string,
  around: ProgramScope,
): Omit<MoveStep, "id" | "name" | "group"> | undefined {
  reader.onlyKeys(
    fields,
    path,
    what,
    keys<MoveStep>()(
      "id",
      "type",
      "name",
      "group",
      "path",
      "target",
      "via",
      "speed",
      "acceleration",
      "blend_m",
      "blend_ratio",
      "until",
    ),
  );
  const kind = PATHS.find(known => known === fields.path);
  if (kind === undefined)
    reader.fault(
      `${path}.path`,
      `${what} moves along ${reader.shown(fields.path)}; a path is one of ${PATHS.join(", ")}.`,
    );
  const target = readTarget(reader, fields.target, `${path}.target`, `the target of ${what}`, around);
  const via =
    fields.via === undefined
      ? undefined
      : readTarget(reader, fields.via, `${path}.via`, `the via point of ${what}`, around);
  if (kind === "circ" && fields.via === undefined)
    reader.fault(`${path}.via`, `${what} is a circular move and names no point to pass through.`);
  if (kind !== undefined && kind !== "circ" && fields.via !== undefined)
    reader.fault(`${path}.via`, `${what} is a ${kind} move; only a circ passes through a via point.`);
  const speed = readSpeed(reader, fields.speed, `${path}.speed`, what);
  const blend_m =
    fields.blend_m === undefined ? 0 : reader.number(fields.blend_m, `${path}.blend_m`, `the blend of ${what}`, "m");
  if (blend_m !== undefined && blend_m < 0)
    reader.fault(`${path}.blend_m`, `${what} blends by ${blend_m} m; a blend is 0 m or more.`);
  const zone =
    fields.blend_ratio === undefined
      ? {}
      : readZone(reader, fields.blend_ratio, `${path}.blend_ratio`, what, blend_m ?? 0);
  const acceleration =
    fields.acceleration === undefined
      ? {}
      : readAcceleration(reader, fields.acceleration, `${path}.acceleration`, what);
  const until = fields.until === undefined ? {} : readSearch(reader, fields.until, `${path}.until`, what);
  if (kind === undefined || target === undefined || speed === undefined || blend_m === undefined) return undefined;
  return {
    type: "move",
    path: kind,
    target,
    ...(via === undefined ? {} : { via }),
    speed,
    ...acceleration,
    blend_m,
    ...zone,
    ...until,
  };
}

function readZone(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
  blend_m: number,
): Pick<MoveStep, "blend_ratio"> {
  const blend_ratio = reader.number(value, path, `the blend ratio of ${what}`, "");
  if (blend_ratio === undefined) return {};
  if (blend_ratio < 0 || blend_ratio > 1)
    reader.fault(path, `the blend ratio of ${what} is from 0 to 1; here it is ${blend_ratio}.`);
  if (blend_ratio !== 0 && blend_m !== 0)
    reader.fault(path, `${what} blends by ${blend_m} m and by a ratio of ${blend_ratio}; only one of them is not 0.`);
  return { blend_ratio };
}

function readAcceleration(reader: Reader, value: unknown, path: string, what: string): Pick<MoveStep, "acceleration"> {
  const fields = reader.object(value, path, `the acceleration of ${what}`);
  if (fields === undefined) return {};
  reader.onlyKeys(fields, path, `the acceleration of ${what}`, ["ratio"]);
  const ratio = reader.number(fields.ratio, `${path}.ratio`, `the acceleration of ${what}`, "");
  if (ratio === undefined) return {};
  if (!(ratio > 0 && ratio <= 1))
    reader.fault(
      `${path}.ratio`,
      `the acceleration of ${what} is a ratio above 0 and up to 1 of the joint accelerations; here it is ${ratio}.`,
    );
  return { acceleration: { ratio } };
}

function readSearch(reader: Reader, value: unknown, path: string, what: string): Pick<MoveStep, "until"> {
  const fields = reader.object(value, path, `the search of ${what}`);
  if (fields === undefined) return {};
  reader.onlyKeys(fields, path, `the search of ${what}`, keys<Search>()("when", "missing"));
  const when = readCondition(reader, fields.when, `${path}.when`, `the search of ${what}`);
  const { missing = "fault" } = fields;
  if (missing !== "continue" && missing !== "fault")
    reader.fault(
      `${path}.missing`,
      `what the search of ${what} does when it finds nothing is "continue" or "fault"; here it is ${reader.shown(missing)}.`,
    );
  else if (when !== undefined) return { until: { when, missing } };
  return {};
}

function readTarget(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
  around: ProgramScope,
): Target | undefined {
  const fields = reader.object(value, path, what);
  if (fields === undefined) return undefined;
  if ("q" in fields === "pose" in fields) return reader.fault(path, `${what} has either joint angles “q” or a “pose”.`);
  if ("q" in fields) {
    reader.onlyKeys(fields, path, what, ["q", "tool"]);
    const q = readJoints(reader, fields.q, `${path}.q`, what, around);
    const tool =
      fields.tool === undefined
        ? {}
        : { tool: known(reader, fields.tool, `${path}.tool`, what, "tool", around.tools, "flange") };
    return q === undefined ? undefined : { q, ...tool };
  }
  reader.onlyKeys(fields, path, what, ["pose", "frame", "tool", "branch"]);
  const pose = reader.pose<"frame", "tcp">(fields.pose, `${path}.pose`, what);
  const frame = fields.frame === undefined ? "world" : readFrame(reader, fields.frame, `${path}.frame`, what, around);
  const tool =
    fields.tool === undefined
      ? "flange"
      : known(reader, fields.tool, `${path}.tool`, what, "tool", around.tools, "flange");
  const branch = fields.branch === undefined ? undefined : readBranch(reader, fields.branch, `${path}.branch`, what);
  return pose === undefined ? undefined : { pose, frame, tool, ...(branch === undefined ? {} : { branch }) };
}

/** A frame of the program, or the place being visited when the target stands inside that pallet's step. */
function readFrame(reader: Reader, value: unknown, path: string, what: string, around: ProgramScope): string {
  if (typeof value !== "string" || !Object.hasOwn(around.pallets, value))
    return known(reader, value, path, what, "frame", around.frames, "world");
  if (!around.open.includes(value))
    reader.fault(
      path,
      `${what} names the pallet “${value}” as its frame; that means a place only inside a pallet step of “${value}”.`,
    );
  return value;
}

function readJoints(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
  around: ProgramScope,
): number[] | undefined {
  const q = reader.numbers(value, path, `the list of joint angles of ${what}`, "rad", undefined);
  if (q === undefined) return undefined;
  if (q.length === 0) return reader.fault(path, `${what} has no joint angles.`);
  if (around.joints !== undefined && q.length !== around.joints) {
    return reader.fault(path, `${what} has ${q.length} joint angles; ${around.robot} has ${around.joints} joints.`);
  }
  return q;
}

function known(
  reader: Reader,
  value: unknown,
  path: string,
  what: string,
  noun: string,
  table: Readonly<Record<string, unknown>>,
  builtIn: string,
): string {
  const name = reader.name(value, path, `the ${noun} of ${what}`) ?? builtIn;
  if (name !== builtIn && !Object.hasOwn(table, name)) {
    reader.fault(
      path,
      `${what} names the ${noun} “${name}”, which the program does not have; it has ${[builtIn, ...Object.keys(table)].join(", ")}.`,
    );
  }
  return name;
}

function readBranch(reader: Reader, value: unknown, path: string, what: string): Branch | undefined {
  const fields = reader.object(value, path, `the branch of ${what}`);
  if (fields === undefined) return undefined;
  reader.onlyKeys(
    fields,
    path,
    `the branch of ${what}`,
    keys<Branch>()("shoulder", "elbow", "wrist", "determinant", "elbow_rad"),
  );
  const oneOf = <T extends string>(key: keyof Branch, a: T, b: T): T | undefined => {
    const word = fields[key];
    return word === a
      ? a
      : word === b
        ? b
        : reader.fault(
            `${path}.${key}`,
            `the ${key} of ${what} is "${a}" or "${b}"; here it is ${reader.shown(word)}.`,
          );
  };
  const shoulder = oneOf("shoulder", "front", "back");
  const elbow = oneOf("elbow", "up", "down");
  const wrist = oneOf("wrist", "positive", "negative");
  const determinant = fields.determinant === undefined ? undefined : oneOf("determinant", "positive", "negative");
  const elbow_rad =
    fields.elbow_rad === undefined
      ? undefined
      : reader.number(fields.elbow_rad, `${path}.elbow_rad`, `the elbow angle of ${what}`, "rad");
  if (shoulder === undefined || elbow === undefined || wrist === undefined) return undefined;
  return {
    shoulder,
    elbow,
    wrist,
    ...(determinant === undefined ? {} : { determinant }),
    ...(elbow_rad === undefined ? {} : { elbow_rad }),
  };
}

function readSpeed(reader: Reader, value: unknown, path: string, what: string): Speed | undefined {
  if (value === undefined) return reader.fault(path, `${what} has no speed; give it a ratio, mps or time_s.`);
  const fields = reader.object(value, path, `the speed of ${what}`);
  if (fields === undefined) return undefined;
  reader.onlyKeys(fields, path, `the speed of ${what}`, ["ratio", "mps", "time_s"]);
  const given = (["ratio", "mps", "time_s"] as const).filter(key => fields[key] !== undefined);
  const key = given[0];
  if (given.length !== 1 || key === undefined)
    return reader.fault(
      path,
      `the speed of ${what} is exactly one of ratio, mps and time_s; here are ${given.length} of them.`,
    );
  const unit = key === "ratio" ? "" : key === "mps" ? "m/s" : "s";
  const number = reader.number(fields[key], `${path}.${key}`, `the speed of ${what}`, unit);
  if (number === undefined) return undefined;
  if (number <= 0)
    return reader.fault(
      `${path}.${key}`,
      `the speed of ${what} is more than 0${unit === "" ? "" : ` ${unit}`}; here it is ${number}.`,
    );
  switch (key) {
    case "ratio":
      return number <= 1
        ? { ratio: number }
        : reader.fault(
            `${path}.ratio`,
            `the speed of ${what} is a ratio from 0 to 1 of full joint speed; here it is ${number}.`,
          );
    case "mps":
      return { mps: number };
    case "time_s":
      return { time_s: number };
  }
}
