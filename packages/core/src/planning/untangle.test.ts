import { describe, expect, test } from "vitest";
import {
  CellCollider,
  checkJointLine,
  checkProgram,
  emptyProgram,
  findPath,
  HandGuard,
  jointLine,
  linkSolids,
  pose,
  robotById,
  samplePlan,
  seededRandom,
  escapeSelfCollision,
  PathValidator,
  type CellGeometry,
  type MoveStep,
  type Program,
} from "../index.ts";
import { box, planarArm, planarCell } from "../collision/testing/test-arm.ts";

const robot = robotById("ur10e")!;
const cell: CellGeometry = {
  worldFromBase: pose(),
  links: linkSolids(robot),
  objects: [],
  allowedPairs: [],
  shapeError_m: 0,
};

/** Two free postures of the UR10e between which the straight way runs the arm into itself. */
function tangled(seed: number): readonly [number[], number[]] {
  const random = seededRandom(seed);
  const collider = new CellCollider(cell, robot.arm);
  for (;;) {
    const draw = (): number[] =>
      [0, -1.2, 0, 0, 0, 0].map((middle, k) => middle + (2 * random() - 1) * (k === 2 ? 2.7 : 2.2));
    const from = draw();
    const to = draw();
    if (collider.collides(from) || collider.collides(to)) continue;
    const verdict = checkJointLine(collider, from, to);
    if (
      verdict.kind === "contact" &&
      verdict.between === "self" &&
      Array.from({ length: 99 }, (_, i) => from.map((q, k) => q + ((i + 1) / 100) * (to[k]! - q))).some(q =>
        collider.collides(q),
      )
    )
      return [from, to];
  }
}

describe("E-25 two modes for a robot that would run into itself", () => {
  const [from, to] = tangled(31);

  test("X-13, E-25 stop: it stands before the contact and knows where it was safe", () => {
    const guard = new HandGuard(new CellCollider(cell, robot.arm), robot.arm);
    const collider = new CellCollider(cell, robot.arm);
    const q = Float64Array.from(from);
    const next = new Float64Array(6);
    guard.begin(q);
    let stopped = false;
    for (let i = 1; i <= 400 && !stopped; i++) {
      const answer = guard.step(
        "stop",
        q,
        from.map((a, k) => a + (i / 400) * (to[k]! - a)),
        next,
      );
      if (answer.kind === "stopped") {
        stopped = true;
        expect(answer.contact.between).toBe("self");
        expect(collider.collides(answer.safe_rad)).toBe(false);
      }
      q.set(next);
      expect(collider.collides(q)).toBe(false);
    }
    expect(stopped).toBe(true);
  });

  test.each([31, 32, 34, 37])(
    "X-28 untangle: it reaches its target without contact and without stopping (seed %i)",
    seed => {
      const [start, goal] = tangled(seed);
      const answer = escapeSelfCollision(new PathValidator(new CellCollider(cell, robot.arm), robot.arm), start, goal, {
        seed,
      });
      if (answer.kind !== "found") throw new Error(answer.kind);
      expect(answer.how).not.toBe("straight");
      const end = answer.way.at(-1)!;
      // The same posture, perhaps with joints a whole turn on.
      end.forEach((angle, k) => {
        expect(Math.cos(angle - goal[k]!)).toBeCloseTo(1, 12);
      });
      const anew = new CellCollider(cell, robot.arm);
      const q = new Float64Array(6);
      answer.way.slice(1).forEach((next, i) => {
        const motion = jointLine(answer.way[i]!, next);
        expect(checkJointLine(anew, answer.way[i]!, next).kind).toBe("clear");
        for (let t = 0; t <= 1; t += 0.01) {
          motion.sample(t, q);
          expect(anew.collides(q)).toBe(false);
        }
      });
    },
  );

  test("X-28 driven as a program with blends the robot is in contact nowhere and stands still nowhere on the way", () => {
    const [start, goal] = tangled(31);
    const answer = escapeSelfCollision(new PathValidator(new CellCollider(cell, robot.arm), robot.arm), start, goal, {
      seed: 1,
    });
    if (answer.kind !== "found") throw new Error(answer.kind);
    const steps = [Float64Array.from(start), ...answer.way.slice(1)].map(
      (q, i): MoveStep => ({
        id: `s${i}`,
        type: "move",
        path: "ptp",
        target: { q: [...q] },
        speed: { ratio: 0.5 },
        blend_m: i === 0 || i === answer.way.length - 1 ? 0 : 0.02,
      }),
    );
    const program: Program = { ...emptyProgram(robot.id), steps };
    const { verdict, plan } = checkProgram(program, robot, { cell, start_rad: start });
    expect(
      verdict.steps
        .flatMap(({ findings }) => findings.map(({ code }) => code))
        .filter(code => code.startsWith("collision.")),
    ).toEqual([]);
    const q = new Float64Array(6);
    const before = new Float64Array(6);
    const from_s = plan.segments.find(({ step, duration_s }) => step === "s1" && duration_s > 0)!.start_s;
    let slowest = Infinity;
    for (let t = from_s + 0.3; t < plan.duration_s - 0.3; t += 0.01) {
      samplePlan(plan, t, q);
      samplePlan(plan, t - 0.01, before);
      slowest = Math.min(slowest, Math.max(...q.map((angle, k) => Math.abs(angle - before[k]!))));
    }
    expect(slowest).toBeGreaterThan(1e-4);
  });

  test("what is free is left straight, what is blocked at an end is said as the search says it", () => {
    const checker = new PathValidator(new CellCollider(cell, robot.arm), robot.arm);
    expect(
      escapeSelfCollision(
        checker,
        robot.home_rad,
        robot.home_rad.map(q => q + 0.1),
      ),
    ).toMatchObject({ kind: "found", how: "straight" });
    const folded = [0, -1.2, 2.9, 0, 0, 0];
    expect(checker.free(folded)).toBe(false);
    expect(escapeSelfCollision(checker, robot.home_rad, folded)).toEqual(findPath(checker, robot.home_rad, folded));
  });
});

describe("a hand that leads the arm towards a wall", () => {
  // The three bars along x; a wall above them, a step in y leads into it.
  const wall = box("wall", [2, 0.4, 0], [4, 0.1, 0.2]);
  const start = [0, 0, 0];
  const STEP = 0.004;
  const led = (behaviour: Parameters<HandGuard["step"]>[0], turns: readonly number[], steps: number) => {
    const collider = new CellCollider(planarCell([wall]), planarArm);
    const guard = new HandGuard(collider, planarArm);
    const q = Float64Array.from(start);
    const next = new Float64Array(3);
    const kinds: string[] = [];
    guard.begin(q);
    let least_m = Infinity;
    let safe: Float64Array | null = null;
    for (let i = 0; i < steps; i++) {
      const answer = guard.step(
        behaviour,
        q,
        q.map((angle, k) => angle + STEP * turns[k]!),
        next,
      );
      kinds.push(answer.kind);
      q.set(next);
      least_m = Math.min(least_m, collider.clearance(q, 1, undefined, ({ b }) => b.name === "wall").distance_m);
      if (answer.kind === "stopped") {
        safe = answer.safe_rad.slice();
        break;
      }
    }
    return { q, kinds, least_m, safe, collider };
  };

  test("N-50 alert: it goes through, and only the alert says so", () => {
    const { kinds, least_m } = led("alert", [1, 0, 0], 60);
    expect(new Set(kinds)).toEqual(new Set(["moved"]));
    expect(least_m).toBe(0);
  });

  test("T-43 stop: it ends before the wall and the posture to go back to has room", () => {
    const { least_m, safe, collider, q } = led("stop", [1, 0, 0], 60);
    expect(least_m).toBeGreaterThan(0.0019);
    expect(safe).not.toBe(null);
    expect(collider.clearance(safe!, 1, undefined, ({ b }) => b.name === "wall").distance_m).toBeGreaterThan(0.0099);
    expect(safe![0]).toBeLessThan(q[0]!);
  });

  test("slide: it goes on along the wall, never nearer than 2 mm and never stopping", () => {
    // Turning the shoulder up and the elbow down: the tip wants into the wall and along it.
    const { kinds, least_m, q } = led("slide", [1, -0.6, 0.3], 300);
    expect(kinds).toContain("slid");
    expect(kinds).not.toContain("stopped");
    expect(least_m).toBeGreaterThan(0.0015);
    expect(Math.hypot(q[0]!, q[1]!, q[2]!)).toBeGreaterThan(0.3);
  });

  test("whoever stands in contact may move out of it", () => {
    const collider = new CellCollider(planarCell([wall]), planarArm);
    const guard = new HandGuard(collider, planarArm);
    const out = new Float64Array(3);
    expect(guard.step("stop", [0.15, 0, 0], [0.14, 0, 0], out)).toEqual({ kind: "moved" });
    expect([...out]).toEqual([0.14, 0, 0]);
  });
});
