import {
  orientationPresetAxis,
  orientationPreset,
  ORIENTATION_PRESET_COUNT,
  angleBetween,
  cross,
  degrees,
  fromAxisAngle,
  multiply,
  normalize,
  pose,
  rotate,
  subtract,
  type Quaternion,
  type Vector3,
} from "@twincell/core";
import { PerspectiveCamera, Vector3 as SceneVector } from "three";
import { beforeEach, expect, test } from "vitest";
import { tiltCloseCamera, toggleCamera, viewStore } from "../../stores/view.ts";
import { toScene } from "../world-space.ts";
import { closeCameraPosition, closeCameraSide, closeCameraUp } from "./close-camera.ts";

const worldFromTcp = pose<"world", "tcp">([0.7, 0.2, 0.55]);
const out: Vector3 = [0, 0, 0];
const free = closeCameraSide(null, [0, 0, 0]);
beforeEach(() => viewStore.setState({ camera: "main", closeTilt_rad: 0 }));

test("N-42 G-09 the close camera keeps 0.5, 0.5, 0.1 m from the TCP wherever it is", () => {
  for (const at of [
    [0.7, 0.2, 0.55],
    [-0.4, 1.1, 0.02],
  ] as const) {
    closeCameraPosition(pose<"world", "tcp">([...at]), "offset", 0, free, out);
    expect(Math.abs(out[0] - at[0])).toBeCloseTo(0.5, 12);
    expect(Math.abs(out[1] - at[1])).toBeCloseTo(0.5, 12);
    expect(out[2] - at[2]).toBeCloseTo(0.1, 12);
  }
});

test("N-45 by default it looks horizontally at the height of the TCP", () => {
  const { closePlacement, closeTilt_rad } = viewStore.getInitialState();
  closeCameraPosition(worldFromTcp, closePlacement, closeTilt_rad, free, out);
  expect(out[2]).toBeCloseTo(0.55, 12);
});

test("N-33 N-44 G-09 the trigger at half tilts the view by 45°, all of it looks straight down, more or less than that is cut off", () => {
  const elevation_deg = (trigger: number): number => {
    tiltCloseCamera(trigger);
    const { closePlacement, closeTilt_rad } = viewStore.getState();
    closeCameraPosition(worldFromTcp, closePlacement, closeTilt_rad, free, out);
    return degrees(Math.atan2(out[2] - 0.55, Math.hypot(out[0] - 0.7, out[1] - 0.2)));
  };
  expect([0, 0.25, 0.5, 1, 7, -3].map(trigger => Math.round(elevation_deg(trigger) * 1e6) / 1e6)).toEqual([
    0, 22.5, 45, 90, 90, 0,
  ]);
});

test("N-43 one camera fills the view; the toggle changes to the other and back", () => {
  expect(viewStore.getState().camera).toBe("main");
  toggleCamera();
  expect(viewStore.getState().camera).toBe("close");
  toggleCamera();
  expect(viewStore.getState().camera).toBe("main");
});

/** Lean of the tool axis against the upright edge of the picture, as three.js projects it [°, 0 … 90]. */
function lean_deg(quaternion: Quaternion, aid: number, tilt_rad: number): number {
  const side = closeCameraSide(orientationPresetAxis(piece, aid), [0, 0, 0]);
  const camera = new PerspectiveCamera(40, 1, 0.02, 60);
  const tip = worldFromTcp.position;
  const axis = rotate(quaternion, [0, 0, 1]);
  toScene(closeCameraPosition(worldFromTcp, "level", tilt_rad, side, out), camera.position);
  toScene(closeCameraUp(tilt_rad, side, out), camera.up);
  camera.lookAt(toScene(tip, new SceneVector()));
  camera.updateMatrixWorld();
  const [a, b] = [0, -0.1].map(back =>
    toScene([tip[0] + back * axis[0], tip[1] + back * axis[1], tip[2] + back * axis[2]], new SceneVector()).project(
      camera,
    ),
  );
  return degrees(Math.atan2(Math.abs(a!.x - b!.x), Math.abs(a!.y - b!.y)));
}
const piece = pose<"world", "object">([0.6, 0, 0.4], fromAxisAngle([0, 0, 1], 0.35));

test("N-46 the close camera is a calibre: a tool at the aid's orientation is parallel to the edge of its picture, a tool that leans by 2° is seen to lean", () => {
  for (let aid = 0; aid < ORIENTATION_PRESET_COUNT; aid++)
    for (const tilt_rad of [0, 0.2, 0.4]) {
      const right = orientationPreset(piece, aid);
      expect(lean_deg(right, aid, tilt_rad)).toBeLessThan(0.01);
      const about = normalize(cross(orientationPresetAxis(piece, aid), [0, 0, 1]));
      const sideways = normalize(cross(about, orientationPresetAxis(piece, aid)));
      const leaning = multiply(fromAxisAngle(sideways, (2 * Math.PI) / 180), right);
      expect(degrees(angleBetween(leaning, right))).toBeCloseTo(2, 6);
      expect(lean_deg(leaning, aid, tilt_rad)).toBeGreaterThan(1);
    }
});

test("N-46 the camera stays on the person's side and as far away as without an aid", () => {
  for (let aid = 0; aid < ORIENTATION_PRESET_COUNT; aid++) {
    const side = closeCameraSide(orientationPresetAxis(piece, aid), [0, 0, 0]);
    const from = subtract(closeCameraPosition(worldFromTcp, "level", 0.3, side, out), worldFromTcp.position);
    expect(side[0] * free[0] + side[1] * free[1]).toBeGreaterThanOrEqual(0);
    expect(Math.hypot(...from)).toBeCloseTo(Math.SQRT1_2, 12);
  }
});
