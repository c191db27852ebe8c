import { useFrame } from "@react-three/fiber";
import { Container, Text } from "@react-three/uikit";
import { useXRInputSourceState } from "@react-three/xr";
import { useMemo, useRef } from "react";
import {
  type BufferGeometry,
  CapsuleGeometry,
  type Group,
  MeshBasicMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { useStore } from "zustand";
import { theLive } from "../../runtime/live.ts";
import { headsetStore } from "../../stores/headset.ts";
import { words } from "../../messages/index.ts";
import { toScene } from "../world-space.ts";

const SAID = words.headset.hint;
/** The gesture again and again until it is done [s]: come, close, and go aside a little. */
const ROUND_S = 2.6;
const COMES_FROM_M = 0.16;
const BESIDE_M = -0.17;
const ABOVE_M = -0.1;
const READ_FROM_M = 1.5;

const tip = new Vector3();
const eye = new Vector3();
const UP = new Vector3(0, 1, 0);

/** A translucent hand shows once, at the ring, how the tool is taken. It leaves when that was done and stays away. */
export function GrabHint() {
  const done = useStore(headsetStore, state => state.hintDone);
  const hand = useXRInputSourceState("hand", "right") !== undefined;
  return done ? null : <Hint hand={hand} />;
}

function Hint({ hand }: { readonly hand: boolean }) {
  const group = useRef<Group>(null);
  const ghost = useRef<Group>(null);
  const [open, closed] = useMemo(() => [handGeometry(1), handGeometry(0)], []);
  const material = useMemo(
    () =>
      new MeshBasicMaterial({
        color: "#2fa5a0",
        transparent: true,
        opacity: 0.5,
        depthWrite: false,
        toneMapped: false,
      }),
    [],
  );
  const since = useRef(0);
  useFrame(({ camera }, dt_s) => {
    const at = group.current;
    if (!at || !ghost.current) return;
    since.current = (since.current + dt_s) % ROUND_S;
    toScene(theLive().worldFromTcp.position, tip);
    eye.setFromMatrixPosition(camera.matrixWorld);
    at.position.copy(tip);
    at.rotation.y = Math.atan2(eye.x - tip.x, eye.z - tip.z);
    const scale = Math.max(1, tip.distanceTo(eye) / READ_FROM_M);
    at.scale.setScalar(scale);
    const part = since.current / ROUND_S;
    const comes = Math.min(1, part / 0.35);
    const isClosed = part > 0.42 && part < 0.9;
    const aside = part > 0.5 ? Math.min(1, (part - 0.5) / 0.3) * 0.05 : 0;
    ghost.current.position.set(COMES_FROM_M * (1 - comes) + aside, -0.08 * (1 - comes), 0.03 * (1 - comes));
    ghost.current.children[0]!.visible = !isClosed;
    ghost.current.children[1]!.visible = isClosed;
  }, -8);
  return (
    <group ref={group} name="grab-hint">
      <group ref={ghost}>
        <mesh geometry={open} material={material} renderOrder={9} />
        <mesh geometry={closed} material={material} renderOrder={9} visible={false} />
      </group>
      <group position={[BESIDE_M, ABOVE_M, 0]}>
        <Container
          id="grab-hint"
          anchorX="right"
          anchorY="top"
          pixelSize={0.001}
          paddingX={24}
          paddingY={16}
          flexDirection="column"
          borderRadius={18}
          backgroundColor="#ffffff"
          pointerEvents="none"
        >
          <Text id="hint-what" fontSize={38} fontWeight="bold" color="#14191c">
            {hand ? SAID.hand : SAID.controller}
          </Text>
          <Text fontSize={32} color="#3a464d">
            {SAID.says}
          </Text>
        </Container>
      </group>
    </group>
  );
}

/** A right hand whose thumb and index finger meet at the origin. @param open  1: apart; 0: closed. */
function handGeometry(open: number): BufferGeometry {
  const parts: BufferGeometry[] = [];
  const bone = (
    from: readonly [number, number, number],
    to: readonly [number, number, number],
    radius: number,
  ): void => {
    const a = new Vector3(...from);
    const b = new Vector3(...to);
    const along = b.clone().sub(a);
    const part = new CapsuleGeometry(radius, along.length(), 6, 12);
    const middle = a.add(b).multiplyScalar(0.5);
    part.applyQuaternion(new Quaternion().setFromUnitVectors(UP, along.clone().normalize()));
    part.translate(middle.x, middle.y, middle.z);
    parts.push(part);
  };
  const gap = 0.026 * open;
  // Index and thumb, two bones each, to the place where they meet.
  bone([0.075, 0.01, 0.02], [0.036, 0.034 + gap, 0.01], 0.0095);
  bone([0.036, 0.034 + gap, 0.01], [0.004, 0.008 + gap, 0], 0.0085);
  bone([0.088, -0.03, 0.02], [0.042, -0.03 - gap * 0.6, 0.014], 0.011);
  bone([0.042, -0.03 - gap * 0.6, 0.014], [0.004, -0.008 - gap * 0.6, 0], 0.0095);
  // The other three are bent.
  for (const [i, y] of [-0.004, -0.022, -0.038].entries()) {
    bone([0.086, y, 0.014 - 0.004 * i], [0.05, y + 0.004, -0.016], 0.009);
    bone([0.05, y + 0.004, -0.016], [0.066, y - 0.002, -0.036], 0.0085);
  }
  // Palm and forearm.
  bone([0.092, 0.004, 0.014], [0.14, -0.016, 0.022], 0.026);
  bone([0.096, -0.03, 0.012], [0.14, -0.026, 0.02], 0.024);
  bone([0.16, -0.03, 0.026], [0.32, -0.16, 0.07], 0.027);
  parts.push(new SphereGeometry(0.028, 16, 12).translate(0.148, -0.022, 0.022));
  const whole = mergeGeometries(parts);
  for (const part of parts) part.dispose();
  return whole;
}
