import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";

const profiles = join(
  dirname(createRequire(import.meta.url).resolve("@webxr-input-profiles/assets/package.json")),
  "dist/profiles",
);

interface Component {
  readonly type: string;
  readonly gamepadIndices: Readonly<Partial<Record<"button" | "xAxis" | "yAxis", number>>>;
}
interface Profile {
  readonly profileId: string;
  readonly fallbackProfileIds: readonly string[];
  readonly layouts: Readonly<Record<string, { readonly components: Readonly<Record<string, Component>> }>>;
}

/** A headset that is emulated here: rates as its maker publishes them, controllers as the W3C registry has them. */
export interface EmulatedDevice {
  readonly name: string;
  /** Of the W3C registry of input profiles. */
  readonly profile: string;
  readonly frameRates: readonly number[];
  readonly features: readonly string[];
}
const FLOOR = ["viewer", "local", "local-floor", "bounded-floor"];
export const VIVE: EmulatedDevice = { name: "HTC Vive", profile: "htc-vive", frameRates: [90], features: FLOOR };

/** Names by which the emulator, and `Person`, press the parts of every controller. */
const NAMES: Readonly<Record<string, string>> = {
  "xr-standard-trigger": "trigger",
  "xr-standard-squeeze": "squeeze",
  "xr-standard-touchpad": "touchpad",
  "xr-standard-thumbstick": "thumbstick",
};
const EVENTS: Readonly<Record<string, string>> = { trigger: "select", squeeze: "squeeze" };

function gamepadOf(components: Readonly<Record<string, Component>>): unknown {
  const buttons: unknown[] = [];
  const axes: unknown[] = [];
  for (const [id, { gamepadIndices }] of Object.entries(components)) {
    const name = NAMES[id] ?? id;
    const { button, xAxis, yAxis } = gamepadIndices;
    if (button !== undefined)
      buttons[button] =
        name in EVENTS ? { id: name, type: "analog", eventTrigger: EVENTS[name] } : { id: name, type: "binary" };
    if (xAxis !== undefined) axes[xAxis] = { id: name, type: "x-axis" };
    if (yAxis !== undefined) axes[yAxis] = { id: name, type: "y-axis" };
  }
  const filled = (list: unknown[]): unknown[] => Array.from(list, each => each ?? null);
  return { mapping: "xr-standard", buttons: filled(buttons), axes: filled(axes) };
}

function controllersOf(profile: string): unknown {
  const { profileId, fallbackProfileIds, layouts }: Profile = JSON.parse(
    readFileSync(join(profiles, profile, "profile.json"), "utf8"),
  );
  const layout = (hand: "left" | "right"): unknown => ({
    gamepad: gamepadOf((layouts[hand] ?? layouts["none"]!).components),
    numHapticActuators: 1,
  });
  return { profileId, fallbackProfileIds, layout: { left: layout("left"), right: layout("right") } };
}
/** Script that makes `window.xrDevice` that device, before the page starts. */
export function deviceScript({ name, profile, frameRates, features }: EmulatedDevice): string {
  const config = {
    name,
    controllerConfig: controllersOf(profile),
    supportedSessionModes: ["inline", "immersive-vr"],
    supportedFeatures: features,
    supportedFrameRates: frameRates,
    isSystemKeyboardSupported: false,
    internalNominalFrameRate: frameRates[0],
    environmentBlendModes: { "immersive-vr": "opaque" },
    interactionMode: "world-space",
    userAgent: "Mozilla/5.0",
  };
  return `window.makeDevice=()=>new IWER.XRDevice(${JSON.stringify(config)});`;
}
