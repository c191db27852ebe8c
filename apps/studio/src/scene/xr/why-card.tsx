import { useFrame } from "@react-three/fiber";
import { Container, Text } from "@react-three/uikit";
import { useRef } from "react";
import { type Group, Vector3 } from "three";
import { useStore } from "zustand";
import { theLive } from "../../runtime/live.ts";
import { cellStore } from "../../stores/cell.ts";
import { jogStore } from "../../stores/jog.ts";
import { watchStore } from "../../stores/watch.ts";
import { solidName } from "../pick/thing-words.ts";
import { toScene } from "../world-space.ts";
import { capital } from "../../messages/phrases.ts";
import { WORDS } from "../words.ts";
import { say } from "../../messages/index.ts";

/** Capitals are 23 mm high at this distance and nearer, and as large to the eye farther away. */
const READ_FROM_M = 1.2;
const METRES_PER_PIXEL = 0.001;
const WORDS_PX = 32;
/** Clear of the tool and the wrist that carries it. */
const ABOVE_M = 0.2;
const TOWARDS_M = 0.22;
const tip = new Vector3();
const eye = new Vector3();

/** Why the tool does not go on, said at the tool and turned to whoever looks. */
export function WhyCard() {
  const blocked = useStore(jogStore, ({ blocked: now }) => now && say(now.sentence));
  const contact = useStore(watchStore, state => state.contacts[0]);
  const document = useStore(cellStore, state => state.document);
  const sentence =
    blocked ??
    (contact && document
      ? capital(WORDS.touch(solidName(contact[0], document), solidName(contact[1], document)))
      : undefined);
  const card = useRef<Group>(null);
  useFrame(({ camera }) => {
    const at = card.current;
    if (!at) return;
    toScene(theLive().worldFromTcp.position, tip);
    // In a headset the camera rides on the place where the person stands.
    eye.setFromMatrixPosition(camera.matrixWorld);
    const scale = Math.max(1, tip.distanceTo(eye) / READ_FROM_M);
    at.position.copy(eye).sub(tip).setLength(TOWARDS_M).add(tip);
    at.position.y += ABOVE_M * scale;
    at.scale.setScalar(scale);
    at.rotation.y = Math.atan2(eye.x - tip.x, eye.z - tip.z);
  }, -8);
  return (
    <group ref={card} visible={sentence !== undefined} name="why-card">
      <Container
        id="why-card"
        positionType="absolute"
        anchorX="center"
        anchorY="bottom"
        pixelSize={METRES_PER_PIXEL}
        width={460}
        padding={20}
        borderRadius={18}
        borderWidth={3}
        borderColor="#ff6157"
        backgroundColor="#1d1414"
        pointerEvents="none"
      >
        <Text id="why" fontSize={WORDS_PX} color="#ffd9d6">
          {sentence ?? ""}
        </Text>
      </Container>
    </group>
  );
}
