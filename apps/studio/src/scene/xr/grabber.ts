import { compose, copyPose, distance, identity, inverse, lerp, type Pose, slerp } from "@twincell/core";
import { beginDrag, dragTcp, refuseDrag } from "../../runtime/jog/drag.ts";
import { onTouching, theLive } from "../../runtime/live.ts";
import { setEnabled } from "../../runtime/robot/cell-connection.ts";
import { connectionStore } from "../../stores/connection.ts";
import { headsetStore } from "../../stores/headset.ts";
import { playStore } from "../../stores/play.ts";
import { traceStore } from "../../stores/trace.ts";
import { words } from "../../messages/index.ts";
import { carried } from "../handle/drag-maths.ts";
import type { Interaction } from "../interaction.ts";
import { WORDS } from "../words.ts";
import { feel } from "./haptics.ts";
import { GRAB_NEAR_M, type HandState, handState, RAY_NEAR_M, rayMisses, readHand, type Room } from "./hands.ts";

const BUZZ_EVERY_MS = 90;
/** No hand goes this far between two frames: the tracking lost it and found it elsewhere. */
const LONGEST_JUMP_M = 0.5;

/** Which panels are being pointed at: then the trigger belongs to them, not to the tool behind. */
export type KeyAim = Set<string>;
export function aimAt(keys: KeyAim, panel: string, aimed: boolean): void {
  if (aimed) keys.add(panel);
  else keys.delete(panel);
}

interface Hand {
  readonly state: HandState;
  readonly last: Pose<"world", "hand">["position"];
  seen: boolean;
  squeezed: boolean;
  pointed: boolean;
  /** It is one of the hands of this frame. */
  present: boolean;
}
interface Taken {
  readonly source: XRInputSource;
  readonly ray: boolean;
  readonly handFromTcp: Pose<"hand", "tcp">;
  /** Where the hand was when it took the tool, and the tool then: what a ratio and a lock count from. */
  readonly worldFromTcp: Pose<"world", "tcp">;
  /** The hand is not seen: the tool stays, and is taken anew where the hand is found. */
  lost: boolean;
  readonly end: () => void;
}

/** What carries a tool that a ray took: the ray, or the hand whose pinch the ray of the eyes belongs to. */
const carrier = (state: HandState): Pose<"world", "hand"> =>
  state.transient ? state.worldFromHand : state.worldFromRay;

/** From here on the tool is as if it were fixed in the hand as they are now: taking it moves nothing. */
function takeAnew(taken: Taken, worldFromHand: Pose<"world", "hand">): void {
  compose(inverse(worldFromHand), theLive().worldFromTcp, taken.handFromTcp);
  copyPose(theLive().worldFromTcp, taken.worldFromTcp);
}

/** The share of the way that the person chose, and only the part of it that is not locked (rows L-28, L-30). */
function limited(from: Pose<"world", "tcp">, wanted: Pose<"world", "tcp">): void {
  const { lock, ratio } = headsetStore.getState();
  if (lock === "turn") for (let k = 0; k < 3; k++) wanted.position[k] = from.position[k]!;
  else if (ratio !== 1) lerp(from.position, wanted.position, ratio, wanted.position);
  if (lock === "move") for (let k = 0; k < 4; k++) wanted.quaternion[k] = from.quaternion[k]!;
  else if (ratio !== 1) slerp(from.quaternion, wanted.quaternion, ratio, wanted.quaternion);
}

/**
 * Takes the tool by squeezing, pinching or pointing, and carries it as if it were fixed in the hand. Every press takes
 * it anew where it is then, so that pressing moves nothing (row L-29). Driven by the poses of the frame alone: no
 * pointer can be left captured, so entering or leaving a headset in mid drag loses nothing.
 */
export class Grabber {
  readonly #interaction: Interaction;
  readonly #keys: KeyAim;
  readonly #hands = new Map<XRInputSource, Hand>();
  readonly #stop: () => void;
  #taken: Taken | null = null;
  #buzzed_ms = 0;

  constructor(interaction: Interaction, keys: KeyAim) {
    this.#interaction = interaction;
    this.#keys = keys;
    this.#stop = onTouching(names => {
      if (names.size > 0 && this.#taken) feel(this.#taken.source, "contact");
    });
  }

  close(): void {
    this.#stop();
    this.letGo();
  }

  /** The session ended, or the studio wants it: nothing is held any more. Says whether something was. */
  letGo(): boolean {
    const held = this.#taken !== null;
    this.#drop();
    this.#hands.clear();
    return held;
  }

  /** Reads every hand of the frame. Allocates nothing of its own while hands only move. */
  read(session: XRSession, frame: XRFrame, space: XRReferenceSpace, room: Room): void {
    for (const [, hand] of this.#hands) hand.present = false;
    for (const source of session.inputSources) {
      let hand = this.#hands.get(source);
      if (!hand)
        this.#hands.set(
          source,
          (hand = { state: handState(), last: [0, 0, 0], seen: false, squeezed: false, pointed: false, present: true }),
        );
      hand.present = true;
      readHand(source, frame, space, room, headsetStore.getState().use, hand.state);
      this.#follow(source, hand);
    }
    // A controller that was switched off, or a hand that became a controller, comes back as another one.
    for (const [source, hand] of this.#hands) {
      if (hand.present) continue;
      if (this.#taken?.source === source) {
        this.#drop();
        // A pinch that ends goes away by itself; a controller that does is switched off, or its battery is empty.
        if (!hand.state.transient) refuseDrag(words.headset.handGone);
      }
      this.#hands.delete(source);
    }
    if (this.#taken && !this.#hands.get(this.#taken.source)?.state.tracked) this.#interaction.wanting = false;
    this.#enable();
  }

  /**
   * The enabling switch of a connected robot: the grip, or the pinch, of the hand that wears the plate, held away from
   * the tool. A hand that is not seen has let go.
   */
  #enable(): void {
    const { station, enabled } = connectionStore.getState();
    if (station === null && !enabled) return;
    const { wrist } = headsetStore.getState();
    let held = false;
    for (const [source, { state }] of this.#hands) {
      const wears = wrist === "stand" || source.handedness === wrist;
      if (wears && state.tracked && state.squeezing && this.#taken?.source !== source) held = true;
    }
    if (station !== null && held !== enabled) setEnabled(held);
  }

  #take(source: XRInputSource, ray: boolean, worldFromHand: Pose<"world", "hand">): void {
    this.#drop();
    if (headsetStore.getState().emergency) {
      feel(source, "limit");
      refuseDrag(words.headset.emergencyPressed);
      return;
    }
    const taken: Taken = {
      source,
      ray,
      handFromTcp: identity(),
      worldFromTcp: identity(),
      lost: false,
      end: beginDrag(this.#drop),
    };
    this.#taken = taken;
    takeAnew(taken, worldFromHand);
    this.#interaction.draggedPart = "free";
    if (!headsetStore.getState().hintDone) headsetStore.setState({ hintDone: true });
    feel(source, "grasp");
  }

  readonly #drop = (): void => {
    const taken = this.#taken;
    if (!taken) return;
    this.#taken = null;
    this.#interaction.wanting = false;
    this.#interaction.draggedPart = null;
    taken.end();
  };

  #follow(source: XRInputSource, hand: Hand): void {
    const { state } = hand;
    const tip = theLive().worldFromTcp.position;
    const { position } = state.worldFromHand;
    if (!this.#taken && state.tracked && !playStore.getState().playing) {
      if (state.squeezing && !hand.squeezed && distance(state.holds, tip) < GRAB_NEAR_M)
        this.#take(source, false, state.worldFromHand);
      else if (
        state.pointing &&
        !hand.pointed &&
        this.#keys.size === 0 &&
        !traceStore.getState().active &&
        rayMisses(state.worldFromRay, tip) < RAY_NEAR_M
      )
        this.#take(source, true, carrier(state));
    }
    const jump_m = hand.seen && state.tracked ? distance(position, hand.last) : 0;
    if (state.tracked) {
      hand.seen = true;
      for (let k = 0; k < 3; k++) hand.last[k] = position[k]!;
    }
    hand.squeezed = state.squeezing;
    hand.pointed = state.pointing;
    if (this.#taken?.source !== source) return;
    // A hand that is not seen holds what it holds; found again, it goes on from where it is (0 mm).
    if (!state.tracked) {
      this.#taken.lost = true;
      return;
    }
    if (!(this.#taken.ray ? state.pointing : state.squeezing)) {
      this.#drop();
      return;
    }
    const carries = this.#taken.ray ? carrier(state) : state.worldFromHand;
    if (this.#taken.lost) {
      this.#taken.lost = false;
      takeAnew(this.#taken, carries);
    } else if (jump_m > LONGEST_JUMP_M) {
      this.#drop();
      feel(source, "limit");
      refuseDrag(WORDS.handJumped(jump_m));
      return;
    }
    carried(carries, this.#taken.handFromTcp, this.#interaction.wanted);
    limited(this.#taken.worldFromTcp, this.#interaction.wanted);
    const outcome = dragTcp(this.#interaction.wanted);
    this.#interaction.wanting = outcome.kind === "blocked";
    const now_ms = performance.now();
    if (outcome.kind === "blocked" && now_ms - this.#buzzed_ms > BUZZ_EVERY_MS) {
      this.#buzzed_ms = now_ms;
      feel(source, "limit");
    }
  }
}
