import { headsetStore } from "../../stores/headset.ts";
import { WORDS } from "../words.ts";

/** Asks the browser once whether it can show a headset session, and says why not. */
export async function askForHeadset(): Promise<void> {
  headsetStore.setState(await answer());
}

async function answer(): Promise<{ ready: boolean; reason: string }> {
  if (!window.isSecureContext) return { ready: false, reason: WORDS.noHeadsetSecure };
  if (!navigator.xr) return { ready: false, reason: WORDS.noHeadset };
  try {
    return (await navigator.xr.isSessionSupported("immersive-vr"))
      ? { ready: true, reason: "" }
      : { ready: false, reason: WORDS.noHeadsetDevice };
  } catch (problem) {
    return { ready: false, reason: problem instanceof Error ? problem.message : WORDS.noHeadsetDevice };
  }
}
