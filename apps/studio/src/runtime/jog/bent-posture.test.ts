import { compose, flangePose, LIBRARY } from "@twincell/core";
import { edgeTraceCell, type CellDocument } from "@twincell/project";
import { describe, expect, test } from "vitest";
import { bentPosture } from "./bent-posture.ts";

const cell = edgeTraceCell();
const bare: CellDocument = { ...cell, tool: "flange", tools: [], objects: [] };

describe("a bent posture", () => {
  test("brings the tool tip of the RX90L to the height of the chest, on the asked side, within its limits", () => {
    const robot = LIBRARY.find(({ id }) => id === cell.robot.id)!;
    const q_rad = bentPosture(cell, robot, 0.4, () => true)!;
    const worldFromFlange = compose(cell.robot.worldFromBase, flangePose(robot.arm, q_rad));
    const [x, y, z] = compose(worldFromFlange, cell.tools[0]!.flangeFromTcp).position;
    expect(z).toBeCloseTo(1.2, 6);
    expect(Math.atan2(y, x)).toBeCloseTo(0.4, 6);
    for (const [i, { limits }] of robot.arm.joints.entries()) {
      expect(q_rad[i]).toBeGreaterThan(limits.lower_rad);
      expect(q_rad[i]).toBeLessThan(limits.upper_rad);
    }
  });

  test("is refused where something is in the way of all of them", () => {
    const robot = LIBRARY.find(({ id }) => id === cell.robot.id)!;
    expect(bentPosture(cell, robot, 0, () => false)).toBeNull();
  });

  test("of every robot of the library is within its limits and has its tool between the knee and the eyes", () => {
    let found = 0;
    for (const robot of LIBRARY) {
      const document: CellDocument = { ...bare, robot: { ...bare.robot, id: robot.id } };
      const q_rad = bentPosture(document, robot, 0, () => true);
      if (!q_rad) continue;
      found++;
      const { position } = compose(document.robot.worldFromBase, flangePose(robot.arm, q_rad));
      expect(position[2], robot.id).toBeGreaterThan(0.5);
      expect(position[2], robot.id).toBeLessThan(1.5);
    }
    expect(found).toBe(LIBRARY.length);
  });
});
