import {
  compose,
  emptyProgram,
  flangePose,
  inverse,
  pose,
  type Capability,
  type MoveStep,
  type Pallet,
  type Pose,
  type Program,
  type Robot,
  type Step,
} from "@twincell/core";

/**
 * Everything that is no plain move, as far as the language can say it: lines, loads, loops, decisions, calls, patterns
 * and searches.
 */
export function structuredProgram(
  robot: Robot,
  worldFromBase: Pose<"world", "base">,
  cannot: ReadonlySet<Capability>,
  pallet: Partial<Pallet> = {},
): Program {
  const home = [...robot.home_rad];
  const worldFromHome = compose(worldFromBase, flangePose(robot.arm, home));
  const near = (x: number, y: number, z: number): Pose<"world", "frame"> =>
    compose(worldFromHome, pose<"flange", "frame">([x, y, z]));
  const carton = near(0.02, 0.01, -0.05);
  const toTray: Pose = pallet.frame === "world" ? near(0, 0.02, 0) : compose(inverse(carton), near(0, 0.02, 0));
  const can = (...all: readonly Capability[]): boolean => all.every(each => !cannot.has(each));
  let count = 0;
  const id = (): { readonly id: string } => ({ id: `k${++count}` });
  const lin = (frame: string, at: Pose<"frame", "tcp">, more: Partial<MoveStep> = {}): MoveStep => ({
    ...id(),
    type: "move",
    path: "lin",
    target: { pose: at, frame, tool: "torch" },
    speed: { mps: 0.1 },
    blend_m: 0,
    ...more,
  });
  const ptp = (): MoveStep => ({
    ...id(),
    type: "move",
    path: "ptp",
    target: { q: home },
    speed: { ratio: 0.5 },
    blend_m: 0,
  });
  const steps: (Step | false)[] = [
    { ...ptp(), name: "Home" },
    can("set-digital") && { ...id(), type: "set", signal: "lamp", to: true },
    can("set-analogue") && { ...id(), type: "set", signal: "flowrate", to: 0.25 },
    can("pulse") && { ...id(), type: "set", signal: "lamp", to: true, pulse_s: 0.5 },
    can("payload") && { ...id(), type: "payload", mass_kg: 1.25, center_m: [0.01, 0, 0.05] },
    can("comment") && { ...id(), type: "comment", text: "Check the hand first" },
    can("message") && { ...id(), type: "message", text: "Cell is running" },
    can("wait-for") && { ...id(), type: "wait-for", when: { signal: "part", is: true } },
    can("wait-for", "timeout") && { ...id(), type: "wait-for", when: { signal: "part", is: false }, timeout_s: 5 },
    can("wait-for", "read-analogue") && { ...id(), type: "wait-for", when: { signal: "pressure", above: 2.5 } },
    can("acceleration") && { ...ptp(), acceleration: { ratio: 0.5 } },
    can("repeat") && {
      ...id(),
      name: "Shake",
      type: "repeat",
      times: 5,
      steps: [
        lin("carton", pose([0, 0, 0]), { blend_m: 0.002 }),
        lin("carton", pose([0.01, 0, 0])),
        { ...id(), type: "wait", s: 0.25 },
      ],
    },
    can("if") && {
      ...id(),
      type: "if",
      when: { signal: "part", is: true },
      then: [lin("carton", pose([0, 0.01, 0])), { ...id(), type: "gripper", closed: true }],
      else: [lin("world", compose(compose(pose<"frame", "world">(), near(0, 0, 0.01)), pose<"frame", "tcp">()))],
    },
    can("if", "read-analogue") && {
      ...id(),
      type: "if",
      when: { signal: "pressure", below: 1.5 },
      then: [{ ...id(), type: "wait", s: 1 }],
    },
    can("call") && { ...id(), type: "call", routine: "drop" },
    can("pallet") && {
      ...id(),
      name: "Fill",
      type: "pallet",
      pallet: "tray",
      steps: [
        lin("tray", pose([0, 0, -0.02]), { blend_m: 0.005 }),
        lin("tray", pose()),
        { ...id(), type: "gripper", closed: false },
        lin("tray", pose([0, 0, -0.02])),
      ],
    },
    can("search") &&
      lin("carton", pose([0, 0, 0.03]), { until: { when: { signal: "part", is: true }, missing: "fault" } }),
    can("call") && { ...id(), type: "call", routine: "drop" },
    ptp(),
    can("stop") && { ...id(), type: "stop" },
  ];
  return {
    ...emptyProgram(robot.id, "Palletise"),
    tools: { torch: pose([0, 0, 0.08]) },
    frames: { carton },
    signals: {
      lamp: { kind: "digital-out", address: 3 },
      part: { kind: "digital-in", address: 9 },
      flowrate: { kind: "analogue-out", address: 1 },
      pressure: { kind: "analogue-in", address: 1 },
    },
    pallets: {
      tray: {
        frame: "carton",
        origin: { position: [...toTray.position], quaternion: [...toTray.quaternion] },
        rowEnd: at(toTray, 0.04, 0),
        columnEnd: at(toTray, 0.002, 0.03),
        rows: 3,
        columns: 4,
        layers: 2,
        layer_m: -0.006,
        ...pallet,
      },
    },
    routines: can("call")
      ? { drop: [lin("carton", pose([0, 0, 0.02])), { ...id(), type: "gripper", closed: false }] }
      : {},
    steps: steps.filter(step => step !== false),
  };
}

const at = (toTray: Pose, x: number, y: number): [number, number, number] => [
  toTray.position[0] + x,
  toTray.position[1] + y,
  toTray.position[2],
];
