import { useFrame, useThree } from "@react-three/fiber";
import { useEffect, useMemo } from "react";
import { PerspectiveCamera, Quaternion, Vector3 } from "three";
import { markerView, onMarkerPicture } from "../../runtime/marker/marker-camera.ts";
import { toScene } from "../world-space.ts";
import { lensProjection } from "./lens-projection.ts";

/** From the world (z up) to the scene (y up), and from a camera that looks along z to one that looks along −z. */
const SCENE_FROM_WORLD = new Quaternion(-Math.SQRT1_2, 0, 0, Math.SQRT1_2);
const FLIP = new Quaternion(1, 0, 0, 0);

/** The scene's camera stands where the device's camera is, and has its lens. What it was before comes back. */
export function MarkerCamera() {
  const camera = useThree(state => state.camera);
  const invalidate = useThree(state => state.invalidate);
  const turned = useMemo(() => new Quaternion(), []);
  useEffect(() => onMarkerPicture(() => invalidate()), [invalidate]);
  useEffect(() => {
    const place = new Vector3().copy(camera.position);
    const orientation = new Quaternion().copy(camera.quaternion);
    return () => {
      camera.position.copy(place);
      camera.quaternion.copy(orientation);
      if (camera instanceof PerspectiveCamera) camera.updateProjectionMatrix();
      invalidate();
    };
  }, [camera, invalidate]);
  useFrame(({ size }) => {
    if (markerView.revision < 0 || !(camera instanceof PerspectiveCamera)) return;
    const { position, quaternion } = markerView.worldFromCamera;
    toScene(position, camera.position);
    turned.set(quaternion[0], quaternion[1], quaternion[2], quaternion[3]);
    camera.quaternion.copy(SCENE_FROM_WORLD).multiply(turned).multiply(FLIP);
    lensProjection(markerView.lens, size.width, size.height, camera.near, camera.far, camera.projectionMatrix);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    camera.updateMatrixWorld();
  }, -4);
  return null;
}
