import {
  memoryNetwork,
  openRobotConnection,
  robotsOf,
  type DriverKind,
  type VendorConnection,
} from "@twincell/controllers";
import {
  emptyProgram,
  manualScheduler,
  seededRandom,
  type CommandOutcome,
  type ManualScheduler,
  type MoveStep,
  type Program,
  type Robot,
} from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { watched, type Watched } from "./watched.ts";

const HOST = "127.0.0.1";
const TICK_S = 0.004;
const BEAT_S = 0.02;
/** Of the one who commands: without a sign of life for so long the robot is stopped, as servers ask for it [s]. */
export const HEARTBEAT_S = 0.08;
/** A joint slower than this stands: a guided robot comes nearer to its target for ever [rad/s]. */
const STILL_RAD = 1e-3 * TICK_S;
/** So many seconds without a joint that turned, and the robot stands; a text may rest between two moves. */
export const STILL_S = 0.012;
export const RESTED_S = 0.6;
/** Rounding on the wire, in turns of a joint from one tick to the next. */
const TOO_FAST = 1.000001;
const WIRE_RAD = 1e-4;

export type Commander = ReturnType<VendorConnection["commander"]>;

/** A station as people have it, with its virtual controller, and everything that is measured about it. */
export interface Cell {
  readonly scheduler: ManualScheduler;
  readonly robot: Robot;
  readonly station: VendorConnection;
  readonly seat: Commander;
  readonly watched: Watched;
  readonly random: () => number;
  /** The station was told where its controller is, as of a real one; else it has started a virtual one beside it. */
  readonly isFar: boolean;
  /** The page that commands: asleep it says nothing. */
  page: { asleep: boolean; alive_s: number };
  stands(for_s?: number): boolean;
  /** Cycles in which a joint was faster than it may be. */
  readonly tooFast: number;
  /** Timers that run. */
  readonly timers: number;
  /** Lets time pass until that is so; the seconds it took, or Infinity. */
  until(so: () => boolean, most_s: number, step_s?: number): Promise<number>;
  /** Somewhere that takes about a second to reach. */
  target(): number[];
  program(): Program;
  close(): void;
}
export interface Pending {
  outcome: CommandOutcome | undefined;
}
export function pending(command: Promise<CommandOutcome>): Pending {
  const held: Pending = { outcome: undefined };
  void command.then(outcome => {
    held.outcome = outcome;
  });
  return held;
}

/** Counts what runs on it. */
function counted(scheduler: ManualScheduler): { readonly scheduler: ManualScheduler; readonly running: () => number } {
  let running = 0;
  return {
    running: () => running,
    scheduler: {
      ...scheduler,
      every(period_s, tick) {
        let on = true;
        running++;
        const stop = scheduler.every(period_s, tick);
        return () => {
          if (on) {
            on = false;
            running--;
          }
          stop();
        };
      },
    },
  };
}

/** Opens and connects a station of that brand with a robot of the library, on a clock and a network of its own. */
export async function openCell(brand: DriverKind, seed: number): Promise<Cell> {
  const random = seededRandom(seed);
  const { scheduler, running } = counted(manualScheduler());
  const isFar = random() < 0.5;
  const robots = robotsOf(brand).filter(({ arm }) => arm.joints.length === 6);
  const robot = robots[Math.floor(random() * robots.length)];
  const dialect = dialectById(brand.dialect);
  if (!robot || !dialect)
    throw new Error(`The library has no six-axis robot of ${brand.vendor}, or no language ${brand.dialect}.`);
  const seen = watched(brand, scheduler, random);
  const far = isFar ? memoryNetwork(scheduler, seed) : null;
  if (far) {
    const started = await seen.brand.virtual({
      robot,
      scheduler,
      network: far,
      host: HOST,
      interpret: text => dialect.interpret(text, robot),
    });
    if (started.kind === "taken") throw new Error(started.sentence);
  }
  const opened = await openRobotConnection({
    id: "soak",
    brand: seen.brand,
    robot,
    scheduler,
    dialect,
    heartbeat_s: HEARTBEAT_S,
    ...(far ? { at: { network: far, host: HOST, ports: seen.virtual.ports } } : {}),
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  const { virtual } = seen;
  const seat = station.commander("soak");
  const page = { asleep: false, alive_s: 0 };

  const limits = robot.arm.joints.map(({ limits: { speed_rad_s } }) => speed_rad_s * TICK_S * TOO_FAST + WIRE_RAD);
  const last_rad = virtual.jointAngles();
  const now_rad = last_rad.slice();
  let still = 0;
  let tooFast = 0;
  scheduler.every(TICK_S, () => {
    virtual.jointAngles(now_rad);
    let turned = 0;
    let fast = false;
    for (let i = 0; i < now_rad.length; i++) {
      const by = Math.abs(now_rad[i]! - last_rad[i]!);
      turned = Math.max(turned, by);
      fast ||= by > limits[i]!;
    }
    if (fast) tooFast++;
    still = turned < STILL_RAD ? still + 1 : 0;
    last_rad.set(now_rad);
  });
  scheduler.every(BEAT_S, () => {
    if (!page.asleep) {
      page.alive_s = scheduler.now_s();
      seat.alive();
    }
  });

  const cell: Cell = {
    scheduler,
    robot,
    station,
    seat,
    watched: seen,
    random,
    isFar,
    page,
    stands: (for_s = STILL_S) => still * TICK_S >= for_s - 1e-9,
    get tooFast() {
      return tooFast;
    },
    get timers() {
      return running();
    },
    async until(so, most_s, step_s = TICK_S) {
      const from_s = scheduler.now_s();
      while (!so() && scheduler.now_s() - from_s < most_s) await scheduler.elapse(step_s);
      return so() ? scheduler.now_s() - from_s : Infinity;
    },
    target: () =>
      robot.home_rad.map((q, i) => {
        const { lower_rad, upper_rad } = robot.arm.joints[i]!.limits;
        const by =
          i === 0 ? (virtual.jointAngles()[0]! > q ? -1 : 1) * (0.6 + 0.6 * random()) : i < 3 ? 0.1 * random() : 0;
        return Math.min(upper_rad - 0.05, Math.max(lower_rad + 0.05, q + by));
      }),
    program() {
      const move = (id: string): MoveStep => ({
        id,
        type: "move",
        path: "ptp",
        target: { q: cell.target() },
        speed: { ratio: 0.5 },
        blend_m: 0,
      });
      return {
        ...emptyProgram(robot.id),
        steps: [move("there"), { id: "rest", type: "wait", s: 0.1 }, move("on"), move("back")],
      };
    },
    close() {
      station.close();
      if (far) {
        virtual.close();
        far.close();
      }
    },
  };
  void station.connect();
  await cell.until(() => station.link?.state === "open", 20, 0.05);
  await scheduler.elapse(0.2);
  return cell;
}
