import {
  memoryNetwork,
  openRobotConnection,
  prepareJob,
  robotsOf,
  clearOf,
  type CellDefinition,
  type DriverKind,
  type JobQuestion,
  type PreparedJob,
  type VendorConnection,
  type VendorVirtual,
} from "@twincell/controllers";
import {
  linkSolids,
  manualScheduler,
  samplePlan,
  seededRandom,
  type CellCollider,
  type CommandOutcome,
  type ManualScheduler,
  type Plan,
  type Robot,
} from "@twincell/core";
import { dialectById } from "@twincell/languages";
import { emptyCell, randomObjects, randomProgram, touching } from "./programs.ts";

const HOST = "127.0.0.1";
/** How often it is looked whether the arm touches anything, and how finely a plan is looked through [s]. */
const LOOK_S = 0.004;
/** Programs of one connection: few enough that one that failed is found again quickly. */
const PER_CONNECTION = 25;
const STRIDE = 7919;
const ENDS_S = 60;
/** What a connection declares that it cannot say, found out where the step is reached. */
const CANNOT_SAY = new Set(["yaskawa.arc", "fanuc.arc", "cs7.arc", "staubli.path"]);
/** Connections that can be told joint moves alone. */
const ONLY_JOINTS = new Set(["staubli"]);
/** Tries for objects that leave the robot room where it stands. */
const TRIES = 20;

export interface Failed {
  readonly seed: number;
  readonly program: number;
  readonly what: string;
}
export interface Soaked {
  readonly colliding: number;
  /** Of them: the arm touched something. */
  readonly touched: number;
  /** Of them: stopped by the guard, before the first contact that the plan has [s], at least. */
  readonly stopped: number;
  readonly clear: number;
  /** Of them: carried out to the end. */
  readonly ended: number;
  /** Neither: nearer than what is kept, without contact. The arm must not touch anything in these either. */
  readonly near: number;
  /** Turned down by planner, language or controller for what they are. */
  readonly refused: number;
  readonly failed: readonly Failed[];
  readonly outcomes: Readonly<Record<string, number>>;
  readonly seconds: number;
}

interface Station {
  readonly scheduler: ManualScheduler;
  readonly robot: Robot;
  readonly station: VendorConnection;
  readonly virtual: VendorVirtual;
  readonly asked: { question: (asked: JobQuestion) => PreparedJob };
  readonly close: () => void;
}

/** A connection of that driver to its virtual controller, which it started itself or which is at an address. */
async function open(kind: DriverKind, seed: number, random: () => number): Promise<Station> {
  const scheduler = manualScheduler();
  const robots = robotsOf(kind).filter(({ arm }) => arm.joints.length === 6);
  const robot = robots[Math.floor(random() * robots.length)]!;
  const dialect = dialectById(kind.dialect)!;
  let virtual: VendorVirtual | null = null;
  const seen: DriverKind = {
    ...kind,
    async virtual(options) {
      const started = await kind.virtual(options);
      if (started.kind === "started") ({ virtual } = started);
      return started;
    },
  };
  const far = random() < 0.5 ? memoryNetwork(scheduler, seed) : null;
  if (far) {
    // The controller that waits for an answer in each of its cycles stands on the same switch.
    far.weather.delay_s = kind.id === "kuka-rsi" ? 0 : 0.004 * random();
    await seen.virtual({
      robot,
      scheduler,
      network: far,
      host: HOST,
      interpret: text => dialect.interpret(text, robot),
    });
  }
  const asked = { question: (question: JobQuestion): PreparedJob => prepareJob(question) };
  const opened = await openRobotConnection({
    id: "soak",
    brand: seen,
    robot,
    scheduler,
    dialect,
    deadMan: false,
    readCell: document => ({ kind: "cell", cell: document as CellDefinition }),
    layOut: question => Promise.resolve(asked.question(question)),
    ...(far ? { at: { network: far, host: HOST, ports: virtual!.ports } } : {}),
  });
  if (opened.kind === "refused") throw new Error(opened.why.sentence);
  const { station } = opened;
  return {
    scheduler,
    robot,
    station,
    virtual: virtual!,
    asked,
    close() {
      station.close();
      if (far) {
        virtual!.close();
        far.close();
      }
    },
  };
}

/** Whether the plan touches anything, looked at every few milliseconds. */
function touches(plan: Plan, collider: CellCollider, joints: number): boolean {
  const q = new Float64Array(joints);
  for (let at_s = 0; at_s <= plan.duration_s; at_s += LOOK_S) {
    samplePlan(plan, at_s, q);
    if (collider.collides(q)) return true;
  }
  return false;
}

/**
 * Random programs among random objects, through the connection that people have, on a virtual clock; the check before
 * the run is switched off for those that it would not let pass: what keeps the arm from touching anything is the guard
 * alone.
 *
 * @param wanted  so many colliding and so many clear ones.
 */
export async function soak(
  kind: DriverKind,
  wanted: { readonly colliding: number; readonly clear: number },
  seed: number,
  now_ms: () => number,
): Promise<Soaked> {
  const begun_ms = now_ms();
  const counts = { colliding: 0, touched: 0, stopped: 0, clear: 0, ended: 0, near: 0, refused: 0 };
  const failed: Failed[] = [];
  const outcomes: Record<string, number> = {};
  for (let k = 0; counts.colliding < wanted.colliding || counts.clear < wanted.clear; k++) {
    const own = seed + STRIDE * k;
    const random = seededRandom(own);
    const connection = await open(kind, own, random);
    try {
      await programs(connection, ONLY_JOINTS.has(kind.id), random, wanted, counts, outcomes, (program, what) =>
        failed.push({ seed: own, program, what }),
      );
    } finally {
      connection.close();
    }
  }
  return { ...counts, failed, outcomes, seconds: Math.round((now_ms() - begun_ms) / 100) / 10 };
}

type Counts = Record<"colliding" | "touched" | "stopped" | "clear" | "ended" | "near" | "refused", number>;

async function programs(
  { scheduler, robot, station, virtual, asked }: Station,
  onlyJoints: boolean,
  random: () => number,
  wanted: { readonly colliding: number; readonly clear: number },
  counts: Counts,
  outcomes: Record<string, number>,
  fail: (program: number, what: string) => void,
): Promise<void> {
  const joints = robot.arm.joints.length;
  const until = async (so: () => boolean, most_s: number): Promise<boolean> => {
    const end_s = scheduler.now_s() + most_s;
    while (!so() && scheduler.now_s() < end_s) await scheduler.elapse(0.02);
    return so();
  };
  const ended = async (command: Promise<CommandOutcome>): Promise<CommandOutcome | null> => {
    let outcome: CommandOutcome | null = null;
    void command.then(is => {
      outcome = is;
    });
    await until(() => outcome !== null, ENDS_S);
    return outcome;
  };
  const bare = emptyCell(robot, random);
  let collider = touching(bare, robot);
  const q = new Float64Array(joints);
  const before = new Float64Array(joints);
  let contact = "";
  const look = scheduler.every(LOOK_S, () => {
    virtual.jointAngles(q);
    if (q.every((angle, i) => angle === before[i])) return;
    before.set(q);
    if (contact === "" && collider.collides(q)) {
      const [first] = collider.check(q);

      contact = `${first?.a} touches ${first?.b}`;
    }
  });

  void station.connect();
  if (!(await until(() => station.link?.state === "open", 20))) throw new Error("It was never connected.");
  await scheduler.elapse(0.2);
  const seat = station.commander("soak");
  seat.acquireLease();
  for (let i = 1; i <= PER_CONNECTION; i++) {
    if (counts.colliding >= wanted.colliding && counts.clear >= wanted.clear) break;
    const from_rad = station.controller.jointAngles().slice();
    const wantsContact = random() < 0.5;
    let program = randomProgram(robot, from_rad, onlyJoints, random);
    let cell = bare;
    let hasRoom = false;
    for (let tries = 0; tries < TRIES && !hasRoom; tries++) {
      if (tries > 0) program = randomProgram(robot, from_rad, onlyJoints, random);
      cell = { ...bare, objects: randomObjects(robot, from_rad, program, wantsContact, random) };
      hasRoom = clearOf({ ...cell, links: linkSolids(robot) }, robot).isSafe(from_rad);
    }
    if (!hasRoom) break;
    station.setCell(cell);
    collider = touching(cell, robot);
    contact = "";
    let sort = "refused" as "colliding" | "clear" | "near" | "refused";
    asked.question = question => {
      const job = prepareJob(question);
      if (job.plan) {
        sort = touches(job.plan, collider, joints) ? "colliding" : job.bad.length === 0 ? "clear" : "near";
      }
      return sort === "clear" ? job : { ...job, bad: [], findings: [] };
    };
    const asText = random() < 0.5;
    const outcome = await ended(station.run(seat, program, asText));
    const said =
      outcome === null ? "no end" : outcome.kind === "done" ? "done" : `${outcome.kind}, ${outcome.why.code}`;
    await until(() => station.guard.state.motion === "at-rest", ENDS_S);
    await scheduler.elapse(0.3);
    if (outcome?.kind === "refused" || (outcome?.kind === "stopped" && CANNOT_SAY.has(outcome.why.code)))
      sort = "refused";
    counts[sort]++;
    const how = `${sort}${asText ? " text" : ""}: ${said}`;
    outcomes[how] = (outcomes[how] ?? 0) + 1;
    if (contact !== "") {
      counts.touched++;
      fail(i, `${robot.id} ${how}; ${contact}`);
    }
    if (sort === "colliding" && said === "stopped, guard.clearance") counts.stopped++;
    if (sort === "clear") {
      if (said === "done") counts.ended++;
      else fail(i, `${robot.id} ${how}`);
    }
    if (contact !== "" || said === "no end") break;
    seat.acknowledge();
    await until(() => station.guard.state.motion === "at-rest", ENDS_S);
    // Drives that went off for a reason of their own are another soak's: a new connection begins.
    if (said.includes("safety.") || station.guard.state.trip !== "none" || station.guard.state.link !== "up") break;
  }
  look();
}
