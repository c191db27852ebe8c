import { useFrame, useThree } from "@react-three/fiber";
import { useEffect, useRef } from "react";
import { type DirectionalLight, PMREMGenerator } from "three";
import { RoomEnvironment } from "three/examples/jsm/environments/RoomEnvironment.js";
import { theLive } from "../../live/live.ts";
import type { SceneTheme } from "../theme.ts";

/** Half the side of the square that the key light's shadow map covers [m]. */
const SHADOW_HALF_M = 1.9;

/** A room made by code for reflections, and a warm key light with soft shadows. Lives in the z-up world. */
export function Light({ theme, anyChange }: { readonly theme: SceneTheme; readonly anyChange: object }) {
  const gl = useThree(state => state.gl), scene = useThree(state => state.scene);
  const key = useRef<DirectionalLight>(null), drawn = useRef(-1);

  useEffect(() => {
    const generator = new PMREMGenerator(gl), room = new RoomEnvironment();
    const target = generator.fromScene(room, 0.04);
    scene.environment = target.texture;
    room.dispose();
    generator.dispose();
    return () => { scene.environment = null; target.dispose(); };
  }, [gl, scene]);
  useEffect(() => { scene.environmentIntensity = theme.dark ? 0.5 : 0.46; }, [scene, theme]);
  useEffect(() => { key.current?.target.updateMatrixWorld(); gl.shadowMap.autoUpdate = false; drawn.current = -1; }, [gl, anyChange]);

  // The shadow map is drawn again only when something moved: turning the camera costs nothing.
  useFrame(() => {
    const { revision } = theLive();
    if (revision !== drawn.current) { gl.shadowMap.needsUpdate = true; drawn.current = revision; }
  }, -5);

  return (
    <>
      <directionalLight ref={key} position={[2.5, -2.5, 4.5]} intensity={theme.dark ? 2.3 : 1.75} color="#fff4e6" castShadow
        shadow-mapSize={[2048, 2048]} shadow-radius={4} shadow-bias={-0.0003} shadow-normalBias={0.012}
        shadow-camera-left={-SHADOW_HALF_M} shadow-camera-right={SHADOW_HALF_M} shadow-camera-top={SHADOW_HALF_M} shadow-camera-bottom={-SHADOW_HALF_M} shadow-camera-near={1} shadow-camera-far={9}>
        <object3D attach="target" position={[0.45, 0, 0.4]} />
      </directionalLight>
      <directionalLight position={[-3, 2, 2.4]} intensity={theme.dark ? 0.5 : 0.25} color="#cfe2ff" />
      <hemisphereLight args={["#dfe9f2", "#3a3d40", theme.dark ? 0.22 : 0.2]} />
    </>
  );
}
