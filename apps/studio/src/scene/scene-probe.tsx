import { useThree } from "@react-three/fiber";
import { useEffect } from "react";
import { type Camera, type Scene, Vector3, type WebGLRenderer } from "three";
import type { Vector3 as WorldVector } from "@twincell/core";
import type { FrameMeter } from "./frame-meter.ts";
import { toScene } from "./world-space.ts";

/** What tests, benchmarks and helping technology may ask of the picture. */
export interface SceneProbe {
  /** Where a point of the world is on the page [CSS pixels]; `visible` is false behind the camera. */
  project(point: WorldVector): { readonly x: number; readonly y: number; readonly visible: boolean };
  readonly frames: number;
  readonly meter: FrameMeter;
  readonly camera: Camera;
  /** The camera that follows the TCP, as the last frame placed it. */
  readonly closeCamera: Camera;
  readonly gl: WebGLRenderer;
  readonly scene: Scene;
  /** Draw calls and triangles of the last frame. */
  drawn(): { readonly calls: number; readonly triangles: number };
}
declare global {
  interface Window {
    twincellScene?: SceneProbe;
  }
}

export function Probe({ meter, close }: { readonly meter: FrameMeter; readonly close: Camera }) {
  const get = useThree(state => state.get);
  useEffect(() => {
    const point = new Vector3();
    window.twincellScene = {
      project(world) {
        const { camera, gl } = get();
        const box = gl.domElement.getBoundingClientRect();
        camera.updateMatrixWorld();
        toScene(world, point).project(camera);
        return {
          x: box.left + ((point.x + 1) / 2) * box.width,
          y: box.top + ((1 - point.y) / 2) * box.height,
          visible: point.z < 1,
        };
      },
      get frames() {
        return meter.frames;
      },
      meter,
      get camera() {
        return get().camera;
      },
      closeCamera: close,
      get gl() {
        return get().gl;
      },
      get scene() {
        return get().scene;
      },
      drawn() {
        const { render } = get().gl.info;
        return { calls: render.calls, triangles: render.triangles };
      },
    };
    return () => {
      delete window.twincellScene;
    };
  }, [get, meter, close]);
  return null;
}
