import type { Vector3 } from "@twincell/core";
import { useEffect, useMemo } from "react";
import type { Color } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { useStore } from "zustand";
import { traceStore } from "../../stores/trace.ts";
import { dashes } from "../path/dashes.ts";
import type { SceneTheme } from "../theme.ts";

/** The edge under the pointer and the edges chosen to be traced. */
export function EdgeView({ theme }: { readonly theme: SceneTheme }) {
  const { active, hovered, chosen } = useStore(traceStore);
  if (!active) return null;
  return (
    <>
      {chosen.length > 0 && (
        <Lines polylines={chosen.map(edge => edge.polyline)} color={theme.accent} width_m={0.007} opacity={1} />
      )}
      {hovered && <Lines polylines={[hovered.polyline]} color={theme.accent} width_m={0.011} opacity={0.6} />}
    </>
  );
}

function Lines({
  polylines,
  color,
  width_m,
  opacity,
}: {
  readonly polylines: readonly (readonly Vector3[])[];
  readonly color: Color;
  readonly width_m: number;
  readonly opacity: number;
}) {
  const lines = useMemo(() => {
    const pieces: number[] = [];
    for (const polyline of polylines) dashes(polyline, [], pieces);
    const made = new LineSegments2(
      new LineSegmentsGeometry().setPositions(pieces),
      new LineMaterial({
        color,
        linewidth: width_m,
        worldUnits: true,
        toneMapped: false,
        transparent: opacity < 1,
        opacity,
      }),
    );
    made.renderOrder = 5;
    made.raycast = () => undefined;
    return made;
  }, [polylines, color, width_m, opacity]);
  useEffect(
    () => () => {
      lines.geometry.dispose();
      lines.material.dispose();
    },
    [lines],
  );
  return <primitive object={lines} />;
}
