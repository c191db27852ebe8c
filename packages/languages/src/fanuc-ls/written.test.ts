/** What the records of a listing say, worked out by hand from what a teach pendant shows. */
import { emptyProgram, pose, radians, robotById, type MoveStep, type Step } from "@twincell/core";
import { expect, test } from "vitest";
import { fanucLs } from "./index.ts";

const robot = robotById("fanuc_lrmate200id")!;
const joints = (id: string, path: "ptp" | "lin", q_deg: readonly number[]): MoveStep => ({
  id,
  type: "move",
  path,
  target: { q: q_deg.map(radians), tool: "flange" },
  speed: { mps: 0.1 },
  blend_m: 0,
});
const on = (id: string, frame: string, z_m: number): MoveStep => ({
  id,
  type: "move",
  path: "lin",
  target: { pose: pose([0, 0, z_m], [0, 1, 0, 0]), frame, tool: "flange" },
  speed: { mps: 0.1 },
  blend_m: 0,
});
function written(...steps: Step[]): string {
  const emitted = fanucLs.emit(
    {
      ...emptyProgram(robot.id, "Fill tray"),
      steps,
      frames: { table: pose([0.3123456, -0.0512346, 0.2976543], [0.01, 0.02, 0.1, Math.sqrt(1 - 0.0105)]) },
      pallets: {
        tray: {
          frame: "table",
          origin: pose([0.01, 0.02, 0]),
          rowEnd: [0.07, 0.02, 0],
          columnEnd: [0.01, 0.05, 0],
          rows: 2,
          columns: 3,
          layers: 1,
          layer_m: 0,
        },
      },
    },
    robot,
  );
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  return emitted.files[0]!.text;
}
/** The record of a position, without the white space of its columns. */
const record = (text: string, n: number): string =>
  text
    .slice(text.indexOf(`P[${n}]{`))
    .split("};")[0]!
    .replace(/\s+/g, " ");

test("the numbers of CONFIG are the turns of axes 1, 4 and 6 in which a line arrives", () => {
  const turns = (from: readonly number[], to: readonly number[]): unknown =>
    /CONFIG : '([^']*)'/.exec(record(written(joints("a", "ptp", from), joints("b", "lin", to)), 2))?.[1];
  // From −175° a line goes on to −185°, whatever was taught; −180° … 180° is the turn 0.
  expect(turns([0, 0, 0, -175, -60, 0], [0, 0, 0, 175, -60, 0])).toBe("N U T, 0, -1, 0");
  expect(turns([0, 0, 0, 175, -60, 0], [0, 0, 0, -175, -60, 0])).toBe("N U T, 0, 1, 0");
  expect(turns([0, 0, 0, 0, -60, -175], [0, 0, 0, 0, -60, 175])).toBe("N U T, 0, 0, -1");
  expect(turns([0, 0, 0, 0, -60, 175], [0, 0, 0, 0, -60, -175])).toBe("N U T, 0, 0, 1");
  expect(turns([0, 0, 0, 20, -60, 30], [0, 0, 0, -20, -60, -30])).toBe("N U T, 0, 0, 0");
});

const home = joints("h", "ptp", [0, 0, 0, 0, -90, 0]);

test("a point over the places of a pallet is written as it was taught, from the first place, whatever the digits of the frame", () => {
  const text = written(home, { id: "pal", type: "pallet", pallet: "tray", steps: [on("over", "tray", 0.05)] });
  expect(record(text, 2)).toContain(
    "X = 10.000 mm, Y = 20.000 mm, Z = 50.000 mm, W = 180.000 deg, P = 0.000 deg, R = 180.000 deg",
  );
});

test("behind the loops of a pallet the frame and the tool are said anew", () => {
  const lines = written(
    home,
    { id: "pal", type: "pallet", pallet: "tray", steps: [on("over", "tray", 0.05)] },
    on("x", "table", 0.2),
  )
    .split("\r\n")
    .map(line => line.replace(/^ *[0-9]+: */, ""));
  expect(lines.slice(lines.indexOf("ENDFOR ;"), lines.indexOf("/POS"))).toEqual([
    "ENDFOR ;",
    "ENDFOR ;",
    "ENDFOR ;",
    "UFRAME_NUM=1 ;",
    "UTOOL_NUM=1 ;",
    "L P[3] 100mm/sec FINE    ;",
  ]);
});

test("registers carry the names of what they hold; CNT is a share of the shorter half of both ways", () => {
  const text = written(
    home,
    on("a", "table", 0.1),
    { ...on("b", "table", 0.2), blend_m: 0.02 },
    { ...on("c", "table", 0.3), blend_m: 0, blend_ratio: 0.3 },
    on("d", "table", 0.2),
  );
  for (const line of [
    "PR[1:flange]=LPOS ;",
    "UTOOL[1]=PR[1:flange] ;",
    "PR[11:table]=LPOS ;",
    "UFRAME[1]=PR[11:table] ;",
  ])
    expect(text).toContain(`  ${line}\r\n`);
  // 20 mm of the 50 mm that are half of either way.
  expect(text.match(/(?:FINE|CNT\d+)(?= +;)/g)).toEqual(["FINE", "FINE", "CNT40", "CNT30", "FINE"]);
});
