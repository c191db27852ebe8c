import {
  DefaultXRController,
  useLoadXRControllerModel,
  useXRInputSourceStateContext,
  XRSpace,
  type XRControllerState,
} from "@react-three/xr";
import { Suspense, useEffect, useMemo } from "react";
import { type BufferGeometry, type Material, Mesh, type Object3D } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";

/**
 * A key that is held down for long before it is let go was pressed all the same. Nearer than the distance a ray presses
 * nothing; it counts in metres of the cell, so that it is twice as long where the cell is drawn 2:1.
 */
export const UNHURRIED = { clickThresholdMs: Infinity, minDistance: 0.06 };

/**
 * The controller of this headset, as its maker draws it, in one draw call a material instead of one a button; and its
 * ray.
 */
export function Controller() {
  const state = useXRInputSourceStateContext("controller");
  return (
    <>
      <Suspense fallback={null}>
        <XRSpace space="grip-space">
          <Body layout={state.layout} />
        </XRSpace>
      </Suspense>
      <DefaultXRController model={false} grabPointer={false} teleportPointer={false} rayPointer={UNHURRIED} />
    </>
  );
}

function Body({ layout }: { readonly layout: XRControllerState["layout"] }) {
  const model = useLoadXRControllerModel(layout);
  const bodies = useMemo(() => mergedByMaterial(model), [model]);
  useEffect(
    () => () => {
      for (const { geometry } of bodies) geometry.dispose();
    },
    [bodies],
  );
  return bodies.map(({ material, geometry }) => <mesh key={material.uuid} geometry={geometry} material={material} />);
}

function mergedByMaterial(model: Object3D): { readonly material: Material; readonly geometry: BufferGeometry }[] {
  model.updateMatrixWorld(true);
  const parts = new Map<Material, BufferGeometry[]>();
  const modelFromWorld = model.matrixWorld.clone().invert();
  model.traverse(each => {
    if (!(each instanceof Mesh) || Array.isArray(each.material)) return;
    const source: BufferGeometry = each.geometry;
    const part = source.index ? source.toNonIndexed() : source.clone();
    for (const name of Object.keys(part.attributes))
      if (name !== "position" && name !== "normal" && name !== "uv") part.deleteAttribute(name);
    part.morphAttributes = {};
    part.applyMatrix4(modelFromWorld.clone().multiply(each.matrixWorld));
    const material: Material = each.material;
    parts.set(material, [...(parts.get(material) ?? []), part]);
  });
  return [...parts].flatMap(([material, geometries]) => {
    // Without a common set of attributes they cannot be one.
    const merged = mergeGeometries(geometries);
    return merged === null ? geometries.map(geometry => ({ material, geometry })) : [{ material, geometry: merged }];
  });
}
