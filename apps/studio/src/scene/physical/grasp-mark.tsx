import { GRASP_MARK_HEIGHT, type GraspSignal } from "@twincell/core";
import { useFrame } from "@react-three/fiber";
import { useMemo, useRef } from "react";
import { type BufferGeometry, Sprite, SpriteMaterial } from "three";
import { partOffset, physicsNow } from "../../runtime/physics/physics.ts";
import type { SceneTheme } from "../theme.ts";

const SIZE_M = [0.034, 0.014] as const;

/**
 * The mark on a work piece (row M-21): a small rectangle whose colour and height say whether the fingers touch or hold
 * it. It is seen through what stands before it, since a gripper hides what it holds.
 */
export function GraspMark({
  id,
  geometry,
  theme,
}: {
  readonly id: string;
  readonly geometry: BufferGeometry;
  readonly theme: SceneTheme;
}) {
  const shown = useRef<GraspSignal | null>(null);
  const sprite = useMemo(() => {
    const made = new Sprite(new SpriteMaterial({ depthTest: false, toneMapped: false, transparent: true }));
    made.scale.set(SIZE_M[0], SIZE_M[1], 1);
    made.renderOrder = 5;
    made.visible = false;
    made.userData.unpickable = true;
    made.raycast = () => undefined;
    return made;
  }, []);
  useFrame(() => {
    const frame = physicsNow();
    const at = partOffset(id) / 7;
    const signal = frame === null || at < 0 ? null : (frame.grasp[at] ?? null);
    if (signal === shown.current) return;
    shown.current = signal;
    sprite.visible = signal !== null;
    if (signal === null) return;
    geometry.computeBoundingBox();
    const { min, max } = geometry.boundingBox!;
    sprite.position.set((min.x + max.x) / 2, (min.y + max.y) / 2, min.z + GRASP_MARK_HEIGHT[signal] * (max.z - min.z));
    sprite.material.color = signal === "held" ? theme.run : signal === "ready" ? theme.near : theme.text;
    sprite.material.opacity = signal === "free" ? 0.55 : 1;
  }, -9);
  return <primitive object={sprite} />;
}
