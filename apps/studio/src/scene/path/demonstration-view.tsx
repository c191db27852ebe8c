import { useThree } from "@react-three/fiber";
import { useEffect, useMemo } from "react";
import { BufferGeometry, Float32BufferAttribute, Line, LineBasicMaterial } from "three";
import { useStore } from "zustand";
import { demonstrationStore } from "../../stores/demonstration.ts";
import type { SceneTheme } from "../theme.ts";

/** A recorded hand as it was and as it is filtered, one over the other (row M-47). */
export function DemonstrationView({ theme }: { readonly theme: SceneTheme }) {
  const demonstration = useStore(demonstrationStore, state => state.open?.demonstration);
  const filtered = useStore(demonstrationStore, state => state.open?.filtered);
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
  return (
    <>
      {original && <primitive object={original} />}
      {result && <primitive object={result} />}
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
