import { describe, expect, test } from "vitest";
import {
  boxMesh,
  checkProgram,
  emptyProgram,
  fromAxisAngle,
  identity,
  linkSolids,
  pose,
  robotById,
  seededRandom,
  verifyProgram,
  type CellGeometry,
  type Finding,
  type MoveStep,
  type Program,
  type Step,
  type Vector3,
  type Verdict,
} from "../index.ts";

const robot = robotById("staubli_rx90l")!;
const DOWN = fromAxisAngle([1, 0, 0], Math.PI);
/** The tool's solid ends 10 mm before its TCP; gripped 5 mm above it, the carton hangs 105 mm below the TCP. */
const TCP = pose<"flange", "tcp">([0, 0, 0.15]);
const box = (id: string, name: string, position: Vector3, size_m: Vector3): CellGeometry["objects"][number] => ({
  id,
  name,
  worldFromObject: pose(position),
  mesh: boxMesh(size_m),
});
const TABLE = box("table", "Table", [0.55, 0, 0.18], [0.3, 0.7, 0.04]);
const WALL = box("wall", "Wall", [0.55, 0, 0.31], [0.2, 0.02, 0.22]);
const CARTON = { ...box("carton", "Carton", [0.55, 0.2, 0.25], [0.1, 0.1, 0.1]), graspable: true } as const;
const cellOf = (...objects: CellGeometry["objects"]): CellGeometry => ({
  worldFromBase: identity(),
  links: linkSolids(robot),
  allowedPairs: [],
  // What is held is asked about here: the links as they are drawn.
  shapeError_m: 0,
  tool: { name: "gripper", mesh: boxMesh([0.02, 0.02, 0.28]) },
  flangeFromGrip: pose([0, 0, 0.15]),
  objects,
});
const to = (id: string, y_m: number, z_m: number, path: MoveStep["path"] = "lin"): MoveStep => ({
  id,
  type: "move",
  path,
  target: { pose: { position: [0.55, y_m, z_m], quaternion: DOWN }, frame: "world", tool: "gripper" },
  speed: path === "ptp" ? { ratio: 0.5 } : { mps: 0.25 },
  blend_m: 0,
});
const grip = (id: string, closed: boolean): Step => ({ id, type: "gripper", closed });
const programOf = (...steps: readonly Step[]): Program => ({
  ...emptyProgram(robot.id),
  tools: { gripper: TCP },
  steps,
});
/** Takes the carton and carries it over the wall at this height of the TCP. */
const carry = (z_m: number): Step[] => [
  to("above", 0.2, z_m, "ptp"),
  to("at", 0.2, 0.305),
  grip("take", true),
  to("lift", 0.2, z_m),
  to("across", -0.2, z_m),
];
const place = (): Step[] => [to("down", -0.2, 0.305), grip("let go", false), to("up", -0.2, 0.6)];
const LOW_M = 0.46;
const HIGH_M = 0.6;
const check = (cell: CellGeometry, steps: readonly Step[], margin_m = 0): Verdict =>
  checkProgram(programOf(...steps), robot, { cell, margin_m }).verdict;
const contactsOf = (verdict: Verdict): (readonly [string, Finding])[] =>
  verdict.steps.flatMap(({ id, findings }) =>
    findings.filter(({ code }) => code === "collision.contact").map(finding => [id, finding] as const),
  );
const sentencesOf = (verdict: Verdict): string[] =>
  contactsOf(verdict).map(([id, { sentence }]) => `${id}: ${sentence.replace(/[0-9.]+ s/, "t")}`);

describe("M-49 a held part counts in the collision check", () => {
  const cell = cellOf(TABLE, WALL, CARTON);

  test("M-49 held part: carried too low it would touch the wall, to where its lower side is; without the part the same way is clear", () => {
    expect(sentencesOf(check(cell, carry(LOW_M)))).toEqual(["across: The held “Carton” would touch “Wall” at t."]);
    expect(contactsOf(check(cellOf(TABLE, WALL), carry(LOW_M)))).toEqual([]);
    expect(
      contactsOf(
        check(cellOf(TABLE, WALL, { ...box("carton", "Carton", [0.55, 0.2, 0.25], [0.1, 0.1, 0.1]) }), carry(LOW_M)),
      ),
    ).toEqual([]);
    // The wall ends at 0.42 m: the carton's lower side passes 1 mm above it, or 1 mm below.
    expect(sentencesOf(check(cell, carry(0.42 + 0.105 + 0.001)))).toEqual([]);
    expect(sentencesOf(check(cell, carry(0.42 + 0.105 - 0.001)))).toEqual([
      "across: The held “Carton” would touch “Wall” at t.",
    ]);
  });

  test("M-49 held part: taken from the table, carried over the wall and put down it is clear, and the verdict says what was taken for true", () => {
    const verdict = check(cell, [...carry(HIGH_M), ...place()]);
    expect(sentencesOf(verdict)).toEqual([]);
    expect(verdict.ok).toBe(true);
    // The carton's lower side passes the wall, 0.42 m high, at 0.495 m; near the table it counts from 3 mm on.
    expect(verdict.clearance_m).toBeGreaterThan(0.002);
    expect(verdict.clearance_m).toBeLessThanOrEqual(0.075);
    expect(verdict.assumptions.join(" ")).toMatch(/The part at the grip point moves with the gripper/);
    expect(verdict.assumptions.join(" ")).not.toMatch(/not carried along/);
  });

  test("M-49 held part: put down it is an obstacle at its new place, and none at its old one", () => {
    const sweep = (y_m: number): Step[] => [to("beside", y_m, HIGH_M, "ptp"), to("into", y_m, 0.28)];
    expect(sentencesOf(check(cell, [...carry(HIGH_M), ...place(), ...sweep(-0.2)]))).toEqual([
      "into: The tool touches “Carton” at t.",
    ]);
    expect(sentencesOf(check(cell, [...carry(HIGH_M), ...place(), ...sweep(0.2)]))).toEqual([]);
    expect(sentencesOf(check(cell, sweep(0.2)))).toEqual(["into: The tool touches “Carton” at t."]);
  });

  test("M-49 held part: pressed into the table by more than it may rest on it, or dragged along it, it would touch it", () => {
    const down = (z_m: number): Step[] => [
      ...carry(HIGH_M),
      to("down", -0.2, z_m),
      grip("let go", false),
      to("up", -0.2, HIGH_M),
    ];
    expect(sentencesOf(check(cell, down(0.304)))).toEqual([]);
    expect(sentencesOf(check(cell, down(0.295)))[0]).toBe("down: The held “Carton” would touch “Table” at t.");
    expect(
      sentencesOf(
        check(cell, [
          to("above", 0.2, HIGH_M, "ptp"),
          to("at", 0.2, 0.305),
          grip("take", true),
          to("drag", 0.15, 0.305),
        ]),
      ),
    ).toEqual(["drag: The held “Carton” would touch “Table” at t."]);
  });

  test("M-49 held part: the margin is kept from the wall, and not from the table it is lifted off", () => {
    const over = (gap_m: number): string[] =>
      sentencesOf(check(cell, [...carry(0.42 + 0.105 + gap_m), to("down", -0.2, 0.305), grip("let go", false)], 0.004));
    expect(over(0.0045)).toEqual([]);
    expect(over(0.0035)[0]).toMatch(
      /^across: The held “Carton” comes within 4\.[0-2] mm of “Wall” at t; the margin is 4\.0 mm\.$/,
    );
  });

  test("M-49 held part: certificates cover it and are confirmed; without the part standing there they are not", () => {
    const program = programOf(...carry(HIGH_M), ...place());
    const { plan, certificate, verdict } = checkProgram(program, robot, { cell, margin_m: 0.002, certify: true });
    expect(verdict).toEqual(checkProgram(program, robot, { cell, margin_m: 0.002 }).verdict);
    expect(certificate!.segments.map(({ step }) => step)).toEqual(["above", "at", "lift", "across", "down", "up"]);
    expect(certificate!.segments[3]!.pieces.some(({ a, b }) => a === "wall" && b === "carton")).toBe(true);
    expect(verifyProgram(certificate!, program, plan, robot, cell)).toMatchObject({ kind: "confirmed", segments: 6 });
    // What was proven of an empty gripper proves nothing of one that holds the carton.
    const empty = cellOf(TABLE, WALL, { ...box("carton", "Carton", [0.55, 0.2, 0.25], [0.1, 0.1, 0.1]) });
    const unheld = checkProgram(programOf(...carry(LOW_M)), robot, { cell: empty, certify: true });
    expect(verifyProgram(unheld.certificate!, programOf(...carry(LOW_M)), unheld.plan, robot, empty).kind).toBe(
      "confirmed",
    );
    expect(verifyProgram(unheld.certificate!, programOf(...carry(LOW_M)), unheld.plan, robot, cell)).toMatchObject({
      kind: "refuted",
      step: "lift",
    });
  });
});

describe("M-49 held part: laws", () => {
  test("taken again from where it was put, it is carried from there", () => {
    const back = [
      to("at again", -0.2, 0.305),
      grip("take again", true),
      to("lift again", -0.2, LOW_M),
      to("back", 0.2, LOW_M),
    ];
    expect(sentencesOf(check(cellOf(TABLE, WALL, CARTON), [...carry(HIGH_M), ...place(), ...back]))).toEqual([
      "back: The held “Carton” would touch “Wall” at t.",
    ]);
    expect(sentencesOf(check(cellOf(TABLE, CARTON), [...carry(HIGH_M), ...place(), ...back]))).toEqual([]);
  });

  test("held part: found exactly where the swept box of the carton meets a block, by arithmetic (40 blocks, seed 49)", () => {
    // The tool keeps its orientation on straight lines, so the carton sweeps boxes along the axes: up at y = 0.2, then
    // across at the carrying height.
    const random = seededRandom(49);
    const found = { met: 0, clear: 0 };
    const half = 0.05;
    const rise_m = HIGH_M - 0.305;
    for (let i = 0; i < 40; i++) {
      const x = 0.55 + (random() - 0.5) * 0.22;
      const y = -0.1 + random() * 0.2;
      const z = 0.41 + random() * 0.09;
      const size: Vector3 = [0.02 + random() * 0.04, 0.02 + random() * 0.04, 0.1];
      const besides_m = Math.abs(x - 0.55) - half - size[0] / 2;
      const above_m = 0.2 + rise_m - (z + size[2] / 2);
      const gap_m = Math.max(besides_m, above_m);
      if (Math.abs(gap_m) < 0.001) continue;
      const verdict = check(cellOf(TABLE, CARTON, box("block", "Block", [x, y, z], size)), carry(HIGH_M));
      const said = sentencesOf(verdict);
      expect(said, `block ${i}: ${gap_m}`).toEqual(
        gap_m < 0 ? ["across: The held “Carton” would touch “Block” at t."] : [],
      );
      found[gap_m < 0 ? "met" : "clear"]++;
    }
    expect(found.met).toBeGreaterThan(5);
    expect(found.clear).toBeGreaterThan(5);
  });
});

describe("M-20 what the gripper takes", () => {
  test("M-20 nothing is taken when nothing is there, and the verdict says so", () => {
    const away = { ...CARTON, worldFromObject: pose<"world", "object">([0.55, 0.2, 0.25 - 0.016] as Vector3) };
    const near = { ...CARTON, worldFromObject: pose<"world", "object">([0.55, 0.2, 0.25 - 0.014] as Vector3) };
    const nothing = check(cellOf(WALL, away), carry(LOW_M));
    expect(sentencesOf(nothing)).toEqual([]);
    expect(nothing.assumptions).toContain(
      "The gripper closes on nothing once: no work piece is drawn within 20 mm of its grip point.",
    );
    expect(sentencesOf(check(cellOf(WALL, near), carry(LOW_M)))).toEqual([
      "across: The held “Carton” would touch “Wall” at t.",
    ]);
  });

  test("M-20 the nearest part is taken, and no fixture", () => {
    const lid = { ...box("lid", "Lid", [0.55, 0.2, 0.287], [0.02, 0.02, 0.02]), graspable: true } as const;
    const low = { ...CARTON, worldFromObject: pose<"world", "object">([0.55, 0.2, 0.225] as Vector3) };
    const post = box("post", "Post", [0.55, 0.1, 0.4], [0.02, 0.02, 0.08]);
    expect(sentencesOf(check(cellOf(low, lid, post), carry(LOW_M)))).toEqual([
      "across: The held “Lid” would touch “Post” at t.",
    ]);
    expect(
      contactsOf(check(cellOf(WALL, box("carton", "Carton", [0.55, 0.2, 0.25], [0.1, 0.1, 0.1])), carry(LOW_M))),
    ).toEqual([]);
  });

  test("M-20 where the program decides between motions parts are not followed, and the verdict says so", () => {
    const decided = check(cellOf(TABLE, WALL, CARTON), [
      ...carry(LOW_M),
      { id: "if", type: "if", when: { signal: "full", is: true }, then: [to("away", -0.2, HIGH_M)] },
    ]);
    expect(contactsOf(decided)).toEqual([]);
    expect(decided.assumptions.join(" ")).toMatch(/Gripped parts stand where they were drawn/);
    const said = check(cellOf(TABLE, WALL, CARTON), [
      {
        id: "if",
        type: "if",
        when: { signal: "full", is: true },
        then: [{ id: "say", type: "message", text: "full" }],
      },
      ...carry(LOW_M),
    ]);
    expect(sentencesOf(said)).toEqual(["across: The held “Carton” would touch “Wall” at t."]);
  });
});
