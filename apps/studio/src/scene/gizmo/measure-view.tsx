import type { Vector3 as WorldVector } from "@twincell/core";
import { useThree } from "@react-three/fiber";
import { useEffect, useMemo } from "react";
import { BufferGeometry, Float32BufferAttribute, Line, LineDashedMaterial, Points, PointsMaterial } from "three";
import { useStore } from "zustand";
import { measureStore } from "../../stores/measure.ts";

const LINE = {
  color: "#ffffff",
  dashSize: 0.02,
  gapSize: 0.012,
  depthTest: false,
  transparent: true,
  toneMapped: false,
};

/** The picked points and the dashed line between them, seen through everything. */
export default function MeasureView() {
  const picks = useStore(measureStore, state => state.picks);
  const invalidate = useThree(state => state.invalidate);
  const drawn = useMemo(() => {
    const places = picks.flatMap(({ at_m }: { at_m: WorldVector }) => [...at_m]);
    const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(places, 3));
    const line = new Line(geometry, new LineDashedMaterial(LINE));
    const ends = new Points(
      geometry,
      new PointsMaterial({ color: LINE.color, size: 9, sizeAttenuation: false, depthTest: false, transparent: true }),
    );
    line.computeLineDistances();
    for (const each of [line, ends]) {
      each.renderOrder = 30;
      each.raycast = () => undefined;
      each.userData.unpickable = true;
    }
    return { geometry, line, ends };
  }, [picks]);
  useEffect(() => {
    invalidate();
    return () => drawn.geometry.dispose();
  }, [drawn, invalidate]);
  return (
    <>
      <primitive object={drawn.line} />
      <primitive object={drawn.ends} />
    </>
  );
}
