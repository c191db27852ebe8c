import { describe, expect, test } from "vitest";
import { robotById } from "../robots/library/index.ts";
import { boxMesh } from "../mesh/solids.ts";
import type { Robot } from "../model/robot.ts";
import { standLoad } from "../model/stand.ts";
import { pose } from "../spatial/pose.ts";
import type { Vector3 } from "../spatial/vector.ts";
import { checkProgram } from "./check.ts";
import { applyRepair } from "../program/edit.ts";
import { emptyProgram, type MoveStep, type Program, type Step } from "../program/program.ts";
import type { Verdict } from "./verdict.ts";

const robot = robotById("staubli_rx90l")!;
const at = (position: Vector3, frame = "world"): MoveStep["target"] => ({
  pose: { position, quaternion: frame === "world" ? [1, 0, 0, 0] : [0, 0, 0, 1] },
  frame,
  tool: "flange",
});
const move = (id: string, path: MoveStep["path"], target: MoveStep["target"]): MoveStep => ({
  id,
  type: "move",
  path,
  target,
  speed: { ratio: 0.5 },
  blend_m: 0,
});
const ready = move("ready", "ptp", { q: [0, -1, 2, 0, 0.6, 0] });
const of = (steps: readonly Step[], more: Partial<Program> = {}): Program => ({
  ...emptyProgram(robot.id),
  steps,
  ...more,
});
const check = (program: Program, other: Robot = robot): Verdict => checkProgram(program, other).verdict;
const codes = (verdict: Verdict, id: string): string[] =>
  verdict.steps.find(step => step.id === id)!.findings.map(finding => finding.code);
const tray = (far_m: number) => ({
  frame: "world",
  origin: { position: [0.5, -0.2, 0.3] as Vector3, quaternion: [1, 0, 0, 0] as [number, number, number, number] },
  rowEnd: [0.5, 0.2, 0.3] as Vector3,
  columnEnd: [far_m, -0.2, 0.3] as Vector3,
  rows: 3,
  columns: 3,
  layers: 1,
  layer_m: 0,
});
const onTray: Step = {
  id: "t",
  type: "pallet",
  pallet: "tray",
  steps: [move("over", "ptp", at([0, 0, -0.05], "tray")), move("in", "lin", at([0, 0, 0], "tray"))],
};

describe("checkProgram of programs with blocks", () => {
  test("M-54 nine of nine places are checked", () => {
    const program = of([ready, onTray], { pallets: { tray: tray(0.65) } });
    const { verdict, plan } = checkProgram(program, robot);
    expect(verdict).toMatchObject({
      ok: true,
      steps: [{ id: "ready", verdict: "ok" }, { id: "t", verdict: "ok" }, { id: "over" }, { id: "in" }],
    });
    expect(plan.segments.filter(segment => segment.step === "in").length).toBe(9);
  });

  test("a place out of reach is named, others with it are counted, and a repair stays a step of the pallet", () => {
    const program = of([ready, onTray], { pallets: { tray: tray(1.5) } });
    const verdict = check(program);
    expect(verdict.ok).toBe(false);
    const finding = verdict.steps.find(step => step.id === "in")!.findings[0]!;
    expect(finding.code).toBe("reach.too-far");
    expect(finding.sentence).toMatch(/^Place [47] of 9: .*more places? (has|have) the same finding\.$/);
    for (const { replace } of finding.repairs) {
      expect(replace).toMatchObject({ id: "in", target: { frame: "tray" } });
      // The repair brings that place into reach, and stands where the others are moved as far.
      expect(applyRepair(program, "in", { replace: replace! }).steps[1]).toMatchObject({
        steps: [{ id: "over" }, { id: "in", target: { frame: "tray" } }],
      });
    }
  });

  test("the end of a loop goes into its beginning: what is only wrong the second time round is found", () => {
    const elbowDown = (id: string): MoveStep => move(id, "lin", { q: [0, -1, 2, 0, 0.6, 0] });
    const loop: Step = {
      id: "r",
      type: "repeat",
      times: "forever",
      steps: [elbowDown("first"), move("far", "ptp", { q: [0.3, -1, 2, 0, -0.6, 0] })],
    };
    const verdict = check(of([ready, loop, { id: "z", type: "wait", s: 1 }]));
    expect(verdict.steps.find(step => step.id === "first")!.findings[0]?.sentence).toMatch(/^The next time round: /);
    expect(codes(verdict, "z")).toEqual(["flow.unreached"]);
    expect(verdict.assumptions).toContain("Loops without end were looked at twice round.");
  });

  test("both sides of a decision are checked, and what follows from either", () => {
    const choice = (...otherwise: Step[]): Step => ({
      id: "i",
      type: "if",
      when: { signal: "part", is: true },
      then: [move("a", "ptp", { q: [0.1, -1, 2, 0, 0.6, 0] })],
      else: otherwise,
    });
    const signals: Program["signals"] = { part: { kind: "digital-in" } };
    expect(check(of([ready, choice(move("b", "ptp", at([3, 0, 0])))], { signals })).steps).toMatchObject([
      {},
      { verdict: "ok" },
      { id: "a", verdict: "ok" },
      { id: "b", verdict: "bad" },
    ]);
    // From the other side, with the wrist turned over, the straight path does not end as it was taught.
    const after = move("after", "lin", { q: [0, -1, 2, 0, 0.6, 0] });
    expect(check(of([ready, choice(), after], { signals })).ok).toBe(true);
    expect(
      codes(check(of([ready, choice(move("b", "ptp", { q: [0.1, -1, 2, 0, -0.6, 0] })), after], { signals })), "after")
        .length,
    ).toBeGreaterThan(0);
  });

  test("steps nobody comes to and loops that let no time pass are warned of", () => {
    const idle: Step = {
      id: "r",
      type: "repeat",
      times: "forever",
      steps: [{ id: "s", type: "set", signal: "lamp", to: true }],
    };
    const verdict = check(
      of([idle], {
        signals: { lamp: { kind: "digital-out" } },
        routines: { never: [{ id: "n", type: "wait", s: 1 }] },
      }),
    );
    expect([codes(verdict, "r"), codes(verdict, "n"), verdict.ok]).toEqual([
      ["flow.idle-loop"],
      ["flow.unreached"],
      true,
    ]);
  });

  test("signals: unknown, an input that is written, a level of a digital line; the repair names one that fits", () => {
    const program = of(
      [
        { id: "a", type: "set", signal: "lamb", to: true },
        { id: "b", type: "set", signal: "part", to: true },
        { id: "c", type: "wait-for", when: { signal: "part", above: 2 } },
        { id: "d", type: "if", when: { signal: "part", is: true }, then: [] },
      ],
      { signals: { part: { kind: "digital-in" }, lamp: { kind: "digital-out" } } },
    );
    const verdict = check(program);
    expect(["a", "b", "c", "d"].map(id => codes(verdict, id))).toEqual([
      ["signals.unknown"],
      ["signals.input-written"],
      ["signals.kind"],
      [],
    ]);
    const repair = verdict.steps[0]!.findings[0]!.repairs[0]!;
    expect(repair.sentence).toBe("Use “lamp”.");
    expect(codes(check(applyRepair(program, "a", repair)), "a")).toEqual([]);
  });

  test("X-07 a load of 9.9 kg is lifted, 10.1 kg is refused with a message", () => {
    const ur10e = robotById("ur10e")!;
    const load = (mass_kg: number): Verdict =>
      check(
        { ...emptyProgram(ur10e.id), steps: [{ id: "l", type: "payload", mass_kg, center_m: [0, 0, 0.05] }] },
        ur10e,
      );
    expect([load(9.9).ok, load(10).ok, load(10.1).ok]).toEqual([true, true, false]);
    expect(load(10.1).steps[0]!.findings[0]).toMatchObject({
      code: "payload.too-heavy",
      value: 10.1,
      limit: 10,
      unit: "kg",
      sentence: `The load is 10.1 kg; the ${ur10e.name} lifts at most 10 kg.`,
    });
  });

  test("X-07 a load on a robot whose payload no source states is unknown, never ok; no load is ok", () => {
    const { payload_kg, payloadMax_kg, ...unstated } = robotById("ur10e")!;
    expect([payload_kg, payloadMax_kg]).toEqual([10, 10]);
    const verdictOf = (mass_kg: number): Verdict =>
      check(
        { ...emptyProgram(unstated.id), steps: [{ id: "l", type: "payload", mass_kg, center_m: [0, 0, 0.05] }] },
        unstated,
      );
    expect([verdictOf(0.1).ok, verdictOf(0.1).steps[0]!.verdict]).toEqual([false, "unknown"]);
    expect(verdictOf(0).steps[0]!.verdict).toBe("ok");
    expect(standLoad(unstated)).toMatchObject({ kind: "unknown" });
  });

  test("X-09 the stand carries robot and load, 33.5 kg and 43.5 kg, or says by how much it does not", () => {
    const ur10e = robotById("ur10e")!;
    const program = {
      ...emptyProgram(ur10e.id),
      steps: [
        { id: "w", type: "wait", s: 1 },
        { id: "l", type: "payload", mass_kg: 10, center_m: [0, 0, 0.05] },
      ] satisfies Step[],
    };
    expect(standLoad(ur10e)).toEqual({ kind: "known", robot_kg: 33.5, payload_kg: 10, total_kg: 43.5 });
    const { mass_kg, ...unweighed } = ur10e;
    expect(mass_kg).toBe(33.5);
    expect(standLoad(unweighed)).toEqual({
      kind: "unknown",
      sentence: `The mass of ${ur10e.name} is not published: whether its stand carries it is not judged.`,
    });
    const on = (carries_kg: number, where: Vector3 = [0, 0, 0.25]): Verdict =>
      checkProgram(program, ur10e, {
        cell: {
          worldFromBase: pose([0, 0, 0.5]),
          links: [],
          allowedPairs: [],
          shapeError_m: 0,
          objects: [
            {
              id: "table",
              name: "The table",
              worldFromObject: pose(where),
              mesh: boxMesh([0.6, 0.6, 0.5]),
              carries_kg,
            },
          ],
        },
      }).verdict;
    expect([43.5, 43.4, 33.5, 33.4].map(kg => on(kg).steps.map(({ verdict }) => verdict))).toEqual([
      ["ok", "ok"],
      ["ok", "bad"],
      ["ok", "bad"],
      ["bad", "ok"],
    ]);
    expect(on(40).steps[1]!.findings[0]).toMatchObject({
      code: "stand.overloaded",
      value: 43.5,
      limit: 40,
      unit: "kg",
      sentence: `${ur10e.name} weighs 33.5 kg and carries 10 kg, 43.5 kg together; The table carries 40 kg.`,
    });
    expect(on(30).steps[0]!.findings[0]!.sentence).toBe(`${ur10e.name} weighs 33.5 kg; The table carries 30 kg.`);
    // A table beside the robot, or high above its base, is not what it stands on.
    expect([on(1, [1, 0, 0.25]).ok, on(1, [0, 0, 0.5]).ok]).toEqual([true, true]);
  });

  test("N-09 the payload of the RX90L: 3.5 kg at full speed, 6 kg at reduced speed, no more", () => {
    const verdict = (mass_kg: number): string =>
      check(of([{ id: "l", type: "payload", mass_kg, center_m: [0, 0, 0] }])).steps[0]!.verdict;
    expect([3.5, 3.6, 6, 6.1].map(verdict)).toEqual(["ok", "warn", "warn", "bad"]);
  });
});
