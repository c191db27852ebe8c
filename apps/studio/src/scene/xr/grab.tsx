import { compose, distance, identity, inverse, type Pose } from "@twincell/core";
import { useFrame } from "@react-three/fiber";
import { type RefObject, useEffect, useMemo } from "react";
import { type Group, Matrix4 } from "three";
import { beginDrag, dragTcp } from "../../live/drag.ts";
import { tick } from "../../live/frames.ts";
import { onTouching, theLive } from "../../live/live.ts";
import { playStore } from "../../stores/play.ts";
import { carried } from "../handle/drag-maths.ts";
import type { Interaction } from "../interaction.ts";
import { pulse } from "./haptics.ts";
import { GRAB_NEAR_M, type HandState, handState, RAY_NEAR_M, rayMisses, readHand } from "./hands.ts";

const BUZZ_EVERY_MS = 90;
interface Taken { readonly source: XRInputSource; readonly ray: boolean; readonly handFromTcp: Pose<"hand", "tcp">; readonly end: () => void }

/**
 * Takes the tool by squeezing, pinching or pointing, and carries it as if it were fixed in the hand. Driven by the poses of
 * the frame alone: no pointer can be left captured, so entering or leaving a headset in mid drag loses nothing.
 */
export function Grab({ interaction, origin, world }: { readonly interaction: Interaction; readonly origin: RefObject<Group | null>; readonly world: RefObject<Group | null> }) {
  const work = useMemo(() => ({
    hands: new Map<XRInputSource, { readonly state: HandState; squeezed: boolean; pointed: boolean }>(), taken: null as Taken | null,
    worldFromScene: new Matrix4(), buzzed_ms: 0,
  }), []);

  const drop = (): void => {
    const { taken } = work;
    if (!taken) return;
    work.taken = null;
    interaction.wanting = false;
    interaction.draggedPart = null;
    taken.end();
  };
  useEffect(() => {
    const stop = onTouching(names => { if (names.size > 0 && work.taken) pulse(work.taken.source, 1, 90); });
    const { hands } = work;
    return () => { stop(); drop(); hands.clear(); };
  });

  const take = (source: XRInputSource, ray: boolean, worldFromHand: Pose<"world", "hand">): void => {
    drop();
    const handFromTcp = compose(inverse(worldFromHand), theLive().worldFromTcp, identity<"hand", "tcp">());
    work.taken = { source, ray, handFromTcp, end: beginDrag(drop) };
    interaction.draggedPart = "free";
    pulse(source, 0.35, 25);
  };

  useFrame(({ gl }, _dt, frame: XRFrame | undefined) => {
    const space = gl.xr.getReferenceSpace(), session = gl.xr.getSession();
    if (!frame || !space || !session || !origin.current || !world.current) return;
    tick(performance.now());
    const room = { origin: origin.current, world: world.current, worldFromScene: work.worldFromScene.copy(world.current.matrixWorld).invert() };
    for (const source of session.inputSources) {
      let hand = work.hands.get(source);
      if (!hand) work.hands.set(source, hand = { state: handState(), squeezed: false, pointed: false });
      readHand(source, frame, space, room, hand.state);
      follow(source, hand);
    }
    if (work.taken && !work.hands.get(work.taken.source)?.state.tracked) interaction.wanting = false;
  }, -30);

  const follow = (source: XRInputSource, hand: { readonly state: HandState; squeezed: boolean; pointed: boolean }): void => {
    const { state } = hand, tip = theLive().worldFromTcp.position;
    if (!work.taken && state.tracked && !playStore.getState().playing) {
      if (state.squeezing && !hand.squeezed && distance(state.worldFromHand.position, tip) < GRAB_NEAR_M) take(source, false, state.worldFromHand);
      else if (state.pointing && !hand.pointed && rayMisses(state.worldFromRay, tip) < RAY_NEAR_M) take(source, true, state.worldFromRay);
    }
    hand.squeezed = state.squeezing; hand.pointed = state.pointing;
    const { taken } = work;
    if (taken?.source !== source) return;
    if (!(taken.ray ? state.pointing : state.squeezing)) { drop(); return; }
    if (!state.tracked) return;
    carried(taken.ray ? state.worldFromRay : state.worldFromHand, taken.handFromTcp, interaction.wanted);
    const outcome = dragTcp(interaction.wanted);
    interaction.wanting = outcome.kind === "blocked";
    const now_ms = performance.now();
    if (outcome.kind === "blocked" && now_ms - work.buzzed_ms > BUZZ_EVERY_MS) { work.buzzed_ms = now_ms; pulse(source, 0.7, 45); }
  };
  return null;
}
