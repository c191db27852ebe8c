import type { CommandOutcome, JointSample, Robot, Scheduler } from "@twincell/core";
import { stepOfMotion, type ControllerAdapter, type AdapterEvents, type Opened } from "../driver/index.ts";
import { createVirtualController, type VirtualController, type VirtualOptions } from "../virtual/index.ts";

export interface InMemoryAdapter extends ControllerAdapter {
  readonly virtual: VirtualController;
  /** Nothing comes any more, nobody says so. */
  silent: boolean;
  /** The next attempts fail so. */
  failing: Opened | null;
  readonly opened: number;
  /** Says a sample of the test's own making, as the latest connection or as the one of that number. */
  say(sample: Partial<JointSample>, connection?: number): void;
  /** The latest connection breaks. */
  breakLine(): void;
}

/**
 * A face without a wire: the neutral virtual robot in the same memory. What is common to drivers is tested before it.
 */
export function inMemoryAdapter(
  robot: Robot,
  scheduler: Scheduler,
  options: Partial<VirtualOptions> = {},
): InMemoryAdapter {
  const virtual = createVirtualController({ robot, scheduler, cycle_s: 0.004, ...options });
  const listening: AdapterEvents[] = [];
  let live = false;
  let silent = false;
  let failing: Opened | null = null;
  let last: JointSample | null = null;
  virtual.onSample(sample => {
    last = { ...sample, q_rad: sample.q_rad.slice() };
    if (live && !silent) listening.at(-1)!.sample(sample);
  });
  return {
    brand: "Near",
    robot,
    virtual,
    stale_s: 0.06,
    watchdog: { kind: "none", because: "there is no wire to watch" },
    get silent() {
      return silent;
    },
    set silent(to) {
      silent = to;
    },
    get failing() {
      return failing;
    },
    set failing(to) {
      failing = to;
    },
    get opened() {
      return listening.length;
    },
    open(events) {
      if (failing) return Promise.resolve(failing);
      listening.push(events);
      live = true;
      return Promise.resolve({ kind: "open" });
    },
    close() {
      live = false;
    },
    cannotSay: () => null,
    move: (motion): Promise<CommandOutcome> => virtual.run([stepOfMotion(motion)], { tools: {}, frames: {} }),
    stop(emergency) {
      virtual.stop(emergency);
    },
    setOverride(ratio) {
      virtual.setSpeed(100 * ratio);
      return null;
    },
    reset: () => virtual.reset(),
    setSignal(signal, value) {
      virtual.signals.write(signal, value);
      return null;
    },
    setGripper(closed) {
      void virtual.run([{ id: "", type: "gripper", closed }], { tools: {}, frames: {} });
      return null;
    },
    say(sample, connection = listening.length - 1) {
      listening[connection]!.sample({ ...last!, ...sample });
    },
    breakLine() {
      live = false;
      listening.at(-1)!.lost("The line broke.");
    },
  };
}
