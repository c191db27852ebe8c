import type { CommandOutcome, Refusal, Robot, Scheduler } from "@twincell/core";
import { Execution, type AdapterMotion } from "../../driver/index.ts";
import { stopped } from "../../outcomes.ts";
import { ADDED, COMMAND, ON, SERVICE, word, type PulseScale } from "../codec/index.ts";
import type { Client, Question } from "./client.ts";
import { cancelError, holdOff, holdOn, resetAlarm, sayHold, saySevered, servoOff, servoOn } from "./holds.ts";
import { commandOf, endOf } from "./motion.ts";
import type { RobotState } from "./state.ts";
import {
  endedEarly,
  jobPace,
  linkClosed,
  neverOn,
  noArc,
  noSoftness,
  notTaken,
  stands,
  standsBecause,
  wasStopped,
} from "./words.ts";

/** An order that must not be carried out twice is said once, and looked after before it is said again [s]. */
const ONCE_S = [0.3];
const MOST_TRIES = 3;
/**
 * Refusals that pass by themselves, as just after a stop: busy, still moving. Nothing was carried out, so it is said
 * again, so often.
 */
const PASSING: readonly number[] = [ADDED.moving, ADDED.busy, 0xd8f1, 0xd8fa];
const MOST_PASSING = 20;
/** From the acceptance of a motion until it must be seen running [s]; the drives may take so long to come on. */
const START_S = 0.3;
const SERVO_S = 5;
/** A robot that is not where it should end is looked at twice: states may be damaged on their way. */
const STANDS = 2;
/** A robot this near to the end is there [pulses of each axis as a part of a degree]. */
const THERE_DEG = 0.02;

interface Going {
  /** Null for a job. */
  readonly motion: AdapterMotion | null;
  readonly end: Int32Array | null;
  readonly resolve: (outcome: CommandOutcome) => void;
  /** waiting: to be told as soon as nothing holds the robot. asking: on its way. going: accepted. */
  phase: "waiting" | "asking" | "going";
  /** A job that was begun is started again, a motion told again. */
  accepted: boolean;
  acceptedPoll: number;
  acceptedAt_s: number;
  seenRunning: boolean;
  /** States in a row in which it stood. */
  standing: number;
}
export interface HandOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly scale: PulseScale;
  readonly state: RobotState;
}

const START: Omit<Question, "patience_s"> = {
  command: COMMAND.start,
  instance: 1,
  attribute: 1,
  service: SERVICE.setOne,
  data: word(ON),
};

/** Why no command of the server says that motion. */
export const unsayableMotion = (
  { path, acceleration }: Pick<AdapterMotion, "path" | "acceleration">,
  robot: Robot,
): Refusal | null => (path === "arc" ? noArc(robot) : acceleration < 1 ? noSoftness(robot) : null);

/**
 * The hand on the robot: one motion or one job at a time. A change of override stops a motion by a hold and tells it
 * again at the new speed: its targets are absolute, and a straight line goes on along itself.
 */
export class Hand extends Execution<Going> {
  override = 1;
  /** Drives were taken off from here and are not on again. */
  emergency = false;
  /** What the controller refused beside a motion, in words. */
  complaint = "";
  /** How often it was stopped: what takes several answers looks whether it still may go on. */
  stops = 0;
  private readonly options: HandOptions;
  private client: Client | null = null;
  private poll = 0;
  /** A hold of ours is on, or on its way; since which poll it is known to be. */
  private hold: { acknowledged: number } | null = null;
  private isLettingGo = false;
  private looks: (() => void)[] = [];

  constructor(options: HandOptions) {
    super();
    this.options = options;
  }

  take(client: Client): void {
    this.client = client;
  }
  beginPoll(): number {
    return ++this.poll;
  }

  /** The line is given up: with a motion under way a hold is its last word. */
  letDrop(): void {
    const { client, moving: going } = this;
    if (client && going) {
      sayHold(client);
      sayHold(client);
      this.hold = { acknowledged: 0 };
    }
    this.client = null;
    this.isLettingGo = false;
    this.settle({ kind: "stopped", why: linkClosed(this.options.robot) });
    for (const look of this.looks.splice(0)) look();
  }

  move(motion: AdapterMotion): Promise<CommandOutcome> {
    const { robot, scale } = this.options;
    const why = unsayableMotion(motion, robot);
    if (why) return refusal(why);
    return this.carryOut(motion, endOf(motion, scale));
  }
  /** The job that was selected, from its beginning to its end. @param stops  as they were when it was asked for. */
  runJob(stops: number): Promise<CommandOutcome> {
    if (stops !== this.stops) return Promise.resolve({ kind: "stopped", why: wasStopped(this.options.robot) });
    return this.override === 1 ? this.carryOut(null, null) : refusal(jobPace(this.options.robot));
  }

  stop(emergency: boolean): void {
    this.stops++;
    const { client, moving: going } = this;
    if (emergency) {
      this.emergency = true;
      if (client) {
        saySevered(client);
        void servoOff(client);
      }
    }
    if (going) this.ending ??= stopped(wasStopped(this.options.robot));
    this.grip();
  }

  setOverride(ratio: number): Refusal | null {
    const { moving: going } = this;
    if (going && going.motion === null && ratio !== 0 && ratio !== 1) return jobPace(this.options.robot);
    if (ratio === this.override) return null;
    this.override = ratio;
    if (ratio === 0 || (going && going.phase !== "waiting" && going.motion !== null)) this.grip();
    else this.goOn();
    return null;
  }

  async reset(): Promise<CommandOutcome> {
    const {
      client,
      options: { robot, scheduler, state },
    } = this;
    if (!client) return { kind: "refused", why: linkClosed(robot) };
    const { stops } = this;
    this.complaint = "";
    for (const [what, order] of [
      ["Resetting the alarm", resetAlarm],
      ["Cancelling the error", cancelError],
      ["Releasing the hold", holdOff],
      ["Turning the servo power on", servoOn],
    ] as const) {
      if (order === holdOff && this.override === 0) continue;
      const answer = await order(client);
      if (stops !== this.stops) return { kind: "refused", why: wasStopped(robot) };
      if (answer.kind === "silent" || answer.reply.status !== 0)
        return { kind: "refused", why: notTaken(what, answer) };
      if (order === holdOff) this.hold = null;
    }
    for (const from_s = scheduler.now_s(); scheduler.now_s() - from_s < SERVO_S && this.client === client; ) {
      await this.nextLook();
      if (stops !== this.stops) return { kind: "refused", why: wasStopped(robot) };
      if (!state.status.servo) continue;
      this.emergency = false;
      this.goOn();
      return { kind: "done" };
    }
    return { kind: "refused", why: neverOn(robot, SERVO_S) };
  }

  /** A state came, whose questions began with that poll. */
  look(poll: number): void {
    for (const look of this.looks.splice(0)) look();
    const { status } = this.options.state;
    const { hold, moving: going } = this;
    if (hold && hold.acknowledged !== 0 && poll > hold.acknowledged && !status.running) {
      this.stood();
      return;
    }
    if (going?.phase !== "going" || poll <= going.acceptedPoll) return;
    if (status.running) {
      going.seenRunning = true;
      going.standing = 0;
      return;
    }
    if (hold) return;
    const isOver = ++going.standing >= STANDS;
    const because = standsBecause(status);
    const robot = this.options.robot;
    if (going.motion !== null && this.isThere(going)) this.settle({ kind: "done" });
    else if (!isOver) return;
    else if (going.motion === null && going.seenRunning && because === undefined) this.settle({ kind: "done" });
    else if (
      going.seenRunning ||
      because !== undefined ||
      this.options.scheduler.now_s() - going.acceptedAt_s > START_S
    ) {
      this.settle(
        going.motion === null && because === undefined
          ? { kind: "done" }
          : {
              kind: "stopped",
              why: because === undefined ? endedEarly(robot) : stands(robot, this.options.state.alarm || because),
            },
      );
    }
  }

  private carryOut(motion: AdapterMotion | null, end: Int32Array | null): Promise<CommandOutcome> {
    if (!this.client) return refusal(linkClosed(this.options.robot));
    this.complaint = "";
    // One that was stopped and has not been let go of yet.
    this.settle({ kind: "stopped", why: wasStopped(this.options.robot) });
    return this.execute(
      resolve => ({
        motion,
        end,
        resolve,
        phase: "waiting",
        accepted: false,
        acceptedPoll: 0,
        acceptedAt_s: 0,
        seenRunning: false,
        standing: 0,
      }),
      () => {
        this.goOn();
      },
    );
  }

  /** Tells what waits, when nothing holds the robot; lets go of a hold that has done its work. */
  private goOn(): void {
    const { moving: going, hold } = this;
    if (this.isLettingGo || this.emergency) return;
    if (hold) {
      if (hold.acknowledged === 0 && this.client && going?.phase === "waiting") {
        this.grip();
        return;
      }
      if (
        hold.acknowledged !== 0 &&
        this.override > 0 &&
        !this.options.state.status.running &&
        (going === null || going.phase === "waiting")
      )
        void this.letGo();
      return;
    }
    if (going?.phase === "waiting" && this.override > 0) void this.tell(going);
  }

  /** Says an order that must not be carried out twice: after silence the robot is looked at before it is said again. */
  private async tell(going: Going): Promise<void> {
    const {
      client,
      options: { robot, scale, state, scheduler },
    } = this;
    const command = going.motion ? commandOf(going.motion, robot, scale, this.override) : START;
    if (!client || !command) return;
    going.phase = "asking";
    for (let tries = 1, passed = 0; ; tries++) {
      const answer = await client.ask({ ...command, patience_s: ONCE_S });
      if (this.moving !== going || this.client !== client) return;
      const isTaken = answer.kind === "answer" && answer.reply.status === 0;
      if (answer.kind === "silent") {
        await this.nextLook();
        await this.nextLook();
        if (this.moving !== going || this.client !== client) return;
      }
      if (
        isTaken ||
        (answer.kind === "silent" && (state.status.running || (going.end !== null && this.isThere(going))))
      ) {
        Object.assign(going, {
          phase: "going",
          accepted: true,
          acceptedPoll: this.poll,
          acceptedAt_s: scheduler.now_s(),
          seenRunning: false,
          standing: 0,
        });
        return;
      }
      // A hold of ours was quicker: it is told again when the hold is let go.
      if (this.hold) {
        going.phase = "waiting";
        return;
      }
      if (answer.kind === "silent" && tries < MOST_TRIES) continue;
      if (answer.kind === "answer" && PASSING.includes(answer.reply.added) && passed++ < MOST_PASSING) {
        await this.nextLook();
        if (this.moving !== going || this.client !== client) return;
        continue;
      }
      this.settle({
        kind: going.accepted ? "stopped" : "refused",
        why: notTaken(going.motion ? "The motion" : "Starting the job", answer),
      });
      return;
    }
  }

  /** Holds the robot, ahead of whatever waits for its answer. */
  private grip(): void {
    const { client } = this;
    const hold = { acknowledged: 0 };
    this.hold = hold;
    if (!client) return;
    void holdOn(client).then(answer => {
      if (this.hold !== hold) return;
      if (answer.kind === "answer" && answer.reply.status === 0) hold.acknowledged = this.poll;
      else this.complaint = notTaken("The hold", answer).sentence;
    });
  }

  /** The robot stands under a hold of ours. */
  private stood(): void {
    const { moving: going } = this;
    if (going && going.phase === "going") going.phase = "waiting";
    if (this.emergency) {
      if (going) this.settle(this.ending ?? stopped(wasStopped(this.options.robot)));
      return;
    }
    if (this.override > 0 && !this.isLettingGo) void this.letGo();
    else if (going && this.ending) this.settle(this.ending);
  }

  private async letGo(): Promise<void> {
    const { client } = this;
    if (!client) return;
    this.isLettingGo = true;
    const held = this.hold;
    const answer = await holdOff(client);
    this.isLettingGo = false;
    if (this.client !== client || this.hold !== held) return;
    const { moving: going } = this;
    if (answer.kind === "silent" || answer.reply.status !== 0) {
      this.settle({ kind: "stopped", why: notTaken("Releasing the hold", answer) });
      return;
    }
    this.hold = null;
    if (going && this.ending) this.settle(this.ending);
    this.goOn();
  }

  private isThere({ end }: Going): boolean {
    const { state, scale } = this.options;
    return (
      end !== null &&
      scale.pulsesPerDegree.every(
        (perDegree, i) => Math.abs(state.position.axes[i]! - end[i]!) <= Math.max(3, THERE_DEG * Math.abs(perDegree)),
      )
    );
  }
  private nextLook(): Promise<void> {
    return new Promise(resolve => {
      if (this.client) this.looks.push(resolve);
      else resolve();
    });
  }
}

const refusal = (why: Refusal): Promise<CommandOutcome> => Promise.resolve({ kind: "refused", why });
