import { millimetres } from "@twincell/core";
import { useFrame } from "@react-three/fiber";
import { Container, Text } from "@react-three/uikit";
import { useRef, useState } from "react";
import { type Group, Vector3 } from "three";
import { theLive } from "../../runtime/live.ts";
import { words } from "../../messages/index.ts";
import { whole } from "../../messages/numbers.ts";
import type { Interaction } from "../interaction.ts";
import { toScene } from "../world-space.ts";

const READ_EVERY_S = 0.1;
const READ_FROM_M = 1.5;
const BESIDE_M = 0.17;
const tip = new Vector3();
const eye = new Vector3();

/** The height of the tool tip, written beside the ring while it is held. */
export function HeldHeight({ interaction }: { readonly interaction: Interaction }) {
  const group = useRef<Group>(null);
  const since = useRef(0);
  const [text, setText] = useState("");
  useFrame(({ camera }, dt_s) => {
    const at = group.current;
    if (!at) return;
    const held = interaction.draggedPart !== null;
    at.visible = held;
    if (!held) return;
    toScene(theLive().worldFromTcp.position, tip);
    eye.setFromMatrixPosition(camera.matrixWorld);
    at.position.copy(tip);
    at.rotation.y = Math.atan2(eye.x - tip.x, eye.z - tip.z);
    at.scale.setScalar(Math.max(1, tip.distanceTo(eye) / READ_FROM_M));
    since.current += dt_s;
    if (since.current < READ_EVERY_S) return;
    since.current = 0;
    const next = words.headset.height(whole(millimetres(theLive().worldFromTcp.position[2])));
    if (next !== text) setText(next);
  }, -8);
  return (
    <group ref={group} name="held-height" visible={false}>
      <group position={[-BESIDE_M, 0, 0]}>
        <Container
          id="held-height"
          anchorX="right"
          pixelSize={0.001}
          paddingX={18}
          paddingY={10}
          borderRadius={12}
          backgroundColor="#161a1d"
          pointerEvents="none"
        >
          <Text fontSize={34} color="#f2f6f8">
            {text}
          </Text>
        </Container>
      </group>
    </group>
  );
}
