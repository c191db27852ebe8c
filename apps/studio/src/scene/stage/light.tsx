import { useFrame, useThree } from "@react-three/fiber";
import { useEffect, useMemo, useRef } from "react";
import { type DirectionalLight, PMREMGenerator } from "three";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";
import { theLive } from "../../runtime/live.ts";
import { drawsInSoftware } from "../software.ts";
import type { SceneTheme } from "../theme.ts";

/** Half the side of the square that the key light's shadow map covers [m]. */
const SHADOW_HALF_M = 1.9;

/** A room made by code for reflections, and a warm key light with soft shadows. Lives in the z-up world. */
export function Light({ theme, anyChange }: { readonly theme: SceneTheme; readonly anyChange: object }) {
  const gl = useThree(state => state.gl);
  const scene = useThree(state => state.scene);
  const key = useRef<DirectionalLight>(null);
  const drawn = useRef(-1);

  useEffect(() => {
    const generator = new PMREMGenerator(gl);
    const room = new RoomEnvironment();
    const target = generator.fromScene(room, 0.04);
    scene.environment = target.texture;
    room.dispose();
    generator.dispose();
    return () => {
      scene.environment = null;
      target.dispose();
    };
  }, [gl, scene]);
  useEffect(() => {
    scene.environmentIntensity = theme.dark ? 0.42 : 0.4;
  }, [scene, theme]);
  const sides = useMemo(() => (drawsInSoftware(gl) ? 1024 : 2048), [gl]);
  useEffect(() => {
    key.current?.target.updateMatrixWorld();
    gl.shadowMap.autoUpdate = false;
    drawn.current = -1;
  }, [gl, anyChange]);

  // The shadow map is drawn again only when something moved: turning the camera costs nothing.
  useFrame(() => {
    const { revision } = theLive();
    if (revision !== drawn.current) {
      gl.shadowMap.needsUpdate = true;
      drawn.current = revision;
    }
  }, -5);

  return (
    <>
      <directionalLight
        ref={key}
        position={[2.5, -2.5, 4.5]}
        intensity={theme.dark ? 2.3 : 1.75}
        color="#fff4e6"
        castShadow
        shadow-mapSize={[sides, sides]}
        shadow-radius={4}
        shadow-bias={-0.0003}
        shadow-normalBias={0.012}
        shadow-camera-left={-SHADOW_HALF_M}
        shadow-camera-right={SHADOW_HALF_M}
        shadow-camera-top={SHADOW_HALF_M}
        shadow-camera-bottom={-SHADOW_HALF_M}
        shadow-camera-near={1}
        shadow-camera-far={9}
      >
        <object3D attach="target" position={[0.45, 0, 0.4]} />
      </directionalLight>
      <hemisphereLight args={["#e6eef6", "#4a4d50", theme.dark ? 0.9 : 1.15]} />
    </>
  );
}
