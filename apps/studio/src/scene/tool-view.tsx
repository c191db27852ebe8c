import { compose, identity, type Pose } from "@twincell/core";
import type { Shape, ToolRecord } from "@twincell/project";
import { useFrame } from "@react-three/fiber";
import { useEffect, useMemo, useRef } from "react";
import { BufferAttribute, type BufferGeometry, Color, type Group } from "three";
import { shownRobot } from "../runtime/robot/drawn-robots.ts";
import { Fingers } from "./physical/fingers.tsx";
import { partGeometries, partMaterial } from "./objects/part-geometry.ts";
import { shapeGeometry } from "./objects/shape-geometry.ts";
import { paintTouching } from "./paint.ts";
import { raycastByTree } from "./pick/raycast.ts";
import { poseMatrix } from "./pose-matrix.ts";

const BODY = new Color("#2b3136");
const TIP = new Color("#c98f45");

/** The last fifth of a tool along the flange axis is drawn in copper, so that the working end shows. */
export function toolGeometry(tool: ToolRecord): BufferGeometry | null {
  if (!tool.shape) return null;
  const geometry = shapeGeometry(tool.shape);
  const position = geometry.getAttribute("position");
  geometry.computeBoundingBox();
  const { min, max } = geometry.boundingBox!;
  const from = max.z - (max.z - min.z) * 0.2;
  const colors = new Float32Array(position.count * 3);
  for (let i = 0; i < position.count; i++) (position.getZ(i) > from ? TIP : BODY).toArray(colors, 3 * i);
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  return geometry;
}

const WIRE_RADIUS_M = 0.0012;

/** Where the solid ends before the TCP, a thin wire shows the way to it. */
function Wire({ tool, from_m }: { readonly tool: ToolRecord; readonly from_m: number }) {
  const [x, y, z] = tool.flangeFromTcp.position;
  const length = z - from_m;
  if (Math.hypot(x, y) > 1e-6 || length < 1e-4) return null;
  return (
    <mesh position={[0, 0, from_m + length / 2]} rotation={[Math.PI / 2, 0, 0]} castShadow>
      <cylinderGeometry args={[WIRE_RADIUS_M, WIRE_RADIUS_M, length, 12]} />
      <meshStandardMaterial color={TIP} roughness={0.4} metalness={0.7} />
    </mesh>
  );
}

/** A tool of the library in its own materials. */
function PartTool({ shape }: { readonly shape: Extract<Shape, { kind: "part" }> }) {
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

/** The tool in use, carried by the flange. */
export function ToolView({
  tool,
  worldFromBase,
}: {
  readonly tool: ToolRecord;
  readonly worldFromBase: Pose<"world", "base">;
}) {
  const group = useRef<Group>(null);
  const seen = useRef(-1);
  const geometry = useMemo(() => toolGeometry(tool), [tool]);
  const world = useMemo(() => identity<"world", "flange">(), []);
  useEffect(() => () => geometry?.dispose(), [geometry]);
  useEffect(() => {
    seen.current = -1;
  }, [tool, worldFromBase]);
  useEffect(() => paintTouching(name => (name === "tool" || name === tool.name ? group.current : null)), [tool.name]);
  useFrame(() => {
    const live = shownRobot();
    if (live.revision === seen.current || !group.current) return;
    seen.current = live.revision;
    poseMatrix(compose(worldFromBase, live.baseFromFlange, world), group.current.matrix);
    group.current.matrixWorldNeedsUpdate = true;
  }, -10);
  return (
    <group ref={group} name="tool" matrixAutoUpdate={false} userData={{ thing: { kind: "tool" } }}>
      {tool.shape && tool.shape.kind !== "part" && <Wire tool={tool} from_m={geometry?.boundingBox?.max.z ?? 0} />}
      {tool.gripper && tool.shape?.kind !== "part" && <Fingers tool={tool} gripper={tool.gripper} />}
      {tool.shape?.kind === "part" && <PartTool shape={tool.shape} />}
      {geometry && tool.shape?.kind !== "part" && (
        <mesh geometry={geometry} castShadow receiveShadow raycast={raycastByTree}>
          <meshStandardMaterial vertexColors roughness={0.36} metalness={0.6} />
        </mesh>
      )}
    </group>
  );
}
