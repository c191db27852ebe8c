/**
 * The shipped examples, for every robot that reaches their places, as text of that robot's own language, executed and
 * compared with the plan.
 */
import { cellGeometry, conveyorPalletCell, tracedCartonCell, type StepsCell } from "@twincell/project";
import {
  checkProgram,
  LIBRARY,
  linkSolids,
  retargetProgram,
  robotById,
  withBranches,
  type Program,
  type Robot,
} from "@twincell/core";
import { dialectsFor, proveText, runnableFile } from "@twincell/languages";
import { expect, test } from "vitest";

/** Controllers that count their inputs from another number than 1. */
const FIRST_INPUT: Readonly<Record<string, number>> = { "v-plus": 1001, "kawasaki-as": 1001 };

/** The program of the example as it is taught to that robot; null when it does not reach all of it. */
function taughtTo(cell: StepsCell, robot: Robot): Program | null {
  const from = robotById(cell.robot.id)!;
  const taught = cell.programs[0]!;
  const program = robot === from ? taught : retargetProgram(taught, from, robot, cell.robot.worldFromBase).program;
  const geometry = cellGeometry({ ...cell, robot: { ...cell.robot, id: robot.id } }, linkSolids(robot));
  const { verdict } = checkProgram(program, robot, { cell: geometry });
  return verdict.ok ? program : null;
}

test.each([
  ["Conveyor and pallet", conveyorPalletCell(), 6],
  ["Traced carton", tracedCartonCell(), 1],
] as const)(
  "%s: every robot that reaches all of it gets it in its own language, and the text is the program",
  (_, cell, least) => {
    const written: string[] = [];
    for (const robot of LIBRARY) {
      const program = taughtTo(cell, robot);
      const [dialect] = dialectsFor(robot);
      if (program === null || dialect === undefined) continue;
      // The pose list of the research arm declares that it reads no signals.
      if (dialect.cannot.some(({ what }) => what === "wait-for") && Object.keys(program.signals).length > 0) continue;
      const { worldFromBase } = cell.robot;
      const numbered = withBranches(
        {
          ...program,
          signals: Object.fromEntries(
            Object.entries(program.signals).map(([name, line]) => [
              name,
              { ...line, address: FIRST_INPUT[dialect.id] ?? line.address ?? 1 },
            ]),
          ),
        },
        robot,
        { where: "needed", worldFromBase },
      );
      const emitted = dialect.emit(numbered, robot, worldFromBase);
      if (emitted.kind !== "emitted") throw new Error(`${robot.id}, ${dialect.id}: ${emitted.sentence}`);
      const file = runnableFile(dialect, emitted.files)!;
      const proof = proveText(dialect, file, numbered, robot, worldFromBase);
      expect([robot.id, proof.kind, proof.kind === "proven" ? "" : proof.sentence]).toEqual([robot.id, "proven", ""]);
      written.push(robot.id);
    }
    expect(written).toContain(cell.robot.id);
    expect(written.length).toBeGreaterThanOrEqual(least);
  },
  120_000,
);
