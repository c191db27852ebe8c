import fc from "fast-check";
import { describe, expect, test } from "vitest";
import {
  boxMesh,
  checkProgram,
  emptyProgram,
  fromAxisAngle,
  identity,
  linkSolids,
  pose,
  readCertificate,
  robotById,
  verifyProgram,
  writeCertificate,
  type CellGeometry,
  type MoveStep,
  type Program,
  type ProgramCertificate,
  type Vector3,
} from "../index.ts";

const robot = robotById("staubli_rx90l")!;
const post = (position: Vector3): CellGeometry["objects"][number] => ({
  id: "post",
  name: "Post",
  worldFromObject: pose(position),
  mesh: boxMesh([0.04, 0.04, 0.5]),
});
const cellWith = (position: Vector3): CellGeometry => ({
  worldFromBase: identity(),
  links: linkSolids(robot),
  allowedPairs: [],
  shapeError_m: 0.01,
  tool: { name: "torch", mesh: boxMesh([0.02, 0.02, 0.28]) },
  objects: [post(position)],
});
const CELL = cellWith([0.9, 0, 0.25]);
const move = (id: string, path: MoveStep["path"], position: Vector3): MoveStep => ({
  id,
  type: "move",
  path,
  target: { pose: { position, quaternion: fromAxisAngle([1, 0, 0], Math.PI) }, frame: "world", tool: "flange" },
  speed: path === "ptp" ? { ratio: 0.5 } : { mps: 0.2 },
  blend_m: 0,
});
const program: Program = {
  ...emptyProgram(robot.id, "Past the post"),
  steps: [move("a", "ptp", [0.55, 0.2, 0.5]), move("b", "lin", [0.55, -0.2, 0.5]), move("c", "lin", [0.5, -0.2, 0.6])],
};
const checked = checkProgram(program, robot, { cell: CELL, margin_m: 0.002, certify: true });
const certificate = checked.certificate!;
const verify = (claimed: ProgramCertificate, cell = CELL, plan = checked.plan): ReturnType<typeof verifyProgram> =>
  verifyProgram(claimed, program, plan, robot, cell);

describe("M-49 a program carries what proves it clear", () => {
  test("one certificate for each motion, confirmed by the second proof, and the same verdict as without", () => {
    expect(checked.verdict).toEqual(checkProgram(program, robot, { cell: CELL, margin_m: 0.002 }).verdict);
    expect(checked.verdict.ok).toBe(true);
    expect(certificate.segments.map(({ step }) => step)).toEqual(["a", "b", "c"]);
    expect(certificate.segments.every(({ clearance_m, pieces }) => clearance_m >= 0 && pieces.length > 10)).toBe(true);
    expect(verify(certificate)).toMatchObject({ kind: "confirmed", segments: 3 });
  });

  test("it is refuted in a cell where the post stands nearer, when a claim is raised, and when a stretch is left out", () => {
    expect(verify(certificate, cellWith([0.62, 0, 0.45]))).toMatchObject({ kind: "refuted", b: "post" });
    const changed = (
      change: (segment: ProgramCertificate["segments"][number]) => Partial<ProgramCertificate["segments"][number]>,
    ): ProgramCertificate => ({
      ...certificate,
      segments: certificate.segments.map((segment, i) => (i === 1 ? { ...segment, ...change(segment) } : segment)),
    });
    expect(
      verify(
        changed(({ pieces }) => ({
          pieces: pieces.map(piece => (piece.b === "post" ? { ...piece, atLeast_m: piece.atLeast_m + 1 } : piece)),
        })),
      ),
    ).toMatchObject({ kind: "refuted", step: "b", reason: "too near" });
    expect(
      verify(changed(({ pieces }) => ({ pieces: pieces.filter(piece => piece.b !== "post" || piece.from > 0.5) }))),
    ).toMatchObject({ kind: "refuted", step: "b", reason: "gap", b: "post" });
    expect(verify({ ...certificate, margin_m: 0.5 })).toMatchObject({ kind: "refuted", reason: "below margin" });
    expect(verify({ ...certificate, segments: certificate.segments.slice(1) })).toEqual({
      kind: "missing",
      step: "a",
      start_s: 0,
    });
  });

  test("it does not fit another program", () => {
    const other = checkProgram(
      { ...program, steps: [program.steps[0]!, move("b", "lin", [0.55, -0.25, 0.5]), program.steps[2]!] },
      robot,
      { cell: CELL },
    ).plan;
    expect(verify(certificate, CELL, other).kind).not.toBe("confirmed");
  });

  test("a motion in contact has none", () => {
    const blocked = checkProgram(program, robot, { cell: cellWith([0.55, 0, 0.4]), certify: true });
    expect(blocked.certificate!.segments.map(({ step }) => step)).toEqual(["a", "c"]);
  });
});

describe("a certificate as a file", () => {
  const text = writeCertificate(certificate);

  test("reads back as it was written, and holds", () => {
    const read = readCertificate(text);
    if (read.kind !== "certificate") throw new Error(read.sentence);
    expect(read.certificate).toEqual(certificate);
    expect(verify(read.certificate).kind).toBe("confirmed");
  });

  test("what is none says where", () => {
    const why = (changed: string): string => {
      const read = readCertificate(changed);
      return read.kind === "certificate" ? "read" : read.sentence;
    };
    expect(why("{")).toBe("The file is not JSON.");
    expect(why("[]")).toMatch(/format/);
    expect(why(text.replace('"version":1', '"version":2'))).toMatch(/^version: /);
    expect(why(text.replace('"margin_m":0.002', '"margin_m":-1'))).toMatch(/^margin_m: /);
    expect(why(text.replace('"pieces":[[', '"pieces":[["x",'))).toMatch(/^segments\[0\]\.pieces\[0\]: five numbers/);
    expect(why(text.replace('"pieces":[[0,', '"pieces":[[999,'))).toMatch(
      /^segments\[0\]\.pieces\[0\]: there is no such solid/,
    );
  });

  test("damaged text never throws", () => {
    const small = writeCertificate({
      ...certificate,
      segments: certificate.segments.map(segment => ({ ...segment, pieces: segment.pieces.slice(0, 4) })),
    });
    fc.assert(
      fc.property(fc.nat(small.length - 1), fc.nat(30), fc.string({ maxLength: 6 }), (at, cut, put) => {
        const read = readCertificate(small.slice(0, at) + put + small.slice(at + cut));
        if (read.kind === "not-a-certificate") expect(read.sentence).toMatch(/\.$/);
      }),
      { seed: 5, numRuns: 500 },
    );
  });
});
