import { Container, Text } from "@react-three/uikit";
import { useEffect, useRef } from "react";

/** Capitals of 32 px are 23 mm high on panels that stand in the room, where a pixel is 1 mm. */
export const WORDS_PX = 32;
const ACCENT = "#3fb8b3";
const ON_ACCENT = "#04211f";

export function Row({ children }: { readonly children: React.ReactNode }) {
  return (
    <Container flexDirection="row" gap={12}>
      {children}
    </Container>
  );
}

export interface KeyProps {
  readonly id: string;
  readonly words: string;
  readonly onPress: () => void;
  readonly color?: string;
  readonly ink?: string;
  /** Of the accent colour: the one that is chosen, or the first thing to do. */
  readonly strong?: boolean;
  /** Acts when pressed; others act when let go, so that a finger can slide off. */
  readonly atOnce?: boolean;
  readonly height?: number;
  readonly size?: number;
  /** Its share of a row is its own width. */
  readonly narrow?: number;
}

/** Acts as long as it is held: a ray or finger that leaves it has let go. */
export function HoldKey({
  id,
  words,
  onHold,
  onLetGo,
}: {
  readonly id: string;
  readonly words: string;
  readonly onHold: () => void;
  readonly onLetGo: () => void;
}) {
  const letGo = useRef(onLetGo);
  letGo.current = onLetGo;
  // A key that goes away while it is held is let go.
  useEffect(
    () => () => {
      letGo.current();
    },
    [],
  );
  return (
    <Container
      id={id}
      flexGrow={1}
      flexBasis={0}
      height={68}
      borderRadius={14}
      alignItems="center"
      justifyContent="center"
      backgroundColor="#12413f"
      borderWidth={4}
      borderColor="#3fb8b3"
      hover={{ borderColor: "#f2f6f8" }}
      active={{ backgroundColor: "#3fb8b3" }}
      onPointerDown={onHold}
      onPointerUp={onLetGo}
      onPointerLeave={onLetGo}
      onPointerCancel={onLetGo}
    >
      <Text fontSize={WORDS_PX} fontWeight="medium" color="#f2f6f8">
        {words}
      </Text>
    </Container>
  );
}

export function Key({
  id,
  words,
  onPress,
  strong = false,
  color = strong ? ACCENT : "#2b343a",
  ink = strong ? ON_ACCENT : "#f2f6f8",
  atOnce = false,
  height = 84,
  size = WORDS_PX,
  narrow,
}: KeyProps) {
  return (
    <Container
      id={id}
      flexGrow={narrow === undefined ? 1 : 0}
      flexBasis={narrow ?? 0}
      height={height}
      borderRadius={14}
      alignItems="center"
      justifyContent="center"
      backgroundColor={color}
      borderWidth={4}
      borderColor={color}
      hover={{ borderColor: "#f2f6f8" }}
      active={{ transformTranslateZ: -6 }}
      {...(atOnce ? { onPointerDown: onPress } : { onClick: onPress })}
    >
      <Text fontSize={size} fontWeight="medium" color={ink}>
        {words}
      </Text>
    </Container>
  );
}
