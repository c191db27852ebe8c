import type { Pose } from "@twincell/core";
import { Vector2 } from "three";

export type HandlePart = "x" | "y" | "z" | "yz" | "zx" | "xy" | "free" | "rx" | "ry" | "rz";

/**
 * What the pointer is doing, shared by everything that listens to it. Mutable: read in the frame loop, never by React.
 */
export interface Interaction {
  /** Pointer in normalised device coordinates and in CSS pixels of the canvas. */
  readonly ndc: Vector2;
  px: number;
  py: number;
  inside: boolean;
  /** The pointer or the scene moved since the last look. */
  dirty: boolean;
  /** The camera is being turned: nothing is looked for meanwhile. */
  turning: boolean;
  hoveredPart: HandlePart | null;
  draggedPart: HandlePart | null;
  shift: boolean;
  /** The pointer is over a handle of what moves objects, or drags it: a click there selects nothing. */
  overGizmo: boolean;
  /** Where the drag wants the tool tip; shown as a ghost while the robot is not there. */
  readonly wanted: Pose<"world", "tcp">;
  wanting: boolean;
}

export const newInteraction = (): Interaction => ({
  ndc: new Vector2(),
  px: 0,
  py: 0,
  inside: false,
  dirty: false,
  turning: false,
  hoveredPart: null,
  draggedPart: null,
  shift: false,
  overGizmo: false,
  wanted: { position: [0, 0, 0], quaternion: [0, 0, 0, 1] },
  wanting: false,
});

/** The small label that follows the pointer: set by the scene, drawn by the DOM. */
export interface PointerLabel {
  element: HTMLElement | null;
}
export function sayAtPointer(label: PointerLabel, text: string, tone: "plain" | "blocked", x: number, y: number): void {
  const { element } = label;
  if (!element) return;
  if (element.textContent !== text) element.textContent = text;
  element.hidden = text === "";
  element.dataset.tone = tone;
  element.style.transform = `translate(${Math.round(x + 14)}px, ${Math.round(y + 16)}px)`;
}
