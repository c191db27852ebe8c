import { emptyProgram, robotById, robotFromArm, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import { DIALECTS } from "./index.ts";

const irb120 = robotById("abb_irb120")!;
const step: Step = {
  id: "p1",
  type: "move",
  path: "ptp",
  target: { q: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6] },
  speed: { ratio: 0.2 },
  blend_m: 0,
};
const program = { ...emptyProgram("abb_irb120"), steps: [step] };

test("no language writes, reads or runs for an arm that only has the id of a library robot; the same arm from a file is written for", () => {
  const wrong = robotFromArm(robotById("kuka_kr6_2")!.arm, { id: "abb_irb120", name: "abb_irb120" });
  for (const dialect of DIALECTS) {
    const emitted = dialect.emit(program, wrong);
    expect(emitted, dialect.id).toMatchObject({ kind: "cannot" });
    expect(emitted.kind === "cannot" && emitted.sentence).toMatch(/is not the ABB IRB 120.*mm apart|mm and .*° apart/);
    for (const read of [dialect.parse("", wrong), dialect.interpret("", wrong)]) {
      expect(read).toMatchObject({ kind: "not-understood" });
      expect(read.kind === "not-understood" && read.faults[0]!.sentence).toMatch(/is not the ABB IRB 120/);
    }
  }
  const right = robotFromArm(irb120.arm, {
    id: "abb_irb120",
    home_rad: irb120.home_rad,
    vendorSection: irb120.vendorSection!,
  });
  const rapid = DIALECTS.find(dialect => dialect.id === "rapid")!;
  expect(rapid.emit(program, right)).toMatchObject({ kind: "emitted" });
});

test("no language writes, reads or runs where the vendor section is not that of the arm: both flanges are named", () => {
  const wrong = {
    ...irb120,
    id: "own",
    vendorSection: {
      ...irb120.vendorSection!,
      postures: [{ axes_deg: [10, 20, 30, 40, 50, 60], flange_mm: [400, 100, 300] as const }],
    },
  };
  for (const dialect of DIALECTS) {
    expect(dialect.emit(program, wrong), dialect.id).toMatchObject({ kind: "cannot" });
    for (const read of [dialect.parse("", wrong), dialect.interpret("", wrong)])
      expect(read.kind === "not-understood" && read.faults[0]!.sentence).toMatch(
        /has the flange at \(400\.0, 100\.0, 300\.0\) mm, that of the ABB .* is at \(.*\) mm: \d+\.\d mm apart/,
      );
  }
});
