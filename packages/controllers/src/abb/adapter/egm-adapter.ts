import type { JointSample, OperatingMode, SafetyState } from "@twincell/core";
import type { ControllerAdapter, AdapterEvents, Opened } from "../../driver/index.ts";
import { COMM_TIMEOUT_S, EGM_STATE, MOTORS } from "../codec/index.ts";
import { createSetpointStream, type SetpointStreamOptions } from "./guide.ts";
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
  const { robot, scheduler, host } = options;
  const n = robot.arm.joints.length;
  const guide = createSetpointStream(options);
  const { message, q_rad } = guide;
  const sample: Lent = {
    sequence: 0,
    time_s: 0,
    q_rad,
    moving: false,
    mode: "remote",
    safety: "normal",
    override: 1,
    gripperClosed: false,
    message: "",
  };
  let events: AdapterEvents | null = null;
  let severed = false;
  let first: ((axes: number) => void) | null = null;

  const modeOf = (): OperatingMode =>
    message.motors === MOTORS.off || message.state === EGM_STATE.running || message.state === EGM_STATE.error
      ? "remote"
      : "manual";
  const safetyOf = (): SafetyState =>
    severed || message.motors === MOTORS.off
      ? "emergency-stop"
      : message.state === EGM_STATE.error
        ? "protective-stop"
        : "normal";

  function close(): void {
    events = null;
    guide.close();
    first?.(-1);
  }
  return {
    brand: "ABB",
    robot,
    stale_s: options.stale_s ?? STALE_S,
    watchdog: { kind: "robot", within_s: COMM_TIMEOUT_S },
    async open(heard): Promise<Opened> {
      close();
      const why = await guide.open({
        state(_, axes) {
          if (first) {
            first(axes);
            return;
          }
          if (axes !== n) return;
          sample.sequence = message.sequence;
          sample.time_s = message.time_ms / 1000;
          sample.moving = guide.isMoving;
          sample.override = guide.override;
          sample.mode = modeOf();
          sample.safety = safetyOf();
          sample.message = notStreamedBecause(message);
          events?.sample(sample);
        },
      });
      if (why) return { kind: "failed", why, again: true };
      const from_s = scheduler.now_s();
      const axes = await new Promise<number>(resolve => {
        const stop = scheduler.every(LOOK_S, () => {
          if (scheduler.now_s() - from_s > OPEN_S) first?.(0);
        });
        first = got => {
          stop();
          first = null;
          resolve(got);
        };
      });
      if (axes !== n) {
        if (axes >= 0) guide.close();
        return {
          kind: "failed",
          why: axes > 0 ? otherAxes(robot, axes) : axes < 0 ? linkClosed(robot) : nobody(guide.port, host),
          again: axes <= 0,
        };
      }
      severed = false;
      events = heard;
      return { kind: "open" };
    },
    close,
    cannotSay: order => (order.kind === "signal" || order.kind === "gripper" ? noLines() : null),
    move: motion => guide.move(motion),
    stop(emergency) {
      severed ||= emergency;
      guide.stop(emergency);
    },
    setOverride(ratio) {
      guide.setOverride(ratio);
      return null;
    },
    async reset() {
      severed = false;
      guide.rearm();
      // The controller's own answer: EGM runs again only when somebody started it there.
      await new Promise<void>(resolve => {
        const stop = scheduler.every(ANSWER_S, () => {
          stop();
          resolve();
        });
      });
      return notStreamedBecause(message) === "" ? { kind: "done" } : { kind: "refused", why: noDrives(robot) };
    },
    setSignal: () => noLines(),
    setGripper: () => noLines(),
  };
}
