import { describe, expect, test } from "vitest";
import { pose, fromAxisAngle, type PhysicalObject } from "@twincell/core";
import { createWorld, solidMesh, touches } from "./index.ts";
import { at, bareScene, box, engine, ready, rest } from "./testing/cells.ts";

const FLOOR = { floor_m: 0 };

test("X-06 a part falls with 9.81 m/s² within 1 %", () => {
  const world = ready(bareScene({ objects: [box("part", [0.1, 0.1, 0.1], [2, 0, 3])] }));
  const t = 0.5;
  rest(world, t);
  expect(Math.abs((2 * (3 - at(world, 0)[2])) / (t * t) / 9.81 - 1)).toBeLessThan(0.01);
  world.close();
});

test("X-06 mass is momentum: a heavy part sends a light one off, a light one stops at a heavy one", () => {
  const after = (first_kg: number, second_kg: number): number => {
    const world = ready(
      bareScene({
        ...FLOOR,
        objects: [
          box("runner", [0.1, 0.1, 0.1], [2, 0, 0.05], { mass_kg: first_kg, friction: 0 }),
          box("target", [0.1, 0.1, 0.1], [2.3, 0, 0.05], { mass_kg: second_kg, friction: 0 }),
        ],
      }),
    );
    rest(world, 0.2);
    world.data.qvel[6] = 1;
    rest(world, 0.6);
    const [one, two] = [world.data.qvel[6] as number, world.data.qvel[12] as number];
    expect(Math.abs(first_kg * one + second_kg * two - first_kg)).toBeLessThan(0.02 * first_kg);
    world.close();
    return two;
  };
  expect(after(5, 0.5)).toBeGreaterThan(0.9);
  expect(after(0.5, 5)).toBeLessThan(0.2);
});

describe("X-16 the surface decides", () => {
  const slope = Math.PI / 9;
  const onSlope = (more: Partial<PhysicalObject>): PhysicalObject[] => [
    {
      id: "ramp",
      name: "Ramp",
      role: "fixture",
      worldFromObject: pose([2, 0, 1], fromAxisAngle([0, 1, 0], slope)),
      shape: { kind: "box", size_m: [2, 1, 0.1] },
    },
    {
      ...box("part", [0.1, 0.1, 0.1], [0, 0, 0], more),
      worldFromObject: pose([2 + 0.1 * Math.sin(slope), 0, 1 + 0.1 * Math.cos(slope)], fromAxisAngle([0, 1, 0], slope)),
    },
  ];
  const slid = (friction: number): number => {
    const world = ready(bareScene({ objects: onSlope({ friction }) }));
    const from = at(world, 0);
    rest(world, 0.4);
    const to = at(world, 0);
    world.close();
    return Math.hypot(to[0] - from[0], to[2] - from[2]);
  };
  test("X-16 friction 0 slides as on ice, 1 holds on a slope of 20°", () => {
    expect(Math.abs(slid(0) / (0.5 * 9.80665 * Math.sin(slope) * 0.16) - 1)).toBeLessThan(0.05);
    expect(slid(1)).toBeLessThan(0.002);
  });
  test("X-16 a soft surface gives way further than a hard one", () => {
    const sunk = (softness_s: number): number => {
      const world = ready(
        bareScene({
          ...FLOOR,
          objects: [box("part", [0.1, 0.1, 0.1], [2, 0, 0.05], { softness_s, friction: 0.5, mass_kg: 5 })],
        }),
      );
      rest(world, 1);
      const depth = 0.05 - at(world, 0)[2];
      world.close();
      return depth;
    };
    expect(sunk(0.05)).toBeGreaterThan(5 * sunk(0.004));
    expect(sunk(0.004)).toBeLessThan(0.0005);
  });
});

describe("L-72 a hole stays a hole", () => {
  const ring: PhysicalObject = {
    id: "ring",
    name: "Ring",
    role: "fixture",
    worldFromObject: pose([2, 0, 0.2]),
    shape: {
      kind: "revolved",
      ring: true,
      profile_m: [
        [0.05, 0],
        [0.1, 0],
        [0.1, 0.1],
        [0.05, 0.1],
      ],
    },
  };
  const peg = (radius_m: number): PhysicalObject => ({
    id: "peg",
    name: "Peg",
    role: "part",
    worldFromObject: pose([2, 0, 0.2]),
    shape: { kind: "cylinder", radius_m, height_m: 0.2 },
    mass_kg: 1,
  });
  test("L-72 a peg with 2 mm of play falls through a ring and touches nothing; one that is too thick is inside it at the start", () => {
    const world = ready(bareScene({ objects: [ring, peg(0.048)] }));
    expect(touches(engine, world.model, world.data, world.scene)).toEqual([]);
    rest(world, 0.3);
    expect(Math.abs(at(world, 0)[2] - (0.2 - 0.5 * 9.80665 * 0.09))).toBeLessThan(0.01);
    world.close();
    const thick = createWorld(engine, bareScene({ objects: [ring, peg(0.056)] }));
    expect(thick.kind === "refused" && thick.why.sentence).toMatch(
      /^“(Ring|Peg)” and “(Ring|Peg)” are \d+\.\d mm inside one another at the start\.$/,
    );
  });
  test("L-72 the same ring as a mesh, which its hull would close", () => {
    const meshed = ready(
      bareScene({ objects: [{ ...ring, shape: { kind: "mesh", mesh: solidMesh(ring.shape) } }, peg(0.03)] }),
    );
    expect(touches(engine, meshed.model, meshed.data, meshed.scene)).toEqual([]);
    rest(meshed, 0.3);
    expect(at(meshed, 0)[2]).toBeLessThan(0);
    meshed.close();
  });
});

describe("what cannot be simulated is said", () => {
  const refused = (objects: readonly PhysicalObject[]): string => {
    const answer = createWorld(engine, bareScene({ objects }));
    if (answer.kind === "ready") {
      answer.world.close();
      return "";
    }
    return answer.why.sentence;
  };
  test("a massless part, one without volume, one that is nowhere", () => {
    expect(refused([box("Box", [0.1, 0.1, 0.1], [2, 0, 0], { mass_kg: 0 })])).toBe(
      "“Box” weighs 0 kg: what falls and is carried needs a mass.",
    );
    expect(refused([box("Box", [0.1, 0.1, 0.1], [2, 0, 0], { mass_kg: Number.NaN })])).toContain("weighs NaN kg");
    expect(refused([box("Box", [0.1, 0.1, 0.1], [2, Number.NaN, 0])])).toBe("The place of “Box” is not a number.");
    expect(
      refused([
        {
          ...box("Sheet", [0.1, 0.1, 0.1], [2, 0, 0]),
          shape: {
            kind: "mesh",
            mesh: { positions: Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), indices: Uint32Array.of(0, 1, 2) },
          },
        },
      ]),
    ).toBe("“Sheet” encloses no volume: it is not a solid.");
  });
  test("solids inside one another at the start", () => {
    expect(refused([box("Box", [0.1, 0.1, 0.1], [2, 0, 0]), box("Other", [0.1, 0.1, 0.1], [2.05, 0, 0])])).toMatch(
      /^“Box” and “Other” are \d+\.\d mm inside one another at the start\.$/,
    );
  });
  test("a state that explodes is paused with the name of what flew off, and no number is NaN", () => {
    const world = ready(bareScene({ ...FLOOR, objects: [box("Box", [0.1, 0.1, 0.1], [2, 0, 0.05])] }));
    world.data.qvel[8] = 1e6;
    const none = new Float64Array(6);
    const outcome = world.step({ q_rad: world.scene.q_rad, qd_rad_s: none, qdd_rad_s2: none, gripperClosed: false });
    expect(outcome.kind === "paused" && outcome.why.sentence).toBe(
      "“Box” flew off: its speed passed 200 m/s at 0.000 s.",
    );
    expect([...world.state.parts, ...world.coordinates.qpos, ...world.coordinates.qvel].every(Number.isFinite)).toBe(
      true,
    );
    expect(world.step({ q_rad: world.scene.q_rad, qd_rad_s: none, qdd_rad_s2: none, gripperClosed: false })).toBe(
      outcome,
    );
    world.reset();
    rest(world, 0.1);
    expect(Math.abs(at(world, 0)[2] - 0.05)).toBeLessThan(0.001);
    world.close();
  });
  test("a command that is no number is refused with its joint", () => {
    const world = ready(bareScene());
    const none = new Float64Array(6);
    const outcome = world.step({
      q_rad: [0, 0, Number.NaN, 0, 0, 0],
      qd_rad_s: none,
      qdd_rad_s2: none,
      gripperClosed: false,
    });
    expect(outcome.kind === "paused" && outcome.why.sentence).toContain("Joint 3 of");
    world.close();
  });
});
