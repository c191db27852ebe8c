import { assumedLens, type Lens, scaledLens } from "@twincell/core/vision";
import type { TextStore } from "../../stores/preferences.ts";

const KEY = "twincell.lenses";

/** Lenses that were calibrated in this browser, by the name of the camera. They are of a device, not of a cell. */
function read(store: TextStore): Readonly<Record<string, Lens>> {
  try {
    const kept: unknown = JSON.parse(store.getItem(KEY) ?? "{}");
    if (typeof kept !== "object" || kept === null) return {};
    return Object.fromEntries(Object.entries(kept).flatMap(([name, lens]) => (isLens(lens) ? [[name, lens]] : [])));
  } catch {
    return {};
  } // damaged: they are calibrated anew
}
const NUMBERS = ["width", "height", "fx", "fy", "cx", "cy", "k1", "k2"] as const;
const isLens = (value: unknown): value is Lens =>
  typeof value === "object" && value !== null && NUMBERS.every(name => Number.isFinite(Reflect.get(value, name)));

/** The lens of a camera for pictures of that size: calibrated, or with a usual angle of view. */
export function lensOf(
  camera: string,
  width: number,
  height: number,
  store: TextStore,
): { readonly lens: Lens; readonly kind: "assumed" | "calibrated" } {
  const kept = read(store)[camera];
  // A picture of another shape is another part of the sensor: then nothing is known.
  if (kept && Math.abs(kept.width / kept.height - width / height) < 0.01)
    return { lens: scaledLens(kept, width, height), kind: "calibrated" };
  return { lens: assumedLens(width, height), kind: "assumed" };
}

/** Keeps the lens of a camera; false when the browser's storage is full or forbidden. */
export function keepLens(camera: string, lens: Lens, store: TextStore): boolean {
  try {
    store.setItem(KEY, JSON.stringify({ ...read(store), [camera]: lens }));
    return true;
  } catch {
    return false;
  }
}
