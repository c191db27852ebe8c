import { useFrame } from "@react-three/fiber";
import { type RefObject, useMemo, useRef } from "react";
import { type Group, type Matrix4, MeshBasicMaterial, Quaternion, RingGeometry, Vector3 } from "three";
import { connectionStore } from "../../stores/connection.ts";
import { headsetStore, LARGEST_SCALE, SMALLEST_SCALE } from "../../stores/headset.ts";
import { roomStore } from "../../stores/room.ts";
import type { Interaction } from "../interaction.ts";
import { readStick, takesWith, turnsView } from "./controller-input.ts";

/** A stick pushed this far asks for something; let go below the second it can ask again. */
const PUSHED = 0.65;
const RESTED = 0.35;
const SNAP_RAD = Math.PI / 6;
const SMOOTH_RAD_PER_S = 1.2;
/** As a stone that is thrown along the ray: how fast [m/s], and how far down it may fall. */
const THROWN_MPS = 5.5;
const FARTHEST_M = 9;
const FALLS_MPS2 = 9.81;

interface Stick {
  asked: boolean;
  aiming: boolean;
}
const at = new Vector3();
const way = new Vector3();
const turn = new Quaternion();
const eye = new Vector3();
const left = new Vector3();
const right = new Vector3();
const middle = new Vector3();
const UP = new Vector3(0, 1, 0);

/**
 * Goes about: the stick pushed forward aims at the floor and, let go, stands there; to the side it turns. Both grips
 * squeezed away from the tool take the world: hands apart make it larger, within 1:20 … 2:1 (row L-07).
 */
export function Locomotion({
  origin,
  interaction,
}: {
  readonly origin: RefObject<Group | null>;
  readonly interaction: Interaction;
}) {
  const marker = useRef<Group>(null);
  const geometry = useMemo(() => new RingGeometry(0.16, 0.22, 48).rotateX(-Math.PI / 2), []);
  const material = useMemo(() => new MeshBasicMaterial({ color: "#2fa5a0", toneMapped: false }), []);
  const work = useMemo(
    () => ({
      sticks: new WeakMap<XRInputSource, Stick>(),
      stick: [0, 0] as [number, number],
      apart_m: 0,
      scale: 1,
      held: new Vector3(),
    }),
    [],
  );
  useFrame(({ gl, camera }, dt_s, frame: XRFrame | undefined) => {
    const person = origin.current;
    const space = gl.xr.getReferenceSpace();
    const session = gl.xr.getSession();
    if (!person || !marker.current || !frame || !space || !session) return;
    let aims = false;
    for (const source of session.inputSources) {
      if (!source.gamepad || !turnsView(source.handedness, headsetStore.getState().use)) continue;
      readStick(source.gamepad, work.stick);
      const [x, y] = work.stick;
      let stick = work.sticks.get(source);
      if (!stick) work.sticks.set(source, (stick = { asked: false, aiming: false }));
      // With the time line open the right stick goes through time.
      const free = source.handedness !== "right" || !roomStore.getState().history;
      if (free) turned(person, camera.matrixWorld, stick, x, y, dt_s);
      if (y < -PUSHED || stick.aiming) {
        const ray = frame.getPose(source.targetRaySpace, space);
        const lands = ray !== undefined && ray !== null && aimed(ray.transform, person);
        if (lands) {
          aims = true;
          marker.current.position.copy(at);
          marker.current.scale.setScalar(person.scale.x);
        }
        if (stick.aiming && Math.hypot(x, y) < RESTED) {
          stick.aiming = false;
          aims = false;
          if (lands) standAt(person, camera.matrixWorld);
        } else stick.aiming = true;
      }
    }
    marker.current.visible = aims;
    stretched(session, frame, space, person);
  }, -25);
  return (
    <group ref={marker} name="teleport-marker" visible={false}>
      <mesh geometry={geometry} material={material} position-y={0.01} />
    </group>
  );

  function stretched(session: XRSession, frame: XRFrame, space: XRReferenceSpace, person: Group): void {
    let count = 0;
    for (const source of session.inputSources) {
      if (!source.gamepad || !source.gripSpace || !takesWith(source.gamepad, headsetStore.getState().use)) continue;
      const grip = frame.getPose(source.gripSpace, space);
      if (!grip) continue;
      const { position } = grip.transform;
      (count++ === 0 ? left : right).set(position.x, position.y, position.z);
    }
    // With a robot connected, a squeezed grip enables it.
    if (count !== 2 || interaction.draggedPart !== null || connectionStore.getState().station !== null) {
      work.apart_m = 0;
      return;
    }
    middle.copy(left).add(right).multiplyScalar(0.5);
    const apart_m = Math.max(0.05, left.distanceTo(right));
    if (work.apart_m === 0) {
      work.apart_m = apart_m;
      work.scale = headsetStore.getState().scale;
      work.held.copy(middle).applyMatrix4(person.matrixWorld);
      return;
    }
    const scale = Math.min(LARGEST_SCALE, Math.max(SMALLEST_SCALE, (work.scale * apart_m) / work.apart_m));
    headsetStore.setState({ scale });
    person.scale.setScalar(1 / scale);
    // What was between the hands stays between them.
    middle.multiplyScalar(1 / scale).applyQuaternion(person.quaternion);
    person.position.copy(work.held).sub(middle);
    person.updateMatrixWorld();
  }
}

/** Turns about the eyes, so that nothing but the direction changes. */
function turned(person: Group, camera: Matrix4, stick: Stick, x: number, y: number, dt_s: number): void {
  const sideways = Math.abs(x) > PUSHED && Math.abs(x) > Math.abs(y) && !stick.aiming;
  if (headsetStore.getState().turning === "smooth") {
    if (sideways) turnBy(person, camera, -Math.sign(x) * SMOOTH_RAD_PER_S * dt_s);
    return;
  }
  if (sideways && !stick.asked) {
    stick.asked = true;
    turnBy(person, camera, -Math.sign(x) * SNAP_RAD);
  } else if (Math.abs(x) < RESTED) stick.asked = false;
}

function turnBy(person: Group, camera: Matrix4, angle_rad: number): void {
  eye.setFromMatrixPosition(camera);
  turn.setFromAxisAngle(UP, angle_rad);
  person.position.sub(eye).applyQuaternion(turn).add(eye);
  person.quaternion.premultiply(turn);
  person.updateMatrixWorld();
}

/** Where a stone thrown along the ray meets the floor, written into `at`; false where it flies too far. */
function aimed(ray: XRRigidTransform, person: Group): boolean {
  const { position, orientation } = ray;
  at.set(position.x, position.y, position.z).applyMatrix4(person.matrixWorld);
  way
    .set(0, 0, -1)
    .applyQuaternion(turn.set(orientation.x, orientation.y, orientation.z, orientation.w))
    .applyQuaternion(person.quaternion);
  const size = person.scale.x;
  const v = THROWN_MPS * way.y;
  const t_s = (v + Math.sqrt(v * v + (2 * FALLS_MPS2 * Math.max(0, at.y)) / size)) / FALLS_MPS2;
  const far_m = THROWN_MPS * t_s * Math.hypot(way.x, way.z);
  if (!(far_m < FARTHEST_M)) return false;
  at.addScaledVector(way, THROWN_MPS * t_s * size);
  at.y = 0;
  return true;
}

/** The eyes come over the place that was aimed at; the height stays. */
function standAt(person: Group, camera: Matrix4): void {
  eye.setFromMatrixPosition(camera);
  person.position.x += at.x - eye.x;
  person.position.z += at.z - eye.z;
  person.updateMatrixWorld();
}

/** Resizes about the eyes when a size was chosen on the plate. */
export function resize(person: Group, camera: Matrix4, scale: number): void {
  const factor = 1 / (scale * person.scale.x);
  if (Math.abs(factor - 1) < 1e-9) return;
  eye.setFromMatrixPosition(camera);
  person.position.set(
    eye.x + (person.position.x - eye.x) * factor,
    person.position.y,
    eye.z + (person.position.z - eye.z) * factor,
  );
  person.scale.setScalar(1 / scale);
  person.updateMatrixWorld();
}
