import { useThree } from "@react-three/fiber";
import { useLayoutEffect, useMemo, useRef } from "react";
import { Color, type InstancedMesh, Matrix4 } from "three";
import { useStore } from "zustand";
import { baseMapStore } from "../stores/base-map.ts";
import { baseSquareColour } from "./base-map-colour.ts";

/** Above the floor, so that its grid does not show through [m]. */
const ABOVE_M = 0.006;
/** Between two squares, as a share of their side. */
const GAP = 0.1;
const BEACON_M = 0.9;
const BEACON = "#3fb8b3";

/** The base position map on the floor, and a beacon at the place that it suggests. */
export function BaseMapView() {
  const { field, from_m, best } = useStore(baseMapStore);
  const invalidate = useThree(state => state.invalidate);
  const squares = useMemo(
    () =>
      (field?.squares ?? []).flatMap(square => {
        const colour = baseSquareColour(square, field?.points ?? 0);
        return colour === null ? [] : [{ square, colour }];
      }),
    [field],
  );
  const mesh = useRef<InstancedMesh>(null);
  const side_m = (field?.square_m ?? 0) * (1 - GAP);
  useLayoutEffect(() => {
    const matrix = new Matrix4();
    const colour = new Color();
    squares.forEach(({ square, colour: wanted }, i) => {
      matrix.makeTranslation(from_m[0] + square.x_m, from_m[1] + square.y_m, ABOVE_M);
      mesh.current?.setMatrixAt(i, matrix);
      mesh.current?.setColorAt(i, colour.set(wanted));
    });
    if (mesh.current) {
      mesh.current.instanceMatrix.needsUpdate = true;
      if (mesh.current.instanceColor) mesh.current.instanceColor.needsUpdate = true;
    }
    invalidate();
  }, [squares, from_m, invalidate]);
  return (
    <>
      {squares.length > 0 && (
        <instancedMesh
          key={squares.length}
          ref={mesh}
          name="base-map"
          args={[undefined, undefined, squares.length]}
          raycast={noPick}
          renderOrder={1}
        >
          <planeGeometry args={[side_m, side_m]} />
          <meshBasicMaterial transparent opacity={0.5} depthWrite={false} toneMapped={false} />
        </instancedMesh>
      )}
      {best && (
        <group name="base-beacon" position={[from_m[0] + best.x_m, from_m[1] + best.y_m, 0]}>
          <mesh position={[0, 0, 2 * ABOVE_M]} raycast={noPick}>
            <ringGeometry args={[0.11, 0.13, 48]} />
            <meshBasicMaterial color="#ffffff" toneMapped={false} />
          </mesh>
          <mesh position={[0, 0, BEACON_M / 2]} rotation-x={Math.PI / 2} raycast={noPick}>
            <cylinderGeometry args={[0.006, 0.006, BEACON_M, 8]} />
            <meshBasicMaterial color="#ffffff" toneMapped={false} />
          </mesh>
          <mesh position={[0, 0, BEACON_M]} raycast={noPick}>
            <octahedronGeometry args={[0.05]} />
            <meshBasicMaterial color={BEACON} toneMapped={false} />
          </mesh>
        </group>
      )}
    </>
  );
}

const noPick = (): void => undefined;
