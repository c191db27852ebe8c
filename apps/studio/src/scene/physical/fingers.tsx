import type { ToolRecord } from "@twincell/project";
import { useFrame } from "@react-three/fiber";
import { useRef } from "react";
import type { Mesh } from "three";
import { physicsNow } from "../../runtime/physics/physics.ts";

/**
 * The palm and the two fingers of a gripper, as far open as physics has them; wide open otherwise. In the frame of the
 * flange.
 */
export function Fingers({
  tool,
  gripper,
}: {
  readonly tool: ToolRecord;
  readonly gripper: NonNullable<ToolRecord["gripper"]>;
}) {
  const fingers = useRef<(Mesh | null)[]>([]);
  const shown = useRef(Number.NaN);
  const {
    open_m,
    finger_m: [thick, wide, long],
    beyond_m,
  } = gripper;
  const { position, quaternion } = tool.flangeFromTcp;
  const palm_m = Math.max(0.02, position[2] - long);
  useFrame(() => {
    const opening = physicsNow()?.opening_m ?? open_m;
    if (opening === shown.current) return;
    shown.current = opening;
    [1, -1].forEach((side, i) => {
      fingers.current[i]?.position.setX(side * (opening / 2 + thick / 2));
    });
  }, -9);
  return (
    <group position={position} quaternion={quaternion}>
      <mesh position={[0, 0, -long - palm_m / 2]} castShadow receiveShadow>
        <boxGeometry args={[open_m + 2 * thick, Math.max(wide, 0.04), palm_m]} />
        <meshStandardMaterial color="#2b3136" roughness={0.36} metalness={0.6} />
      </mesh>
      {[0, 1].map(i => (
        <mesh
          key={i}
          ref={element => {
            fingers.current[i] = element;
          }}
          position={[(i === 0 ? 1 : -1) * (open_m / 2 + thick / 2), 0, (beyond_m - long) / 2]}
          castShadow
        >
          <boxGeometry args={[thick, wide, long + beyond_m]} />
          <meshStandardMaterial color="#c98f45" roughness={0.4} metalness={0.5} />
        </mesh>
      ))}
    </group>
  );
}
