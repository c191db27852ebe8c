import { type CellDocument, shapeMesh } from "@twincell/project";
import { transformPoint, type Vector3 } from "@twincell/core";
import { useEffect, useMemo } from "react";
import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  Float32BufferAttribute,
  MeshBasicMaterial,
  PlaneGeometry,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";

/** From the edge of the cell to the wall, and the least half length of a side [m]. */
const BEYOND_M = 2.6;
const LEAST_HALF_M = 4.6;
const HIGH_M = 4.4;
const PANEL_M = 1.15;
/** Floor paint: how far it goes about the cell, and its width [m]. */
const LINE_BEYOND_M = 0.35;
const LINE_M = 0.07;
const ABOVE_FLOOR_M = 0.003;
const WINDOW_EVERY_M = 2.2;

const COLOURS = {
  floor: "#c9cfd2",
  wall: "#eeeeea",
  side: "#dfe2e2",
  ceiling: "#f6f7f7",
  panel: "#a9b4b1",
  skirting: "#868f92",
  frame: "#9aa0a2",
  pane: "#f3f8ff",
  line: "#f2b100",
} as const;

/**
 * The bright room of a headset: white walls with windows, a floor with painted lines about the working area. One
 * geometry with its colours in its corners, unlit: one draw call an eye.
 */
export function Surroundings({ document }: { readonly document: CellDocument }) {
  const geometry = useMemo(() => roomGeometry(document), [document]);
  const material = useMemo(() => new MeshBasicMaterial({ vertexColors: true, toneMapped: false }), []);
  useEffect(() => () => geometry.dispose(), [geometry]);
  useEffect(() => () => material.dispose(), [material]);
  return <mesh name="surroundings" geometry={geometry} material={material} userData={{ unpickable: true }} />;
}

interface Ground {
  readonly x: number;
  readonly y: number;
  readonly halfX: number;
  readonly halfY: number;
}

/** The floor under robot and objects. */
function groundOf(document: CellDocument): Ground {
  const [rx, ry] = document.robot.worldFromBase.position;
  let [x0, y0, x1, y1] = [rx - 0.5, ry - 0.5, rx + 0.5, ry + 0.5];
  const point: Vector3 = [0, 0, 0];
  for (const object of document.objects) {
    if (object.role === "wall") continue;
    const { positions } = shapeMesh(object.shape);
    for (let i = 0; i < positions.length; i += 3) {
      point[0] = positions[i]!;
      point[1] = positions[i + 1]!;
      point[2] = positions[i + 2]!;
      transformPoint(object.worldFromObject, point, point);
      x0 = Math.min(x0, point[0]);
      y0 = Math.min(y0, point[1]);
      x1 = Math.max(x1, point[0]);
      y1 = Math.max(y1, point[1]);
    }
  }
  return { x: (x0 + x1) / 2, y: (y0 + y1) / 2, halfX: (x1 - x0) / 2, halfY: (y1 - y0) / 2 };
}

function painted(indexed: BufferGeometry, color: string, darker = 0): BufferGeometry {
  const geometry = indexed.toNonIndexed();
  indexed.dispose();
  const { r, g, b } = new Color(color).multiplyScalar(1 - darker);
  const { count } = geometry.getAttribute("position");
  const colours = new Float32Array(3 * count);
  for (let i = 0; i < count; i++) colours.set([r, g, b], 3 * i);
  geometry.setAttribute("color", new Float32BufferAttribute(colours, 3));
  geometry.deleteAttribute("uv");
  geometry.deleteAttribute("normal");
  return geometry;
}

/** In the z-up world. */
function roomGeometry(document: CellDocument): BufferGeometry {
  const ground = groundOf(document);
  const halfX = Math.max(LEAST_HALF_M, ground.halfX + BEYOND_M);
  const halfY = Math.max(LEAST_HALF_M, ground.halfY + BEYOND_M);
  const parts: BufferGeometry[] = [...floor(halfX, halfY), ...lines(ground)];
  const ceiling = new PlaneGeometry(2 * halfX, 2 * halfY).rotateX(Math.PI).translate(0, 0, HIGH_M);
  parts.push(painted(ceiling, COLOURS.ceiling));
  for (const [turn_rad, away, half, darker] of [
    [0, halfX, halfY, 0.03],
    [Math.PI / 2, halfY, halfX, 0.09],
    [Math.PI, halfX, halfY, 0.05],
    [-Math.PI / 2, halfY, halfX, 0.12],
  ] as const)
    parts.push(...wall(half, darker).map(part => part.translate(away, 0, 0).rotateZ(turn_rad)));
  const whole = mergeGeometries(parts).translate(ground.x, ground.y, 0);
  for (const part of parts) part.dispose();
  return whole;
}

function floor(halfX: number, halfY: number): BufferGeometry[] {
  // Under the floor of the cell, which takes the shadows and fades into this one.
  return [painted(new PlaneGeometry(2 * halfX, 2 * halfY).translate(0, 0, -ABOVE_FLOOR_M), COLOURS.floor)];
}

/** Yellow paint about the working area. */
function lines({ halfX, halfY }: Ground): BufferGeometry[] {
  const [x, y] = [halfX + LINE_BEYOND_M, halfY + LINE_BEYOND_M];
  return [
    new PlaneGeometry(2 * x + LINE_M, LINE_M).translate(0, y, ABOVE_FLOOR_M),
    new PlaneGeometry(2 * x + LINE_M, LINE_M).translate(0, -y, ABOVE_FLOOR_M),
    new PlaneGeometry(LINE_M, 2 * y - LINE_M).translate(x, 0, ABOVE_FLOOR_M),
    new PlaneGeometry(LINE_M, 2 * y - LINE_M).translate(-x, 0, ABOVE_FLOOR_M),
  ].map(part => painted(part, COLOURS.line));
}

/** A wall in the plane x = 0 that is seen from −x, with panels at its foot and a row of windows. */
function wall(half: number, darker: number): BufferGeometry[] {
  const flat = (width: number, height: number, y: number, z: number, before: number): BufferGeometry =>
    new PlaneGeometry(width, height)
      .rotateZ(Math.PI / 2)
      .rotateY(-Math.PI / 2)
      .translate(-before, y, z);
  const parts = [
    painted(flat(2 * half, HIGH_M, 0, HIGH_M / 2, 0), COLOURS.wall, darker),
    painted(flat(2 * half, PANEL_M, 0, PANEL_M / 2, 0.004), COLOURS.panel, darker),
    painted(new BoxGeometry(0.03, 2 * half, 0.12).translate(-0.015, 0, 0.06), COLOURS.skirting, darker),
  ];
  const count = Math.max(1, Math.floor((2 * half - 1) / WINDOW_EVERY_M));
  for (let i = 0; i < count; i++) {
    const y = (i - (count - 1) / 2) * WINDOW_EVERY_M;
    parts.push(
      painted(new BoxGeometry(0.06, 1.66, 1.16).translate(-0.02, y, 3), COLOURS.frame, darker),
      painted(flat(0.74, 1.04, y - 0.4, 3, 0.052), COLOURS.pane),
      painted(flat(0.74, 1.04, y + 0.4, 3, 0.052), COLOURS.pane),
    );
  }
  return parts;
}
