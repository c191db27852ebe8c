import { degrees, radians, brakingTime_s, type CommandOutcome, type OperatingMode, type Robot, type Scheduler } from "@twincell/core";
import type { Address, Network } from "../../transport/index.ts";
import { createVirtualController, type VirtualController } from "../../virtual/index.ts";
import { COMM_TIMEOUT_S, EGM_CYCLE_S, EGM_PORT, EGM_STATE, MOTORS, RAPID, egmRobotWriter, noEgmRobot, noEgmSensor, readEgmSensor } from "../codec/index.ts";

export interface VirtualAbbOptions {
  readonly robot: Robot;
  readonly scheduler: Scheduler;
  readonly network: Network;
  /** The controller's own address; it is the one that sends first. */
  readonly host: string;
  /** Where it sends its states: the computer that guides it. */
  readonly sensor?: Address;
  readonly start_rad?: ArrayLike<number>;
  /** Part of the robot's own joint speeds that it follows targets with. */
  readonly maxSpeed?: number;
  readonly cycle_s?: number;
  /** Without a target for this long the motion is given up [s]. */
  readonly commTimeout_s?: number;
  /** How quickly a gap to the target is closed [1/s]: the first-order lag of a guided robot. */
  readonly gain_per_s?: number;
  readonly initialize?: () => void;
  /** Told once about each kind of datagram that is no target. */
  readonly log?: (sentence: string) => void;
}
/** The cabinet as a person stands before it. The program that waits for targets runs while motors are on, the key is not in manual and nothing is wrong. */
export interface AbbPendant {
  /** Away from manual also means: motors on, program started, as a person does it there. */
  setMode(mode: OperatingMode): void;
  jog(q_rad: ArrayLike<number>): Promise<CommandOutcome>;
  emergencyStop(pressed: boolean): void;
  setGuardOpen(open: boolean): void;
  protectiveStop(because: string): void;
}
export interface VirtualAbb {
  readonly robot: Robot;
  readonly neutral: VirtualController;
  readonly pendant: AbbPendant;
  readonly brakingTime_s: number;
  /** The socket that it sends from. */
  readonly address: Address;
  /** Neither hears nor says anything while it is true. */
  frozen: boolean;
  /** Why the program stopped last, or "". */
  readonly message: string;
  readonly motorsOn: boolean;
  /** Whether the program waits for targets. */
  readonly isRunning: boolean;
  readonly inError: boolean;
  setMotors(on: boolean): void;
  reboot(off_s: number): void;
  close(): void;
}
export type AbbStart = { readonly kind: "started"; readonly controller: VirtualAbb } | { readonly kind: "taken"; readonly sentence: string };

const LONGEST_CYCLE_S = 0.04;
const GAIN_PER_S = 20, MOST_LOGGED = 100, CONVERGED_DEG = 0.01;
/** Beyond its limit a target is a fault; rounding is none [rad]. */
const SLACK_RAD = 1e-7;

/** A controller that is guided from outside: it tells where it is in every cycle and goes where it is told, with a lag, until targets fail to come. */
export async function createVirtualAbb(options: VirtualAbbOptions): Promise<AbbStart> {
  const { robot, scheduler, network } = options, { joints } = robot.arm, n = joints.length, cycle_s = options.cycle_s ?? EGM_CYCLE_S;
  const to = options.sensor ?? { host: options.host, port: EGM_PORT }, gain_per_s = Math.min(1 / LONGEST_CYCLE_S, options.gain_per_s ?? GAIN_PER_S), timeout_s = options.commTimeout_s ?? COMM_TIMEOUT_S, maxSpeed = options.maxSpeed ?? 1;
  const bound = await network.bind({ host: options.host, port: 0 });
  if (bound.kind === "taken") return bound;
  const { socket } = bound, { start_rad, initialize } = options;
  const neutral = createVirtualController({ robot, scheduler, cycle_s, mode: "remote", ...(start_rad ? { start_rad } : {}), ...(initialize ? { initialize } : {}) });
  const q_rad = neutral.jointAngles(), v_rad_s = new Float64Array(n), target_rad = q_rad.slice(), wanted_rad_s = new Float64Array(n);
  const out = noEgmRobot(), heard = noEgmSensor(), write = egmRobotWriter(), logged = new Set<string>();
  let motors: number = MOTORS.on, state: number = EGM_STATE.running, mode: OperatingMode = "remote", pressed = false, guardOpen = false, frozen = false, isOff = false, message = "";
  let silent_s = -Infinity, sequence = 0, powered_s = scheduler.now_s(), cycled_s = powered_s, stopWaiting: () => void = () => { /* Nothing is waited for yet. */ };
  out.axes = n;

  /** The program that waits for targets is started: the robot stays where it is until the first one comes. */
  function restart(): void {
    if (pressed || guardOpen || mode === "manual") return;
    motors = MOTORS.on;
    state = EGM_STATE.running;
    message = "";
    target_rad.set(q_rad);
    wanted_rad_s.fill(0);
    silent_s = -Infinity;
  }
  function giveUp(to_: number, because: string): void {
    if (state === EGM_STATE.running || to_ === EGM_STATE.error) state = to_;
    message = because;
  }

  /** One cycle of motion towards the target, or of braking. */
  function follow(dt_s: number): void {
    for (let i = 0; i < n; i++) {
      const { limits } = joints[i]!, most = limits.speed_rad_s * maxSpeed;
      if (state === EGM_STATE.running) {
        const to_rad_s = wanted_rad_s[i]! + gain_per_s * (target_rad[i]! - q_rad[i]!);
        v_rad_s[i] = Math.min(most, Math.max(-most, to_rad_s));
      } else {
        const less = limits.acceleration_rad_s2 * dt_s, v = v_rad_s[i]!;
        v_rad_s[i] = Math.abs(v) <= less ? 0 : v - Math.sign(v) * less;
      }
      const q = q_rad[i]! + v_rad_s[i]! * dt_s;
      q_rad[i] = Math.min(limits.upper_rad, Math.max(limits.lower_rad, q));
    }
  }
  function tell(): void {
    let converged = true;
    for (let i = 0; i < n; i++) {
      out.joints_deg[i] = degrees(q_rad[i]!);
      converged &&= Math.abs(degrees(target_rad[i]! - q_rad[i]!)) < CONVERGED_DEG;
    }
    out.sequence = sequence++;
    out.time_ms = Math.round((scheduler.now_s() - powered_s) * 1000);
    out.motors = motors; out.state = state; out.rapid = state === EGM_STATE.running ? RAPID.running : RAPID.stopped; out.converged = converged;
    socket.send(write(out), to);
  }

  const stopCycle = scheduler.every(cycle_s, () => {
    // A clock that ticks late is made good in one longer cycle, up to a bound that keeps the lag stable.
    const now_s = scheduler.now_s(), dt_s = Math.min(LONGEST_CYCLE_S, now_s - cycled_s);
    cycled_s = now_s;
    if (isOff) return;
    if (neutral.isMoving()) neutral.jointAngles(q_rad);
    else {
      silent_s += dt_s;
      if (state === EGM_STATE.running && silent_s > timeout_s) giveUp(EGM_STATE.error, `No target came for ${timeout_s} s.`);
      follow(dt_s);
      neutral.jumpTo(q_rad);
    }
    if (!frozen) tell();
  });
  socket.onDatagram((lent, from) => {
    if (isOff || frozen) return;
    const flaw = readEgmSensor(lent, heard) ?? (heard.axes === n ? null : `The target has ${heard.axes} axes; ${robot.name} has ${n}.`);
    if (flaw !== null) {
      const line = `${from.host}:${from.port}: ${flaw}`;
      if (logged.size < MOST_LOGGED && !logged.has(line)) { logged.add(line); options.log?.(line); }
      return;
    }
    if (state !== EGM_STATE.running) return;
    for (let i = 0; i < n; i++) {
      const { lower_rad, upper_rad } = joints[i]!.limits, q = radians(heard.joints_deg[i]!);
      if (q < lower_rad - SLACK_RAD || q > upper_rad + SLACK_RAD) { giveUp(EGM_STATE.error, `Joint ${i + 1} was told to go to ${heard.joints_deg[i]!.toFixed(1)}°, beyond its limit.`); return; }
    }
    silent_s = 0;
    for (let i = 0; i < n; i++) {
      target_rad[i] = radians(heard.joints_deg[i]!);
      wanted_rad_s[i] = heard.hasSpeeds ? radians(heard.speeds_deg_s[i]!) : 0;
    }
  });

  const controller: VirtualAbb = {
    robot, neutral, address: socket.address, brakingTime_s: brakingTime_s(robot) + 2 * cycle_s,
    get frozen() { return frozen; }, set frozen(is) { frozen = is; },
    get message() { return message; },
    get motorsOn() { return motors === MOTORS.on; }, get isRunning() { return state === EGM_STATE.running; }, get inError() { return state === EGM_STATE.error; },
    setMotors(on) {
      if (on) { if (!pressed) motors = MOTORS.on; return; }
      motors = MOTORS.off;
      neutral.stop();
      giveUp(EGM_STATE.stopped, "The motors were switched off.");
    },
    pendant: {
      setMode(to_) {
        mode = to_;
        neutral.atTheRobot.setMode(to_);
        if (to_ === "manual") giveUp(EGM_STATE.stopped, "The key was turned to manual."); else restart();
      },
      jog: target => neutral.atTheRobot.jog(target),
      emergencyStop(is) {
        pressed = is;
        if (!is) return;
        motors = MOTORS.off;
        giveUp(EGM_STATE.stopped, "The emergency stop was pressed.");
      },
      setGuardOpen(open) {
        guardOpen = open;
        if (open) giveUp(EGM_STATE.stopped, "The guard was opened."); else restart();
      },
      protectiveStop(because) { giveUp(EGM_STATE.error, because); },
    },
    reboot(off_s) {
      giveUp(EGM_STATE.stopped, "The controller was switched off.");
      motors = MOTORS.off;
      v_rad_s.fill(0);
      isOff = true;
      stopWaiting();
      const stop = scheduler.every(off_s, () => { stop(); isOff = false; sequence = 0; powered_s = scheduler.now_s(); });
      stopWaiting = stop;
    },
    close() { stopWaiting(); stopCycle(); socket.close(); neutral.close(); },
  };
  return { kind: "started", controller };
}
