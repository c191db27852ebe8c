import { useThree } from "@react-three/fiber";
import { type RefObject, useEffect, useMemo } from "react";
import { type BufferGeometry, EdgesGeometry, type Group, Mesh, type Object3D } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { selectionStore, type Thing } from "../../stores/selection.ts";
import type { SceneTheme } from "../theme.ts";

const edges = new WeakMap<BufferGeometry, LineSegmentsGeometry>();
/**
 * Faces that bend by more than this meet in a drawn edge [°]: the bevel of a box does, the side of a cylinder does not.
 */
const BEND_DEG = 15;

/** Draws the edges of what is selected, and fainter of what is under the pointer, in the accent colour. */
export function Outline({ world, theme }: { readonly world: RefObject<Group | null>; readonly theme: SceneTheme }) {
  const invalidate = useThree(state => state.invalidate);
  const materials = useMemo(
    () => ({
      // Seen through other things.
      selected: new LineMaterial({
        color: theme.accent,
        linewidth: 2.4,
        toneMapped: false,
        depthTest: false,
        transparent: true,
      }),
      hovered: new LineMaterial({
        color: theme.text,
        linewidth: 1.2,
        toneMapped: false,
        transparent: true,
        opacity: 0.7,
      }),
    }),
    [theme],
  );
  useEffect(() => {
    let drawn: LineSegments2[] = [];
    const apply = (): void => {
      for (const lines of drawn) lines.removeFromParent();
      drawn = [];
      const { selected, hovered, more } = selectionStore.getState();
      const root = world.current;
      if (!root) return;
      for (const holder of root.children) {
        const thing: Thing | undefined = holder.userData.thing;
        const material =
          same(thing, selected) || (thing?.kind === "object" && more.includes(thing.id))
            ? materials.selected
            : same(thing, hovered)
              ? materials.hovered
              : null;
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
    case "routine":
    case "step":
      return false;
  }
}

function outlineOf(holder: Object3D, material: LineMaterial): LineSegments2[] {
  const made: LineSegments2[] = [];
  holder.traverse(object => {
    if (!(object instanceof Mesh) || object.userData.unpainted === true) return;
    const geometry: BufferGeometry = object.geometry;
    let lines = edges.get(geometry);
    if (!lines) edges.set(geometry, (lines = linesOf(geometry)));
    made.push(new LineSegments2(lines, material));
    made.at(-1)!.raycast = () => undefined;
    made.at(-1)!.userData.unpickable = true;
  });
  for (const lines of made) holder.add(lines);
  return made;
}

function linesOf(geometry: BufferGeometry): LineSegmentsGeometry {
  const thin = new EdgesGeometry(geometry, BEND_DEG);
  const wide = new LineSegmentsGeometry().fromEdgesGeometry(thin);
  thin.dispose();
  return wide;
}
