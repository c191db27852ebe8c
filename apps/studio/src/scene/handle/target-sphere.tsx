import { useFrame, useThree } from "@react-three/fiber";
import { useEffect, useMemo, useRef } from "react";
import { BufferGeometry, Float32BufferAttribute, Line, LineBasicMaterial, type Mesh, MeshBasicMaterial } from "three";
import { useStore } from "zustand";
import { targetRevision, theTarget } from "../../runtime/jog/follow-target.ts";
import { onFrame } from "../../runtime/jog/jog-frames.ts";
import { theLive } from "../../runtime/live.ts";
import { followTargetStore } from "../../stores/follow-target.ts";
import type { SceneTheme } from "../theme.ts";

const RADIUS_M = 0.025;

/** The target that the arm follows (row X-29): green where the tool is at it, amber behind it, red out of reach. */
export function TargetSphere({ theme }: { readonly theme: SceneTheme }) {
  const on = useStore(followTargetStore, state => state.on);
  return on ? <Sphere theme={theme} /> : null;
}

function Sphere({ theme }: { readonly theme: SceneTheme }) {
  const ball = useRef<Mesh>(null);
  const invalidate = useThree(state => state.invalidate);
  const { line, material } = useMemo(() => {
    const geometry = new BufferGeometry().setAttribute("position", new Float32BufferAttribute(new Float32Array(6), 3));
    const drawn = new Line(geometry, new LineBasicMaterial({ toneMapped: false, depthTest: false }));
    drawn.name = "target-distance";
    drawn.renderOrder = 7;
    drawn.frustumCulled = false;
    drawn.userData.unpickable = true;
    drawn.raycast = () => undefined;
    return {
      line: drawn,
      material: new MeshBasicMaterial({ transparent: true, opacity: 0.55, depthTest: false, toneMapped: false }),
    };
  }, []);
  useEffect(() => {
    let seen = -1;
    const leave = onFrame(() => {
      if (targetRevision() === seen) return;
      seen = targetRevision();
      invalidate();
    });
    const off = followTargetStore.subscribe(() => invalidate());
    invalidate();
    return () => {
      leave();
      off();
      line.geometry.dispose();
      line.material.dispose();
      material.dispose();
    };
  }, [invalidate, line, material]);
  useFrame(() => {
    const { position } = theTarget();
    ball.current?.position.set(...position);
    const ends = line.geometry.getAttribute("position");
    ends.setXYZ(0, ...theLive().worldFromTcp.position);
    ends.setXYZ(1, ...position);
    ends.needsUpdate = true;
    const { kind } = followTargetStore.getState();
    const colour = kind === "on-target" ? theme.run : kind === "behind" ? theme.near : theme.bad;
    material.color.copy(colour);
    line.material.color.copy(colour);
  }, -9);
  return (
    <>
      <mesh ref={ball} name="target-sphere" material={material} renderOrder={7} raycast={() => undefined}>
        <sphereGeometry args={[RADIUS_M, 24, 16]} />
      </mesh>
      <primitive object={line} />
    </>
  );
}
