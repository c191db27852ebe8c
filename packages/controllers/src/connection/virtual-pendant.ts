import {
  armScratch,
  flangePose,
  identity,
  linkPoses,
  type CommandOutcome,
  type Interpreted,
  type OperatingMode,
  type Pose,
  type Refusal,
  type Robot,
  type Scheduler,
} from "@twincell/core";
import type { DriverKind, VendorVirtual, VendorVirtualOptions, KeyPosition, PendantShown } from "../driver/index.ts";
import { emulateNetwork, type Network, type FaultInjection } from "../transport/index.ts";
import { DONE, refused } from "../outcomes.ts";

/** What a person does before a virtual cabinet and at its pendant. Joints count from 1. */
export type VirtualPendantAction =
  | { readonly do: "mode"; readonly mode: OperatingMode }
  | { readonly do: "key"; readonly position: string }
  | { readonly do: "enable"; readonly pressed: boolean }
  | { readonly do: "jog"; readonly joint: number; readonly direction: -1 | 0 | 1 }
  | { readonly do: "servo"; readonly on: boolean }
  | { readonly do: "override"; readonly percent: number }
  | { readonly do: "reset" }
  | { readonly do: "emergency-stop"; readonly pressed: boolean }
  | { readonly do: "guard"; readonly open: boolean }
  | { readonly do: "near"; readonly somebody: boolean }
  | { readonly do: "protective-stop"; readonly because: string }
  | { readonly do: "input"; readonly signal: string; readonly value: boolean | number }
  | {
      readonly do: "trouble";
      readonly delay_s?: number;
      readonly loss?: number;
      readonly hangs?: boolean;
      readonly unplugged?: boolean;
    }
  | { readonly do: "reboot" };

/** What does not change while it is on. */
export interface VirtualPendantState {
  readonly brand: string;
  readonly brandName: string;
  readonly robotName: string;
  readonly host: string;
  readonly ports: Readonly<Record<string, number>>;
  readonly keys: readonly KeyPosition[];
  readonly labels: { readonly servo: string; readonly reset: string };
  readonly joints: readonly { readonly lower_rad: number; readonly upper_rad: number; readonly slides: boolean }[];
  readonly inputs: readonly string[];
  readonly outputs: readonly string[];
}
export interface VirtualPendantShown extends PendantShown {
  readonly q_rad: readonly number[];
  /** Of the flange in the base [m], and where the joints are on the way there. */
  readonly flange: Pose<"base", "flange">;
  readonly points: readonly (readonly [number, number, number])[];
  readonly moving: boolean;
  /** The enabling switch is pressed by somebody. */
  readonly enabled: boolean;
  readonly jog: { readonly joint: number; readonly direction: -1 | 1 } | null;
  readonly pressed: boolean;
  readonly gateOpen: boolean;
  readonly near: boolean;
  /** Lines that are on. */
  readonly on: readonly string[];
  readonly trouble: FaultInjection;
  readonly peers: readonly string[];
  /** What the cabinet itself has to say. */
  readonly says: string;
}

/** The cabinet of a virtual controller, for any number of people before it. */
export interface VirtualPendant {
  readonly words: VirtualPendantState;
  readonly shown: VirtualPendantShown;
  /** @param who  one person at one screen: what they hold is let go when they leave or fall silent. */
  act(who: string, act: VirtualPendantAction): Promise<CommandOutcome>;
  alive(who: string): void;
  leave(who: string): void;
}
export interface VirtualPendantOptions extends Omit<VendorVirtualOptions, "network" | "scheduler"> {
  readonly brand: DriverKind;
  readonly network: Network;
  readonly scheduler: Scheduler;
  readonly interpret: (text: string) => Interpreted;
}
export type VirtualPendantOpened =
  | { readonly kind: "opened"; readonly virtual: VendorVirtual; readonly cabinet: VirtualPendant; close(): void }
  | { readonly kind: "taken"; readonly sentence: string };

/** Who holds something and is not heard of for so long has let go; with the look at it below 100 ms (row X-41) [s]. */
const SILENCE_S = 0.08;
const LOOK_S = 0.01;
/** A jog key waits so long for the drives and for the arm to stand [s]. */
const PATIENCE_S = 2;
/** No joint is jogged faster than this share of its speed. */
const JOG_RATIO = 0.25;
const AT_LIMIT_RAD = 1e-4;
const refuse = (code: string, sentence: string, hint: string): CommandOutcome =>
  refused({ code, sentence, hint } satisfies Refusal);

interface Jog {
  readonly who: string;
  readonly joint: number;
  readonly direction: -1 | 1;
  readonly since_s: number;
  begun: boolean;
  readonly settle: (outcome: CommandOutcome) => void;
}

/**
 * Starts a virtual controller of that brand with its cabinet: surroundings in which things go wrong, and a pendant that
 * people hold.
 */
export async function openVirtualPendant({
  brand,
  network,
  scheduler,
  ...options
}: VirtualPendantOptions): Promise<VirtualPendantOpened> {
  const outside = emulateNetwork(network, scheduler);
  const started = await brand.virtual({ ...options, network: outside.network, scheduler: outside.scheduler });
  if (started.kind === "taken") {
    outside.close();
    return started;
  }
  const { virtual } = started;
  const { cabinet: virtualPendant, close } = virtualPendantOf(brand, options.host, virtual, outside, scheduler);
  return {
    kind: "opened",
    virtual,
    cabinet: virtualPendant,
    close() {
      close();
      virtual.close();
      outside.close();
    },
  };
}

function virtualPendantOf(
  brand: DriverKind,
  host: string,
  virtual: VendorVirtual,
  outside: ReturnType<typeof emulateNetwork>,
  scheduler: Scheduler,
): { readonly cabinet: VirtualPendant; close(): void } {
  const { pendant, robot } = virtual;
  const { joints } = robot.arm;
  const q_rad = new Float64Array(joints.length);
  const last_rad = virtual.jointAngles().slice();
  const at = placesOf(robot);
  const holding = new Map<string, number>();
  let jog: Jog | null = null;
  let pressed = false;
  let gateOpen = false;
  let near = false;
  let moving = false;
  let says = "";
  const isManual = (): boolean => pendant.keys.find(({ id }) => id === pendant.shown.key)?.mode === "manual";

  function endJog(outcome: CommandOutcome = DONE): void {
    const ended = jog;
    jog = null;
    if (ended?.begun) pendant.stopJog();
    ended?.settle(outcome);
  }
  function letGo(who: string): void {
    if (jog?.who === who) endJog();
    if (holding.delete(who) && holding.size === 0) pendant.setEnabling(false);
  }
  function hold(who: string): void {
    if (holding.size === 0) pendant.setEnabling(true);
    holding.set(who, scheduler.now_s());
  }

  /** The joint runs towards its limit until the key is let go. */
  function begin(mine: Jog): void {
    const target = virtual.jointAngles().slice();
    const { lower_rad, upper_rad } = joints[mine.joint - 1]!.limits;
    const limit_rad = mine.direction > 0 ? upper_rad : lower_rad;
    if (Math.abs(target[mine.joint - 1]! - limit_rad) < AT_LIMIT_RAD) {
      endJog(refuse("limits.joint", `Joint ${mine.joint} is at its limit.`, "Jog it the other way."));
      return;
    }
    target[mine.joint - 1] = limit_rad;
    mine.begun = true;
    void pendant.jog(target, JOG_RATIO).then(outcome => {
      if (jog !== mine) return;
      // A controller that is still braking, or just coming on, is asked again.
      if (
        outcome.kind === "refused" &&
        outcome.why.code === "controller.busy" &&
        scheduler.now_s() - mine.since_s < PATIENCE_S
      ) {
        mine.begun = false;
        return;
      }
      jog = null;
      mine.settle(outcome);
    });
  }
  const stop = scheduler.every(LOOK_S, () => {
    virtual.jointAngles(q_rad);
    moving = q_rad.some((q, i) => Math.abs(q - last_rad[i]!) > 1e-9);
    last_rad.set(q_rad);
    const now_s = scheduler.now_s();
    for (const [who, heard_s] of holding) {
      if (now_s - heard_s <= SILENCE_S) continue;
      letGo(who);
      says = `Nothing was heard from the pendant for ${Math.round(SILENCE_S * 1000)} ms: the enabling switch counts as let go.`;
    }
    if (!jog || jog.begun) return;
    const { servo } = pendant.shown;
    if (now_s - jog.since_s > PATIENCE_S) {
      endJog(
        refuse(
          "controller.not-ready",
          servo === "on" ? "The arm does not come to rest." : "The drives are off.",
          servo === "on" ? "Let the key go and press it again." : "Acknowledge what is wrong and switch them on.",
        ),
      );
      return;
    }
    if (servo === "on" && !moving) begin(jog);
  });

  function press(who: string, joint: number, direction: -1 | 0 | 1): CommandOutcome | Promise<CommandOutcome> {
    if (direction === 0) {
      if (jog?.who === who) endJog();
      return DONE;
    }
    if (joint < 1 || joint > joints.length)
      return refuse(
        "controller.no-joint",
        `${robot.name} has ${joints.length} joints; there is no joint ${joint}.`,
        "Press another key.",
      );
    if (!isManual())
      return refuse(
        "controller.not-manual",
        "The jog keys work in a manual mode only.",
        `Turn the key to ${pendant.keys.find(({ mode }) => mode === "manual")?.name ?? "manual"}.`,
      );
    if (!holding.has(who))
      return refuse("cabinet.enabling", "The enabling switch is not pressed.", "Hold it, then the jog key.");
    if (jog && jog.who !== who)
      return refuse("controller.busy", "Somebody else is jogging.", "Wait until they have let go.");
    endJog();
    return new Promise(settle => {
      jog = { who, joint, direction, since_s: scheduler.now_s(), begun: false, settle };
    });
  }
  const said = (why: string | null): CommandOutcome => (why === null ? DONE : refuse("cabinet.refused", why, ""));
  const guard = (): void => {
    pendant.setGuardOpen(gateOpen || near);
  };

  return {
    close() {
      stop();
      endJog();
    },
    cabinet: {
      words: {
        brand: brand.id,
        brandName: brand.name,
        robotName: robot.name,
        host,
        ports: virtual.ports,
        keys: pendant.keys,
        labels: pendant.labels,
        inputs: pendant.lines.inputs,
        outputs: pendant.lines.outputs,
        joints: joints.map(({ limits, kind }) => ({
          lower_rad: limits.lower_rad,
          upper_rad: limits.upper_rad,
          slides: kind === "prismatic",
        })),
      },
      get shown(): VirtualPendantShown {
        const { lines } = pendant;
        const q = virtual.jointAngles();
        return {
          ...pendant.shown,
          q_rad: Array.from(q),
          ...at(q),
          moving,
          enabled: holding.size > 0,
          jog: jog && { joint: jog.joint, direction: jog.direction },
          pressed,
          gateOpen,
          near,
          says,
          on: [...lines.inputs, ...lines.outputs].filter(signal => lines.read(signal)),
          trouble: { ...outside.trouble },
          peers: outside.peers(),
        };
      },
      alive(who) {
        if (holding.has(who)) holding.set(who, scheduler.now_s());
      },
      leave: letGo,
      async act(who, act) {
        if (act.do !== "enable") says = "";
        switch (act.do) {
          case "mode":
            endJog();
            pendant.setMode(act.mode);
            return DONE;
          case "key":
            if (!pendant.keys.some(({ id }) => id === act.position))
              return refuse(
                "cabinet.no-position",
                `The key has no position “${act.position}”.`,
                `It has: ${pendant.keys.map(({ id }) => id).join(", ")}.`,
              );
            endJog();
            pendant.turnKey(act.position);
            return DONE;
          case "enable":
            if (act.pressed) {
              says = "";
              hold(who);
            } else letGo(who);
            return DONE;
          case "jog":
            return press(who, act.joint, act.direction);
          case "servo":
            return said(pendant.setServo(act.on));
          case "override":
            if (!(act.percent >= 0 && act.percent <= 100))
              return refuse(
                "controller.override",
                `An override of ${act.percent} % is not between 0 and 100 %.`,
                "Choose one between.",
              );
            return said(pendant.setOverride(act.percent / 100));
          case "reset":
            return said(pendant.reset());
          case "emergency-stop":
            pressed = act.pressed;
            if (pressed) endJog();
            pendant.emergencyStop(pressed);
            return DONE;
          case "guard":
            gateOpen = act.open;
            guard();
            return DONE;
          case "near":
            near = act.somebody;
            guard();
            return DONE;
          case "protective-stop":
            pendant.protectiveStop(act.because);
            return DONE;
          case "input":
            pendant.setInput(act.signal, act.value);
            return DONE;
          case "trouble": {
            const { trouble: problem } = outside;
            problem.delay_s = act.delay_s ?? problem.delay_s;
            problem.loss = act.loss ?? problem.loss;
            problem.hangs = act.hangs ?? problem.hangs;
            problem.unplugged = act.unplugged ?? problem.unplugged;
            return DONE;
          }
          case "reboot":
            endJog();
            virtual.reboot();
            return DONE;
        }
      },
    },
  };
}

/** Where flange and joints are for given angles. */
function placesOf(robot: Robot): (q_rad: Float64Array) => Pick<VirtualPendantShown, "flange" | "points"> {
  const scratch = armScratch();
  const links = Array.from({ length: robot.arm.joints.length + 1 }, () => identity<"base", "link">());
  return q_rad => {
    linkPoses(robot.arm, q_rad, links, scratch);
    const flange = flangePose(robot.arm, q_rad, identity<"base", "flange">(), scratch);
    return {
      flange,
      points: [
        ...links.map(({ position: [x, y, z] }) => [x, y, z] as const),
        [...flange.position] as [number, number, number],
      ],
    };
  };
}
