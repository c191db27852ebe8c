import type { EgmRobot } from "../codec/egm.ts";
import type { JointSample, OperatingMode, SafetyState, Robot, Scheduler } from "@twincell/core";
import type { ControllerAdapter, AdapterEvents, Opened } from "../../driver/index.ts";
import { COMM_TIMEOUT_S, EGM_STATE, MOTORS } from "../codec/index.ts";
import { createSetpointStream, type SetpointStreamOptions, type SetpointStream } from "./guide.ts";
import { linkClosed, noDrives, noLines, nobody, notStreamedBecause, otherAxes } from "./words.ts";

export interface AbbEgmAdapterOptions extends SetpointStreamOptions {
  readonly stale_s?: number;
}
type Lent = { -readonly [K in keyof Omit<JointSample, "step">]: JointSample[K] };

const STALE_S = 0.08;
const OPEN_S = 3;
const LOOK_S = 0.01;
const ANSWER_S = 0.1;

/**
 * A controller over Externally Guided Motion alone, as where Robot Web Services are not those of RobotWare 6: nothing
 * of it is switched from here.
 */
export function abbEgmAdapter(options: AbbEgmAdapterOptions): ControllerAdapter {
  return abbEgmAdapterOf(new EgmWire(options));
}

class EgmWire {
  readonly options: AbbEgmAdapterOptions;
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly host: string;
  readonly n: number;
  readonly guide: SetpointStream;
  readonly message: EgmRobot;
  readonly q_rad: Float64Array;
  readonly sample: Lent;
  events: AdapterEvents | null = null;
  severed = false;
  first: ((axes: number) => void) | null = null;

  constructor(options: AbbEgmAdapterOptions) {
    this.options = options;
    this.robot = this.options.robot;
    this.scheduler = this.options.scheduler;
    this.host = this.options.host;
    this.n = this.robot.arm.joints.length;
    this.guide = createSetpointStream(this.options);
    this.message = this.guide.message;
    this.q_rad = this.guide.q_rad;
    this.sample = {
      sequence: 0,
      time_s: 0,
      q_rad: this.q_rad,
      moving: false,
      mode: "remote",
      safety: "normal",
      override: 1,
      gripperClosed: false,
      message: "",
    };
  }

  modeOf(): OperatingMode {
    return this.message.motors === MOTORS.off ||
      this.message.state === EGM_STATE.running ||
      this.message.state === EGM_STATE.error
      ? "remote"
      : "manual";
  }

  safetyOf(): SafetyState {
    return this.severed || this.message.motors === MOTORS.off
      ? "emergency-stop"
      : this.message.state === EGM_STATE.error
        ? "protective-stop"
        : "normal";
  }

  readonly close = (): void => {
    this.events = null;
    this.guide.close();
    this.first?.(-1);
  };
}

function abbEgmAdapterOf(wire: EgmWire): ControllerAdapter {
  return {
    brand: "ABB",
    robot: wire.robot,
    stale_s: wire.options.stale_s ?? STALE_S,
    watchdog: { kind: "robot", within_s: COMM_TIMEOUT_S },
    async open(heard): Promise<Opened> {
      wire.close();
      const why = await wire.guide.open({
        state(_, axes) {
          if (wire.first) {
            wire.first(axes);
            return;
          }
          if (axes !== wire.n) return;
          wire.sample.sequence = wire.message.sequence;
          wire.sample.time_s = wire.message.time_ms / 1000;
          wire.sample.moving = wire.guide.isMoving;
          wire.sample.override = wire.guide.override;
          wire.sample.mode = wire.modeOf();
          wire.sample.safety = wire.safetyOf();
          wire.sample.message = notStreamedBecause(wire.message);
          wire.events?.sample(wire.sample);
        },
      });
      if (why) return { kind: "failed", why, again: true };
      const from_s = wire.scheduler.now_s();
      const axes = await new Promise<number>(resolve => {
        const stop = wire.scheduler.every(LOOK_S, () => {
          if (wire.scheduler.now_s() - from_s > OPEN_S) wire.first?.(0);
        });
        wire.first = got => {
          stop();
          wire.first = null;
          resolve(got);
        };
      });
      if (axes !== wire.n) {
        if (axes >= 0) wire.guide.close();
        return {
          kind: "failed",
          why:
            axes > 0
              ? otherAxes(wire.robot, axes)
              : axes < 0
                ? linkClosed(wire.robot)
                : nobody(wire.guide.port, wire.host),
          again: axes <= 0,
        };
      }
      wire.severed = false;
      wire.events = heard;
      return { kind: "open" };
    },
    close: wire.close,
    cannotSay: order => (order.kind === "signal" || order.kind === "gripper" ? noLines() : null),
    move: motion => wire.guide.move(motion),
    stop(emergency) {
      wire.severed ||= emergency;
      wire.guide.stop(emergency);
    },
    setOverride(ratio) {
      wire.guide.setOverride(ratio);
      return null;
    },
    async reset() {
      wire.severed = false;
      wire.guide.rearm();
      // The controller's own answer: EGM runs again only when somebody started it there.
      await new Promise<void>(resolve => {
        const stop = wire.scheduler.every(ANSWER_S, () => {
          stop();
          resolve();
        });
      });
      return notStreamedBecause(wire.message) === ""
        ? { kind: "done" }
        : { kind: "refused", why: noDrives(wire.robot) };
    },
    setSignal: () => noLines(),
    setGripper: () => noLines(),
  };
}
