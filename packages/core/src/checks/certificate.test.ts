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
const tinyAt = (position: Vector3): Pick<CellGeometry["objects"][number], "worldFromObject" | "mesh"> => ({
  worldFromObject: pose(position),
  mesh: boxMesh([0.01, 0.01, 0.01]),
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
      of: "motion",
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

  test("the corner that is passed without a stop has one of its own: left out, cut short or claiming too little it proves nothing", () => {
    const [a, b, c] = program.steps as readonly MoveStep[];
    const rounded = { ...program, steps: [a!, { ...b!, blend_m: 0.04 }, c!] };
    const { certificate: whole, plan, verdict } = checkProgram(rounded, robot, { cell: CELL, certify: true });
    const prove = (corners: ProgramCertificate["corners"], cell = CELL): ReturnType<typeof verifyProgram> =>
      verifyProgram({ ...whole!, corners }, rounded, plan, robot, cell);
    expect(verdict.ok).toBe(true);
    expect(whole!.corners.map(({ step }) => step)).toEqual(["b"]);
    expect(prove(whole!.corners)).toMatchObject({ kind: "confirmed", segments: 3, corners: 1 });
    const missing = { kind: "missing", step: "b", of: "corner" };
    expect(prove([])).toMatchObject(missing);
    const [corner] = whole!.corners;
    expect(prove([{ ...corner!, pieces: corner!.pieces.slice(1) }])).toMatchObject(missing);
    const claims = (atLeast_m: number): ProgramCertificate["corners"] => [
      {
        ...corner!,
        pieces: corner!.pieces.map(piece => ({
          ...piece,
          lines: piece.lines.map(line => ({
            ...line,
            pieces: line.pieces.map(one => (one.b === "post" ? { ...one, atLeast_m } : one)),
          })),
        })),
      },
    ];
    expect(prove(claims(0))).toMatchObject({ kind: "refuted", step: "b", reason: "below margin", b: "post" });
    expect(prove(claims(5))).toMatchObject({ kind: "refuted", step: "b", reason: "too near", b: "post" });
    const text = writeCertificate(whole!);
    const read = readCertificate(text);
    expect(read).toEqual({ kind: "certificate", certificate: whole });
    // A certificate of the first version says nothing of corners: it is read, and proves no program that has some.
    const old = readCertificate(text.replace('"version":2', '"version":1'));
    if (old.kind !== "certificate") throw new Error(old.sentence);
    expect(verifyProgram(old.certificate, rounded, plan, robot, CELL)).toMatchObject(missing);
  });

  test("a corner that is too near to something has none", () => {
    const [a, b, c] = program.steps as readonly MoveStep[];
    const rounded = { ...program, steps: [a!, { ...b!, blend_m: 0.06 }, c!] };
    const clear = checkProgram(rounded, robot, { cell: CELL, certify: true });
    const near: CellGeometry = { ...CELL, objects: [{ ...post([0, 0, 0]), ...tinyAt([0.53, -0.17, 0.5]) }] };
    const blocked = checkProgram(rounded, robot, { cell: near, certify: true });
    expect(clear.certificate!.corners).toHaveLength(1);
    expect(blocked.certificate!.corners).toEqual([]);
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
    expect(why(text.replace('"version":2', '"version":3'))).toMatch(/^version: /);
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
