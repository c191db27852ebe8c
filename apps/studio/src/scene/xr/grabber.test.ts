import { compose, distance, flangePose, pose, robotById, seededRandom, type Vector3 } from "@twincell/core";
import { Matrix4 } from "three";
import { beforeEach, describe, expect, test } from "vitest";
import { dragFollows } from "../../runtime/jog/drag.ts";
import { followPoses, setTouching, showJoints, tcpNow } from "../../runtime/live.ts";
import { headsetStore } from "../../stores/headset.ts";
import { jogStore } from "../../stores/jog.ts";
import { newInteraction } from "../interaction.ts";
import { Grabber } from "./grabber.ts";

const robot = robotById("staubli_rx90l")!;
const worldFromBase = pose<"world", "base">([0, 0, 0.42]);
const flangeFromTcp = pose<"flange", "tcp">([0, 0, 0.14]);
const START = [0.2, -0.9, 2.6, 0.1, 0.6, -0.4];
/** The room of the headset is the world, turned from y up to z up. */
const room = { sceneFromRoom: new Matrix4(), worldFromScene: new Matrix4().makeRotationX(Math.PI / 2) };

/** A right controller as a session tells of it: a place in the room, a grip that is squeezed or not, seen or not. */
class Hand {
  readonly at: Vector3 = [0, 0, 0];
  squeezed = false;
  /** "guessed": as headsets say of a controller that is out of sight. */
  seen: "seen" | "guessed" | "lost" = "seen";
  /** What the motor was told: strength and duration [ms]. */
  readonly felt: [number, number][] = [];
  readonly #space = {};
  readonly #source: XRInputSource;
  readonly #grabber: Grabber;
  /** @param mode  of the ray: a controller's, or that of eyes and a pinch. */
  constructor(grabber: Grabber, mode: XRTargetRayMode = "tracked-pointer") {
    this.#grabber = grabber;
    const { felt } = this;
    const buttons = [{ pressed: false }, { pressed: false }];
    const isSqueezed = (): boolean => this.squeezed;
    this.#source = {
      handedness: "right",
      targetRayMode: mode,
      gripSpace: this.#space,
      targetRaySpace: this.#space,
      gamepad: {
        axes: [],
        hapticActuators: [
          {
            pulse: (strength: number, duration_ms: number) => {
              felt.push([strength, duration_ms]);
              return Promise.resolve(true);
            },
          },
        ],
        get buttons() {
          buttons[1]!.pressed = isSqueezed();
          return buttons;
        },
      },
    } as unknown as XRInputSource;
  }
  /** One frame. */
  frame(): void {
    const { at, seen } = this;
    const frame = {
      getPose: () => {
        if (seen === "lost") return null;
        const [x, y, z] = at;
        const matrix = new Matrix4().makeTranslation(x, z, -y).toArray();
        return { emulatedPosition: seen === "guessed", transform: { matrix } };
      },
    } as unknown as XRFrame;
    this.#grabber.read({ inputSources: [this.#source] } as unknown as XRSession, frame, {} as XRReferenceSpace, room);
  }
  /** A frame in which it is no more. */
  gone(): void {
    this.#grabber.read({ inputSources: [] } as unknown as XRSession, {} as XRFrame, {} as XRReferenceSpace, room);
  }
  move(to: readonly number[]): void {
    for (let k = 0; k < 3; k++) this.at[k] = to[k]!;
    this.frame();
  }
}

let grabber: Grabber;
let hand: Hand;
beforeEach(() => {
  followPoses(robot, {
    flange: (q, out) => {
      flangePose(robot.arm, q, out);
    },
    tcp: (baseFromFlange, out) => {
      compose(compose(worldFromBase, baseFromFlange), flangeFromTcp, out);
    },
  });
  dragFollows(robot, worldFromBase, flangeFromTcp);
  showJoints(START);
  headsetStore.setState({ lock: "free", ratio: 1, emergency: false });
  jogStore.setState({ blocked: null });
  setTouching(new Set());
  grabber = new Grabber(newInteraction(), new Set());
  hand = new Hand(grabber);
});

const take = (): void => {
  hand.move(tcpNow().position.map((value, k) => value + [0.03, -0.02, 0.04][k]!));
  hand.squeezed = true;
  hand.frame();
};

describe("a hand that holds the tool", () => {
  test("moves it as far as itself, to a thousandth of a millimetre, in 500 steps at random", () => {
    const random = seededRandom(1);
    take();
    const tool = tcpNow().position;
    const from: Vector3 = [...hand.at];
    let worst_m = 0;
    for (let i = 0; i < 500; i++) {
      hand.move(from.map(value => value + 0.03 * (random() - 0.5)));
      const { position } = tcpNow();
      for (let k = 0; k < 3; k++)
        worst_m = Math.max(worst_m, Math.abs(position[k]! - tool[k]! - (hand.at[k]! - from[k]!)));
    }
    expect(worst_m).toBeLessThan(1e-6);
  });

  test.each(["lost", "guessed"] as const)(
    "that is not seen a thousand times, the position %s, and found elsewhere each time: the tool moves 0 mm",
    how => {
      const random = seededRandom(2);
      take();
      const stands = tcpNow().position;
      for (let i = 0; i < 1000; i++) {
        hand.seen = how;
        hand.frame();
        hand.frame();
        hand.seen = "seen";
        hand.move(hand.at.map(value => value + 1.2 * (random() - 0.5)));
        expect(distance(tcpNow().position, stands)).toBeLessThan(1e-9);
      }
      // And it still holds it.
      hand.move([hand.at[0], hand.at[1], hand.at[2] + 0.02]);
      expect(tcpNow().position[2] - stands[2]).toBeCloseTo(0.02, 6);
    },
  );

  test("that jumps while it is seen lets go", () => {
    take();
    const stands = tcpNow().position;
    hand.move([hand.at[0] + 2, hand.at[1], hand.at[2]]);
    hand.move([hand.at[0], hand.at[1], hand.at[2] + 0.02]);
    expect(distance(tcpNow().position, stands)).toBeLessThan(1e-9);
  });

  test("under a pressed emergency stop takes nothing", () => {
    headsetStore.setState({ emergency: true });
    take();
    const stands = tcpNow().position;
    hand.move([hand.at[0], hand.at[1], hand.at[2] + 0.05]);
    expect(distance(tcpNow().position, stands)).toBe(0);
  });

  test("M-22 is felt: taking it, a contact, and a limit, each in its own way", () => {
    take();
    expect(hand.felt).toEqual([[0.35, 25]]);
    setTouching(new Set(["carton"]));
    expect(hand.felt.at(-1)).toEqual([1, 90]);
    setTouching(new Set());
    const before = hand.felt.length;
    // Far out of reach, without a jump.
    for (let i = 0; i < 12; i++) hand.move([hand.at[0] + 0.3, hand.at[1], hand.at[2]]);
    expect(hand.felt.slice(before)).toContainEqual([0.7, 45]);
  });

  test("that is switched off while it holds lets go, says so, and the tool stays", () => {
    take();
    const stands = tcpNow().position;
    hand.gone();
    expect(jogStore.getState().blocked?.sentence).toBe(
      "The controller went away, so the tool was let go. Switch it on or charge it, then take the tool again.",
    );
    expect(distance(tcpNow().position, stands)).toBe(0);
  });

  test("lets go when the session ends, and says that it held", () => {
    take();
    const stands = tcpNow().position;
    expect(grabber.letGo()).toBe(true);
    expect(grabber.letGo()).toBe(false);
    hand.move([hand.at[0], hand.at[1], hand.at[2] + 0.05]);
    expect(distance(tcpNow().position, stands), "it is not taken again by a grip that is still held").toBeLessThan(
      0.05,
    );
  });
});

describe("T-48 a pinch with the ray of the eyes, as on Vision Pro", () => {
  test("takes the tool without moving it, carries it as far as the hand goes, and is gone with the pinch", () => {
    const pinch = new Hand(grabber, "transient-pointer");
    const tool = tcpNow().position;
    // The ray looks along −z of the room, which is +y of the world: from 1 m before the tool.
    pinch.move([tool[0], tool[1] - 1, tool[2]]);
    for (let i = 0; i < 4; i++) pinch.frame();
    expect(distance(tcpNow().position, tool)).toBeLessThan(1e-9);
    pinch.move([tool[0] + 0.04, tool[1] - 1.03, tool[2] + 0.02]);
    const went = tcpNow().position.map((value, k) => value - tool[k]!);
    for (const [k, wanted_m] of [0.04, -0.03, 0.02].entries()) expect(went[k]).toBeCloseTo(wanted_m, 6);
    pinch.gone();
    expect(jogStore.getState().blocked, "a pinch that ends is nothing to be told").toBeNull();
  });
});
