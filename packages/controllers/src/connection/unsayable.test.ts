import {
  emptyProgram,
  flangePose,
  manualScheduler,
  type Dialect,
  type MoveStep,
  type Pose,
  type Program,
  type Robot,
  type Step,
} from "@twincell/core";
import { describe, expect, test } from "vitest";
import { DRIVER_KINDS, robotsOf } from "../brands.ts";
import { endedOn } from "../testing/index.ts";
import { openRobotConnection } from "./index.ts";

const dialect = { interpret: () => ({ kind: "not-understood", faults: [] }) } as unknown as Dialect;
const signals = { part: { direction: "out", kind: "digital" } } as unknown as Program["signals"];

/** A motion that every controller takes; arc, line, load, spline and search deep in routines and branches. */
function programFor(robot: Robot): Program {
  const at = (dx_m: number, dz_m: number) => {
    const { position, quaternion } = flangePose(robot.arm, robot.home_rad);
    const [x, y, z] = position;
    return {
      pose: { position: [x - dx_m, y, z - dz_m], quaternion } as unknown as Pose<"frame", "tcp">,
      frame: "world",
      tool: "flange",
    };
  };
  const ptp = (id: string, by_rad: number): MoveStep => ({
    id,
    type: "move",
    path: "ptp",
    target: { q: robot.home_rad.map((q, i) => (i === 0 ? q + by_rad : q)) },
    speed: { ratio: 1 },
    blend_m: 0,
  });
  const path = { type: "move", speed: { mps: 0.05 }, blend_m: 0 } as const;
  const arc: Step = { ...path, id: "arc", path: "circ", via: at(0.01, 0.01), target: at(0.02, 0) };
  const steps: readonly Step[] = [
    ptp("first", 0.2),
    {
      id: "round",
      type: "repeat",
      times: 2,
      steps: [
        {
          id: "whether",
          type: "if",
          when: { signal: "part", is: true },
          then: [{ id: "go", type: "call", routine: "edge" }],
          else: [{ id: "load", type: "payload", mass_kg: 0.5, center_m: [0, 0, 0] }],
        },
        {
          id: "wait",
          type: "wait-for",
          when: { signal: "part", is: true },
          timeout_s: 1,
          late: [{ ...path, id: "spline", path: "spline", target: at(0.01, 0) }],
        },
      ],
    },
  ];
  return {
    ...emptyProgram(robot.id, "Edges"),
    signals,
    steps,
    routines: {
      edge: [
        arc,
        { ...path, id: "line", path: "lin", target: at(0.01, 0) },
        { id: "on", type: "call", routine: "find" },
      ],
      find: [
        {
          ...path,
          id: "search",
          path: "lin",
          target: at(0.01, 0),
          until: { when: { signal: "part", is: true }, missing: "continue" },
        },
      ],
      never: [{ ...path, id: "never", path: "spline", target: at(0.01, 0) }],
    },
  };
}

/** What each driver cannot be told of that program. */
const UNSAID: Readonly<Record<string, readonly string[]>> = {
  ur: ["spline", "search"],
  kuka: ["load", "spline", "search"],
  yaskawa: ["arc", "load", "spline", "search"],
  fanuc: ["arc", "load", "spline", "search"],
  abb: ["load", "spline", "search"],
  staubli: ["arc", "line", "load", "spline", "search"],
  "staubli-cs7": ["arc", "load", "spline", "search"],
};

describe("a program with steps that the connection cannot say", () => {
  test.each(DRIVER_KINDS.map(brand => [brand.id, brand] as const))(
    "T-15 is refused by %s before the first motion, with every one of them and the way out",
    async (id, brand) => {
      const scheduler = manualScheduler();
      const ended = endedOn(scheduler, 0.02);
      const robot = robotsOf(brand).find(({ arm }) => arm.joints.length === 6)!;
      const opened = await openRobotConnection({ id: "s", brand, robot, scheduler, dialect, deadMan: false });
      if (opened.kind === "refused") throw new Error(opened.why.sentence);
      const { station } = opened;
      expect(await ended(station.connect())).toEqual({ kind: "done" });
      await scheduler.elapse(0.2);
      const seat = station.commander("you");
      seat.acquireLease();
      const from_rad = station.controller.jointAngles();
      const program = programFor(robot);
      const outcomes = [
        await ended(station.run(seat, program, false)),
        station.takes(program),
        await ended(station.prepare(seat, program, false)),
      ];
      await scheduler.elapse(1);
      for (const outcome of outcomes) {
        if (outcome.kind !== "refused") throw new Error(`${id}: ${outcome.kind}`);
        const { sentence, hint } = outcome.why;
        expect([...sentence.matchAll(/“([a-z]+)”/g)].map(([, step]) => step).sort()).toEqual([...UNSAID[id]!].sort());
        expect(sentence).toMatch(/Nothing has moved\.$/);
        expect(hint).toContain("Run the program as text of the controller's own language.");
      }
      station.controller.jointAngles().forEach((q, i) => {
        expect(Math.abs(q - from_rad[i]!)).toBeLessThan(1e-4);
      });
      const fit: Program = { ...program, steps: [program.steps[0]!], routines: {} };
      expect(await ended(station.run(seat, fit, false))).toEqual({ kind: "done" });
      expect(Math.abs(station.controller.jointAngle(1) - from_rad[0]!)).toBeGreaterThan(0.1);
      station.close();
    },
  );
});
