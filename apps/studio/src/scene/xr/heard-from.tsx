import { useThree } from "@react-three/fiber";
import { useEffect } from "react";
import { Matrix4, Vector3 } from "three";
import { theLive } from "../../runtime/live.ts";
import { soundsComeFrom } from "../../stores/sound.ts";
import { toScene } from "../world-space.ts";

/** Contact, limit and grasp are heard from where the tool is; what concerns the whole page is heard from nowhere. */
export function HeardFrom() {
  const gl = useThree(state => state.gl);
  useEffect(() => {
    const tool = new Vector3();
    const headFromScene = new Matrix4();
    soundsComeFrom(name => {
      if (name === "done" || name === "link-lost" || !gl.xr.isPresenting) return null;
      headFromScene.copy(gl.xr.getCamera().matrixWorld).invert();
      const { x, y, z } = toScene(theLive().worldFromTcp.position, tool).applyMatrix4(headFromScene);
      return [x, y, z];
    });
    return () => {
      soundsComeFrom(null);
    };
  }, [gl]);
  return null;
}
