import {
  PALLET_ORDERS,
  branchOf,
  compose,
  emptyProgram,
  flangePose,
  identity,
  inverse,
  palletSlots,
  seededRandom,
  solveAll,
  type Capability,
  type Condition,
  type MoveStep,
  type Pallet,
  type PalletStep,
  type Pose,
  type Program,
  type Quaternion,
  type Random,
  type Robot,
  type SignalLine,
  type Speed,
  type Step,
  type Target,
} from "@twincell/core";

export interface ProgramChoices {
  readonly seed: number;
  readonly steps: number;
  readonly worldFromBase: Pose<"world", "base">;
  readonly paths: readonly MoveStep["path"][];
  /** What the language lacks. */
  readonly cannot?: readonly Capability[];
  /** What else the programs may ask for; plain points, waits and gripper actions when left out. */
  readonly can?: ReadonlySet<Capability>;
  /** Lines by the names and numbers that the language has. */
  readonly signals?: Program["signals"];
  /** Whether targets ask for a posture by its name. */
  readonly branches?: boolean;
}

/** Lines with numbers that a language may use; outputs and inputs of most controllers are apart. */
export const SIGNALS: Program["signals"] = {
  lamp: { kind: "digital-out", address: 5 },
  "Blow off": { kind: "digital-out", address: 6 },
  part: { kind: "digital-in", address: 1003 },
  tray_full: { kind: "digital-in", address: 1004 },
  level: { kind: "analogue-in", address: 1 },
  valve: { kind: "analogue-out", address: 2 },
};

/**
 * A program whose every point the robot reaches: random postures, taught as joint angles or as poses of a tool in a
 * frame. Whatever the language can say beside points is mixed in: signals, loops, decisions, calls, pallets, comments.
 */
export function randomProgram(robot: Robot, choices: ProgramChoices): Program {
  const random = seededRandom(choices.seed);
  const made = new Maker(robot, random, choices);
  const steps = made.list(choices.steps, 0);
  const { tools, frames, pallets, routines } = made;
  const used = choices.can === undefined ? {} : { signals: choices.signals ?? SIGNALS, pallets, routines };
  return {
    ...emptyProgram(robot.id, `Prüfung No. ${choices.seed}`),
    tools,
    frames,
    groups: { g1: { name: "Edge 1" }, g2: { name: "Edge 2" } },
    ...used,
    steps,
  };
}

class Maker {
  readonly tools: Program["tools"];
  readonly frames: Program["frames"];
  readonly pallets: Record<string, Pallet> = {};
  readonly routines: Record<string, readonly Step[]> = {};
  private readonly robot: Robot;
  private readonly random: Random;
  private readonly choices: ProgramChoices;
  private count = 0;

  constructor(robot: Robot, random: Random, choices: ProgramChoices) {
    this.robot = robot;
    this.random = random;
    this.choices = choices;
    this.tools = { torch: randomPose(random, 0.2), "long tool (2)": randomPose(random, 0.4) };
    this.frames = { carton: randomPose(random, 1), "Drehtisch ä": randomPose(random, 2) };
  }

  /** @param depth  blocks around the list. */
  list(length: number, depth: number): readonly Step[] {
    const steps: Step[] = [];
    for (let i = 0; i < length; i++) {
      const { random } = this;
      const base = {
        id: `k${this.count++}`,
        ...(random() < 0.3 ? { name: `Point ${this.count}` } : {}),
        ...(random() < 0.4 ? { group: random() < 0.5 ? "g1" : "g2" } : {}),
      };
      const sort = random();
      if (sort < 0.08) steps.push({ ...base, type: "wait", s: Math.round(random() * 1000) / 100 });
      else if (sort < 0.16) steps.push({ ...base, type: "gripper", closed: random() < 0.5 });
      else steps.push((sort < 0.4 ? this.other(base, depth) : undefined) ?? this.move(base));
    }
    return steps;
  }

  private move(base: { readonly id: string }): MoveStep {
    const { random, robot, tools, frames } = this;
    const { worldFromBase, paths, can } = this.choices;
    const q = easyConfiguration(robot, random, EASE_M);
    const tool = pick(random, ["flange", ...Object.keys(tools)]);
    const frame = pick(random, ["world", ...Object.keys(frames)]);
    const worldFromTcp = compose(
      worldFromBase,
      compose(flangePose(robot.arm, q), tools[tool] ?? identity<"flange", "tcp">()),
    );
    const branch = random() < 0.5 && this.choices.branches !== false ? branchOf(robot, q) : undefined;
    const path = pick(random, paths);
    const speed = this.speed(path);
    const target: Target =
      random() < 0.4
        ? { q, ...(random() < 0.5 ? { tool } : {}) }
        : {
            pose: compose(inverse(frames[frame] ?? identity()), worldFromTcp),
            frame,
            tool,
            ...(branch === undefined ? {} : { branch }),
          };
    const passing = (by: string): Target => ({
      pose: compose(
        inverse(frames[frame] ?? identity()),
        compose(
          worldFromBase,
          compose(flangePose(robot.arm, beside(robot, q, random)), tools[by] ?? identity<"flange", "tcp">()),
        ),
      ),
      frame,
      tool: by,
    });
    return {
      ...base,
      type: "move",
      path,
      target,
      ...(path === "circ" ? { via: passing(target.tool ?? "flange") } : {}),
      speed,
      ...(can?.has("acceleration") === true && random() < 0.3
        ? { acceleration: { ratio: Math.ceil(20 + random() * 80) / 100 } }
        : {}),
      blend_m: random() < 0.5 ? 0 : 0.01,
    };
  }

  /** One of the steps that only some languages have; undefined where none fits. */
  private other(base: { readonly id: string }, depth: number): Step | undefined {
    const { random } = this;
    const { can } = this.choices;
    const kind = pick(random, OTHERS);
    if (can?.has(kind) !== true) return undefined;
    switch (kind) {
      case "set-digital": {
        const signal = this.line("digital-out");
        const to = random() < 0.5;
        // Some controllers pulse an output on and never off.
        return {
          ...base,
          type: "set",
          signal,
          to,
          ...(to && can.has("pulse") && random() < 0.5 ? { pulse_s: 0.5 } : {}),
        };
      }
      case "set-analogue":
        return { ...base, type: "set", signal: this.line("analogue-out"), to: Math.round(random() * 100) / 100 };
      case "wait-for":
        return {
          ...base,
          type: "wait-for",
          when: this.condition(),
          ...(can.has("timeout") && random() < 0.3 ? { timeout_s: 2.5 } : {}),
        };
      case "payload":
        return {
          ...base,
          type: "payload",
          mass_kg: Math.round(random() * 30) / 10,
          center_m: [0, 0, Math.round(random() * 100) / 1000],
        };
      case "message":
        return { ...base, type: "message", text: `Part ${this.count} is done.` };
      case "comment":
        return { id: base.id, type: "comment", text: `Comment ${this.count}` };
      case "call":
        return { ...base, type: "call", routine: this.routine(depth) };
      case "repeat":
        return depth >= DEEPEST
          ? undefined
          : { ...base, type: "repeat", times: pick(random, [1, 2, 3]), steps: this.list(3, depth + 1) };
      case "if":
        return depth >= DEEPEST
          ? undefined
          : {
              ...base,
              type: "if",
              when: this.condition(),
              then: this.list(2, depth + 1),
              ...(random() < 0.5 ? { else: this.list(2, depth + 1) } : {}),
            };
      case "pallet":
        return depth >= DEEPEST ? undefined : this.pallet(base);
    }
  }

  private speed(path: MoveStep["path"]): Speed {
    const drawn = randomSpeed(this.random);
    return "time_s" in drawn && (path === "circ" || this.choices.cannot?.includes("duration") === true)
      ? { mps: 0.1 }
      : drawn;
  }

  private line(kind: SignalLine["kind"]): string {
    return pick(
      this.random,
      Object.entries(this.choices.signals ?? SIGNALS).flatMap(([name, line]) => (line.kind === kind ? [name] : [])),
    );
  }

  private condition(): Condition {
    const { random } = this;
    if (this.choices.can?.has("read-analogue") === true && random() < 0.3)
      return random() < 0.5
        ? { signal: this.line("analogue-in"), above: 2.5 }
        : { signal: this.line("analogue-in"), below: 7 };
    return { signal: this.line("digital-in"), is: random() < 0.5 };
  }

  /** A routine that is there already, or a new one. */
  private routine(depth: number): string {
    const names = Object.keys(this.routines);
    // One that is being made would call itself.
    if (names.length > 0 && (depth > 0 || this.random() < 0.5)) {
      const ready = names.find(name => this.routines[name]!.length > 0);
      if (ready !== undefined) return ready;
    }
    const name = `Pick part ${names.length + 1}`;
    this.routines[name] = [];
    this.routines[name] = this.list(2, DEEPEST + 1).filter(step => step.type !== "call");
    return name;
  }

  /** A small pallet around a posture, every place of which that posture reaches. */
  private pallet(base: { readonly id: string }): PalletStep {
    const { random, robot } = this;
    const name = `Tray ${Object.keys(this.pallets).length + 1}`;
    let q: number[];
    let pallet: Pallet;
    do {
      q = easyConfiguration(robot, random, ROOM_M, 0.1);
      pallet = this.pattern(q);
    } while (!this.reachesAll(pallet, q));
    this.pallets[name] = pallet;
    const at = (z_m: number): MoveStep["target"] => ({
      pose: { position: [0, 0, z_m], quaternion: [0, 0, 0, 1] },
      frame: name,
      tool: "flange",
      ...(this.choices.branches === false ? {} : { branch: branchOf(robot, q)! }),
    });
    const move = (path: MoveStep["path"], z_m: number): MoveStep => ({
      id: `k${this.count++}`,
      type: "move",
      path,
      target: at(z_m),
      speed: this.speed(path),
      blend_m: 0,
    });
    const paths = this.choices.paths.filter(path => path === "ptp" || path === "lin");
    return {
      ...base,
      type: "pallet",
      pallet: name,
      steps: [
        move(pick(random, paths), -0.003),
        move(pick(random, paths), 0),
        { id: `k${this.count++}`, type: "gripper", closed: false },
      ],
    };
  }

  private pattern(q: readonly number[]): Pallet {
    const { random, robot, frames } = this;
    const { worldFromBase } = this.choices;
    const frame = pick(random, ["world", ...Object.keys(frames)]);
    const frameFromPlace = compose(
      inverse(frames[frame] ?? identity()),
      compose(worldFromBase, flangePose(robot.arm, q)),
    ) as Pose as Pose<"frame", "place">;
    const [x, y, z] = frameFromPlace.position;
    const order = pick(random, PALLET_ORDERS);
    const shifted = order.startsWith("rows") && random() < 0.4;
    return {
      frame,
      origin: frameFromPlace,
      rowEnd: [x + 0.004, y + 0.001, z],
      columnEnd: [x - 0.001, y + 0.003, z + 0.001],
      rows: pick(random, [1, 2, 3]),
      columns: pick(random, [2, 3]),
      layers: pick(random, [1, 2]),
      layer_m: 0.002,
      order,
      ...(shifted ? { interleave: "odd-rows-shifted" } : {}),
    };
  }

  /** Whether its places, and what lies 3 mm behind them, are reached in the posture of the first one and near to it. */
  private reachesAll(pallet: Pallet, q: readonly number[]): boolean {
    const { robot, frames } = this;
    const branch = branchOf(robot, q);
    if (branch === undefined) return true;
    return palletSlots(pallet).every(place =>
      [0, -0.003].every(z_m => {
        const worldFromFlange = compose(compose(frames[pallet.frame] ?? identity<"world", "frame">(), place) as Pose, {
          position: [0, 0, z_m],
          quaternion: [0, 0, 0, 1],
        });
        const reach = solveAll(
          robot,
          compose(inverse(this.choices.worldFromBase) as Pose, worldFromFlange) as Pose as Pose<"base", "flange">,
          { near: q, branch },
        );
        return (
          reach.kind === "reached" && reach.solutions[0]!.q_rad.every((angle, i) => Math.abs(angle - q[i]!) < NEAR_RAD)
        );
      }),
    );
  }
}

const OTHERS = [
  "set-digital",
  "set-analogue",
  "wait-for",
  "payload",
  "message",
  "comment",
  "call",
  "repeat",
  "if",
  "pallet",
] as const satisfies readonly Capability[];
const DEEPEST = 2;

/**
 * Joint angles a little inside the limits, with the arm not stretched: the text's resolution must not push them out of
 * reach.
 */
function easyConfiguration(robot: Robot, random: Random, ease_m: number, inside = 0.01): number[] {
  for (;;) {
    const q = robot.arm.joints.map(
      ({ limits: { lower_rad, upper_rad } }) =>
        lower_rad + (upper_rad - lower_rad) * (inside + (1 - 2 * inside) * random()),
    );
    // Other arms than these are not asked how far they are stretched, but whether there is room on every side.
    if (robot.family.kind !== "ortho-parallel") {
      if (hasRoom(robot, q, ease_m)) return q;
      continue;
    }
    // From the elbow itself: a wrist behind the shoulder is as far as one in front, seen from the elbow alone.
    const { c2_m, c3_m, a2_m, signs, offsets_rad } = robot.family;
    const k = Math.hypot(a2_m, c3_m);
    const bend = signs[2] * q[2]! - offsets_rad[2] + Math.atan2(a2_m, c3_m);
    const length_m = Math.sqrt(c2_m * c2_m + k * k + 2 * c2_m * k * Math.cos(bend));
    if (
      c2_m + k - length_m > ease_m &&
      length_m - Math.abs(c2_m - k) > ease_m &&
      (inside < 0.05 || Math.abs(Math.sin(q.at(-2)!)) > 0.3)
    )
      return q;
  }
}
function hasRoom(robot: Robot, q: readonly number[], ease_m: number): boolean {
  if (robot.family.kind === "general") return true;
  const { position, quaternion } = flangePose(robot.arm, q);
  const wanted = branchOf(robot, q)!;
  return [-1, 1].every(side =>
    [0, 1, 2].every(axis => {
      const moved: Pose<"base", "flange"> = { position: [...position], quaternion };
      moved.position[axis]! += side * ease_m;
      return solveAll(robot, moved, { near: q, branch: wanted }).kind === "reached";
    }),
  );
}
const EASE_M = 0.001;
const ROOM_M = 0.05;
/** No axis turns further between the places of a pallet [rad]. */
const NEAR_RAD = 0.3;

/** A posture near by, inside the limits. */
const beside = (robot: Robot, q: readonly number[], random: Random): number[] =>
  robot.arm.joints.map(({ limits: { lower_rad, upper_rad } }, i) =>
    Math.min(upper_rad, Math.max(lower_rad, q[i]! + 0.3 * (random() - 0.5))),
  );

function randomSpeed(random: Random): Speed {
  const sort = random();
  if (sort < 0.45) return { ratio: 0.01 + 0.99 * random() };
  return sort < 0.9 ? { mps: 0.005 + random() } : { time_s: 0.5 + 5 * random() };
}

const pick = <T>(random: Random, list: readonly T[]): T => list[Math.floor(random() * list.length)]!;

/** Quarter and half turns, where angle conventions are singular. */
const SPECIAL: readonly Quaternion[] = [
  [0, 0, 0, 1],
  [1, 0, 0, 0],
  [0, 0, Math.SQRT1_2, Math.SQRT1_2],
  [0, Math.SQRT1_2, 0, Math.SQRT1_2],
];

function randomPose<Into extends string, From extends string>(random: Random, size_m: number): Pose<Into, From> {
  const between = (): number => random() - 0.5;
  const q: Quaternion = random() < 0.3 ? pick(random, SPECIAL) : [between(), between(), between(), between()];
  const size = Math.hypot(...q);
  return {
    position: [between() * size_m, between() * size_m, between() * size_m],
    quaternion: [q[0] / size, q[1] / size, q[2] / size, q[3] / size],
  };
}
