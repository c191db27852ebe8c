import { useFrame } from "@react-three/fiber";
import { useEffect, useMemo, useRef, useState } from "react";
import { CanvasTexture, type Mesh, type MeshBasicMaterial, SRGBColorSpace } from "three";
import { useStore } from "zustand";
import { feedOf, hideCamera, showCamera } from "../../runtime/video/feeds.ts";
import { freshness } from "../../runtime/video/freshness.ts";
import { videoStore, type VideoPanel } from "../../stores/video.ts";
import { words } from "../../messages/index.ts";
import { ageWords } from "../../messages/phrases.ts";
import { WORDS } from "../words.ts";
import type { KeyAim } from "./grabber.ts";
import { Key, Row } from "./keys.tsx";
import { RoomPanel, Words } from "./room-panel.tsx";

const WIDTH_M = 0.84;
const WIDTH_PX = 840;
const BAR_M = 0.076;
const SAY_EVERY_S = 0.25;
const QUIET = "#b9c4ca";
const WARNS = "#ffcf70";
/** To the right of the robot as the person sees it, the next ones above it. */
const placeOf = (place: number): readonly [number, number, number] => [0.95, 1.3 + 0.75 * place, -0.95];
const TURN_RAD = -0.75;

/** The picture of a camera beside the twin. It says how old it is; one that stands still goes grey. */
export function CameraPanel({
  panel: { id, name, trouble: problem },
  place,
  keys,
}: {
  readonly panel: VideoPanel;
  readonly place: number;
  readonly keys: KeyAim;
}) {
  const held = useStore(videoStore, state => state.heldBy === id);
  const [said, setSaid] = useState<readonly [string, string, boolean]>(["", "", false]);
  const quad = useRef<Mesh>(null);
  const since_s = useRef(SAY_EVERY_S);
  const seen = useRef(-1);
  const texture = useMemo(() => {
    const canvas = feedOf(id)?.canvas;
    const made = canvas && new CanvasTexture(canvas);
    if (made) made.colorSpace = SRGBColorSpace;
    return made;
  }, [id]);
  useEffect(
    () => () => {
      texture?.dispose();
    },
    [texture],
  );
  useFrame((_, dt_s) => {
    const feed = feedOf(id);
    const mesh = quad.current;
    if (!feed || !mesh || !texture) return;
    const now = freshness(feed.times, performance.now() / 1000);
    const material = mesh.material as MeshBasicMaterial;
    if (feed.revision !== seen.current) {
      seen.current = feed.revision;
      const { width, height } = feed.canvas;
      const image = texture.userData as { width?: number; height?: number };
      // A texture keeps the size it was made with.
      if (image.width !== width || image.height !== height) {
        texture.dispose();
        image.width = width;
        image.height = height;
      }
      texture.needsUpdate = true;
      mesh.scale.set(WIDTH_M, (WIDTH_M * height) / width, 1);
      mesh.position.y = BAR_M + mesh.scale.y / 2;
    }
    mesh.visible = now.kind !== "none";
    material.color.setScalar(now.kind === "still" ? 0.28 : 1);
    since_s.current += dt_s;
    if (since_s.current < SAY_EVERY_S) return;
    since_s.current = 0;
    const age = now.kind === "none" || now.kind === "still" ? "" : ageWords(now.age_s);
    const warns =
      problem ||
      (now.kind === "late"
        ? words.video.late(now.age_s)
        : now.kind === "still"
          ? words.video.still(now.still_s)
          : now.kind === "none"
            ? words.video.waiting
            : "");
    const text = now.kind === "still" && problem ? `${problem} ${words.video.still(now.still_s)}` : warns;
    if (age !== said[0] || text !== said[1]) setSaid([age, text, text !== ""]);
  });
  return (
    <RoomPanel
      id={`camera-panel-${place}`}
      place={placeOf(place)}
      turn_rad={TURN_RAD}
      width={WIDTH_PX}
      keys={keys}
      title={
        <>
          <Words>{name}</Words>
          <Words color={QUIET}>{said[0]}</Words>
        </>
      }
      above={
        texture && (
          <mesh ref={quad} name={`camera-picture-${place}`} visible={false} pointerEvents="none">
            <planeGeometry />
            <meshBasicMaterial map={texture} toneMapped={false} />
          </mesh>
        )
      }
    >
      <Words color={said[2] ? WARNS : QUIET}>{said[1] || words.video.noSafety}</Words>
      <Row>
        <Key
          id={`camera-hold-${place}`}
          words={held ? WORDS.twinHeld : WORDS.holdTwin}
          {...(held ? { color: "#3fb8b3", ink: "#04211f" } : {})}
          onPress={() => {
            videoStore.setState({ heldBy: held ? null : id });
          }}
        />
        <Key
          id={`camera-hide-${place}`}
          words={WORDS.hide}
          onPress={() => {
            hideCamera(id);
          }}
        />
      </Row>
    </RoomPanel>
  );
}

const MOST_OFFERED = 4;

/** Where no camera is shown yet: those that show themselves through the server can be taken here. */
export function NoCamera({ keys }: { readonly keys: KeyAim }) {
  const cameras = useStore(videoStore, state => state.cameras);
  if (cameras.length === 0) return null;
  return (
    <RoomPanel
      id="camera-none"
      place={placeOf(0)}
      turn_rad={TURN_RAD}
      width={WIDTH_PX}
      keys={keys}
      title={<Words>{WORDS.noCamera}</Words>}
    >
      <Words color={QUIET}>{WORDS.offered}</Words>
      {cameras.slice(0, MOST_OFFERED).map(({ camera, name }) => (
        <Row key={camera}>
          <Key
            id={`camera-show-${camera}`}
            words={name}
            onPress={() => {
              showCamera({ kind: "server", name }, name);
            }}
          />
        </Row>
      ))}
    </RoomPanel>
  );
}
