import { emptyProgram, pose, robotById, type MoveStep, type Program } from "@twincell/core";
import { describe, expect, test } from "vitest";
import { vPlus } from "../index.ts";
import { proveText } from "../prove.ts";

const robot = robotById("staubli_rx90l")!;
const move = (id: string, target: MoveStep["target"]): MoveStep => ({
  id,
  type: "move",
  path: "lin",
  target,
  speed: { mps: 0.2 },
  blend_m: 0,
});
const onTray = (id: string, z: number): MoveStep =>
  move(id, {
    pose: { position: [0, 0, z], quaternion: [0, 0, 0, 1] },
    frame: "tray",
    tool: "flange",
    branch: { shoulder: "front", elbow: "up", wrist: "positive" },
  });
/** M-54: parts come on a conveyor and go to nine places of a table, for ever. */
const program: Program = {
  ...emptyProgram(robot.id, "Conveyor"),
  signals: { part: { kind: "digital-in", address: 1003 }, lamp: { kind: "digital-out", address: 5 } },
  pallets: {
    tray: {
      frame: "world",
      origin: pose([0.5, -0.1, 0.3], [1, 0, 0, 0]),
      rowEnd: [0.5, 0.1, 0.3],
      columnEnd: [0.6, -0.1, 0.3],
      rows: 3,
      columns: 3,
      layers: 1,
      layer_m: 0,
    },
  },
  routines: {
    pick: [
      { id: "w", type: "wait-for", when: { signal: "part", is: true } },
      { id: "g", type: "gripper", closed: true },
    ],
  },
  steps: [
    { ...move("ready", { q: [0, -1, 2, 0, 0.6, 0] }), path: "ptp" },
    {
      id: "forever",
      type: "repeat",
      times: "forever",
      steps: [
        { id: "c", type: "comment", text: "One tray" },
        {
          id: "t",
          type: "pallet",
          pallet: "tray",
          steps: [
            { id: "p", type: "call", routine: "pick" },
            onTray("over", -0.05),
            onTray("in", 0),
            { id: "o", type: "gripper", closed: false },
          ],
        },
        {
          id: "i",
          type: "if",
          when: { signal: "part", is: false },
          then: [
            { id: "s", type: "set", signal: "lamp", to: true },
            { id: "m", type: "message", text: "No part." },
            { id: "h", type: "stop" },
          ],
        },
      ],
    },
  ],
};
function textOf(it: Program): string {
  const emitted = vPlus.emit(it, robot);
  if (emitted.kind === "cannot") throw new Error(emitted.sentence);
  return emitted.files[0]!.text;
}

describe("structure in V+", () => {
  test("M-54 a pallet is loops, not nine copies; a call, a decision and signals keep their names", () => {
    const text = textOf(program);
    expect(text.match(/^ *MOVES? tray:/gm)?.length).toBe(2);
    for (const line of [
      "part = 1003",
      "WHILE TRUE DO",
      ";- One tray",
      "CALL pick()",
      "IF SIG(-part) THEN",
      "SIGNAL lamp",
      'TYPE "No part."',
      "HALT",
      ".PROGRAM pick() ;pick",
      "WAIT SIG(part)",
    ])
      expect(text).toContain(line);
    expect(text).toContain("SET tray = SHIFT(tray_0 BY n_3*0+n_2*50+n_1*0, n_3*100+n_2*0+n_1*0, n_3*0+n_2*0+n_1*0)");
    expect(proveText(vPlus, { name: "", text }, program, robot).kind).toBe("proven");
  });

  test("parsing keeps the structure: loops, pallet, routine, decision, signals", () => {
    const parsed = vPlus.parse(textOf(program), robot);
    if (parsed.kind !== "parsed") throw new Error(JSON.stringify(parsed.faults));
    expect(parsed.warnings).toEqual([]);
    expect(parsed.program).toMatchObject({
      signals: program.signals,
      routines: {
        pick: [
          { type: "wait-for", when: { signal: "part", is: true } },
          { type: "gripper", closed: true },
        ],
      },
      pallets: { tray: { rows: 3, columns: 3, layers: 1 } },
      steps: [
        { type: "move" },
        {
          type: "repeat",
          times: "forever",
          steps: [
            { type: "comment", text: "One tray" },
            {
              type: "pallet",
              steps: [
                { type: "call", routine: "pick" },
                { target: { frame: "tray" } },
                { target: { frame: "tray" } },
                {},
              ],
            },
            { type: "if", then: [{}, {}, { type: "stop" }] },
          ],
        },
      ],
    });
    const { rowEnd, columnEnd } = parsed.program.pallets.tray!;
    rowEnd.forEach((x, i) => {
      expect(x).toBeCloseTo(program.pallets.tray!.rowEnd[i]!, 6);
    });
    columnEnd.forEach((x, i) => {
      expect(x).toBeCloseTo(program.pallets.tray!.columnEnd[i]!, 6);
    });
  });

  test("loops that no neutral program has are executed and written down", () => {
    const parsed = vPlus.parse(".PROGRAM a()\nFOR i = 10 TO 30 STEP 10\nMOVE #PPOINT(i,-90,90)\nEND\n.END\n", robot);
    expect(parsed).toMatchObject({
      kind: "parsed",
      program: { steps: [{ type: "move" }, { type: "move" }, { type: "move" }] },
    });
    // The variable of the loop is used inside: three rounds are not the same.
    expect(vPlus.parse(".PROGRAM a()\nFOR i = 1 TO 3\nMOVE #PPOINT(i,-90,90)\nEND\n.END\n", robot)).toMatchObject({
      program: { steps: [{ type: "move" }, { type: "move" }, { type: "move" }] },
    });
    expect(
      vPlus.parse(".PROGRAM a()\nFOR i = 1 TO 3\nMOVE #PPOINT(5,-90,90)\nDELAY 1\nEND\n.END\n", robot),
    ).toMatchObject({
      program: { steps: [{ type: "repeat", times: 3, steps: [{ type: "move" }, { type: "wait" }] }] },
    });
  });

  test("a signal without a number, a place out of reach and what V+ cannot say stop the export and name the step", () => {
    const refusal = (it: Program): unknown => vPlus.emit(it, robot);
    expect(refusal({ ...program, signals: { ...program.signals, lamp: { kind: "digital-out" } } })).toMatchObject({
      kind: "cannot",
      step: "s",
      sentence: expect.stringContaining("lamp"),
    });
    expect(
      refusal({ ...program, pallets: { tray: { ...program.pallets.tray!, columnEnd: [1.6, -0.1, 0.3] } } }),
    ).toMatchObject({ kind: "cannot", step: "over", sentence: expect.stringMatching(/^Place [47] of 9: /) });
    expect(
      refusal({ ...program, steps: [{ id: "x", type: "set", signal: "lamp", to: true, pulse_s: 1 }] }),
    ).toMatchObject({ kind: "cannot", step: "x", sentence: "Step x asks for: pulse. V+ sets a signal and leaves it." });
  });

  test.each<[string, (text: string) => string]>([
    ["a round less", text => text.replace("TO 2\r\n", "TO 1\r\n")],
    ["a pitch with the wrong sign", text => text.replace("n_3*100", "n_3*(-100)")],
    ["rows for columns", text => text.replaceAll("n_3*", "n_9*").replaceAll("n_2*", "n_3*").replaceAll("n_9*", "n_2*")],
    ["a signal that goes off", text => text.replace("SIGNAL lamp", "SIGNAL -lamp")],
    ["another signal", text => text.replace("lamp = 5", "lamp = 6")],
    ["a decision the other way round", text => text.replace("SIG(-part)", "SIG(part)")],
    ["a lost call", text => text.replace(/ *CALL pick\(\)\r\n/, "")],
    ["a wait for the other state", text => text.replace("WAIT SIG(part)", "WAIT SIG(-part)")],
    ["a lost end", text => text.replace(/ *HALT\r\n/, "")],
  ])("a text with %s is not proven", (_name, spoil) => {
    const text = textOf(program);
    const spoilt = spoil(text);
    expect(spoilt).not.toBe(text);
    expect(proveText(vPlus, { name: "", text: spoilt }, program, robot).kind).not.toBe("proven");
  });
});
