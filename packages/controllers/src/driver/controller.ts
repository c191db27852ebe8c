import {
  explainReach,
  solveAll,
  type CommandOutcome,
  type EmittedFile,
  type UploadedProgram,
  type JointSample,
  type Pose,
  type RealController,
  type Refusal,
  type Scheduler,
  type Signals,
  type Step,
} from "@twincell/core";
import { listeners } from "../listeners.ts";
import {
  busy,
  closed,
  drivesOff,
  guardOpen,
  jointNumberRefusal,
  jointRefusal,
  manualMode,
  percentRefusal,
  programFault,
  protective,
  stoppedInReset,
} from "../refusals.ts";
import type { ControllerAdapter } from "./adapter.ts";
import { keepLink } from "./link.ts";
import { stepRefusal } from "./sayable.ts";
import { sendSteps } from "./steps.ts";
import { linkDown, notOpen, resetUnseen, wasStopped } from "./words.ts";
import { DONE, refused } from "../outcomes.ts";

export interface RealOptions {
  readonly face: ControllerAdapter;
  readonly scheduler: Scheduler;
  readonly name?: string;
  /** Where the robot stands in the cell; frames of a program are seen from the world. */
  readonly worldFromBase?: Pose<"world", "base">;
  /** Called once, before the first connection (row T-11). */
  readonly initialize?: () => void;
  /** Called with the target of every motion that is sent: the one primitive behind all moves (row T-12). */
  readonly onMotion?: (q_rad: ArrayLike<number>) => void;
}

type Lent = { -readonly [K in keyof JointSample]: JointSample[K] };
interface Command {
  readonly settle: (outcome: CommandOutcome) => void;
  stopping: Refusal | null;
  seenMoving: boolean;
  moves: boolean;
  step: string;
  over: boolean;
}

/** Longest time between the end of a reset and the first sample that says so [s]: drives and brakes take seconds. */
const RESET_SEEN_S = 20;
/** How often it is looked whether a reset was seen [s]. */
const RESET_LOOK_S = 0.01;

/** A stop is over when the robot says so this many times, should the answer to the motion itself be lost. */
const STANDS = 3;

/** What all drivers have in common, in front of one brand's face. Nothing here waits for the wire. */
export function createRealController(options: RealOptions): RealController {
  const { face: adapter, scheduler } = options;
  const { robot } = adapter;
  const n = robot.arm.joints.length;
  const name = options.name ?? `${adapter.brand} ${robot.name}`;
  const samples = listeners<JointSample>();
  const q_rad = Float64Array.from(robot.home_rad);
  const lent: Lent = {
    sequence: 0,
    time_s: 0,
    q_rad,
    moving: false,
    mode: "automatic",
    safety: "normal",
    override: 1,
    gripperClosed: false,
    step: "",
    message: "",
  };
  let command: Command | null = null;
  let isClosed = false;
  let said = "";
  let moving = false;
  let standing = 0;
  let override = 1;
  /** Stops so far, and emergency stops among them: a reset that began before one of them is over. */
  let stops = 0;
  let emergencies = 0;
  let resetting: Promise<CommandOutcome> | null = null;

  const link = keepLink(adapter, scheduler, name, {
    losing() {
      if (command) adapter.stop(false);
    },
    lost(why) {
      end({ kind: "stopped", why });
    },
    sample(sample) {
      q_rad.set(sample.q_rad);
      lent.sequence = sample.sequence;
      lent.time_s = sample.time_s;
      lent.mode = sample.mode;
      lent.safety = sample.safety;
      lent.override = sample.override;
      lent.gripperClosed = sample.gripperClosed;
      if (sample.signals) lent.signals = sample.signals;
      if (sample.target_rad) lent.target_rad = sample.target_rad;
      lent.message = sample.message === "" ? said : sample.message;
      lent.step = command?.step ?? "";
      if (command && sample.moving) command.seenMoving = true;
      moving = sample.moving;
      standing = moving ? 0 : standing + 1;
      lent.moving = isMoving();
      samples.call(lent);
      if (command?.stopping && standing >= STANDS) end({ kind: "stopped", why: command.stopping });
    },
  });

  function isMoving(): boolean {
    return moving || (command !== null && command.moves && !command.seenMoving && override > 0 && !command.stopping);
  }
  function end(outcome: CommandOutcome): void {
    const ended = command;
    command = null;
    if (!ended) return;
    ended.over = true;
    if (outcome.kind !== "done") said = outcome.why.sentence;
    ended.settle(outcome);
  }

  function unfit(): Refusal | null {
    if (isClosed) return closed(name);
    if (!link.isOpen) return link.report.state === "closed" ? notOpen(name) : linkDown(name, link.report.sentence);
    if (lent.safety === "emergency-stop") return drivesOff(robot);
    if (lent.safety === "protective-stop") return protective(lent.message);
    if (lent.safety === "guard-stop") return guardOpen(robot);
    if (lent.mode === "manual") return manualMode(robot);
    return command ? busy(robot) : null;
  }
  function refuse(why: Refusal): CommandOutcome {
    said = why.sentence;
    return refused(why);
  }

  /** One command at a time; its promise ends with the robot's own word, a stop, or the link. */
  function carryOut(body: (mine: Command) => Promise<CommandOutcome>): Promise<CommandOutcome> {
    said = "";
    return new Promise(resolve => {
      const mine: Command = { settle: resolve, stopping: null, seenMoving: false, moves: false, step: "", over: false };
      command = mine;
      body(mine).then(
        outcome => {
          if (command === mine)
            end(mine.stopping && outcome.kind !== "refused" ? { kind: "stopped", why: mine.stopping } : outcome);
        },
        // Steps may come from a running program text, and that may fault.
        (reason: unknown) => {
          if (command === mine) {
            adapter.stop(false);
            end({ kind: "stopped", why: programFault(reason) });
          }
        },
      );
    });
  }

  /** Everything that moves the robot move by move goes through here (rows T-12, T-13). */
  function send(steps: Iterable<Step>, context: Parameters<RealController["run"]>[1]): Promise<CommandOutcome> {
    const plan = options.worldFromBase ? { ...context, worldFromBase: options.worldFromBase } : context;
    return carryOut(mine =>
      sendSteps(steps, {
        robot,
        face: adapter,
        scheduler,
        signals,
        context: plan,
        measured_rad: () => q_rad.slice(),
        ended: () => mine.over || mine.stopping !== null,
        onStep(id) {
          mine.step = id;
        },
        onMessage(text) {
          said = text;
        },
        onMotion(target_rad) {
          mine.moves = true;
          mine.seenMoving = false;
          options.onMotion?.(target_rad);
        },
      }),
    );
  }
  async function moveRobotJoints(target_rad: ArrayLike<number>): Promise<CommandOutcome> {
    const why = unfit() ?? jointRefusal(robot, target_rad);
    if (why) return refuse(why);
    return send(
      [{ id: "", type: "move", path: "ptp", target: { q: Array.from(target_rad) }, speed: { ratio: 1 }, blend_m: 0 }],
      { tools: {}, frames: {} },
    );
  }

  /** Resolves when a sample says that the stop is over; why not, after the time is up or when the link went. */
  function stopCleared(wanted: () => boolean): Promise<Refusal | null> {
    const until_s = scheduler.now_s() + RESET_SEEN_S;
    const look = (): Refusal | "wait" | null => {
      if (isClosed) return closed(name);
      if (!link.isOpen) return linkDown(name, link.report.sentence);
      if (!wanted()) return stoppedInReset(robot);
      if (lent.safety !== "emergency-stop" && lent.safety !== "protective-stop") return null;
      return scheduler.now_s() >= until_s ? resetUnseen(robot, RESET_SEEN_S) : "wait";
    };
    return new Promise(resolve => {
      const first = look();
      if (first !== "wait") {
        resolve(first);
        return;
      }
      const cancel = scheduler.every(RESET_LOOK_S, () => {
        const now = look();
        if (now === "wait") return;
        cancel();
        resolve(now);
      });
    });
  }
  async function carryOutReset(): Promise<CommandOutcome> {
    if (!link.isOpen) return refuse(isClosed ? closed(name) : notOpen(name));
    said = "";
    const stopsBefore = stops;
    const emergenciesBefore = emergencies;
    const wanted = (): boolean => stops === stopsBefore;
    const outcome = await adapter.reset(wanted);
    // An order that was on its way when the stop came may have switched on what the stop had switched off.
    if (emergencies !== emergenciesBefore) adapter.stop(true);
    if (!wanted()) return refuse(stoppedInReset(robot));
    if (outcome.kind !== "done") return refuse(outcome.why);
    const why = await stopCleared(wanted);
    return why ? refuse(why) : DONE;
  }

  const signals: Signals = {
    read: signal => lent.signals?.get(signal) ?? false,
    write(signal, value) {
      const why = link.isOpen ? adapter.setSignal(signal, value) : notOpen(name);
      if (why) said = why.sentence;
    },
  };

  options.initialize?.();
  const { runText, handText } = adapter;
  return {
    kind: "real",
    name,
    robot,
    signals,
    watchdog: adapter.watchdog,
    link: link.report,
    get isConnected() {
      return link.isOpen;
    },
    connect: () => (isClosed ? Promise.resolve(refused(closed(name))) : link.open()),
    disconnect() {
      link.close();
    },
    onLink: listen => link.onChange(listen),
    onSample: listen => samples.add(listen),
    close() {
      if (isClosed) return;
      isClosed = true;
      link.close();
      end({ kind: "stopped", why: closed(name) });
      samples.clear();
    },
    isMoving,
    setSpeed(percent) {
      const why = percentRefusal(percent) ?? (link.isOpen ? adapter.setOverride(percent / 100) : unfit());
      if (why) return refuse(why);
      override = percent / 100;
      return DONE;
    },
    jointAngle: joint => q_rad[joint - 1] ?? NaN,
    jointAngles(out = new Float64Array(n)) {
      out.set(q_rad);
      return out;
    },
    async moveJoint(joint, angle_rad) {
      const why = jointNumberRefusal(robot, joint);
      if (why) return refuse(why);
      const target_rad = q_rad.slice();
      target_rad[joint - 1] = angle_rad;
      return moveRobotJoints(target_rad);
    },
    moveJoints: target_rad => moveRobotJoints(target_rad),
    moveToZero: () => moveRobotJoints(new Float64Array(n)),
    async moveToPose(baseFromFlange) {
      const reach = solveAll(robot, baseFromFlange, { near: q_rad });
      const nearest = reach.kind === "reached" ? reach.solutions[0] : undefined;
      if (!nearest)
        return refuse({
          code: `reach.${reach.kind}`,
          sentence: explainReach(reach),
          hint: "Choose a pose within reach.",
        });
      return moveRobotJoints(nearest.q_rad);
    },
    async run(steps, context) {
      const why = unfit();
      return why ? refuse(why) : send(steps, context);
    },
    cannotCarryOut: step => stepRefusal(step, adapter, robot),
    stop(emergency = false) {
      // Even when the link looks closed: a word too many does no harm.
      adapter.stop(emergency);
      stops++;
      if (emergency) emergencies++;
      if (!command) return;
      command.stopping ??= emergency ? drivesOff(robot) : wasStopped(robot);
      standing = 0;
    },
    reset() {
      resetting ??= carryOutReset().finally(() => {
        resetting = null;
      });
      return resetting;
    },
    ...(runText
      ? {
          async runText(files: readonly EmittedFile[]): Promise<CommandOutcome> {
            const why = unfit();
            return why
              ? refuse(why)
              : carryOut(mine => {
                  mine.moves = true;
                  return runText.call(adapter, files);
                });
          },
        }
      : {}),
    ...(handText
      ? {
          async handText(files: readonly EmittedFile[]): Promise<UploadedProgram> {
            const why = unfit();
            if (why) {
              said = why.sentence;
              return { kind: "refused", why };
            }
            const handed = await handText.call(adapter, files);
            if (handed.kind === "refused") {
              said = handed.why.sentence;
              return handed;
            }
            return {
              kind: "handed",
              drop: () => {
                handed.drop();
              },
              start() {
                const unready = unfit();
                if (unready) {
                  handed.drop();
                  return Promise.resolve(refuse(unready));
                }
                return carryOut(mine => {
                  mine.moves = true;
                  return handed.start();
                });
              },
            };
          },
        }
      : {}),
  };
}
