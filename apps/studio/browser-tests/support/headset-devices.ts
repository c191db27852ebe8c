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
  /** Of the W3C registry of input profiles; null: no controllers, a pinch with the ray of the eyes. */
  readonly profile: string | null;
  readonly frameRates: readonly number[];
  readonly features: readonly string[];
}
const FLOOR = ["viewer", "local", "local-floor", "bounded-floor"];
export const VIVE: EmulatedDevice = { name: "HTC Vive", profile: "htc-vive", frameRates: [90], features: FLOOR };
export const INDEX: EmulatedDevice = {
  name: "Valve Index",
  profile: "valve-index",
  frameRates: [80, 90, 120, 144],
  features: FLOOR,
};
export const PICO: EmulatedDevice = {
  name: "Pico 4",
  profile: "pico-4",
  frameRates: [72, 90],
  features: [...FLOOR, "hand-tracking"],
};
export const VISION: EmulatedDevice = {
  name: "Apple Vision Pro",
  profile: null,
  frameRates: [90],
  features: ["viewer", "local", "local-floor", "unbounded"],
};

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
/** Of a pinch: one button, present only while the fingers are closed. */
const PINCH = {
  profileId: "generic-hand-select",
  fallbackProfileIds: ["generic-button"],
  layout: Object.fromEntries(
    ["left", "right"].map(hand => [
      hand,
      {
        gamepad: {
          mapping: "xr-standard",
          buttons: [{ id: "trigger", type: "analog", eventTrigger: "select" }],
          axes: [],
        },
        numHapticActuators: 0,
      },
    ]),
  ),
};

/** Script that makes `window.xrDevice` that device, before the page starts. */
export function deviceScript({ name, profile, frameRates, features }: EmulatedDevice): string {
  const config = {
    name,
    controllerConfig: profile === null ? PINCH : controllersOf(profile),
    supportedSessionModes: ["inline", "immersive-vr"],
    supportedFeatures: features,
    supportedFrameRates: frameRates,
    isSystemKeyboardSupported: false,
    internalNominalFrameRate: frameRates[0],
    environmentBlendModes: { "immersive-vr": "opaque" },
    interactionMode: "world-space",
    userAgent: "Mozilla/5.0",
  };
  // The emulator has no pinch that comes and goes: a controller that is there only while it is pressed stands for it.
  const pinching =
    profile === null
      ? `for(const hand of ["left","right"]){const c=window.xrDevice.controllers[hand];Object.defineProperty(c.inputSource,"targetRayMode",{value:"transient-pointer"});c.connected=false;}`
      : "";
  return `window.makeDevice=()=>new IWER.XRDevice(${JSON.stringify(config)});window.afterDevice=()=>{${pinching}};`;
}
