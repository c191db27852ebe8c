import type { Vector3 } from "@twincell/core";
import type { CellDocument } from "@twincell/project";
import { useThree } from "@react-three/fiber";
import { useEffect, useMemo } from "react";
import { CanvasTexture, type ColorRepresentation, Sprite, SpriteMaterial } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { useStore } from "zustand";
import { buildStore } from "../../stores/build.ts";
import { mateStore } from "../../stores/mate.ts";
import { rigStore } from "../../stores/rig.ts";
import { surfaceStore } from "../../stores/surface.ts";
import { dashes } from "../path/dashes.ts";
import type { SceneTheme } from "../theme.ts";
import { axisLines, chainLine, surfaceLines } from "./surface-lines.ts";

/** Pink is what guides, and nothing else. */
const GUIDE = "#ff6fb5";

/** What a click would take, what was picked to be mated, and the axes and limits of a robot in the making. */
export default function SurfaceView({ document, theme }: { document: CellDocument; theme: SceneTheme }) {
  const tool = useStore(buildStore, state => state.tool);
  const hovered = useStore(surfaceStore, state => state.hovered);
  const { moving, fixed } = useStore(mateStore);
  const rig = useStore(rigStore);
  const { axes, flange } = rig;
  const invalidate = useThree(state => state.invalidate);
  // What moved or is no longer there is not pointed at any more.
  useEffect(() => surfaceStore.setState({ hovered: null }), [document]);
  useEffect(() => invalidate(), [hovered, moving, fixed, rig, tool, invalidate]);
  const drawn = useMemo(() => axes.map(axisLines), [axes]);
  const chain = useMemo(() => chainLine({ axes, flange }), [axes, flange]);
  return (
    <group userData={{ unpickable: true }}>
      {hovered && <Lines polylines={surfaceLines(hovered.feature)} color={GUIDE} width_px={2.5} />}
      {tool === "mate" && moving && !fixed && (
        <Lines polylines={surfaceLines(moving.feature)} color={theme.accent} width_px={3} />
      )}
      {tool === "rig" && (
        <>
          {axes.length > 0 && <Lines polylines={drawn.flatMap(({ axis }) => axis)} color={theme.accent} width_px={3} />}
          {axes.length > 0 && (
            <Lines polylines={drawn.flatMap(({ range }) => range)} color={theme.near} width_px={2.5} />
          )}
          {chain.length > 1 && <Lines polylines={[chain]} color={theme.text} width_px={1.5} />}
          {flange && (
            <Lines
              polylines={surfaceLines({ kind: "plane", center_m: flange.at_m, axis: flange.axis })}
              color={theme.accent}
              width_px={2.5}
            />
          )}
          {axes.map(({ key, through_m, axis, radius_m }, i) => (
            <NumberTag
              key={key}
              number={i + 1}
              at={through_m.map((value, k) => value + axis[k]! * Math.max(0.13, radius_m * 2.9)) as Vector3}
              color={theme.dark ? "#58cbc6" : "#086b68"}
            />
          ))}
        </>
      )}
    </group>
  );
}

function Lines({
  polylines,
  color,
  width_px,
}: {
  readonly polylines: readonly (readonly Vector3[])[];
  readonly color: ColorRepresentation;
  readonly width_px: number;
}) {
  const size = useThree(state => state.size);
  const lines = useMemo(() => {
    const pieces: number[] = [];
    for (const polyline of polylines) dashes(polyline, [], pieces);
    const made = new LineSegments2(
      new LineSegmentsGeometry().setPositions(pieces),
      new LineMaterial({ color, linewidth: width_px, depthTest: false, transparent: true, toneMapped: false }),
    );
    made.renderOrder = 31;
    made.raycast = () => undefined;
    return made;
  }, [polylines, color, width_px]);
  useEffect(() => {
    lines.material.resolution.set(size.width, size.height);
  }, [lines, size]);
  useEffect(
    () => () => {
      lines.geometry.dispose();
      lines.material.dispose();
    },
    [lines],
  );
  return <primitive object={lines} />;
}

const TAG_PX = 64;
const TAG_SHARE = 0.05;

/** The number of a joint at its axis, as large on the screen wherever it stands. */
function NumberTag({ number, at, color }: { readonly number: number; readonly at: Vector3; readonly color: string }) {
  const sprite = useMemo(() => {
    const canvas = globalThis.document.createElement("canvas");
    canvas.width = TAG_PX;
    canvas.height = TAG_PX;
    const pen = canvas.getContext("2d");
    if (pen) {
      pen.fillStyle = color;
      pen.beginPath();
      pen.arc(TAG_PX / 2, TAG_PX / 2, TAG_PX / 2 - 2, 0, 2 * Math.PI);
      pen.fill();
      pen.fillStyle = "#ffffff";
      pen.font = `600 ${TAG_PX * 0.6}px system-ui, sans-serif`;
      pen.textAlign = "center";
      pen.textBaseline = "middle";
      pen.fillText(String(number), TAG_PX / 2, TAG_PX * 0.54);
    }
    const made = new Sprite(
      new SpriteMaterial({
        map: new CanvasTexture(canvas),
        sizeAttenuation: false,
        depthTest: false,
        transparent: true,
        toneMapped: false,
      }),
    );
    made.scale.setScalar(TAG_SHARE * 0.5);
    made.renderOrder = 32;
    made.raycast = () => undefined;
    return made;
  }, [number, color]);
  useEffect(
    () => () => {
      sprite.material.map?.dispose();
      sprite.material.dispose();
    },
    [sprite],
  );
  return <primitive object={sprite} position={at} />;
}
