import type { SurfaceFeature, Vector3 } from "@twincell/core";
import { importedFrom, type CellDocument, type ObjectRecord } from "@twincell/project";
import { createStore } from "zustand/vanilla";
import { words } from "../messages/index.ts";
import { cellStore } from "./cell.ts";
import { objectOf } from "./document.ts";
import type { PickedSurface } from "./surface.ts";

/** An axis that was picked, with its limits as they were typed. World, metres, radians. */
export interface RigAxis {
  readonly key: number;
  readonly name: string;
  readonly kind: "revolute" | "prismatic";
  /** The object that moves with it. */
  readonly object: string;
  readonly through_m: Vector3;
  readonly axis: Vector3;
  readonly radius_m: number;
  readonly lower: number;
  readonly upper: number;
  readonly speed: number;
}

export interface RigState {
  readonly name: string;
  /** Base first. */
  readonly axes: readonly RigAxis[];
  /** The link that a person gave an object, 0 for the base, −1 for none; what is not in it follows what was picked. */
  readonly links: Readonly<Record<string, number>>;
  readonly flange: { readonly at_m: Vector3; readonly axis: Vector3 } | null;
  /** What the next click picks. */
  readonly picking: "axis" | "flange";
  readonly density_kgm3: number;
  readonly busy: boolean;
}
const NOTHING: RigState = {
  name: "",
  axes: [],
  links: {},
  flange: null,
  picking: "axis",
  density_kgm3: 2700,
  busy: false,
};
export const rigStore = createStore<RigState>(() => NOTHING);
export const clearRig = (): void => rigStore.setState(NOTHING);

const TURN = { lower: -Math.PI, upper: Math.PI, speed: Math.PI };
const SLIDE = { lower: 0, upper: 0.5, speed: 0.5 };
/** How large an axis of a flat face is drawn [m]. */
const FACE_M = 0.03;
export const MOST_AXES = 12;

/** A bore, shaft or round edge becomes a joint that turns about it, a flat face one that slides along its normal. */
export function pickForRig({ object, feature }: PickedSurface): void {
  const { axes, picking } = rigStore.getState();
  if (picking === "flange") {
    rigStore.setState({ flange: flangeOf(feature), picking: "axis" });
    return;
  }
  if (axes.length >= MOST_AXES) return;
  const isFlat = feature.kind === "plane";
  const key = axes.reduce((most, each) => Math.max(most, each.key), 0) + 1;
  const picked: RigAxis = {
    key,
    name: words.rig.jointName(key),
    kind: isFlat ? "prismatic" : "revolute",
    object,
    through_m: feature.center_m,
    axis: feature.axis,
    radius_m: isFlat ? FACE_M : feature.radius_m,
    ...(isFlat ? SLIDE : TURN),
  };
  rigStore.setState({ axes: [...axes, picked] });
}

/** The mounting face looks away from the robot: from the last axis outward. */
function flangeOf({ kind, center_m, axis }: SurfaceFeature): RigState["flange"] {
  const last = rigStore.getState().axes.at(-1);
  const outward = last ? center_m.reduce((sum, value, k) => sum + (value - last.through_m[k]!) * axis[k]!, 0) : 1;
  const sign = kind !== "plane" && outward < 0 ? -1 : 1;
  return { at_m: center_m, axis: axis.map(value => sign * value) as Vector3 };
}

export const changeAxis = (key: number, change: Partial<RigAxis>): void =>
  rigStore.setState(({ axes }) => ({ axes: axes.map(each => (each.key === key ? { ...each, ...change } : each)) }));

/** Turned the other way round: limits that were typed keep the places they were typed for. */
export function reverseAxis(key: number): void {
  rigStore.setState(({ axes }) => ({
    axes: axes.map(each =>
      each.key === key
        ? {
            ...each,
            axis: each.axis.map(value => -value) as Vector3,
            lower: -each.upper,
            upper: -each.lower,
          }
        : each,
    ),
  }));
}

/** A joint that turns from now on slides, or the other way; its limits are those of its kind. */
export const changeKind = (key: number, kind: RigAxis["kind"]): void =>
  changeAxis(key, { kind, ...(kind === "prismatic" ? SLIDE : TURN) });

export function removeAxis(key: number): void {
  const at = rigStore.getState().axes.findIndex(each => each.key === key);
  rigStore.setState(({ axes, links }) => ({
    axes: axes.filter(each => each.key !== key),
    // Links after it move up by one; what was on it falls back to what was picked.
    links: Object.fromEntries(
      Object.entries(links).flatMap(([id, link]) =>
        link === at + 1 ? [] : [[id, link > at + 1 ? link - 1 : link] as const],
      ),
    ),
  }));
}

/** The objects that can be part of the robot: those that were picked, and all that came from the same files. */
export function rigObjects(document: CellDocument, { axes }: RigState): readonly ObjectRecord[] {
  const picked = axes.flatMap(({ object }) => objectOf(document, object) ?? []);
  const files = new Set(picked.flatMap(({ shape }) => (shape.kind === "mesh" ? [shape.file] : [])));
  const ids = new Set([
    ...picked.map(({ id }) => id),
    ...[...files].flatMap(file => importedFrom(document, file).map(({ id }) => id)),
  ]);
  return document.objects.filter(({ id }) => ids.has(id));
}

/** The link an object belongs to: as a person said, else the joint it was picked for, else the base. */
export function linkOf({ links, axes }: RigState, id: string): number {
  const said = links[id];
  if (said !== undefined && said <= axes.length) return said;
  return axes.findLastIndex(({ object }) => object === id) + 1;
}

/** What a new robot is called: as typed, else as the file its parts came from. */
export function rigName(state: RigState): string {
  if (state.name.trim() !== "") return state.name.trim();
  const { document } = cellStore.getState();
  const shape = document ? rigObjects(document, state)[0]?.shape : undefined;
  return shape?.kind === "mesh" ? shape.file.replace(/\.[^.]*$/, "") : words.rig.mine;
}
