import {
  angleBetween,
  compose,
  distance,
  fromAxisAngle,
  multiply,
  rotate,
  unrolled,
  type Demonstration,
  type GridRule,
  type InferOptions,
  type InferredPallet,
  type Pose,
  type Quaternion,
  type Random,
  type SceneBox,
  type Vector3,
} from "../../../index.ts";

/** How unsure the hand is: how far it misses what it means at most, and the tremor of every sample (one deviation). */
export interface HandNoise {
  readonly misses_m: number;
  readonly tremor_m: number;
  readonly turns_rad: number;
}
export interface RandomPallet {
  readonly demonstration: Demonstration;
  readonly options: InferOptions;
  /** Where the tool is to be when it opens, at all nine places, in no order. */
  readonly wanted: readonly Pose<"world", "tcp">[];
  readonly picked: Pose<"world", "tcp">;
  readonly rules: readonly [GridRule, GridRule];
}

const RATE_HZ = 50;
const SIDE = 3;
const UP: Vector3 = [0, 0, 1];
const DOWN: Quaternion = [1, 0, 0, 0];
const PATTERNS = ["even", "edges", "middle", "end"] as const;

/**
 * Nine places, three by three, on a surface that stands anywhere and is turned anyhow; a part of random size in a
 * feeder; the hand shows two different places of the nine, drawn at random. One rule for both sides of the surface,
 * from a random corner where it is packed from an end; 20 to 160 mm of room beside the parts along each side.
 */
export function randomPallet(random: Random, noise: HandNoise, places: number | undefined): RandomPallet {
  const between = (low: number, high: number): number => low + (high - low) * random();
  const gauss = (): number => Math.sqrt(-2 * Math.log(1 - random())) * Math.cos(2 * Math.PI * random());
  const part_m: Vector3 = [between(0.05, 0.16), between(0.05, 0.16), between(0.04, 0.15)];
  const quarter = random() < 0.5 ? 0 : 1;
  const foot = quarter === 1 ? [part_m[1], part_m[0]] : [part_m[0], part_m[1]];
  const pattern = PATTERNS[Math.floor(random() * PATTERNS.length)]!;
  const lines = foot.map(wide => {
    const room = between(0.02, 0.16);
    const side = SIDE * wide + room;
    const start = -side / 2 + wide / 2;
    const gap = room / (SIDE + 1);
    if (pattern === "even") return { side, rule: "even", first: start + gap, pitch: wide + gap } as const;
    if (pattern === "edges") return { side, rule: "edges", first: start, pitch: (side - wide) / (SIDE - 1) } as const;
    if (pattern === "middle") return { side, rule: "middle", first: -wide, pitch: wide } as const;
    return random() < 0.5
      ? ({ side, rule: "low", first: start, pitch: wide } as const)
      : ({ side, rule: "high", first: start + room, pitch: wide } as const);
  });
  const [x, y] = [lines[0]!, lines[1]!];
  const size_m: Vector3 = [x.side, y.side, 0.144];
  const surface: SceneBox = {
    name: "Surface",
    worldFromBox: {
      position: [between(-1, 1), between(-1, 1), between(0.1, 0.6)],
      quaternion: fromAxisAngle(UP, between(-Math.PI, Math.PI)),
    },
    size_m,
  };
  const part: SceneBox = {
    name: "Part",
    worldFromBox: {
      position: [between(-1, 1), between(2, 3), between(0.3, 0.8)],
      quaternion: fromAxisAngle(UP, between(-Math.PI, Math.PI)),
    },
    size_m: part_m,
  };
  const partFromTcp: Pose<"box", "tcp"> = {
    position: [0, 0, part_m[2] / 2],
    quaternion: multiply(fromAxisAngle(UP, (Math.floor(random() * 4) * Math.PI) / 2), DOWN),
  };
  const picked = compose(part.worldFromBox, partFromTcp);
  const wanted = Array.from({ length: SIDE * SIDE }, (_, n) => {
    const at: Pose<"box", "part"> = {
      position: [
        x.first + (n % SIDE) * x.pitch,
        y.first + Math.floor(n / SIDE) * y.pitch,
        size_m[2] / 2 + part_m[2] / 2,
      ],
      quaternion: fromAxisAngle(UP, (quarter * Math.PI) / 2),
    };
    return compose(compose(surface.worldFromBox, at), partFromTcp as Pose<string, "tcp"> as Pose<"part", "tcp">);
  });
  const one = Math.floor(random() * 9);
  const other = (one + 1 + Math.floor(random() * 8)) % 9;

  const missed = (pose: Pose<"world", "tcp">): Pose<"world", "tcp"> => {
    const angle = 2 * Math.PI * random();
    const off = noise.misses_m * Math.sqrt(random());
    const [px, py, pz] = pose.position;
    return {
      position: [px + off * Math.cos(angle), py + off * Math.sin(angle), pz + noise.misses_m * (random() - 0.5)],
      quaternion: multiply(
        fromAxisAngle(rotate(pose.quaternion, [random(), random(), random()]), noise.turns_rad * (2 * random() - 1)),
        pose.quaternion,
      ),
    };
  };
  const above = ({ position: [px, py, pz], quaternion }: Pose<"world", "tcp">, by: number): Pose<"world", "tcp"> => ({
    position: [px, py, pz + by],
    quaternion,
  });
  const lift = between(0.06, 0.2);
  const times_s: number[] = [];
  const poses: Pose<"world", "tcp">[] = [];
  const closed: boolean[] = [];
  let now = above(picked, lift + 0.1);
  let grip = false;
  const go = (to: Pose<"world", "tcp">, took_s: number): void => {
    const from = now;
    const count = Math.max(2, Math.round(took_s * RATE_HZ));
    for (let i = 1; i <= count; i++) {
      const t = i / count;
      const s = t * t * (3 - 2 * t);
      times_s.push(times_s.length / RATE_HZ);
      poses.push({
        position: [0, 1, 2].map(
          k => from.position[k]! + s * (to.position[k]! - from.position[k]!) + noise.tremor_m * gauss(),
        ) as Vector3,
        quaternion: to.quaternion,
      });
      closed.push(grip);
    }
    now = to;
  };
  for (const place of [one, other]) {
    for (const [goal, closes] of [
      [missed(picked), true],
      [missed(wanted[place]!), false],
    ] as const) {
      go(above(goal, lift), between(0.6, 1.2));
      go(goal, between(0.5, 0.9));
      go(goal, between(0.2, 0.5));
      grip = closes;
      go(goal, between(0.2, 0.5));
      go(above(goal, lift), between(0.5, 0.9));
    }
  }
  return {
    demonstration: { times_s, worldFromTcp: poses, closed },
    options: {
      parts: [part],
      surfaces: [surface],
      places,
      tool: "gripper",
      flangeFromTcp: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
      robot: "kuka_kr6_2",
      name: "Shown",
    },
    wanted,
    picked,
    rules: [x.rule, y.rule],
  };
}

/** Lines of a program: every step is one, those inside others too. */
export const linesOf = (steps: InferredPallet["program"]["steps"]): number =>
  steps.reduce((sum, step) => sum + 1 + ("steps" in step ? linesOf(step.steps) : 0), 0);

/** How many of the wanted places the program opens the gripper at, within a distance and an angle. */
export function placesMet(
  { program }: InferredPallet,
  { wanted }: RandomPallet,
  within_m: number,
  within_rad: number,
): number {
  const opens: Pose<"world", "tcp">[] = [];
  let last: Pose<"world", "tcp"> | undefined;
  for (const step of unrolled(program)) {
    if (step.type === "gripper" && !step.closed && last) opens.push(last);
    if (step.type !== "move" || !("pose" in step.target)) continue;
    const { frame, pose } = step.target;
    last =
      frame === "world" ? (pose as Pose<string, "tcp"> as Pose<"world", "tcp">) : compose(program.frames[frame]!, pose);
  }
  return wanted.filter(({ position, quaternion }) =>
    opens.some(
      open => distance(open.position, position) <= within_m && angleBetween(open.quaternion, quaternion) <= within_rad,
    ),
  ).length;
}
