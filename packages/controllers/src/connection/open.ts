import type { VendorVirtual } from "../driver/brand.ts";
import type { ControllerAdapter } from "../driver/adapter.ts";
import type { CellMember } from "../cell/shared-cell.ts";
import type { Cannot } from "../driver/cannot.ts";
import {
  falseIdentity,
  isOwnRobot,
  pose,
  samplePlan,
  unrolled,
  type CommandOutcome,
  type ConnectedRobot,
  type Dialect,
  type Plan,
  type Pose,
  type PreparedRun,
  type Program,
  type Refusal,
  type Robot,
  type Scheduler,
  type Signals,
  type Step,
  type RealController,
  robotFileOf,
} from "@twincell/core";
import {
  createRealController,
  drivesRobot,
  reachableSteps,
  stepsRefusal,
  type DriverKind,
  type ControllerData,
  type PortNumbers,
} from "../driver/index.ts";
import { memoryNetwork, type Network } from "../transport/index.ts";
import { withLines } from "../runner/index.ts";
import type { SharedCell } from "../cell/index.ts";
import { clearOf, type ClearOf, type Commander } from "../guard/index.ts";
import { LookAhead, pathBlocked } from "../twin/index.ts";
import { listeners } from "../listeners.ts";
import { DONE, refused } from "../outcomes.ts";
import { prepareJob, withLinks, type CellDefinition, type PrepareJob } from "./prepare-job.ts";
import { openVirtualPendant, type VirtualPendant, type VirtualPendantOpened } from "./virtual-pendant.ts";
import { createRobotConnection, type RobotConnection, type RobotJob } from "./connection.ts";
import { movedMeanwhile, noCell, stoppedMeanwhile } from "./words.ts";

/** A cell that was read from a document, or why it was not. */
export type CellRead =
  | { readonly kind: "cell"; readonly cell: CellDefinition }
  | { readonly kind: "refused"; readonly why: Refusal };

export interface OpenOptions {
  readonly id: string;
  readonly brand: DriverKind;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  /** The language its controllers run. */
  readonly dialect: Dialect;
  readonly name?: string;
  readonly worldFromBase?: Pose<"world", "base">;
  /** Where the controller is. Left out, a virtual one is started beside its driver, in memory. */
  readonly at?: {
    readonly network: Network;
    readonly host: string;
    readonly ports?: PortNumbers;
    readonly data?: ControllerData;
  };
  /**
   * The cell it shares with other robots, and where it stands there; `worldFromBase` is where its programs take it to
   * stand.
   */
  readonly shared?: { readonly cell: SharedCell; readonly stand: Pose<"world", "base"> };
  /** The document of the cell it works in: its objects and tool are what its guard keeps it from. */
  readonly cell?: unknown;
  /** Reads such a document for this robot. An app that gives none knows no cells, and one that is given is refused. */
  readonly readCell?: (document: unknown, robot: Robot, worldFromBase?: Pose<"world", "base">) => CellRead;
  readonly deadMan?: boolean;
  readonly heartbeat_s?: number;
  /** Opened to watch: whoever moves the robot is left alone, and from here it is not commanded. */
  readonly watching?: boolean;
  /** Who lays programs out; here and at once when left out, which keeps every link of this thread waiting. */
  readonly layOut?: PrepareJob;
}

/** A robot that turned no more than this meanwhile stands where its program was laid out from [rad]. */
const STANDS_RAD = 1e-3;

/** A station of a brand, and what a person can do at its cabinet where that is virtual. */
export interface VendorConnection extends RobotConnection, ConnectedRobot<Commander> {
  /** What is said of it. */
  readonly words: {
    readonly id: string;
    readonly name: string;
    readonly brand: string;
    readonly robot: string;
    readonly virtual: boolean;
    readonly watchdog: string;
    /** The robot file of a robot that is in no library, without its meshes: those who look on learn it from here. */
    readonly robotFile?: unknown;
  };
  /** null where a person stands before a real one. */
  readonly pendant: VirtualPendant | null;
  close(then?: () => void): void;
}
export type OpenedDriver =
  | { readonly kind: "opened"; readonly station: VendorConnection }
  | { readonly kind: "refused"; readonly why: Refusal };

const withoutMeshes = ({ links: _links, ...robot }: Robot): unknown => robotFileOf(robot);

/** Why a robot does not stand on a controller of that kind, by section and kinematics; null where it does. */
function otherRobot(kind: DriverKind, robot: Robot): Refusal | null {
  const wrong = falseIdentity(robot);
  if (wrong !== undefined)
    return {
      code: "station.other-robot",
      sentence: wrong,
      hint: "Give the file of the robot itself, with its own vendor section.",
    };
  if (drivesRobot(kind, robot)) return null;
  const drivers = robot.vendorSection?.drivers ?? [];
  return {
    code: "station.other-brand",
    sentence:
      robot.vendorSection === undefined
        ? `${robot.name} does not stand on a controller of ${kind.name}: its file has no vendor section.`
        : drivers.length === 0
          ? `${robot.name} does not stand on a controller of ${kind.name}.`
          : `${robot.name} does not stand on a controller of ${kind.name}; its drivers are ${drivers.join(", ")}.`,
    hint: `Choose another controller or another robot, or give its file a vendor section with the driver ${kind.id}.`,
  };
}

/** Opens a station of that brand. It is not connected yet. */
export async function openRobotConnection(options: OpenOptions): Promise<OpenedDriver> {
  const { brand, robot, worldFromBase } = options;
  const stranger = otherRobot(brand, robot);
  if (stranger !== null) return { kind: "refused", why: stranger };
  const readCell = (document: unknown): CellRead =>
    options.readCell?.(document, robot, worldFromBase) ?? { kind: "refused", why: readsNoCells };
  const read = options.cell === undefined ? null : readCell(options.cell);
  if (read?.kind === "refused") return read;
  const deaf = brand.cannot.find(({ row }) => row === "watch");
  if (deaf && options.watching === true) return cannotWatch(brand.name, deaf.because);
  const wire = options.at ? { ...options.at, virtual: null, close: null } : await virtualBeside(options);
  if ("kind" in wire) return wire;
  return { kind: "opened", station: vendorConnection(options, wire, readCell, read?.cell ?? null) };
}

/** The wire to a controller, and what is at its other end where that is virtual. */
interface Wire {
  readonly network: Network;
  readonly host: string;
  readonly ports?: PortNumbers;
  readonly data?: ControllerData;
  readonly virtual: Extract<VirtualPendantOpened, { kind: "opened" }> | null;
  readonly close: (() => void) | null;
}
/** A virtual controller in memory. */
async function virtualBeside(options: OpenOptions): Promise<Wire | Extract<OpenedDriver, { kind: "refused" }>> {
  const { brand, robot, scheduler, dialect, worldFromBase } = options;
  const network = memoryNetwork(scheduler);
  const host = "127.0.0.1";
  const started = await openVirtualPendant({
    brand,
    robot,
    scheduler,
    network,
    host,
    interpret: text => dialect.interpret(text, robot, worldFromBase),
  });
  if (started.kind === "taken") {
    network.close();
    return { kind: "refused", why: { code: "station.taken", sentence: started.sentence, hint: "Try it again." } };
  }
  return {
    network,
    host,
    ports: started.virtual.ports,
    virtual: started,
    close: () => {
      started.close();
      network.close();
    },
  };
}

function vendorConnection(
  options: OpenOptions,
  wire: Wire,
  readCell: (document: unknown) => CellRead,
  firstCell: CellDefinition | null,
): VendorConnection {
  return vendorConnectionOf(new VendorConnectionState(options, wire, readCell, firstCell));
}

class VendorConnectionState {
  readonly options: OpenOptions;
  readonly wire: Wire;
  readonly readCell: (document: unknown) => CellRead;
  readonly firstCell: CellDefinition | null;
  readonly brand: DriverKind;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly dialect: Dialect;
  readonly worldFromBase: Pose<"world", "base"> | undefined;
  readonly deaf: Cannot | undefined;
  cell: CellDefinition | null;
  readonly virtual: VendorVirtual | undefined;
  readonly virtualPendant: VirtualPendant | null;
  readonly name: string;
  isWatched: boolean;
  readonly adapter: ControllerAdapter;
  readonly controller: RealController;
  readonly place: CellMember | undefined;
  readonly station: RobotConnection;
  clear: ClearOf | null = null;
  /**
   * Whether objects are known that it must not touch; without a cell it is kept from itself alone, and that is said.
   */
  knowsCell: boolean;
  readonly notices = listeners<Refusal>();
  readonly unnotice: () => void;
  /** Stops that were asked for: a program that is still being planned then does not begin after it. */
  stops = 0;
  /** Where the program that runs, or ran last, ends. */
  #end_rad: Float64Array | null = null;

  constructor(
    options: OpenOptions,
    wire: Wire,
    readCell: (document: unknown) => CellRead,
    firstCell: CellDefinition | null,
  ) {
    this.options = options;
    this.wire = wire;
    this.readCell = readCell;
    this.firstCell = firstCell;
    this.brand = this.options.brand;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.dialect = this.options.dialect;
    this.worldFromBase = this.options.worldFromBase;
    this.deaf = this.brand.cannot.find(({ row }) => row === "watch");
    this.cell = this.firstCell;
    this.virtual = this.wire.virtual?.virtual;
    this.virtualPendant = this.wire.virtual?.cabinet ?? null;
    this.name = this.options.name ?? `${this.wire.virtual ? "Virtual " : ""}${this.robot.name}`;
    this.isWatched = this.options.watching === true;
    this.adapter = this.brand.face({
      robot: this.robot,
      scheduler: this.scheduler,
      network: this.wire.network,
      host: this.wire.host,
      ...(this.wire.ports ? { ports: this.wire.ports } : {}),
      ...(this.wire.data ? { data: this.wire.data } : {}),
      isWatched: () => this.isWatched,
    });
    this.controller = createRealController({
      face: this.adapter,
      scheduler: this.scheduler,
      name: this.name,
      ...(this.worldFromBase ? { worldFromBase: this.worldFromBase } : {}),
    });
    this.place = this.options.shared?.cell.join({
      id: this.options.id,
      name: this.name,
      robot: this.robot,
      worldFromBase: this.options.shared.stand,
      ...(this.virtual ? { brakingTime_s: this.virtual.brakingTime_s } : {}),
    });
    this.station = createRobotConnection({
      controller: this.controller,
      scheduler: this.scheduler,
      name: this.name,
      silence_s: () => this.adapter.stale_s,
      ...(this.place ? { place: this.place } : {}),
      ...(this.options.watching === undefined ? {} : { watching: this.options.watching }),
      ...(this.worldFromBase ? { worldFromBase: this.worldFromBase } : {}),
      ...(this.virtual ? { brakingTime_s: this.virtual.brakingTime_s } : {}),
      ...(this.options.heartbeat_s === undefined ? {} : { heartbeat_s: this.options.heartbeat_s }),
      deadMan: this.options.deadMan ?? this.wire.virtual === null,
    });
    this.keepClearOf(
      this.cell ?? {
        worldFromBase: this.worldFromBase ?? pose(),
        objects: [],
        allowedPairs: [],
        shapeError_m: this.robot.shapeError_m,
      },
    );
    this.knowsCell = this.options.cell !== undefined;
    this.unnotice = this.station.onNotice(why => {
      this.notices.call(why);
    });
  }

  keepClearOf(definition: CellDefinition): void {
    this.cell = definition;
    const before = this.clear;
    this.clear = clearOf(withLinks(definition, this.robot), this.robot);
    if (before) this.clear.goOnFrom(before);
    const { isSafe, contactsAt, gripper } = this.clear;
    const { flangeFromGrip } = definition;
    this.station.guard.setCell({
      isSafe,
      contactsAt,
      gripper,
      ...(flangeFromGrip ? { flangeFromTcp: flangeFromGrip as Pose as Pose<"flange", "tcp"> } : {}),
    });
  }

  /**
   * What of a program an open connection cannot be told step by step; null where it goes there as text, which its
   * language has been asked about.
   */
  unsayable(program: Program, asText: boolean): Refusal | null {
    if (!this.controller.isConnected || (asText && this.controller.runText)) return null;
    const terminal = terminalsOf(program, this.brand);
    return stepsRefusal(
      [...reachableSteps(program)].map(step => withLines(step, terminal)),
      this.controller,
    );
  }

  /**
   * The program with its plan from where the robot stands, what the check finds on it, and its text; or why it is not
   * sent.
   */
  async jobOf(
    program: Program,
    asText: boolean,
    from_rad?: Float64Array,
  ): Promise<
    | { readonly kind: "job"; readonly job: RobotJob; readonly stuck: Refusal | null }
    | { readonly kind: "refused"; readonly why: Refusal }
  > {
    const start_rad = from_rad ?? this.controller.jointAngles().slice();
    const held = this.clear?.held();
    const laid = await (this.options.layOut ?? (question => Promise.resolve(prepareJob(question))))({
      program,
      robot: this.robot,
      start_rad,
      ...(this.worldFromBase ? { worldFromBase: this.worldFromBase } : {}),
      ...(this.cell ? { cell: held ? { ...this.cell, held } : this.cell } : {}),
      ...(asText && this.controller.runText ? { dialect: this.dialect } : {}),
    });
    if (laid.unwritten) return { kind: "refused", why: laid.unwritten };
    if (!from_rad && this.controller.jointAngles().some((q, i) => Math.abs(q - start_rad[i]!) > STANDS_RAD))
      return { kind: "refused", why: movedMeanwhile(this.name) };
    const job: RobotJob = {
      program,
      steps: () => atTerminals(program, this.brand, this.controller.signals),
      findings: laid.findings,
      bad: laid.bad,
      carried: laid.carried,
      corners: laid.corners,
      ...(laid.plan ? { plan: laid.plan } : {}),
      ...(laid.files ? { files: laid.files } : {}),
    };
    return { kind: "job", job, stuck: laid.stuck };
  }

  /**
   * The first thing that keeps a planned program from being sent: a red finding that nobody has agreed to, or a robot
   * that stands in its way. With others in a common start, robots that stand now may move then.
   */
  blockedBy(
    { plan, findings = [], bad = [] }: RobotJob,
    despite: readonly string[],
    withOthers: boolean,
  ): Refusal | null {
    if (!plan) return null;
    const { blocked } = new LookAhead({
      name: this.name,
      plan,
      findings,
      bad: bad.filter(({ code }) => !despite.includes(code)),
      place: withOthers ? null : (this.place ?? null),
      joints: this.robot.arm.joints.length,
    }).preview();
    return blocked && !despite.includes(blocked.code) ? pathBlocked(blocked) : null;
  }

  /** While it runs the guard knows which parts the program takes, and where it puts them. */
  async carrying({ carried = [] }: RobotJob, go: () => Promise<CommandOutcome>): Promise<CommandOutcome> {
    this.clear?.begin(carried);
    try {
      return await go();
    } finally {
      this.clear?.end();
    }
  }

  async run(
    commander: Commander,
    program: Program,
    asText: boolean,
    despite: readonly string[],
  ): Promise<CommandOutcome> {
    const unsaid = this.unsayable(program, asText);
    if (unsaid) return refused(unsaid);
    const before = this.stops;
    const answer = await this.jobOf(program, asText);
    if (answer.kind === "refused") return answer;
    if (this.stops !== before) return refused(stoppedMeanwhile(this.name));
    // What cannot be planned cannot be checked: it is not sent to find out where it ends.
    if (answer.stuck) return refused(answer.stuck);
    const blocked = this.blockedBy(answer.job, despite, false);
    this.#end_rad = answer.job.plan ? endOf(answer.job.plan, this.robot) : null;
    return blocked ? refused(blocked) : this.carrying(answer.job, () => this.station.carryOut(commander, answer.job));
  }

  async judge(program: Program, asText: boolean, despite: readonly string[]): Promise<Refusal | null> {
    const unsaid = this.unsayable(program, asText);
    if (unsaid) return unsaid;
    const answer = await this.jobOf(program, asText, this.#end_rad ?? this.controller.jointAngles().slice());
    return answer.kind === "refused" ? answer.why : (answer.stuck ?? this.blockedBy(answer.job, despite, false));
  }

  async preview(program: Program): Promise<CommandOutcome> {
    const unsaid = this.unsayable(program, true);
    if (unsaid) return refused(unsaid);
    const answer = await this.jobOf(program, false);
    if (answer.kind === "refused") return answer;
    const {
      job: { plan, findings = [], bad = [] },
      stuck,
    } = answer;
    if (!plan) return refused(stuck!);
    const { blocked, told } = this.station.ahead.preview(plan, findings, bad);
    const first = blocked ?? told;
    return first
      ? refused({
          ...pathBlocked(first),
          hint: blocked
            ? "It would not be sent. Clear the way, or change the program."
            : "It would be sent all the same; this is only told.",
        })
      : DONE;
  }

  async prepare(
    commander: Commander,
    program: Program,
    asText: boolean,
    despite: readonly string[],
  ): Promise<PreparedRun> {
    const unsaid = this.unsayable(program, asText);
    if (unsaid) return { kind: "refused", why: unsaid };
    const before = this.stops;
    const answer = await this.jobOf(program, asText);
    if (answer.kind === "refused") return answer;
    if (this.stops !== before) return { kind: "refused", why: stoppedMeanwhile(this.name) };
    const why = answer.stuck ?? this.blockedBy(answer.job, despite, true);
    if (why) return { kind: "refused", why };
    const armed = await this.station.arm(commander, answer.job);
    return armed.kind === "armed" ? { ...armed, start: () => this.carrying(answer.job, () => armed.start()) } : armed;
  }
}

function vendorConnectionOf(own: VendorConnectionState): VendorConnection {
  const { virtualPendant } = own;
  return {
    ...own.station,
    words: {
      id: own.options.id,
      name: own.name,
      brand: own.brand.id,
      robot: own.robot.id,
      virtual: own.virtualPendant !== null,
      ...(isOwnRobot(own.robot) ? { robotFile: withoutMeshes(own.robot) } : {}),
      watchdog:
        own.adapter.watchdog.kind === "robot"
          ? `The robot stops by itself within ${Math.round(own.adapter.watchdog.within_s * 1000)} ms.`
          : `The robot does not stop by itself: ${own.adapter.watchdog.because}`,
    },
    pendant: own.virtualPendant,
    plug:
      virtualPendant &&
      (pulled => {
        void virtualPendant.act("", { do: "trouble", unplugged: pulled });
      }),
    async connect() {
      const outcome = await own.station.connect();
      if (outcome.kind === "done" && !own.knowsCell && !own.station.guard.state.watching)
        own.notices.call(noCell(own.name));
      return outcome;
    },
    onNotice: listen => own.notices.add(listen),
    get kept() {
      return { cell: own.knowsCell, kept_m: own.clear?.kept_m ?? 0 };
    },
    stop(emergency) {
      own.stops++;
      own.station.guard.stop(emergency);
    },
    setCell(document) {
      const read = own.readCell(document);
      if (read.kind === "refused") return read;
      own.keepClearOf(read.cell);
      own.knowsCell = true;
      return DONE;
    },
    async watch(commander, on) {
      const { state } = own.station.guard;
      if (on === state.watching) return DONE;
      if (own.deaf && on) return cannotWatch(own.brand.name, own.deaf.because);
      if (on) {
        const turned = commander.watch(true);
        if (turned.kind !== "done") return turned;
      }
      own.isWatched = on;
      const rejoined = await rejoin(own.station);
      return on ? rejoined : rejoined.kind === "done" ? commander.watch(false) : rejoined;
    },
    run: (commander, program, asText, despite = []) => own.run(commander, program, asText, despite),
    judge: (program, asText, despite = []) => own.judge(program, asText, despite),
    takes(program) {
      const why = own.unsayable(program, false);
      return why ? refused(why) : DONE;
    },
    preview: program => own.preview(program),
    prepare: (commander, program, asText, despite = []) => own.prepare(commander, program, asText, despite),
    close(then) {
      own.station.close(() => {
        own.unnotice();
        own.notices.clear();
        own.wire.close?.();
        then?.();
      });
    },
  };
}

/** What the lines of a program are called at the controller. */
const terminalsOf =
  (program: Program, brand: DriverKind) =>
  (name: string): string => {
    const line = program.signals[name];
    return (line?.address === undefined ? undefined : brand.terminal?.({ ...line, address: line.address })) ?? name;
  };
/**
 * The steps of a program as the wire takes them: lines with a number by the controller's own names for those, decisions
 * too.
 */
function* atTerminals(program: Program, brand: DriverKind, signals?: Signals): Generator<Step> {
  const terminal = terminalsOf(program, brand);
  const read = signals && {
    read: (name: string) => signals.read(terminal(name)),
    write: (name: string, value: boolean | number) => {
      signals.write(terminal(name), value);
    },
  };
  for (const step of unrolled(program, read)) yield withLines(step, terminal);
}

const readsNoCells: Refusal = {
  code: "station.no-cells",
  sentence: "A cell was given, and nothing here reads cells.",
  hint: "Open the robot without a cell, or use a program that reads them.",
};
const cannotWatch = (brand: string, because: string): { readonly kind: "refused"; readonly why: Refusal } => ({
  kind: "refused",
  why: {
    code: "station.no-watching",
    sentence: `Controllers of ${brand} cannot only be watched: ${because}`,
    hint: "Open it to command; it moves only when it is told to.",
  },
});

/** Posture at the end of a plan. */
function endOf(plan: Plan, robot: Robot): Float64Array {
  const q_rad = new Float64Array(robot.arm.joints.length);
  samplePlan(plan, plan.duration_s, q_rad);
  return q_rad;
}

/** Closes an open link and opens it again; resolves with the first state that comes over it. */
async function rejoin(station: RobotConnection): Promise<CommandOutcome> {
  if (station.link?.state !== "open") return DONE;
  // Whoever moves the robot is left alone: only the line is opened anew.
  if ("disconnect" in station.controller) station.controller.disconnect();
  const connected = await station.connect();
  if (connected.kind !== "done") return connected;
  return new Promise(resolve => {
    const offs = [
      station.onSample(() => {
        end(DONE);
      }),
      station.onLink(({ state, sentence }) => {
        if (state !== "open") end(refused({ code: "link.lost", sentence, hint: "Connect it, then try again." }));
      }),
    ];
    const end = (outcome: CommandOutcome): void => {
      for (const off of offs) off();
      resolve(outcome);
    };
  });
}
