import { useThree } from "@react-three/fiber";
import { type RefObject, useEffect, useMemo } from "react";
import {
  type BufferGeometry,
  EdgesGeometry,
  type Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  type Object3D,
} from "three";
import { selectionStore, type Thing } from "../../stores/selection.ts";
import type { SceneTheme } from "../theme.ts";

const edges = new WeakMap<BufferGeometry, EdgesGeometry>();

/** Draws the edges of what is selected, and fainter of what is under the pointer, in the accent colour. */
export function Outline({ world, theme }: { readonly world: RefObject<Group | null>; readonly theme: SceneTheme }) {
  const invalidate = useThree(state => state.invalidate);
  const materials = useMemo(
    () => ({
      selected: new LineBasicMaterial({ color: theme.accent, toneMapped: false }),
      hovered: new LineBasicMaterial({ color: theme.accent, toneMapped: false, transparent: true, opacity: 0.45 }),
    }),
    [theme],
  );
  useEffect(() => {
    let drawn: LineSegments[] = [];
    const apply = (): void => {
      for (const lines of drawn) lines.removeFromParent();
      drawn = [];
      const { selected, hovered } = selectionStore.getState();
      const root = world.current;
      if (!root) return;
      for (const holder of root.children) {
        const thing: Thing | undefined = holder.userData.thing;
        const material = same(thing, selected) ? materials.selected : same(thing, hovered) ? materials.hovered : null;
        if (material) drawn.push(...outlineOf(holder, material));
      }
      invalidate();
    };
    apply();
    const stop = selectionStore.subscribe(apply);
    return () => {
      stop();
      for (const lines of drawn) lines.removeFromParent();
    };
  }, [world, materials, invalidate]);
  return null;
}

/** Selecting the robot shows all its links. */
function same(thing: Thing | undefined, wanted: Thing | null): boolean {
  if (!thing || !wanted) return false;
  switch (wanted.kind) {
    case "robot":
      return thing.kind === "link";
    case "link":
      return thing.kind === "link" && thing.link === wanted.link;
    case "tool":
      return thing.kind === "tool";
    case "object":
      return thing.kind === "object" && thing.id === wanted.id;
    case "frame":
    case "step":
      return false;
  }
}

function outlineOf(holder: Object3D, material: LineBasicMaterial): LineSegments[] {
  const made: LineSegments[] = [];
  holder.traverse(object => {
    if (!(object instanceof Mesh) || object.userData.unpainted === true) return;
    const geometry: BufferGeometry = object.geometry;
    let lines = edges.get(geometry);
    if (!lines) edges.set(geometry, (lines = new EdgesGeometry(geometry, 32)));
    made.push(new LineSegments(lines, material));
    made.at(-1)!.raycast = () => undefined;
    made.at(-1)!.userData.unpickable = true;
  });
  for (const lines of made) holder.add(lines);
  return made;
}
