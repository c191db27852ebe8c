import type { Pose } from "@twincell/core";
import type { ToolRecord } from "@twincell/project";
import { useFrame } from "@react-three/fiber";
import { useEffect, useMemo, useRef } from "react";
import {
  Color,
  DoubleSide,
  Float32BufferAttribute,
  type Group,
  type Mesh,
  MeshBasicMaterial,
  PerspectiveCamera,
  Vector3,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { useStore } from "zustand";
import { theLive } from "../../runtime/live.ts";
import { jogStore } from "../../stores/jog.ts";
import { viewStore } from "../../stores/view.ts";
import type { Interaction } from "../interaction.ts";
import type { SceneTheme } from "../theme.ts";
import { toScene } from "../world-space.ts";
import { ghostGeometry } from "./ghost-geometry.ts";
import { handleShapes, type HandleShape } from "./handle-shapes.ts";

/** Radius of the rings: this share of half the picture's height, whatever the distance; in a headset a fixed size. */
const SHARE = 0.135;
const HEADSET_RADIUS_M = 0.12;
const place = new Vector3();

/** Orientation of the handle: the tool's own axes when jogging in the tool frame, the world's otherwise. */
export function handleAxes(worldFromTcp: Pose<"world", "tcp">): Pose<"world", "tcp">["quaternion"] | null {
  return jogStore.getState().frame === "tool" ? worldFromTcp.quaternion : null;
}

/**
 * Rings, arrows and squares at the tool tip that can be dragged. Drawn over everything, so that it can be taken from
 * any side.
 */
export function TcpHandle({
  interaction,
  shown,
  theme,
  targets,
}: {
  readonly interaction: Interaction;
  readonly shown: boolean;
  readonly theme: SceneTheme;
  readonly targets: { current: readonly Mesh[] };
}) {
  const group = useRef<Group>(null);
  const inHeadset = useStore(viewStore, state => state.inHeadset);
  const shapes = useMemo(handleShapes, []);
  const materials = useMemo(
    () =>
      shapes.map(
        shape =>
          new MeshBasicMaterial({
            color: shape.part === "free" ? theme.accent : new Color(shape.color),
            transparent: true,
            depthTest: false,
            depthWrite: false,
            toneMapped: false,
            side: DoubleSide,
          }),
      ),
    [shapes, theme],
  );
  const nothing = useMemo(() => new MeshBasicMaterial({ visible: false }), []);
  const hits = useRef<(Mesh | null)[]>([]);
  useEffect(() => {
    targets.current = shown ? hits.current.filter(mesh => mesh !== null) : [];
    return () => {
      targets.current = [];
    };
  }, [targets, shown, shapes]);

  useFrame(({ camera, gl }) => {
    const at = group.current;
    if (!at) return;
    const { worldFromTcp } = theLive();
    const presenting = gl.xr.isPresenting;
    at.position.set(...worldFromTcp.position);
    const axes = handleAxes(worldFromTcp);
    if (axes) at.quaternion.set(...axes);
    else at.quaternion.identity();
    const distance = camera.position.distanceTo(toScene(worldFromTcp.position, place));
    const half = camera instanceof PerspectiveCamera ? Math.tan((camera.fov * Math.PI) / 360) * distance : distance;
    at.scale.setScalar(presenting ? HEADSET_RADIUS_M : half * SHARE);
    for (let i = 0; i < shapes.length; i++) {
      const { part } = shapes[i]!;
      const active = interaction.draggedPart === part;
      const hovered = interaction.hoveredPart === part;
      const square = part.length === 2 && !part.startsWith("r");
      materials[i]!.opacity =
        interaction.draggedPart && !active
          ? 0.16
          : active || hovered
            ? 1
            : square
              ? 0.42
              : part === "free"
                ? 0.85
                : 0.72;
    }
  }, -9);

  return (
    <group ref={group} visible={shown} userData={{ unpickable: true }}>
      {inHeadset && <WholeHandle theme={theme} shapes={shapes} />}
      {shapes.map((shape, i) => (
        <group key={shape.part} visible={!inHeadset}>
          <mesh geometry={shape.seen} material={materials[i]!} renderOrder={20} raycast={() => undefined} />
          <mesh
            ref={mesh => {
              hits.current[i] = mesh;
            }}
            geometry={shape.hit}
            material={nothing}
            userData={{ part: shape.part, unpickable: true }}
          />
        </group>
      ))}
    </group>
  );
}

/** In a headset the handle is taken as a whole: one draw call, its colours in its corners. */
function WholeHandle({ theme, shapes }: { readonly theme: SceneTheme; readonly shapes: readonly HandleShape[] }) {
  const geometry = useMemo(() => {
    const parts = shapes.map(({ part, color, seen }) => {
      const one = seen.toNonIndexed();
      const { r, g, b } = part === "free" ? theme.accent : new Color(color);
      const { count } = one.getAttribute("position");
      one.setAttribute(
        "color",
        new Float32BufferAttribute(
          Float32Array.from({ length: 3 * count }, (_, i) => [r, g, b][i % 3]!),
          3,
        ),
      );
      return one;
    });
    const whole = mergeGeometries(parts);
    for (const one of parts) one.dispose();
    return whole;
  }, [shapes, theme]);
  useEffect(() => () => geometry.dispose(), [geometry]);
  return (
    <mesh name="whole-handle" geometry={geometry} renderOrder={20} raycast={() => undefined}>
      <meshBasicMaterial
        vertexColors
        transparent
        opacity={0.85}
        depthTest={false}
        depthWrite={false}
        toneMapped={false}
        side={DoubleSide}
      />
    </mesh>
  );
}

/** The tool where the hand wants it while the robot cannot be there. */
export function Ghost({
  interaction,
  tool,
  theme,
}: {
  readonly interaction: Interaction;
  readonly tool: ToolRecord | undefined;
  readonly theme: SceneTheme;
}) {
  const group = useRef<Group>(null);
  useFrame(() => {
    const at = group.current;
    if (!at) return;
    at.visible = interaction.wanting;
    if (!interaction.wanting) return;
    at.position.set(...interaction.wanted.position);
    at.quaternion.set(...interaction.wanted.quaternion);
  }, -9);
  return (
    <group ref={group} visible={false} userData={{ unpickable: true }}>
      <GhostTool tool={tool} theme={theme} />
    </group>
  );
}

function GhostTool({ tool, theme }: { readonly tool: ToolRecord | undefined; readonly theme: SceneTheme }) {
  const geometry = useMemo(() => ghostGeometry(tool), [tool]);
  useEffect(() => () => geometry.dispose(), [geometry]);
  return (
    <mesh geometry={geometry} renderOrder={8}>
      <meshBasicMaterial color={theme.bad} transparent opacity={0.38} depthWrite={false} toneMapped={false} />
    </mesh>
  );
}
