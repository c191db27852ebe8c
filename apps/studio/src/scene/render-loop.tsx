import { useFrame, useThree } from "@react-three/fiber";
import type { Vector3 as Vector } from "@twincell/core";
import { type RefObject, useEffect, useMemo } from "react";
import { PerspectiveCamera, Quaternion } from "three";
import { takeEffort_ms } from "../runtime/effort.ts";
import { chosenPresetAxis } from "../runtime/jog/orientation-presets.ts";
import { onTouching, theLive } from "../runtime/live.ts";
import { othersRevision, shownRobot } from "../runtime/robot/drawn-robots.ts";
import { jogStore } from "../stores/jog.ts";
import { viewStore } from "../stores/view.ts";
import { closeCameraPosition, closeCameraSide, closeCameraUp } from "./camera/close-camera.ts";
import { turnCube } from "./camera/view-cube.tsx";
import type { FrameMeter } from "./frame-meter.ts";
import type { PictureFrame } from "./picture.ts";
import { Sharpness } from "./sharpness.ts";
import { toScene } from "./world-space.ts";

const place: Vector = [0, 0, 0];
const side: Vector = [0, 0, 0];
const up: Vector = [0, 0, 0];

/** Renders the frame: the view, and the other camera as a picture in it. Measures script and draw time apart. */
export function RenderLoop({
  meter,
  picture,
  cube,
  close,
}: {
  readonly meter: FrameMeter;
  /** Follows the TCP; placed anew every frame. */
  readonly close: PerspectiveCamera;
  readonly picture: PictureFrame;
  readonly cube: RefObject<HTMLDivElement | null>;
}) {
  const overview = useMemo(() => new PerspectiveCamera(36, 1.4, 0.05, 60), []);
  const clock = useMemo(() => ({ start: 0, turned: new Quaternion(0, 0, 0, 0) }), []);
  const invalidate = useThree(state => state.invalidate);
  const sharpness = useMemo(() => new Sharpness(), []);

  // Nothing is drawn while nothing changes: two comparisons per display frame keep watch.
  useEffect(() => {
    let seen = -1;
    let others = -1;
    let handle = 0;
    const watch = (): void => {
      const { revision } = shownRobot();
      const moved = othersRevision();
      if (revision !== seen || moved !== others) {
        seen = revision;
        others = moved;
        invalidate();
      }
      handle = requestAnimationFrame(watch);
    };
    handle = requestAnimationFrame(watch);
    const stops = [
      viewStore.subscribe(() => invalidate()),
      onTouching(() => invalidate()),
      jogStore.subscribe(({ aid }, before) => {
        if (aid !== before.aid) invalidate();
      }),
    ];
    return () => {
      cancelAnimationFrame(handle);
      for (const stop of stops) stop();
    };
  }, [invalidate]);

  useFrame(() => {
    clock.start = performance.now();
  }, -2000);
  useFrame(({ gl, scene, camera, size }) => {
    const drawing = performance.now();
    meter.addScript(drawing - clock.start);
    if (gl.xr.isPresenting) {
      gl.render(scene, camera);
    } else {
      sharpness.choose(gl, camera, invalidate);
      const view = viewStore.getState();
      const { worldFromTcp } = theLive();
      closeCameraSide(chosenPresetAxis(), side);
      closeCameraPosition(worldFromTcp, view.closePlacement, view.closeTilt_rad, side, place);
      toScene(place, close.position);
      toScene(closeCameraUp(view.closeTilt_rad, side, up), close.up);
      close.lookAt(worldFromTcp.position[0], worldFromTcp.position[2], -worldFromTcp.position[1]);
      const large = view.camera === "main" ? camera : close;
      close.aspect = size.width / size.height;
      close.updateProjectionMatrix();
      gl.setScissorTest(false);
      gl.setViewport(0, 0, size.width, size.height);
      gl.render(scene, large);
      if (picture.visible) {
        const small = view.camera === "main" ? close : overview;
        if (small === overview) {
          overview.position.copy(camera.position);
          overview.quaternion.copy(camera.quaternion);
        }
        small.aspect = picture.width / picture.height;
        small.updateProjectionMatrix();
        const below = size.height - picture.top - picture.height;
        gl.setScissorTest(true);
        gl.setScissor(picture.left, below, picture.width, picture.height);
        gl.setViewport(picture.left, below, picture.width, picture.height);
        gl.shadowMap.needsUpdate = false;
        gl.render(scene, small);
        gl.setScissorTest(false);
        gl.setViewport(0, 0, size.width, size.height);
      }
    }
    const drawn = performance.now();
    if (cube.current && !camera.quaternion.equals(clock.turned)) {
      clock.turned.copy(camera.quaternion);
      turnCube(cube.current, camera);
    }
    meter.addDraw(drawn - drawing);
    meter.addScript(performance.now() - drawn + takeEffort_ms());
    meter.endFrame();
  }, 1);
  return null;
}
