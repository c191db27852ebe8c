import { pose, type Vector3 } from "@twincell/core";
import type { ObjectRecord, StepsCell } from "../document.ts";
import { box, GRIPPER, pointed, SLOW, StepList, taskCell } from "./task-cell.ts";

const WOOD = "#b98a5a";
const STEEL = "#8a94a0";
const DARK = "#3d444b";
const WORK: { readonly mps: number } = { mps: 0.05 };
const OVER_M = 0.12;

const table = (x: number, y: number, size_m: Vector3): ObjectRecord =>
  box("table", "Table", "furniture", size_m, [x, y, 0], STEEL);

/** A part carried from one side of a table to the other. */
export function pickAndPlaceCell(): StepsCell {
  const from: Vector3 = [0.6, -0.25, 0.23];
  const to: Vector3 = [0.6, 0.25, 0.23];
  const over = ([x, y, z]: Vector3): Vector3 => [x, y, z + OVER_M];
  const { steps } = new StepList(GRIPPER.name)
    .to("Over the part", "ptp", over(from))
    .to("At the part", "lin", from)
    .grip(true)
    .to("Lift", "lin", over(from))
    .to("Over the place", "ptp", over(to))
    .to("At the place", "lin", to)
    .grip(false)
    .to("Leave", "lin", over(to));
  const part = box("part", "Part", "workpiece", [0.06, 0.06, 0.06], [from[0], from[1], 0.2], WOOD);
  return taskCell({
    name: "Pick and place",
    robot: "ur10e",
    foot_m: 0.1,
    tool: GRIPPER,
    objects: [table(0.6, 0, [0.4, 0.8, 0.2]), { ...part, mass_kg: 0.5, friction: 0.6 }],
    steps,
  });
}

/** Nine boxes from one place onto a pallet of three by three. */
export function palletOfNineCell(): StepsCell {
  const pick: Vector3 = [0.1, -0.95, 0.53];
  const { steps } = new StepList(GRIPPER.name)
    .to("Over the feeder", "ptp", [pick[0], pick[1], pick[2] + OVER_M])
    .to("At the box", "lin", pick)
    .grip(true)
    .to("Lift", "lin", [pick[0], pick[1], pick[2] + OVER_M])
    .to("Over the place", "ptp", [0, 0, 0.03 + OVER_M], undefined, "places")
    .to("At the place", "lin", [0, 0, 0.03], undefined, "places")
    .grip(false)
    .to("Leave", "lin", [0, 0, 0.03 + OVER_M], undefined, "places");
  return taskCell({
    name: "Pallet of nine",
    robot: "kuka_kr6_2",
    foot_m: 0.2,
    tool: GRIPPER,
    objects: [
      box("feeder", "Feeder", "fixture", [0.3, 0.3, 0.5], [pick[0], pick[1], 0], DARK),
      box("table", "Pallet", "furniture", [0.5, 0.5, 0.5], [0.95, 0.15, 0], STEEL),
    ],
    frames: { pallet: pose([0.82, 0.02, 0.5]) },
    pallets: {
      places: {
        frame: "pallet",
        origin: pose(),
        rowEnd: [0.26, 0, 0],
        columnEnd: [0, 0.26, 0],
        rows: 3,
        columns: 3,
        layers: 1,
        layer_m: 0.06,
      },
    },
    steps: [{ id: "p", type: "pallet", pallet: "places", steps }],
  });
}

/** A lap over four points, to be mirrored, taken over on the pendant and travelled back in the history. */
export function twinLapCell(): StepsCell {
  const tool = pointed("pointer", 0.12);
  const { steps } = new StepList(tool.name)
    .to("First corner", "ptp", [0.4, -0.2, 0.45])
    .to("Second corner", "lin", [0.55, -0.2, 0.45], SLOW)
    .to("Third corner", "lin", [0.55, 0.2, 0.45], SLOW)
    .to("Fourth corner", "lin", [0.4, 0.2, 0.45], SLOW)
    .to("First corner again", "lin", [0.4, -0.2, 0.45], SLOW);
  return taskCell({
    name: "Twin of a GP8",
    robot: "yaskawa_gp8",
    foot_m: 0.3,
    tool,
    objects: [table(0.5, 0, [0.35, 0.6, 0.3])],
    steps,
  });
}

/** A raw part into the vice of a machine once the machine asks for it, and the start given. */
export function machineTendingCell(): StepsCell {
  const tray: Vector3 = [0.25, -0.45, 0.33];
  const vice: Vector3 = [0.5, 0.15, 0.36];
  const over = ([x, y, z]: Vector3): Vector3 => [x, y, z + OVER_M];
  const { steps } = new StepList(GRIPPER.name)
    .to("Over the tray", "ptp", over(tray))
    .to("At the raw part", "lin", tray)
    .grip(true)
    .to("Lift", "lin", over(tray))
    .waitFor("machine_ready")
    .to("Over the vice", "ptp", over(vice))
    .to("In the vice", "lin", vice)
    .set("clamp", true)
    .grip(false)
    .to("Out of the machine", "lin", over(vice))
    .set("start_cycle", true);
  return taskCell({
    name: "Machine tending",
    robot: "fanuc_lrmate200id",
    foot_m: 0.3,
    tool: GRIPPER,
    objects: [
      box("tray", "Tray", "fixture", [0.3, 0.2, 0.3], [tray[0], tray[1], 0], DARK),
      box("vice", "Vice", "fixture", [0.12, 0.12, 0.33], [vice[0], vice[1], 0], STEEL),
      box("machine", "Machine", "wall", [0.3, 0.9, 1.4], [0.95, 0.15, 0], DARK),
    ],
    signals: {
      machine_ready: { kind: "digital-in", address: 1 },
      clamp: { kind: "digital-out", address: 1 },
      start_cycle: { kind: "digital-out", address: 2 },
    },
    steps,
  });
}

/** The top edges of a block, one after the other, with a spindle that is switched on and off. */
export function deburringCell(): StepsCell {
  const tool = pointed("spindle", 0.14);
  const z = 0.35;
  const list = new StepList(tool.name)
    .to("Before the block", "ptp", [0.38, -0.08, z + 0.06])
    .set("spindle", true)
    .to("First corner", "lin", [0.38, -0.08, z], WORK)
    .to("Far corner, right", "lin", [0.5, -0.08, z], WORK)
    .to("Far corner, left", "lin", [0.5, 0.08, z], WORK)
    .to("Near corner, left", "lin", [0.38, 0.08, z], WORK)
    .to("First corner again", "lin", [0.38, -0.08, z], WORK)
    .to("Off the block", "lin", [0.38, -0.08, z + 0.06])
    .set("spindle", false);
  return taskCell({
    name: "Deburring",
    robot: "abb_irb120",
    foot_m: 0.3,
    tool,
    objects: [
      table(0.44, 0, [0.3, 0.4, 0.3]),
      box("block", "Block", "workpiece", [0.12, 0.16, 0.05], [0.44, 0, 0.3], WOOD),
    ],
    signals: { spindle: { kind: "digital-out", address: 1 } },
    steps: list.steps,
  });
}

/** Two parallel seams with the arc on along each. */
export function weldingCell(): StepsCell {
  const tool = pointed("torch", 0.2);
  const z = 0.52;
  const list = new StepList(tool.name, { ratio: 0.5 });
  for (const [name, y] of [
    ["First seam", -0.1],
    ["Second seam", 0.1],
  ] as const)
    list
      .to(`${name}, before`, "ptp", [0.8, y, z + 0.08])
      .to(`${name}, start`, "lin", [0.8, y, z], WORK)
      .set("arc", true)
      .to(`${name}, end`, "lin", [1.1, y, z], { mps: 0.01 })
      .set("arc", false)
      .to(`${name}, after`, "lin", [1.1, y, z + 0.08]);
  return taskCell({
    name: "Welding two seams",
    robot: "staubli_rx160",
    foot_m: 0.3,
    tool,
    objects: [
      table(0.95, 0, [0.6, 0.8, 0.5]),
      box("plate", "Plate", "workpiece", [0.4, 0.3, 0.02], [0.95, 0, 0.5], WOOD),
    ],
    signals: { arc: { kind: "digital-out", address: 1 } },
    steps: list.steps,
  });
}

/** Glue along three sides of a cover. */
export function gluingCell(): StepsCell {
  const tool = pointed("nozzle", 0.12);
  const z = 0.345;
  const list = new StepList(tool.name)
    .to("Before the cover", "ptp", [0.4, -0.1, z + 0.06])
    .to("Start of the bead", "lin", [0.4, -0.1, z], WORK)
    .set("glue", true)
    .to("Right corner", "lin", [0.55, -0.1, z], WORK)
    .to("Left corner", "lin", [0.55, 0.1, z], WORK)
    .to("End of the bead", "lin", [0.4, 0.1, z], WORK)
    .set("glue", false)
    .to("Off the cover", "lin", [0.4, 0.1, z + 0.06]);
  return taskCell({
    name: "Gluing a cover",
    robot: "mitsubishi_rv7fl",
    foot_m: 0.3,
    tool,
    objects: [
      table(0.475, 0, [0.35, 0.5, 0.3]),
      box("cover", "Cover", "workpiece", [0.2, 0.25, 0.04], [0.475, 0, 0.3], WOOD),
    ],
    signals: { glue: { kind: "digital-out", address: 1 } },
    steps: list.steps,
  });
}

/** A sensor shown to the four corners and the middle of a part; the robot says when to measure. */
export function inspectionCell(): StepsCell {
  const tool = pointed("camera", 0.1);
  const places: readonly (readonly [string, Vector3])[] = [
    ["Corner 1", [0.42, -0.1, 0.45]],
    ["Corner 2", [0.58, -0.1, 0.45]],
    ["Corner 3", [0.58, 0.1, 0.45]],
    ["Corner 4", [0.42, 0.1, 0.45]],
    ["Middle", [0.5, 0, 0.45]],
  ];
  const list = new StepList(tool.name);
  for (const [name, at_m] of places) list.to(name, "ptp", at_m).set("measure", true).set("measure", false);
  return taskCell({
    name: "Inspection at five points",
    robot: "kawasaki_rs007l",
    foot_m: 0.3,
    tool,
    objects: [table(0.5, 0, [0.4, 0.6, 0.3]), box("part", "Part", "workpiece", [0.2, 0.24, 0.05], [0.5, 0, 0.3], WOOD)],
    signals: { measure: { kind: "digital-out", address: 1 } },
    steps: list.steps,
  });
}

/** A line that begins in reach and ends beyond it: the check says from where on, and by how much. */
export function infeasibleLineCell(): StepsCell {
  const tool = pointed("pointer", 0.12);
  const { steps } = new StepList(tool.name)
    .to("Start of the line", "ptp", [0.9, -0.3, 0.7])
    .to("End of the line", "lin", [0.9, 3, 0.7], SLOW);
  return taskCell({
    name: "A line out of reach",
    robot: "lola_rl15_placeholder",
    foot_m: 0.3,
    tool,
    objects: [],
    steps,
  });
}
