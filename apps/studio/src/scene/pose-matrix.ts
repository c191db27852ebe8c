import type { Pose } from "@twincell/core";
import { Matrix4, Quaternion, Vector3 } from "three";

const place = new Vector3();
const turn = new Quaternion();
const one = new Vector3(1, 1, 1);

/** The 4 × 4 matrix of a pose. Allocates nothing. */
export function poseMatrix(pose: Pose, out: Matrix4): Matrix4 {
  place.set(pose.position[0], pose.position[1], pose.position[2]);
  turn.set(pose.quaternion[0], pose.quaternion[1], pose.quaternion[2], pose.quaternion[3]);
  return out.compose(place, turn, one);
}

/** The pose of a rigid matrix, written into `out`. */
export function matrixPose<A extends string, B extends string>(matrix: Matrix4, out: Pose<A, B>): Pose<A, B> {
  matrix.decompose(place, turn, scale);
  out.position[0] = place.x;
  out.position[1] = place.y;
  out.position[2] = place.z;
  out.quaternion[0] = turn.x;
  out.quaternion[1] = turn.y;
  out.quaternion[2] = turn.z;
  out.quaternion[3] = turn.w;
  return out;
}
const scale = new Vector3();
