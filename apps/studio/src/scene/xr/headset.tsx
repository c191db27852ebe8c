import type { CellDocument } from "@twincell/project";
import { createXRStore, useXR, useXRInputSourceState, XR, XROrigin, XRSpace } from "@react-three/xr";
import { type RefObject, Suspense, useEffect, useMemo, useRef } from "react";
import type { Group } from "three";
import { useStore } from "zustand";
import { leaveHeadsetBy } from "../../stores/headset.ts";
import { notify } from "../../stores/notices.ts";
import { roomStore } from "../../stores/room.ts";
import { videoStore } from "../../stores/video.ts";
import { viewStore } from "../../stores/view.ts";
import type { Interaction } from "../interaction.ts";
import { CameraPanel, NoCamera } from "./camera-panel.tsx";
import { Grab } from "./grab.tsx";
import type { KeyAim } from "./grabber.ts";
import { PastPanel } from "./past-panel.tsx";
import { standingPlace } from "./standing-place.ts";
import { WhyCard } from "./why-card.tsx";
import { WristPanel } from "./wrist-panel.tsx";

/** A key that is held down for long before it is let go was pressed all the same. */
const UNHURRIED = { clickThresholdMs: Infinity };

/** Controller models come with the studio: a headset on the local network may have no other. */
const store = createXRStore({
  emulate: false,
  offerSession: false,
  enterGrantedSession: false,
  foveation: 0.3,
  baseAssetPath: new URL("profiles/", window.location.href).href,
  controller: { grabPointer: false, teleportPointer: false, rayPointer: UNHURRIED },
  hand: { grabPointer: false, teleportPointer: false, rayPointer: UNHURRIED, touchPointer: UNHURRIED },
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
  const place = useMemo(() => standingPlace(document), [document]);
  const keys = useMemo<KeyAim>(() => new Set(), []);
  useEffect(() => {
    if (wish === 0 || store.getState().session) return;
    store.enterVR().catch((problem: unknown) => {
      notify("warn", problem instanceof Error ? problem.message : String(problem));
    });
  }, [wish]);
  useEffect(() => {
    leaveHeadsetBy(() => {
      void store.getState().session?.end();
    });
    const stop = store.subscribe((state, before) => {
      if (state.session !== before.session) viewStore.setState({ inHeadset: state.session !== undefined });
    });
    return () => {
      stop();
      leaveHeadsetBy(null);
    };
  }, []);
  return (
    <XR store={store}>
      <XROrigin name="standing-place" ref={origin} position={[place.x, 0, -place.y]} rotation-y={place.turn_rad}>
        <Suspense fallback={null}>
          <Menu keys={keys} />
        </Suspense>
        <Suspense fallback={null}>
          <Room keys={keys} />
        </Suspense>
      </XROrigin>
      <Suspense fallback={null}>
        <Why />
      </Suspense>
      <Grab interaction={interaction} keys={keys} origin={origin} world={world} />
    </XR>
  );
}

/** What is said in the room is only there while somebody is. */
function Why() {
  return useXR(state => state.session) ? <WhyCard /> : null;
}

/** Panels that stand about the person: pictures of cameras, and the time line of what was recorded. */
function Room({ keys }: { readonly keys: KeyAim }) {
  const inside = useXR(state => state.session !== undefined);
  const { cameras, history } = useStore(roomStore);
  const panels = useStore(videoStore, state => state.panels);
  if (!inside) return null;
  return (
    <>
      {cameras && panels.map((panel, i) => <CameraPanel key={panel.id} panel={panel} place={i} keys={keys} />)}
      {cameras && panels.length === 0 && <NoCamera keys={keys} />}
      {history && <PastPanel keys={keys} />}
    </>
  );
}

/**
 * The panel rides on the left hand: above a controller, or on the inside of a bare wrist. Who has no left hand finds it
 * standing beside.
 */
function Menu({ keys }: { readonly keys: KeyAim }) {
  const controller = useXRInputSourceState("controller", "left");
  const hand = useXRInputSourceState("hand", "left");
  const inside = useXR(state => state.session !== undefined);
  const grip = controller?.inputSource.gripSpace;
  const wrist = hand?.inputSource.hand.get("wrist");
  if (grip)
    return (
      <XRSpace key="controller" space={grip}>
        <group name="wrist-panel" position={[0.02, 0.13, -0.08]} rotation={[-0.75, 0.15, 0]}>
          <WristPanel keys={keys} wearer="left" />
        </group>
      </XRSpace>
    );
  if (wrist)
    return (
      <XRSpace key="hand" space={wrist}>
        <group name="wrist-panel" position={[0.03, 0.1, -0.06]} rotation={[-0.75, 0.15, 0]}>
          <WristPanel keys={keys} wearer="left" />
        </group>
      </XRSpace>
    );
  return inside ? (
    <group name="wrist-panel" position={[-0.5, 1.15, -0.6]} rotation={[-0.35, 0.7, 0]} scale={1.6}>
      <WristPanel keys={keys} wearer="none" />
    </group>
  ) : null;
}
