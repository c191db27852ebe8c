import { compose, identity } from "@twincell/core";
import type { ObjectRecord } from "@twincell/project";
import { useFrame } from "@react-three/fiber";
import { useEffect, useMemo, useRef } from "react";
import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  EdgesGeometry,
  type Group,
  type LineSegments,
  type Mesh,
  Vector3,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { carriedPose } from "../../runtime/history/carried.ts";
import { shownMoment } from "../../runtime/history/playhead.ts";
import { theLive } from "../../runtime/live.ts";
import { partOffset, physicsNow } from "../../runtime/physics/physics.ts";
import { cellStore } from "../../stores/cell.ts";
import { playStore } from "../../stores/play.ts";
import { GraspMark } from "../physical/grasp-mark.tsx";
import { paintTouching } from "../paint.ts";
import { raycastByTree } from "../pick/raycast.ts";
import { poseMatrix } from "../pose-matrix.ts";
import { kraftTexture, looksLikeCardboard } from "./cardboard.ts";
import { partGeometries, partMaterial } from "./part-geometry.ts";
import { shapeGeometry } from "./shape-geometry.ts";
import { wallHides } from "./walls.ts";
import type { SceneTheme } from "../theme.ts";

/** Where a part is now; read and written within one frame. */
const place = identity();
const inHand = identity<"world", "object">();
const worldFromFlange = identity<"world", "flange">();

/** Which picture of the robot a part was placed for, and whether it is away from where the cell has it. */
interface Carriage {
  revision: number;
  carried: object | null;
  away: boolean;
}
/** Puts a part where the program has it at the moment shown. False when it is where the cell has it. */
function carry(object: ObjectRecord, group: Group, carriage: Carriage): boolean {
  const { revision, baseFromFlange } = theLive();
  const { carried } = playStore.getState();
  if (carried.length === 0 && !carriage.away) return false;
  if (carriage.revision === revision && carriage.carried === carried) return carriage.away;
  carriage.revision = revision;
  carriage.carried = carried;
  const moment = shownMoment();
  const { document } = cellStore.getState();
  const at =
    moment === null || document === null
      ? undefined
      : carriedPose(
          carried,
          object.id,
          moment,
          compose(document.robot.worldFromBase, baseFromFlange, worldFromFlange),
          inHand,
        );
  if (at === undefined && !carriage.away) return false;
  carriage.away = at !== undefined;
  poseMatrix(at ?? object.worldFromObject, group.matrix);
  group.matrixWorldNeedsUpdate = true;
  return true;
}

/** One thing in the cell: furniture, work piece or wall. */
export function ObjectView({
  object,
  theme,
  glass = false,
}: {
  readonly object: ObjectRecord;
  readonly theme: SceneTheme;
  /** Walls are seen through: a person stands among them. */
  readonly glass?: boolean;
}) {
  const group = useRef<Group>(null);
  const geometry = useMemo(() => shapeGeometry(object.shape), [object.shape]);
  const edges = useMemo(() => new EdgesGeometry(geometry, 40), [geometry]);
  useEffect(
    () => () => {
      geometry.dispose();
      edges.dispose();
    },
    [geometry, edges],
  );
  const moved = useRef<object | null>(null);
  const carriage = useRef<Carriage>({ revision: -1, carried: null, away: false });
  useEffect(() => {
    if (!group.current) return;
    poseMatrix(object.worldFromObject, group.current.matrix);
    group.current.matrixWorldNeedsUpdate = true;
    carriage.current.carried = null;
  }, [object.worldFromObject]);
  // While a program is played with contact, parts are where physics has them; without, where the gripper takes them.
  useFrame(() => {
    const frame = physicsNow();
    if (
      frame === null &&
      object.role === "workpiece" &&
      group.current &&
      carry(object, group.current, carriage.current)
    )
      return;
    if (frame === moved.current || !group.current || object.role !== "workpiece") return;
    moved.current = frame;
    const at = frame === null ? -1 : partOffset(object.id);
    if (frame === null || at < 0) poseMatrix(object.worldFromObject, group.current.matrix);
    else {
      for (let k = 0; k < 3; k++) place.position[k] = frame.parts[at + k]!;
      for (let k = 0; k < 4; k++) place.quaternion[k] = frame.parts[at + 3 + k]!;
      poseMatrix(place, group.current.matrix);
    }
    group.current.matrixWorldNeedsUpdate = true;
  }, -9);
  useEffect(
    () => paintTouching(name => (name === object.name || name === object.id ? group.current : null)),
    [object.name, object.id],
  );

  const wall = object.role === "wall";
  const box = object.shape.kind === "box" ? object.shape.size_m : null;
  const cardboard = object.role === "workpiece" && box !== null && looksLikeCardboard(object.color);
  return (
    <group
      ref={group}
      name={object.id}
      matrixAutoUpdate={false}
      visible={!object.hidden}
      userData={{ thing: { kind: "object", id: object.id }, unpickable: object.locked === true }}
    >
      {object.shape.kind === "part" ? (
        <Part shape={object.shape} />
      ) : wall ? (
        <Wall geometry={geometry} edges={edges} color={object.color} size_m={box} theme={theme} glass={glass} />
      ) : cardboard ? (
        <Carton geometry={geometry} size_m={box} color={object.color} />
      ) : (
        <mesh geometry={geometry} castShadow receiveShadow raycast={raycastByTree}>
          <meshStandardMaterial
            color={object.color}
            roughness={object.role === "furniture" ? 0.48 : 0.62}
            metalness={object.role === "furniture" ? 0.25 : 0.05}
          />
        </mesh>
      )}
      {object.role === "workpiece" && <GraspMark id={object.id} geometry={geometry} theme={theme} />}
    </group>
  );
}

/** A part of the library: a mesh for each of its materials. */
function Part({ shape }: { readonly shape: Extract<ObjectRecord["shape"], { kind: "part" }> }) {
  const pieces = useMemo(() => partGeometries(shape), [shape]);
  useEffect(
    () => () => {
      for (const { geometry } of pieces) geometry.dispose();
    },
    [pieces],
  );
  return pieces.map(({ material, geometry }) => (
    <mesh
      key={material}
      geometry={geometry}
      material={partMaterial(material)}
      castShadow
      receiveShadow
      raycast={raycastByTree}
    />
  ));
}

/** A matt panel that keeps to the background, and is gone when it stands between the camera and the cell. */
function Wall({
  geometry,
  edges,
  color,
  size_m,
  theme,
  glass,
}: {
  readonly glass: boolean;
  readonly geometry: BufferGeometry;
  readonly edges: EdgesGeometry;
  readonly color: string;
  readonly size_m: readonly [number, number, number] | null;
  readonly theme: SceneTheme;
}) {
  const mesh = useRef<Mesh>(null);
  const lines = useRef<LineSegments>(null);
  const paint = useMemo(
    () =>
      theme.floor
        .clone()
        .multiplyScalar(theme.dark ? 1.5 : 1)
        .lerp(new Color(color), theme.dark ? 0.06 : 0.4),
    [color, theme],
  );
  useFrame(({ camera }) => {
    if (!mesh.current || !lines.current || !size_m) return;
    const hides = wallHides(mesh.current, size_m, MIDDLE, camera);
    mesh.current.visible = !hides || glass;
    lines.current.visible = !hides && !glass;
  }, -7);
  return (
    <>
      <mesh ref={mesh} geometry={geometry} receiveShadow={!glass}>
        <meshLambertMaterial
          key={glass ? "glass" : "panel"}
          color={paint}
          transparent={glass}
          opacity={glass ? 0.1 : 1}
          depthWrite={!glass}
        />
      </mesh>
      <lineSegments ref={lines} geometry={edges} userData={{ unpainted: true }} raycast={() => undefined}>
        <lineBasicMaterial color={theme.text} transparent opacity={theme.dark ? 0.22 : 0.3} />
      </lineSegments>
    </>
  );
}
/** A point inside every cell: where robots stand, at half height. Scene coordinates. */
const MIDDLE = new Vector3(0.3, 0.8, 0);

/** A taped carton: kraft paper, a tape over the seam of the lid and down both ends. */
function Carton({
  geometry,
  size_m: [x, y, z],
  color,
}: {
  readonly geometry: BufferGeometry;
  readonly size_m: readonly [number, number, number];
  readonly color: string;
}) {
  const texture = useMemo(() => kraftTexture(color), [color]);
  useEffect(() => () => texture.dispose(), [texture]);
  const long = x >= y;
  const length = long ? x : y;
  const tape = Math.min(0.05, (long ? y : x) * 0.2);
  const thin = 0.0006;
  const down = Math.min(0.06, z * 0.3);
  const tapes = useMemo(() => {
    const strip = (place: [number, number, number], size: [number, number, number]) =>
      new BoxGeometry(...(long ? size : ([size[1], size[0], size[2]] as const))).translate(
        ...(long ? place : ([place[1], place[0], place[2]] as const)),
      );
    const parts = [
      strip([0, 0, z / 2 + thin / 2], [length + 2 * thin, tape, thin]),
      ...[1, -1].map(side => strip([side * (length / 2 + thin / 2), 0, z / 2 - down / 2], [thin, tape, down])),
    ];
    const merged = mergeGeometries(parts);
    for (const part of parts) part.dispose();
    return merged;
  }, [long, length, tape, thin, down, z]);
  useEffect(() => () => tapes.dispose(), [tapes]);
  return (
    <>
      <mesh geometry={geometry} castShadow receiveShadow>
        <meshStandardMaterial map={texture} roughness={0.93} metalness={0} bumpMap={texture} bumpScale={0.25} />
      </mesh>
      <mesh position={[0, 0, z / 2 + 0.0001]}>
        <boxGeometry args={long ? [length * 0.994, 0.0018, 0.0004] : [0.0018, length * 0.994, 0.0004]} />
        <meshStandardMaterial color="#5d4325" roughness={1} />
      </mesh>
      <mesh geometry={tapes} receiveShadow>
        <meshStandardMaterial color="#c9a572" roughness={0.28} metalness={0} transparent opacity={0.82} />
      </mesh>
    </>
  );
}
