import type { StepVerdict } from "@twincell/core";
import { useThree } from "@react-three/fiber";
import { useEffect, useMemo } from "react";
import { BufferGeometry, CanvasTexture, Color, Float32BufferAttribute, SRGBColorSpace } from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { useStore } from "zustand";
import { playStore } from "../../stores/play.ts";
import type { SceneTheme } from "../theme.ts";
import { dashes, type Pattern, stations } from "./dashes.ts";

interface Style {
  readonly verdict: StepVerdict;
  readonly pattern: Pattern;
  readonly width_m: number;
  readonly symbol: "triangle" | "cross" | null;
}

/** Blue, yellow, red as the source system has it; dash and symbol say the same without colour. */
const STYLES: readonly Style[] = [
  { verdict: "ok", pattern: [], width_m: 0.0075, symbol: null },
  { verdict: "unknown", pattern: [0.006, 0.006], width_m: 0.0055, symbol: null },
  { verdict: "warn", pattern: [0.026, 0.008], width_m: 0.0095, symbol: "triangle" },
  { verdict: "bad", pattern: [0.012, 0.007], width_m: 0.0105, symbol: "cross" },
];
const SYMBOL_EVERY_M = 0.11;

/** The way of the TCP through the program, in the colours of the verdict. */
export function PathView({ theme }: { readonly theme: SceneTheme }) {
  const path = useStore(playStore, state => state.path);
  const invalidate = useThree(state => state.invalidate);
  const drawn = useMemo(
    () =>
      STYLES.flatMap(style => {
        const pieces: number[] = [];
        const marks: number[] = [];
        for (const stretch of path) {
          if (stretch.verdict !== style.verdict) continue;
          dashes(stretch.points, style.pattern, pieces);
          if (style.symbol) stations(stretch.points, SYMBOL_EVERY_M, marks);
        }
        if (pieces.length === 0) return [];
        const color = {
          ok: theme.ok,
          unknown: theme.grid.clone().lerp(theme.text, 0.5),
          warn: theme.near,
          bad: theme.bad,
        }[style.verdict];
        const lines = new LineSegments2(
          new LineSegmentsGeometry().setPositions(pieces),
          new LineMaterial({ color, linewidth: style.width_m, worldUnits: true, toneMapped: false }),
        );
        lines.userData.unpickable = true;
        lines.raycast = () => undefined;
        return [{ style, lines, symbols: style.symbol ? symbols(marks, style.symbol, color) : null }];
      }),
    [path, theme],
  );
  useEffect(() => {
    invalidate();
    return () => {
      for (const { lines, symbols: marks } of drawn) {
        lines.geometry.dispose();
        lines.material.dispose();
        marks?.geometry.dispose();
        marks?.texture.dispose();
      }
    };
  }, [drawn, invalidate]);
  return drawn.map(({ style, lines, symbols: marks }) => (
    <group key={style.verdict}>
      <primitive object={lines} />
      {marks && (
        <points geometry={marks.geometry} renderOrder={6} userData={{ unpickable: true }}>
          <pointsMaterial
            map={marks.texture}
            size={15 * window.devicePixelRatio}
            sizeAttenuation={false}
            transparent
            depthTest={false}
            toneMapped={false}
          />
        </points>
      )}
    </group>
  ));
}

function symbols(
  at: readonly number[],
  symbol: "triangle" | "cross",
  color: Color,
): { readonly geometry: BufferGeometry; readonly texture: CanvasTexture } {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(at, 3));
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 48;
  const paint = canvas.getContext("2d")!;
  paint.lineJoin = paint.lineCap = "round";
  const stroke = (width: number, style: string): void => {
    paint.lineWidth = width;
    paint.strokeStyle = style;
    paint.beginPath();
    if (symbol === "triangle") {
      paint.moveTo(24, 10);
      paint.lineTo(39, 37);
      paint.lineTo(9, 37);
      paint.closePath();
    } else {
      paint.moveTo(13, 13);
      paint.lineTo(35, 35);
      paint.moveTo(35, 13);
      paint.lineTo(13, 35);
    }
    paint.stroke();
  };
  stroke(13, "#14181b");
  stroke(6.5, `#${color.getHexString()}`);
  if (symbol === "triangle") {
    paint.fillStyle = `#${color.getHexString()}`;
    paint.fill();
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return { geometry, texture };
}
