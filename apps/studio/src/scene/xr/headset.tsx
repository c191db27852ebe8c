import type { CellDocument } from "@twincell/project";
import { useThree } from "@react-three/fiber";
import { createXRStore, useXR, XR, XROrigin } from "@react-three/xr";
import { type RefObject, Suspense, useEffect, useLayoutEffect, useMemo, useRef } from "react";
import type { Group } from "three";
import { useStore } from "zustand";
import { bentPosture } from "../../runtime/jog/bent-posture.ts";
import { contactAt } from "../../runtime/jog/hand-motion.ts";
import { showJoints, theLive } from "../../runtime/live.ts";
import { setEnabled } from "../../runtime/robot/cell-connection.ts";
import { connectionStore } from "../../stores/connection.ts";
import { robotOf } from "../../stores/document.ts";
import { headsetStore, leaveHeadsetBy } from "../../stores/headset.ts";
import { notify } from "../../stores/notices.ts";
import { roomStore } from "../../stores/room.ts";
import { videoStore } from "../../stores/video.ts";
import { viewStore } from "../../stores/view.ts";
import type { Interaction } from "../interaction.ts";
import { CameraPanel, NoCamera } from "./camera-panel.tsx";
import { Controller, UNHURRIED } from "./controller.tsx";
import { EdgePointing } from "./edge-pointing.tsx";
import { EmergencyButton } from "./emergency-button.tsx";
import { Grab } from "./grab.tsx";
import { GrabHint } from "./grab-hint.tsx";
import type { KeyAim } from "./grabber.ts";
import { HeardFrom } from "./heard-from.tsx";
import { HeldHeight } from "./held-height.tsx";
import { KeypadPanel } from "./keypad-panel.tsx";
import { Locomotion, resize } from "./locomotion.tsx";
import { PastPanel } from "./past-panel.tsx";
import { whatEnded, whyNotEntered } from "./session-sentences.ts";
import { standingPlace } from "./standing-place.ts";
import { StepStand } from "./step-stand.tsx";
import { Surroundings } from "./surroundings.tsx";
import { WhyCard } from "./why-card.tsx";
import { WristPlace } from "./wrist-place.tsx";

/** Controller models come with the studio: a headset on the local network may have no other. */
const store = createXRStore({
  emulate: false,
  offerSession: false,
  enterGrantedSession: false,
  foveation: 0.3,
  baseAssetPath: new URL("profiles/", window.location.href).href,
  controller: Controller,
  hand: { grabPointer: false, teleportPointer: false, rayPointer: UNHURRIED, touchPointer: UNHURRIED },
  transientPointer: { clickThresholdMs: Infinity },
});

/** The cell at full size with a person in front of it. Mounted when a headset is first asked for. */
export function Headset({
  wish,
  document,
  interaction,
  world,
}: {
  /** Each new number enters the headset. */
  readonly wish: number;
  readonly document: CellDocument;
  readonly interaction: Interaction;
  readonly world: RefObject<Group | null>;
}) {
  const origin = useRef<Group>(null);
  const keys = useMemo<KeyAim>(() => new Set(), []);
  useEffect(() => {
    if (wish === 0 || store.getState().session) return;
    store.enterVR().catch((problem: unknown) => {
      const { sentence, hint } = whyNotEntered(problem);
      notify("warn", sentence, hint);
    });
  }, [wish]);
  const letGo = useRef<(() => boolean) | null>(null);
  useEffect(() => {
    let byKey = false;
    leaveHeadsetBy(() => {
      byKey = true;
      void store.getState().session?.end();
    });
    const stop = store.subscribe((state, before) => {
      if (state.session === before.session) return;
      viewStore.setState({ inHeadset: state.session !== undefined });
      if (state.session) return;
      // Nobody holds anything any more when the session ends, whatever ended it.
      setEnabled(false);
      const held = letGo.current?.() === true;
      const told = whatEnded(byKey ? "left" : held ? "ended-held" : "ended");
      byKey = false;
      if (told !== null) notify("warn", told);
    });
    return () => {
      stop();
      leaveHeadsetBy(null);
    };
  }, []);
  return (
    <XR store={store}>
      <XROrigin name="standing-place" ref={origin}>
        <Suspense fallback={null}>
          <Inside keys={keys} />
        </Suspense>
      </XROrigin>
      <Suspense fallback={null}>
        <Around interaction={interaction} document={document} origin={origin} world={world} keys={keys} />
      </Suspense>
      <Standing origin={origin} document={document} />
      <Grab interaction={interaction} keys={keys} origin={origin} world={world} letGo={letGo} />
    </XR>
  );
}

/** What goes along with the person: the plate on the wrist, the emergency stop, and panels that stand about. */
function Inside({ keys }: { readonly keys: KeyAim }) {
  const inside = useXR(state => state.session !== undefined);
  if (!inside) return null;
  return (
    <>
      <WristPlace keys={keys} />
      <EmergencyButton />
      <Room keys={keys} />
    </>
  );
}

/** What stands in the cell while somebody is in it. */
function Around({
  document,
  interaction,
  origin,
  world,
  keys,
}: {
  readonly document: CellDocument;
  readonly interaction: Interaction;
  readonly origin: RefObject<Group | null>;
  readonly world: RefObject<Group | null>;
  readonly keys: KeyAim;
}) {
  const inside = useXR(state => state.session !== undefined);
  if (!inside) return null;
  return (
    <>
      <group rotation-x={-Math.PI / 2}>
        <Surroundings document={document} />
      </group>
      <Locomotion origin={origin} interaction={interaction} />
      <EdgePointing world={world} origin={origin} document={document} keys={keys} />
      <WhyCard />
      <HeldHeight interaction={interaction} />
      <HeardFrom />
      <GrabHint />
    </>
  );
}

/** Eyes of a person who stands, and of one who sits [m]: who sits is raised by the difference (row M-14). */
const SEATED_M = 0.45;
/** The cell stands on a table of this height. */
const TABLE_M = 0.75;

/**
 * Puts the person before the robot when a headset is entered and when they wish to come back; where they went since is
 * theirs. A robot that nobody has moved yet is bent, with its tool at the height of the chest.
 */
function Standing({ origin, document }: { readonly origin: RefObject<Group | null>; readonly document: CellDocument }) {
  const inside = useXR(state => state.session !== undefined);
  const { placedAnew, posture, scale } = useStore(headsetStore);
  const camera = useThree(state => state.camera);
  const cell = useRef(document);
  cell.current = document;
  useLayoutEffect(() => {
    if (!inside || !origin.current) return;
    const place = standingPlace(cell.current);
    origin.current.position.set(place.x, origin.current.position.y, -place.y);
    origin.current.rotation.set(0, place.turn_rad, 0);
    origin.current.scale.setScalar(1 / headsetStore.getState().scale);
    origin.current.updateMatrixWorld();
    bendOnce(cell.current, place.tool_rad);
  }, [inside, placedAnew, origin]);
  useLayoutEffect(() => {
    const person = origin.current;
    if (!inside || !person) return;
    person.position.y = (posture === "seated" ? SEATED_M : posture === "table" ? -TABLE_M : 0) / scale;
    resize(person, camera.matrixWorld, scale);
  }, [inside, posture, scale, origin, camera]);
  return null;
}

/** Of a robot that stands as it was built, moved by nobody and driven by nothing. */
function bendOnce(document: CellDocument, towards_rad: number): void {
  const robot = robotOf(document);
  const { q_rad } = theLive();
  if (!robot || connectionStore.getState().station !== null) return;
  if (robot.home_rad.some((home, i) => Math.abs(home - q_rad[i]!) > 1e-9)) return;
  const bent = bentPosture(document, robot, towards_rad, posture => contactAt(posture) === null);
  if (bent) showJoints(bent);
}

/** Panels that stand about the person: pictures of cameras, and the time line of what was recorded. */
function Room({ keys }: { readonly keys: KeyAim }) {
  const { cameras, history, keypad } = useStore(roomStore);
  const panels = useStore(videoStore, state => state.panels);
  return (
    <>
      {cameras && panels.map((panel, i) => <CameraPanel key={panel.id} panel={panel} place={i} keys={keys} />)}
      {cameras && panels.length === 0 && <NoCamera keys={keys} />}
      {history ? <PastPanel keys={keys} /> : <StepStand keys={keys} />}
      {keypad && <KeypadPanel keys={keys} />}
    </>
  );
}
