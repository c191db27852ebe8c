import { compose, distance, flangePose, pose, robotById, seededRandom, type Vector3 } from "@twincell/core";
import { Matrix4 } from "three";
import { beforeEach, describe, expect, test } from "vitest";
import { dragFollows } from "../../runtime/jog/drag.ts";
import { followPoses, showJoints, tcpNow } from "../../runtime/live.ts";
import { headsetStore } from "../../stores/headset.ts";
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
  readonly #space = {};
  readonly #source: XRInputSource;
  readonly #grabber: Grabber;
  constructor(grabber: Grabber) {
    this.#grabber = grabber;
    const buttons = [{ pressed: false }, { pressed: false }];
    const isSqueezed = (): boolean => this.squeezed;
    this.#source = {
      handedness: "right",
      gripSpace: this.#space,
      targetRaySpace: this.#space,
      gamepad: {
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
});
