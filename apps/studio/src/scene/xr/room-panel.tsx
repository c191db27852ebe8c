import { Container, Text } from "@react-three/uikit";
import { Handle, HandleTarget } from "@react-three/handle";
import { useEffect, type ReactNode } from "react";
import { aimAt, type KeyAim } from "./grabber.ts";
import { WORDS_PX } from "./keys.tsx";

/** Capitals are 23 mm high: read from 1.2 m. */
export const ROOM_METRES_PER_PIXEL = 0.001;

/** A panel that stands in the room. Who takes its upper bar with the ray or a hand puts it elsewhere. */
export function RoomPanel({
  id,
  title,
  place,
  turn_rad,
  width,
  keys,
  above,
  children,
}: {
  readonly id: string;
  readonly title: ReactNode;
  readonly place: readonly [number, number, number];
  readonly turn_rad: number;
  /** In pixels of 1 mm. */
  readonly width: number;
  readonly keys: KeyAim;
  /** What hangs above the bar, its lower edge at y = 0 [m]. */
  readonly above?: ReactNode;
  readonly children: ReactNode;
}) {
  useEffect(
    () => () => {
      aimAt(keys, id, false);
    },
    [keys, id],
  );
  const aim = (aimed: boolean): void => {
    aimAt(keys, id, aimed);
  };
  return (
    <group name={id} position={[...place]} rotation-y={turn_rad}>
      <HandleTarget>
        {above}
        <Handle targetRef="from-context" scale={false} rotate={false} multitouch={false}>
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
export const Words = ({ children, color = "#f2f6f8" }: { readonly children: string; readonly color?: string }) => (
  <Text fontSize={WORDS_PX} color={color}>
    {children}
  </Text>
);
