import { compose, distance, identity, inverse, type Pose } from "@twincell/core";
import { beginDrag, dragTcp, refuseDrag } from "../../runtime/jog/drag.ts";
import { onTouching, theLive } from "../../runtime/live.ts";
import { playStore } from "../../stores/play.ts";
import { carried } from "../handle/drag-maths.ts";
import type { Interaction } from "../interaction.ts";
import { WORDS } from "../words.ts";
import { pulse } from "./haptics.ts";
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
}
interface Taken {
  readonly source: XRInputSource;
  readonly ray: boolean;
  readonly handFromTcp: Pose<"hand", "tcp">;
  readonly end: () => void;
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
      if (names.size > 0 && this.#taken) pulse(this.#taken.source, 1, 90);
    });
  }

  close(): void {
    this.#stop();
    this.#drop();
    this.#hands.clear();
  }

  /** Reads every hand of the frame. Allocates nothing of its own while hands only move. */
  read(session: XRSession, frame: XRFrame, space: XRReferenceSpace, room: Room): void {
    for (const source of session.inputSources) {
      let hand = this.#hands.get(source);
      if (!hand)
        this.#hands.set(
          source,
          (hand = { state: handState(), last: [0, 0, 0], seen: false, squeezed: false, pointed: false }),
        );
      readHand(source, frame, space, room, hand.state);
      this.#follow(source, hand);
    }
    if (this.#taken && !this.#hands.get(this.#taken.source)?.state.tracked) this.#interaction.wanting = false;
  }

  #take(source: XRInputSource, ray: boolean, worldFromHand: Pose<"world", "hand">): void {
    this.#drop();
    const handFromTcp = compose(inverse(worldFromHand), theLive().worldFromTcp, identity<"hand", "tcp">());
    this.#taken = { source, ray, handFromTcp, end: beginDrag(this.#drop) };
    this.#interaction.draggedPart = "free";
    pulse(source, 0.35, 25);
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
      if (state.squeezing && !hand.squeezed && distance(position, tip) < GRAB_NEAR_M)
        this.#take(source, false, state.worldFromHand);
      else if (
        state.pointing &&
        !hand.pointed &&
        this.#keys.size === 0 &&
        rayMisses(state.worldFromRay, tip) < RAY_NEAR_M
      )
        this.#take(source, true, state.worldFromRay);
    }
    const jump_m = hand.seen && state.tracked ? distance(position, hand.last) : 0;
    if (state.tracked) {
      hand.seen = true;
      for (let k = 0; k < 3; k++) hand.last[k] = position[k]!;
    }
    hand.squeezed = state.squeezing;
    hand.pointed = state.pointing;
    if (this.#taken?.source !== source) return;
    if (!(this.#taken.ray ? state.pointing : state.squeezing)) {
      this.#drop();
      return;
    }
    if (!state.tracked) return;
    if (jump_m > LONGEST_JUMP_M) {
      this.#drop();
      pulse(source, 0.7, 45);
      refuseDrag(WORDS.handJumped(jump_m));
      return;
    }
    carried(
      this.#taken.ray ? state.worldFromRay : state.worldFromHand,
      this.#taken.handFromTcp,
      this.#interaction.wanted,
    );
    const outcome = dragTcp(this.#interaction.wanted);
    this.#interaction.wanting = outcome.kind === "blocked";
    const now_ms = performance.now();
    if (outcome.kind === "blocked" && now_ms - this.#buzzed_ms > BUZZ_EVERY_MS) {
      this.#buzzed_ms = now_ms;
      pulse(source, 0.7, 45);
    }
  }
}
