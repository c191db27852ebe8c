import type { Vector3 } from "@twincell/core";
import { useThree } from "@react-three/fiber";
import { useEffect, useMemo } from "react";
import { BufferGeometry, Float32BufferAttribute, Line, LineBasicMaterial } from "three";
import { useStore } from "zustand";
import { demonstrationStore } from "../../stores/demonstration.ts";
import type { SceneTheme } from "../theme.ts";

/** Pink is what guides, and nothing else. */
const GUIDE = "#ff6fb5";
const PLACE_M = 0.012;
const NO_PLACES: readonly Vector3[] = [];

/** A recorded hand as it was and as it is filtered (row M-47), and the places that it stands for. */
export function DemonstrationView({ theme }: { readonly theme: SceneTheme }) {
  const demonstration = useStore(demonstrationStore, state => state.open?.demonstration);
  const filtered = useStore(demonstrationStore, state => state.open?.filtered);
  const places = useStore(demonstrationStore, state => state.open?.places_m ?? NO_PLACES);
  const invalidate = useThree(state => state.invalidate);
  const original = useMemo(
    () =>
      demonstration &&
      lineOf(
        demonstration.worldFromTcp.map(({ position }) => position),
        theme,
        "near",
        5,
      ),
    [demonstration, theme],
  );
  const result = useMemo(() => filtered && lineOf(filtered.polyline, theme, "run", 6), [filtered, theme]);
  useEffect(() => {
    invalidate();
    return () => {
      for (const line of [original, result]) line?.geometry.dispose();
    };
  }, [original, result, invalidate]);
  useEffect(() => invalidate(), [places, invalidate]);
  return (
    <>
      {original && <primitive object={original} />}
      {result && <primitive object={result} />}
      {places.map((place, i) => (
        <mesh key={i} name="shown-place" position={[...place]} renderOrder={7} raycast={() => undefined}>
          <sphereGeometry args={[PLACE_M, 16, 12]} />
          <meshBasicMaterial color={GUIDE} transparent opacity={0.8} depthTest={false} toneMapped={false} />
        </mesh>
      ))}
    </>
  );
}

function lineOf(
  points: readonly (readonly number[])[],
  theme: SceneTheme,
  color: "near" | "run",
  renderOrder: number,
): Line<BufferGeometry, LineBasicMaterial> {
  const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points.flat(), 3));
  const line = new Line(geometry, new LineBasicMaterial({ color: theme[color], toneMapped: false, depthTest: false }));
  line.name = color === "near" ? "demonstration-original" : "demonstration-filtered";
  line.renderOrder = renderOrder;
  line.userData.unpickable = true;
  line.raycast = () => undefined;
  return line;
}
