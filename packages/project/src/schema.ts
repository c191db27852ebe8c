import { z } from "zod";
import { decodeMesh, ROBOT_FORMAT, type Pose } from "@twincell/core";
import { partById } from "./parts/index.ts";
import { TEXT_PROGRAM_FORMAT } from "./text-program.ts";

/** How far a quaternion's length may be from 1 before it is taken for a mistake instead of rounding. */
const UNIT_TOLERANCE = 1e-3;

const number = z.number();
const length_m = z.number().positive();
const text = z.string().min(1);

const quaternion = z
  .tuple([number, number, number, number])
  .transform((q, context): [number, number, number, number] => {
    const size = Math.hypot(...q);
    if (!(Math.abs(size - 1) <= UNIT_TOLERANCE)) {
      context.addIssue({
        code: "custom",
        message: `the length of a quaternion is 1, this one's is ${size.toPrecision(4)}`,
      });
      return z.NEVER;
    }
    // A quaternion that is exact to rounding is kept bit for bit, so that open and save do not make it drift.
    return Math.abs(size - 1) <= 1e-12 ? q : [q[0] / size, q[1] / size, q[2] / size, q[3] / size];
  });

/** The frames of a pose are known from where it stands in the file. */
const poseOf = <Into extends string, From extends string>() =>
  z
    .strictObject({ position: z.tuple([number, number, number]), quaternion })
    .transform((pose): Pose<Into, From> => pose);

const shape = z.discriminatedUnion("kind", [
  z.strictObject({ kind: z.literal("box"), size_m: z.tuple([length_m, length_m, length_m]) }),
  z.strictObject({ kind: z.literal("cylinder"), radius_m: length_m, height_m: length_m }),
  z.strictObject({
    kind: z.literal("revolved"),
    profile_m: z.array(z.tuple([z.number().nonnegative(), number])).min(2),
  }),
  z
    .strictObject({ kind: z.literal("part"), part: text, parameters: z.record(text, number) })
    .superRefine((part, context) => {
      const kind = partById(part.part);
      if (kind === undefined)
        context.addIssue({
          code: "custom",
          path: ["part"],
          message: `the library has no part ${JSON.stringify(part.part)}`,
        });
      for (const { id, min, max } of kind?.parameters ?? []) {
        const value = part.parameters[id];
        if (value !== undefined && !(value >= min && value <= max))
          context.addIssue({
            code: "custom",
            path: ["parameters", id],
            message: `${value} is not between ${min} and ${max}`,
          });
      }
    }),
  z
    .strictObject({ kind: z.literal("mesh"), file: z.string(), positions: z.string(), indices: z.string() })
    .superRefine((mesh, context) => {
      const decoded = decodeMesh(mesh);
      if (decoded.kind === "not-a-mesh") context.addIssue({ code: "custom", message: decoded.sentence });
    }),
]);

const point = z.tuple([number, number, number]);
const floor = z.array(z.tuple([number, number]));
const belt = z.strictObject({
  direction: point,
  speed_mps: number,
  runs: z.exactOptional(z.strictObject({ signal: text, is: z.boolean() })),
});
const gripper = z.strictObject({
  open_m: length_m,
  closed_m: z.number().nonnegative(),
  force_N: z.number().positive(),
  finger_m: z.tuple([length_m, length_m, length_m]),
  beyond_m: z.number().nonnegative(),
  speed_mps: z.number().positive(),
  friction: z.number().nonnegative().max(10),
  mass_kg: z.number().positive(),
});
const sensed = {
  id: text,
  name: text,
  signal: text,
  sees: z.array(z.enum(["part", "robot", "person"])),
  stops: z.exactOptional(z.literal(true)),
};
const sensor = z.discriminatedUnion("kind", [
  z.strictObject({ ...sensed, kind: z.literal("beam"), from_m: point, to_m: point }),
  z.strictObject({ ...sensed, kind: z.literal("proximity"), at_m: point, range_m: length_m }),
]);
const person = z.strictObject({
  id: text,
  name: text,
  path_m: floor.min(1),
  speed_mps: z.number().nonnegative(),
  starts_s: z.number().nonnegative(),
  height_m: length_m,
});
const zone = z.strictObject({
  id: text,
  name: text,
  outline_m: floor.min(3),
  reaction: z.discriminatedUnion("kind", [
    z.strictObject({ kind: z.literal("slow"), override: z.number().positive().max(1) }),
    z.strictObject({ kind: z.literal("stop") }),
  ]),
});

const yes = z.exactOptional(z.literal(true));

/** Of a file that is not UTF-8 each character is a byte. */
const textFile = z
  .strictObject({ name: text, encoding: z.exactOptional(z.enum(["utf-8", "latin-1", "shift-jis"])), text: z.string() })
  .superRefine(({ encoding = "utf-8", text: content }, context) => {
    const wrong = encoding === "utf-8" ? content.search(/\p{Surrogate}/u) : content.search(/[^\u0000-\u00ff]/u);
    if (wrong >= 0)
      context.addIssue({
        code: "custom",
        message: `character ${wrong + 1} of the text is no ${encoding === "utf-8" ? "character of UTF-8" : "byte (U+0000 … U+00FF)"}`,
      });
  });

/** A vendor's program, kept as its files. */
export const textProgramSchema = z
  .strictObject({
    format: z.literal(TEXT_PROGRAM_FORMAT),
    version: z.literal(1),
    name: text,
    robot: text,
    language: text,
    main: text,
    files: z.array(textFile).min(1),
  })
  .superRefine(({ main, files }, context) => {
    const names = files.map(file => file.name);
    if (!names.includes(main))
      context.addIssue({
        code: "custom",
        path: ["main"],
        message: `the program has no file called ${JSON.stringify(main)}`,
      });
    for (const [i, name] of names.entries())
      if (names.indexOf(name) < i)
        context.addIssue({
          code: "custom",
          path: ["files", i, "name"],
          message: `${JSON.stringify(name)} is already the name of another file`,
        });
  });

/** More than half a metre is no error of a measurement. */
const error_m = z.exactOptional(z.number().nonnegative().max(0.5));

/**
 * The newest version of the cell file; docs/cell.schema.json is printed from it. Each program in it is read on its own:
 * steps by core's `parseProgram`.
 */
export const cellSchema = z.strictObject({
  format: z.literal("twincell.cell"),
  version: z.literal(2),
  name: z.string(),
  training: yes,
  robot: z.strictObject({
    id: text,
    worldFromBase: poseOf<"world", "base">(),
    /** A robot that is in no library, as its robot file (docs/robot.schema.json). */
    file: z.exactOptional(z.looseObject({ format: z.literal(ROBOT_FORMAT), id: text })),
  }),
  errors: z.exactOptional(z.strictObject({ registration_m: error_m, twin_m: error_m })),
  tools: z.array(
    z.strictObject({
      name: text,
      flangeFromTcp: poseOf<"flange", "tcp">(),
      shape: z.exactOptional(shape),
      mass_kg: z.exactOptional(z.number().positive()),
      gripper: z.exactOptional(gripper),
    }),
  ),
  tool: text,
  objects: z.array(
    z.strictObject({
      id: text,
      name: text,
      role: z.enum(["workpiece", "fixture", "furniture", "wall"]),
      worldFromObject: poseOf<"world", "object">(),
      shape,
      color: z.string().regex(/^#[0-9a-f]{6}$/i, "a colour is written #rrggbb"),
      carries_kg: z.exactOptional(z.number().positive()),
      mass_kg: z.exactOptional(z.number().positive()),
      friction: z.exactOptional(z.number().nonnegative().max(10)),
      softness_s: z.exactOptional(z.number().positive()),
      belt: z.exactOptional(belt),
      group: z.exactOptional(text),
      hidden: yes,
      locked: yes,
    }),
  ),
  frames: z.array(
    z.strictObject({
      name: text,
      worldFromFrame: poseOf<"world", "frame">(),
      saved: yes,
      attachedTo: z.exactOptional(z.strictObject({ object: text, objectFromFrame: poseOf<"object", "frame">() })),
      hidden: yes,
      locked: yes,
    }),
  ),
  allowedPairs: z.array(z.tuple([text, text])),
  sensors: z.exactOptional(z.array(sensor)),
  people: z.exactOptional(z.array(person)),
  zones: z.exactOptional(z.array(zone)),
  pairs: z.exactOptional(
    z.strictObject({
      robot: text,
      tool: text,
      seed: number,
      entries: z
        .array(
          z.strictObject({
            a: text,
            b: text,
            reason: z.enum(["adjacent", "always", "at home", "allowed", "sometimes", "never seen"]),
            samples: z.number().nonnegative(),
            touches: z.number().nonnegative(),
            watched: z.boolean(),
          }),
        )
        .max(1000),
    }),
  ),
  programs: z.array(z.unknown()),
  /** What people say about steps, which they name by program and id. */
  comments: z.exactOptional(
    z
      .array(
        z.strictObject({
          id: text,
          program: text,
          step: text,
          who: z.string().max(80),
          at: z.iso.datetime(),
          text: text.max(2000),
          done: yes,
        }),
      )
      .max(10_000),
  ),
  program: z.string(),
});
