import { useThree } from "@react-three/fiber";
import { Container, Text } from "@react-three/uikit";
import { defaultApply, Handle, HandleTarget, type HandleOptions } from "@react-three/handle";
import { useEffect, useRef, type ReactNode } from "react";
import { type Group, Matrix4, type Object3D, Vector3 } from "three";
import { useStore } from "zustand";
import { headsetStore, putPanel } from "../../stores/headset.ts";
import { aimAt, type KeyAim } from "./grabber.ts";
import { WORDS_PX } from "./keys.tsx";
import { settledPlace } from "./panel-place.ts";

/** Capitals are 23 mm high: read from 1.6 m. */
export const ROOM_METRES_PER_PIXEL = 0.001;

/**
 * A panel that stands in the room. Who takes its upper bar with the ray or a hand puts it elsewhere: let go, it turns
 * to the eyes, and it stands there again the next time.
 */
export function RoomPanel({
  id,
  title,
  place,
  turn_rad,
  width,
  keys,
  upright = false,
  above,
  children,
}: {
  readonly id: string;
  readonly title: ReactNode;
  /** Where it stands until somebody puts it elsewhere. */
  readonly place: readonly [number, number, number];
  readonly turn_rad: number;
  /** In pixels of 1 mm. */
  readonly width: number;
  readonly keys: KeyAim;
  /** It stands on a post: it is turned to the eyes but not tilted. */
  readonly upright?: boolean;
  /** What hangs above the bar, its lower edge at y = 0 [m]. */
  readonly above?: ReactNode;
  readonly children: ReactNode;
}) {
  const put = useStore(headsetStore, state => state.places[id]);
  const panel = useRef<Group>(null);
  const get = useThree(state => state.get);
  useEffect(
    () => () => {
      aimAt(keys, id, false);
    },
    [keys, id],
  );
  const aim = (aimed: boolean): void => {
    aimAt(keys, id, aimed);
  };
  const apply: HandleOptions<unknown>["apply"] = (state, moved) => {
    const result = defaultApply(state, moved);
    if (state.last && panel.current) settle(id, panel.current, moved, get().camera.matrixWorld);
    return result;
  };
  return (
    <group
      ref={panel}
      name={id}
      position={put ? [...put.at] : [...place]}
      rotation={[upright ? 0 : (put?.tilt_rad ?? 0), put?.turn_rad ?? turn_rad, 0, "YXZ"]}
    >
      <HandleTarget>
        {above}
        <Handle targetRef="from-context" scale={false} rotate={false} multitouch={false} apply={apply}>
          <Container
            id={`${id}-bar`}
            anchorX="center"
            anchorY="bottom"
            pixelSize={ROOM_METRES_PER_PIXEL}
            width={width}
            height={64}
            paddingX={22}
            borderRadius={18}
            alignItems="center"
            justifyContent="space-between"
            flexDirection="row"
            backgroundColor="#232b30"
            borderWidth={3}
            borderColor="#3a444a"
            hover={{ borderColor: "#f2f6f8" }}
            onHoverChange={aim}
          >
            {title}
          </Container>
        </Handle>
        <group position-y={-0.012}>
          <Container
            id={`${id}-body`}
            anchorX="center"
            anchorY="top"
            flexDirection="column"
            gap={14}
            padding={18}
            width={width}
            pixelSize={ROOM_METRES_PER_PIXEL}
            backgroundColor="#161a1d"
            borderRadius={22}
            borderWidth={2}
            borderColor="#3a444a"
            onHoverChange={aim}
          >
            {children}
          </Container>
        </group>
      </HandleTarget>
    </group>
  );
}

const roomFromScene = new Matrix4();
const at = new Vector3();
const eye = new Vector3();

/** Keeps where it was let go, and takes back the way it was carried: from now on it stands there by itself. */
function settle(id: string, panel: Group, moved: Object3D, camera: Matrix4): void {
  const room = panel.parent;
  if (!room) return;
  roomFromScene.copy(room.matrixWorld).invert();
  eye.setFromMatrixPosition(camera).applyMatrix4(roomFromScene);
  panel.updateMatrix();
  at.copy(moved.position).applyMatrix4(panel.matrix);
  moved.position.set(0, 0, 0);
  putPanel(id, settledPlace([at.x, at.y, at.z], [eye.x, eye.y, eye.z]));
}

export const Words = ({ children, color = "#f2f6f8" }: { readonly children: string; readonly color?: string }) => (
  <Text fontSize={WORDS_PX} color={color}>
    {children}
  </Text>
);
