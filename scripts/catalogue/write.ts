/**
 * Writes packages/core/src/robots/catalogue/MAKER.ts from public robot descriptions: node scripts/catalogue/write.ts
 * FOLDER
 *
 * FOLDER holds checkouts of the repositories of descriptions.json, each as OWNER+NAME; they are not part of this
 * repository. Two of them need a package of a sister repository beside their own: abb_resources (ros-industrial/abb) in
 * ros-industrial+abb_experimental, staubli_resources (ros-industrial/staubli) in ros-industrial+staubli_experimental.
 * Only numbers are taken: places and axes of joints, limits, speeds. `witness.py` beside this file reads the same
 * descriptions with other programs and writes the fixture that the tests hold the data against.
 */
import { existsSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import {
  alignedWithBase,
  compose,
  degrees,
  fromEulerAngles,
  inverse,
  toEulerAngles,
  toMatrix,
  type Pose,
  type Quaternion,
  type SerialArm,
  type Vector3,
} from "@twincell/core";
import { armFromUrdf, readRobot, type UrdfChain, type UrdfRobot } from "@twincell/formats";

interface Description {
  readonly id: string;
  readonly name: string;
  readonly vendor: string;
  readonly repository: string;
  readonly path: string;
  readonly args?: Readonly<Record<string, string>>;
  readonly base?: string;
  readonly tip?: string;
  readonly world?: string;
  readonly home_deg?: readonly number[];
  /** `Payload` of the catalogue. */
  readonly payload?: { readonly kg: number; readonly from: string };
  /** What the maker's controllers need: `SectionData`. */
  readonly section?: unknown;
  /** Where witness.py cannot compute it. */
  readonly unverified?: true;
}
interface Listing {
  readonly repositories: Readonly<Record<string, { readonly licence: string; readonly commit: string }>>;
  readonly robots: readonly Description[];
}

/** Angles of a description this close to a multiple of 90° stand for it: 1.5708, 1.57 [rad]. */
const QUARTER_SLACK_RAD = 1e-3;
/** Limits this close to a tenth of a degree stand for it: 2.9671 rad is 170° [deg]. */
const LIMIT_SLACK_DEG = 0.02;
/** Lengths and angles below this are what rounding left of 0 [m, °]. */
const NOTHING = 5e-10;
const OUT = new URL("../../packages/core/src/robots/catalogue/", import.meta.url);

const disk = {
  read: (path: string): Uint8Array | undefined =>
    existsSync(path) && statSync(path).isFile() ? readFileSync(path) : undefined,
  list: (folder: string): readonly string[] | undefined =>
    existsSync(folder) && statSync(folder).isDirectory() ? readdirSync(folder) : undefined,
};

function quarter(angle_rad: number): number {
  const whole = Math.round(angle_rad / (Math.PI / 2)) * (Math.PI / 2);
  return Math.abs(angle_rad - whole) < QUARTER_SLACK_RAD ? whole : angle_rad;
}

/** A turn with rounded right angles made exact. */
function exact(turn: Quaternion): Quaternion {
  const matrix = [...toMatrix(turn)];
  const whole = matrix.map(value => Math.round(value));
  if (matrix.every((value, i) => Math.abs(value - whole[i]!) < QUARTER_SLACK_RAD)) return fromWhole(whole);
  const [yaw, pitch, roll] = toEulerAngles("zyx", turn);
  return fromEulerAngles("zyx", quarter(yaw), quarter(pitch), quarter(roll));
}

/** Of the 24 turns by right angles the one whose matrix that is. */
function fromWhole(matrix: readonly number[]): Quaternion {
  const angles = [0, 1, 2, 3].map(n => (n * Math.PI) / 2);
  for (const a of angles)
    for (const b of angles)
      for (const c of angles) {
        const turn = fromEulerAngles("zyx", a, b, c);
        if ([...toMatrix(turn)].every((value, i) => Math.abs(value - matrix[i]!) < 1e-9)) return turn;
      }
  throw new Error(`no turn by right angles: ${matrix.join(" ")}`);
}

const exactRobot = (robot: UrdfRobot): UrdfRobot => ({
  ...robot,
  joints: robot.joints.map(joint => ({
    ...joint,
    parentFromJoint: { ...joint.parentFromJoint, quaternion: exact(joint.parentFromJoint.quaternion) },
  })),
});

function chainOf(robot: UrdfRobot, { id, tip }: Description, base: string | undefined): UrdfChain {
  const chain = armFromUrdf(robot, base, tip);
  if (chain.kind !== "chain") throw new Error(`${id}: ${chain.sentence}`);
  return chain;
}

const number = (value: number, digits = 11): string =>
  Math.abs(value) < NOTHING ? "0" : String(Number(value.toFixed(digits)));

function limit(angle_rad: number): string {
  const angle = degrees(angle_rad);
  const tenth = Math.round(10 * angle) / 10;
  return number(Math.abs(angle - tenth) < LIMIT_SLACK_DEG ? tenth : angle, 4);
}

function axisText(axis: Vector3): string {
  const whole = axis.map(value => Math.round(value));
  const along = whole.findIndex(value => value !== 0);
  const isWhole = axis.every((value, i) => Math.abs(value - whole[i]!) < 1e-9);
  return isWhole ? `${whole[along]! < 0 ? "-" : ""}${"xyz"[along]}` : axis.map(value => number(value, 15)).join(",");
}

function placeText({ position, quaternion }: Pose): string {
  const [yaw, pitch, roll] = toEulerAngles("zyx", quaternion);
  const turns = [roll, pitch, yaw].map(turn => number(degrees(turn), 10));
  return [...position.map(value => number(value)), ...turns].join(" ");
}

function table(arm: SerialArm, baseFromWorld: Pose | undefined): string {
  const { joints, lastJointFromFlange } = alignedWithBase(arm);
  const lines = joints.map(({ name, parentFromJoint: { position }, axis, limits }) =>
    [
      name,
      ...position.map(value => number(value)),
      axisText(axis),
      limit(limits.lower_rad),
      limit(limits.upper_rad),
      limit(limits.speed_rad_s),
    ].join(" "),
  );
  lines.push(`flange ${placeText(lastJointFromFlange as Pose)}`);
  const world = baseFromWorld && placeText(baseFromWorld);
  if (world !== undefined && world !== "0 0 0 0 0 0") lines.push(`world ${world}`);
  return lines.join("\n");
}

/** A value of JSON as these files write it. */
function literal(value: unknown): string {
  if (Array.isArray(value)) return `[${value.map(literal).join(", ")}]`;
  if (value !== null && typeof value === "object")
    return `{ ${Object.entries(value)
      .map(([key, each]) => `${key}: ${literal(each)}`)
      .join(", ")} }`;
  return JSON.stringify(value);
}

/** Names of base and tip of every arm that was written, for the witness. */
const framesOf = new Map<string, readonly [base: string, tip: string]>();

function entryOf(description: Description, folder: string): string {
  const { id, name, repository, path, args, base, world = "base" } = description;
  const read = readRobot(join(folder, repository.replace("/", "+"), path), disk, args === undefined ? {} : { args });
  if (read.kind !== "read") throw new Error(`${id}: ${read.sentence}`);
  const robot = exactRobot(read.robot);
  const chain = chainOf(robot, description, base);
  framesOf.set(id, [chain.base, chain.tip]);
  const hasWorld = world !== chain.base && robot.links.some(link => link.name === world);
  const baseFromWorld = hasWorld
    ? compose(
        chain.arm.joints[0]!.parentFromJoint as Pose,
        inverse(chainOf(robot, description, world).arm.joints[0]!.parentFromJoint as Pose),
      )
    : undefined;
  const { home_deg, unverified, section, payload } = description;
  const given = Object.entries(args ?? {}).map(([key, value]) => ` ${key}:=${value}`);
  return [
    "  {",
    `    id: ${JSON.stringify(id)},`,
    `    name: ${JSON.stringify(name)},`,
    ...(payload === undefined ? [] : [`    payload: ${literal(payload)},`]),
    ...(home_deg === undefined ? [] : [`    home_deg: [${home_deg.join(", ")}],`]),
    ...(unverified === undefined ? [] : ["    unverified: true,"]),
    `    frames: [${JSON.stringify(chain.base)}, ${JSON.stringify(chain.tip)}],`,
    `    repository: ${JSON.stringify(repository)},`,
    `    path: ${JSON.stringify(`${path}${given.join("")}`)},`,
    ...(section === undefined ? [] : [`    section: ${literal(section)},`]),
    `    table: \`\n${table(chain.arm, baseFromWorld)}\`,`,
    "  },",
  ].join("\n");
}

/** "Universal Robots" → universal-robots, UNIVERSAL_ROBOTS. */
const fileName = (vendor: string): string =>
  vendor
    .normalize("NFD")
    .replace(/[^A-Za-z ]/g, "")
    .toLowerCase()
    .replaceAll(" ", "-");
const constant = (vendor: string): string => fileName(vendor).toUpperCase().replaceAll("-", "_");

const folder = process.argv[2];
if (folder === undefined || !existsSync(folder)) {
  process.stderr.write("write.ts: the folder with the checkouts of descriptions.json is missing.\n");
  process.exit(2);
}
const { repositories, robots } = JSON.parse(
  readFileSync(new URL("descriptions.json", import.meta.url), "utf8"),
) as Listing;
for (const vendor of new Set(robots.map(each => each.vendor))) {
  const entries: string[] = [];
  for (const robot of robots.filter(each => each.vendor === vendor)) {
    try {
      entries.push(entryOf(robot, folder));
    } catch (cause) {
      const why = cause instanceof Error ? cause.message : String(cause);
      process.stderr.write(`write.ts: ${robot.id} is left out: ${why}\n`);
      process.exitCode = 1;
    }
  }
  const text = `// Written by scripts/catalogue/write.ts from public descriptions; do not edit.
import type { CatalogueMaker } from "./entry.ts";

export const ${constant(vendor)}: CatalogueMaker = {
  vendor: ${JSON.stringify(vendor)},
  robots: [
${entries.join("\n")}
  ],
};
`;
  writeFileSync(new URL(`${fileName(vendor)}.ts`, OUT), text);
}
const used = Object.entries(repositories).filter(([name]) => robots.some(({ repository }) => repository === name));
const lines = used.map(
  ([name, { licence, commit }]) =>
    `  ${JSON.stringify(name)}: ${JSON.stringify(`${licence}, commit ${commit.slice(0, 7)}`)},`,
);
writeFileSync(
  new URL("repositories.ts", OUT),
  `// Written by scripts/catalogue/write.ts; do not edit.

/** Repository of robot descriptions → its licence and the commit that was read. */
export const REPOSITORIES: Readonly<Record<string, string>> = {
${lines.join("\n")}
};
`,
);
writeFileSync(new URL("frames.json", import.meta.url), `${JSON.stringify(Object.fromEntries(framesOf), null, 1)}\n`);
