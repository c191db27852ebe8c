import type { CellDocument } from "@twincell/project";
import { createXRStore, useXRInputSourceState, XR, XROrigin, XRSpace } from "@react-three/xr";
import { type RefObject, Suspense, useEffect, useMemo, useRef } from "react";
import type { Group } from "three";
import { leaveHeadsetBy } from "../../stores/headset.ts";
import { notify } from "../../stores/notices.ts";
import { viewStore } from "../../stores/view.ts";
import type { Interaction } from "../interaction.ts";
import { Grab } from "./grab.tsx";
import { standingPlace } from "./standing-place.ts";
import { WristPanel } from "./wrist-panel.tsx";

/** Controller models come with the studio: a headset on the local network may have no other. */
const store = createXRStore({
  emulate: false, offerSession: false, enterGrantedSession: false, foveation: 0.3,
  baseAssetPath: new URL("profiles/", window.location.href).href,
  controller: { grabPointer: false, teleportPointer: false }, hand: { grabPointer: false, teleportPointer: false },
});

/** The cell at full size with a person in front of it. Mounted when a headset is first asked for. */
export function Headset({ wish, document, interaction, world }: {
  /** Each new number enters the headset. */
  readonly wish: number; readonly document: CellDocument; readonly interaction: Interaction; readonly world: RefObject<Group | null>;
}) {
  const origin = useRef<Group>(null), place = useMemo(() => standingPlace(document), [document]);
  useEffect(() => {
    if (wish === 0 || store.getState().session) return;
    store.enterVR().catch((trouble: unknown) => { notify("warn", trouble instanceof Error ? trouble.message : String(trouble)); });
  }, [wish]);
  useEffect(() => {
    leaveHeadsetBy(() => { void store.getState().session?.end(); });
    const stop = store.subscribe((state, before) => {
      if (state.session !== before.session) viewStore.setState({ inHeadset: state.session !== undefined });
    });
    return () => { stop(); leaveHeadsetBy(null); };
  }, []);
  return (
    <XR store={store}>
      <XROrigin ref={origin} position={[place.x, 0, -place.y]} rotation-y={place.turn_rad}>
        <Suspense fallback={null}><Wrist /></Suspense>
      </XROrigin>
      <Grab interaction={interaction} origin={origin} world={world} />
    </XR>
  );
}

/** The panel rides on the left hand: above a controller, or on the inside of a bare wrist. */
function Wrist() {
  const controller = useXRInputSourceState("controller", "left"), hand = useXRInputSourceState("hand", "left");
  const grip = controller?.inputSource.gripSpace, wrist = hand?.inputSource.hand.get("wrist");
  if (grip) return <XRSpace key="controller" space={grip}><group position={[0.02, 0.1, -0.06]} rotation={[-0.75, 0.15, 0]}><WristPanel /></group></XRSpace>;
  if (wrist) return <XRSpace key="hand" space={wrist}><group position={[0.03, 0.08, -0.04]} rotation={[-0.75, 0.15, 0]}><WristPanel /></group></XRSpace>;
  return null;
}
