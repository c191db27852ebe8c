import { useThree } from "@react-three/fiber";
import { type RefObject, useEffect } from "react";
import {
  type BufferGeometry,
  Color,
  type Group,
  type Material,
  Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial,
  Plane,
  Points,
  PointsMaterial,
  Vector3,
} from "three";
import { useStore } from "zustand";
import { buildStore, type BuildState } from "../../stores/build.ts";
import { cellStore } from "../../stores/cell.ts";

/** Draws the cell otherwise than smooth, and cut off above a height, until it is taken away (row M-10). */
export default function Display({ world }: { readonly world: RefObject<Group | null> }) {
  const gl = useThree(state => state.gl);
  const invalidate = useThree(state => state.invalidate);
  const display = useStore(buildStore, state => state.display);
  const section_m = useStore(buildStore, state => state.section_m);
  // What is added meanwhile is drawn like the rest.
  const objects = useStore(cellStore, state => state.document?.objects);

  useEffect(() => {
    const root = world.current;
    const back: (() => void)[] = [];
    for (const holder of root?.children ?? []) {
      if (holder.userData.thing === undefined) continue;
      holder.traverse(each => {
        if (each instanceof Mesh && !(each instanceof Points) && display !== "smooth")
          back.push(drawnAs(each, display));
      });
    }
    invalidate();
    return () => {
      for (const undo of back) undo();
      invalidate();
    };
  }, [display, invalidate, objects, world]);

  useEffect(() => {
    if (section_m === null) return;
    gl.clippingPlanes = [new Plane(new Vector3(0, -1, 0), section_m)];
    invalidate();
    return () => {
      gl.clippingPlanes = [];
      invalidate();
    };
  }, [gl, invalidate, section_m]);
  return null;
}

const NEUTRAL = "#8a949c";
const WOODEN = "#b98f5f";

/** @returns what draws the mesh as before. */
function drawnAs(mesh: Mesh, display: Exclude<BuildState["display"], "smooth">): () => void {
  const before: Material | Material[] = mesh.material;
  const first = Array.isArray(before) ? before[0] : before;
  const standard = first instanceof MeshStandardMaterial ? first : null;
  // What wears a picture has no colour of its own.
  const color = standard && !standard.map ? standard.color : new Color(standard?.map ? WOODEN : NEUTRAL);
  const vertexColors = standard?.vertexColors ?? false;
  if (display === "flat") {
    const flat = new MeshStandardMaterial({ color, roughness: 0.8, flatShading: true, vertexColors });
    mesh.material = flat;
    return () => {
      mesh.material = before;
      flat.dispose();
    };
  }
  if (display === "wire") {
    const wire = new MeshBasicMaterial({ color, wireframe: true, vertexColors });
    mesh.material = wire;
    return () => {
      mesh.material = before;
      wire.dispose();
    };
  }
  const hidden = new MeshBasicMaterial({ colorWrite: false, depthWrite: false });
  const dots = new PointsMaterial({ color, size: 2, sizeAttenuation: false, vertexColors });
  const geometry: BufferGeometry = mesh.geometry;
  const points = new Points(geometry, dots);
  points.raycast = () => undefined;
  points.userData.unpickable = true;
  mesh.material = hidden;
  mesh.add(points);
  return () => {
    mesh.material = before;
    mesh.remove(points);
    hidden.dispose();
    dots.dispose();
  };
}
