import { useFrame } from "@react-three/fiber";
import { Container, Text } from "@react-three/uikit";
import { useMemo, useRef } from "react";
import { BoxGeometry, CylinderGeometry, type Group, Matrix4, MeshStandardMaterial, Quaternion, Vector3 } from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { useStore } from "zustand";
import { theConnected } from "../../runtime/robot/cell-connection.ts";
import { connectionStore } from "../../stores/connection.ts";
import { headsetStore } from "../../stores/headset.ts";
import { notify } from "../../stores/notices.ts";
import { sound } from "../../stores/sound.ts";
import { stationStore } from "../../stores/stations.ts";
import { stopEverything } from "../../stores/stop.ts";
import { words } from "../../messages/index.ts";
import { feel } from "./haptics.ts";

const SAID = words.headset;
const BOX_M = 0.1;
const DEEP_M = 0.05;
const MUSHROOM_M = 0.034;
const MUSHROOM_HIGH_M = 0.03;
/** Pressed by a finger or the tip of a controller that comes from before it and goes this far in. */
const PRESSED_M = DEEP_M / 2 + MUSHROOM_HIGH_M - 0.008;
const BEFORE_M = DEEP_M / 2 + MUSHROOM_HIGH_M + 0.01;
/** Beside the hip, a little ahead, tilted up to the eyes [m, rad]. */
const BESIDE_M = 0.34;
const AHEAD_M = 0.3;
const BELOW_EYES_M = 0.56;
const TILT_RAD = -0.9;
/** It goes along when the person has walked or turned this far, not with every look. */
const WALKED_M = 0.25;
const TURNED_RAD = 0.8;

const eye = new Vector3();
const wanted = new Vector3();
const way = new Vector3();
const tip = new Vector3();
const turn = new Quaternion();
const roomFromScene = new Matrix4();
const buttonFromRoom = new Matrix4();

/** Presses it: everything stands still, and what is connected is told so in its own protocol. */
export function pressEmergency(): void {
  stopEverything();
  theConnected()?.drivesOff();
  headsetStore.setState({ emergency: true });
  sound("crash");
  notify("bad", SAID.emergencyTold);
}

/**
 * The emergency stop at the right hip, or at the left one of who wears the plate on the right: an object of its own,
 * never on the plate, pressed by hand alone and latching. Of a real robot it says what it is not.
 */
export function EmergencyButton() {
  const pressed = useStore(headsetStore, state => state.emergency);
  const left = useStore(headsetStore, state => state.wrist === "right");
  const station = useStore(connectionStore, state => state.station);
  const real = useStore(stationStore, ({ stations }) => stations.some(({ id, virtual }) => id === station && !virtual));
  const group = useRef<Group>(null);
  const work = useMemo(
    () => ({ placed: false, yaw_rad: 0, at: new Vector3(), before: new WeakMap<XRInputSource, boolean>() }),
    [],
  );
  const [box, mushroom] = useMemo(
    () => [
      new BoxGeometry(BOX_M, BOX_M, DEEP_M, 1, 1, 1),
      mergeGeometries([
        new CylinderGeometry(MUSHROOM_M, MUSHROOM_M * 0.92, 0.014, 40).translate(0, MUSHROOM_HIGH_M - 0.007, 0),
        new CylinderGeometry(MUSHROOM_M * 0.55, MUSHROOM_M * 0.55, MUSHROOM_HIGH_M, 32).translate(
          0,
          MUSHROOM_HIGH_M / 2,
          0,
        ),
      ])
        .rotateX(Math.PI / 2)
        .translate(0, 0, DEEP_M / 2),
    ],
    [],
  );
  const [yellow, red] = useMemo(
    () => [
      new MeshStandardMaterial({ color: "#f2b100", roughness: 0.5 }),
      new MeshStandardMaterial({ color: "#c8201c", roughness: 0.4 }),
    ],
    [],
  );

  useFrame(({ gl, camera }, _dt, frame: XRFrame | undefined) => {
    const at = group.current;
    const space = gl.xr.getReferenceSpace();
    const session = gl.xr.getSession();
    if (!at?.parent || !frame || !space || !session) return;
    follow(at, camera.matrixWorld, work, left ? -1 : 1);
    buttonFromRoom.copy(at.matrix).invert();
    for (const source of session.inputSources) {
      const space_ = source.hand?.get("index-finger-tip") ?? source.gripSpace;
      const pose = space_ ? frame.getPose(space_, space) : undefined;
      if (!pose) continue;
      const { position } = pose.transform;
      tip.set(position.x, position.y, position.z).applyMatrix4(buttonFromRoom);
      const over = Math.hypot(tip.x, tip.y) < BOX_M / 2;
      if (over && tip.z < PRESSED_M && tip.z > -BOX_M && work.before.get(source) === true) {
        work.before.set(source, false);
        if (!headsetStore.getState().emergency) {
          feel(source, "emergency");
          pressEmergency();
        }
      } else if (tip.z > BEFORE_M || !over) work.before.set(source, tip.z > BEFORE_M && over);
    }
  }, -21);

  return (
    <group ref={group} name="emergency-stop">
      <mesh geometry={box} material={yellow} />
      <mesh geometry={mushroom} material={red} position-z={pressed ? -0.014 : 0} />
      <group position={[0, -BOX_M / 2 - 0.012, DEEP_M / 2]}>
        <Container
          id="emergency-words"
          anchorX="center"
          anchorY="top"
          pixelSize={0.0006}
          paddingX={16}
          paddingY={8}
          width={real ? 460 : 190}
          alignItems="center"
          flexDirection="column"
          borderRadius={14}
          backgroundColor="#ffffff"
          pointerEvents="none"
        >
          <Text fontSize={30} fontWeight="bold" color="#8d1010">
            {real ? SAID.drivesOff : SAID.emergency}
          </Text>
          {real && (
            <Text fontSize={26} color="#3a1010">
              {SAID.notSafety}
            </Text>
          )}
        </Container>
      </group>
    </group>
  );
}

/** Room coordinates: stays where it is while the person looks about, and comes along when they walk or turn. */
function follow(
  at: Group,
  cameraMatrix: Matrix4,
  work: { placed: boolean; yaw_rad: number; readonly at: Vector3 },
  side: 1 | -1,
): void {
  roomFromScene.copy(at.parent!.matrixWorld).invert().multiply(cameraMatrix);
  eye.setFromMatrixPosition(roomFromScene);
  way.set(0, 0, -1).transformDirection(roomFromScene);
  const yaw_rad = Math.atan2(-way.x, -way.z);
  const turned_rad = Math.abs(Math.atan2(Math.sin(yaw_rad - work.yaw_rad), Math.cos(yaw_rad - work.yaw_rad)));
  const walked_m = Math.hypot(eye.x - work.at.x, eye.y - work.at.y, eye.z - work.at.z);
  if (!work.placed || turned_rad > TURNED_RAD || walked_m > WALKED_M) {
    work.placed = true;
    work.yaw_rad = yaw_rad;
    work.at.copy(eye);
  }
  const [s, c] = [Math.sin(work.yaw_rad), Math.cos(work.yaw_rad)];
  wanted.set(side * BESIDE_M * c - AHEAD_M * s, -BELOW_EYES_M, -side * BESIDE_M * s - AHEAD_M * c).add(work.at);
  at.position.copy(wanted);
  at.quaternion.setFromAxisAngle(UP, work.yaw_rad).multiply(turn.setFromAxisAngle(RIGHT, TILT_RAD));
  at.updateMatrix();
}
const UP = new Vector3(0, 1, 0);
const RIGHT = new Vector3(1, 0, 0);
