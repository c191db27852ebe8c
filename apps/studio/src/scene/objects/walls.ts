import { type Camera, Matrix4, type Object3D, Vector3 } from "three";

const place = new Vector3();
const eye = new Vector3();
const inverse = new Matrix4();

/**
 * Whether a wall stands between the camera and the cell: the camera is on the other side of it than the middle of the
 * cell. The wall is a box; its thinnest side is its normal.
 */
export function wallHides(
  wall: Object3D,
  size_m: readonly [number, number, number],
  middle: Vector3,
  camera: Camera,
): boolean {
  const thin = size_m[0] <= size_m[1] && size_m[0] <= size_m[2] ? 0 : size_m[1] <= size_m[2] ? 1 : 2;
  inverse.copy(wall.matrixWorld).invert();
  camera.getWorldPosition(eye).applyMatrix4(inverse);
  place.copy(middle).applyMatrix4(inverse);
  return eye.getComponent(thin) * place.getComponent(thin) < 0 && Math.abs(eye.getComponent(thin)) > size_m[thin]! / 2;
}
