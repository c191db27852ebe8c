import { useThree } from "@react-three/fiber";
import { useEffect, useMemo } from "react";
import { useStore } from "zustand";
import { helpOf, judgedNow, lessonStore } from "../../stores/lesson.ts";
import { playStore } from "../../stores/play.ts";
import type { SceneTheme } from "../theme.ts";

/** Pink is what guides, and nothing else. */
const GUIDE = "#ff6fb5";
const RADIUS_M = 0.011;
const NEXT_M = 0.018;
const STICK_M = 0.09;

/** The goals of a lesson: balls with a stick from where the tool comes; those that are met turn green. */
export function LessonView({ theme }: { readonly theme: SceneTheme }) {
  const state = useStore(lessonStore);
  const plan = useStore(playStore, each => each.plan);
  const invalidate = useThree(each => each.invalidate);
  const { lesson } = state;
  const met = useMemo(() => (lesson && plan ? (judgedNow(lesson)?.met ?? []) : []), [lesson, plan]);
  const help = helpOf(state);
  useEffect(() => invalidate(), [lesson, met, help, invalidate]);
  if (!lesson || help === "none") return null;
  const next = lesson.goals.findIndex((_, i) => met[i] !== true);
  return lesson.goals.map(({ position_m, axis }, i) => {
    if (help === "next" && i !== next) return null;
    const isMet = met[i] === true;
    const end = position_m.map((value, k) => value - axis[k]! * STICK_M) as [number, number, number];
    return (
      <group key={i} userData={{ unpickable: true }}>
        <mesh position={[...position_m]} raycast={() => undefined} renderOrder={6}>
          <sphereGeometry args={[i === next ? NEXT_M : RADIUS_M, 20, 14]} />
          <meshBasicMaterial
            color={isMet ? theme.run : GUIDE}
            transparent
            opacity={i === next ? 0.85 : 0.5}
            depthTest={false}
            toneMapped={false}
          />
        </mesh>
        {!isMet && (
          <line>
            <bufferGeometry>
              <bufferAttribute attach="attributes-position" args={[new Float32Array([...position_m, ...end]), 3]} />
            </bufferGeometry>
            <lineBasicMaterial color={GUIDE} toneMapped={false} />
          </line>
        )}
      </group>
    );
  });
}
