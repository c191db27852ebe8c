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
  type Joint,
} from "@twincell/core";
import type {
  DriverKind,
  VendorVirtual,
  VendorVirtualOptions,
  KeyPosition,
  PendantShown,
  Pendant,
} from "../driver/index.ts";
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
  return servedPendantOf(new ServedPendantState(brand, host, virtual, outside, scheduler));
}

/** Acts at the pendant itself. */
type AtThePendant = "mode" | "key" | "enable" | "jog" | "servo" | "override" | "reset" | "emergency-stop";

class ServedPendantState {
  readonly brand: DriverKind;
  readonly host: string;
  readonly virtual: VendorVirtual;
  readonly outside: ReturnType<typeof emulateNetwork>;
  readonly scheduler: Scheduler;
  readonly pendant: Pendant;
  readonly robot: Robot;
  readonly joints: readonly Joint[];
  readonly q_rad: Float64Array;
  readonly last_rad: Float64Array;
  readonly at: (q_rad: Float64Array) => Pick<VirtualPendantShown, "flange" | "points">;
  readonly holding = new Map<string, number>();
  jog: Jog | null = null;
  pressed = false;
  gateOpen = false;
  near = false;
  moving = false;
  says = "";
  readonly stop: () => void;

  constructor(
    brand: DriverKind,
    host: string,
    virtual: VendorVirtual,
    outside: ReturnType<typeof emulateNetwork>,
    scheduler: Scheduler,
  ) {
    this.brand = brand;
    this.host = host;
    this.virtual = virtual;
    this.outside = outside;
    this.scheduler = scheduler;
    this.pendant = this.virtual.pendant;
    this.robot = this.virtual.robot;
    this.joints = this.robot.arm.joints;
    this.q_rad = new Float64Array(this.joints.length);
    this.last_rad = this.virtual.jointAngles().slice();
    this.at = placesOf(this.robot);
    this.stop = this.scheduler.every(LOOK_S, () => {
      this.virtual.jointAngles(this.q_rad);
      this.moving = this.q_rad.some((q, i) => Math.abs(q - this.last_rad[i]!) > 1e-9);
      this.last_rad.set(this.q_rad);
      const now_s = this.scheduler.now_s();
      for (const [who, heard_s] of this.holding) {
        if (now_s - heard_s <= SILENCE_S) continue;
        this.letGo(who);
        this.says = `Nothing was heard from the pendant for ${Math.round(SILENCE_S * 1000)} ms: the enabling switch counts as let go.`;
      }
      if (!this.jog || this.jog.begun) return;
      const { servo } = this.pendant.shown;
      if (now_s - this.jog.since_s > PATIENCE_S) {
        this.endJog(
          refuse(
            "controller.not-ready",
            servo === "on" ? "The arm does not come to rest." : "The drives are off.",
            servo === "on" ? "Let the key go and press it again." : "Acknowledge what is wrong and switch them on.",
          ),
        );
        return;
      }
      if (servo === "on" && !this.moving) this.begin(this.jog);
    });
  }

  isManual(): boolean {
    return this.pendant.keys.find(({ id }) => id === this.pendant.shown.key)?.mode === "manual";
  }

  endJog(outcome: CommandOutcome = DONE): void {
    const ended = this.jog;
    this.jog = null;
    if (ended?.begun) this.pendant.stopJog();
    ended?.settle(outcome);
  }

  readonly letGo = (who: string): void => {
    if (this.jog?.who === who) this.endJog();
    if (this.holding.delete(who) && this.holding.size === 0) this.pendant.setEnabling(false);
  };

  hold(who: string): void {
    if (this.holding.size === 0) this.pendant.setEnabling(true);
    this.holding.set(who, this.scheduler.now_s());
  }

  /** The joint runs towards its limit until the key is let go. */
  begin(mine: Jog): void {
    const target = this.virtual.jointAngles().slice();
    const { lower_rad, upper_rad } = this.joints[mine.joint - 1]!.limits;
    const limit_rad = mine.direction > 0 ? upper_rad : lower_rad;
    if (Math.abs(target[mine.joint - 1]! - limit_rad) < AT_LIMIT_RAD) {
      this.endJog(refuse("limits.joint", `Joint ${mine.joint} is at its limit.`, "Jog it the other way."));
      return;
    }
    target[mine.joint - 1] = limit_rad;
    mine.begun = true;
    void this.pendant.jog(target, JOG_RATIO).then(outcome => {
      if (this.jog !== mine) return;
      // A controller that is still braking, or just coming on, is asked again.
      if (
        outcome.kind === "refused" &&
        outcome.why.code === "controller.busy" &&
        this.scheduler.now_s() - mine.since_s < PATIENCE_S
      ) {
        mine.begun = false;
        return;
      }
      this.jog = null;
      mine.settle(outcome);
    });
  }

  press(who: string, joint: number, direction: -1 | 0 | 1): CommandOutcome | Promise<CommandOutcome> {
    if (direction === 0) {
      if (this.jog?.who === who) this.endJog();
      return DONE;
    }
    if (joint < 1 || joint > this.joints.length)
      return refuse(
        "controller.no-joint",
        `${this.robot.name} has ${this.joints.length} joints; there is no joint ${joint}.`,
        "Press another key.",
      );
    if (!this.isManual())
      return refuse(
        "controller.not-manual",
        "The jog keys work in a manual mode only.",
        `Turn the key to ${this.pendant.keys.find(({ mode }) => mode === "manual")?.name ?? "manual"}.`,
      );
    if (!this.holding.has(who))
      return refuse("cabinet.enabling", "The enabling switch is not pressed.", "Hold it, then the jog key.");
    if (this.jog && this.jog.who !== who)
      return refuse("controller.busy", "Somebody else is jogging.", "Wait until they have let go.");
    this.endJog();
    return new Promise(settle => {
      this.jog = { who, joint, direction, since_s: this.scheduler.now_s(), begun: false, settle };
    });
  }

  said(why: string | null): CommandOutcome {
    return why === null ? DONE : refuse("cabinet.refused", why, "");
  }

  async act(who: string, act: VirtualPendantAction): Promise<CommandOutcome> {
    if (act.do !== "enable") this.says = "";
    switch (act.do) {
      case "mode":
        this.endJog();
        this.pendant.setMode(act.mode);
        return DONE;
      case "key":
        if (!this.pendant.keys.some(({ id }) => id === act.position))
          return refuse(
            "cabinet.no-position",
            `The key has no position “${act.position}”.`,
            `It has: ${this.pendant.keys.map(({ id }) => id).join(", ")}.`,
          );
        this.endJog();
        this.pendant.turnKey(act.position);
        return DONE;
      case "enable":
        if (act.pressed) {
          this.says = "";
          this.hold(who);
        } else this.letGo(who);
        return DONE;
      case "jog":
        return this.press(who, act.joint, act.direction);
      case "servo":
        return this.said(this.pendant.setServo(act.on));
      case "override":
        if (!(act.percent >= 0 && act.percent <= 100))
          return refuse(
            "controller.override",
            `An override of ${act.percent} % is not between 0 and 100 %.`,
            "Choose one between.",
          );
        return this.said(this.pendant.setOverride(act.percent / 100));
      case "reset":
        return this.said(this.pendant.reset());
      case "emergency-stop":
        this.pressed = act.pressed;
        if (this.pressed) this.endJog();
        this.pendant.emergencyStop(this.pressed);
        return DONE;
      default:
        return this.beside(act);
    }
  }

  /** What is done at the cabinet and around the robot, not at the pendant. */
  private beside(act: Exclude<VirtualPendantAction, { readonly do: AtThePendant }>): CommandOutcome {
    switch (act.do) {
      case "guard":
        this.gateOpen = act.open;
        this.guard();
        return DONE;
      case "near":
        this.near = act.somebody;
        this.guard();
        return DONE;
      case "protective-stop":
        this.pendant.protectiveStop(act.because);
        return DONE;
      case "input":
        this.pendant.setInput(act.signal, act.value);
        return DONE;
      case "trouble": {
        const { trouble: problem } = this.outside;
        problem.delay_s = act.delay_s ?? problem.delay_s;
        problem.loss = act.loss ?? problem.loss;
        problem.hangs = act.hangs ?? problem.hangs;
        problem.unplugged = act.unplugged ?? problem.unplugged;
        return DONE;
      }
      case "reboot":
        this.endJog();
        this.virtual.reboot();
        return DONE;
    }
  }

  guard(): void {
    this.pendant.setGuardOpen(this.gateOpen || this.near);
  }
}

function servedPendantOf(own: ServedPendantState): { readonly cabinet: VirtualPendant; close(): void } {
  return {
    close() {
      own.stop();
      own.endJog();
    },
    cabinet: {
      words: {
        brand: own.brand.id,
        brandName: own.brand.name,
        robotName: own.robot.name,
        host: own.host,
        ports: own.virtual.ports,
        keys: own.pendant.keys,
        labels: own.pendant.labels,
        inputs: own.pendant.lines.inputs,
        outputs: own.pendant.lines.outputs,
        joints: own.joints.map(({ limits, kind }) => ({
          lower_rad: limits.lower_rad,
          upper_rad: limits.upper_rad,
          slides: kind === "prismatic",
        })),
      },
      get shown(): VirtualPendantShown {
        const { lines } = own.pendant;
        const q = own.virtual.jointAngles();
        return {
          ...own.pendant.shown,
          q_rad: Array.from(q),
          ...own.at(q),
          moving: own.moving,
          enabled: own.holding.size > 0,
          jog: own.jog && { joint: own.jog.joint, direction: own.jog.direction },
          pressed: own.pressed,
          gateOpen: own.gateOpen,
          near: own.near,
          says: own.says,
          on: [...lines.inputs, ...lines.outputs].filter(signal => lines.read(signal)),
          trouble: { ...own.outside.trouble },
          peers: own.outside.peers(),
        };
      },
      alive(who) {
        if (own.holding.has(who)) own.holding.set(who, own.scheduler.now_s());
      },
      leave: own.letGo,
      act: (who, act) => own.act(who, act),
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
